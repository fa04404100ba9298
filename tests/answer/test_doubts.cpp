#include "outflow/doubts.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "accuracy/accuracy.hpp"
#include "accuracy/accuracy_doubts.hpp"
#include "calibration/calibration_answer.hpp"
#include "input/read_scene.hpp"
#include "input/table.hpp"
#include "optimise/decide.hpp"
#include "optimise/optimise.hpp"
#include "report/accuracy_report.hpp"
#include "report/answer_doubts.hpp"
#include "report/calibration_report.hpp"
#include "report/front_report.hpp"
#include "report/study_page.hpp"
#include "report/sweep_report.hpp"
#include "support/rounds_of_runs.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Two widths of holes, of which the wider sows more; sound, and nothing speaks against it.
Run sound_run(const Model& model, const SimulationOptions& options) {
  Run run = quick_run(model, options);
  for (int more = 0; model.scene.tray.holes[0].width > 0.015 && more < 30; ++more)
    run.events.push_back({3.9, 1, 0, run.balance.counted++, model.scene.lots[0].mass, 0.1, 0.5});
  run.balance.inside = 10 * run.balance.counted;
  run.balance.put_in = run.balance.counted + run.balance.inside;
  return run;
}

/// The same with what makes a doubt of a kind.
Run doubtful_run(DoubtKind kind, const Model& model, const SimulationOptions& options) {
  using enum DoubtKind;
  Run run = sound_run(model, options);
  switch (kind) {
    case outside_the_model:
      run.outside_the_model = true;
      break;
    case ran_dry:
      run.tray_empty_since = 3.5;
      break;
    case drained:
      run.tray_at_begin = 20, run.tray_at_end = 5;
      break;
    case stopped_flowing:
      run.end_reason = "no grain left for 1 s", run.balance.inside = 20;
      break;
    case seeds_lost:
      run.balance.lost = 1, --run.balance.inside;
      break;
    case feeder_behind:
    case guard_warned:
    case sizes_drawn:
      run.warnings = {{kind, "as the simulation has it"}};
      break;
    case stopped_by_guard:
      run.status = RunStatus::stopped_by_guard, run.stop_reason = "too deep";
      break;
    case interrupted:
      run.status = RunStatus::interrupted;
      break;
    case before_the_window:
      run.status = RunStatus::stopped_by_guard, run.stop_reason = "too deep", run.end_time = 1.5, run.events.clear();
      break;
    case few_seeds:
      run.events.resize(model.scene.tray.holes[0].width > 0.015 ? 9 : 3);
      break;
    case seeds_spilled:
      run.balance.spilled = 20, run.balance.put_in += 20;
      break;
    case flow_changed:
      for (int more = 0; more < 300; ++more)
        run.events.push_back({3.39 + 2e-3 * more, 1, 0, run.balance.counted++, model.scene.lots[0].mass, 0.1, 0.5});
      run.balance.put_in += 300;
      break;
    default:
      ADD_FAILURE() << "not of a run";
  }
  return run;
}

/// How an answer tells of a kind of doubt that all its runs have.
enum class Told {
  as_doubt,    // in its sentences, and in what it writes
  as_status,   // the runs count for nothing: in the layout's or the setting's reason
  as_clogged,  // the runs count as clogged
  not_at_all,  // the answer has no such rate: a curve of all that has left
  as_missing,  // the answer waits for these runs
};
using enum Told;

struct KindAndAnswers {
  DoubtKind kind;
  Told sweep, decision, search, accuracy, rates, curves;  // the last two: calibrations
};

/// The table of kinds of doubts and kinds of answers.
constexpr std::array table = {
    KindAndAnswers{DoubtKind::outside_the_model, as_doubt, as_status, as_status, as_status, as_status, as_status},
    KindAndAnswers{DoubtKind::ran_dry, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, not_at_all},
    KindAndAnswers{DoubtKind::drained, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, not_at_all},
    KindAndAnswers{DoubtKind::stopped_flowing, as_doubt, as_clogged, as_clogged, as_doubt, as_doubt, not_at_all},
    KindAndAnswers{DoubtKind::seeds_lost, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt},
    KindAndAnswers{DoubtKind::feeder_behind, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt},
    KindAndAnswers{DoubtKind::guard_warned, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt},
    KindAndAnswers{DoubtKind::stopped_by_guard, as_status, as_status, as_status, as_status, as_status, as_status},
    KindAndAnswers{DoubtKind::interrupted, as_status, as_missing, as_missing, as_status, as_missing, as_missing},
    KindAndAnswers{DoubtKind::before_the_window, as_status, as_status, as_status, as_status, as_status, as_status},
    KindAndAnswers{DoubtKind::few_seeds, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, not_at_all},
    KindAndAnswers{DoubtKind::seeds_spilled, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt},
    KindAndAnswers{DoubtKind::flow_changed, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, not_at_all},
    KindAndAnswers{DoubtKind::sizes_drawn, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt, as_doubt},
};

std::vector<std::string> sentences_of(const std::vector<Remark>& remarks) {
  std::vector<std::string> sentences;
  for (const Remark& remark : remarks) sentences.push_back(sentence_of(remark));
  return sentences;
}

class DoubtsOfScenes : public testing::Test {
 protected:
  /// Sound where `kind` is none.
  static Simulator simulator(std::optional<DoubtKind> kind) {
    return [kind](const Model& model, const SimulationOptions& options) {
      return kind ? doubtful_run(*kind, model, options) : sound_run(model, options);
    };
  }
  Study study(const std::string& frequency = "10 Hz") const {
    return read_study(files_.study(
        "replicates = 3\n[set.contact]\nfriction_model = \"spring\"\nrolling = \"spring\"\nrolling_friction = 0.02\n"
        "[set.tray.motion]\nkind = \"harmonic\"\namplitude = \"4 mm\"\n"
        "frequency = \"" +
        frequency + "\"\n[vary]\ntray.holes.width = [\"14 mm\", \"16 mm\"]\n"));
  }
  StudyFiles files_;
};

class Doubts : public DoubtsOfScenes, public testing::WithParamInterface<KindAndAnswers> {
 protected:
  static std::string name() { return std::string(words_of(GetParam().kind).name); }

  /// What is told first, and all that is written.
  struct Texts {
    std::vector<std::string> sentences;
    std::string written;
  };
  static void check(Told told, const Texts& texts) {
    const auto about_it = Contains(HasSubstr(name()));
    if (told == as_doubt) {
      EXPECT_THAT(texts.sentences, about_it);
      EXPECT_THAT(texts.written, HasSubstr(name()));
    } else {
      EXPECT_THAT(texts.sentences, testing::Not(about_it));
    }
  }

  Texts sweep_texts(std::optional<DoubtKind> kind) const {
    const StudyResult result = sweep(study(), simulator(kind), {});
    return {sentences_of(doubt_remarks(doubts_about(answer_of(result, 1)))),
            sweep_csv(result) + page_data(study_page(result, 1))};
  }
};

TEST_P(Doubts, ASweepTells) {
  const StudyResult result = sweep(study(), simulator(GetParam().kind), {});
  check(GetParam().sweep, sweep_texts(GetParam().kind));
  EXPECT_THAT(sweep_texts({}).sentences, testing::IsEmpty());
  if (GetParam().sweep == as_status) {
    EXPECT_THAT(sweep_csv(result), testing::AnyOf(HasSubstr(",stopped,"), HasSubstr(",incomplete,")));
  } else if (words_of(GetParam().kind).severity == Severity::serious) {
    EXPECT_THAT(sweep_csv(result), testing::AnyOf(HasSubstr(",doubtful,"), HasSubstr(",outside the model,")));
  } else {
    EXPECT_THAT(sweep_csv(result), HasSubstr(",ok,"));
  }
}

DecisionReport decided(const Study& study, const Simulator& simulator, std::optional<WantedRate> rate = {}) {
  DecideOptions options;
  options.rate = rate;
  options.goal = &goal_named("rate");
  options.margin = 0.05;
  options.most = 20;
  StudyDecision decision(study, options);
  lead_to_the_end(decision, simulator);
  return {decision.result(), {}};
}

/// The file has the kinds with their layouts, as decision.json has.
TEST_P(Doubts, OfASweepStandInAFile) {
  const StudyResult result = sweep(study(), simulator(GetParam().kind), {});
  for (const OutputFile& file : sweep_files(answer_of(result, 1), result, SweepRunsCsv(result.study), {})) {
    if (file.name != "doubts.json") continue;
    const auto doubts = nlohmann::json::parse(file.content).at("doubts");
    const auto about_it =
        std::find_if(doubts.begin(), doubts.end(), [](const auto& doubt) { return doubt.at("kind") == name(); });
    ASSERT_EQ(about_it != doubts.end(), GetParam().sweep == as_doubt);
    if (about_it != doubts.end()) {
      EXPECT_EQ(about_it->at("layouts"), (nlohmann::json{1, 2}));
    }
    return;
  }
  ADD_FAILURE() << "doubts.json is missing";
}

TEST_P(Doubts, ADecisionTells) {
  const Told told = GetParam().decision;
  const DecisionReport report = decided(study(), simulator(GetParam().kind));
  check(told, {sentences_of(doubt_remarks(doubts_about(answer_of(report.result)))),
               decision_csv(report) + decision_json(report)});
  if (told == as_doubt) {
    EXPECT_EQ(report.result.best, 1u) << "doubtful, and yet the best";
    const auto page = nlohmann::json::parse(page_data(study_page(report, {})));
    EXPECT_THAT(page["remarks"][0]["text"].get<std::string>(), HasSubstr(name()));
  }
  if (told == as_status) {
    EXPECT_THAT(decision_csv(report), HasSubstr(",failed,"));
  }
  if (told == as_clogged) {
    EXPECT_GT(report.result.scenes[0].clogged, 0);
  }
  if (told == as_missing) {
    EXPECT_EQ(report.result.cost.runs, 0);
  }
  const DecisionReport sound = decided(study(), simulator({}));
  EXPECT_THAT(doubts_about(answer_of(sound.result)), testing::IsEmpty());
}

/// A window that holds no whole period of the drive; of the scene, so not of the table.
TEST_F(DoubtsOfScenes, ADriveSlowerThanTheWindowIsTold) {
  const std::string name(words_of(DoubtKind::part_of_a_period).name);
  const StudyResult swept = sweep(study("0.1 Hz"), simulator({}), {});
  EXPECT_THAT(sentences_of(doubt_remarks(doubts_about(answer_of(swept, 1)))), Contains(HasSubstr(name)));
  EXPECT_EQ(swept.layouts[0].status, LayoutStanding::doubtful);
  const DecisionReport report = decided(study("0.1 Hz"), simulator({}));
  EXPECT_THAT(sentences_of(doubt_remarks(doubts_about(answer_of(report.result)))), Contains(HasSubstr(name)));
}

TEST_F(DoubtsOfScenes, AnAnswerThatNamesNoLayoutRestsOnAll) {
  const WantedRate unheard_of{.low = 1e3, .high = 2e3};  // kg/s
  const DecisionReport report = decided(study(), simulator(DoubtKind::guard_warned), unheard_of);
  EXPECT_FALSE(report.result.best.has_value());
  const Answer answer = answer_of(report.result);
  EXPECT_TRUE(answer.best_first.empty());
  EXPECT_THAT(sentences_of(doubt_remarks(doubts_about(answer))),
              Contains(testing::StartsWith("Doubtful: layouts 1, 2: the guard warned in ")));
}

OptimiseResult searched(const StudySource& source, const Simulator& simulator) {
  OptimiseOptions options;
  options.goals = read_front_goals({"rate", "power"});
  options.runs = 20;
  StudyOptimisation search(source, options);
  lead_to_the_end(search, simulator);
  return search.result();
}

TEST_P(Doubts, ASearchTells) {
  const Told told = GetParam().search;
  const StudySource source{
      files_.study("[set.contact]\nfriction_model = \"spring\"\nrolling = \"spring\"\nrolling_friction = 0.02\n"
                   "[set.tray.motion]\nkind = \"harmonic\"\namplitude = \"4 mm\"\nfrequency = \"10 Hz\"\n[vary]\n"
                   "tray.holes.width = [\"14 mm\", \"16 mm\"]\n")};
  const OptimiseResult result = searched(source, simulator(GetParam().kind));
  check(told,
        {sentences_of(doubt_remarks(doubts_about(answer_of(result)))), pareto_csv(result) + optimise_json(result)});
  if (told == as_doubt) {
    const auto page = nlohmann::json::parse(page_data(study_page(result, {})));
    EXPECT_THAT(page["remarks"][0]["text"].get<std::string>(), HasSubstr(name()));
  }
  if (told == as_status) {
    EXPECT_THAT(pareto_csv(result), HasSubstr(",failed,"));
  }
  if (told == as_clogged) {
    EXPECT_THAT(pareto_csv(result), HasSubstr(",clogs,"));
  }
  if (told == as_missing) {
    EXPECT_EQ(result.cost.runs, 0);
  }
}

TEST_P(Doubts, AnAccuracyStudyTells) {
  const Told told = GetParam().accuracy;
  const Scene scene = read_scene(files_.seeder(), {});
  AccuracyGrid grid = default_accuracy_grid(scene);
  grid.integrators = {Integrator::velocity_verlet};
  const AccuracyResult result =
      measure_accuracy(scene, screening_design(grid), 1, simulator(GetParam().kind), SweepOptions());
  const std::vector<std::string> sentences = sentences_of(doubt_remarks(doubts_about(result, scene), "setting"));
  if (told == as_doubt) {
    EXPECT_THAT(sentences, Contains(HasSubstr(name())));
    EXPECT_THAT(sentences.front(), HasSubstr("settings 1 to "));
  } else {
    EXPECT_THAT(sentences, Contains(HasSubstr("no rate")));
  }
}

CalibrationTask task_of(const StudyFiles& files, const std::string& csv) {
  CalibrationTask task;
  task.seeder = files.seeder();
  task.keys = {parse_fitted_key("contact.friction=0.1..0.8")};
  task.measured.file = "bench.csv";
  task.measured.table = read_measured(parse_csv_lines(csv, "bench.csv"));
  task.measured.scale = MeasuredScale::none;
  task.measured.time_zero = 2;
  task.most_runs = 12;
  return task;
}

/// The sentences of a calibration whose runs are so.
void check_calibration(Told told, const StudyFiles& files, const std::string& csv, DoubtKind kind,
                       const Simulator& simulator) {
  const CalibrationTask task = task_of(files, csv);
  const CalibrationDesign design = design_calibration(task, std::make_shared<SourceFiles>());
  const std::optional<std::vector<ReducedRun>> runs =
      reduced_runs(task, design, runs_on_demand(wanted_runs(design), simulator));
  ASSERT_EQ(runs.has_value(), told != as_missing);
  if (!runs) return;
  if (told == as_status) {
    EXPECT_FALSE(runs->front().reason.empty());
    return;
  }
  EXPECT_EQ(runs->front().reason, "");
  Calibration calibration;
  calibration.values.resize(1);
  const std::vector<std::string> sentences =
      sentences_of(doubt_remarks(answer_of(task, design, *runs, calibration).doubts));
  const auto about_it = Contains(HasSubstr(std::string(words_of(kind).name)));
  if (told == as_doubt)
    EXPECT_THAT(sentences, about_it);
  else
    EXPECT_THAT(sentences, testing::Not(about_it));
}

TEST_P(Doubts, ACalibrationOfRatesTells) {
  check_calibration(GetParam().rates, files_, "hole,seeds_per_s\nall,12\n", GetParam().kind,
                    simulator(GetParam().kind));
}

TEST_P(Doubts, ACalibrationOfACurveTellsWhatIsNotOfARate) {
  check_calibration(GetParam().curves, files_, "time_s,mass_g\n0.5,1\n1,2\n1.5,3\n1.9,4\n", GetParam().kind,
                    simulator(GetParam().kind));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Doubts, testing::ValuesIn(table), [](const auto& info) {
  std::string name(words_of(info.param.kind).name);
  std::ranges::replace(name, ' ', '_');
  return name;
});

TEST(DoubtTable, HasEveryKindOfARun) {
  std::vector<DoubtKind> of_a_run;
  for (int kind = 0; kind <= static_cast<int>(DoubtKind::few_seeds); ++kind)
    of_a_run.push_back(static_cast<DoubtKind>(kind));
  of_a_run.insert(of_a_run.end(), {DoubtKind::seeds_spilled, DoubtKind::flow_changed, DoubtKind::sizes_drawn});
  std::vector<DoubtKind> of_the_table;
  for (const KindAndAnswers& row : table) of_the_table.push_back(row.kind);
  EXPECT_EQ(of_the_table, of_a_run);
}

TEST(DoubtTable, EveryKindSaysWhatToDo) {
  for (int i = 0; i <= static_cast<int>(last_doubt_kind); ++i) {
    const DoubtWords& words = words_of(static_cast<DoubtKind>(i));
    EXPECT_FALSE(words.name.empty() || words.advice.empty() || words.advice.ends_with('.')) << words.name;
  }
}

TEST(SharedDoubts, JoinLayoutsAndCountTheirRuns) {
  const CountedDoubt warned{DoubtKind::guard_warned, 2, 3, "deep"},
      few{DoubtKind::few_seeds, 3, 3, "a rate from 3 seeds"};
  const CountedDoubt width{DoubtKind::unlikely_scene, 0, 0, "tray.holes.width: narrow"};
  const auto shared =
      shared_doubts({{1, {few, width}}, {2, {warned}}, {3, {warned, few}}, {4, {warned}}, {7, {width}}});
  ASSERT_EQ(shared.size(), 3u);
  EXPECT_EQ(sentence_of(remark_of(shared[0])).find("Doubtful: layouts 1, 7: tray.holes.width: narrow. What to do: "),
            0u);
  EXPECT_EQ(
      sentence_of(remark_of(shared[1])).find("Doubtful: layouts 2 to 4: the guard warned in 6 of 9 runs (deep). What"),
      0u);
  EXPECT_EQ(sentence_of(remark_of(shared[2])).find("Note: layouts 1, 3: few seeds in 6 of 6 runs"), 0u)
      << "serious ones first";
}

TEST(SharedDoubts, BeyondSixAreCounted) {
  std::vector<SharedDoubt> many(9, {DoubtKind::unlikely_scene, {1}, 0, 0, "a key"});
  const std::vector<Remark> remarks = doubt_remarks(many);
  ASSERT_EQ(remarks.size(), 7u);
  EXPECT_EQ(remarks.back().text, "3 more kinds of doubts: the table names them");
}

/// An answer of so many layouts that stand so, numbered from 1, each for its reason.
class LeftOut : public testing::Test {
 protected:
  std::vector<std::string> sentences(AnswerKind kind,
                                     const std::vector<std::pair<LayoutStanding, std::string>>& layouts) {
    study_.layouts.clear();
    Answer answer{kind, &study_};
    for (const auto& [standing, reason] : layouts) {
      answer.layouts.push_back({.layout = study_.layouts.size(), .standing = standing, .reason = reason});
      Layout layout;
      layout.number = static_cast<int>(answer.layouts.size());
      study_.layouts.push_back(layout);
    }
    return sentences_of(left_out_remarks(answer));
  }
  Study study_;
};

TEST_F(LeftOut, HasASentenceForEveryReason) {
  using enum LayoutStanding;
  EXPECT_THAT(sentences(AnswerKind::sweep, {{ok, ""},
                                            {stopped, "energy."},
                                            {invalid, "it does not fit"},
                                            {invalid, "it does not fit"},
                                            {invalid, "it does not fit"},
                                            {incomplete, ""},
                                            {outside_the_model, ""}}),
              testing::ElementsAre("Note: layout 2 was stopped by the guard: energy.",
                                   "Note: layouts 3 to 5 cannot be built: it does not fit.",
                                   "Note: layout 6 has runs that are missing."));
}

TEST_F(LeftOut, OfADecisionAreThoseThatFailedOrCannotBeBuilt) {
  using enum LayoutStanding;
  EXPECT_THAT(sentences(AnswerKind::decision, {{clogs, ""}, {failed, "hole 3 lies beyond the rim"}, {worse, ""}}),
              testing::ElementsAre("Note: layout 2 failed: hole 3 lies beyond the rim."));
}

TEST_F(LeftOut, BeyondSixReasonsTheRestIsCounted) {
  std::vector<std::pair<LayoutStanding, std::string>> layouts;
  for (int k = 0; k < 20; ++k) layouts.emplace_back(LayoutStanding::invalid, fmt::format("reason {}", k));
  const std::vector<std::string> all = sentences(AnswerKind::sweep, layouts);
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all[6], "Note: 14 more layouts are not compared, for other reasons: the table names them.");
}

}  // namespace
}  // namespace vibrosow
