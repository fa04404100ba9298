// What must hold in any scene, on random ones in 2D and in 3D: energy, momenta, numbers and masses are
// accounted for, lists miss nothing up to the last of their margins, and neither a period nor the lab's axes show.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "grains/random.hpp"
#include "simulation/simulation.hpp"
#include "support/bench.hpp"
#include "support/random_cases.hpp"

namespace vibrosow {
namespace {

class RandomScene : public testing::TestWithParam<Space> {
 protected:
  static bool is_3d() { return GetParam() == Space::three_dimensional; }
  static std::optional<double> depth(double value) { return is_3d() ? std::optional(value) : std::nullopt; }
};
INSTANTIATE_TEST_SUITE_P(Spaces, RandomScene, testing::ValuesIn(both_spaces), named_by_space);

template <class Value>
Value one_of(Random& random, const std::vector<Value>& values) {
  return values[random.below(values.size())];
}

// ---- energy ----

/// A tray that is shaken along and held apart by a board. On the left balls are held to the floor by springs against
/// sliding and rolling that never give way; on the right others fall without friction or loss, through a hole and onto
/// the floor, and more rain in.
Scene lossless_tray(Random& random, Space space) {
  Scene scene;
  scene.space = space;
  scene.lots = {{"roller", 8e-3, 6e-4, Shape::ball, 0}, {"drop", 5e-3, 1.5e-4, Shape::ball, 1}};
  scene.lots[0].shell_compression = 0.03;  // so that its springs hold much of the energy
  Contact& contact = scene.contact;
  contact.shell_compression = 3e-3;
  contact.seed = contact.wall = {0, 1};
  contact.overrides = {{0, -1, {1, 1, 1, 0, 1}}};
  contact.friction_model = FrictionModel::spring, contact.rolling = Rolling::spring, contact.rolling_damping = 0;
  Vessel& tray = scene.tray;
  tray.name = "tray";
  tray.length = 0.2, tray.height = 0.25;
  if (space == Space::three_dimensional) tray.depth = 0.04;
  tray.pieces = {{.a = {0.1, 0}, .b = {0.1, 0.25}}};
  tray.holes = {{.centre = random.uniform(0.14, 0.16),
                 .width = random.uniform(0.02, 0.04),
                 .across = 0.02,
                 .across_length = random.uniform(0.02, 0.03)}};
  tray.rain = Rain{random.uniform(40, 80), 0.11, 0.19, 0.05};
  tray.motion = HarmonicMotion{0, random.uniform(1e-3, 1.5e-3), random.uniform(8, 10), 0.1};
  scene.run.duration = 1;
  scene.numerics.dt = Bench::pi * std::sqrt(3e-3 * 2.5e-3 / standard_gravity) / 1200;
  return scene;
}

TEST_P(RandomScene, EnergyIsAccountedForInATrayThatRollsDrainsAndIsFed) {
  for_random_cases(3, [&] {
    Random random = any_random();
    const Model model = prepare(lossless_tray(random, GetParam()));
    Grains grains = no_grains(model);
    const double roller = 4e-3 * (1 - *model.scene.lots[0].shell_compression);
    for (int k = 0; k < 4; ++k)
      grains.add(Eigen::Vector3d(0.02 + 0.02 * k, roller, 0.02), Eigen::Vector3d::Zero(), 0, grains.kinds[0]);
    for (int k = 0; k < 8; ++k)
      grains.add(Eigen::Vector3d(0.11 + 0.02 * (k % 4) + random.uniform(0, 5e-3), 0.01 + 0.02 * (k / 4),
                                 random.uniform(0.01, 0.03)),
                 Eigen::Vector3d::Zero(), 1, grains.kinds[1]);
    Simulation run(model, starting_state(model, 1, std::move(grains)));
    const auto unaccounted = [&] {
      const EnergyAccount e = run.result().energy;
      return e.kinetic + e.potential + e.elastic - e.wall_work - e.inserted + e.removed;
    };
    const double at_first = unaccounted();
    double in_play = 0, largest = 0;  // J
    while (run.time() < 0.25) {
      run.steps(100);
      RC_ASSERT(!run.guard().stop_reason());
      const EnergyAccount e = run.result().energy;
      in_play = std::max(in_play, e.kinetic + e.elastic);
      largest = std::max(largest, std::abs(unaccounted() - at_first));
    }
    const vibrosow::Run result = run.result();
    RC_ASSERT(result.balance.counted > 3);
    RC_ASSERT(result.balance.put_in > 20);
    RC_ASSERT(result.energy.removed != 0);
    // Of the largest kinetic and elastic energy that there was.
    RC_LOG() << "unaccounted: " << largest / in_play << "\n";
    RC_ASSERT(largest < 1e-6 * in_play);
  });
}

// ---- momenta ----

struct Momenta {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  double linear_scale = 0, angular_scale = 0;  // sums of sizes
};
Momenta momenta_of(const Grains& g) {
  Momenta sum;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const GrainKind kind = g.kind(i);
    const Eigen::Vector3d p = kind.mass * velocity_of(g, i);
    const Eigen::Vector3d l = place_of(g, i).cross(p) + turning_of(g, i) / kind.inverse_inertia;
    sum.linear += p, sum.angular += l;
    sum.linear_scale += p.norm(), sum.angular_scale += l.norm();
  }
  return sum;
}

/// Grains of two lots with every kind of contact, flying at each other without gravity.
TEST_P(RandomScene, MomentaAreKeptAmongGrains) {
  for_random_cases(20, [&] {
    Random random = any_random();
    Bench bench(GetParam());
    Contact& contact = bench.scene.contact;
    contact.law = one_of<Law>(random, {Law::elastic_shell, Law::hertz, Law::hertz_viscous});
    contact.youngs_modulus = 2e7, contact.damping_rate = 500;
    contact.seed = {random.uniform(0, 1), random.uniform(0.3, 1), 0.1, 2e-4, 0.1};
    contact.friction_model = one_of<FrictionModel>(random, {FrictionModel::sliding, FrictionModel::spring});
    contact.rolling = one_of<Rolling>(random, {Rolling::none, Rolling::constant_torque, Rolling::spring});
    SeedLot other = bench.scene.lots[0];
    other.name = "other", other.diameter *= 0.6, other.mass *= 0.3;
    bench.scene.lots[0].number_fraction = other.number_fraction = 0.5;
    bench.scene.lots.push_back(other);
    bench.scene.numerics.integrator =
        one_of<Integrator>(random, {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5});
    const auto any = [&](double size) -> Eigen::Vector3d {
      return Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size),
                             is_3d() ? random.uniform(-size, size) : 0);
    };
    const Eigen::Vector3d middle(0.5, 0.5, 0.5);
    for (int k = 0; k < 27; ++k) {
      const Eigen::Vector3d cell(k % 3 - 1, k / 3 % 3 - 1, is_3d() ? k / 9 - 1 : 0);
      if (!is_3d() && k >= 9) break;
      const Eigen::Vector3d at = middle + 8.5e-3 * cell + any(2e-4);
      const Eigen::Vector3d spin = is_3d() ? any(100) : Eigen::Vector3d(0, 0, random.uniform(-100, 100));
      bench.place(at, -40 * 8.5e-3 * cell + any(0.1), spin, k % 2);
    }
    Simulation& run = bench.start(1e-5);
    const Momenta before = momenta_of(run.grains());
    run.steps(2000);
    RC_ASSERT(!run.guard().stop_reason());
    RC_ASSERT(run.statistics().contacts > 300);
    const Momenta after = momenta_of(run.grains());
    RC_ASSERT((after.linear - before.linear).norm() < 1e-12 * before.linear_scale);
    // Verlet's step keeps the sum of moments; the others to their own order.
    if (bench.scene.numerics.integrator == Integrator::velocity_verlet)
      RC_ASSERT((after.angular - before.angular).norm() < 1e-12 * before.angular_scale);
  });
}

// ---- numbers and masses ----

TEST_P(RandomScene, EveryGrainAndItsMassAreSomewhere) {
  for_random_cases(6, [&] {
    Random random = any_random();
    Scene scene;
    scene.space = GetParam();
    scene.lots = {{"big", 8e-3, 6e-4, Shape::ball, 0.5},
                  {"small", 5e-3, 1.5e-4, Shape::ball, 0.3},
                  {"heavy", 6e-3, 9e-4, Shape::ball, 0.2}};
    scene.contact.shell_compression = 1e-3;
    scene.contact.seed = scene.contact.wall = {0.3, 0.5};
    scene.contact.friction_model = FrictionModel::spring;
    Vessel& tray = scene.tray;
    tray.name = "tray";
    tray.length = is_3d() ? 0.06 : 0.15, tray.height = 0.06, tray.depth = depth(0.04);
    tray.sides = one_of<Sides>(random, {Sides::walls, Sides::open, Sides::periodic});
    tray.tilt = tray.sides == Sides::periodic ? 0 : random.uniform(-0.1, 0.1);
    for (const double centre : {0.3, 0.7})
      tray.holes.push_back({.centre = centre * tray.length,
                            .width = random.uniform(0.012, 0.02),
                            .across = 0.02,
                            .across_length = 0.02});
    tray.fill = Fill{50, Packing::layers, 1e-3, false};
    tray.rain = Rain{random.uniform(50, 150), 0.2 * tray.length, 0.8 * tray.length, 0.055};
    tray.motion = HarmonicMotion{random.uniform(0, 1), 4e-3, random.uniform(8, 14), 0.05};
    scene.run.duration = 0.4;
    Simulation run(prepare_to_run(scene), 1);
    std::map<std::int64_t, double> masses;  // kg, of all that were ever seen, by number
    run.watch(1e-3, [&](Simulation& now) {
      const Grains& g = now.grains();
      for (std::size_t i = 0; i < g.size(); ++i) masses.emplace(g.id[i], g.kind(i).mass);
    });
    run.run_until(scene.run.duration);
    RC_ASSERT(!run.guard().stop_reason());
    const vibrosow::Run result = run.result();
    const Balance& balance = result.balance;
    RC_ASSERT(balance.put_in == balance.inside + balance.counted + balance.spilled);
    RC_ASSERT(balance.lost == 0);
    RC_ASSERT(balance.counted + balance.spilled > 5);
    RC_ASSERT(static_cast<std::int64_t>(masses.size()) == balance.put_in);
    std::set<std::int64_t> left;
    for (const OutflowEvent& event : result.events) {
      RC_ASSERT(left.insert(event.grain).second);
      RC_ASSERT(event.mass == masses.at(event.grain));
      RC_ASSERT(event.mass == scene.lots[static_cast<std::size_t>(event.lot)].mass);
    }
    std::int64_t inside = 0;
    for (const std::int64_t id : run.grains().id) inside += left.contains(id) ? 0 : 1;
    RC_ASSERT(inside == balance.inside);
    RC_ASSERT(inside + std::ssize(left) == balance.put_in);
  });
}

// ---- lists ----

/// Grains of two diameters (m) anywhere in a box that is periodic along, and in 3D across, with their lists. Where
/// they move, each has gone its own way for a while before the lists were made, and goes on so before they are tried.
class RandomLists {
 public:
  static constexpr double largest = 4e-3, wide = 0.9, narrow = 0.2;  // m; margins in diameters

  RandomLists(Random& random, Space space, bool moving)
      : vessels_(1, box(space)),
        walls_(vessels_, space),
        grains_({{largest / 2, 1e-5, 1e5, 1e10, 1e-3}}, true, true),
        neighbours_(vessels_, largest, {wide, narrow, wide}, {.is_3d = space == Space::three_dimensional}, execution_) {
    grains_.is_3d = space == Space::three_dimensional;
    for (int k = 0; k < (grains_.is_3d ? 120 : 40); ++k) {
      GrainKind kind = grains_.kinds.front();
      kind.radius *= k % 2 ? 1 : 0.6;
      grains_.add(Eigen::Vector3d(random.uniform(0, 0.03), random.uniform(0, 0.03), random.uniform(0, 0.03)),
                  Eigen::Vector3d::Zero(), 0, kind);
      const auto speed = [&] { return moving ? random.uniform(-0.5, 0.5) : 0; };
      const double x = speed(), y = speed(), z = speed();
      speeds_.emplace_back(x, y, z);
    }
    const Grains there = grains_;
    go_on(-before);
    neighbours_.update(grains_, walls_, 0, contacts_);
    grains_ = there;
    neighbours_.start_afresh();
    neighbours_.update(grains_, walls_, before, contacts_);
    go_on(after);
  }

  /// Of all pairs that are up to `gap` (m) apart, and not much less, seen across every boundary too: brings their two
  /// grains nearer by just under half of `nearer` (m) each, and looks whether they are listed while closer than
  /// `listed` (m). How many there were, and how many were missed.
  struct Found {
    int pairs = 0, missed = 0;
  };
  Found bring_together(double gap, double nearer, double listed) {
    Found found;
    look(
        {0, 0}, [this]() -> const PairList& { return contacts_.pairs; }, gap, nearer, listed, found);
    for (std::size_t k = 0; k < neighbours_.images().size(); ++k)
      look(
          neighbours_.images()[k], [this, k]() -> const PairList& { return contacts_.boundaries[k].pairs; }, gap,
          nearer, listed, found);
    return found;
  }

 private:
  static constexpr double before = 1.6e-3, after = 1.2e-3;  // s

  static Vessel box(Space space) {
    Vessel vessel;
    vessel.name = "tray";
    vessel.length = 0.03, vessel.height = 0.03, vessel.sides = Sides::periodic;
    if (space == Space::three_dimensional) vessel.depth = 0.03, vessel.front_and_back = Sides::periodic;
    return vessel;
  }
  void go_on(double time) {
    for (std::size_t i = 0; i < grains_.size(); ++i) move(i, time * speeds_[i]);
  }
  void move(std::size_t i, const Eigen::Vector3d& by) {
    grains_.x[i] += by.x(), grains_.y[i] += by.y();
    if (grains_.is_3d) grains_.z[i] += by.z();
  }
  template <class List>
  void look(const Neighbours::Image& image, List list, double gap, double nearer, double listed, Found& found) {
    const bool across = image.x != 0 || image.z != 0;
    for (std::size_t i = 0; i < grains_.size(); ++i)
      for (std::size_t j = 0; j < (across ? grains_.size() : i); ++j) {
        const Eigen::Vector3d shift(image.x, 0, image.z);
        const Eigen::Vector3d apart = place_of(grains_, j) - place_of(grains_, i) - shift;
        const double reach = grains_.radius[i] + grains_.radius[j], between = apart.norm() - reach;
        if (i == j || between > 0.999 * gap || between < 0.7 * gap) continue;
        const Grains there = grains_;
        const Eigen::Vector3d step = 0.4998 * nearer * apart.normalized();
        move(i, step), move(j, -step);
        neighbours_.update(grains_, walls_, before + after, contacts_);
        const double now = (place_of(grains_, j) - place_of(grains_, i) - shift).norm() - reach;
        grains_ = there;
        if (now >= listed) continue;
        ++found.pairs;
        const PairList& pairs = list();
        bool is_listed = false;
        for (std::size_t k = 0; k < pairs.size(); ++k)
          is_listed |= pairs.grain[k] == static_cast<int>(i) && pairs.partner[k] == static_cast<int>(j);
        if (!is_listed) ++found.missed;
      }
  }

  std::vector<Vessel> vessels_;
  Walls walls_;
  Grains grains_;
  std::vector<Eigen::Vector3d> speeds_;  // m/s
  Execution execution_;
  Neighbours neighbours_;
  ContactState contacts_;
};

// A list is made anew once a grain has strayed from its course by half of its margin: until then the two grains of a
// pair that was a margin apart may have come to touch, if both came as far as they may.
TEST_P(RandomScene, ListsMissNoPairUpToTheLastOfTheirMargins) {
  constexpr double wide = RandomLists::wide * RandomLists::largest, narrow = RandomLists::narrow * RandomLists::largest;
  int pairs_of_narrow = 0, pairs_of_wide = 0;
  for_random_cases(8, [&] {
    Random random = any_random();
    const bool moving = *rc::gen::arbitrary<bool>();
    // Contacts, while the narrow lists hold; then what is to be in those, while the wide ones hold.
    const auto of_narrow = RandomLists(random, GetParam(), moving).bring_together(narrow, narrow, 0);
    RC_ASSERT(of_narrow.missed == 0);
    const auto of_wide = RandomLists(random, GetParam(), moving).bring_together(wide, wide - narrow, narrow);
    RC_ASSERT(of_wide.missed == 0);
    pairs_of_narrow += of_narrow.pairs, pairs_of_wide += of_wide.pairs;
  });
  EXPECT_GT(pairs_of_narrow, 30);
  EXPECT_GT(pairs_of_wide, 30);
}

// ---- what must not show ----

Scene any_bed(Random& random, Space space) {
  Scene scene = Bench(space).scene;
  Contact& contact = scene.contact;
  contact.law = one_of<Law>(random, {Law::elastic_shell, Law::hertz});
  contact.shell_compression = 1e-3, contact.youngs_modulus = 5e6;
  contact.seed = contact.wall = {random.uniform(0.1, 0.8), random.uniform(0.3, 0.9), 0.1};
  contact.friction_model = one_of<FrictionModel>(random, {FrictionModel::sliding, FrictionModel::spring});
  contact.rolling = one_of<Rolling>(random, {Rolling::none, Rolling::spring});
  contact.slip_speed = 0.1;
  SeedLot other = scene.lots[0];
  other.name = "other", other.diameter *= 0.7, other.mass *= 0.4;
  scene.lots[0].number_fraction = other.number_fraction = 0.5;
  scene.lots.push_back(other);
  return scene;
}

struct Placed {
  Eigen::Vector3d at, velocity;
  int lot;
};
/// Grains in the cells of a grid over `size` (m), a little out of place, that fall and fly about.
std::vector<Placed> any_grains(Random& random, const Eigen::Vector3d& size, const Eigen::Vector3i& cells) {
  std::vector<Placed> grains;
  for (int i = 0; i < cells.x(); ++i)
    for (int j = 0; j < cells.y(); ++j)
      for (int k = 0; k < cells.z(); ++k) {
        const auto in_cell = [&](int cell, int count, double length) {
          return (cell + 0.5 + random.uniform(-0.05, 0.05)) * length / count;
        };
        const auto any = [&] { return random.uniform(-0.5, 0.5); };
        const Eigen::Vector3d at(in_cell(i, cells.x(), size.x()), in_cell(j, cells.y(), size.y()),
                                 in_cell(k, cells.z(), size.z()));
        const double vx = any(), vy = any(), vz = any();
        grains.push_back({at, {vx, vy, vz}, (i + j + k) % 2});
      }
  return grains;
}

Simulation started(const Model& model, const std::vector<Placed>& placed) {
  Grains grains = no_grains(model);
  for (const Placed& one : placed)
    grains.add(one.at, grains.is_3d ? one.velocity : Eigen::Vector3d(one.velocity.x(), one.velocity.y(), 0), one.lot,
               grains.kinds[static_cast<std::size_t>(one.lot)]);
  return Simulation(model, starting_state(model, 1, std::move(grains)));
}

// A periodic slice is one of the equal slices of a longer tray, in which what meets across the slice's seam meets as
// ordinary neighbours.
TEST_P(RandomScene, APeriodicSliceIsAPartOfALongerTray) {
  for_random_cases(8, [&] {
    Random random = any_random();
    constexpr double period = 0.04;
    Scene scene = any_bed(random, GetParam());
    scene.tray.length = period, scene.tray.sides = Sides::periodic, scene.tray.depth = depth(0.03);
    scene.tray.motion = HarmonicMotion{0.5, 3e-3, 10, 0.02};
    Scene longer = scene;
    longer.tray.length = 3 * period;
    const std::vector<Placed> placed = any_grains(random, {period, 0.05, 0.03}, {4, is_3d() ? 3 : 5, is_3d() ? 3 : 1});
    std::vector<Placed> thrice;
    for (int copy = 0; copy < 3; ++copy)
      for (Placed one : placed) one.at.x() += copy * period, thrice.push_back(one);
    const double dt = 1e-5;
    const Model model = with_step(prepare(scene), dt), model_of_longer = with_step(prepare(longer), dt);
    Simulation slice = started(model, placed), all = started(model_of_longer, thrice);
    slice.steps(5000), all.steps(5000);
    RC_ASSERT(!slice.guard().stop_reason());
    double largest = 0;
    for (std::size_t i = 0; i < thrice.size(); ++i) {
      const std::size_t k = i % placed.size();
      Eigen::Vector3d apart = place_of(all.grains(), i) - place_of(slice.grains(), k);
      apart.x() = std::remainder(apart.x(), period);
      largest = std::max(largest, apart.norm());
    }
    RC_LOG() << "apart by " << largest << " m\n";
    RC_ASSERT(slice.statistics().contacts > 2000);
    RC_ASSERT(largest < 1e-9);
  });
}

// The weight leans over, or the box with all in it the other way: the same, seen in other axes.
TEST_P(RandomScene, ATurnedTrayIsATurnedWeight) {
  for_random_cases(8, [&] {
    Random random = any_random();
    const Scene scene = any_bed(random, GetParam());
    const double angle = random.uniform(-1, 1);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Scene upright = scene, turned = scene;
    upright.tray.length = turned.tray.length = 0.04;
    upright.tray.depth = turned.tray.depth = depth(0.03);
    turned.tray.tilt = angle;
    std::vector<Placed> placed = any_grains(random, {0.04, 0.05, 0.03}, {4, is_3d() ? 3 : 5, is_3d() ? 3 : 1});
    if (!is_3d())
      for (Placed& one : placed) one.velocity.z() = 0;
    std::vector<Placed> leaning = placed;
    for (Placed& one : leaning) one.at = turn * one.at, one.velocity = turn * one.velocity;
    Model model = with_step(prepare(upright), 1e-5), model_of_turned = with_step(prepare(turned), 1e-5);
    model.gravity = (turn.transpose() * Eigen::Vector3d(0, -standard_gravity, 0)).head<2>();
    Simulation straight = started(model, placed), so = started(model_of_turned, leaning);
    straight.steps(5000), so.steps(5000);
    RC_ASSERT(!straight.guard().stop_reason());
    RC_ASSERT(straight.statistics().contacts > 2000);
    double largest = 0;
    for (std::size_t i = 0; i < placed.size(); ++i)
      largest = std::max(largest, (place_of(so.grains(), i) - turn * place_of(straight.grains(), i)).norm());
    RC_LOG() << "apart by " << largest << " m\n";
    RC_ASSERT(largest < 1e-9);
  });
}

}  // namespace
}  // namespace vibrosow
