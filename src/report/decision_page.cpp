#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

#include "report/answer_doubts.hpp"
#include "report/decision_words.hpp"
#include "report/layout_text.hpp"
#include "report/study_page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

/// "Layout 7 (count 5, frequency 9 Hz)"
std::string named(const Study& study, const Layout& layout) {
  const std::string text = described(study, layout);
  return text.empty() ? fmt::format("Layout {}", layout.number) : fmt::format("Layout {} ({})", layout.number, text);
}

std::string numbers_of_undecided(const Answer& answer) {
  std::vector<int> numbers;
  for (const AnsweredLayout& one : answer.layouts)
    if (one.standing == LayoutStanding::undecided) numbers.push_back(answer.study->layouts[one.layout].number);
  return fmt::format("{}", fmt::join(numbers, ", "));
}

std::string headline(const DecisionResult& result, const Answer& answer) {
  if (!result.is_sure) {
    const std::string text = undecided_sentence(result);
    return tells_who_is_left(result) ? fmt::format("{} {}.", text, numbers_of_undecided(answer)) : text;
  }
  for (const Layout& layout : result.study.layouts)
    if (layout.scene && layout.scene == result.best)
      return fmt::format("{} is the best: {}. {}", named(result.study, layout),
                         metrics_sentence(result, *layout.scene, "±"), promise_sentence(result));
  return no_best_sentence(result);
}

std::vector<Remark> remarks(const DecisionReport& report, const Answer& answer) {
  const DecisionResult& result = report.result;
  std::vector<Remark> all = doubt_remarks(doubts_about(answer));
  const auto add = [&](std::string text) { all.push_back({Severity::mild, std::move(text)}); };
  if (result.is_sure && result.best && !is_guaranteed(result)) add(weakness_sentence());
  if (report.drafts && report.drafts->screens) add(drafts_sentence(*report.drafts));
  if (!result.tests_clogging && result.options.clogging_limit < 1) add(clogging_untested_sentence());
  std::ranges::move(left_out_remarks(answer), std::back_inserter(all));
  return all;
}

std::vector<std::pair<std::string, std::string>> asked(const DecisionResult& result) {
  const DecideOptions& options = result.options;
  std::vector<std::pair<std::string, std::string>> all;
  const auto add = [&](const std::string& name, const std::string& value) { all.emplace_back(name, value); };
  add("goal", fmt::format("{}: {}", options.goal->words, options.goal->description));
  if (options.rate) {
    const Metric& metric = rate_metric(options.rate);
    add("rate of the tray", fmt::format("{} to {} {}", to_digits(options.rate->low / metric.unit_size, 4),
                                        to_digits(options.rate->high / metric.unit_size, 4), unit_of(metric)));
  }
  if (result.tests_clogging) add("clogs in fewer than", percent_text(options.clogging_limit) + " of runs");
  add("a difference that does not matter", percent_text(options.margin) + " of the best's mean");
  add("wanted", sureness_text(options));
  add("procedure", is_guaranteed(result) ? "guaranteed" : "posterior");
  add("runs of a layout at most", fmt::format("{}", options.most));
  return all;
}

std::vector<std::string> cost(const DecisionReport& report, const SweepTiming& timing) {
  std::vector<std::string> all = {cost_sentence(report.result)};
  for (const std::string& text : {page_timing(timing), correlation_sentence(report.result)})
    if (!text.empty()) all.push_back(text);
  if (report.drafts && !report.drafts->screens) all.push_back(drafts_sentence(*report.drafts));
  return all;
}

}  // namespace

StudyPage study_page(const DecisionReport& report, const SweepTiming& timing) {
  const DecisionResult& result = report.result;
  StudyPage page{.answer = answer_of(result)};
  page.headline = headline(result, page.answer);
  page.remarks = remarks(report, page.answer);
  page.asked = asked(result);
  page.wanted = result.options.rate;
  page.cost = cost(report, timing);
  page.confidence = sureness_text(result.options);
  return page;
}

FileText decision_page_text() {
  return {"report.html", "with --html: the answer and the layouts to look at in any browser, each drawn", {}};
}

}  // namespace vibrosow
