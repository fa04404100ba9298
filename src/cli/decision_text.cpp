#include "cli/decision_text.hpp"

#include <fmt/format.h>

#include "answer/answer.hpp"
#include "report/answer_doubts.hpp"
#include "report/decision_words.hpp"
#include "report/expected_report.hpp"
#include "report/layout_text.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

std::string layouts_that_are(const DecisionResult& result, const Answer& answer, LayoutStanding standing) {
  std::string text;
  for (const AnsweredLayout& one : answer.layouts) {
    if (one.standing != standing) continue;
    const Layout& layout = result.study.layouts[one.layout];
    const std::string label = fmt::format("{:>5}  ", layout.number);
    text += wrapped_beside(label, described(result.study, layout)) +
            wrapped(metrics_sentence(result, layout.scene.value()), label.size());
  }
  return text;
}

std::string answer_text(const DecisionResult& result, const Answer& answer) {
  const std::string doubts = doubts_paragraph(doubts_about(answer));
  const auto that_are = [&](LayoutStanding standing) { return layouts_that_are(result, answer, standing); };
  if (!result.is_sure)
    return wrapped(undecided_sentence(result)) +
           (result.cost.runs == 0 ? "" : that_are(LayoutStanding::undecided) + doubts);
  if (!result.best) return wrapped(no_best_sentence(result)) + doubts;
  std::string promise = promise_sentence(result);
  if (!is_guaranteed(result)) promise += ' ' + weakness_sentence();
  const std::string others = that_are(LayoutStanding::not_shown_worse);
  return fmt::format("The best:\n{}{}{}{}{}", that_are(LayoutStanding::best), doubts, wrapped(promise),
                     others.empty() ? "" : "\nBehind the best, but not shown to be worse:\n", others);
}

std::string rest_text(const DecisionResult& result, const Answer& answer) {
  const std::string text = counted_standings(answer, [&](const AnsweredLayout& one) {
    return one.is_named && (result.is_sure || one.standing != LayoutStanding::not_shown_worse);
  });
  return text.empty() ? "" : fmt::format("\n{}", wrapped(fmt::format("The others: {} (decision.csv).", text)));
}

}  // namespace

std::string decision_text(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  std::string text = result.study.title.empty() ? "" : wrapped(result.study.title) + "\n";
  const Answer answer = answer_of(result);
  text += answer_text(result, answer) + rest_text(result, answer) + left_out_paragraph(answer) + "\n";
  text += expected_paragraph(answer);
  if (!result.tests_clogging && result.options.clogging_limit < 1) text += wrapped(clogging_untested_sentence());
  if (report.drafts) text += wrapped(drafts_sentence(*report.drafts));
  const std::string correlation = correlation_sentence(result);
  return text + wrapped(cost_sentence(result)) + (correlation.empty() ? "" : wrapped(correlation));
}

}  // namespace vibrosow
