#include "study/predicted_cost.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input/read_scene.hpp"
#include "plan/predicted_grains.hpp"
#include "simulation/state.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

// What a machine takes decides no test; that every figure is there does.

std::vector<std::string> names_of(const std::vector<EffectCost>& effects) {
  std::vector<std::string> names;
  for (const EffectCost& effect : effects) names.push_back(effect.effect);
  return names;
}

Scene small_scene(const StudyFiles& files, const std::vector<Override>& overrides) {
  return read_scene(files.study("").parent_path() / "seeder.toml", overrides);
}

TEST(PredictedCost, EveryEffectThatCanBeLeftOutHasAMetric) {
  const StudyFiles files;
  const Scene scene = small_scene(
      files, {parse_override("contact.friction_model=\"spring\""), parse_override("contact.rolling=\"spring\""),
              parse_override("contact.rolling_friction=0.05"), parse_override("contact.cohesion=\"1 uN\""),
              parse_override("contact.drag=\"0.01 g/s\""), parse_override("tray.motion.kind=\"rocking\""),
              parse_override("tray.motion.pivot=[\"25 cm\", \"0 cm\"]"),
              parse_override("tray.motion.angle=\"2 degree\""), parse_override("tray.motion.frequency=\"9 Hz\"")});
  const Model model = prepare(scene);
  const CostBreakdown cost = break_down_cost(model, starting_state(model, 1).grains);
  EXPECT_THAT(names_of(cost.effects), testing::ElementsAre("friction", "tangential spring", "rotation", "rolling",
                                                           "damping", "cohesion", "drag"));
  EXPECT_GT(cost.whole.ns_per_grain_step, 0);
  EXPECT_DOUBLE_EQ(cost.whole.seconds(), 1e-9 * cost.whole.ns_per_grain_step * cost.whole.grain_steps);
  for (const EffectCost& effect : cost.effects) EXPECT_GT(effect.half_width_95, 0);
}

TEST(PredictedCost, OneWithinItsScatterIsNotResolved) {
  EXPECT_FALSE((EffectCost{"rotation", 0.9, 1.0}.is_resolved()));
  EXPECT_FALSE((EffectCost{"rotation", -2.0, 1.0}.is_resolved()));
  EXPECT_TRUE((EffectCost{"friction", 1.1, 1.0}.is_resolved()));
}

TEST(PredictedCost, AStudyTakesItsReplicates) {
  const StudyFiles files;
  const Study study = read_study(files.study("replicates = 4\n[vary]\ntray.holes.count = [1, 3]\n"));
  EXPECT_GT(predict_seconds(study), 0);
}

TEST(PredictedCost, TheUsualIsOfGrainStepsAndTheBallsOfASeed) {
  const StudyFiles files;
  const auto a_grain_step = [&](const std::vector<Override>& overrides) {
    const Scene scene = small_scene(files, overrides);
    return usual_seconds(scene) / predicted_grain_steps(scene, prepare(scene).step.dt);
  };
  const Override space = parse_override("space=3d");
  const double disc = a_grain_step({}), ball = a_grain_step({space});
  EXPECT_GT(ball, disc);
  const double grains =
      a_grain_step({space, parse_override("seeds.wheat.shape=dipole"), parse_override("seeds.wheat.distance=2 mm")});
  EXPECT_NEAR(grains, 2 * ball, 1e-6 * ball);
}

}  // namespace
}  // namespace vibrosow
