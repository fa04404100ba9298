#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/asked_study.hpp"
#include "design/draft_screen.hpp"
#include "design/planned_study.hpp"
#include "report/decision_report.hpp"

namespace vibrosow {

/// What `decide` is asked, in the words of its command line.
struct DecideQuestion {
  std::string goal, rate;
  std::string clogging = "5 %", within = "2 %", confidence = "95 %";
  std::string procedure = "guaranteed";
  int most = 400;
  bool drafts = false;
};

/// Adds --goal, --rate, --clogging, --within, --confidence, --procedure, --most and --drafts.
void add_question_options(CLI::App& command, DecideQuestion& question);

/// A decision with the drafts before it, if any.
class AskedDecision : public AskedStudy {
 public:
  static constexpr std::string_view command = "decide";

  /// Throws InputError for what cannot be decided.
  AskedDecision(PlannedStudy planned, const DecideQuestion& question);
  explicit AskedDecision(const StudyPlan& plan);

  std::vector<std::string> warnings() const override { return study_warnings(planned_.study); }
  OutputFolder folder(const CommonOptions& options) const override;
  const StudyPlan& plan() const override { return planned_.plan; }
  bool lead(RoundsOfRuns& rounds) override;
  std::vector<PlannedRun> asked_for() const override { return asked_for_; }
  std::vector<WantedReplay> best_to_replay(std::size_t most) const override;
  std::string page_data(const SweepTiming& timing, const Replays& replays) const override;
  int report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const override;

 private:
  bool lead_drafts(RoundsOfRuns& rounds);

  PlannedStudy planned_;
  DecideOptions options_;
  std::optional<DraftScreen> drafts_;
  std::vector<PlannedRun> asked_for_;
  DecisionReport report_;
};

}  // namespace vibrosow
