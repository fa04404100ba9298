// Where seeds are put in, by every way there is: clear of everything, and where seeds can come to from the vessel's
// top.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "grains/turned_discs.hpp"
#include "scene/input_error.hpp"
#include "simulation/feeder.hpp"
#include "simulation/seed_places.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "support/solid_lots.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

constexpr double diameter = 4e-3;  // m

/// What must hold of a seed's ball besides: its centre in the frame of vessel `vessel` (m).
using Where = std::function<bool(const Eigen::Vector3d& own)>;

std::vector<ClumpDisc> balls_of(const Simulation& run, std::size_t i) {
  const Grains& g = run.grains();
  const SeedLot& lot = run.model().scene.lots[static_cast<std::size_t>(g.lot[i])];
  Turn turn;
  if (g.oriented && g.is_3d) turn.orientation = g.orientation(i);
  if (g.oriented && !g.is_3d) turn.angle = g.angle[i];
  return turned_discs(lot, 2 * g.kind(i).radius / lot.diameter, turn);
}

Eigen::Vector3d centre_of(const Simulation& run, std::size_t i, const ClumpDisc& ball) {
  return place_of(run.grains(), i) + Eigen::Vector3d(ball.x, ball.y, ball.z);
}

/// Seed `i` touches nothing but what it lies on, and every ball of it is where `where` says, in the frame of a vessel.
void expect_clear(const Simulation& run, std::size_t i, std::size_t vessel, const Where& where) {
  constexpr double slack = 1e-9;  // of the radius
  const Walls& walls = run.field().walls();
  for (const ClumpDisc& ball : balls_of(run, i)) {
    const Eigen::Vector3d at = centre_of(run, i, ball);
    for (std::size_t wall = 0; wall < walls.count(); ++wall) {
      if (walls.is_removed(wall)) continue;
      ASSERT_GT(std::sqrt(walls.distance2(wall, at)), ball.radius * (1 - slack)) << "wall " << wall << ", seed " << i;
    }
    for (std::size_t j = 0; j < run.grains().size(); ++j)
      for (const ClumpDisc& other : j == i ? std::vector<ClumpDisc>{} : balls_of(run, j))
        ASSERT_GT((centre_of(run, j, other) - at).norm(), ball.radius + other.radius - slack * ball.radius)
            << "seeds " << i << " and " << j;
    const Eigen::Vector3d own = point_in_vessel(walls.vessels()[vessel], walls.poses()[vessel], at);
    ASSERT_TRUE(where(own)) << "seed " << i << " at " << own.transpose() << ", " << run.time() << " s";
  }
}

/// Runs a scene to its end; every seed is looked at when it is seen first. How many there were.
std::size_t expect_all_clear(const Scene& scene, std::size_t vessel, const Where& where) {
  Simulation run(prepare(scene), 1);
  std::size_t seen = 0;
  std::int64_t last = -1;
  const auto look = [&] {
    const Grains& g = run.grains();
    for (std::size_t i = 0; i < g.size(); ++i)
      if (g.id[i] > last) expect_clear(run, i, vessel, where), ++seen, last = g.id[i];
  };
  look();
  while (!run.at_end() && !testing::Test::HasFatalFailure()) {
    const std::int64_t next = run.grains().next_id;
    if (!run.step()) break;
    if (run.grains().next_id != next) look();
  }
  EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_EQ(run.result().balance.lost, 0);
  return seen;
}

Scene soft(Space space) {
  Scene scene;
  scene.space = space;
  scene.lots = {{"a", diameter, 4e-5, Shape::ball, 1}};
  scene.contact.shell_compression = 2e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.3};
  scene.contact.slip_speed = 0.1;
  Vessel& tray = scene.tray;
  tray.name = "tray";
  tray.length = 0.08, tray.height = 0.06;
  if (space == Space::three_dimensional) tray.depth = 0.02;
  scene.run.duration = 0.25;
  return scene;
}

Vessel hopper_over(const Scene& scene) {
  Vessel hopper;
  hopper.name = "hopper";
  hopper.origin = {0.01, 0.03};
  hopper.length = 0.06, hopper.height = 0.08;
  hopper.depth = scene.tray.depth;
  const double depth = hopper.depth.value_or(0);
  hopper.holes = {{.centre = 0.03, .width = 0.014, .across = depth / 2, .across_length = depth}};
  hopper.funnel = 0.7;
  hopper.fill = Fill{scene.space == Space::two_dimensional ? 60 : 200, Packing::poured, 1e-3, true};
  return hopper;
}

/// Over the slopes of that hopper, which fall to the outlet's edges at y = 0.
bool is_over_slopes(const Eigen::Vector3d& own) {
  const double beside = std::max(0.0, std::abs(own.x() - 0.03) - 0.007);
  return own.y() > beside * std::tan(0.7);
}

class Insertion : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Spaces, Insertion, testing::ValuesIn(both_spaces), named_by_space);

/// A kept hopper that dips into its tray, on whose floor seeds lie beneath the slopes, in the hopper's box.
Scene dipping(Space space) {
  Scene scene = soft(space);
  scene.hopper = hopper_over(scene);
  scene.hopper->fill->count = 12;
  return scene;
}
Eigen::Vector3d of_dipping(double own_x, double own_y) {
  return {0.01 + own_x, 0.03 + own_y, 0.01};
}

TEST_P(Insertion, ASeedCountsWhereItLies) {
  const Simulation run(prepare(dipping(GetParam())), 1);
  const SeedPlaces places(run.model());
  const auto counts = [&](const Eigen::Vector3d& at) {
    return std::pair(places.counts_in(at, 0, run.field().walls()), places.counts_in(at, 1, run.field().walls()));
  };
  EXPECT_EQ(counts(of_dipping(0.03, 0.02)), std::pair(false, true)) << "over the slopes, though in the tray's box";
  EXPECT_EQ(counts(of_dipping(0.005, 0.005)), std::pair(true, false)) << "beneath them, though in the hopper's box";
}

TEST_P(Insertion, AKeptHopperIsNotFullOfSeedsBeneathItsSlopes) {
  const Model model = prepare(dipping(GetParam()));
  Grains grains = no_grains(model);
  for (int k = 0; k < 3; ++k)
    grains.add(of_dipping(0.003 + 0.0045 * k, 0.002), Eigen::Vector3d::Zero(), 0, grains.kinds[0], {});
  const Simulation run(model, starting_state(model, 1, grains));
  FeederState state = run.state().feeder;
  Feeder feeder(run.model(), state);
  EXPECT_EQ(feeder.top_up(grains, {0, 0, 0}, run.field().walls(), 0), 12);
  EXPECT_FALSE(feeder.fault()) << *feeder.fault();
}

/// The tray's own seeds run out, and only a closed hopper that dips into it holds any.
TEST_P(Insertion, ATrayIsEmptyThoughAHopperInItIsFull) {
  Scene scene = dipping(GetParam());
  scene.hopper->holes.clear(), scene.hopper->funnel = 0, scene.hopper->fill->keep = false;
  scene.run.duration = 0.05;
  Simulation run(prepare(scene), 1);
  while (!run.at_end()) run.step();
  EXPECT_EQ(run.result().balance.inside, 12);
  EXPECT_EQ(run.result().tray_at_end, 0);
  EXPECT_GE(run.result().tray_empty_since, 0);
}

TEST_P(Insertion, AKeptHopperWithAFunnelIsFedAboveItsSlopes) {
  Scene scene = soft(GetParam());
  scene.tray.holes = {{.centre = 0.04, .width = 0.03, .across = 0.01, .across_length = 0.02}};
  scene.hopper = hopper_over(scene);
  const std::size_t seen = expect_all_clear(scene, 1, is_over_slopes);
  EXPECT_GT(seen, static_cast<std::size_t>(scene.hopper->fill->count + 10)) << "it was fed";
}

TEST(Insertion, AKeptConeIsFedWithinIt) {
  Scene scene = soft(Space::three_dimensional);
  scene.tray.depth = 0.08;
  scene.tray.holes = {{.centre = 0.04, .width = 0.03, .across = 0.04, .across_length = 0.03}};
  Vessel hopper = hopper_over(scene);
  hopper.plan = Plan::round;
  hopper.length = 0.04, hopper.depth = 0.04, hopper.front = 0.02;
  hopper.origin.x() = 0.02;
  hopper.holes = {{.centre = 0.02, .width = 0.014, .shape = HoleShape::round, .across = 0.02}};
  hopper.fill->count = 150;
  scene.hopper = hopper;
  const std::size_t seen = expect_all_clear(scene, 1, [](const Eigen::Vector3d& own) {
    const double aside = std::hypot(own.x() - 0.02, own.z() - 0.02);
    return aside < 0.02 && own.y() > std::max(0.0, aside - 0.007) * std::tan(0.7);
  });
  EXPECT_GT(seen, 155u);
}

/// A shelf over a part of the floor, and a floor that slopes, drawn as pieces.
TEST_P(Insertion, AKeptTrayWithPiecesIsFedClearOfThem) {
  for (const bool slope : {false, true}) {
    Scene scene = soft(GetParam());
    scene.tray.holes = {{.centre = 0.07, .width = 0.014, .across = 0.01, .across_length = 0.02}};
    if (slope)
      scene.tray.pieces = {{.a = {0, 0.03}, .b = {0.063, 0}}};
    else
      scene.tray.pieces = {{.a = {0.01, 0.02}, .b = {0.05, 0.02}}};
    scene.tray.fill = Fill{GetParam() == Space::two_dimensional ? 70 : 250, Packing::poured, 1e-3, true};
    const Where where = [&](const Eigen::Vector3d& own) {
      return !slope || own.x() > 0.063 || own.y() > 0.03 * (1 - own.x() / 0.063);
    };
    EXPECT_GT(expect_all_clear(scene, 0, where), static_cast<std::size_t>(scene.tray.fill->count)) << slope;
  }
}

/// An arc, and in 3D a cylinder, over the floor.
TEST_P(Insertion, AKeptTrayIsFedOutsideOfWhatIsClosed) {
  Scene scene = soft(GetParam());
  scene.tray.holes = {{.centre = 0.07, .width = 0.014, .across = 0.01, .across_length = 0.02}};
  scene.tray.pieces = {{.centre = {0.03, 0.02}, .radius = 0.015, .from = 0, .to = 2 * std::numbers::pi}};
  scene.tray.fill = Fill{GetParam() == Space::two_dimensional ? 60 : 220, Packing::poured, 1e-3, true};
  const auto outside = [](const Eigen::Vector3d& own) { return std::hypot(own.x() - 0.03, own.y() - 0.02) > 0.015; };
  EXPECT_GT(expect_all_clear(scene, 0, outside), static_cast<std::size_t>(scene.tray.fill->count));
}

TEST_P(Insertion, AKeptTrayIsFedBesideAHopperThatDipsIntoIt) {
  Scene scene = soft(GetParam());
  scene.tray.holes = {{.centre = 0.07, .width = 0.014, .across = 0.01, .across_length = 0.02}};
  scene.tray.fill = Fill{GetParam() == Space::two_dimensional ? 70 : 250, Packing::poured, 1e-3, true};
  scene.tray.motion = HarmonicMotion{0, 4e-3, 12, 0};
  Vessel hopper = hopper_over(scene);
  hopper.origin = {0.02, 0.03}, hopper.length = 0.03;
  hopper.holes.clear(), hopper.funnel = 0, hopper.fill.reset();
  scene.hopper = hopper;
  const Where beside = [](const Eigen::Vector3d&) { return true; };
  EXPECT_GT(expect_all_clear(scene, 0, beside), static_cast<std::size_t>(scene.tray.fill->count));
  Simulation run(prepare(scene), 1);
  std::int64_t last = run.grains().next_id - 1;
  while (run.step()) {
    const Grains& g = run.grains();
    for (std::size_t i = 0; i < g.size(); ++i)
      if (g.id[i] > last) {
        last = g.id[i];
        EXPECT_FALSE(g.x[i] > 0.02 && g.x[i] < 0.05 && g.y[i] > 0.03) << "in the hopper";
      }
    if (run.at_end()) break;
  }
}

/// Where it leaves a gap that seeds pass they lie beneath it too, otherwise they wait.
TEST_P(Insertion, AKeptTrayIsNotFedBeneathAHopperThatShutsIt) {
  for (const double gap : {0.003, 0.006}) {
    Scene scene = soft(GetParam());
    scene.tray.rain = Rain{400, 0, 0.08, 0.01};
    Vessel hopper = hopper_over(scene);
    hopper.origin = {gap, 0.02}, hopper.length = 0.08 - 2 * gap;
    hopper.fill.reset();
    scene.hopper = hopper;
    scene.run.duration = 0.1;
    const vibrosow::Run run = simulate(scene);
    if (gap > diameter) {
      EXPECT_GT(run.balance.put_in, 20) << gap;
    } else {
      EXPECT_EQ(run.balance.put_in, 0) << gap;
      ASSERT_FALSE(run.warnings.empty());
      EXPECT_EQ(run.warnings.back().kind, DoubtKind::feeder_behind);
    }
  }
}

TEST_P(Insertion, RowsLieOverAFunnelAndOverDrawnSlopes) {
  for (const Packing packing : {Packing::layers, Packing::hexagonal})
    for (const bool drawn : {false, true}) {
      Scene scene = soft(GetParam());
      scene.run.duration = 1e-3;
      Vessel hopper = hopper_over(scene);
      hopper.holes[0].width = 0.003;
      hopper.fill = Fill{GetParam() == Space::two_dimensional ? 40 : 100, packing, 1e-3, false};
      if (drawn) {
        hopper.funnel = 0;
        hopper.pieces = {{.a = {0, 0.025}, .b = {0.0285, 0.001}}, {.a = {0.06, 0.025}, .b = {0.0315, 0.001}}};
      }
      scene.hopper = hopper;
      const Where over = [&](const Eigen::Vector3d& own) {
        const double beside = std::max(0.0, std::abs(own.x() - 0.03) - 0.0015);
        return own.y() > beside * (drawn ? 0.024 / 0.0285 : std::tan(0.7));
      };
      EXPECT_EQ(expect_all_clear(scene, 1, over), static_cast<std::size_t>(hopper.fill->count)) << drawn;
    }
}

SeedLot grains_for(Space space) {
  if (space == Space::three_dimensional) return wheat_grains();
  SeedLot lot{"a", 0, 4e-5, Shape::clump, 1};
  make_clump(lot, elongated(7e-3, 3e-3), Space::two_dimensional);
  return lot;
}

/// A table holds its vessel where it stands first.
VesselMotion standing_at(double angle) {
  return TableMotion{{0, 1, 2, 3}, {0, 0, 0, 0}, {0, 0, 0, 0}, {angle, angle, angle, angle}, {}};
}

TEST_P(Insertion, ClumpsPouredIntoATurnedVesselTurnWithIt) {
  const auto pour = [](Scene scene) {
    scene.lots = {grains_for(scene.space)};
    scene.tray.fill = Fill{scene.space == Space::two_dimensional ? 60 : 150, Packing::poured, 1e-3, false};
    scene.run.duration = 1e-3;
    EXPECT_EQ(expect_all_clear(scene, 0, [](const Eigen::Vector3d&) { return true; }),
              static_cast<std::size_t>(scene.tray.fill->count));
  };
  for (const double tilt : {-0.4, 0.009, 0.09, 0.4}) {
    Scene scene = soft(GetParam());
    scene.tray.tilt = tilt;
    pour(scene);
    scene.tray.motion = standing_at(0.3);
    pour(scene);
  }
  if (GetParam() == Space::two_dimensional) return;
  Scene scene = soft(GetParam());
  scene.tray.motion =
      TurningMotion{.pivot = {0.04, 0.01}, .angular_velocity = 1, .axis = TurningAxis::upright, .phase = 1};
  scene.tray.tilt = 0.2;
  pour(scene);
}

TEST_P(Insertion, RainUnderASlopeWaitsAndTheRunSaysSo) {
  Scene scene = soft(GetParam());
  scene.tray.pieces = {{.a = {0, 0.05}, .b = {0.08, 0.03}}};
  scene.tray.rain = Rain{200, 0, 0.08, 0.01};
  scene.run.duration = 0.1;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.balance.put_in, 0);
  ASSERT_EQ(run.warnings.size(), 1u);
  EXPECT_EQ(run.warnings[0].kind, DoubtKind::feeder_behind);
  EXPECT_THAT(run.warnings[0].text, testing::StartsWith("tray.rain falls behind: 20 of 20 seeds still wait at 0.1"));
}

TEST_P(Insertion, RainBesideAShelfComesUnderItToo) {
  Scene scene = soft(GetParam());
  scene.tray.pieces = {{.a = {0.0, 0.03}, .b = {0.05, 0.03}}};
  scene.tray.rain = Rain{100, 0, 0.04, 0.02};
  scene.run.duration = 0.2;
  EXPECT_GT(expect_all_clear(scene, 0, [](const Eigen::Vector3d& own) { return own.y() < 0.03; }), 15u);
}

/// Two shelves with a slit of 3 mm, and seeds of two sizes: the small ones alone are put beneath.
TEST_P(Insertion, OnlySmallSeedsArePutBehindASlitThatLargeOnesDoNotPass) {
  int small_ones = 0;
  for (const bool of_one_lot : {false, true})
    for (const bool rains : {false, true}) {
      Scene scene = soft(GetParam());
      scene.lots[0].number_fraction = 0.5;
      scene.lots.push_back(scene.lots[0]);
      scene.lots[1].name = "b", scene.lots[1].diameter = 2e-3, scene.lots[1].mass = 5e-6;
      if (of_one_lot) {
        scene.lots.pop_back();
        scene.lots[0].number_fraction = 1;
        scene.lots[0].diameter = 3e-3;
        SizeDistribution& sizes = scene.lots[0].sizes;
        sizes.kind = SizeDistribution::Kind::uniform;
        sizes.least = 2e-3, sizes.most = 4e-3;
      }
      scene.tray.pieces = {{.a = {0, 0.03}, .b = {0.0385, 0.03}}, {.a = {0.0415, 0.03}, .b = {0.08, 0.03}}};
      scene.run.duration = 0.1;
      if (rains)
        scene.tray.rain = Rain{400, 0, 0.08, 0.015};
      else
        scene.tray.fill = Fill{GetParam() == Space::two_dimensional ? 40 : 200, Packing::poured, 1e-3, true};
      Model model = prepare(scene);
      if (!rains) model.vessels[0].fill->count *= 2, model.scene.tray.fill->count *= 2;
      Simulation run(model, starting_state(model, 1, starting_state(prepare(scene), 1).grains));
      const std::int64_t put = run.grains().next_id;
      std::int64_t last = put - 1;
      while (!run.at_end() && run.step()) {
        const Grains& g = run.grains();
        for (std::size_t i = 0; i < g.size(); ++i) {
          if (g.id[i] <= last) continue;
          last = g.id[i];
          if (g.y[i] > 0.03) continue;
          EXPECT_LT(g.kind(i).radius, 1.5e-3 * 1.25) << "grain " << g.id[i];
          ++small_ones;
        }
      }
      EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
    }
  EXPECT_GT(small_ones, 2);
}

/// A seed is put in by its centre; the thickest ball of a clump may then hang over an open edge.
TEST_P(Insertion, ClumpsThatRainAtAnOpenEdgeMayHangOverIt) {
  Scene scene = soft(GetParam());
  SeedLot drop{"drop", 0, 4e-5, Shape::clump, 1};
  make_clump(drop, {{0, 0, 1.5e-3}, {2.5e-3, 0, 1e-3}}, scene.space);
  scene.lots = {drop};
  scene.tray.sides = scene.tray.front_and_back = Sides::open;
  scene.tray.rain = Rain{400, 0, 0.08, 0.05};
  bool hung_over = false;
  const auto look = [&](const Eigen::Vector3d& own) {
    hung_over |= own.x() < 0 || own.x() > 0.08 || own.z() < 0 || own.z() > 0.02;
    return own.y() > 0;
  };
  EXPECT_GT(expect_all_clear(scene, 0, look), 50u);
  EXPECT_TRUE(hung_over);
}

/// Between two drawn slopes is a gap; under their ends no seed passes that stays in the vessel.
TEST_P(Insertion, AKeptVesselWithoutABoxIsNotFedBeneathItsSlopes) {
  Scene scene = soft(GetParam());
  scene.lots[0].diameter = 2e-3;
  Vessel& tray = scene.tray;
  tray.box = false;
  tray.length = 0.06;
  tray.pieces = {{.a = {0, 0.04}, .b = {0, 0.02}},
                 {.a = {0, 0.02}, .b = {0.022, 0.001}},
                 {.a = {0.038, 0.001}, .b = {0.06, 0.02}},
                 {.a = {0.06, 0.02}, .b = {0.06, 0.04}}};
  tray.fill = Fill{GetParam() == Space::two_dimensional ? 60 : 200, Packing::poured, 1e-3, true};
  scene.run.duration = 0.1;
  const auto is_over_slopes_or_gap = [](const Eigen::Vector3d& own) {
    const double beside = std::max(0.0, std::abs(own.x() - 0.03) - 0.008);
    return own.y() > beside * 0.019 / 0.022;
  };
  EXPECT_GT(expect_all_clear(scene, 0, is_over_slopes_or_gap), 80u);
}

TEST_P(Insertion, ADrumIsKeptFullWithinItsCircle) {
  Scene scene = soft(GetParam());
  Vessel& drum = scene.tray;
  drum.length = drum.height = 0.06;
  drum.box = false;
  drum.pieces = {{.centre = {0.03, 0.03}, .radius = 0.03, .from = 0, .to = 2 * std::numbers::pi}};
  drum.motion = TurningMotion{.pivot = {0.03, 0.03}, .angular_velocity = 10, .phase = 2};
  drum.fill = Fill{GetParam() == Space::two_dimensional ? 60 : 200, Packing::poured, 1e-3, false};
  drum.rain = Rain{100, 0.01, 0.05, 0.045};
  const auto inside = [](const Eigen::Vector3d& own) { return std::hypot(own.x() - 0.03, own.y() - 0.03) < 0.03; };
  const std::size_t poured = static_cast<std::size_t>(drum.fill->count);
  EXPECT_GT(expect_all_clear(scene, 0, inside), poured + 10);
  drum.rain.reset();
  drum.fill->keep = true;
  Model model = prepare(scene);
  model.vessels[0].fill->count += 20;  // as if so many had got out
  model.scene.tray.fill->count += 20;
  Grains packed = starting_state(prepare(scene), 1).grains;
  Simulation run(model, starting_state(model, 1, std::move(packed)));
  run.steps(20000);
  EXPECT_EQ(run.grains().size(), poured + 20);
  EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
}

TEST_P(Insertion, FillsInEachOthersWayAreRefused) {
  Scene scene = soft(GetParam());
  scene.tray.fill = Fill{GetParam() == Space::two_dimensional ? 100 : 500, Packing::poured, 1e-3, false};
  scene.hopper = hopper_over(scene);
  scene.hopper->origin.y() = 0.01;
  EXPECT_THROW(starting_state(prepare(scene), 1), InputError);
}

/// What the look at a seed that was put in finds, of one beneath a funnel, in the wall, in another, and rightly placed.
TEST_P(Insertion, ALookAtASeedFindsWhatIsWrong) {
  Scene scene = soft(GetParam());
  const double middle = scene.tray.depth.value_or(0) / 2;
  scene.tray.holes = {{.centre = 0.04, .width = 0.01, .across = middle, .across_length = 2 * middle}};
  scene.tray.funnel = 0.7;
  const Model model = prepare(scene);
  const SeedPlaces places(model);
  const Walls walls(model.vessels, scene.space);
  Grains grains = no_grains(model);
  const auto fault_at = [&](double x, double y) {
    grains.add(Eigen::Vector3d(x, y, middle), Eigen::Vector3d::Zero(), 0, grains.kinds.front());
    return places.fault(grains, grains.size() - 1, 0, walls).value_or("none");
  };
  EXPECT_EQ(fault_at(0.04, 0.04), "none");
  EXPECT_EQ(fault_at(0.044, 0.04), "none") << "just touching";
  EXPECT_EQ(fault_at(0.0438, 0.0441), "none");
  EXPECT_THAT(fault_at(0.0407, 0.0365), testing::StartsWith("lies 0."));
  EXPECT_THAT(fault_at(0.0005, 0.05), testing::MatchesRegex("lies 0.75 of its radius deep in a wall"));
  EXPECT_THAT(fault_at(0.01, 0.005), testing::StartsWith("lies where no seed comes to from the top of the tray"));
}

/// A model whose walls do not stand where its fill was put: the run stops before its first step, and says why.
TEST_P(Insertion, AWrongPlaceIsToldFromALongStep) {
  Scene scene = soft(GetParam());
  const double depth = scene.tray.depth.value_or(0);
  Model model = prepare(scene);
  Grains grains = no_grains(model);
  const GrainKind kind = grains.kinds.front();
  for (const double x : {0.04, 0.0412})
    grains.add(Eigen::Vector3d(x, 0.01, depth / 2), Eigen::Vector3d::Zero(), 0, kind);
  Simulation run(model, starting_state(model, 1, std::move(grains)));
  EXPECT_FALSE(run.step());
  ASSERT_TRUE(run.guard().stop_reason());
  EXPECT_THAT(*run.guard().stop_reason(), testing::HasSubstr("before the first step"));
  EXPECT_THAT(*run.guard().stop_reason(), testing::Not(testing::HasSubstr("numerics.dt")));
}

/// No input is known to put a seed wrongly, so the seeds are made larger than what their places were sought for.
TEST_P(Insertion, AWrongPlaceInARunStopsIt) {
  Scene scene = soft(GetParam());
  scene.tray.fill = Fill{200, Packing::poured, 1e-3, true};
  Model model = prepare(scene);
  model.kinds.front().radius *= 1.1;
  Simulation run(model, starting_state(model, 1, no_grains(model)));
  for (int step = 0; step < 2000 && run.step();) ++step;
  ASSERT_TRUE(run.guard().stop_reason());
  EXPECT_THAT(*run.guard().stop_reason(), testing::HasSubstr("was put in wrongly"));
  EXPECT_THAT(*run.guard().stop_reason(), testing::HasSubstr("not of the step"));
}

}  // namespace
}  // namespace vibrosow
