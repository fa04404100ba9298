#include "cli/selection_study.hpp"

#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/decision_text.hpp"
#include "cli/report_study.hpp"

namespace vibrosow {
namespace {

DecideOptions options_of(const DecideQuestion& question, std::uint64_t first_random_seed) {
  DecideOptions options;
  options.goal = &goal_named(question.goal);
  options.rate = question.rate;
  options.clogging_limit = question.clogging_limit;
  options.margin = question.margin;
  options.confidence = question.confidence;
  options.rule = question.rule;
  options.most = question.most;
  options.first_random_seed = first_random_seed;
  return options;
}

std::string names_of_goals() {
  std::string names;
  for (const Goal& goal : goals()) names += fmt::format("{}{}", names.empty() ? "" : ", ", goal.name);
  return names;
}

/// Tells of each layout that drops out while runs are made.
class LayoutsLeft {
 public:
  void tell(const StudyDecision& decision, const RoundExecutor& rounds) {
    const std::size_t left = decision.left();
    if (!rounds.quiet() && rounds.made() > told_at_ && left != left_)
      complain(
          fmt::format("after {} new runs: {} layout{} may be the best", rounds.made(), left, left == 1 ? "" : "s"));
    left_ = left;
    told_at_ = rounds.made();
  }

 private:
  std::size_t left_ = 0;
  std::int64_t told_at_ = 0;
};

}  // namespace

void add_question_options(CLI::App& command, DecideWords& words) {
  command.add_option("--goal", words.goal, "what makes a layout good: " + names_of_goals())
      ->type_name("GOAL")
      ->required();
  command.add_option("--rate", words.rate, "wanted rate of the whole tray: \"43 seeds/s +- 5 %\", \"12 g/min +- 5 %\"")
      ->type_name("RATE");
  command.add_option("--clogging", words.clogging, "largest share of runs in which a layout may clog")
      ->type_name("SHARE")
      ->capture_default_str();
  command.add_option("--within", words.within, "difference that does not matter, as a share of the best mean")
      ->type_name("SHARE")
      ->capture_default_str();
  command.add_option("--confidence", words.confidence, "confidence in the decision")
      ->type_name("SHARE")
      ->capture_default_str();
  command.add_option("--procedure", words.procedure, "guaranteed, or posterior: fewer runs, no guarantee")
      ->type_name("NAME")
      ->check(CLI::IsMember({"guaranteed", "posterior"}))
      ->capture_default_str();
  command.add_option("--most", words.most, "largest number of runs of a layout")
      ->type_name("N")
      ->check(CLI::Range(most_runs_range.least, most_runs_range.most))
      ->capture_default_str();
  command.add_flag("--drafts", words.drafts,
                   "let quick runs with softer seeds rule layouts out, if they are shown to agree with the others");
}

DecideQuestion read_question(const DecideWords& words) {
  DecideQuestion question{std::string(goal_named(words.goal).name)};
  if (!words.rate.empty()) question.rate = read_wanted_rate(words.rate);
  question.clogging_limit = share_option("--clogging", words.clogging, clogging_range);
  question.margin = share_option("--within", words.within, margin_range);
  question.confidence = share_option("--confidence", words.confidence, confidence_range);
  question.rule = words.procedure == "posterior" ? SelectionRule::posterior : SelectionRule::guaranteed;
  question.most = words.most;
  question.drafts = words.drafts;
  return question;
}

SelectionStudy::SelectionStudy(PlannedStudy planned, const DecideQuestion& question)
    : planned_(std::move(planned)), options_(options_of(question, planned_.plan.random_seed)) {
  StudyDecision decision(planned_.study, options_);
  if (question.drafts) drafts_.emplace(planned_.study, options_);
  decision.request_next_round();
  planned_.plan.runs = decision.plan();
  planned_.plan.question = question;
}

OutputFolder SelectionStudy::folder(const CommonOptions& options) const {
  return options.output_folder(std::string(DecideQuestion::command), decision_file_texts());
}

bool SelectionStudy::run_drafts(RoundExecutor& rounds) {
  if (!drafts_) return true;
  const bool is_whole = rounds.run_to_decision(*drafts_, [] {});
  report_.drafts = drafts_->findings();
  return is_whole;
}

bool SelectionStudy::run_to_decision(RoundExecutor& rounds) {
  const bool has_drafts = run_drafts(rounds);
  StudyDecision decision(planned_.study, options_, report_.drafts ? report_.drafts->taking_part : std::vector<bool>());
  decision.request_next_round();
  LayoutsLeft left;
  const bool is_whole = has_drafts && rounds.run_to_decision(decision, [&] { left.tell(decision, rounds); });
  planned_.plan.runs = decision.plan();
  asked_for_ = has_drafts ? decision.plan() : drafts_->plan();
  report_.result = decision.result();
  report_.result.is_interrupted = !is_whole;
  if (!is_whole) report_.result.is_sure = false;
  if (report_.result.cost.runs == 0)  // a procedure that has seen nothing knows nothing of any layout
    for (SceneDecision& scene : report_.result.scenes) scene.standing = Standing::undecided;
  return is_whole;
}

int SelectionStudy::report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const {
  std::vector<OutputFile> files = decision_files(report_, options.csv);
  if (!page.empty()) files.push_back({"report.html", page});
  write_then_print(
      options.quiet, [&] { folder.write(files); }, [&] { print("{}", decision_text(report_)); });
  if (report_.result.is_interrupted) return exit_interrupted;
  for (const Layout& layout : report_.result.study.layouts)
    if (layout.scene && !report_.result.scenes[*layout.scene].stopped.empty())
      return stopped_by_guard(layout.number, report_.result.scenes[*layout.scene].stopped);
  return exit_done;
}

}  // namespace vibrosow
