#include "accuracy/promise.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "accuracy/accuracy_doubts.hpp"
#include "input/read_scene.hpp"
#include "made_up_rates.hpp"
#include "report/accuracy_report.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

/// By so few and so scattered pilots every setting often looks as if it erred by more than is wanted.
TEST(Promise, GoesOnWhereTheFirstPilotsCannotTell) {
  const Kept count = promises_kept({.by_softness = 2, .by_step = 0.2, .scatter = 3}, 1, choices());
  EXPECT_GE(count.kept, 0.95 * count.made) << count.made;
  EXPECT_GE(count.made, trays * 9 / 10);
}

/// What the finest setting is far beyond, and what chance would take thousands of runs to tell, is given up at once.
TEST(Promise, TakesNoFurtherPilotsForWhatIsOutOfReach) {
  const auto rounds = [](const MadeUpTray& tray, double percent) {
    MadeUpRuns runs(tray);
    int count = 0;
    const Promise made = promise(choices(), {.within_percent = percent}, [&](const std::vector<SettingRuns>& wanted) {
      ++count;
      return runs.run(choices().design.settings, wanted);
    });
    EXPECT_FALSE(made.offer);
    return count;
  };
  EXPECT_EQ(rounds({.by_softness = 60, .by_step = 60, .scatter = 0.1}, 0.02), 1);
  EXPECT_EQ(rounds({.by_softness = 1, .scatter = 40}, 1), 1);
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

/// t s / sqrt(n) of the pilots' s, a window of so many times the scene's counted as that many; and no more runs than
/// bring the error within the goal.
TEST(Promise, ItsHalfWidthIsStudentsOfThePilotsScatter) {
  PromiseChoices from = choices();
  from.lead = 9;
  from.windows = {1, 4};
  for (const double percent : {1.0, 3.0})
    for (const double scatter : {1.5, 3.0}) {
      const Promise made =
          promise_of({.by_softness = 0.5, .by_step = 0.1, .scatter = scatter}, {.within_percent = percent}, from);
      ASSERT_TRUE(made.offer && made.mass_rate);
      const Offer& offer = *made.offer;
      const double of_run = student_t_95(made.fit->degrees_of_freedom()) * made.fit->scatter_percent();
      const auto half = [&](int runs) { return of_run / std::sqrt(offer.window * runs); };
      EXPECT_NEAR(offer.half_width_percent, half(offer.replicates), 1e-9);
      EXPECT_NEAR(*made.mass_rate->half_width_95, made.fit->limit().mean * half(offer.replicates) / 100, 1e-12);
      EXPECT_LE(offer.bias.bound() + half(offer.replicates), percent);
      if (offer.to_run > 0) {
        EXPECT_GT(offer.bias.bound() + half(offer.replicates - 1), percent);
      }
    }
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
  EXPECT_THAT(promise_text(sound_scene(), made, goal), testing::HasSubstr("cannot be promised"));
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

TEST(Promise, SaysWhenNothingFlows) {
  MadeUpRuns tray({});
  const auto run = [&](const std::vector<SettingRuns>& wanted, auto change) {
    std::vector<AccuracyRun> runs = tray.run(choices().design.settings, wanted);
    for (AccuracyRun& one : runs) change(one);
    return runs;
  };
  const auto refused = [&](auto change) {
    return promise(choices(), {.within_percent = 3}, [&](const auto& wanted) { return run(wanted, change); }).refused;
  };
  EXPECT_EQ(refused([](AccuracyRun& one) { one.mass_rate = 0; }), "nothing flows");
  EXPECT_EQ(refused([](AccuracyRun& one) { one.mass_rate.reset(), one.refused = "too deep"; }),
            "too few of the pilots have a rate");
}

TEST(Promise, TellsWhatEachStageCostsBeforeItIsRun) {
  const PromiseChoices from = choices();
  MadeUpRuns runs({});
  std::vector<int> told, made_runs;
  std::vector<double> foretold, taken;
  const Promise made = promise(
      from, {.within_percent = 3},
      [&](const std::vector<SettingRuns>& wanted) {
        std::vector<AccuracyRun> stage = runs.run(from.design.settings, wanted);
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

/// A promise of which some runs were kept from before, by their numbers.
Promise promise_from_kept(const std::function<bool(std::size_t)>& kept, const PromiseGoal& goal) {
  const PromiseChoices from = choices();
  MadeUpRuns runs({});
  std::size_t count = 0;
  return promise(from, goal, [&](const std::vector<SettingRuns>& wanted) {
    std::vector<AccuracyRun> stage = runs.run(from.design.settings, wanted);
    for (AccuracyRun& run : stage)
      if (kept(count++)) run.cpu_time = 0;
    return stage;
  });
}
bool kept_none(std::size_t) {
  return false;
}
bool kept_all(std::size_t) {
  return true;
}
bool kept_every_other(std::size_t run) {
  return run % 2 == 0;
}

TEST(Promise, RunsThatWereKeptChangeNothingButTheTimeTaken) {
  const PromiseGoal goal{.within_percent = 3};
  const Promise whole = promise_from_kept(kept_none, goal);
  ASSERT_TRUE(whole.mass_rate);
  const std::size_t count = whole.runs.size();
  for (const auto& [which, kept] : {std::pair(&kept_every_other, (count + 1) / 2), std::pair(&kept_all, count)}) {
    const Promise made = promise_from_kept(which, goal);
    ASSERT_TRUE(made.mass_rate);
    EXPECT_EQ(made.mass_rate->mean, whole.mass_rate->mean);
    EXPECT_EQ(made.offer->setting, whole.offer->setting);
    EXPECT_EQ(made.runs.size(), whole.runs.size());
    EXPECT_THAT(promise_text(sound_scene(), made, goal),
                testing::HasSubstr(fmt::format("{} of the {} runs", kept, count)));
  }
  EXPECT_EQ(promise_text(sound_scene(), whole, goal).find("from before"), std::string::npos);
}

TEST(Promise, WhatCannotBeHadIsTheSameOfRunsThatWereKept) {
  const PromiseGoal goal{.within_percent = 0.02};
  const Promise whole = promise_from_kept(kept_none, goal), kept = promise_from_kept(kept_all, goal);
  ASSERT_TRUE(whole.least && kept.least);
  EXPECT_EQ(kept.least->setting, whole.least->setting);
  EXPECT_EQ(kept.least->replicates, whole.least->replicates);
}

TEST(Promise, SaysWhichOfItsRunsAreOdd) {
  std::vector<AccuracyRun> runs(5);
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].mass_rate = 2.0 + 0.1 * static_cast<double>(i);
  const auto doubts_of_them = [&] {
    AccuracyResult result;
    result.runs = runs;
    return doubts_about(result, sound_scene());
  };
  ASSERT_EQ(doubts_of_them().size(), 1u) << "that a limit is not known";
  runs[1].mass_rate = 0.04, runs[3].mass_rate.reset(), runs[3].refused = "it does not fit";
  const std::vector<SharedDoubt> doubts = doubts_of_them();
  ASSERT_EQ(doubts.size(), 3u);
  EXPECT_THAT(sentence_of(remark_of(doubts[0], "setting")),
              testing::StartsWith("Doubtful: 1 of the 4 runs with a rate passed less than half"));
  EXPECT_THAT(sentence_of(remark_of(doubts[1], "setting")),
              testing::StartsWith("Note: 1 of the 5 runs has no rate: it does not fit. What to do: "));
  const PromiseChoices from = choices();
  MadeUpRuns made_up({});
  const PromiseGoal goal{.within_percent = 3};
  const Promise made = promise(from, goal, [&](const std::vector<SettingRuns>& wanted) {
    std::vector<AccuracyRun> some = made_up.run(from.design.settings, wanted);
    some.front().mass_rate = *some.front().mass_rate / 50;
    return some;
  });
  EXPECT_THAT(promise_text(sound_scene(), made, goal), testing::HasSubstr("clogs"));
}

TEST(Promise, CpuTimeIsThatOfRunsThatWereMade) {
  const Promise whole = promise_from_kept(kept_none, {.within_percent = 3}),
                half = promise_from_kept(kept_every_other, {.within_percent = 3});
  ASSERT_TRUE(whole.offer && half.offer);
  EXPECT_LT(half.pilot_cpu_time, whole.pilot_cpu_time);
  EXPECT_NEAR(half.offer->cpu_time, whole.offer->cpu_time, 1e-9 * whole.offer->cpu_time);
}

TEST(Promise, AGoalIsOneOfTheTwo) {
  EXPECT_THROW(promise_of({}, {}), std::invalid_argument);
  EXPECT_THROW(promise_of({}, {.within_percent = 3, .cpu_time = 100}), std::invalid_argument);
}

TEST(Promise, WritesTheKeysOfASeeder) {
  const PromiseGoal goal{.within_percent = 3};
  const Promise made = promise_of({}, goal);
  ASSERT_TRUE(made.offer);
  Scene scene = read_scene(VIBROSOW_SOURCE_DIR "/seeders/wheat-tray.toml");
  EXPECT_THAT(promised_numerics(scene, made, goal),
              AllOf(HasSubstr("[contact]\nshell_compression = "), HasSubstr("[numerics]\n"),
                    HasSubstr("integrator = \"velocity-verlet\"\nsteps_per_contact = ")));
  const double asked = made.settings[made.offer->setting].shell_compression;
  EXPECT_THAT(promised_numerics(scene, made, goal), Not(HasSubstr("[seeds.")));
  scene.lots[0].shell_compression = 3 * scene.contact.shell_compression;
  scene.lots.push_back(scene.lots[0]);
  scene.lots[1].name = "soft", scene.lots[1].shell_compression = 9 * scene.contact.shell_compression;
  const std::string of_lots = promised_numerics(scene, made, goal);
  EXPECT_THAT(of_lots, HasSubstr(fmt::format("[seeds.{}]\nshell_compression = {:.4g}\n", scene.lots[0].name, asked)));
  EXPECT_THAT(of_lots, HasSubstr(fmt::format("[seeds.soft]\nshell_compression = {:.4g}\n", 3 * asked)));
}

}  // namespace
}  // namespace vibrosow
