#include "cli/decision_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cli/layout_text.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

std::string percent_text(double fraction) {
  return to_digits(100 * fraction, 4) + " %";
}

std::string in_figure(const std::optional<MeanWithInterval>& value, std::string_view name) {
  const Figure& figure = figure_named(name);
  const std::string_view unit = name == "tray_seeds_per_s" ? "seeds/s" : figure.unit;
  return value ? fmt::format("{} {}", with_interval(value, figure.unit_size), unit) : "";
}

/// "evenness 8.2 +- 0.4 %, 43.2 +- 0.5 seeds/s, clogged in 0 of 203 runs"
std::string figures_text(const DecideOptions& options, const SceneDecision& of) {
  std::string text = fmt::format("{} {}", options.goal->name, in_figure(of.goal, options.goal->figure));
  if (options.rate && of.rate) text += fmt::format(", {} of the tray", in_figure(of.rate, options.rate->figure));
  return text + fmt::format(", clogged in {} of {} runs", of.clogged, of.runs);
}

std::string layout_text(const DecisionReport& report, const Layout& layout) {
  const DecisionResult& result = report.result;
  const std::string label = fmt::format("{:>5}  ", layout.number);
  return wrapped_beside(label, described(result.study, layout)) +
         wrapped(figures_text(result.options, result.scenes[layout.scene.value()]), label.size());
}

std::string layouts_that_are(const DecisionReport& report, const std::string& standing) {
  std::string text;
  for (const Layout& layout : report.result.study.layouts)
    if (standing_text(report, layout) == standing) text += layout_text(report, layout);
  return text;
}

std::string constraints_text(const DecisionResult& result) {
  std::string text;
  if (result.options.rate) text = "meets the rate";
  if (result.tests_clogging)
    text += fmt::format("{}clogs in fewer than {} of runs", text.empty() ? "" : " and ",
                        percent_text(result.options.clogging_limit));
  return text;
}

/// "confidence of 95 %"
std::string sureness_text(const DecideOptions& options) {
  return fmt::format("{} of {}", options.rule == SelectionRule::posterior ? "posterior probability" : "confidence",
                     percent_text(options.confidence));
}

std::string promise_text(const DecisionResult& result) {
  const DecideOptions& options = result.options;
  const std::string met = constraints_text(result);
  const std::string among = met.empty() ? "No other" : fmt::format("It {}; no other that does so", met);
  const std::string weakness =
      options.rule == SelectionRule::guaranteed
          ? ""
          : " That is no guarantee: among layouts that all lie about that far behind the best this rule is wrong "
            "clearly "
            "more often (docs/DECIDING.md). For a guarantee: --procedure guaranteed, which goes on from these runs.";
  return wrapped(fmt::format("{} is better by more than {}: with a {}.{}", among, percent_text(options.margin),
                             sureness_text(options), weakness));
}

std::string undecided_text(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  if (!result.has_margin)
    return wrapped(fmt::format(
        "Undecided: the least {} is 0, and so is any share of it: --within cannot tell layouts apart by this goal.",
        result.options.goal->name));
  if (result.is_interrupted && result.cost.runs == 0)
    return wrapped(
        "Interrupted in the first round of runs: the same command goes on from here. No layout is ruled out.");
  if (result.is_interrupted) return wrapped("Interrupted: the same command goes on from here. So far not ruled out:");
  return wrapped(
      fmt::format("Undecided: after {} runs of a layout (--most) these cannot be told apart, or it is not "
                  "known whether they meet the constraints:",
                  result.options.most));
}

std::string answer_text(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  if (!result.is_sure)
    return undecided_text(report) + (result.cost.runs == 0 ? "" : layouts_that_are(report, "undecided"));
  if (!result.best)
    return wrapped(constraints_text(result).empty() ? std::string("No layout can be compared.")
                                                    : fmt::format("No layout {}: with a {}.", constraints_text(result),
                                                                  sureness_text(result.options)));
  const std::string others = layouts_that_are(report, "not shown to be worse");
  return fmt::format("The best:\n{}{}{}{}", layouts_that_are(report, "best"), promise_text(result),
                     others.empty() ? "" : "\nLeft behind, but not shown to be worse:\n", others);
}

/// "38 worse, 12 misses the rate"
std::string rest_text(const DecisionReport& report) {
  std::map<std::string, int> counts;
  for (const Layout& layout : report.result.study.layouts) ++counts[standing_text(report, layout)];
  std::string text;
  for (const auto& [standing, count] : counts)
    if (standing != "best" && standing != "undecided" &&
        !(report.result.is_sure && standing == "not shown to be worse"))
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", standing, count);
  return text.empty() ? "" : fmt::format("\n{}", wrapped(fmt::format("Of the others, {} (decision.csv).", text)));
}

std::string failures_text(const DecisionReport& report) {
  std::string text;
  for (const Layout& layout : report.result.study.layouts) {
    const std::string reason = layout.scene ? report.result.scenes[*layout.scene].reason : layout.invalid;
    if (!reason.empty()) text += wrapped(fmt::format("Layout {} is left out: {}", layout.number, reason));
  }
  return text;
}

std::string cost_text(const DecisionResult& result) {
  std::string text = fmt::format("Cost: {} runs, {:.3g} grain-steps", static_cast<long long>(result.cost.runs),
                                 result.cost.grain_steps);
  if (result.equal_grid)
    text += fmt::format(
        "; a grid that is run without looking (Rinott's procedure) takes {} runs, {:.3g} grain-steps "
        "for the same confidence",
        static_cast<long long>(result.equal_grid->runs), result.equal_grid->grain_steps);
  return wrapped(text + ".");
}

std::string correlation_text(const DecisionResult& result) {
  if (!result.correlation) return "";
  return wrapped(fmt::format(
      "Runs of different layouts under one random seed correlate by {:.2f}{}.", *result.correlation,
      *result.correlation < DraftScreen::least_correlation
          ? fmt::format("; below {:g} nothing is claimed of common random numbers", DraftScreen::least_correlation)
          : ": differences are surer than each value"));
}

std::string drafts_text(const DraftFindings& drafts) {
  if (!drafts.correlation)
    return wrapped(fmt::format("Drafts: only {} of the pilot layouts have the goal both ways; they decide nothing.",
                               drafts.pilots));
  const auto ruled_out = std::ranges::count(drafts.taking_part, false);
  const std::string so =
      drafts.screens ? fmt::format("{} layouts are ruled out by them, which the confidence does not cover", ruled_out)
                     : fmt::format("below {:g} they decide nothing", DraftScreen::least_correlation);
  return wrapped(fmt::format(
      "Drafts: means of {} pilot layouts correlate by {:.2f} with those at the study's accuracy; "
      "{}. They took {} runs, {:.3g} grain-steps.",
      drafts.pilots, *drafts.correlation, so, static_cast<long long>(drafts.cost.runs), drafts.cost.grain_steps));
}

}  // namespace

std::string decision_text(const DecisionReport& report) {
  const DecisionResult& result = report.result;
  std::string text = result.study.title.empty() ? "" : wrapped(result.study.title) + "\n";
  text += answer_text(report) + rest_text(report) + failures_text(report) + "\n";
  if (!result.tests_clogging && result.options.clogging_limit < 1)
    text += wrapped("Clogging is not tested: no layout has run.end_after_pause.");
  if (report.drafts) text += drafts_text(*report.drafts);
  return text + cost_text(result) + correlation_text(result);
}

}  // namespace vibrosow
