#include "design/promise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_up_rates.hpp"
#include "report/accuracy_report.hpp"

namespace vibrosow {
namespace {

PromiseChoices choices(const std::vector<double>& slip_speeds = {}) {
  return {.design = made_up_design(slip_speeds)};
}

Promise promise_of(const MadeUpTray& tray, const PromiseGoal& goal, const PromiseChoices& from = choices()) {
  MadeUpRuns runs(tray);
  return promise(from, goal,
                 [&](const std::vector<SettingRuns>& wanted) { return runs.run(from.design.settings, wanted); });
}

struct Kept {
  int made = 0, kept = 0;
};

/// Of so many trays alike but for chance, how many promises were made and kept.
constexpr int trays = 60;

Kept promises_kept(MadeUpTray tray, double percent, const PromiseChoices& from) {
  Kept count;
  for (std::uint64_t seed = 1; seed <= trays; ++seed) {
    tray.random_seed = seed;
    const Promise made = promise_of(tray, {.within_percent = percent}, from);
    if (!made.mass_rate) continue;
    ++count.made;
    count.kept += std::abs(made.mass_rate->mean / tray.limit - 1) <= percent / 100;
  }
  return count;
}

TEST(Promise, AtLeast95PercentAreKept) {
  const MadeUpTray steep{.by_softness = 20, .by_step = 2}, flat{.by_softness = 2, .by_step = 0.2},
      noisy{.by_softness = 5, .scatter = 2}, sliding{.by_slip_speed = 4};
  for (const auto& [tray, from, percent] :
       {std::tuple(steep, choices(), 3.0), std::tuple(flat, choices(), 3.0), std::tuple(flat, choices(), 1.0),
        std::tuple(noisy, choices(), 3.0), std::tuple(sliding, choices({0.01, 0.08}), 3.0)}) {
    const Kept count = promises_kept(tray, percent, from);
    EXPECT_GE(count.kept, 0.95 * count.made) << percent << " % of " << count.made;
    EXPECT_GE(count.made, trays * 9 / 10) << percent;
  }
}

TEST(Promise, InteractionsOfSoftAndCoarseBreakNoPromises) {
  const Kept count = promises_kept({.by_interaction = 4}, 3, choices());
  EXPECT_GE(count.kept, 0.95 * count.made) << count.made;
}

TEST(Promise, ChoosesTheSoftSettingWhereSoftnessDoesNoHarm) {
  const Promise made = promise_of({.by_softness = 0.2, .by_step = 0.1}, {.within_percent = 3});
  ASSERT_TRUE(made.offer);
  EXPECT_EQ(made.settings[made.offer->setting].shell_compression, 1e-2);
  EXPECT_LE(made.offer->error_bound(), 3);
  ASSERT_TRUE(made.finest);
  EXPECT_LT(made.offer->work, made.finest->work);
}

TEST(Promise, ChoosesAStiffSettingWhereSoftnessErrs) {
  const Promise made = promise_of({.by_softness = 30}, {.within_percent = 2});
  ASSERT_TRUE(made.offer);
  EXPECT_LE(made.settings[made.offer->setting].shell_compression, 1e-4);
}

TEST(Promise, PilotsOfTheChosenSettingCountAmongItsRuns) {
  const Promise made = promise_of({.by_softness = 1, .by_step = 0.1}, {.within_percent = 5});
  ASSERT_TRUE(made.offer && made.mass_rate);
  int runs = 0;
  for (const AccuracyRun& run : made.runs) runs += run.setting == made.offer->setting;
  EXPECT_EQ(runs, made.offer->replicates);
  EXPECT_LT(made.offer->to_run, made.offer->replicates);
}

TEST(Promise, MorePilotsForANarrowGoal) {
  const std::size_t wide = promise_of({}, {.within_percent = 20}).pilots;
  EXPECT_GT(promise_of({.by_softness = 5}, {.within_percent = 0.8}).pilots, wide);
}

TEST(Promise, SaysWhatCannotBeHad) {
  const PromiseGoal goal{.within_percent = 0.02};
  const Promise made = promise_of({.scatter = 5}, goal);
  EXPECT_FALSE(made.offer);
  ASSERT_TRUE(made.least);
  EXPECT_GT(made.least->error_bound(), 0.02);
  EXPECT_THAT(promise_text(made, goal), testing::HasSubstr("cannot be promised"));
}

TEST(Promise, ABudgetIsKeptAndMoreBuysLess) {
  double before = 1e9;
  for (const double seconds : {1000.0, 3000.0, 20000.0}) {
    const Promise made = promise_of({}, {.cpu_time = seconds});
    ASSERT_TRUE(made.offer);
    EXPECT_LE(made.pilot_cpu_time + made.answer_cpu_time, seconds);
    EXPECT_LT(made.offer->error_bound(), before);
    before = made.offer->error_bound();
  }
}

TEST(Promise, LongerWindowsAreChosenWhereTheLeadIsDear) {
  PromiseChoices from = choices();
  from.lead = 9;
  from.windows = {1, 4};
  MadeUpTray tray{.by_softness = 0.5, .by_step = 0.1, .scatter = 1.5};
  const Promise made = promise_of(tray, {.within_percent = 3}, from);
  ASSERT_TRUE(made.offer);
  EXPECT_EQ(made.offer->window, 4);
}

TEST(Promise, InterruptedPilotsPromiseNothing) {
  const PromiseChoices from = choices();
  MadeUpRuns runs({});
  const Promise made = promise(from, {.within_percent = 3}, [&](const std::vector<SettingRuns>& wanted) {
    std::vector<AccuracyRun> cut = runs.run(from.design.settings, wanted);
    cut.back().mass_rate.reset();
    cut.back().refused = interrupted_run;
    return cut;
  });
  EXPECT_FALSE(made.offer);
  EXPECT_EQ(made.refused, interrupted_run);
}

TEST(Promise, TellsWhatEachStageCostsBeforeItIsRun) {
  const PromiseChoices from = choices();
  MadeUpRuns runs({});
  std::vector<int> told, made_runs;
  std::vector<double> foretold, taken;
  const Promise made = promise(
      from, {.within_percent = 3},
      [&](const std::vector<SettingRuns>& wanted) {
        const std::vector<AccuracyRun> stage = runs.run(from.design.settings, wanted);
        made_runs.push_back(static_cast<int>(stage.size()));
        taken.push_back(0);
        for (const AccuracyRun& run : stage) taken.back() += run.cpu_time;
        EXPECT_EQ(told.size() + 1, made_runs.size()) << "not before it";
        return stage;
      },
      [&](int count, double cpu_time) { told.push_back(count), foretold.push_back(cpu_time); });
  ASSERT_TRUE(made.mass_rate);
  ASSERT_GE(told.size(), 1u);
  EXPECT_EQ(told, std::vector<int>(made_runs.begin() + 1, made_runs.end()));
  for (std::size_t k = 0; k < told.size(); ++k) EXPECT_NEAR(foretold[k], taken[k + 1], 0.02 * taken[k + 1]);
}

TEST(Promise, ClockDoesNotChooseWhereAnErrorIsWanted) {
  const PromiseChoices from = choices();
  const auto chosen = [&](double slow) {
    MadeUpRuns runs({});
    const Promise made = promise(from, {.within_percent = 3}, [&](const std::vector<SettingRuns>& wanted) {
      std::vector<AccuracyRun> timed = runs.run(from.design.settings, wanted);
      for (AccuracyRun& run : timed)
        if (from.design.settings[run.setting].shell_compression > 1e-3) run.cpu_time *= slow;
      return timed;
    });
    return std::tuple(made.offer->setting, made.offer->replicates, made.pilots);
  };
  EXPECT_EQ(chosen(1), chosen(1000));
}

TEST(Promise, AGoalIsOneOfTheTwo) {
  EXPECT_THROW(promise_of({}, {}), std::invalid_argument);
  EXPECT_THROW(promise_of({}, {.within_percent = 3, .cpu_time = 100}), std::invalid_argument);
}

TEST(Promise, WritesTheKeysOfASeeder) {
  const PromiseGoal goal{.within_percent = 3};
  const Promise made = promise_of({}, goal);
  ASSERT_TRUE(made.offer);
  EXPECT_THAT(promised_numerics(made, goal),
              testing::AllOf(testing::HasSubstr("[contact]\nshell_compression = "), testing::HasSubstr("[numerics]\n"),
                             testing::HasSubstr("integrator = \"velocity-verlet\"\nsteps_per_contact = ")));
}

}  // namespace
}  // namespace vibrosow
