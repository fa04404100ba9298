#include "cli/pareto_study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/optimise_text.hpp"
#include "cli/report_study.hpp"
#include "report/front_report.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

OptimiseOptions options_of(const OptimiseQuestion& question, std::uint64_t first_random_seed) {
  OptimiseOptions options;
  options.goals = read_front_goals(question.goals);
  options.rate = question.rate;
  options.clogging_limit = question.clogging_limit;
  options.spilled_limit = question.spilled_limit;
  options.confidence = question.confidence;
  options.runs = question.runs;
  options.first_random_seed = first_random_seed;
  return options;
}

std::string names_of_front_goals() {
  std::string names;
  for (const FrontGoal& goal : front_goals()) names += fmt::format("{}{}", names.empty() ? "" : ", ", goal.name);
  return names;
}

}  // namespace

void add_question_options(CLI::App& command, OptimiseWords& words) {
  command.add_option("--goals", words.goals, "what makes a layout good: " + names_of_front_goals())
      ->delimiter(',')
      ->type_name("GOAL")
      ->required();
  command.add_option("--rate", words.rate, "wanted rate of the whole tray: \"43 seeds/s +- 5 %\", \"12 g/min +- 5 %\"")
      ->type_name("RATE");
  command.add_option("--runs", words.runs, "largest number of runs")
      ->type_name("N")
      ->check(CLI::Range(search_runs_range.least, search_runs_range.most))
      ->capture_default_str();
  command.add_option("--clogging", words.clogging, "largest share of a layout's runs that may clog")
      ->type_name("SHARE")
      ->capture_default_str();
  command.add_option("--spilled", words.spilled, "largest share of the seeds that may leave over the rim; default any")
      ->type_name("SHARE");
  command.add_option("--confidence", words.confidence, "confidence of each statement about a layout")
      ->type_name("SHARE")
      ->capture_default_str();
}

OptimiseQuestion read_question(const OptimiseWords& words) {
  OptimiseQuestion question;
  for (const FrontGoal* goal : read_front_goals(words.goals)) question.goals.emplace_back(goal->name);
  if (!words.rate.empty()) question.rate = read_wanted_rate(words.rate);
  question.clogging_limit = share_option("--clogging", words.clogging, clogging_range);
  if (!words.spilled.empty()) question.spilled_limit = share_option("--spilled", words.spilled, spilled_range);
  question.confidence = share_option("--confidence", words.confidence, confidence_range);
  question.runs = words.runs;
  return question;
}

ParetoStudy::ParetoStudy(const std::filesystem::path& file, const std::vector<std::string>& sets,
                         std::uint64_t first_random_seed, const std::shared_ptr<SourceFiles>& files,
                         const OptimiseQuestion& question)
    : file_(file), files_(files), search_({file, overrides_of(sets), files}, options_of(question, first_random_seed)) {
  search_.request_next_round();
  plan_ = {name_in_plan(file, file), sets, first_random_seed, files_->planned_texts(file), search_.plan(), question};
}

ParetoStudy::ParetoStudy(const StudyPlan& plan)
    : ParetoStudy(path_of_planned(plan.study), plan.sets, plan.random_seed, SourceFiles::of_plan(plan.files),
                  std::get<OptimiseQuestion>(plan.question)) {
  if (!std::ranges::equal(plan.runs, plan_.runs, {}, &PlannedRun::name, &PlannedRun::name))
    throw InputError(
        fmt::format("{}: the plan was made by another version of the program, or of the models shipped with it; "
                    "optimise it again, which makes a new plan",
                    plan.study));
}

OutputFolder ParetoStudy::folder(const CommonOptions& options) const {
  return options.output_folder(std::string(OptimiseQuestion::command), optimise_file_texts());
}

bool ParetoStudy::run_to_decision(RoundExecutor& rounds) {
  const bool is_whole = rounds.run_to_decision(search_, [&] {
    if (!rounds.quiet() && rounds.made() > 0)
      complain(fmt::format("after {} new runs: {} layouts tried", rounds.made(), search_.tried()));
  });
  plan_.files = files_->planned_texts(file_);  // later layouts may have read more of them
  result_ = search_.result();
  result_.is_interrupted = !is_whole;
  return is_whole;
}

int ParetoStudy::report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const {
  const OptimiseResult& result = result_;
  std::vector<OutputFile> files = optimise_files(result, folder.path(), options.csv);
  if (!page.empty()) files.push_back({"report.html", page});
  write_then_print(
      options.quiet, [&] { folder.write(files); }, [&] { print("{}", optimise_text(result, folder.path().string())); });
  if (result.is_interrupted) return exit_interrupted;
  for (std::size_t i = 0; i < result.layouts.size(); ++i)
    if (!result.layouts[i].stopped.empty())
      return stopped_by_guard(result.study.layouts[i].number, result.layouts[i].stopped);
  return exit_done;
}

}  // namespace vibrosow
