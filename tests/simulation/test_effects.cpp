// Specialised kernels against the all-effects kernel at neutral values: the same trajectories, compared with ==.
#include <gtest/gtest.h>

#include "support/bench.hpp"

namespace vibrosow {
namespace {

struct Chosen {
  bool friction, rotation, damping, drag, motion;
};

Bench crowded_bench(const Chosen& chosen) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.length = 0.06;
  bench.scene.tray.holes = {{0.03, 0.01}};
  const Surface surface{chosen.friction ? 0.3 : 0.0, chosen.damping ? 0.5 : 1.0};
  bench.scene.contact.seed = bench.scene.contact.wall = surface;
  bench.scene.contact.rotation = chosen.rotation;
  bench.scene.contact.drag = chosen.drag ? 1e-3 : 0.0;
  if (chosen.motion) bench.scene.tray.motion = HarmonicMotion{0.3, 2e-3, 15, 0};
  for (int k = 0; k < 42; ++k)
    bench.place(0.005 + 0.0083 * (k % 7) + 1e-5 * (k % 3), 0.0045 + 0.0085 * (k / 7), 0.1 * ((k * 7) % 5 - 2),
                -0.05 * (k % 4));
  return bench;
}

void expect_same_trajectories(const Chosen& chosen, Integrator integrator) {
  const auto end = [&](bool all) {
    Bench bench = crowded_bench(chosen);
    bench.scene.numerics.integrator = integrator;
    EffectSet effects = effects_of(bench.scene);
    if (all) {
      effects = all_pair_effects();
      effects.drag = effects.motion = true;
    }
    // Rotation left out of a scene with friction is neutral at 1/J = 0, which grain_kinds gives.
    Simulation& run = bench.start(2e-5, effects);
    run.steps(4000);
    EXPECT_GT(run.census().contacts, 10000);
    EXPECT_FALSE(run.guard().stop_reason()) << *run.guard().stop_reason();
    return run.grains();
  };
  const Grains special = end(false), all = end(true);
  ASSERT_EQ(special.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(special.x[i], all.x[i]) << i;
    ASSERT_EQ(special.y[i], all.y[i]) << i;
    ASSERT_EQ(special.vx[i], all.vx[i]) << i;
    ASSERT_EQ(special.vy[i], all.vy[i]) << i;
    if (special.rotation) {
      ASSERT_EQ(special.omega[i], all.omega[i]) << i;
    }
  }
}

TEST(Effects, SpecialisedKernelsAgreeWithTheAllEffectsKernelToTheBit) {
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint})
    for (int set = 0; set < 32; ++set) {
      const Chosen chosen{(set & 1) != 0, (set & 2) != 0, (set & 4) != 0, (set & 8) != 0, (set & 16) != 0};
      if (chosen.rotation && !chosen.friction) continue;
      SCOPED_TRACE(testing::Message() << "set " << set);
      expect_same_trajectories(chosen, integrator);
    }
}

TEST(Effects, AreDerivedFromTheScene) {
  Bench bench;
  EXPECT_EQ(effect_names(effects_of(bench.scene)), std::vector<std::string>{});
  bench.scene.contact.wall.friction = 0.1;
  bench.scene.contact.drag = 1e-3;
  bench.scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  EXPECT_EQ(effect_names(effects_of(bench.scene)),
            (std::vector<std::string>{"friction", "rotation", "drag", "motion"}));
  bench.scene.contact.rotation = false;
  bench.scene.contact.seed.restitution = 0.9;
  bench.scene.lots.push_back({"b", 0.01, 1e-3, Shape::disc, 0.5});
  EXPECT_EQ(effect_names(effects_of(bench.scene)),
            (std::vector<std::string>{"friction", "damping", "unequal", "drag", "motion"}));
  std::get<HarmonicMotion>(*bench.scene.tray.motion).amplitude = 0;  // a key at its neutral value
  EXPECT_FALSE(effects_of(bench.scene).motion);
}

TEST(Effects, AbsentOnesHaveNoArrays) {
  Bench bench;
  bench.place(0.5, 0.5);
  Simulation& run = bench.start(1e-5);
  EXPECT_TRUE(run.grains().omega.empty());
  EXPECT_TRUE(run.grains().radius.empty());
  EXPECT_TRUE(run.field().forces().torque.empty());
}

TEST(Effects, EveryRegisteredSetIsFoundAndDistinct) {
  for (const KernelSet& set : registered_kernels()) {
    const EffectSet wanted{set.friction, set.rotation, set.damping, set.unequal, false, false};
    EXPECT_EQ(kernels_for(set.law, wanted).pair, set.pair);
  }
  EXPECT_EQ(registered_kernels().size(), 12u);
}

}  // namespace
}  // namespace vibrosow
