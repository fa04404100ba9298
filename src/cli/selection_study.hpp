#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/adaptive_study.hpp"
#include "optimise/draft_screen.hpp"
#include "report/decision_report.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {

/// What `decide` is asked, in the words of its command line.
struct DecideWords {
  std::string goal, rate;
  std::string clogging = "5 %", within = "2 %", confidence = "95 %";
  std::string procedure = "guaranteed";
  int most = 400;
  bool drafts = false;
};

/// Adds --goal, --rate, --clogging, --within, --confidence, --procedure, --most and --drafts.
void add_question_options(CLI::App& command, DecideWords& words);

/// Throws InputError for a goal that is none, and for what is out of its range.
DecideQuestion read_question(const DecideWords& words);

/// A decision with the drafts before it, if any.
class SelectionStudy : public AdaptiveStudy {
 public:
  /// Throws InputError for what cannot be decided.
  SelectionStudy(PlannedStudy planned, const DecideQuestion& question);

  std::vector<std::string> warnings() const override { return study_warnings(planned_.study); }
  OutputFolder folder(const CommonOptions& options) const override;
  const StudyPlan& plan() const override { return planned_.plan; }
  bool run_to_decision(RoundExecutor& rounds) override;
  std::vector<PlannedRun> asked_for() const override { return asked_for_; }
  StudyPage page(const SweepTiming& timing) const override { return study_page(report_, timing); }
  int report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const override;

 private:
  bool run_drafts(RoundExecutor& rounds);

  PlannedStudy planned_;
  DecideOptions options_;
  std::optional<DraftScreen> drafts_;
  std::vector<PlannedRun> asked_for_;
  DecisionReport report_;
};

}  // namespace vibrosow
