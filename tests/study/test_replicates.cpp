#include "study/replicates.hpp"

#include <gtest/gtest.h>

#include "scene/input_error.hpp"
#include "study/planned_study.hpp"
#include "study/sweep.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using Rates = std::vector<std::optional<CountedRate>>;

/// To and fro about 1.
Rates even_rates(int runs, double scatter) {
  Rates rates;
  for (int k = 0; k < runs; ++k) rates.push_back(CountedRate{1 + scatter * (k % 2 == 0 ? 1 : -1), 0});
  return rates;
}

TEST(Replicates, TenAtLeastAndThenTheFirstNumberThatIsEnough) {
  const Replicates wanted{.interval = 0.02, .most = 40};
  EXPECT_EQ(enough_runs(even_rates(9, 0.001), wanted), std::nullopt);
  EXPECT_EQ(enough_runs(even_rates(40, 0.001), wanted), 10);
  // half width t(0.975, n - 1) s / sqrt(n) with s = 0.04 (n / (n - 1))^(1/2): 0.0205 of 18, 0.0198 of 19
  EXPECT_EQ(enough_runs(even_rates(40, 0.04), wanted), 19);
  EXPECT_EQ(enough_runs(even_rates(19, 0.04), wanted), 19) << "depends on no later run";
  EXPECT_EQ(enough_runs(even_rates(18, 0.04), wanted), std::nullopt);
}

/// t(0.975, 9) / sqrt(10 x 12) = 0.2065 of a seed.
TEST(Replicates, RunsOfEqualCountsAreNoSurerThanTheirCounts) {
  const auto equal = [](double seeds) { return Rates(10, CountedRate{1, seeds}); };
  const Replicates wanted{.interval = 0.02, .most = 40};
  EXPECT_EQ(enough_runs(equal(11), wanted), 10);
  EXPECT_EQ(enough_runs(equal(10), wanted), std::nullopt);
  EXPECT_EQ(runs_to_go_to(equal(10), wanted), 11);
}

TEST(Replicates, RunsThatClogAreNotCounted) {
  const Replicates wanted{.interval = 0.02, .most = 40};
  Rates rates = even_rates(12, 0.001);
  rates[3] = rates[7] = std::nullopt;
  EXPECT_EQ(enough_runs(rates, wanted), 12);
}

TEST(Replicates, GoOnByTheScatterAndNotBeyondTheMost) {
  const Replicates wanted{.interval = 0.02, .most = 40};
  EXPECT_EQ(runs_to_go_to(even_rates(10, 0.001), wanted), 10);
  const int next = runs_to_go_to(even_rates(10, 0.04), wanted);
  EXPECT_GT(next, 10);
  EXPECT_LE(next, 20);
  EXPECT_EQ(runs_to_go_to(even_rates(30, 0.5), wanted), 40);
  EXPECT_EQ(runs_to_go_to(even_rates(40, 0.5), wanted), 40);
  EXPECT_EQ(runs_to_go_to(Rates(10, std::nullopt), wanted), 20) << "all clogged";
}

/// Ten to and fro by 0.02: half width t(0.975, 9) 0.02 sqrt(10 / 9) / sqrt(10) = 0.015081, and its square over the
/// wanted one's times ten.
TEST(Replicates, GoOnToWhatTheScatterAsksFor) {
  const auto next = [](double interval) {
    return runs_to_go_to(even_rates(10, 0.02), {.interval = interval, .most = 40});
  };
  EXPECT_EQ(next(0.0150), 11);  // 10.1
  EXPECT_EQ(next(0.0136), 13);  // 12.3
  EXPECT_EQ(next(0.0132), 14);  // 13.05
  EXPECT_EQ(next(0.0110), 19);  // 18.8
}

/// G1 of the sample against twice its standard error if it were normal: 1.374 of ten values, 1.024 of twenty.
TEST(Replicates, LookSkewedBeyondTwoStandardErrors) {
  const auto looks = [](std::size_t zeros, std::size_t others, double other) {
    std::vector<double> values(zeros, 0.0);
    values.insert(values.end(), others, other);
    values.push_back(1);
    return look_skewed(values);
  };
  EXPECT_TRUE(looks(7, 2, 0.6));    // 1.391
  EXPECT_FALSE(looks(7, 2, 0.62));  // 1.348
  EXPECT_TRUE(looks(14, 5, 0.7));   // 1.071
  EXPECT_FALSE(looks(14, 5, 0.8));  // 0.989
}

TEST(Replicates, LookSkewed) {
  std::vector<double> even, skewed;
  for (int k = 0; k < 20; ++k) {
    even.push_back(k);
    skewed.push_back(k == 0 ? 50 : k % 3);
  }
  EXPECT_FALSE(look_skewed(even));
  EXPECT_TRUE(look_skewed(skewed));
  EXPECT_FALSE(look_skewed({1, 1, 90}));
  EXPECT_FALSE(look_skewed(std::vector<double>(20, 3.0)));
}

/// A study of one layout whose runs are quick; that of random seed 4 clogs.
class ByNeed : public testing::Test {
 protected:
  PlannedStudy planned(const std::string& replicates) const {
    return plan_study(files_.study("replicates = " + replicates + "\n"), {}, 1);
  }
  StudyFiles files_;
  /// As if all runs of a plan had been made.
  KeptRuns kept(const PlannedStudy& of) const {
    return [this, of](const std::string& name) -> std::optional<vibrosow::Run> {
      const auto run = std::ranges::find(of.plan.runs, name, &PlannedRun::name);
      if (run == of.plan.runs.end()) return std::nullopt;
      const auto scene = of.study.layouts.at(static_cast<std::size_t>(run->layout) - 1).scene;
      SimulationOptions options;
      options.random_seed = run->random_seed;
      return simulator_(prepare(of.study.scenes.at(scene.value())), options);
    };
  }
  Simulator simulator_ = [](const Model& model, SimulationOptions options) {
    const std::uint64_t seed = options.random_seed;
    options.random_seed = 1 + 6 * (seed % 2);  // few or many, in turns
    vibrosow::Run run = quick_run(model, options);
    run.random_seed = seed;
    if (seed == 4) run.end_reason = "nothing left for 5 s", run.balance.inside = 20;
    return run;
  };
};

TEST_F(ByNeed, RoundsGoOnUntilTheIntervalIsNarrow) {
  PlannedStudy study = planned(R"({ interval = "5 %", most = 60 })");
  EXPECT_EQ(study.plan.runs.size(), 10u);
  int rounds = 1;
  while (auto next = next_round(study, kept(study), 1)) {
    ASSERT_GT(next->plan.runs.size(), study.plan.runs.size());
    study = *next;
    ++rounds;
  }
  EXPECT_GT(rounds, 1);
  SweepOptions all;
  all.replicates = replicates_in(study);
  const StudyResult result = sweep(study.study, simulator_, all);
  const auto used = static_cast<int>(result.runs.at(0).size());
  EXPECT_EQ(result.layouts.at(0).replicates, used - 1) << "one clogged";
  EXPECT_NE(doubts_text(result.layouts[0].doubts).find("clogged in 1 of"), std::string::npos)
      << doubts_text(result.layouts[0].doubts);
  const auto rate = *result.layouts[0].metrics["rate_g_per_s"];
  EXPECT_LE(*rate.half_width_95, 0.05 * rate.mean);
  all.replicates = {60};  // as if another had made more
  EXPECT_EQ(sweep(study.study, simulator_, all).runs.at(0).size(), result.runs.at(0).size());
}

/// The runs that flowed say little of a layout of which most, or all, clog.
TEST_F(ByNeed, ALayoutThatMostlyClogsIsDoubtful) {
  const PlannedStudy study = planned(R"({ interval = "5 %", most = 10 })");
  for (const auto& [clogging, status, told] :
       {std::tuple(2, LayoutStanding::ok, "clogged in 2 of 10 runs, which are left out"),
        std::tuple(6, LayoutStanding::doubtful, "clogged in 6 of 10 runs, which are left out"),
        std::tuple(10, LayoutStanding::doubtful, "stopped flowing in 10 of 10 runs")}) {
    SweepOptions all;
    all.replicates = {10};
    const StudyResult result = sweep(
        study.study,
        [last = clogging](const Model& model, const SimulationOptions& options) {
          vibrosow::Run run = quick_run(model, options);
          if (static_cast<int>(options.random_seed) <= last) run.end_reason = "no more", run.balance.inside = 20;
          return run;
        },
        all);
    EXPECT_EQ(result.layouts[0].status, status) << clogging;
    EXPECT_NE(doubts_text(result.layouts[0].doubts).find(told), std::string::npos)
        << doubts_text(result.layouts[0].doubts);
  }
}

/// Holes 1 to 3 let out 5 n + k / 2 seeds/s in run k, and half of that in runs that clog.
TEST_F(ByNeed, MeasuredOutflowIsComparedWithTheRunsThatFlowed) {
  files_.write("bench.csv", "hole,seeds_per_s\n1,9.5\n");
  const Study study = read_study(files_.study(
      "replicates = { interval = \"5 %\", most = 12 }\n[measured]\nfile = \"bench.csv\"\nscale = \"none\"\n"));
  SweepOptions all;
  all.replicates = {12};
  const StudyResult result = sweep(
      study,
      [](const Model& model, const SimulationOptions& options) {
        vibrosow::Run run = quick_run(model, options);
        if (options.random_seed > 6) return run;
        std::erase_if(run.events, [](const OutflowEvent& event) { return event.time > 3; });
        run.end_reason = "no more", run.balance.inside = 20;
        return run;
      },
      all);
  // Runs 7 to 12: 9.75 seeds/s from hole 1.
  EXPECT_NEAR(result.layouts[0].holes[0].seeds_per_s->mean, 9.75, 1e-9);
  EXPECT_NEAR(result.comparison->rows[0].simulated.mean, 9.75, 1e-9);
  EXPECT_NEAR(*result.layouts[0].holes[0].difference_percent, 100 * (9.75 / 9.5 - 1), 1e-9);
}

TEST_F(ByNeed, APlanOfALaterRoundIsReadBack) {
  PlannedStudy study = planned(R"({ interval = "0.1 %", most = 25 })");
  study = next_round(study, kept(study), 1).value();
  EXPECT_EQ(study.plan.runs.size(), 20u);
  EXPECT_EQ(replicates_in(study_of_plan(study.plan)), std::vector<int>{20});
  study = next_round(study, kept(study), 1).value();
  EXPECT_EQ(study.plan.runs.size(), 25u);
  EXPECT_FALSE(next_round(study, kept(study), 1));
  SweepOptions all;
  all.replicates = {25};
  EXPECT_NE(doubts_text(sweep(study.study, simulator_, all).layouts[0].doubts).find("still wider than 0.1 %"),
            std::string::npos);
}

TEST_F(ByNeed, WhatCannotBeMeantIsRefused) {
  for (const char* wrong : {"{ most = 20 }", R"({ interval = "2 %", most = 9 })", R"({ interval = "0 %" })",
                            R"({ interval = "2 mm" })", R"({ interval = "2 %", least = 5 })", "0"})
    EXPECT_THROW(planned(wrong), InputError) << wrong;
  EXPECT_EQ(planned(R"({ interval = "2 %" })").study.replicates.most, 40);
}

TEST_F(ByNeed, AFixedNumberIsOneRound) {
  EXPECT_FALSE(next_round(planned("3"), kept(planned("3")), 1));
}

}  // namespace
}  // namespace vibrosow
