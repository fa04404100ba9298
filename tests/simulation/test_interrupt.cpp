// What takes long among millions of seeds ends when it is asked to: a request that is there already is seen before
// anything is done, so no clock is needed.
#include <gtest/gtest.h>

#include <atomic>

#include "grains/packing.hpp"
#include "simulation/simulate.hpp"
#include "simulation/simulation.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

const std::atomic<bool> asked{true};

Scene layers(int count) {
  Scene scene = Bench().scene;
  scene.tray.length = 2, scene.tray.height = 2;
  scene.tray.fill = Fill{count, Packing::layers, 1e-3, false};
  scene.contact.shell_compression = 1e-3;
  return scene;
}

TEST(Interrupt, ARunThatIsNotWantedAnyMoreTakesNoStep) {
  int looks = 0;
  const auto run = simulate(layers(40), {.interrupt = &asked, .progress = [&](double) { ++looks; }});
  EXPECT_EQ(run.status, RunStatus::interrupted);
  EXPECT_EQ(run.steps, 0);
  EXPECT_EQ(run.end_time, 0);
  EXPECT_EQ(run.balance.put_in, 0);
  EXPECT_EQ(looks, 0);
}

TEST(Interrupt, PackingEnds) {
  const Scene scene = layers(40);
  for (const Packing packing : {Packing::layers, Packing::hexagonal, Packing::poured}) {
    Vessel tray = scene.tray;
    tray.fill->packing = packing;
    Random random(1);
    EXPECT_THROW(pack(tray, scene.lots, Space::two_dimensional, random, &asked), Interrupted);
  }
}

TEST(Interrupt, TheFirstSearchForNeighboursEnds) {
  const Model model = prepare(layers(40));
  const SimulationState packed = starting_state(model, 1);
  EXPECT_THROW(Simulation(model, packed, {.stop = &asked}), Interrupted);
  EXPECT_NO_THROW(Simulation(model, packed, {}));
}

// A search and the forces of a large bed take seconds, so a look between whole steps alone would come late.
TEST(Interrupt, OfALargeBedEveryFewStepsAreLookedAt) {
  constexpr int grains = 20000, steps = 120;
  Scene scene = layers(grains);
  int looks = 0;
  const Model model = [&] {
    scene.run.duration = steps * prepare(scene).step.dt;
    return prepare(scene);
  }();
  const auto run = run_model(model, {.progress = [&](double) { ++looks; }});
  EXPECT_EQ(run.status, RunStatus::finished);
  EXPECT_GE(looks, 2);
}

TEST(Interrupt, ARunThatHasBegunEndsBetweenTwoSteps) {
  std::atomic<bool> ask{false};
  const auto run = simulate(layers(40), {.interrupt = &ask, .progress = [&](double) { ask = true; }});
  EXPECT_EQ(run.status, RunStatus::interrupted);
  EXPECT_EQ(run.steps, 512);  // the look that sees it comes after the one that asks
  EXPECT_EQ(run.balance.put_in, 40);
}

TEST(ARun, GoesOnUntilItsLastStep) {
  Scene scene = layers(4);
  scene.run.duration = 3 * prepare(scene).step.dt;
  const Model model = prepare(scene);
  Simulation simulation(model, starting_state(model, 1), {});
  while (!simulation.at_end()) {
    EXPECT_TRUE(simulation.result().goes_on);
    simulation.step();
  }
  EXPECT_FALSE(simulation.result().goes_on);
}

}  // namespace
}  // namespace vibrosow
