#include "calibration/bench_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "grains/random.hpp"
#include "scene/input_error.hpp"
#include "support/runs_on_demand.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

/// Seeds that leave in the window: through holes of 12 mm friction decides, of 20 mm nothing does.
Run made_up_run(const Model& model, const SimulationOptions& options) {
  Random random(options.random_seed);
  const double chance = quantile(boost::math::normal(), 1e-9 + (1 - 2e-9) * random.uniform());
  const double width = model.scene.tray.holes.front().width;
  const double minds = (0.020 - width) / 0.008;
  const auto seeds = std::llround(400 * std::exp(-minds * model.scene.contact.seed.friction) * (1 + 0.01 * chance));
  Run run;
  run.random_seed = options.random_seed;
  run.dt = 1e-3, run.steps = 4000, run.end_time = 4;
  for (std::int64_t i = 0; i < seeds; ++i)
    run.events.push_back({2 + 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(seeds), 1, 0, i,
                          model.scene.lots[0].mass, 0.1, 0.5});
  run.balance.put_in = run.balance.counted = seeds;
  return run;
}

class BenchPlanOf : public testing::Test {
 protected:
  BenchPlanOf() {
    task_.seeder = files_.seeder();
    task_.overrides = {parse_override("tray.holes.count=1"), parse_override("tray.fill.keep=true")};
    task_.keys = {parse_fitted_key("contact.friction=0.1..0.8"), parse_fitted_key("contact.restitution=0.2..0.9")};
    task_.measured.table = bench_candidates({parse_setting("tray.holes.width=12 mm..20 mm")});
  }
  BenchPlan plan(const BenchLimits& limits, MeasuredScale scale = MeasuredScale::none,
                 const Simulator& simulator = made_up_run) {
    task_.measured.scale = scale;
    task_.most_runs = 60;
    const CalibrationDesign design = design_bench(task_, std::make_shared<SourceFiles>());
    return *plan_bench(task_, design, limits, runs_on_demand(wanted_runs(design), simulator));
  }
  StudyFiles files_;
  CalibrationTask task_;
};

TEST_F(BenchPlanOf, TakesFirstWhatTellsMost) {
  const BenchPlan all = plan({});
  ASSERT_EQ(all.candidates.size(), 3U);
  EXPECT_EQ(all.candidates[0].place, 1);
  EXPECT_GT(all.contraction[0], 0.9);
  EXPECT_LT(all.contraction[1], 0.2);
  EXPECT_EQ(all.repeats, 3);
}

TEST_F(BenchPlanOf, LeavesRunsOutsideTheModelOut) {
  const auto quarter_outside = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = made_up_run(model, options);
    run.outside_the_model = model.scene.contact.seed.friction > 0.6;
    if (run.outside_the_model) run.events.resize(run.events.size() / 4);
    return run;
  };
  const double sound = plan({}).candidates[0].mass_rate;
  EXPECT_NEAR(plan({}, MeasuredScale::none, quarter_outside).candidates[0].mass_rate, sound, 0.1 * sound);
}

TEST_F(BenchPlanOf, TellsWhatSpeaksAgainstItsRuns) {
  const auto warned = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = made_up_run(model, options);
    run.warnings = {{DoubtKind::guard_warned, "overlaps were deep"}};
    return run;
  };
  const auto about_it = [](const SharedDoubt& doubt) { return doubt.kind == DoubtKind::guard_warned; };
  EXPECT_TRUE(std::ranges::none_of(plan({}).doubts, about_it));
  const BenchPlan of_warned = plan({}, MeasuredScale::none, warned);
  const auto found = std::ranges::find_if(of_warned.doubts, about_it);
  ASSERT_NE(found, of_warned.doubts.end());
  EXPECT_GT(found->runs, 0);
  EXPECT_EQ(found->runs, found->of);
}

/// Seeds that fall by exp(-slope part) along friction's range, under all widths alike but for their slopes; so many
/// that their rounding counts for nothing.
Run exact_run(const Model& model, const SimulationOptions& options) {
  const double part = (model.scene.contact.seed.friction - 0.1) / 0.7;
  const double slope = 250 * model.scene.tray.holes.front().width - 2;  // 1, 2 and 3 of 12, 16 and 20 mm
  const auto seeds = std::llround(2e4 * std::exp(-slope * part));
  Run run;
  run.random_seed = options.random_seed;
  run.dt = 1e-3, run.steps = 4000, run.end_time = 4;
  for (std::int64_t i = 0; i < seeds; ++i)
    run.events.push_back({2 + 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(seeds), 1, 0, i,
                          model.scene.lots[0].mass, 0.1, 0.5});
  run.balance.put_in = run.balance.counted = seeds;
  return run;
}

/// Information adds up: 12 of a flat prior over the range, and of each reading its squared slope over its variance.
TEST_F(BenchPlanOf, ItsContractionIsThatOfTheReadingsInformation) {
  task_.keys.resize(1);
  BenchLimits limits;
  limits.noise = 0.3;
  const BenchPlan all = plan(limits, MeasuredScale::none, exact_run);
  ASSERT_EQ(all.chosen().size(), 3U);
  ASSERT_EQ(all.repeats, 3);
  for (const BenchCandidate& one : all.candidates) EXPECT_NEAR(one.chance, 0.3, 1e-3);
  const double information = 12 + 3 * (1 + 4 + 9) / (0.3 * 0.3);
  EXPECT_NEAR(all.contraction.at(0), 1 - std::sqrt(12 / information), 2e-3);
  // With a factor that nobody knows but for three times less or more: 1 / 1.1^2 and what readings and slopes add.
  const BenchPlan scaled = plan(limits, MeasuredScale::free, exact_run);
  const double of_factor = 1 / (1.1 * 1.1) + 3 * 3 / 0.09, across = 3 * (1 + 2 + 3) / 0.09;
  EXPECT_NEAR(scaled.contraction.at(0), 1 - std::sqrt(12 / (information - across * across / of_factor)), 5e-3);
}

/// By a thirty-fifth of what flows, in a way that depends on the random seed alone.
Run scattered_run(const Model& model, const SimulationOptions& options) {
  Run run = exact_run(model, options);
  const double chance = 0.1 * static_cast<double>((7 * options.random_seed) % 5) / 5;  // deviation 0.1 sqrt(2) / 5
  run.events.resize(static_cast<std::size_t>((1 - chance) * static_cast<double>(run.events.size())));
  return run;
}

/// A reading scatters by the flow's chance as far as the time in which it is caught is longer than a run's window, and
/// by its own noise.
TEST_F(BenchPlanOf, ALongerCatchHasLessChance) {
  BenchLimits limits;
  limits.noise = 1e-3;
  const BenchPlan all = plan(limits, MeasuredScale::none, scattered_run);
  ASSERT_GE(all.catch_time, 10);
  const double expected = 0.1 * std::sqrt(2.0) / 5 * std::sqrt(2 / all.catch_time);  // the window is of 2 s
  for (const BenchCandidate& one : all.candidates) EXPECT_NEAR(one.chance, expected, 0.35 * expected);
}

/// What is read is compared with runs that scatter too: a trend of two numbers from 150 runs of three conditions.
TEST_F(BenchPlanOf, ItsContractionAllowsForTheChanceOfTheRunsThatAreFitted) {
  task_.keys.resize(1);
  BenchLimits limits;
  limits.noise = 1e-3;
  const BenchPlan all = plan(limits, MeasuredScale::none, scattered_run);
  ASSERT_EQ(all.chosen().size(), 3U);
  const double flow = 0.1 * 0.1 * 2 / 25, window = 2;  // s
  const double variance = (flow * window / all.catch_time + 1e-6) / 3 + flow * 2 / 50;
  const double expected = std::sqrt(12 / (12 + (1 + 4 + 9) / variance));
  EXPECT_NEAR(1 - all.contraction.at(0), expected, 0.3 * expected);
  const double without_runs = std::sqrt(12 / (12 + (1 + 4 + 9) / (variance - flow * 2 / 50)));
  EXPECT_GT(1 - all.contraction.at(0), 1.2 * without_runs);
}

/// Every fourth condition is predicted by calibrate and not fitted: it narrows nothing.
TEST_F(BenchPlanOf, ItsContractionIsWithoutWhatIsHeldOut) {
  task_.keys.resize(1);
  task_.measured.table =
      bench_candidates({parse_setting("tray.holes.width=12 mm..20 mm"), parse_setting("tray.depth=5 cm..7 cm")});
  BenchLimits limits;
  limits.noise = 0.3, limits.time = 3600;
  const BenchPlan all = plan(limits, MeasuredScale::none, exact_run);
  ASSERT_EQ(all.chosen().size(), 9U);
  ASSERT_EQ(all.repeats, 3);
  // The steepest are chosen first, three of each slope; the fourth is of slope 2, the eighth of slope 1.
  const double expected = std::sqrt(12 / (12 + 3 * (3 * 9 + 2 * 4 + 2 * 1) / 0.09));
  EXPECT_NEAR(1 - all.contraction.at(0), expected, 0.02 * expected);
}

/// With an unknown factor one condition alone tells nothing: the two that differ most do.
TEST_F(BenchPlanOf, NeedsTwoConditionsForARateUpToAFactor) {
  BenchLimits limits;
  limits.time = 4 * (limits.handling + 15);  // four readings
  const BenchPlan two = plan(limits, MeasuredScale::free);
  ASSERT_EQ(two.chosen().size(), 2U);
  EXPECT_TRUE(two.candidates[0].place);
  EXPECT_TRUE(two.candidates[2].place);
  EXPECT_EQ(two.repeats, 2);
}

TEST_F(BenchPlanOf, StaysWithinItsTime) {
  for (const double minutes : {5.0, 10.0, 30.0}) {
    BenchLimits limits;
    limits.time = 60 * minutes;
    const BenchPlan planned = plan(limits);
    EXPECT_LE(planned.readings() * (planned.catch_time + limits.handling), limits.time);
  }
  BenchLimits limits;
  limits.time = 60;
  EXPECT_THROW(plan(limits), InputError);
}

/// A setting under which most runs are stopped up is not asked for; what flows under others tells of theirs.
TEST_F(BenchPlanOf, LeavesOutASettingUnderWhichMostRunsClog) {
  const auto narrow_clogs = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = made_up_run(model, options);
    if (model.scene.tray.holes.front().width < 0.013) run.events.clear(), run.balance.counted = 0;
    return run;
  };
  const BenchPlan planned = plan({}, MeasuredScale::none, narrow_clogs);
  EXPECT_FALSE(planned.candidates[0].place);
  EXPECT_TRUE(planned.candidates[1].place);
  const auto all_clog = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = made_up_run(model, options);
    run.events.clear(), run.balance.counted = 0;
    return run;
  };
  EXPECT_THROW(plan({}, MeasuredScale::none, all_clog), InputError);
}

TEST(BenchCandidates, AreOfRangesThatHaveTwoNumbers) {
  EXPECT_THROW(bench_candidates({parse_setting("tray.motion.frequency=6.7512 Hz..6.7513 Hz")}), InputError);
}

TEST(BenchCandidates, AreSettableNumbers) {
  const MeasuredTable table = bench_candidates(
      {parse_setting("tray.motion.frequency=6.7512 Hz..11.251 Hz"), parse_setting("tray.motion.amplitude=3 mm..5 mm")});
  ASSERT_EQ(table.series.size(), 9U);
  EXPECT_EQ(table.series[0].conditions[0].text, "6.75");
  EXPECT_EQ(table.series[4].conditions[0].text, "9");
  EXPECT_EQ(table.series[5].conditions[1].text, "5");
}

}  // namespace
}  // namespace vibrosow
