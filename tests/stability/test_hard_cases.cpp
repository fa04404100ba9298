// What breaks a discrete-element code and can be known before or soon: refused with a reason, or stopped with one.
#include <cmath>
#include <numbers>

#include "plan/step_plan.hpp"
#include "scene/input_error.hpp"
#include "stability/bounds.hpp"

namespace vibrosow {
namespace {

class Refusal : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(Stability, Refusal, testing::ValuesIn(settings()), named_by_setting);

/// m; so that some hundred grains lie in a few layers.
double tray_length(const Setting& setting) {
  return setting.is_3d() ? 0.034 : 0.1;
}

void expect_refusal(const Bounds& bounds, const Scene& scene, const std::string& because) {
  std::string reason = "it was run";
  try {
    simulate(scene);
  } catch (const InputError& error) {
    reason = error.what();
  }
  EXPECT_NE(reason.find(because), std::string::npos) << reason;
  bounds.just("refused with its reason", reason.find(because) != std::string::npos ? 1 : 0, 1);
}

TEST_P(Refusal, OfAnOverlappingStart) {
  Scene scene = tray_scene(GetParam(), 200, tray_length(GetParam()));
  Vessel hopper = scene.tray;
  hopper.name = "hopper";
  hopper.origin = {0, 0.03};  // in the midst of the tray's bed
  hopper.height = 0.4;
  scene.hopper = hopper;
  scene.run.duration = 0.01;
  expect_refusal(Bounds("overlapping start that nobody asked for", GetParam(), scene.contact), scene, "overlap");
}

TEST_P(Refusal, OfAStepTooLongForTheShellAndInsistedOnItIsStopped) {
  Scene scene = tray_scene(GetParam(), 100, tray_length(GetParam()));
  scene.contact.seed = scene.contact.wall = {0, 1};
  scene.numerics.dt = 1.2 * prepare(scene).step.contact_duration;
  scene.run.duration = 0.5;
  EXPECT_THROW(simulate(scene), InputError);
  scene.numerics.allow_long_step = true;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::stopped_by_guard);
  const Bounds bounds("step too long for the shell, insisted on", GetParam(), scene.contact);
  bounds.stopped(run.stop_reason, "", run.balance);
  bounds.just("marked as outside the model", run.outside_the_model ? 1 : 0, 1);
}

class EnergyGuard : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Stability, EnergyGuard, testing::ValuesIn(both_spaces), named_by_space);

TEST_P(EnergyGuard, StopsAStepThatMakesEnergy) {
  const Setting setting{GetParam(), Integrator::rk2_midpoint};
  // Midpoint RK2 at z = 1 multiplies a free vibration by 1.11 each step; shells far from the guard's limit.
  Scene scene = tray_scene(setting, 30, setting.is_3d() ? tray_length(setting) : 0.085);
  scene.contact.seed = scene.contact.wall = {0, 1};
  scene.numerics.dt = 0.99 * prepare(scene).step.contact_duration / std::numbers::pi;
  scene.numerics.allow_long_step = true;
  scene.guard.stop_relative_overlap = 100;
  scene.run.duration = 0.5;
  const vibrosow::Run run = simulate(scene);
  EXPECT_EQ(run.status, RunStatus::stopped_by_guard);
  Bounds("step that makes energy", setting, scene.contact).stopped(run.stop_reason, "numerics made", run.balance);
}

TEST_P(Refusal, OfAStepTooLongForFrictionNamesTheLongestAllowed) {
  Scene scene = tray_scene(GetParam(), 400, GetParam().is_3d() ? tray_length(GetParam()) : 0.085);
  scene.contact.slip_speed = 1e-3;
  scene.numerics.dt = GetParam().scheme == Integrator::gear5 ? 4e-6 : 2e-5;
  scene.run.duration = 0.1;
  const StepPlan plan = prepare(scene).step;
  EXPECT_TRUE(plan.too_long);
  EXPECT_EQ(plan.bound_by, "friction below the slip speed");
  expect_refusal(Bounds("step too long for friction", GetParam(), scene.contact), scene,
                 "friction below the slip speed");
}

}  // namespace
}  // namespace vibrosow
