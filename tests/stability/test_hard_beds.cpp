// Beds that break a discrete-element code, in 2D and in 3D: each must stay bounded.
#include <algorithm>
#include <cmath>

#include "plan/step_plan.hpp"
#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"
#include "stability/bounds.hpp"

namespace vibrosow {
namespace {

constexpr double up = std::numbers::pi / 2;

class HardBed : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(Stability, HardBed, testing::ValuesIn(settings()), named_by_setting);
class HardBed3d : public HardBed {};
INSTANTIATE_TEST_SUITE_P(Stability, HardBed3d, testing::ValuesIn(settings_3d()), named_by_setting);

/// For more than a few grains: steps 1.7 times as long.
void soften(Scene& scene) {
  scene.contact.shell_compression = 3e-4, scene.contact.youngs_modulus = 4e6;
}

HarmonicMotion shaken_up(double acceleration, double frequency, double ramp) {
  const double omega = 2 * std::numbers::pi * frequency;
  return {up, acceleration / (omega * omega), frequency, ramp};
}

// Its lowest shells bear its weight at the tray's largest acceleration, and the blow of the bed that lands on the tray,
// thrown back from its top.
TEST_P(HardBed, TallShakenVerticallyAtThreeG) {
  const bool is_3d = GetParam().is_3d();
  Scene scene = tray_scene(GetParam(), 157, is_3d ? 0.0162 : 0.0345);  // 38 layers
  if (is_3d) soften(scene);
  scene.contact.wall.friction = 0;  // or the walls of a tube bear the bed
  scene.contact.slip_speed = 0.1;   // or the load makes friction ask for a tiny step
  scene.tray.motion = shaken_up(3 * standard_gravity, 20, 0.03);
  scene.run.duration = is_3d ? 0.08 : 0.15;
  const PredictedOverlap predicted = prepare(scene).overlap;
  EXPECT_GT(predicted.layers, 35);
  const vibrosow::Run run = simulate(scene);
  const Bounds bounds("tall bed shaken up and down at 3 g", GetParam(), scene.contact);
  bounds.sound(run);
  bounds.at_most("largest relative overlap", run.max_relative_overlap,
                 predicted.overlap_at_rest + 2 * predicted.overlap_at_impact);
  bounds.at_most(made_by_numerics, run.energy.made_by_numerics, 0.01 * run.energy.wall_work, "J");
}

// A ball that meets the tray always at its fastest, u, leaves at e v + (1 + e) u: at 3 u in the end, with e = 1/2, and
// meets it at 4 u.
TEST_P(HardBed, AtSixtyHertzAndTwentyG) {
  Scene scene = tray_scene(GetParam(), 60, GetParam().is_3d() ? 0.034 : 0.085);
  scene.contact.shell_compression = 1e-5;
  scene.contact.youngs_modulus = 2e8;
  scene.tray.motion = shaken_up(20 * standard_gravity, 60, 0);
  scene.run.duration = GetParam().is_3d() ? 0.15 : 0.3;
  const vibrosow::Run run = simulate(scene);
  const Bounds bounds("bed at 60 Hz and 20 g", GetParam(), scene.contact);
  bounds.sound(run);
  const double tray_speed = 20 * standard_gravity / (2 * std::numbers::pi * 60);
  bounds.at_most("kinetic energy", run.energy.kinetic, 60 * 0.5 * Bench::mass * 9 * tray_speed * tray_speed, "J");
  bounds.at_most("largest relative overlap", run.max_relative_overlap,
                 GetParam().overlap_on_wall(scene, 4 * tray_speed) / Bench::radius);
  bounds.at_most(made_by_numerics, run.energy.made_by_numerics, 0.01 * run.energy.wall_work, "J");
}

TEST_P(HardBed, HeavyGrainsOnLightOnesAtOneToThousand) {
  Bench bench = GetParam().bench();
  const bool is_3d = GetParam().is_3d();
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.shell_compression = 2e-5;  // 1:1000 needs 5e-5 or less
  bench.scene.contact.youngs_modulus = 1e8;
  bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.5};
  bench.scene.tray.length = is_3d ? 0.0267 : 0.04;
  if (is_3d) bench.scene.tray.depth = bench.scene.tray.length;
  SeedLot heavy = bench.scene.lots[0];
  heavy.name = "heavy", heavy.mass *= 1000, heavy.number_fraction = 0.5;
  bench.scene.lots.push_back(heavy);
  const int across = is_3d ? 3 : 1, along = is_3d ? 3 : 4;
  for (int row = 0; row < across; ++row)
    for (int k = 0; k < along; ++k) {
      const double z = 0.0041 + 0.0089 * row;
      for (int layer = 0; layer < 3; ++layer) bench.place({0.0041 + 0.0089 * k, 0.0041 + 0.0083 * layer, z});
      bench.place({0.0042 + 0.0088 * k, 0.0300, z}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1);
    }
  Simulation& run = bench.start(prepare(bench.scene).step.dt);
  const double before = total_energy(run, bench.gravity), end_time = is_3d ? 0.25 : 2;
  while (run.time() < 0.25 * end_time) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double on_the_way = total_energy(run, bench.gravity);
  while (run.time() < end_time) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double end = total_energy(run, bench.gravity);
  const Bounds bounds("heavy grains on light ones, 1000 to 1", GetParam(), bench.scene.contact);
  bounds.at_most("energy at a quarter of the time", on_the_way, before, "J");
  bounds.at_most("energy at the end", end, on_the_way, "J");
  bounds.just("grains inside", static_cast<double>(run.result().balance.inside), 4 * across * along);
  // A heavy grain's whole fall, until it lies on one light grain, in the two sides of that one.
  const double fall = 1000 * Bench::mass * standard_gravity * (0.0300 - 3 * Bench::radius);
  bounds.at_most("largest relative overlap", run.result().max_relative_overlap,
                 GetParam().overlap_of_energy(bench.scene, 0.5 * fall) / Bench::radius);
  // In play: the fall of the heavy row.
  bounds.at_most(made_by_numerics, run.result().energy.made_by_numerics, 0.01 * (before - end), "J");
}

// Regularised friction creeps: a pile spreads at about the slip speed times its load, but its kinetic energy dies and
// nothing leaps. The tall step and walls keep this one in place. Poured balls stand on three others each and give way
// under those above: in 3D springs hold them.
TEST_P(HardBed, PileComesToRest) {
  const bool is_3d = GetParam().is_3d();
  const int count = is_3d ? 60 : 150;
  Scene scene = tray_scene(GetParam(), count, is_3d ? 0.034 : 0.12);
  scene.tray.fill->packing = Packing::poured;
  if (is_3d) {
    soften(scene);
    Contact& contact = scene.contact;
    contact.friction_model = FrictionModel::spring, contact.rolling = Rolling::spring;
    contact.seed.rolling_friction = contact.wall.rolling_friction = 0.05;
    contact.seed.twisting_friction = contact.wall.twisting_friction = 0.05;
  }
  const double settled = is_3d ? 0.4 : 1, looked_at = is_3d ? 0.1 : 0.5;
  scene.run.duration = settled + looked_at;
  Simulation run(prepare(scene), 1);
  while (run.time() < settled) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const Bounds bounds("pile at rest", GetParam(), scene.contact);
  // The slope of sliding friction is held to what a step can take, so a pile creeps at a speed that goes with the step.
  const double longer = is_3d ? 1 : 20 / scene.numerics.steps_per_contact;
  bounds.at_most("kinetic energy of a grain", kinetic_energy(run.grains()) / count,
                 1e-8 * longer * longer * Bench::mass * standard_gravity * Bench::radius, "J");
  const Grains before = run.grains();
  while (run.time() < settled + looked_at) ASSERT_TRUE(run.step());
  double most = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    most = std::max(most, (place_of(run.grains(), i) - place_of(before, i)).norm());
  bounds.at_most("way of any grain", most, 0.01 * Bench::radius, "m");
}

/// The same with friction that slides: it goes on creeping, slower than the slip speed and ever more slowly.
TEST_P(HardBed3d, PileThatSlidesOnlyCreeps) {
  Scene scene = tray_scene(GetParam(), 60, 0.034);
  soften(scene);
  scene.tray.fill->packing = Packing::poured;
  scene.run.duration = 0.4;
  Simulation run(prepare(scene), 1);
  const auto speed_from = [&](double from, double to) {  // root mean square, over all balls and that time
    double squares = 0, looks = 0;
    for (run.run_until(from); run.time() < to; ++looks) {
      run.run_until(run.time() + 1e-3);
      squares += 2 * kinetic_energy(run.grains()) / (60 * Bench::mass);
    }
    return std::sqrt(squares / looks);
  };
  const double before = speed_from(0.1, 0.2), later = speed_from(0.3, 0.4);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  const Bounds bounds("pile that slides", GetParam(), scene.contact);
  bounds.at_most("speed, later", later, before, "m/s");
  bounds.at_most("speed", later, scene.contact.slip_speed, "m/s");
}

/// Rough dipoles, and in the floor a hole (in 2D a slot) somewhat longer than one: they fall through it for a
/// while, and then hang over it.
TEST_P(HardBed, ClumpsThatArchOverAHole) {
  const bool is_3d = GetParam().is_3d();
  Scene scene = tray_scene(GetParam(), 30, is_3d ? 0.034 : 0.1);
  soften(scene);
  make_clump(scene.lots[0], dipole(6e-3, 5e-3), GetParam().space);
  scene.contact.seed = scene.contact.wall = {0.9, 0.3};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.fill->packing = Packing::poured;
  scene.tray.holes = {{.centre = 0.5 * scene.tray.length, .width = is_3d ? 0.017 : 0.021}};
  if (is_3d) scene.tray.holes[0].shape = HoleShape::round, scene.tray.holes[0].across = 0.5 * *scene.tray.depth;
  scene.run.duration = 0.4;
  Simulation run(prepare_to_run(scene), 1);
  const double highest = std::ranges::max(run.grains().y);
  while (run.time() < scene.run.duration) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const vibrosow::Run result = run.result();
  const double weight = scene.lots[0].mass * standard_gravity;
  const Bounds bounds("clumps arch over a hole", GetParam(), scene.contact);
  bounds.sound(result);
  const double put_in = static_cast<double>(result.balance.put_in), inside = static_cast<double>(result.balance.inside);
  bounds.at_most(made_by_numerics, result.energy.made_by_numerics, 0.01 * weight * highest * put_in, "J");
  bounds.at_least("clumps that fell through", static_cast<double>(result.balance.counted), 1);
  bounds.at_least("clumps that hang", inside, 16);
  bounds.at_most("kinetic energy of those", result.energy.kinetic, 1e-3 * weight * Bench::radius * inside, "J");
}

/// A bed as its tray shakes it, in one figure: an isolated grain gets to 3 u between walls that move at u (see 60 Hz).
void expect_driven(const Bounds& bounds, const vibrosow::Run& run, int grains, double tray_speed, double overlap) {
  bounds.sound(run);
  const double most = grains * 0.5 * Bench::mass * 9 * tray_speed * tray_speed;
  bounds.at_most("kinetic energy", run.energy.kinetic, most, "J");
  bounds.at_most("largest relative overlap", run.max_relative_overlap, overlap / Bench::radius);
  bounds.at_most(made_by_numerics, run.energy.made_by_numerics, 0.01 * most, "J");
}

TEST_P(HardBed, AtAKilohertzAndAHundredG) {
  Scene scene = tray_scene(GetParam(), 30, GetParam().is_3d() ? 0.034 : 0.085);
  scene.tray.motion = shaken_up(100 * standard_gravity, 1000, 0);
  scene.run.duration = 0.1;
  const double tray_speed = 100 * standard_gravity / (2 * std::numbers::pi * 1000);
  expect_driven(Bounds("bed at 1 kHz and 100 g", GetParam(), scene.contact), simulate(scene), 30, tray_speed,
                GetParam().overlap_on_wall(scene, 4 * tray_speed) + GetParam().overlap_at_rest(scene, 5));
}

// At its fastest, towards the other side from one step to the next: the wall meets the bed at twice its speed.
TEST_P(HardBed, WhoseTrayIsReversedAtFullSpeed) {
  const int grains = 40;
  Scene scene = tray_scene(GetParam(), grains, GetParam().is_3d() ? 0.034 : 0.085);
  constexpr double amplitude = 0.01, frequency = 9;
  scene.tray.motion = HarmonicMotion{0, amplitude, frequency, 0};
  scene.run.duration = 0.2;
  Simulation run(prepare_to_run(scene), 1);
  ASSERT_TRUE(run.run_until(1 / frequency)) << *run.guard().stop_reason();
  run.set_motion(0, HarmonicMotion{0, -amplitude, frequency, 0});
  run.run_until(scene.run.duration);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  const double tray_speed = 2 * std::numbers::pi * frequency * amplitude;
  expect_driven(Bounds("tray reversed at full speed", GetParam(), scene.contact), run.result(), grains, tray_speed,
                GetParam().overlap_on_wall(scene, 4 * tray_speed));
}

TEST_P(HardBed, DroppedOnItsFloor) {
  Bench bench = GetParam().bench();
  const bool is_3d = GetParam().is_3d();
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.5};
  bench.scene.contact.friction_model = FrictionModel::spring;
  bench.scene.tray.length = 0.04, bench.scene.tray.depth = is_3d ? std::optional(0.04) : std::nullopt;
  constexpr double drop = 0.1;  // m
  const int layers = is_3d ? 3 : 6, across = is_3d ? 4 : 1, grains = 4 * across * layers;
  for (int k = 0; k < grains; ++k)
    bench.place({0.005 + 0.01 * (k % 4) + 2e-4 * std::sin(3.7 * k), drop + Bench::radius + 0.0082 * (k / 4 / across),
                 0.005 + 0.01 * (k / 4 % across)});
  Simulation& run = bench.start(prepare(bench.scene).step.dt);
  const double before = total_energy(run, bench.gravity), fall = grains * Bench::mass * standard_gravity * drop;
  const bool went_on = run.run_until(0.5);
  ASSERT_TRUE(went_on || !run.guard().stop_reason()) << *run.guard().stop_reason();
  const Bounds bounds("bed dropped on its floor from 10 cm", GetParam(), bench.scene.contact);
  bounds.sound(run.result());
  bounds.at_most("energy at the end", total_energy(run, bench.gravity), before - fall, "J");
  bounds.at_most("kinetic energy at the end", kinetic_energy(run.grains()), 0.01 * fall, "J");
  // The first layer is hit by those above while it rebounds, each at most as fast as it fell.
  bounds.at_most(
      "largest relative overlap", run.result().max_relative_overlap,
      2 * GetParam().overlap_on_wall(bench.scene, std::sqrt(2 * standard_gravity * (drop + 0.05))) / Bench::radius);
  bounds.at_most(made_by_numerics, run.result().energy.made_by_numerics, 0.01 * fall, "J");
}

/// A column of grains between the tray's left wall and a board.
TEST_P(HardBed, WhoseWallIsTakenAway) {
  Bench bench = GetParam().bench();
  const bool is_3d = GetParam().is_3d();
  soften(bench.scene);
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.5};
  bench.scene.tray.length = 0.3, bench.scene.tray.depth = is_3d ? std::optional(0.0245) : std::nullopt;
  bench.scene.tray.pieces = {{.a = {0.0265, 0}, .b = {0.0265, 0.2}}};
  const int layers = is_3d ? 4 : 10, across = is_3d ? 3 : 1, grains = 3 * across * layers;
  for (int k = 0; k < grains; ++k)
    bench.place({0.0041 + 0.00814 * (k % 3) + 0.002 * (k / 3 / across % 2), Bench::radius + 0.008 * (k / 3 / across),
                 0.0041 + 0.00814 * (k / 3 % across)});
  Simulation& run = bench.start(prepare(bench.scene).step.dt);
  const auto potential = [&] { return potential_energy(run.grains(), bench.gravity); };
  run.run_until(0.05);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  run.field().remove_wall(run.field().walls().named("tray piece 1").front());
  const double before = total_energy(run, bench.gravity), at_first = potential();
  double most = 0, fallen = 0;
  while (run.time() < 0.4 && run.step())
    most = std::max(most, kinetic_energy(run.grains())), fallen = std::max(fallen, at_first - potential());
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  EXPECT_GT(std::ranges::max(run.grains().x), 0.05) << "it must have spread";
  const Bounds bounds("heap whose wall is taken away", GetParam(), bench.scene.contact);
  bounds.sound(run.result());
  bounds.at_most("largest kinetic energy", most, fallen, "J");
  bounds.at_most("energy at the end", total_energy(run, bench.gravity), before, "J");
  bounds.at_most(made_by_numerics, run.result().energy.made_by_numerics, 0.01 * fallen, "J");
}

// The gate closes only where no grain is in its way, and otherwise stays open.
TEST_P(HardBed, OverAGateThatOpensAndCloses) {
  const bool is_3d = GetParam().is_3d();
  Scene scene = tray_scene(GetParam(), 60, is_3d ? 0.034 : 0.085);
  soften(scene);
  Hole hole{.centre = 0.5 * scene.tray.length, .width = 0.02, .open_at = 0.01};
  if (is_3d) hole.across = 0.5 * *scene.tray.depth, hole.across_length = 0.02;
  scene.tray.holes = {hole};
  scene.run.duration = 0.3;
  Simulation run(prepare_to_run(scene), 1);
  const double highest = std::ranges::max(run.grains().y);
  int refused = 0, closed = 0;
  for (int k = 1; k <= 60; ++k) {
    run.run_until(0.02 + 0.004 * k);
    ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
    if (k % 3 == 0) run.open_gate("tray", 1);
    if (k % 3 == 1) ++(run.close_gate("tray", 1) ? closed : refused);
  }
  const vibrosow::Run result = run.result();
  EXPECT_GT(refused, 0);
  EXPECT_GT(result.balance.counted, 5);
  const Bounds bounds("gate closed on a bed that flows", GetParam(), scene.contact);
  bounds.sound(result);
  const double fall = 60 * Bench::mass * standard_gravity * (highest + scene.run.count_below);
  bounds.at_most("kinetic energy", result.energy.kinetic, fall, "J");
  bounds.at_most(made_by_numerics, result.energy.made_by_numerics, 0.01 * fall, "J");
  bounds.at_most("largest relative overlap", result.max_relative_overlap,
                 2 * GetParam().overlap_on_wall(scene, std::sqrt(2 * standard_gravity * highest)) / Bench::radius);
}

}  // namespace
}  // namespace vibrosow
