// Gates: walls across the holes that vanish at a time.
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/simulate.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

TEST(Gate, HoldsUntilItsTimeAndThenLetsFall) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.holes = {{0.3, 0.04, 0.05}, {0.7, 0.04, 0.2}};
  bench.scene.contact.wall.restitution = 0.5;
  bench.place(0.3, Bench::radius).place(0.7, Bench::radius);
  Simulation& run = bench.start(1e-5);
  const std::size_t walls = run.field().walls().placed().size();
  EXPECT_EQ(walls, 7u) << "five of the box, two gates";
  run.steps(5000);
  EXPECT_NEAR(run.grains().y[0], Bench::radius, 0.001 * Bench::radius) << "held up to its time";
  run.steps(30000);
  ASSERT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
  const vibrosow::Run result = run.result();
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_EQ(result.events[0].hole, 1);
  // From the gate's height to the line 20 mm below.
  const double fall = std::sqrt(2 * (0.02 + Bench::radius) / standard_gravity);
  EXPECT_NEAR(result.events[0].time, 0.05 + fall, 2e-5);
  EXPECT_NEAR(result.events[1].time, 0.2 + fall, 2e-5);
  EXPECT_EQ(result.balance.put_in, result.balance.inside + result.balance.counted);
}

TEST(Gate, AClosedTrayWithGatesIsAClosedTray) {
  // A bed on gates that never open moves as on a floor: nothing is counted, nothing lost.
  Scene scene = Bench().scene;
  scene.lots = {{"grain", 6e-3, 2e-4, Shape::ball, 1.0}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.3, 0.5};
  scene.contact.slip_speed = 0.1;
  scene.tray.length = 0.1;
  scene.tray.height = 0.1;
  scene.tray.holes = {{0.05, 0.04, 0.3}};
  scene.tray.fill = Fill{80, Packing::poured, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0.4, 3e-3, 12, 0.1};
  scene.run.duration = 0.29;
  EXPECT_EQ(simulate(scene).balance.inside, 80);
  scene.run.duration = 0.6;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::finished) << run.stop_reason;
  EXPECT_GT(run.balance.counted, 20);
  EXPECT_EQ(run.balance.lost, 0);
  for (const OutflowEvent& event : run.events) EXPECT_GT(event.time, 0.3);
}

TEST(Gate, OpeningKeepsTheAccountOfEnergy) {
  // A grain pressed into the gate: what the shell had stored is taken out of the account with the gate.
  Bench bench;
  bench.scene.tray.holes = {{0.5, 0.04, 1e-4}};
  bench.place(0.5, Bench::radius - 1e-5);
  Simulation& run = bench.start(1e-6);
  const double stored = run.field().elastic_energy();
  EXPECT_GT(stored, 0);
  run.steps(200);
  EXPECT_EQ(run.field().elastic_energy(), 0);
  const vibrosow::Run result = run.result();
  EXPECT_NEAR(kinetic_energy(run.grains()) + result.energy.removed, stored, 1e-4 * stored);
  EXPECT_GT(result.energy.removed, 0.5 * stored);
}

}  // namespace
}  // namespace vibrosow
