#include "study/evaluate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;

Model small_model(const StudyFiles& files) {
  return prepare(read_scene(files.write("scene.toml", "").parent_path() / "seeder.toml"));
}

SimulationOptions with_random_seed(std::uint64_t random_seed) {
  SimulationOptions options;
  options.random_seed = random_seed;
  return options;
}

TEST(Evaluate, KeepsWhatHolesGaveAndTheCurvesAskedFor) {
  const StudyFiles files;
  const Model model = small_model(files);
  const std::vector<CurveRequest> wanted = {{Discharge::seeds, "2", "all", {1, 3, 4}},
                                            {Discharge::fraction, "all", "wheat", {4}}};
  const Evaluation evaluation = evaluate(model, with_random_seed(4), wanted, quick_run);
  EXPECT_TRUE(evaluation.finished());
  EXPECT_EQ(evaluation.random_seed, 4u);
  EXPECT_EQ(evaluation.grain_steps, 12000);
  EXPECT_FALSE(evaluation.tray_empty_since);
  // Holes 1 to 3 give 14, 24 and 34 seeds between 2 and 4 s.
  EXPECT_EQ(evaluation.balance.counted, 72);
  EXPECT_DOUBLE_EQ(find_row(evaluation.outflow, "3", "all")->seeds_per_s, 17);
  ASSERT_EQ(evaluation.curves.size(), 2u);
  EXPECT_EQ(evaluation.curves[0].request, wanted[0]);
  EXPECT_THAT(evaluation.curves[0].values, ElementsAre(0, 12, 24));
  EXPECT_THAT(evaluation.curves[1].values, ElementsAre(testing::DoubleNear(72.0 / 40, 1e-12)));
}

TEST(Evaluate, ARunCutShortKeepsItsMetricsAndItsReason) {
  const StudyFiles files;
  const Simulator dry_and_stopped = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = quick_run(model, options);
    run.status = RunStatus::stopped_by_guard;
    run.stop_reason = "relative overlap 0.6";
    run.tray_empty_since = 3;
    run.end_time = 3.5;
    return run;
  };
  const Evaluation evaluation =
      evaluate(small_model(files), with_random_seed(2), {{Discharge::seeds, "all", "all", {3, 4}}}, dry_and_stopped);
  EXPECT_EQ(evaluation.status, EvaluationStatus::stopped);
  EXPECT_TRUE(evaluation.was_run());
  EXPECT_EQ(evaluation.reason, "relative overlap 0.6");
  EXPECT_EQ(evaluation.tray_empty_since, 3);
  EXPECT_EQ(evaluation.curves[0].values[0], 33);  // half of 12, 22 and 32
  EXPECT_TRUE(std::isnan(evaluation.curves[0].values[1]));
}

TEST(Evaluate, WhatTheSimulatorRefusesIsAReasonAndNoMetrics) {
  const StudyFiles files;
  const Simulator refusing = [](const Model&, const SimulationOptions&) -> vibrosow::Run {
    throw InputError("the fill does not fit");
  };
  const Evaluation evaluation = evaluate(small_model(files), with_random_seed(7), {}, refusing);
  EXPECT_EQ(evaluation.status, EvaluationStatus::refused);
  EXPECT_FALSE(evaluation.was_run());
  EXPECT_EQ(evaluation.reason, "the fill does not fit");
  EXPECT_EQ(evaluation.random_seed, 7u);
}

}  // namespace
}  // namespace vibrosow
