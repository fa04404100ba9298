// Snapshots: when they are taken, and what they hold.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/clump_body.hpp"
#include "scene/clump_shape.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/simulate.hpp"
#include "support/bench.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

TEST(Recorder, TakesTheFirstStepAtOrAfterEachTime) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.contact.seed.friction = 0.3;  // grains can turn
  bench.scene.tray.motion = HarmonicMotion{0, 0.01, 2, 0};
  bench.scene.record = Record{{0, 0.1, 0.10005, 0.2, 5}, 0.01};
  bench.place(0.2, 0.5).place(0.6, 0.7, 0.25, 0, 3);
  Simulation& run = bench.start(1e-4);
  EXPECT_EQ(run.result().snapshots.size(), 1u) << "at time 0 before the first step";
  run.steps(2000);
  const std::vector<Snapshot> taken = run.result().snapshots;
  ASSERT_EQ(taken.size(), 4u) << "5 s was not reached";
  EXPECT_EQ(taken[0].time, 0);
  EXPECT_NEAR(taken[1].time, 0.1, 1e-12);
  EXPECT_NEAR(taken[2].time, 0.1001, 1e-12);
  EXPECT_NEAR(taken[3].time, 0.2, 1e-12);
  // Free flight, which Verlet has exactly.
  const Snapshot& s = taken[3];
  ASSERT_EQ(s.size(), 2u);
  EXPECT_NEAR(s.x[1], 0.65, 1e-12);
  EXPECT_NEAR(s.y[1], 0.7 - 0.5 * standard_gravity * 0.04, 1e-10);
  EXPECT_NEAR(s.vy[1], -standard_gravity * 0.2, 1e-10);
  EXPECT_EQ(s.omega[1], 3);
  EXPECT_EQ(s.id, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(s.radius[0], Bench::radius);
  EXPECT_EQ(s.mass[0], Bench::mass);
  EXPECT_EQ(s.start_x[1], 0.6);
  EXPECT_EQ(s.start_y[1], 0.7);
  EXPECT_EQ(s.tray_x, vessel_pose(bench.scene.tray, s.time).displacement.x());
  EXPECT_EQ(s.tray_vx, vessel_velocity(bench.scene.tray, s.time).velocity.x());
}

/// A hopper reaches into the tray.
TEST(Recorder, KnowsWhatLiesInTheTray) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  Vessel& hopper = bench.scene.hopper.emplace(bench.scene.tray);
  hopper.name = "hopper", hopper.motion.reset(), hopper.holes.clear();
  hopper.origin = {0.3, 0.2}, hopper.length = 0.4;
  bench.scene.record = Record{{0}, 0.01};
  bench.place(0.1, Bench::radius).place(0.5, 0.2 + Bench::radius).place(0.5, Bench::radius);
  const std::vector<Snapshot> taken = bench.start(1e-4).result().snapshots;
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].in_tray, (std::vector<char>{1, 0, 1}));
}

TEST(Recorder, KnowsWhereFedGrainsWerePutInAndWhoHasLeft) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.holes = {{0.2, 0.05}};
  bench.scene.tray.fill = Fill{.count = 2, .keep = true};
  bench.scene.record = Record{{0.3}, 0.01};
  bench.place(0.2, 0.05).place(0.6, Bench::radius);
  Simulation& run = bench.start(1e-4);
  run.steps(3000);
  const std::vector<Snapshot> taken = run.result().snapshots;
  ASSERT_EQ(taken.size(), 1u);
  const Snapshot& s = taken[0];
  ASSERT_EQ(s.id, (std::vector<std::int64_t>{1, 2})) << "grain 0 has left and one was fed";
  EXPECT_EQ(s.start_x[0], 0.6);
  // Laid at rest on the floor or the other grain: it has hardly moved since.
  EXPECT_NEAR(s.start_x[1], s.x[1], 1e-3);
  EXPECT_GE(s.start_y[1], Bench::radius);
}

TEST(Recorder, RecordsAtTheVeryEndAndChangesNothing) {
  Scene scene = Bench().scene;
  scene.tray.holes = {{0.5, 0.05}};
  scene.tray.length = 0.6;
  scene.tray.fill = Fill{.count = 60};
  scene.run.duration = 0.1;
  const vibrosow::Run plain = simulate(scene);
  scene.record = Record{{0.05, 0.1}, 0.01};
  const vibrosow::Run recorded = simulate(scene);
  EXPECT_TRUE(plain.snapshots.empty());
  EXPECT_EQ(recorded.snapshots.size(), 2u);
  EXPECT_EQ(plain.energy.kinetic, recorded.energy.kinetic);
  EXPECT_EQ(plain.events.size(), recorded.events.size());
}

TEST(Recorder, ClumpsHaveTheirAngleAndTheirOwnArea) {
  Scene scene = Bench().scene;
  SeedLot& lot = scene.lots[0];
  lot.shape = Shape::clump;
  lot.discs = dipole(4e-3, 3e-3);
  lot.gyration2 = plate_of(lot.discs).gyration2;
  lot.diameter = 7e-3;
  scene.contact.seed.friction = 0.3;
  scene.tray.length = 0.05;
  scene.tray.fill = Fill{.count = 20};
  scene.run.duration = 0.05;
  scene.record = Record{{0, 0.05}, 0.01};
  const vibrosow::Run run = simulate(scene);
  ASSERT_EQ(run.status, RunStatus::finished);
  ASSERT_EQ(run.snapshots.size(), 2u);
  const Snapshot &start = run.snapshots[0], &end = run.snapshots[1];
  ASSERT_EQ(start.angle.size(), 20u);
  EXPECT_NE(start.angle[0], start.angle[1]) << "turned at random";
  EXPECT_NE(end.angle[0], start.angle[0]) << "it has fallen over";
  // Two discs of 2 mm radius less their lens: 2 r^2 acos(d / 2r) - d / 2 sqrt(4 r^2 - d^2).
  const double lens = 8e-6 * std::acos(0.75) - 1.5e-3 * std::sqrt(7e-6);
  EXPECT_NEAR(start.area[0], 8e-6 * std::numbers::pi - lens, 1e-16);
}

TEST(Recorder, BallsInSpaceHaveTheirVolumeAndWhatIsAcross) {
  Bench bench;
  bench.scene.space = Space::three_dimensional;
  bench.scene.lots[0].shape = Shape::ball;
  bench.scene.tray.depth = 0.1;
  bench.scene.tray.motion = HarmonicMotion{.amplitude = 1e-3, .frequency = 2, .across = 0.5};
  bench.scene.record = Record{{0, 0.05}, 0.01};
  const Model model = with_step(prepare(bench.scene), 1e-4);
  Grains grains = no_grains(model);
  grains.add(Eigen::Vector3d(0.2, 0.05, 0.03), Eigen::Vector3d(0, 0, 0.4), 0, model.kinds.front());
  Simulation run(model, starting_state(model, 1, grains));
  run.run_until(0.02);
  Simulation resumed(model, restore(model, save(model, run.state())));
  resumed.run_until(0.05);
  const std::vector<Snapshot> taken = resumed.result().snapshots;
  ASSERT_EQ(taken.size(), 2u);
  const Snapshot& s = taken[1];
  EXPECT_NEAR(s.z.at(0), 0.05, 1e-12);
  EXPECT_EQ(s.vz.at(0), 0.4);
  EXPECT_EQ(s.start_z.at(0), 0.03);
  EXPECT_EQ(s.omega_x, std::vector<double>{0});
  EXPECT_NEAR(s.volume.at(0), 4 * std::numbers::pi / 3 * 64e-9, 1e-21);
  EXPECT_TRUE(s.area.empty());
  EXPECT_EQ(s.tray_z, vessel_pose(bench.scene.tray, s.time).across);
  EXPECT_EQ(s.tray_vz, vessel_velocity(bench.scene.tray, s.time).across_velocity);
  EXPECT_GT(s.tray_z, 1e-4);
}

TEST(Recorder, ClumpsInSpaceHaveTheirQuaternionAndTheirOwnVolume) {
  Bench bench;
  bench.scene.space = Space::three_dimensional;
  bench.scene.tray.depth = 0.1;
  bench.scene.record = Record{{0}, 0.01};
  SeedLot& lot = bench.scene.lots[0];
  lot.shape = Shape::clump;
  const SolidClump clump = solid_clump({{-1.5e-3, 0, 2e-3}, {1.5e-3, 0, 2e-3}});
  lot.discs = clump.balls, lot.diameter = 7e-3;
  lot.gyration2_x = clump.gyration2.x(), lot.gyration2_y = clump.gyration2.y(), lot.gyration2 = clump.gyration2.z();
  const Model model = with_step(prepare(bench.scene), 1e-4);
  Grains grains = no_grains(model);
  grains.add(Eigen::Vector3d(0.2, 0.05, 0.03), Eigen::Vector3d::Zero(), 0, model.kinds.front(),
             {.orientation = {0.5, 0.5, -0.5, 0.5}});
  const vibrosow::Run run = Simulation(model, starting_state(model, 1, grains)).result();
  const Snapshot& s = run.snapshots.at(0);
  EXPECT_EQ(s.q_w, std::vector<double>{0.5});
  EXPECT_EQ(s.q_y, std::vector<double>{-0.5});
  EXPECT_TRUE(s.angle.empty());
  // Less the lens of two caps 0.5 mm high, pi h^2 (3 r - h) / 3 each.
  const double pi = std::numbers::pi;
  EXPECT_NEAR(s.volume.at(0), 64e-9 * pi / 3 - 2 * (pi * 0.25e-6 * 5.5e-3 / 3), 1e-20);
}

TEST(Recorder, InThePlaneWhatIsAcrossIsEmpty) {
  Bench bench;
  bench.scene.record = Record{{0}, 0.01};
  bench.place(0.2, 0.5);
  const Snapshot s = bench.start(1e-4).result().snapshots.at(0);
  for (const auto* array : {&s.z, &s.vz, &s.omega_x, &s.omega_y, &s.start_z, &s.volume, &s.q_w})
    EXPECT_TRUE(array->empty());
}

TEST(Recorder, AreaOfADiscIsItsCircles) {
  Bench bench;
  bench.scene.record = Record{{0}, 0.01};
  bench.place(0.2, 0.5);
  const vibrosow::Run run = bench.start(1e-4).result();
  EXPECT_NEAR(run.snapshots.at(0).area.at(0), std::numbers::pi * 16e-6, 1e-18);
  EXPECT_TRUE(run.snapshots.at(0).angle.empty());
}

TEST(Recorder, WithoutRotationSpinsAreZero) {
  Bench bench;
  bench.scene.contact.rotation = false;
  bench.scene.record = Record{{0}, 0.01};
  bench.place(0.2, 0.5);
  EXPECT_EQ(bench.start(1e-4).result().snapshots.at(0).omega, std::vector<double>{0});
}

}  // namespace
}  // namespace vibrosow
