// Beds that break a discrete-element code, in the plane and in space: each must stay bounded.
#include <algorithm>
#include <cmath>

#include "plan/step_plan.hpp"
#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"
#include "stability/hard_cases.hpp"

namespace vibrosow {
namespace {

constexpr double up = std::numbers::pi / 2;

class HardBed : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(Stability, HardBed, testing::ValuesIn(settings()), named_by_setting);
class HardBedInSpace : public HardBed {};
INSTANTIATE_TEST_SUITE_P(Stability, HardBedInSpace, testing::ValuesIn(settings_in_space()), named_by_setting);

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
  const bool in_space = GetParam().in_space();
  Scene scene = tray_scene(GetParam(), in_space ? 157 : 400, in_space ? 0.0162 : 0.085);  // 38 layers
  if (in_space) soften(scene), scene.contact.wall.friction = 0;  // or the walls of a tube bear the bed
  scene.tray.motion = shaken_up(3 * standard_gravity, 20, in_space ? 0.03 : 0.1);
  scene.run.duration = in_space ? 0.08 : 1;
  const PredictedOverlap predicted = prepare(scene).overlap;
  EXPECT_GT(predicted.layers, 35);
  const vibrosow::Run run = simulate(scene);
  expect_sound(run);
  EXPECT_LT(run.max_relative_overlap, predicted.overlap_at_rest + 2 * predicted.overlap_at_impact);
  EXPECT_LT(run.energy.made_by_numerics, 0.01 * run.energy.wall_work);
}

// A ball that meets the tray always at its fastest, u, leaves at e v + (1 + e) u: at 3 u in the end, with e = 1/2, and
// meets it at 4 u.
TEST_P(HardBed, AtSixtyHertzAndTwentyG) {
  Scene scene = tray_scene(GetParam(), 60, GetParam().in_space() ? 0.034 : 0.085);
  scene.contact.shell_compression = 1e-5;
  scene.contact.youngs_modulus = 2e8;
  scene.tray.motion = shaken_up(20 * standard_gravity, 60, 0);
  scene.run.duration = GetParam().in_space() ? 0.15 : 0.3;
  const vibrosow::Run run = simulate(scene);
  expect_sound(run);
  const double tray_speed = 20 * standard_gravity / (2 * std::numbers::pi * 60);
  EXPECT_LT(run.energy.kinetic, 60 * 0.5 * Bench::mass * 9 * tray_speed * tray_speed);
  EXPECT_LT(run.max_relative_overlap, GetParam().overlap_on_wall(scene, 4 * tray_speed) / Bench::radius);
  EXPECT_LT(run.energy.made_by_numerics, 0.01 * run.energy.wall_work);
}

TEST_P(HardBed, HeavyGrainsOnLightOnesAtOneToThousand) {
  Bench bench = GetParam().bench();
  const bool in_space = GetParam().in_space();
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.shell_compression = 2e-5;  // 1:1000 needs 5e-5 or less
  bench.scene.contact.youngs_modulus = 1e8;
  bench.scene.contact.seed = bench.scene.contact.wall = {0.3, 0.5};
  bench.scene.tray.length = in_space ? 0.0267 : 0.04;
  if (in_space) bench.scene.tray.depth = bench.scene.tray.length;
  SeedLot heavy = bench.scene.lots[0];
  heavy.name = "heavy", heavy.mass *= 1000, heavy.number_fraction = 0.5;
  bench.scene.lots.push_back(heavy);
  const int across = in_space ? 3 : 1, along = in_space ? 3 : 4;
  for (int row = 0; row < across; ++row)
    for (int k = 0; k < along; ++k) {
      const double z = 0.0041 + 0.0089 * row;
      for (int layer = 0; layer < 3; ++layer) bench.place({0.0041 + 0.0089 * k, 0.0041 + 0.0083 * layer, z});
      bench.place({0.0042 + 0.0088 * k, 0.0300, z}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1);
    }
  Simulation& run = bench.start(prepare(bench.scene).step.dt);
  const double before = total_energy(run, bench.gravity), end_time = in_space ? 0.25 : 2;
  while (run.time() < 0.25 * end_time) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double on_the_way = total_energy(run, bench.gravity);
  while (run.time() < end_time) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double end = total_energy(run, bench.gravity);
  EXPECT_LT(on_the_way, before);
  EXPECT_LT(end, on_the_way);
  EXPECT_EQ(run.result().balance.inside, 4 * across * along);
  EXPECT_LT(run.result().max_relative_overlap, 0.2);
  // In play: the fall of the heavy row.
  EXPECT_LT(run.result().energy.made_by_numerics, 0.01 * (before - end));
}

// Regularised friction creeps: a pile spreads at about the slip speed times its load, but its kinetic energy dies and
// nothing leaps. The tall step and walls keep this one in place. Poured balls stand on three others each and give way
// under those above: in space springs hold them.
TEST_P(HardBed, PileComesToRest) {
  const bool in_space = GetParam().in_space();
  const int count = in_space ? 60 : 150;
  Scene scene = tray_scene(GetParam(), count, in_space ? 0.034 : 0.12);
  scene.tray.fill->packing = Packing::poured;
  if (in_space) {
    soften(scene);
    Contact& contact = scene.contact;
    contact.friction_model = FrictionModel::spring, contact.rolling = Rolling::spring;
    contact.seed.rolling_friction = contact.wall.rolling_friction = 0.05;
    contact.seed.twisting_friction = contact.wall.twisting_friction = 0.05;
  }
  const double settled = in_space ? 0.4 : 1, looked_at = in_space ? 0.1 : 0.5;
  scene.run.duration = settled + looked_at;
  Simulation run(prepare(scene), 1);
  while (run.time() < settled) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double per_grain = kinetic_energy(run.grains()) / count;
  EXPECT_LT(per_grain, 1e-8 * Bench::mass * standard_gravity * Bench::radius);
  const Grains before = run.grains();
  while (run.time() < settled + looked_at) ASSERT_TRUE(run.step());
  double most = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    most = std::max(most, (place_of(run.grains(), i) - place_of(before, i)).norm());
  EXPECT_LT(most, 0.01 * Bench::radius);
}

/// The same with friction that slides: it goes on creeping, slower than the slip speed and ever more slowly.
TEST_P(HardBedInSpace, PileThatSlidesOnlyCreeps) {
  Scene scene = tray_scene(GetParam(), 60, 0.034);
  soften(scene);
  scene.tray.fill->packing = Packing::poured;
  scene.run.duration = 0.4;
  Simulation run(prepare(scene), 1);
  const auto speed = [&] { return std::sqrt(2 * kinetic_energy(run.grains()) / (60 * Bench::mass)); };
  while (run.time() < 0.2) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const double before = speed();
  while (run.time() < 0.4) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  EXPECT_LT(speed(), before);
  EXPECT_LT(speed(), scene.contact.slip_speed);
}

/// Rough dipoles, and in the floor a hole (in the plane a slot) somewhat longer than one: they fall through it for a
/// while, and then hang over it.
TEST_P(HardBed, ClumpsThatArchOverAHole) {
  const bool in_space = GetParam().in_space();
  Scene scene = tray_scene(GetParam(), 30, in_space ? 0.034 : 0.1);
  soften(scene);
  make_clump(scene.lots[0], dipole(6e-3, 5e-3), GetParam().space);
  scene.contact.seed = scene.contact.wall = {0.9, 0.3};
  scene.contact.friction_model = FrictionModel::spring;
  scene.tray.fill->packing = Packing::poured;
  scene.tray.holes = {{.centre = 0.5 * scene.tray.length, .width = in_space ? 0.017 : 0.02}};
  if (in_space) scene.tray.holes[0].shape = HoleShape::round, scene.tray.holes[0].across = 0.5 * *scene.tray.depth;
  scene.run.duration = 0.4;
  Simulation run(prepare_to_run(scene), 1);
  const double highest = std::ranges::max(run.grains().y);
  while (run.time() < scene.run.duration) ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
  const vibrosow::Run result = run.result();
  const double weight = scene.lots[0].mass * standard_gravity;
  EXPECT_EQ(result.balance.lost, 0);
  EXPECT_EQ(result.balance.spilled, 0);
  EXPECT_EQ(result.balance.put_in, result.balance.inside + result.balance.counted);
  EXPECT_LT(result.energy.made_by_numerics, 0.01 * weight * highest * static_cast<double>(result.balance.put_in));
  EXPECT_GT(result.balance.counted, 0);
  EXPECT_GT(result.balance.inside, 15);
  EXPECT_LT(result.energy.kinetic, 1e-3 * weight * Bench::radius * static_cast<double>(result.balance.inside));
}

}  // namespace
}  // namespace vibrosow
