#include "accuracy/depth_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "accuracy/accuracy_doubts.hpp"
#include "input/read_scene.hpp"
#include "support/study_files.hpp"

namespace vibrosow::depth_error_test {
namespace {

SweepOptions one_job() {
  SweepOptions options;
  options.runs.jobs = 1;
  return options;
}

/// In 3D twelve times what the plane's slice sows; the tray has fifteen slices.
Run slow_3d(const Model& model, const SimulationOptions& options) {
  Run run = quick_run(model, options);
  if (model.scene.space == Space::two_dimensional) return run;
  const std::vector<OutflowEvent> once = run.events;
  for (int times = 1; times < 12; ++times) run.events.insert(run.events.end(), once.begin(), once.end());
  std::ranges::stable_sort(run.events, {}, &OutflowEvent::time);
  return run;
}

TEST(DepthError, IsThePlanesTrayAgainstTheTray3d) {
  const StudyFiles files;
  const auto [plane, space] = read_in_both_spaces(files.seeder());
  const auto found = measure_depth_error(plane, space, 3, slow_3d, one_job());
  ASSERT_TRUE(found);
  // 63, 66 and 69 seeds of 40 mg in 2 s, by random seed; Student's t of two degrees of freedom is 4.3027.
  const double slice = 33 * 40e-6, relative = 4.3027 * 3 / std::sqrt(3.0) / 66;
  EXPECT_NEAR(found->plane.mean, 15 * slice, 1e-9);
  EXPECT_NEAR(found->space.mean, 12 * slice, 1e-9);
  EXPECT_NEAR(found->error.percent, 25, 1e-9);
  EXPECT_NEAR(found->error.band, 125 * std::sqrt(2.0) * relative, 1e-3);
}

TEST(DepthError, NoneOfRunsOutsideTheModel) {
  const StudyFiles files;
  const auto [plane, space] = read_in_both_spaces(files.seeder());
  const Simulator outside = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = slow_3d(model, options);
    run.outside_the_model = model.scene.space == Space::three_dimensional;
    return run;
  };
  EXPECT_FALSE(measure_depth_error(plane, space, 2, outside, one_job()));
}

TEST(DepthError, CarriesTheDoubtsOfItsRuns) {
  const StudyFiles files;
  const auto [plane, space] = read_in_both_spaces(files.seeder());
  const Simulator warned = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = slow_3d(model, options);
    if (model.scene.space == Space::three_dimensional && options.random_seed == 2)
      run.warnings.push_back({DoubtKind::guard_warned, "deep"});
    return run;
  };
  AccuracyResult result;
  result.depth = measure_depth_error(plane, space, 3, warned, one_job());
  ASSERT_TRUE(result.depth);
  std::vector<std::string> texts;
  for (const SharedDoubt& doubt : doubts_about(result, plane)) texts.push_back(remark_of(doubt).text);
  EXPECT_THAT(texts,
              testing::Contains("of the runs in 3D for the error of the depth: the guard warned in 1 of 3 runs"));
}

/// Else a tray that lets out nothing in 2D would err by -100 +- 0 %.
TEST(DepthError, NoneWhereNothingFlows) {
  const StudyFiles files;
  const auto [plane, space] = read_in_both_spaces(files.seeder());
  const Simulator dry_in_2d = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = slow_3d(model, options);
    if (model.scene.space == Space::two_dimensional) run.events.clear();
    return run;
  };
  EXPECT_FALSE(measure_depth_error(plane, space, 3, dry_in_2d, one_job()));
}

TEST(DepthError, NeedsTwoRuns) {
  const StudyFiles files;
  const auto [plane, space] = read_in_both_spaces(files.seeder());
  EXPECT_THROW(measure_depth_error(plane, space, 1, slow_3d, one_job()), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow::depth_error_test
