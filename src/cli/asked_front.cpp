#include "cli/asked_front.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/optimise_text.hpp"
#include "cli/report_study.hpp"
#include "report/front_page.hpp"
#include "report/front_report.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

OptimiseOptions options_of(const OptimiseQuestion& question, std::uint64_t first_random_seed) {
  OptimiseOptions options;
  options.goals = read_front_goals(question.goals);
  if (!question.rate.empty()) options.rate = read_wanted_rate(question.rate);
  options.clogging_limit = share_option("--clogging", question.clogging, 0.001, 1, "0.1 % to 100 %");
  if (!question.spilled.empty())
    options.spilled_limit = share_option("--spilled", question.spilled, 0.0001, 1, "0.01 % to 100 %");
  options.confidence = share_option("--confidence", question.confidence, 0.6, 0.9999, "60 % to 99.99 %");
  options.runs = question.runs;
  options.first_random_seed = first_random_seed;
  return options;
}

/// What a plan keeps of it, what is not said included.
std::vector<std::string> words_of(const OptimiseQuestion& question) {
  std::vector<std::string> words = {std::string(AskedFront::command),
                                    fmt::format("--goals={}", fmt::join(question.goals, ",")),
                                    fmt::format("--runs={}", question.runs), "--clogging=" + question.clogging,
                                    "--confidence=" + question.confidence};
  if (!question.rate.empty()) words.push_back("--rate=" + question.rate);
  if (!question.spilled.empty()) words.push_back("--spilled=" + question.spilled);
  return words;
}

OptimiseQuestion optimise_question_in(const StudyPlan& plan) {
  CLI::App app;
  OptimiseQuestion question;
  add_question_options(app, question);
  read_asked(plan, app);
  return question;
}

std::string names_of_front_goals() {
  std::string names;
  for (const FrontGoal& goal : front_goals()) names += fmt::format("{}{}", names.empty() ? "" : ", ", goal.name);
  return names;
}

}  // namespace

void add_question_options(CLI::App& command, OptimiseQuestion& question) {
  command.add_option("--goals", question.goals, "what makes a layout good: " + names_of_front_goals())
      ->delimiter(',')
      ->type_name("GOAL")
      ->required();
  command.add_option("--rate", question.rate, "wanted of the tray: \"43 seeds/s +- 5 %\", \"12 g/min +- 5 %\"")
      ->type_name("RATE");
  command.add_option("--runs", question.runs, "that it may take")
      ->type_name("N")
      ->check(CLI::Range(8, 1000000))
      ->capture_default_str();
  command.add_option("--clogging", question.clogging, "share of a layout's runs that may clog")
      ->type_name("SHARE")
      ->capture_default_str();
  command.add_option("--spilled", question.spilled, "share of the seeds that may leave over the rim; default any")
      ->type_name("SHARE");
  command.add_option("--confidence", question.confidence, "of what is said of a layout")
      ->type_name("SHARE")
      ->capture_default_str();
}

AskedFront::AskedFront(const std::filesystem::path& file, const std::vector<std::string>& sets,
                       std::uint64_t first_random_seed, const std::shared_ptr<SourceFiles>& files,
                       const OptimiseQuestion& question)
    : file_(file), files_(files), search_({file, overrides_of(sets), files}, options_of(question, first_random_seed)) {
  search_.wanted();
  plan_ = {name_in_plan(file, file),    sets,           first_random_seed,
           files_->planned_texts(file), search_.plan(), words_of(question)};
}

AskedFront::AskedFront(const StudyPlan& plan)
    : AskedFront(path_of_planned(plan.study), plan.sets, plan.random_seed, SourceFiles::of_plan(plan.files),
                 optimise_question_in(plan)) {
  if (!std::ranges::equal(plan.runs, plan_.runs, {}, &PlannedRun::name, &PlannedRun::name))
    throw InputError(
        fmt::format("{}: the plan was made by another version of the program, or of the models shipped with it; "
                    "optimise it again, which makes a new plan",
                    plan.study));
}

OutputFolder AskedFront::folder(const CommonOptions& options) const {
  return options.output_folder(std::string(command), optimise_file_texts());
}

bool AskedFront::lead(RoundsOfRuns& rounds) {
  is_interrupted_ = !rounds.lead(search_, [&] {
    if (!rounds.quiet() && rounds.made() > 0)
      complain(fmt::format("after {} new runs: {} layouts tried", rounds.made(), search_.tried()));
  });
  plan_.files = files_->planned_texts(file_);  // later layouts may have read more of them
  return !is_interrupted_;
}

OptimiseResult AskedFront::result() const {
  OptimiseResult result = search_.result();
  result.is_interrupted = is_interrupted_;
  return result;
}

std::vector<WantedReplay> AskedFront::best_to_replay(std::size_t most) const {
  return vibrosow::best_to_replay(result(), most);
}

std::string AskedFront::page_data(const SweepTiming& timing, const Replays& replays) const {
  return front_page_data(result(), timing, replays);
}

int AskedFront::report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const {
  const OptimiseResult result = this->result();
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
