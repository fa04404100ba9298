#include "cli/decision_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report/answer_doubts.hpp"
#include "report/decision_words.hpp"
#include "report/layout_text.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

std::string in_figure(const std::optional<MeanWithInterval>& value, std::string_view name) {
  const Figure& figure = figure_named(name);
  const std::string_view unit = name == "tray_seeds_per_s" ? "seeds/s" : figure.unit;
  return value ? fmt::format("{} {}", with_interval(value, figure.unit_size), unit) : "";
}

/// "CV of a run 8.2 +- 0.4 %, unevenness (CV) 7.1 % (6.2 to 8.3 %), 43.2 +- 0.5 seeds/s, clogged in 0 of 203 runs"
std::string figures_text(const DecideOptions& options, const SceneDecision& of, Space space) {
  std::string text = fmt::format("{} {}", options.goal->words, in_figure(of.goal, options.goal->figure));
  if (of.unevenness) text += fmt::format(", unevenness (CV) {}", unevenness_text(*of.unevenness));
  if (options.rate && of.rate)
    text += fmt::format(", {} of the tray{}", in_figure(of.rate, options.rate->figure), of_plane(space));
  return text + fmt::format(", clogged in {} of {} runs", of.clogged, of.runs);
}

std::string layout_text(const DecisionReport& report, const Layout& layout) {
  const DecisionResult& result = report.result;
  const std::string label = fmt::format("{:>5}  ", layout.number);
  return wrapped_beside(label, described(result.study, layout)) +
         wrapped(figures_text(result.options, result.scenes[layout.scene.value()],
                              result.study.scenes[*layout.scene].space),
                 label.size());
}

std::string layouts_that_are(const DecisionReport& report, Standing standing) {
  std::string text;
  for (const Layout& layout : report.result.study.layouts)
    if (stands(report.result, layout, standing)) text += layout_text(report, layout);
  return text;
}

std::string answer_text(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  if (!result.is_sure)
    return wrapped(undecided_sentence(result)) +
           (result.cost.runs == 0
                ? ""
                : layouts_that_are(report, Standing::undecided) + doubts_paragraph(doubts_about(report)));
  if (!result.best) return wrapped(no_best_sentence(result));
  std::string promise = promise_sentence(result);
  if (!is_guaranteed(result)) promise += ' ' + weakness_sentence();
  const std::string others = layouts_that_are(report, Standing::not_shown_worse);
  return fmt::format("The best:\n{}{}{}{}{}", layouts_that_are(report, Standing::best),
                     doubts_paragraph(doubts_about(report)), wrapped(promise),
                     others.empty() ? "" : "\nLeft behind, but not shown to be worse:\n", others);
}

/// "38 worse, 12 misses the rate"
std::string rest_text(const DecisionReport& report) {
  std::map<std::string, int> counts;
  for (const Layout& layout : report.result.study.layouts) {
    const DecisionResult& result = report.result;
    const bool is_told = stands(result, layout, Standing::best) || stands(result, layout, Standing::undecided) ||
                         (result.is_sure && stands(result, layout, Standing::not_shown_worse));
    if (!is_told) ++counts[standing_text(report, layout)];
  }
  std::string text;
  for (const auto& [standing, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, standing);
  return text.empty() ? "" : fmt::format("\n{}", wrapped(fmt::format("The others: {} (decision.csv).", text)));
}

std::string failures_text(const DecisionReport& report) {
  std::string text;
  for (const Layout& layout : report.result.study.layouts) {
    const std::string reason = layout.scene ? report.result.scenes[*layout.scene].reason : layout.invalid;
    if (!reason.empty()) text += wrapped(fmt::format("Layout {} is left out: {}", layout.number, reason));
  }
  return text;
}

}  // namespace

std::string decision_text(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  std::string text = result.study.title.empty() ? "" : wrapped(result.study.title) + "\n";
  text += answer_text(report) + rest_text(report) + failures_text(report) + "\n";
  if (!result.tests_clogging && result.options.clogging_limit < 1) text += wrapped(clogging_untested_sentence());
  if (report.drafts) text += wrapped(drafts_sentence(*report.drafts));
  const std::string correlation = correlation_sentence(result);
  return text + wrapped(cost_sentence(result)) + (correlation.empty() ? "" : wrapped(correlation));
}

}  // namespace vibrosow
