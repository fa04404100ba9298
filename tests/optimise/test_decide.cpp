#include "optimise/decide.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "grains/random.hpp"
#include "optimise/draft_screen.hpp"
#include "report/decision_report.hpp"
#include "report/decision_words.hpp"
#include "scene/input_error.hpp"
#include "support/rounds_of_runs.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Mean seeds of a scene's run, by the width of its holes and how many there are.
double mean_seeds(const Scene& scene) {
  return 10e3 * scene.tray.holes[0].width * static_cast<double>(scene.tray.holes.size());
}

Run run_of(const Model& model, const SimulationOptions& options, double mean, double deviation) {
  const Scene& scene = model.scene;
  Run run;
  run.random_seed = options.random_seed;
  run.dt = 1e-3;
  run.steps = std::llround(scene.run.duration / run.dt);
  run.end_time = scene.run.duration;
  run.grain_steps = 4000;
  Random random(options.random_seed * 1000 + static_cast<std::uint64_t>(std::llround(mean)));
  double chance = -6;  // of 12 uniform numbers: nearly normal
  for (int i = 0; i < 12; ++i) chance += random.uniform();
  const int seeds = static_cast<int>(std::lround(mean + deviation * chance));
  for (int i = 0; i < seeds; ++i) {
    const int hole = 1 + i % static_cast<int>(scene.tray.holes.size());
    run.events.push_back({2.0 + 2.0 * (i + 0.5) / seeds, hole, 0, run.balance.counted++, scene.lots[0].mass, 0.1, 0.5});
  }
  run.balance.put_in = run.balance.counted;
  return run;
}

/// Scatters by 4 seeds.
Run noisy_run(const Model& model, const SimulationOptions& options) {
  return run_of(model, options, mean_seeds(model.scene), 4);
}

/// By 30: to tell 390 from 420 seeds takes many runs.
Run loud_run(const Model& model, const SimulationOptions& options) {
  return run_of(model, options, mean_seeds(model.scene), 30);
}

DecideOptions most_flow() {
  DecideOptions options;
  options.goal = &goal_named("rate");
  options.margin = 0.05;
  return options;
}

/// To its end; the files that come of it.
DecisionReport lead(StudyDecision& decision, const Simulator& simulator, int jobs = 1) {
  lead_to_the_end(decision, simulator, jobs);
  return {decision.result(), {}};
}

Study widths(const StudyFiles& files, const std::string& more = "") {
  return read_study(
      files.study("title = \"widths\"\n" + more + "[vary]\ntray.holes.width = [\"10 mm\", \"13 mm\", \"14 mm\"]\n"));
}

TEST(Decide, FindsTheBestAndLeavesThePlainlyWorse) {
  const StudyFiles files;
  const Study study = widths(files);
  StudyDecision decision(study, most_flow());
  const DecisionResult result = lead(decision, noisy_run).result;
  ASSERT_TRUE(result.is_sure);
  EXPECT_EQ(result.best, 2u);
  EXPECT_EQ(result.scenes[0].standing, Standing::worse);
  EXPECT_EQ(result.scenes[0].runs, 10);
  EXPECT_FALSE(result.tests_clogging);
  EXPECT_EQ(decision.left(), 1u);
  EXPECT_NEAR(result.scenes[2].goal->mean, 420 / 2.0 * 40e-6, 420 / 2.0 * 40e-6 * 0.02);
  EXPECT_EQ(result.cost.runs, result.scenes[0].runs + result.scenes[1].runs + result.scenes[2].runs);
  EXPECT_EQ(result.cost.grain_steps, 4000 * result.cost.runs);
  EXPECT_GT(result.equal_grid->runs, 0);
  EXPECT_DOUBLE_EQ(result.equal_grid->grain_steps, 4000 * result.equal_grid->runs);
}

TEST(Decide, InSpaceTellsWhatTheRatesAreExpectedToBeAndDecidesByChanceAlone) {
  const StudyFiles files;
  const std::string along =
      "contact.shell_compression = 1e-4\n[set.tray.holes]\nshape = \"round\"\n[set.tray.motion]\nkind = \"harmonic\"\n"
      "amplitude = \"8 mm\"\nfrequency = \"5 Hz\"\n";
  const Study space = widths(files, "[set]\nspace = \"3d\"\n" + along);
  const Study plane = widths(files, "[set]\n" + along);
  StudyDecision is_3d(space, most_flow()), in_plane(plane, most_flow());
  const DecisionReport report = lead(is_3d, noisy_run), other = lead(in_plane, noisy_run);
  EXPECT_EQ(report.result.best, other.result.best);
  EXPECT_EQ(report.result.cost.runs, other.result.cost.runs);
  for (std::size_t scene = 0; scene < 3; ++scene) {
    EXPECT_FALSE(other.result.scenes[scene].expected);
    const auto& expected = report.result.scenes[scene].expected;
    ASSERT_TRUE(expected);
    EXPECT_DOUBLE_EQ(expected->mass_rate, report.result.scenes[scene].rate->mean);
    EXPECT_GT(half_width_of_model(expected->error), 0.1);
  }
  EXPECT_THAT(decision_csv(report), HasSubstr(",expected_low_g_per_s,expected_high_g_per_s,chance_percent,"));
}

TEST(Decide, NeitherJobsNorProcedureNeedMore) {
  const StudyFiles files;
  const Study study = widths(files);
  StudyDecision one(study, most_flow()), two(study, most_flow());
  EXPECT_EQ(decision_csv(lead(one, noisy_run, 1)), decision_csv(lead(two, noisy_run, 2)));
  DecideOptions quicker = most_flow();
  quicker.rule = SelectionRule::posterior;
  StudyDecision posterior(study, quicker);
  const DecisionResult result = lead(posterior, noisy_run).result;
  EXPECT_EQ(result.best, 2u);
  EXPECT_LT(result.cost.runs, one.result().cost.runs);
}

TEST(Decide, GoesOnFromTheRunsThatAreKept) {
  const StudyFiles files;
  const Study study = widths(files);
  DecideOptions options = most_flow();
  options.margin = 0.01;
  StudyDecision undisturbed(study, options);
  const std::string csv = decision_csv(lead(undisturbed, loud_run));

  StudyDecision decision(study, options);
  const std::int64_t made =
      lead_through_a_kill(files.seeder().parent_path() / "cases", StudyDecision(study, options), decision, loud_run);
  EXPECT_EQ(decision_csv({decision.result(), {}}), csv);
  EXPECT_EQ(static_cast<double>(made), decision.result().cost.runs - 36);
  EXPECT_EQ(static_cast<double>(decision.plan().size()), decision.result().cost.runs);
}

TEST(Decide, ClogsAndRatesAreConstraints) {
  const StudyFiles files;
  const Study study = widths(files, "set.run.end_after_pause = \"1 s\"\n");
  const Simulator widest_clogs = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = noisy_run(model, options);
    if (model.scene.tray.holes[0].width > 0.0135 && options.random_seed % 3 == 0) {
      run.end_reason = "no grain left";
      run.balance.inside = 20;
    }
    return run;
  };
  const Simulator widest_runs_dry = [&](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = widest_clogs(model, options);
    run.balance.inside = 0;
    return run;
  };
  DecideOptions options = most_flow();
  options.clogging_limit = 0.1;
  StudyDecision by_clogging(study, options);
  const DecisionReport clogs = lead(by_clogging, widest_clogs);
  EXPECT_TRUE(clogs.result.tests_clogging);
  EXPECT_EQ(clogs.result.best, 1u);
  EXPECT_EQ(clogs.result.scenes[2].standing, Standing::clogs);
  EXPECT_THAT(decision_csv(clogs), HasSubstr("\n3,,clogs,"));
  StudyDecision of_dry(study, options);
  EXPECT_EQ(lead(of_dry, widest_runs_dry).result.scenes[2].clogged, 0) << "what is empty has not clogged";
  // 10 mm and three holes: 300 seeds in 2 s of a slice, 15 slices.
  options.rate = read_wanted_rate("2250 seeds/s +- 10 %");
  StudyDecision by_rate(study, options);
  const DecisionReport misses = lead(by_rate, noisy_run);
  EXPECT_EQ(misses.result.best, 0u);
  EXPECT_EQ(misses.result.scenes[1].standing, Standing::misses_the_rate);
  EXPECT_THAT(decision_json(misses), HasSubstr("\"figure\": \"tray_seeds_per_s\""));
}

TEST(Decide, FailuresInvalidAndEqualLayoutsAreSaid) {
  const StudyFiles files;
  const Study study = read_study(files.study(
      "[vary]\ntray.holes.count = [1, 3]\ntray.holes.width = [\"10 mm\", \"14 mm\", \"16 mm\", \"60 cm\"]\n"));
  DecideOptions options = most_flow();
  options.goal = &goal_named("unevenness");
  const Simulator stopped = [](const Model& model, const SimulationOptions& simulation) {
    vibrosow::Run run = noisy_run(model, simulation);
    run.events.erase(run.events.begin(), run.events.begin() + static_cast<std::ptrdiff_t>(simulation.random_seed % 5));
    if (model.scene.tray.holes[0].width > 0.015) run.status = RunStatus::stopped_by_guard, run.stop_reason = "too deep";
    return run;
  };
  StudyDecision decision(study, options);
  const std::string csv = decision_csv(lead(decision, stopped));
  EXPECT_THAT(csv, HasSubstr("\n1,,failed,random seed 1: one hole has no unevenness,"));
  EXPECT_THAT(csv, HasSubstr("\n7,,failed,random seed 1: too deep,"));
  EXPECT_THAT(csv, HasSubstr("\n8,,invalid,"));
}

/// The widest gives most, but by runs that nothing is to be decided by.
TEST(Decide, NothingByRunsOutsideTheModel) {
  const StudyFiles files;
  const Study study = widths(files);
  const Simulator third_of_the_widest = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = noisy_run(model, options);
    run.outside_the_model = model.scene.tray.holes[0].width > 0.0135 && options.random_seed % 3 == 0;
    return run;
  };
  for (const SelectionRule rule : {SelectionRule::guaranteed, SelectionRule::posterior}) {
    DecideOptions options = most_flow();
    options.rule = rule;
    StudyDecision decision(study, options);
    const DecisionReport report = lead(decision, third_of_the_widest);
    EXPECT_EQ(report.result.best, 1u);
    EXPECT_EQ(report.result.scenes[2].standing, Standing::failed);
    EXPECT_THAT(decision_csv(report), HasSubstr("\n3,,failed,random seed 3: outside the model,"));
  }
  const Simulator whole_of_the_widest = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = noisy_run(model, options);
    run.outside_the_model = model.scene.tray.holes[0].width > 0.0135;
    return run;
  };
  StudyDecision decision(study, most_flow());
  const DecisionResult result = lead(decision, whole_of_the_widest).result;
  EXPECT_FALSE(result.scenes[2].goal);
  EXPECT_FALSE(result.scenes[2].rate);
}

/// Two thirds of the widest's windows have no seed: it lets out least, though it would most where it flows.
TEST(Decide, AnEmptyWindowCountsWhereCloggingIsNotTested) {
  const StudyFiles files;
  const Simulator widest_is_often_empty = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = noisy_run(model, options);
    if (model.scene.tray.holes[0].width > 0.0135 && options.random_seed % 3 != 0) run.events.clear(), run.balance = {};
    return run;
  };
  DecideOptions options = most_flow();
  options.rate = read_wanted_rate("3000 seeds/s +- 20 %");
  for (const SelectionRule rule : {SelectionRule::guaranteed, SelectionRule::posterior}) {
    options.rule = rule;
    const Study study = widths(files);
    StudyDecision decision(study, options);
    const DecisionResult result = lead(decision, widest_is_often_empty).result;
    EXPECT_FALSE(result.tests_clogging);
    EXPECT_EQ(result.best, 1u);
    EXPECT_EQ(result.scenes[2].standing, Standing::misses_the_rate);
    const SceneDecision& widest = result.scenes[2];
    const double flowed = widest.runs - widest.clogged, of_the_tray = 15 * 420 / 2.0 * flowed / widest.runs;
    EXPECT_GT(widest.clogged, 0);
    EXPECT_NEAR(widest.rate->mean, of_the_tray, 0.05 * of_the_tray);
  }
}

TEST(Decide, RefusesWhatCannotBeDecided) {
  const StudyFiles files;
  const Study alone = read_study(files.study("title = \"alone\"\n"));
  EXPECT_THAT([&] { StudyDecision(alone, most_flow()); }, ThrowsMessage<InputError>(HasSubstr("one layout")));
  const Study study = widths(files, "set.run.end_after_pause = \"1 s\"\n");
  DecideOptions few = most_flow();
  few.most = 50;
  EXPECT_THAT([&] { StudyDecision(study, few); }, ThrowsMessage<InputError>(HasSubstr("50 cannot decide")));
  few.clogging_limit = 1;
  EXPECT_NO_THROW(StudyDecision(study, few));
  DecideOptions rate = most_flow();
  rate.rate = read_wanted_rate("43 seeds/s +- 5 %");
  const Study slice = widths(files, "set.unset = [\"tray.depth\"]\n");
  EXPECT_THAT([&] { StudyDecision(slice, rate); }, ThrowsMessage<InputError>(HasSubstr("layout 1 is in 2D")));
}

TEST(Decide, CorrelationOfCommonRandomSeeds) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(*mean_correlation({{1, 2, 3, 4}, {2, 4, 6, 8}}), 1, 1e-12);
  EXPECT_NEAR(*mean_correlation({{1, none, 2, 3}, {6, 5, 4, 2}, {5, 5, 5, 5}}), -1, 1e-12);
  EXPECT_NEAR(*mean_correlation({{1, -1, 1, -1}, {1, 1, -1, -1}}), 0, 1e-12);
  EXPECT_FALSE(mean_correlation({{1, 2}, {2, 4}}));
  EXPECT_FALSE(mean_correlation({{1, 2, 3, 4}}));
}

/// A dozen widths, of which a draft gives nine tenths of the rate, or nonsense.
class Drafts : public testing::Test {
 protected:
  Study study() const {
    return read_study(
        files_.study("title = \"drafts\"\n[set]\ncontact.shell_compression = 1e-5\n[vary]\n"
                     "tray.holes.width = { from = \"10 mm\", to = \"30 mm\", step = \"1 mm\" }\n"));
  }
  static DraftFindings findings_of(DraftScreen& screen, const Simulator& simulator) {
    lead_to_the_end(screen, simulator);
    return screen.findings();
  }
  static double unrelated(const Model& model) {
    return 300 + 20 * static_cast<double>(7 * std::lround(1e3 * model.scene.tray.holes[0].width) % 5);
  }
  static bool is_draft(const Model& model) { return model.scene.contact.shell_compression > 1e-4; }

 private:
  StudyFiles files_;
};

TEST_F(Drafts, ThatAreLikeTheLayoutsRuleSomeOut) {
  const Study all = study();
  DraftScreen screen(all, most_flow());
  const DraftFindings findings = findings_of(screen, [](const Model& model, const SimulationOptions& options) {
    return run_of(model, options, (is_draft(model) ? 0.9 : 1.0) * mean_seeds(model.scene), 4);
  });
  EXPECT_EQ(findings.pilots, 12);
  EXPECT_GT(findings.correlation.value(), 0.9);
  EXPECT_TRUE(findings.screens);
  EXPECT_EQ(findings.cost.runs, 21 * DraftScreen::runs);
  EXPECT_FALSE(findings.taking_part.front());
  EXPECT_TRUE(findings.taking_part.back());
  StudyDecision decision(all, most_flow(), findings.taking_part);
  DecisionReport report = lead(decision, noisy_run);
  report.drafts = findings;
  EXPECT_EQ(report.result.best, 20u);
  EXPECT_EQ(report.result.scenes[0].runs, 0);
  EXPECT_THAT(decision_csv(report), HasSubstr("\n1,,ruled out by drafts,"));
}

/// The line through the pilots' means by the textbook's sums, and what it foretells of two layouts' difference:
/// Student's t of two degrees of freedom fewer than pilots, its error shared out among the layouts.
TEST_F(Drafts, RuleOutBeyondThePredictionIntervalOfTheDifference) {
  const Study all = study();
  const auto draft_of = [](double width) { return std::round(2e4 * width); };
  std::size_t out = 0, in = 0;
  for (const double amplitude : {4.0, 12.0, 18.0, 24.0, 30.0}) {
    const auto own_of = [&](double width) {
      return draft_of(width) + amplitude * static_cast<double>((7 * std::lround(1e3 * width)) % 5 - 2);
    };
    DraftScreen screen(all, most_flow());
    const DraftFindings findings = findings_of(screen, [&](const Model& model, const SimulationOptions& options) {
      const double width = model.scene.tray.holes[0].width;
      return run_of(model, options, is_draft(model) ? draft_of(width) : own_of(width), 0);
    });
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (int pilot = 0; pilot < 12; ++pilot) {
      const double width = all.scenes[static_cast<std::size_t>(pilot * 20 / 11)].tray.holes[0].width;
      const double draft = draft_of(width), own = own_of(width);
      x += draft / 12, y += own / 12, xx += draft * draft, xy += draft * own, yy += own * own;
    }
    const double squares = xx - 12 * x * x, slope = (xy - 12 * x * y) / squares;
    const double unexplained = yy - 12 * y * y - slope * slope * squares;
    EXPECT_NEAR(findings.correlation.value(), slope * std::sqrt(squares / (yy - 12 * y * y)), 1e-9);
    ASSERT_TRUE(findings.screens);
    const double t = quantile(complement(boost::math::students_t(10), 0.05 / 20));
    const double most = draft_of(all.scenes.back().tray.holes[0].width);
    for (std::size_t i = 0; i + 2 < all.scenes.size(); ++i) {  // two are left at least
      const double behind = most - draft_of(all.scenes[i].tray.holes[0].width);
      const double interval = t * std::sqrt(unexplained / 10 * (2 + behind * behind / squares));
      EXPECT_EQ(findings.taking_part[i], slope * behind <= interval) << amplitude << ' ' << i;
      ++(findings.taking_part[i] ? in : out);
    }
  }
  EXPECT_GT(out, 20U);
  EXPECT_GT(in, 20U);
}

TEST_F(Drafts, ThatAreNotDecideNothing) {
  const Study all = study();
  DraftScreen screen(all, most_flow());
  const DraftFindings findings = findings_of(screen, [](const Model& model, const SimulationOptions& options) {
    return run_of(model, options, is_draft(model) ? unrelated(model) : mean_seeds(model.scene), 4);
  });
  EXPECT_LT(std::abs(findings.correlation.value()), DraftScreen::least_correlation);
  EXPECT_FALSE(findings.screens);
  EXPECT_EQ(findings.cost.runs, DraftScreen::pilots * DraftScreen::runs);
  EXPECT_THAT(findings.taking_part, testing::Each(true));
}

TEST_F(Drafts, OutsideTheModelRuleNothingOut) {
  const Study all = study();
  DraftScreen screen(all, most_flow());
  const DraftFindings findings = findings_of(screen, [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = run_of(model, options, (is_draft(model) ? 0.9 : 1.0) * mean_seeds(model.scene), 4);
    run.outside_the_model = is_draft(model) && model.scene.tray.holes[0].width < 0.0105;
    return run;
  });
  EXPECT_TRUE(findings.screens);
  EXPECT_TRUE(findings.taking_part[0]);
  EXPECT_FALSE(findings.taking_part[1]);
}

/// A slice of a tray of 6 cm stands for twice as much as one of 3 cm: drafts that compared slices would rule out the
/// better layouts.
TEST(DraftScreens, CompareRatesOfTraysOfUnlikeDepthAsTheDecisionDoes) {
  const StudyFiles files;
  const Study study = read_study(
      files.study("title = \"depths\"\n[set]\ncontact.shell_compression = 1e-5\n[vary]\ntray.depth = [\"3 cm\", \"6 "
                  "cm\"]\ntray.holes.width = { from = \"10 mm\", to = \"20 mm\", step = \"1 mm\" }\n"));
  DraftScreen screen(study, most_flow());
  lead_to_the_end(screen, [](const Model& model, const SimulationOptions& options) {
    return run_of(model, options, mean_seeds(model.scene), 4);
  });
  const DraftFindings findings = screen.findings();
  ASSERT_TRUE(findings.screens);
  EXPECT_FALSE(findings.taking_part[10]) << "3 cm deep and 20 mm wide: half of the best";
  EXPECT_TRUE(findings.taking_part[21]) << "6 cm deep and 20 mm wide";
  EXPECT_TRUE(findings.taking_part[20]) << "19 mm: within what drafts can tell";
}

/// Where all runs may clog, those that did count with the rates that they had, and it is said.
TEST(Decide, RunsThatClogAreDoubtedWhereAllMayClog) {
  const StudyFiles files;
  const Study study = widths(files, "set.run.end_after_pause = \"1 s\"\n");
  const Simulator all_clog = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = noisy_run(model, options);
    run.end_reason = "no grain left", run.balance.inside = 20;
    return run;
  };
  for (const double limit : {1.0, 0.5}) {
    DecideOptions options = most_flow();
    options.clogging_limit = limit;
    StudyDecision decision(study, options);
    const DecisionResult result = lead(decision, all_clog).result;
    const bool counts = limit == 1;
    EXPECT_EQ(result.scenes[2].goal.has_value(), counts);
    EXPECT_EQ(doubts_text(result.scenes[2].doubts).find("stopped flowing in") != std::string::npos, counts);
    EXPECT_EQ(metrics_sentence(result, 2).find("which count as they are") != std::string::npos, counts);
  }
}

TEST_F(Drafts, OfDraftsAreRefused) {
  const StudyFiles files;
  const Study soft = widths(files);  // at a shell compression of 1e-3
  EXPECT_THAT([&] { DraftScreen(soft, most_flow()); }, ThrowsMessage<InputError>(HasSubstr("as soft as drafts")));
}

}  // namespace
}  // namespace vibrosow
