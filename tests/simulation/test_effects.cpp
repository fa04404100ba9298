// Specialised kernels against the all-effects kernel at neutral values: the same trajectories, compared with ==.
#include <gtest/gtest.h>

#include "plan/effects.hpp"
#include "plan/model.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

struct Chosen {
  bool friction, rotation, damping, drag, motion, cohesion;
  FrictionModel model = FrictionModel::sliding;
  Rolling rolling = Rolling::none;
  Law law = Law::elastic_shell;
};

Bench crowded_bench(const Chosen& chosen) {
  Bench bench;
  bench.gravity = {0, -standard_gravity};
  bench.scene.tray.length = 0.06;
  bench.scene.tray.holes = {{0.03, 0.01}};
  Contact& contact = bench.scene.contact;
  contact.law = chosen.law;
  contact.youngs_modulus = 1e7;
  contact.poisson_ratio = 0.2;
  contact.damping_rate = chosen.law == Law::hertz_viscous && chosen.damping ? 300 : 0;
  const bool restitutes = chosen.damping && chosen.law != Law::hertz_viscous;
  contact.seed = contact.wall = {chosen.friction ? 0.3 : 0.0, restitutes ? 0.5 : 1.0,
                                 chosen.rolling == Rolling::none ? 0.0 : 0.05, chosen.cohesion ? 2e-3 : 0.0};
  contact.friction_model = chosen.model;
  contact.rolling = chosen.rolling;
  contact.rotation = chosen.rotation;
  contact.drag = chosen.drag ? 1e-3 : 0.0;
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
    EffectSet effects = prepare(bench.scene).effects;
    if (all) {
      if (!effects.friction) effects.tangential_spring = chosen.model == FrictionModel::spring;
      effects = all_pair_effects(effects);
      effects.drag = effects.motion = true;
    }
    // Rotation left out of a scene with friction is neutral at 1/J = 0.
    Simulation& run = bench.start(2e-5, effects);
    run.steps(3000);
    EXPECT_GT(run.statistics().contacts, 5000);
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
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::rk2_midpoint, Integrator::gear5})
    for (int set = 0; set < 32; ++set) {
      const Chosen chosen{(set & 1) != 0, (set & 2) != 0, (set & 4) != 0, (set & 8) != 0, (set & 16) != 0, false};
      if (chosen.rotation && !chosen.friction) continue;
      SCOPED_TRACE(testing::Message() << "set " << set);
      expect_same_trajectories(chosen, integrator);
    }
}

TEST(Effects, EveryLawAndKindOfFrictionAndRollingAgreesWithItsAllEffectsKernelToTheBit) {
  for (const Law law : {Law::elastic_shell, Law::hertz, Law::hertz_viscous})
    for (const FrictionModel model : {FrictionModel::sliding, FrictionModel::spring})
      for (const Rolling rolling : {Rolling::none, Rolling::constant_torque, Rolling::spring})
        for (const bool cohesion : {false, true})
          for (const bool damping : {false, true}) {
            SCOPED_TRACE(testing::Message() << "law " << int(law) << " model " << int(model) << " rolling "
                                            << int(rolling) << " cohesion " << cohesion << " damping " << damping);
            expect_same_trajectories({true, true, damping, false, false, cohesion, model, rolling, law},
                                     Integrator::velocity_verlet);
          }
}

TEST(Effects, AreDerivedFromTheScene) {
  Bench bench;
  EXPECT_EQ(effect_names(prepare(bench.scene).effects), std::vector<std::string>{});
  bench.scene.contact.wall.friction = 0.1;
  bench.scene.contact.drag = 1e-3;
  bench.scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  EXPECT_EQ(effect_names(prepare(bench.scene).effects),
            (std::vector<std::string>{"friction", "rotation", "drag", "motion"}));
  bench.scene.contact.rotation = false;
  bench.scene.contact.seed.restitution = 0.9;
  bench.scene.lots.push_back({"b", 0.01, 1e-3, Shape::disc, 0.5});
  EXPECT_EQ(effect_names(prepare(bench.scene).effects),
            (std::vector<std::string>{"friction", "damping", "polydisperse", "drag", "motion"}));
  std::get<HarmonicMotion>(*bench.scene.tray.motion).amplitude = 0;  // a key at its neutral value
  EXPECT_FALSE(prepare(bench.scene).effects.motion);
}

TEST(Effects, AbsentOnesHaveNoArrays) {
  Bench bench;
  bench.place(0.5, 0.5);
  Simulation& run = bench.start(1e-5);
  EXPECT_TRUE(run.grains().omega.empty());
  EXPECT_TRUE(run.grains().radius.empty());
}

TEST(Effects, EveryRegisteredSetIsFoundAndDistinct) {
  for (const KernelSet& set : registered_kernels()) {
    EffectSet wanted;
    const EffectChoice& effects = set.effects;
    wanted.friction = effects.friction != FrictionChoice::none;
    wanted.tangential_spring = effects.friction == FrictionChoice::spring;
    wanted.rotation = effects.rotation, wanted.damping = effects.damping, wanted.polydisperse = effects.polydisperse;
    wanted.rolling = effects.rolling, wanted.cohesion = effects.cohesion;
    EXPECT_EQ(&kernels_for(set.law, wanted), &set);
  }
  EXPECT_EQ(registered_kernels().size(), 3u * 46u);
}

}  // namespace
}  // namespace vibrosow
