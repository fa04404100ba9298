#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

#include "report/answer_doubts.hpp"
#include "report/decision_words.hpp"
#include "report/front_report.hpp"
#include "report/layout_text.hpp"
#include "report/study_page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

/// "CV of a run and power"
std::string goals_text(const OptimiseOptions& options) {
  std::string text;
  for (std::size_t g = 0; g < options.goals.size(); ++g)
    text += fmt::format("{}{}", g == 0 ? "" : g + 1 == options.goals.size() ? " and " : ", ", options.goals[g]->words);
  return text;
}

std::string headline(const OptimiseResult& result) {
  const auto count = [&](FrontStanding standing) {
    return std::ranges::count(result.layouts, standing, &FrontLayout::standing);
  };
  const auto sure = count(FrontStanding::on_front), unsure = count(FrontStanding::may_be_on_front);
  const std::string of = fmt::format("of {} that were tried", result.layouts.size());
  if (sure + unsure == 0) return fmt::format("No layout {} is known to meet the constraints.", of);
  const std::string may_be = fmt::format("{} layout{} may be", unsure, unsure == 1 ? "" : "s");
  const std::string front = fmt::format("on the front of {}", goals_text(result.options));
  if (sure == 0) return fmt::format("{} {}, {}; none is shown to be.", may_be, front, of);
  const std::string shown = fmt::format("{} layout{} {}", sure, sure == 1 ? " is" : "s are", front);
  return unsure == 0 ? fmt::format("{}, {}.", shown, of) : fmt::format("{}, {}; {} more may be.", shown, of, unsure);
}

std::vector<Remark> remarks(const OptimiseResult& result, const Answer& answer) {
  std::vector<Remark> all = doubt_remarks(doubts_about(answer));
  if (result.is_interrupted) all.push_back({Severity::mild, "Interrupted", "the same command resumes"});
  if (const std::string why = why_unsure(result); !why.empty()) all.push_back({Severity::mild, why});
  all.push_back({Severity::mild, front_promise(result)});
  std::ranges::move(left_out_remarks(answer), std::back_inserter(all));
  return all;
}

std::vector<std::pair<std::string, std::string>> asked(const OptimiseOptions& options) {
  std::vector<std::pair<std::string, std::string>> all;
  const auto add = [&](const std::string& name, const std::string& value) { all.emplace_back(name, value); };
  for (const FrontGoal* goal : options.goals) add("goal", fmt::format("{}: {}", goal->words, goal->description));
  if (options.rate) {
    const Metric& metric = rate_metric(options.rate);
    add("rate of the tray", fmt::format("{} to {} {}", to_digits(options.rate->low / metric.unit_size, 4),
                                        to_digits(options.rate->high / metric.unit_size, 4), unit_of(metric)));
  }
  add("clogs in at most", percent_text(options.clogging_limit) + " of runs");
  if (options.spilled_limit) add("spills at most", percent_text(*options.spilled_limit) + " of the seeds");
  add("confidence of each standing", percent_text(options.confidence));
  add("runs at most", fmt::format("{}", options.runs));
  return all;
}

std::vector<std::string> cost(const OptimiseResult& result, const SweepTiming& timing) {
  std::vector<std::string> all = {front_cost(result)};
  if (const std::string text = page_timing(timing); !text.empty()) all.push_back(text);
  return all;
}

}  // namespace

StudyPage study_page(const OptimiseResult& result, const SweepTiming& timing) {
  StudyPage page{.answer = answer_of(result), .headline = headline(result)};
  page.remarks = remarks(result, page.answer);
  page.asked = asked(result.options);
  page.wanted = result.options.rate;
  page.cost = cost(result, timing);
  return page;
}

FileText front_page_text() {
  return {"report.html", "with --html: the front and the layouts to look at in any browser, each drawn", {}};
}

}  // namespace vibrosow
