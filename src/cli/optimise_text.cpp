#include "cli/optimise_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "answer/answer.hpp"
#include "report/answer_doubts.hpp"
#include "report/expected_report.hpp"
#include "report/front_report.hpp"
#include "report/layout_text.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

std::string with_unit(const std::optional<MeanWithInterval>& value, std::string_view unit, double size) {
  const std::string text = value ? with_interval(value, size) : "unknown";
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

/// "CV of a run 8.2 +- 0.4 %, power 1.4 W/kg, unevenness (CV) 7.1 % (6.2 to 8.3 %), 43.2 +- 0.5 seeds/s of the tray, 12
/// runs"
std::string metrics_text(const OptimiseResult& result, std::size_t layout) {
  const FrontLayout& of = result.layouts[layout];
  std::string text;
  for (std::size_t g = 0; g < of.goals.size(); ++g) {
    const FrontGoal& goal = *result.options.goals[g];
    text += fmt::format("{} {}, ", goal.words, with_unit(of.goals[g], goal.unit, goal.unit_size));
  }
  if (of.unevenness) text += fmt::format("unevenness (CV) {}, ", unevenness_text(*of.unevenness));
  if (const auto& rate = result.options.rate) {
    const Metric& metric = rate_metric(rate);
    text += fmt::format("{} of the tray{}, ", with_unit(of.rate, unit_of(metric), metric.unit_size),
                        of_plane(result.study.scenes[result.study.layouts[layout].scene.value()].space));
  }
  text += fmt::format("{} runs{}", of.runs, of.clogged > 0 ? fmt::format(", {} clogged", of.clogged) : "");
  return of.at_edge.empty() ? text : text + "; " + edge_text(of.at_edge);
}

/// The layouts of a standing that lead.
std::string leading_text(const OptimiseResult& result, FrontStanding standing) {
  std::string text;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const FrontLayout& of = result.layouts[i];
    if (of.standing != standing || !leads(of)) continue;
    const Layout& layout = result.study.layouts[i];
    const std::string label = fmt::format("{:>5}  ", layout.number);
    text += wrapped_beside(label, described(result.study, layout)) + wrapped(metrics_text(result, i), label.size());
  }
  return text;
}

std::string rest_text(const Answer& answer) {
  const std::string text = counted_standings(answer, [](const AnsweredLayout& one) { return one.is_named; });
  return text.empty() ? "" : wrapped(fmt::format("The other layouts that were tried: {} (pareto.csv).", text));
}

}  // namespace

std::string optimise_text(const OptimiseResult& result, const std::string& folder) {
  std::string text = result.study.title.empty() ? "" : wrapped(result.study.title) + "\n";
  const Answer answer = answer_of(result);
  if (result.is_interrupted) text += wrapped("Interrupted. So far:");
  if (result.is_interrupted &&
      std::ranges::all_of(result.layouts, [](const FrontLayout& one) { return one.runs == 0; }))
    return text + wrapped("No run was made, so nothing is known of any layout.") + wrapped(front_cost(result));
  const std::string sure = leading_text(result, FrontStanding::on_front);
  const std::string unsure = leading_text(result, FrontStanding::may_be_on_front);
  if (!sure.empty()) text += fmt::format("On the front:\n{}", sure);
  if (!unsure.empty()) text += fmt::format("First by their means, and may be on the front:\n{}", unsure);
  if (const std::string why = why_unsure(result); !why.empty()) text += wrapped(why);
  text += doubts_paragraph(doubts_about(answer));
  text += expected_paragraph(answer);
  if (sure.empty() && unsure.empty()) text += wrapped("No layout meets the constraints by its means.");
  text += fmt::format("\n{}{}{}", rest_text(answer), left_out_paragraph(answer), wrapped(front_promise(result)));
  text += wrapped(front_cost(result));
  if (std::ranges::count_if(result.layouts, leads) < 2) return text;
  const std::uint64_t random_seed = result.options.first_random_seed;  // else it would take none of the runs
  return text + fmt::format(
                    "To decide among these by one goal:\n  vibrosow decide {0}/front.toml --goal GOAL --reuse {0}{1}\n",
                    folder, random_seed == 1 ? "" : fmt::format(" --random-seed {}", random_seed));
}

}  // namespace vibrosow
