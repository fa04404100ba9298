#include "accuracy/accuracy_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "input/read_scene.hpp"
#include "support/study_files.hpp"

namespace vibrosow::accuracy_settings_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

Scene scene_of(const StudyFiles& files, const std::vector<Override>& overrides = {}) {
  return read_scene(files.write("scene.toml", "").parent_path() / "seeder.toml", overrides);
}

TEST(AccuracySettings, DefaultsReachBeyondTheSceneToBothSides) {
  const StudyFiles files;
  const Scene scene = scene_of(files, {parse_override("contact.shell_compression=1e-5")});
  const AccuracyGrid grid = default_accuracy_grid(scene);
  ASSERT_GE(grid.shell_compressions.size(), 3u);
  EXPECT_DOUBLE_EQ(grid.shell_compressions[0], 1e-6);
  EXPECT_DOUBLE_EQ(grid.shell_compressions[1], 1e-5);
  EXPECT_GT(grid.shell_compressions[2], 2e-5);
  EXPECT_THAT(grid.slip_speeds, ElementsAre(DoubleNear(0.01, 1e-12), DoubleNear(0.08, 1e-12)));
  EXPECT_DOUBLE_EQ(grid.steps_per_contact.back(), 48);
}

TEST(AccuracySettings, ALongerWindowIsTakenOnlyWhereItIsLikeTheScenesOwn) {
  const StudyFiles files;
  Scene scene = scene_of(files);
  ASSERT_TRUE(scene.tray.fill);
  EXPECT_THAT(windows_alike(scene), ElementsAre(1)) << "a fill empties";
  scene.tray.fill->keep = true;
  EXPECT_THAT(windows_alike(scene), ElementsAre(1, 2, 4));
  const double end = scene.run.duration, window = end - scene.run.measure_from;
  scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 9, .stop = end};
  EXPECT_THAT(windows_alike(scene), ElementsAre(1));
  scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 9, .stop = end + 1.5 * window};
  EXPECT_THAT(windows_alike(scene), ElementsAre(1, 2));
  scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 9};
  scene.tray.holes.back().open_at = end + 0.5 * window;
  EXPECT_THAT(windows_alike(scene), ElementsAre(1));
}

TEST(AccuracySettings, NoDefaultIsPredictedUnsoundOrTooLong) {
  const StudyFiles files;
  for (const char* softness : {"contact.shell_compression=1e-4", "contact.shell_compression=0.03"}) {
    const Scene scene = scene_of(files, {parse_override(softness), parse_override("contact.friction_model=spring")});
    AccuracyDesign design = full_design(default_accuracy_grid(scene));
    for (AccuracySetting& setting : design.settings) {
      const Model model = prepare(scene_with(scene, setting));
      EXPECT_FALSE(step_refused(model.scene.numerics, model.step)) << setting.steps_per_contact;
      if (setting.shell_compression > scene.contact.shell_compression * 1.01) {
        EXPECT_LE(model.overlap.overlap_at_impact, 0.16);
      }
    }
  }
}

TEST(AccuracySettings, SlipSpeedIsLeftOutWhereFrictionHasNone) {
  const StudyFiles files;
  const Override spring = parse_override("contact.friction_model=spring");
  const Override smooth = parse_override("contact.friction=0");
  const std::vector<Override> rolling = {spring, parse_override("contact.rolling=constant-torque"),
                                         parse_override("contact.rolling_friction=0.1")};
  EXPECT_THAT(default_accuracy_grid(scene_of(files, {spring})).slip_speeds, testing::IsEmpty());
  EXPECT_THAT(default_accuracy_grid(scene_of(files, {smooth})).slip_speeds, testing::IsEmpty());
  EXPECT_EQ(default_accuracy_grid(scene_of(files, rolling)).slip_speeds.size(), 2u);
}

TEST(AccuracySettings, ThriftyDesignRunsEveryLevelAndTheFinestSetting) {
  const StudyFiles files;
  const AccuracyGrid grid = default_accuracy_grid(scene_of(files));
  const AccuracyDesign design = screening_design(grid), full = full_design(grid);
  ASSERT_EQ(design.settings.size(), full.settings.size());
  const int runs = std::accumulate(design.runs.begin(), design.runs.end(), 0);
  EXPECT_LT(runs, 3 * static_cast<int>(full.runs.size()) / 2);
  const auto runs_of = [&](auto is) {
    int sum = 0;
    for (std::size_t i = 0; i < design.settings.size(); ++i)
      if (is(design.settings[i])) sum += design.runs[i];
    return sum;
  };
  for (const double compression : grid.shell_compressions)
    EXPECT_GE(runs_of([&](const AccuracySetting& s) { return s.shell_compression == compression; }), 2);
  for (const double slip_speed : grid.slip_speeds)
    EXPECT_GE(runs_of([&](const AccuracySetting& s) { return s.slip_speed == slip_speed; }), 5);
  for (const Integrator integrator : grid.integrators)
    for (const double steps : {grid.steps_per_contact.front(), grid.steps_per_contact.back()})
      EXPECT_GE(
          runs_of([&](const AccuracySetting& s) { return s.integrator == integrator && s.steps_per_contact == steps; }),
          1);
  EXPECT_EQ(runs_of([&](const AccuracySetting& s) {
              return s.integrator == grid.integrators[0] && s.shell_compression == grid.shell_compressions[0] &&
                     s.slip_speed == grid.slip_speeds[0] && s.steps_per_contact == grid.steps_per_contact.end()[-2];
            }),
            1);
}

TEST(AccuracySettings, OnlyWhatCanBeRunIsLeftOfADesign) {
  const StudyFiles files;
  const Scene scene = scene_of(files);
  AccuracyGrid grid = default_accuracy_grid(scene);
  grid.integrators = {Integrator::velocity_verlet};
  grid.steps_per_contact = {2, 40};
  const AccuracyDesign design = runnable(scene, full_design(grid));
  ASSERT_EQ(design.settings.size(), full_design(grid).settings.size() / 2);
  EXPECT_EQ(design.runs.size(), design.settings.size());
  for (const AccuracySetting& setting : design.settings) EXPECT_EQ(setting.steps_per_contact, 40);
}

TEST(AccuracySettings, ALongerWindowBeginsWithTheScenes) {
  const StudyFiles files;
  const Scene scene = scene_of(files);
  std::vector<AccuracySetting> settings(1);
  settings[0].shell_compression = 1e-3;
  SweepOptions options;
  options.runs.jobs = 1;
  std::vector<double> durations;
  SettingRunner runner(
      scene, settings,
      [&](const Model& model, const SimulationOptions& simulation) {
        durations.push_back(model.scene.run.duration);
        EXPECT_DOUBLE_EQ(model.scene.run.measure_from, 2);
        return quick_run(model, simulation);
      },
      options);
  runner.run({{0, 1, 1}, {0, 1, 3}});
  EXPECT_THAT(durations, ElementsAre(4, 8));
}

}  // namespace
}  // namespace vibrosow::accuracy_settings_test
