// A few grains where a discrete-element code goes wrong: at edges, in wedges, at seams and gates, between vessels, with
// what is very unequal. In 2D and in 3D, most of them with both kinds of friction.
#include <cmath>
#include <numbers>

#include "stability/bounds.hpp"

namespace vibrosow {
namespace {

class HardPlace : public testing::TestWithParam<Setting> {
 protected:
  /// A bench under gravity with friction and rebound.
  static Bench heavy_bench(FrictionModel friction, double coefficient = 0.3) {
    Bench bench = GetParam().bench();
    bench.gravity = {0, -standard_gravity};
    bench.scene.contact.seed = bench.scene.contact.wall = {coefficient, 0.5};
    bench.scene.contact.friction_model = friction;
    return bench;
  }
  /// With 20 steps in a contact at this speed (m/s), or more where the scheme needs them.
  static Simulation& start(Bench& bench, double fastest) {
    return bench.start(std::min(contact_time(GetParam(), bench, fastest) / 20, prepare(bench.scene).step.longest_safe));
  }
  /// Steps up to a time (s); the largest kinetic energy on the way (J).
  static double run_until(Simulation& run, double time) {
    double most = 0;
    while (run.time() < time && run.step()) most = std::max(most, kinetic_energy(run.grains()));
    EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
    return most;
  }
  static bool is_3d() { return GetParam().is_3d(); }
};
INSTANTIATE_TEST_SUITE_P(Stability, HardPlace, testing::ValuesIn(settings()), named_by_setting);

constexpr double r = Bench::radius, weight = Bench::mass * standard_gravity;  // m, N
constexpr FrictionModel both_frictions[] = {FrictionModel::sliding, FrictionModel::spring};

/// A grain that lies still moves no more than this, J.
constexpr double silent = 1e-8 * weight * r;

// A groove of 60 degrees bears a grain with its weight on either side; without friction it lies at twice its radius.
TEST_P(HardPlace, AGrainFallsIntoAWedgeAndLies) {
  for (const FrictionModel friction : both_frictions) {
    Bench bench = heavy_bench(friction);
    const Eigen::Vector2d foot(0.5, 0.3), side = 0.2 * Eigen::Vector2d(0.5, std::sqrt(0.75));
    bench.scene.tray.pieces = {{.a = foot + Eigen::Vector2d(-side.x(), side.y()), .b = foot},
                               {.a = foot, .b = foot + side}};
    constexpr double speed = 0.2;
    bench.place({0.5 + 1e-4, 0.3 + 2 * r + 2e-3, 0.5}, {0, -speed, 0});
    Simulation& run = start(bench, speed);
    run_until(run, 0.4);
    const Setting& setting = GetParam();
    const double pressed = setting.overlap_at_rest(bench.scene, 1), height = run.grains().y[0] - 0.3;
    const Bounds bounds("grain fallen into a wedge", setting, bench.scene.contact);
    bounds.at_most("kinetic energy", kinetic_energy(run.grains()), silent, "J");
    bounds.at_most("height", height, 2 * r, "m");
    bounds.at_least("height", height, 2 * r - 2 * (2 * pressed), "m");
    bounds.at_most("largest relative overlap", run.result().max_relative_overlap,
                   (setting.overlap_on_wall(bench.scene, 1.1 * speed) + pressed) / r);
  }
}

TEST_P(HardPlace, AGrainLiesOnASlotNarrowerThanItself) {
  constexpr double half = 0.75 * r;
  for (const FrictionModel friction : both_frictions) {
    Bench bench = heavy_bench(friction);
    bench.scene.tray.holes = {{.centre = 0.5, .width = 2 * half, .across = 0.5, .across_length = 0.1}};
    bench.place({0.5003, r, 0.5}, {0.02, -0.05, 0});
    Simulation& run = start(bench, 0.2);
    run_until(run, 0.5);
    const double rigid = std::sqrt(r * r - half * half);
    const double pressed = GetParam().overlap_at_rest(bench.scene, r / (2 * rigid));
    const double sunk = rigid - std::sqrt((r - pressed) * (r - pressed) - half * half), height = run.grains().y[0];
    const Bounds bounds("grain on a slot narrower than itself", GetParam(), bench.scene.contact);
    bounds.at_most("kinetic energy", kinetic_energy(run.grains()), silent, "J");
    bounds.at_most("height", height, rigid, "m");
    bounds.at_least("height", height, rigid - 2 * sunk, "m");
  }
}

// It turns about the edge, slides off and falls: no faster than from its height, and is counted once.
TEST_P(HardPlace, AGrainTipsOffAHolesEdge) {
  for (const FrictionModel friction : both_frictions) {
    Bench bench = heavy_bench(friction);
    bench.scene.tray.holes = {{.centre = 0.5, .width = 0.1, .across = 0.5, .across_length = 0.1}};
    constexpr double over = 0.05 * r;
    const double height = std::sqrt(r * r - over * over);
    bench.place({0.45 + over, height, 0.5});
    Simulation& run = start(bench, 0.2);
    while (run.time() < 0.6 && run.result().balance.counted == 0) ASSERT_TRUE(run.step());
    const vibrosow::Run result = run.result();
    const Bounds bounds("grain poised on a hole's edge", GetParam(), bench.scene.contact);
    bounds.sound(result);
    bounds.just("grains counted", static_cast<double>(result.balance.counted), 1);
    ASSERT_EQ(result.events.size(), 1u);
    const double fallen = height + bench.scene.run.count_below;
    const double free_fall = std::sqrt(2 * standard_gravity * fallen);
    bounds.at_most("speed at the counting line", result.events[0].speed, free_fall, "m/s");
    bounds.at_least("speed at the counting line", result.events[0].speed, 0.5 * free_fall, "m/s");
  }
}

// 1 to 1000 in mass: the small ones bear it, or roll from under it.
TEST_P(HardPlace, AGrainLiesOnOthersATenthOfItsSize) {
  for (const FrictionModel friction : both_frictions) {
    Bench bench = heavy_bench(friction);
    bench.scene.contact.shell_compression = 2e-6, bench.scene.contact.youngs_modulus = 1e9;
    SeedLot small = bench.scene.lots[0];
    small.name = "small", small.diameter /= 10, small.mass /= 1000;
    bench.scene.lots[0].number_fraction = small.number_fraction = 0.5;
    bench.scene.lots.push_back(small);
    const double s = r / 10;
    const int across = is_3d() ? 4 : 1, along = is_3d() ? 4 : 9;
    for (int row = 0; row < across; ++row)
      for (int k = 0; k < along; ++k)
        bench.place({0.5 + 2.1 * s * (k - 0.5 * (along - 1)), s, 0.5 + 2.1 * s * (row - 0.5 * (across - 1))},
                    Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1);
    bench.place({0.5 + 0.3 * s, 2 * s + r, 0.5 + 0.2 * s});
    Simulation& run = bench.start(prepare(bench.scene).step.dt);
    const double before = total_energy(run, bench.gravity);
    const double most = run_until(run, 0.05), end = total_energy(run, bench.gravity);
    const Bounds bounds("grain on others a tenth of its size", GetParam(), bench.scene.contact);
    bounds.sound(run.result());
    bounds.at_most("energy at the end", end, before, "J");
    bounds.at_most("largest kinetic energy", most, 2 * s * weight, "J");  // of its fall to the floor
    bounds.at_most("largest relative overlap", run.result().max_relative_overlap, GuardLimits{}.warn_relative_overlap);
    bounds.at_most(made_by_numerics, run.result().energy.made_by_numerics, 0.01 * 2 * s * weight, "J");
  }
}

TEST_P(HardPlace, ASoftGrainAndAStiffOneMeetAsTheyShould) {
  Bench bench = GetParam().bench();
  bench.scene.contact.seed = {0, 0.5};
  SeedLot stiff = bench.scene.lots[0];
  stiff.name = "stiff", stiff.shell_compression = 1e-8, stiff.youngs_modulus = 2e11;
  bench.scene.contact.shell_compression = 1e-3, bench.scene.contact.youngs_modulus = 1e6;
  bench.scene.lots[0].number_fraction = stiff.number_fraction = 0.5;
  bench.scene.lots.push_back(stiff);
  constexpr double speed = 0.3;
  bench.place({0.5, 0.5, 0.5}, {speed, 0, 0})
      .place({0.5 + 2 * r + 1e-4, 0.5 + 1e-4, 0.5}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1);
  Simulation& run = bench.start(contact_time(GetParam(), bench, speed) / 40);
  const double before = kinetic_energy(run.grains());
  run_until(run, 0.02);
  const Eigen::Vector3d sum = velocity_of(run.grains(), 0) + velocity_of(run.grains(), 1);
  const Bounds bounds("soft grain against one 1e5 times as stiff", GetParam(), bench.scene.contact);
  bounds.at_most("change of momentum, relative", (sum - Eigen::Vector3d(speed, 0, 0)).norm() / speed, 1e-13);
  // e = 1/2 leaves (1 + e^2) / 2 of the energy; paper B's damping leaves what it leaves, at least that of the whole.
  const double left = kinetic_energy(run.grains()) / before, kept = (1 + 0.25) / 2;
  const bool known = GetParam().law != Law::hertz_viscous;
  bounds.at_most("energy left", left, known ? 1.01 * kept : 1);
  bounds.at_least("energy left", left, known ? 0.99 * kept : 0.5);
}

// The same two grains roll over the seam of a periodic floor, and in the midst of a long one.
TEST_P(HardPlace, SpringsAreCarriedOverASeam) {
  for (const FrictionModel friction : both_frictions) {
    const auto run_from = [&](Sides sides, double x) {
      Bench bench = heavy_bench(friction, 0.5);
      bench.scene.contact.rolling = Rolling::spring;
      bench.scene.contact.seed.rolling_friction = bench.scene.contact.wall.rolling_friction = 0.02;
      bench.scene.tray.sides = sides;
      bench.place({x, r, 0.5}, {1.5, 0, 0}).place({x + 2 * r, r + 1e-4, 0.5 + 1e-4}, {1, 0, 0});
      Simulation& run = start(bench, 1);
      run_until(run, 0.1);
      std::vector<double> values;
      for (std::size_t i = 0; i < 2; ++i) {
        const Eigen::Vector3d at = place_of(run.grains(), i), spin = turning_of(run.grains(), i);
        const double along = at.x() - x;
        values.insert(values.end(),
                      {along < 0 ? along + 1 : along, at.y(), at.z(), r * spin.x(), r * spin.y(), r * spin.z()});
      }
      return std::pair(values, bench.scene.contact);
    };
    const auto [over_the_seam, contact] = run_from(Sides::periodic, 0.95);
    const auto in_the_midst = run_from(Sides::walls, 0.45).first;
    double largest = 0;
    for (std::size_t k = 0; k < over_the_seam.size(); ++k)
      largest = std::max(largest, std::abs(over_the_seam[k] - in_the_midst[k]));
    EXPECT_GT(in_the_midst[0], 0.06) << "they must have passed the seam";
    Bounds("springs carried over a periodic seam", GetParam(), contact)
        .at_most("difference to the same without a seam", largest, 1e-9, "m, m/s");
  }
}

// Friction 1 turns spin into speed until it rolls, at 2/7 of its rim's speed, a disc at 1/3.
TEST_P(HardPlace, AGrainThatSpinsFastIsSetDown) {
  for (const FrictionModel friction : both_frictions) {
    Bench bench = heavy_bench(friction, 1);
    constexpr double spin = -1000;
    bench.place({0.3, 0.999 * r, 0.5}, Eigen::Vector3d::Zero(), {0, 0, spin});
    bench.scene.lots[0].shape = is_3d() ? Shape::ball : Shape::disc;
    Simulation& run = start(bench, 0.2);
    run_until(run, 0.25);
    const double rolling = -r * spin * (is_3d() ? 2.0 / 7 : 1.0 / 3), speed = run.grains().vx[0];
    const Bounds bounds("grain set down at 1000 rad/s", GetParam(), bench.scene.contact);
    bounds.at_most("speed", speed, 1.002 * rolling, "m/s");
    bounds.at_least("speed", speed, 0.995 * rolling, "m/s");
  }
}

TEST_P(HardPlace, AFastGrainHitsARowOfTen) {
  Bench bench = GetParam().bench();
  constexpr double speed = 0.5;
  bench.place({0.3, 0.5, 0.5}, {speed, 0, 0});
  for (int k = 0; k < 10; ++k)  // a zigzag whose neighbours just touch
    bench.place(
        {0.31 + 2 * r * std::sqrt(1 - 0.02) * k, 0.5 + 0.1 * r * (k % 2 ? 1 : -1), 0.5 + 0.1 * r * (k % 2 ? 1 : -1)});
  Simulation& run = start(bench, speed);
  run.field().evaluate(0, {});
  const double before = total_energy(run, bench.gravity);
  const double most = run_until(run, 0.05);
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < run.grains().size(); ++i) momentum += velocity_of(run.grains(), i);
  const Bounds bounds("fast grain into a row of ten", GetParam(), bench.scene.contact);
  bounds.at_most("change of momentum, relative", (momentum - Eigen::Vector3d(speed, 0, 0)).norm() / speed, 1e-12);
  // Each of eleven contacts is an impact at 20 steps.
  constexpr double z = std::numbers::pi / 20;
  bounds.at_most("largest kinetic energy, of what there was", most / before, 1 + 11 * (0.23 * z * z + z * z * z));
  bounds.at_most("energy at the end, of what there was", total_energy(run, bench.gravity) / before,
                 1 + 11 * (0.23 * z * z + z * z * z));
}

TEST_P(HardPlace, AGrainSqueezedBetweenTwoVesselsStopsTheRun) {
  Bench bench = heavy_bench(FrictionModel::sliding);
  bench.scene.tray.motion = HarmonicMotion{std::numbers::pi / 2, 6e-3, 5, 0};
  Vessel hopper = bench.scene.tray;
  hopper.name = "hopper", hopper.motion.reset(), hopper.pieces.clear();
  hopper.origin = {0, 9.5e-3};
  bench.scene.hopper = hopper;
  bench.place({0.5, 0.999 * r, 0.5});
  Simulation& run = start(bench, 0.2);
  while (run.time() < 0.2 && run.step()) {
  }
  const vibrosow::Run result = run.result();
  const Bounds bounds("grain squeezed between tray and hopper", GetParam(), bench.scene.contact);
  bounds.stopped(run.guard().stop_reason(), "relative overlap", result.balance);
  bounds.just("grains inside", static_cast<double>(result.balance.inside), 1);
}

// Its pull is two weights: it hangs as deep in the ceiling as it would lie on a floor.
TEST_P(HardPlace, AGrainHangsByItsCohesion) {
  Bench bench = heavy_bench(FrictionModel::spring);
  bench.scene.contact.wall.cohesion = 2 * weight;
  bench.scene.tray.pieces = {{.a = {0, 0.3}, .b = {1, 0.3}}};
  const double pressed = GetParam().overlap_at_rest(bench.scene, 1), height = 0.3 - r + pressed;
  bench.place({0.5, height, 0.5});
  Simulation& run = start(bench, 0.2);
  run_until(run, 0.2);
  const Bounds bounds("grain that hangs by its cohesion", GetParam(), bench.scene.contact);
  bounds.at_most("kinetic energy", kinetic_energy(run.grains()), silent, "J");
  bounds.at_most("way", std::abs(run.grains().y[0] - height), 0.01 * pressed, "m");
}

// Without gravity, in a closed box: every impact takes energy, and none gives any.
TEST_P(HardPlace, AGasThatLosesEnergyOnlyCools) {
  Bench bench = GetParam().bench();
  bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.5};
  bench.scene.contact.friction_model = FrictionModel::spring;
  Vessel& box = bench.scene.tray;
  box.length = 0.06, box.depth = is_3d() ? std::optional(0.06) : std::nullopt;
  box.pieces = {{.a = {0, 0.06}, .b = {0.06, 0.06}}};
  const int grains = is_3d() ? 27 : 9;
  for (int k = 0; k < grains; ++k)
    bench.place({0.01 + 0.02 * (k % 3), 0.01 + 0.02 * (k / 3 % 3), 0.01 + 0.02 * (k / 9)},
                {0.3 * std::sin(1.7 * k), -0.3 * std::cos(2.3 * k), 0.3 * std::sin(2.9 * k + 1)});
  Simulation& run = start(bench, 0.5);
  std::vector<double> energies = {total_energy(run, bench.gravity)};
  for (const double time : {0.05, 0.1, 0.2, 0.4}) {
    run_until(run, time);
    energies.push_back(total_energy(run, bench.gravity));
  }
  const Bounds bounds("gas that loses energy, without gravity", GetParam(), bench.scene.contact);
  bounds.sound(run.result());
  for (std::size_t k = 1; k < energies.size(); ++k)
    bounds.at_most("energy, of that before", energies[k] / energies[k - 1], 1);
  bounds.at_most("energy at the end, of the first", energies.back() / energies.front(), 0.5);
  bounds.at_most(made_by_numerics, run.result().energy.made_by_numerics, 0.01 * energies.front(), "J");
}

}  // namespace
}  // namespace vibrosow
