// What must hold whatever the scene: how it is read, where seeds are put, and what becomes of them.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

#include "compute/nearest_image.hpp"
#include "fields/map_part.hpp"
#include "fields/mean_map.hpp"
#include "fields/packing_fraction.hpp"
#include "fields/tray_frame.hpp"
#include "grains/turned_discs.hpp"
#include "input/read_scene.hpp"
#include "result/run_check.hpp"
#include "scene/input_error.hpp"
#include "scene/motion.hpp"
#include "scene/scene_json.hpp"
#include "scene/seed_lot.hpp"
#include "scenes/any_scene.hpp"
#include "scenes/mirrored.hpp"
#include "scenes/own_walls.hpp"
#include "simulation/live_run.hpp"
#include "simulation/seed_places.hpp"
#include "simulation/simulation.hpp"
#include "support/bench.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

// ---- reading ----

std::string json_differs(const DrawnScene& drawn) {
  Scene scene;
  if (!refusal([&] { scene = drawn.read(); }).empty()) return "";
  const std::string json = scene_to_json(scene);
  const Scene again = scene_from_json(json);
  if (!(again == scene)) return "read back from its JSON it is another scene: " + json;
  return scene_to_json(again) == json ? "" : "its JSON is not the same when it is written again: " + json;
}

TEST(DrawnScene, IsTheSameReadBackFromItsJson) {
  expect_of_drawn_scenes(60, json_differs);
}

/// What a seeder text with a change from the command line is: a scene, or the words by which it is refused.
struct Said {
  std::optional<Scene> scene;
  std::string refused;
  bool operator==(const Said&) const = default;
};
Said said(const DrawnScene& drawn, const std::string& text, const std::vector<Override>& overrides = {}) {
  Said what;
  what.refused = refusal([&] { what.scene = read_scene(DrawnScene::path(), overrides, drawn.files_with(text)); });
  return what;
}

std::string text_with(const DrawnScene& drawn, const std::string& key, const std::string& value) {
  std::string text;
  for (const DrawnScene::Key& one : drawn.keys()) {
    if (one.first != key)
      text += one.first + " = " + one.second + "\n";
    else if (!value.empty())
      text += one.first + " = " + value + "\n";
  }
  return text;
}

/// Whether another key stands in the same table, which is then still there without this one.
bool has_company(const DrawnScene& drawn, const std::string& key) {
  const std::string table = key.substr(0, key.rfind('.') + 1);
  return std::ranges::count_if(drawn.keys(), [&](const DrawnScene::Key& one) { return one.first.starts_with(table); }) >
         1;
}

/// Of some keys one of three ways; which, is the scene's.
std::string set_differs(const DrawnScene& drawn) {
  const Said whole = said(drawn, drawn.toml());
  for (const auto& [key, value] : drawn.keys()) {
    if (Draw(drawn.seed(), {}).below(key, 4) > 0) continue;  // a solid clump takes 20 ms to read
    const std::string without = text_with(drawn, key, "");
    const Override given = parse_override(key + "=" + value), taken_out = parse_override(key + "=");
    const auto way = drawn.seed() % 3;
    if (way == 0 && !(said(drawn, without, {given}) == whole)) return "by --set it is another scene: " + key;
    if (way == 1 && !(said(drawn, text_with(drawn, key, "\"nothing\""), {given}) == whole))
      return "by --set over another value it is another scene: " + key;
    if (way == 2 && has_company(drawn, key) && !(said(drawn, drawn.toml(), {taken_out}) == said(drawn, without)))
      return "by --set KEY= it is not as if that had not been written: " + key;
  }
  return "";
}

TEST(DrawnScene, IsTheSameBySetAndByTheFile) {
  expect_of_drawn_scenes(16, set_differs);
}

// ---- balls, as the test sees them ----

struct OwnBall {
  std::size_t seed;    // of the grains
  std::int64_t id;     // of the seed
  std::size_t part;    // of a clump
  Eigen::Vector3d at;  // m, lab; in the plane z = 0
  double radius;       // m
};

std::vector<OwnBall> balls_of(const Model& model, const Grains& grains) {
  std::vector<OwnBall> balls;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const SeedLot& lot = model.scene.lots[static_cast<std::size_t>(grains.lot[i])];
    const double radius = grains.kind(i).radius, size = radius / (0.5 * lot.diameter);
    const Eigen::Vector3d centre = place_of(grains, i);
    if (lot.discs.empty()) balls.push_back({i, grains.id[i], 0, centre, radius});
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    if (!lot.discs.empty() && grains.is_3d)
      turned = Eigen::Quaterniond(grains.q_w[i], grains.q_x[i], grains.q_y[i], grains.q_z[i]).toRotationMatrix();
    else if (!lot.discs.empty())
      turned = Eigen::AngleAxisd(grains.angle[i], Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (std::size_t k = 0; k < lot.discs.size(); ++k) {
      const ClumpDisc& disc = lot.discs[k];
      balls.push_back({i, grains.id[i], k, centre + size * (turned * centre_of(disc)), size * disc.radius});
    }
  }
  return balls;
}

/// A scene's vessels, and in the periods beside a periodic tray the hopper again, which is fed nothing there.
std::vector<Vessel> with_hoppers_beside(const Scene& scene) {
  std::vector<Vessel> vessels = vessels_of(scene);
  if (!scene.hopper) return vessels;
  const bool along = scene.tray.sides == Sides::periodic;
  const bool across = scene.space != Space::two_dimensional && scene.tray.front_and_back == Sides::periodic &&
                      scene.hopper->front_and_back != Sides::periodic;
  for (int i = along ? -1 : 0; i <= (along ? 1 : 0); ++i)
    for (int k = across ? -1 : 0; k <= (across ? 1 : 0); ++k) {
      if (i == 0 && k == 0) continue;
      Vessel beside = *scene.hopper;
      beside.fill.reset(), beside.rain.reset();
      beside.origin.x() += i * scene.tray.length;
      if (k != 0) beside.front += k * *scene.tray.depth;
      vessels.push_back(beside);
    }
  return vessels;
}

/// Walls and rooms of a scene's vessels.
class OwnScene {
 public:
  explicit OwnScene(const Model& model)
      : model_(model), vessels_(with_hoppers_beside(model.scene)), space_(model.scene.space) {
    for (const Vessel& vessel : vessels_) {
      walls_.push_back(own_walls(vessel, space_));
      paths_.emplace_back(vessel);
    }
  }

  std::size_t vessels() const { return vessels_.size(); }
  const Vessel& vessel(std::size_t vessel) const { return vessels_[vessel]; }
  const std::vector<OwnWall>& walls(std::size_t vessel) const { return walls_[vessel]; }
  Eigen::Vector3d in_vessel(std::size_t vessel, double time, const Eigen::Vector3d& lab) const {
    return point_in_vessel(vessels_[vessel], paths_[vessel].pose(time), lab);
  }

  /// What a seed that was just put in overlaps; empty: nothing.
  std::string overlaps(const std::vector<OwnBall>& balls, std::int64_t first_new, double time) const {
    for (const OwnBall& ball : balls) {
      if (ball.id < first_new) continue;
      for (const OwnBall& other : balls) {
        if (other.seed == ball.seed) continue;
        const double deep = ball.radius + other.radius - apart(ball.at - other.at);
        if (deep > slack * std::min(ball.radius, other.radius)) return told(ball, time, deep, fmt("seed ", other.id));
      }
      for (std::size_t v = 0; v < vessels(); ++v) {
        const Eigen::Vector3d own = in_vessel(v, time, ball.at);
        for (const OwnWall& wall : walls_[v])
          if (!(wall.opens_at > 0 && wall.opens_at <= time) && ball.radius - wall.distance(own) > slack * ball.radius)
            return told(ball, time, ball.radius - wall.distance(own), wall.name);
      }
    }
    return "";
  }

  /// Whether a seed lies in the room of a vessel, or falls straight down into its opening. Rain falls into one that
  /// turns as if it stood still.
  bool is_in(std::size_t vessel, double time, const Eigen::Vector3d& lab) {
    for (std::size_t v = rooms_.size(); v <= vessel; ++v)
      rooms_.emplace_back(vessels_[v], space_, 0.8 * least_half_width(model_.scene.lots));
    if (turns_steadily(vessels_[vessel]) && time > 0) return true;
    Eigen::Vector3d own = in_vessel(vessel, time, lab);
    const Eigen::Vector3d up = in_vessel(vessel, time, lab + Eigen::Vector3d::UnitY()) - own;
    const double over = own.y() - vessels_[vessel].height;
    if (over > 0 && up.y() > 0) own -= over / up.y() * Eigen::Vector3d(up.x(), 0, up.z());
    return rooms_[vessel].contains(own);
  }

 private:
  static constexpr double slack = 1e-9;  // of the radius

  template <class... Parts>
  static std::string fmt(const Parts&... parts) {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
  }
  static std::string told(const OwnBall& ball, double time, double deep, const std::string& what) {
    return fmt("seed ", ball.id, ", put in before ", time, " s, overlaps ", what, " by ", deep / ball.radius,
               " of its radius, at ", ball.at.transpose());
  }
  double apart(Eigen::Vector3d between) const {
    const Vessel& tray = model_.scene.tray;
    if (tray.sides == Sides::periodic) between.x() = std::remainder(between.x(), tray.length);
    if (space_ != Space::two_dimensional && tray.front_and_back == Sides::periodic)
      between.z() = std::remainder(between.z(), *tray.depth);
    return between.norm();
  }

  const Model& model_;
  std::vector<Vessel> vessels_;
  Space space_;
  std::vector<std::vector<OwnWall>> walls_;
  std::vector<OwnRoom> rooms_;
  std::vector<VesselPath> paths_;
};

/// Where the guard ended a run, and why; empty: it did not.
std::string told_by(const Simulation& run) {
  return run.guard().stop_reason() ? " (the guard has since stopped the run: " + *run.guard().stop_reason() + ")" : "";
}

// ---- what is put in ----

/// The vessel into which the fill's k-th seed went.
std::size_t vessel_filled(const Scene& scene, std::size_t k) {
  return scene.tray.fill && k < static_cast<std::size_t>(scene.tray.fill->count) ? 0 : 1;
}

std::string outside_of_room(OwnScene& own, const Model& model, const Grains& grains, std::int64_t first_new,
                            double time) {
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (grains.id[i] < first_new) continue;
    bool inside = false;
    for (std::size_t v = 0; v < own.vessels(); ++v) {
      const Vessel& vessel = own.vessel(v);
      const bool feeds =
          time > 0 ? vessel.rain || (vessel.fill && vessel.fill->keep) : vessel_filled(model.scene, i) == v;
      inside |= feeds && own.is_in(v, time, place_of(grains, i));
    }
    if (inside) continue;
    std::ostringstream out;
    out << "seed " << grains.id[i] << ", put in before " << time << " s, lies outside, at "
        << place_of(grains, i).transpose();
    return out.str();
  }
  return "";
}

/// Watches the start and every insertion.
std::string put_in_wrongly(const DrawnScene& drawn, bool rooms) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start) return "";
  const Model& model = start->model;
  OwnScene own(model);
  std::int64_t seen = 0;
  std::string wrong;
  const auto look = [&](const Grains& grains, double time) {
    if (grains.next_id == seen || !wrong.empty()) return;
    wrong = rooms ? outside_of_room(own, model, grains, seen, time) : own.overlaps(balls_of(model, grains), seen, time);
    seen = grains.next_id;
  };
  look(start->state.grains, 0);
  Simulation run(model, std::move(start->state));
  while (wrong.empty() && !run.at_end() && run.step()) look(run.grains(), run.time());
  // The program's own look at each insertion ends a run before this test's; that it had to is a fault as well.
  const std::optional<std::string>& stopped = run.guard().stop_reason();
  if (wrong.empty() && stopped && stopped->find("was put in wrongly") != std::string::npos) wrong = *stopped;
  return wrong;
}

TEST(DrawnScene, WhatIsPutInOverlapsNothing) {
  expect_of_drawn_scenes(30, [](const DrawnScene& drawn) { return put_in_wrongly(drawn, false); });
}

TEST(DrawnScene, WhatIsPutInLiesWithinItsVessel) {
  expect_of_drawn_scenes(30, [](const DrawnScene& drawn) { return put_in_wrongly(drawn, true); });
}

/// The share of a mixture that was asked of each lot, as it is written; empty where a lot's seeds are of many sizes.
std::vector<double> shares_asked(const DrawnScene& drawn, const Scene& scene, bool& by_mass) {
  std::vector<double> shares;
  for (const auto& [key, value] : drawn.keys()) {
    if (!key.ends_with("_fraction")) continue;
    by_mass = key.ends_with("mass_fraction");
    shares.push_back(std::strtod(value.c_str() + 1, nullptr) / 100);
  }
  for (const SeedLot& lot : scene.lots)
    if (lot.sizes.kind != SizeDistribution::Kind::single) return {};
  return shares;
}

/// Of what lies there at the start; each vessel's fill may miss a lot's share by less than a seed.
std::string lots_not_as_asked(const DrawnScene& drawn) {
  const std::optional<RunStart> start = start_of(drawn);
  if (!start || start->state.grains.size() == 0) return "";
  const Scene& scene = start->model.scene;
  bool by_mass = false;
  const std::vector<double> asked = shares_asked(drawn, scene, by_mass);
  std::vector<double> of_lot(scene.lots.size());
  double all = 0, seed = 0;
  for (const int lot : start->state.grains.lot) {
    const double one = by_mass ? scene.lots[static_cast<std::size_t>(lot)].mass : 1;
    of_lot[static_cast<std::size_t>(lot)] += one, all += one;
  }
  for (const SeedLot& lot : scene.lots) seed += by_mass ? lot.mass : 1;
  for (std::size_t lot = 0; lot < scene.lots.size(); ++lot) {
    if (of_lot[lot] == 0) return "there is no seed of the lot " + scene.lots[lot].name;
    if (asked.empty() || std::abs(of_lot[lot] / all - asked[lot]) < 2 * seed / all + 1e-9) continue;
    return "the lot " + scene.lots[lot].name +
           " has another share than was asked for: " + std::to_string(of_lot[lot] / all);
  }
  return "";
}

TEST(DrawnScene, HasTheLotsThatWereAskedFor) {
  expect_of_drawn_scenes(60, lots_not_as_asked);
}

// ---- what is counted ----

std::string unbalanced(const DrawnScene& drawn) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start) return "";
  Simulation run(start->model, std::move(start->state));
  std::string wrong;
  run.watch(1e-3, [&](Simulation& now) {
    const vibrosow::Run result = now.result();
    const Balance& balance = result.balance;
    std::set<std::int64_t> left;
    std::int64_t counted = 0, spilled = 0, inside = 0;
    for (const OutflowEvent& event : result.events) {
      if (!left.insert(event.grain).second) wrong = "a seed was counted twice";
      ++(event.hole > 0 ? counted : spilled);
    }
    for (const std::int64_t id : now.grains().id) inside += left.contains(id) ? 0 : 1;
    if (balance.put_in != now.grains().next_id) wrong = "not all that was put in is told";
    if (balance.counted != counted || balance.spilled != spilled) wrong = "events and balance differ";
    const std::int64_t gone = balance.put_in - inside - counted - spilled;
    if (balance.inside + balance.lost != inside + gone || balance.lost < gone) wrong = "seeds are nowhere";
    if (balance.put_in != balance.inside + balance.counted + balance.spilled + balance.lost)
      wrong = "put in is not inside + counted + spilled + lost";
  });
  while (wrong.empty() && !run.at_end() && run.step()) {
  }
  return wrong.empty() ? "" : wrong + told_by(run);
}

/// A run whose shake and first hole change on its way: what was counted before each change is no longer in its balance.
std::string unbalanced_by_changes(const DrawnScene& drawn) {
  std::optional<Scene> scene = scene_of(drawn);
  if (!scene || scene->space != Space::two_dimensional || !start_of(drawn)) return "";
  if (!scene->tray.motion || !std::holds_alternative<HarmonicMotion>(*scene->tray.motion))
    scene->tray.motion = HarmonicMotion{0, 1e-3, 12, 0};  // which alone changes on the way
  scene->run.end_after_pause.reset();
  std::optional<LiveRun> started;
  if (!refusal([&] { started.emplace(*scene, 1); }).empty()) return "";
  LiveRun& run = *started;
  std::set<std::int64_t> counted;
  const auto count = [&] {
    for (const OutflowEvent& event : run.simulation().events_since(0)) counted.insert(event.grain);
  };
  const auto go_to = [&](double time) {
    while (run.simulation().time() < time && !run.simulation().at_end()) {
      if (run.is_waiting()) count();  // the next step may begin anew
      if (!run.step()) return;
    }
  };
  go_to(0.4 * scene->run.duration);
  Scene wanted = *scene;
  HarmonicMotion& shake = std::get<HarmonicMotion>(*wanted.tray.motion);
  shake.amplitude *= 1.3, shake.frequency *= 1.1;
  if (!wanted.tray.holes.empty()) wanted.tray.holes.front().centre += 1e-3, wanted.tray.holes.front().width += 1e-3;
  if (run.change(wanted)) return "";
  go_to(1.2 * scene->run.duration);
  count();
  const vibrosow::Run result = run.simulation().result();
  const Balance& balance = result.balance;
  if (!is_balanced(balance)) return "put in is not inside + counted + spilled + lost" + told_by(run.simulation());
  std::set<std::int64_t> known = counted;
  known.insert(run.simulation().grains().id.begin(), run.simulation().grains().id.end());
  const std::int64_t gone = run.simulation().grains().next_id - static_cast<std::int64_t>(known.size());
  return gone <= balance.lost ? "" : std::to_string(gone) + " seeds are nowhere" + told_by(run.simulation());
}

TEST(DrawnScene, LosesNoSeedWhenItIsChangedOnItsWay) {
  expect_of_drawn_scenes(60, unbalanced_by_changes);
}

TEST(DrawnScene, AllThatWasPutInIsSomewhere) {
  expect_of_drawn_scenes(30, unbalanced);
}

/// Whether a seed counts as a vessel's own, by the program and by this test's rooms: in the vessel's, and in no hopper
/// within it. Seeds so near to a wall that rooms differ by what fits there are left out.
std::string counts_elsewhere(const DrawnScene& drawn) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start || !start->model.scene.hopper) return "";
  const Model& model = start->model;
  if (std::ranges::any_of(model.vessels, turns_steadily)) return "";
  OwnScene own(model);
  const SeedPlaces places(model);
  const double least = least_half_width(model.scene.lots);
  Simulation run(model, std::move(start->state));
  std::string wrong;
  const auto look = [&] {
    const Grains& grains = run.grains();
    for (std::size_t i = 0; i < grains.size() && wrong.empty(); ++i) {
      const Eigen::Vector3d at = place_of(grains, i);
      bool is_near_wall = false;
      for (std::size_t v = 0; v < own.vessels(); ++v) {
        const Eigen::Vector3d in_vessel = own.in_vessel(v, run.time(), at);
        is_near_wall |= std::abs(in_vessel.y()) < least;
        for (const OwnWall& wall : own.walls(v)) is_near_wall |= wall.distance(in_vessel) < 0.9 * least;
      }
      if (is_near_wall) continue;
      const Walls& walls = run.field().walls();
      const bool below_top = own.in_vessel(1, run.time(), at).y() <= model.vessels[1].height;
      const bool in_hopper = below_top && own.is_in(1, run.time(), at);
      const bool of_hopper = below_top && places.counts_in(at, 1, walls);
      if (of_hopper != in_hopper || places.counts_in(at, 0, walls) == in_hopper)
        wrong = "seed " + std::to_string(grains.id[i]) + " lies " + (in_hopper ? "in" : "beside") + " the hopper at " +
                std::to_string(run.time()) + " s, and counts otherwise";
    }
  };
  look();
  run.watch(0.2 * model.scene.run.duration, [&](Simulation&) { look(); });
  while (wrong.empty() && !run.at_end() && run.step()) {
  }
  return wrong;
}

TEST(DrawnScene, CountsEachSeedInTheVesselWhereItLies) {
  expect_of_drawn_scenes(30, counts_elsewhere);
}

// ---- lists ----

/// Lists that reach far and last, against those that are made anew every few steps: not one contact may differ.
std::string depends_on_margins(const DrawnScene& drawn) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start) return "";
  const ComputeOptions narrow{.margins = {.wide = 0.1, .narrow = 0.02, .wide_3d = 0.1}};
  Simulation run(start->model, start->state), other(start->model, start->state, narrow);
  const double end = start->model.scene.run.duration;
  run.run_until(end), other.run_until(end);
  const Grains &g = run.grains(), &h = other.grains();
  const bool same = g.id == h.id && g.x == h.x && g.y == h.y && g.z == h.z && g.vx == h.vx && g.omega == h.omega;
  return same ? "" : "other margins of the lists give another run" + told_by(run);
}

TEST(DrawnScene, IsTheSameWithOtherMarginsOfItsLists) {
  expect_of_drawn_scenes(30, depends_on_margins);
}

// ---- walls ----

/// Follows every ball from millisecond to millisecond.
class Followed {
 public:
  Followed(const Model& model) : model_(model), own_(model) {}

  /// The first wall that a ball has passed since the look before; empty: none.
  std::string look(const Grains& grains, double time) {
    std::string wrong;
    std::map<std::pair<std::int64_t, std::size_t>, std::vector<Eigen::Vector3d>> now;
    for (const OwnBall& ball : balls_of(model_, grains)) {
      std::vector<Eigen::Vector3d>& places = now[{ball.id, ball.part}];
      for (std::size_t v = 0; v < own_.vessels(); ++v) places.push_back(own_.in_vessel(v, time, ball.at));
      const auto before = before_.find({ball.id, ball.part});
      if (before == before_.end()) continue;
      for (std::size_t v = 0; v < own_.vessels() && wrong.empty(); ++v)
        wrong = passed(v, before->second[v], places[v], ball, time);
    }
    before_ = std::move(now);
    return wrong;
  }

 private:
  std::string passed(std::size_t v, const Eigen::Vector3d& from, const Eigen::Vector3d& to, const OwnBall& ball,
                     double time) const {
    const Vessel& tray = model_.scene.tray;
    const Eigen::Vector3d way = to - from;
    if (tray.sides == Sides::periodic && std::abs(way.x()) > tray.length / 2) return "";
    if (grains_3d() && tray.front_and_back == Sides::periodic && std::abs(way.z()) > *tray.depth / 2) return "";
    const int pieces = 1 + static_cast<int>(way.norm() / (0.2 * ball.radius));
    for (const OwnWall& wall : own_.walls(v)) {
      if (wall.opens_at > 0 && wall.opens_at <= time) continue;
      for (int k = 0; k <= pieces; ++k)
        if (wall.distance(from + way * k / pieces) < 0.15 * ball.radius) {
          std::ostringstream out;
          out << "seed " << ball.id << " passed " << wall.name << " before " << time << " s, at "
              << ball.at.transpose();
          return out.str();
        }
    }
    return "";
  }
  bool grains_3d() const { return model_.scene.space != Space::two_dimensional; }

  const Model& model_;
  OwnScene own_;
  std::map<std::pair<std::int64_t, std::size_t>, std::vector<Eigen::Vector3d>> before_;
};

std::string passed_a_wall(const DrawnScene& drawn) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start) return "";
  Followed followed(start->model);
  std::string wrong = followed.look(start->state.grains, 0);
  Simulation run(start->model, std::move(start->state));
  run.watch(1e-3, [&](Simulation& now) {
    const std::string text = followed.look(now.grains(), now.time());
    if (wrong.empty()) wrong = text;
  });
  run.run_until(start->model.scene.run.duration);
  const vibrosow::Run result = run.result();
  return result.status == RunStatus::finished && result.balance.lost == 0 ? wrong : "";
}

TEST(DrawnScene, NoSeedOfAFinishedRunHasPassedAWall) {
  expect_of_drawn_scenes(30, passed_a_wall);
}

/// Places around a scene's vessels, the same ones for every scene of one size.
std::vector<Eigen::Vector3d> places_around(const Scene& scene) {
  Random random(7);
  std::vector<Eigen::Vector3d> places;
  for (int k = 0; k < 40; ++k) {
    const Vessel& vessel = k % 2 && scene.hopper ? *scene.hopper : scene.tray;
    const double x = vessel.length * random.uniform(-0.2, 1.2), y = vessel.height * random.uniform(-0.2, 1.2);
    const double z =
        scene.space == Space::two_dimensional ? 0 : vessel.front + *vessel.depth * random.uniform(-0.2, 1.2);
    places.emplace_back(vessel.origin.x() + x, vessel.origin.y() + y, z);
  }
  return places;
}

std::string not_the_walls_described(const DrawnScene& drawn) {
  Scene scene;
  if (!refusal([&] { scene = drawn.read(); }).empty()) return "";
  Walls walls(vessels_of(scene), scene.space);
  for (const double time : {0.0, 0.013}) {
    walls.place(time);
    for (const Eigen::Vector3d& at : places_around(scene)) {
      double theirs = INFINITY, ours = INFINITY;
      for (std::size_t k = 0; k < walls.count(); ++k) theirs = std::min(theirs, std::sqrt(walls.distance2(k, at)));
      for (const Vessel& vessel : vessels_of(scene))
        for (const OwnWall& wall : own_walls(vessel, scene.space))
          ours = std::min(ours, wall.distance(point_in_vessel(vessel, vessel_pose(vessel, time), at)));
      if (std::abs(theirs - ours) < 1e-9) continue;
      std::ostringstream out;
      out << "at " << time << " s the nearest wall to " << at.transpose() << " is " << theirs << " m away, not "
          << ours;
      return out.str();
    }
  }
  return "";
}

TEST(DrawnScene, HasTheWallsThatItDescribes) {
  expect_of_drawn_scenes(60, not_the_walls_described);
}

/// Between two equal rows of a table, further apart than those beside them, a vessel holds still.
std::string drifts_while_it_holds(const DrawnScene& drawn) {
  const std::optional<Scene> scene = scene_of(drawn);
  if (!scene) return "";
  for (const Vessel& vessel : vessels_of(*scene)) {
    const auto* table = vessel.motion ? std::get_if<TableMotion>(&*vessel.motion) : nullptr;
    if (table == nullptr) continue;
    const std::vector<double>& times = table->times;
    const VesselPath path(vessel);
    for (std::size_t k = 1; k + 2 < times.size(); ++k) {
      const double length = times[k + 1] - times[k];
      if (length < 2 * (times[k] - times[k - 1]) || length < 2 * (times[k + 2] - times[k + 1])) continue;
      const Pose at_first = path.pose(times[k]);
      for (int part = 1; part <= 20; ++part) {
        const Pose now = path.pose(times[k] + part * length / 20);
        const double moved = (now.displacement - at_first.displacement).norm() + std::abs(now.across - at_first.across);
        const double turned = std::abs(now.angle - at_first.angle);
        if (moved <= 1e-12 * vessel.length && turned <= 1e-12) continue;
        return fmt::format("the {} drifts by {} m and {} rad from {} s on, where its table holds", vessel.name, moved,
                           turned, times[k]);
      }
    }
  }
  return "";
}

TEST(DrawnScene, HoldsStillWhereItsTableDoes) {
  expect_of_drawn_scenes(100, drifts_while_it_holds);
}

bool turns_by_table(const Vessel& vessel) {
  const TableMotion* table = vessel.motion ? std::get_if<TableMotion>(&*vessel.motion) : nullptr;
  return table != nullptr && std::ranges::any_of(table->angle, [](double angle) { return angle != 0; });
}

/// From all walls to a place, by length.
std::vector<double> distances(const Walls& walls, const Eigen::Vector3d& at) {
  std::vector<double> all;
  for (std::size_t k = 0; k < walls.count(); ++k) all.push_back(std::sqrt(walls.distance2(k, at)));
  std::ranges::sort(all);
  return all;
}

std::string walls_not_mirrored(const DrawnScene& drawn) {
  Scene scene;
  if (!refusal([&] { scene = drawn.read(); }).empty()) return "";
  Walls walls(vessels_of(scene), scene.space), others(vessels_of(mirrored(scene)), scene.space);
  if (walls.count() != others.count()) return "the mirrored scene has another number of walls";
  for (const double time : {0.0, 0.01, 0.03}) {  // times of the tables
    walls.place(time), others.place(time);
    for (const Eigen::Vector3d& at : places_around(scene)) {
      const std::vector<double> here = distances(walls, at), there = distances(others, {-at.x(), at.y(), at.z()});
      for (std::size_t k = 0; k < here.size(); ++k)
        if (!(std::abs(here[k] - there[k]) < 1e-9)) {
          std::ostringstream out;
          out << "a wall " << here[k] << " m from " << at.transpose() << " at " << time << " s is " << there[k]
              << " m away in the mirrored scene";
          return out.str();
        }
    }
  }
  return "";
}

TEST(DrawnScene, HasMirroredWallsInItsMirrorImage) {
  expect_of_drawn_scenes(60, walls_not_mirrored);
}

/// The scene with nothing but the seeds that it is given, and the step of `model`.
Scene left_alone(const Model& model) {
  Scene scene = model.scene;
  scene.numerics.dt = model.step.dt, scene.numerics.allow_long_step = true;
  for (Vessel* vessel : {&scene.tray, scene.hopper ? &*scene.hopper : nullptr})
    if (vessel != nullptr) {
      vessel->rain.reset();
      if (vessel->fill) vessel->fill->keep = false;
    }
  return scene;
}

/// Poured seeds touch or do not by a rounding error: now by more than that.
void stir(Grains& grains) {
  Random random(3);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double by = 1e-3 * grains.kind(i).radius;
    grains.x[i] += random.uniform(-by, by), grains.y[i] += random.uniform(-by, by);
    if (grains.is_3d) grains.z[i] += random.uniform(-by, by);
    grains.vx[i] += random.uniform(-0.1, 0.1), grains.vy[i] += random.uniform(-0.1, 0.1);
  }
}

/// How two runs of the same seeds come apart within some steps, the second's x being `side` times the first's; empty:
/// they do not.
std::string come_apart(const Model& first, const Grains& here, const Model& second, const Grains& there, double side) {
  Simulation run(first, starting_state(first, 1, here)), other(second, starting_state(second, 1, there));
  for (int step = 0; step < 60; ++step) run.step(), other.step();
  if (run.grains().size() != other.grains().size()) return "another number of seeds is left";
  for (std::size_t i = 0; i < run.grains().size(); ++i) {
    const Eigen::Vector3d at = place_of(run.grains(), i), beside = place_of(other.grains(), i);
    const double apart = (Eigen::Vector3d(side * beside.x(), beside.y(), beside.z()) - at).norm();
    if (apart < 1e-6 * run.grains().kind(i).radius) continue;
    std::ostringstream out;
    out << "seed " << i << " at " << at.transpose() << " is " << apart / run.grains().kind(i).radius
        << " radii from where it is to be";
    return out.str();
  }
  return "";
}

std::string steps_not_mirrored(const DrawnScene& drawn) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start) return "";
  const Scene scene = left_alone(start->model), other = mirrored(scene);
  for (const Vessel& vessel : vessels_of(scene))
    if (turns_by_table(vessel)) return "";
  const Model model = prepare(scene), mirror = prepare(other);
  stir(start->state.grains);
  const Grains image = mirrored(start->state.grains, no_grains(mirror));
  return come_apart(model, start->state.grains, mirror, image, -1);
}

TEST(DrawnScene, StepsMirroredInItsMirrorImage) {
  expect_of_drawn_scenes(30, steps_not_mirrored);
}

// ---- maps ----

/// What discs (balls) fill from the floor line up to `top`, m2 (m3), of those that lie in a part; a clump's balls may
/// lie beyond the seam that its centre is before.
double filled_up_to(double top, const Snapshot& own, const Scene& scene, const MapPart& part) {
  const std::vector<SeedLot>& lots = scene.lots;
  const bool closes = scene.tray.front_and_back == Sides::periodic;
  constexpr double far = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const CoveringDisc& disc : covering_discs(own, lots)) {
    const double low = -disc.y, high = top - disc.y, r = disc.radius;
    if (!own.is_3d())
      sum += disc.fraction * disc_in_rectangle(r, {-2 * r, low}, {2 * r, high});
    else if (const double z = closes ? within_period(disc.z, *scene.tray.depth) : disc.z;
             z >= part.front && z <= part.back)
      sum += disc.fraction * ball_in_box(r, {-far, low, -far}, {far, high, far});
  }
  return sum;
}

/// The map of a tray without ends has all its seeds once, also those at the seam.
std::string map_loses_seeds(const DrawnScene& drawn) {
  std::optional<RunStart> start = start_of(drawn);
  if (!start || start->model.scene.tray.sides != Sides::periodic) return "";
  constexpr double at = 0.02;  // s
  Scene scene = start->model.scene;
  scene.record = Record{{at}, scene.tray.length / 8};
  const Model model = prepare(scene);
  Simulation run(model, starting_state(model, 1));
  run.run_until(1.5 * at);
  const vibrosow::Run result = run.result();
  if (result.snapshots.empty() || result.outside_the_model) return "";
  const Snapshot own = in_tray_frame(result.snapshots.front(), scene.tray);
  MeanMapSum sum(scene);
  sum.add(own);
  const MeanMap map = sum.mean();
  const MapPart part = map_part(scene);
  const double cell = map.grid.cell * map.grid.cell * (own.is_3d() ? part.depth() : 1);
  const double mapped = cell * std::accumulate(map.packing.begin(), map.packing.end(), 0.0);
  const double top = map.grid.cell * static_cast<double>(cells_over(scene.tray.height, map.grid.cell));
  const double filled = filled_up_to(top, own, scene, part);
  return std::abs(mapped - filled) <= 1e-9 * filled
             ? ""
             : fmt::format("its map has {} of what the seeds in it fill, {}", mapped, filled);
}

TEST(DrawnScene, HasAllSeedsInTheMapOfAPeriodicTray) {
  expect_of_drawn_scenes(60, map_loses_seeds);
}

/// The tray with a part of its floor and of its right wall drawn once more.
Vessel drawn_twice(Vessel tray) {
  const double floor = tray.holes.empty() ? tray.length : tray.holes.front().centre - tray.holes.front().width / 2;
  if (tray.funnel == 0 && floor > 0) tray.pieces.push_back({.a = {0, 0}, .b = {0.7 * floor, 0}});
  if (tray.sides == Sides::walls)
    tray.pieces.push_back({.a = {tray.length, 0.1 * tray.height}, .b = {tray.length, tray.height}});
  return tray;
}

std::string pushes_twice(const DrawnScene& drawn) {
  const std::optional<RunStart> start = start_of(drawn);
  if (!start) return "";
  const Scene once = left_alone(start->model);
  const bool round = once.space != Space::two_dimensional && once.tray.plan == Plan::round;
  if (!once.tray.box || round) return "";
  Scene twice = once;
  twice.tray = drawn_twice(once.tray);
  Grains grains = start->state.grains;
  stir(grains);
  return come_apart(prepare(once), grains, prepare(twice), grains, 1);
}

TEST(DrawnScene, IsNoOtherWithItsWallsDrawnTwice) {
  expect_of_drawn_scenes(30, pushes_twice);
}

// ---- the scenes themselves ----

TEST(DrawnScene, HasEveryFeatureAndIsMostlyTaken) {
  std::set<std::string> drawn;
  int taken = 0;
  constexpr int looked_at = 400, begun = 40;
  for (std::uint64_t number = 1; number <= looked_at; ++number) {
    const DrawnScene scene(number);
    for (const auto& [key, value] : scene.keys()) drawn.insert(key), drawn.insert(key + " = " + value);
    for (const auto& [file, text] : scene.texts()) drawn.insert(file);
    if (number <= begun && start_of(scene)) ++taken;
  }
  for (const char* feature : {"space = \"3d\"",
                              "seeds.a.shape = \"disc\"",
                              "seeds.a.shape = \"elongated\"",
                              "seeds.a.shape = \"drop\"",
                              "seeds.a.shape = \"dipole\"",
                              "seeds.a.shape = \"discs\"",
                              "seeds.a.thickness",
                              "seeds.a.sizes",
                              "seeds.c.mass_fraction",
                              "seeds.c.number_fraction",
                              "contact.law = \"hertz\"",
                              "contact.damping_rate",
                              "contact.friction_model = \"spring\"",
                              "contact.rolling = \"spring\"",
                              "contact.rolling = \"constant-torque\"",
                              "contact.cohesion",
                              "contact.drag",
                              "contact.rotation = false",
                              "contact.a.wall.friction",
                              "contact.a.b.friction",
                              "contact.model = \"crop\"",
                              "seeds.a.contact = \"a-contact.toml\"",
                              "seeds.c.contact = \"c-contact.toml\"",
                              "tray.fill.packing = \"layers\"",
                              "tray.fill.packing = \"hexagonal\"",
                              "tray.fill.keep",
                              "hopper.fill.keep",
                              "tray.rain.rate",
                              "hopper.rain.rate",
                              "tray.funnel",
                              "hopper.funnel",
                              "tray.plan = \"round\"",
                              "hopper.plan = \"round\"",
                              "tray.pieces",
                              "hopper.pieces",
                              "/drawn/tray.piece.svg",
                              "/drawn/tray.piece.dxf",
                              "tray.box = false",
                              "tray.tilt",
                              "hopper.tilt",
                              "tray.sides = \"open\"",
                              "tray.sides = \"periodic\"",
                              "tray.front_and_back = \"periodic\"",
                              "tray.holes.open_at",
                              "hopper.holes.open_at",
                              "tray.holes.shape = \"round\"",
                              "tray.holes.rows",
                              "tray.holes.thickness",
                              "tray.holes.chamfer",
                              "tray.holes.across",
                              "tray.motion.kind = \"harmonic\"",
                              "tray.motion.kind = \"sum\"",
                              "tray.motion.kind = \"rocking\"",
                              "tray.motion.kind = \"turning\"",
                              "tray.motion.kind = \"table\"",
                              "tray.motion.axis = \"upright\"",
                              "tray.motion.ramp",
                              "tray.motion.stop",
                              "tray.motion.stop_ramp",
                              "tray.rain.start",
                              "tray.rain.stop",
                              "run.measure_from",
                              "hopper.motion.kind = \"harmonic\"",
                              "numerics.integrator = \"gear5\"",
                              "numerics.integrator = \"rk2-midpoint\"",
                              "record.every",
                              "drill.speed",
                              "run.start = \"with-tray\""})
    EXPECT_TRUE(drawn.contains(feature)) << feature;
  EXPECT_GT(taken, begun / 2);
}

}  // namespace
}  // namespace vibrosow
