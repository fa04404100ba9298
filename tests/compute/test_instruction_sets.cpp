// Every instruction set gives the same bits, for every kind of effect: the same source compiled again may only be
// faster.
#include <gtest/gtest.h>

#include <limits>

#include "simulation/simulation.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

/// Two lots shaken in a tray with a hole, with the choice of effects that `effects` asks for beside the scene's own.
Grains shaken(Law law, const EffectChoice& choice, InstructionSet instructions, int threads = 1) {
  Scene scene;
  scene.lots = {{"a", 8e-3, 0.6e-3, Shape::disc, 0.5}, {"b", 8e-3, 0.6e-3, Shape::disc, 0.5}};
  scene.contact.law = law;
  scene.contact.shell_compression = 1e-3;
  scene.contact.youngs_modulus = 1e6;
  scene.contact.damping_rate = 100;
  scene.contact.seed = scene.contact.wall = {0.4, 0.5};
  scene.contact.seed.rolling_friction = 0.1;
  scene.contact.seed.cohesion = 1e-3;
  scene.tray.length = 0.12;
  scene.tray.height = 0.2;
  scene.tray.holes = {{0.06, 0.03}};
  scene.tray.fill = Fill{150, Packing::layers, 1e-4, false};
  scene.tray.motion = HarmonicMotion{0.5, 0.01, 12, 0};
  scene.guard.stop_relative_overlap = 100;
  scene.run.duration = 1;
  EffectSet effects;
  effects.friction = choice.friction != FrictionChoice::none;
  effects.tangential_spring = choice.friction == FrictionChoice::spring;
  effects.rotation = choice.rotation, effects.damping = choice.damping, effects.polydisperse = choice.polydisperse;
  effects.rolling = choice.rolling, effects.cohesion = choice.cohesion;
  effects.motion = true;
  if (choice.polydisperse) scene.lots[1].diameter = 5e-3, scene.lots[1].mass = 0.2e-3;
  Model model = with_step(prepare(scene, effects), 5e-5);
  model.step.too_long = true;
  Simulation run(model, 5, {.instructions = instructions, .threads = threads});
  run.steps(1500);
  EXPECT_GT(run.statistics().contacts, 20000);
  return run.grains();
}

TEST(InstructionSets, GiveTheSameBits) {
  for (const Law law : {Law::elastic_shell, Law::hertz, Law::hertz_viscous})
    for (const EffectChoice& choice : compiled_effects) {
      const Grains generic = shaken(law, choice, InstructionSet::generic);
      for (const InstructionSet set : instruction_sets) {
        if (!is_available(set)) continue;
        const Grains same = shaken(law, choice, set);
        ASSERT_EQ(same.x, generic.x) << name_of(set);
        ASSERT_EQ(same.y, generic.y) << name_of(set);
        ASSERT_EQ(same.vx, generic.vx) << name_of(set);
        ASSERT_EQ(same.vy, generic.vy) << name_of(set);
        ASSERT_EQ(same.omega, generic.omega) << name_of(set);
      }
    }
}

// The sums of a grain are the same whichever thread's range it and its neighbours are in.
TEST(Threads, GiveTheSameBits) {
  for (const EffectChoice& choice : compiled_effects) {
    const Grains one = shaken(Law::elastic_shell, choice, best_instruction_set());
    for (const int threads : {2, 3, 7}) {
      const Grains same = shaken(Law::elastic_shell, choice, best_instruction_set(), threads);
      ASSERT_EQ(same.x, one.x) << threads;
      ASSERT_EQ(same.vy, one.vy) << threads;
      ASSERT_EQ(same.omega, one.omega) << threads;
    }
  }
}

// A state that is not a number ends a run at once, insisted on or not: it must never reach the lists.
TEST(InstructionSets, AllSeeWhatIsNotANumber) {
  Scene scene;
  scene.lots = {{"a", 8e-3, 0.6e-3, Shape::disc, 1}};
  scene.contact.shell_compression = 1e-3;
  scene.tray.length = 0.12, scene.tray.height = 0.2;
  scene.tray.fill = Fill{40, Packing::layers, 0, false};
  scene.run.duration = 1;
  for (const InstructionSet set : instruction_sets) {
    if (!is_available(set)) continue;
    Model model = with_step(prepare(scene), 1e-5);
    model.step.too_long = true;
    Simulation run(model, 1, {.instructions = set});
    run.grains().vx[37] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(run.step()) << name_of(set);
    ASSERT_TRUE(run.guard().stop_reason()) << name_of(set);
    EXPECT_NE(run.guard().stop_reason()->find("not a number"), std::string::npos);
  }
}

TEST(InstructionSets, TheBestIsAvailable) {
  EXPECT_TRUE(is_available(InstructionSet::generic));
  EXPECT_TRUE(is_available(best_instruction_set()));
}

}  // namespace
}  // namespace vibrosow
