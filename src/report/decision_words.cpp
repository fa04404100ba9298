#include "report/decision_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/layout_text.hpp"
#include "report/number_text.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {

std::string percent_text(double fraction) {
  return to_digits(100 * fraction, 4) + " %";
}

std::string constraints_text(const DecisionResult& result) {
  std::string text;
  if (result.options.rate) text = "meets the rate";
  if (result.tests_clogging)
    text += fmt::format("{}clogs in fewer than {} of runs", text.empty() ? "" : " and ",
                        percent_text(result.options.clogging_limit));
  return text;
}

std::string sureness_text(const DecideOptions& options) {
  return fmt::format("{} of {}", options.rule == SelectionRule::posterior ? "posterior probability" : "confidence",
                     percent_text(options.confidence));
}

std::string promise_sentence(const DecisionResult& result) {
  const std::string met = constraints_text(result);
  return fmt::format("{} a {}, no other layout{} is more than {} better.",
                     met.empty() ? "With" : fmt::format("It {}. With", met), sureness_text(result.options),
                     met.empty() ? "" : " that does so", percent_text(result.options.margin));
}

bool is_guaranteed(const DecisionResult& result) {
  return result.options.rule == SelectionRule::guaranteed;
}

std::string weakness_sentence() {
  return "That is no guarantee: among layouts that all lie about that far behind the best this rule is wrong clearly "
         "more often (docs/explanation/how-the-best-layout-is-found.md). For a guarantee: --procedure guaranteed, "
         "which uses these runs.";
}

std::string metrics_sentence(const DecisionResult& result, std::size_t scene, std::string_view plus_minus) {
  const SceneDecision& of = result.scenes[scene];
  const DecideOptions& options = result.options;
  const auto in_metric = [&](const MeanWithInterval& value, const Metric& metric) {
    return fmt::format("{} {}", with_interval(value, metric.unit_size, plus_minus), unit_of(metric));
  };
  std::string text;
  if (of.goal)
    text = fmt::format("{} {}, ", options.goal->words, in_metric(*of.goal, metric_named(options.goal->metric)));
  if (of.unevenness) text += fmt::format("unevenness (CV) {}, ", unevenness_text(*of.unevenness));
  if (options.rate && of.rate)
    text += fmt::format("{} of the tray{}, ", in_metric(*of.rate, rate_metric(options.rate)),
                        of_plane(result.study.scenes[scene].space));
  if (!result.tests_clogging && of.clogged > 0)
    return text + (options.clogging_limit < 1
                       ? fmt::format("nothing came in {} of {} runs, which count as 0", of.clogged, of.runs)
                       : fmt::format("clogged in {} of {} runs, which count as they are", of.clogged, of.runs));
  return text + fmt::format("clogged in {} of {} runs", of.clogged, of.runs);
}

bool tells_who_is_left(const DecisionResult& result) {
  return result.has_margin && !(result.is_interrupted && result.cost.runs == 0);
}

std::string undecided_sentence(const DecisionResult& result) {
  if (result.is_interrupted && result.cost.runs == 0)
    return "Interrupted in the first round of runs: the same command resumes. No layout is ruled out.";
  if (!result.has_margin)
    return fmt::format(
        "Undecided: the best {} is 0, and so is any share of it, so --within cannot tell layouts apart by this goal.",
        result.options.goal->words);
  if (result.is_interrupted) return "Interrupted: the same command resumes. So far not ruled out:";
  return fmt::format(
      "Undecided: after {} runs of a layout (--most) these cannot be told apart, or it is not known whether they meet "
      "the constraints:",
      result.options.most);
}

std::string no_best_sentence(const DecisionResult& result) {
  const std::string constraints = constraints_text(result);
  if (constraints.empty()) return "No layout can be compared.";
  return fmt::format("With a {}, no layout {}.", sureness_text(result.options), constraints);
}

std::string cost_sentence(const DecisionResult& result) {
  std::string text = fmt::format("Cost: {} runs, {} grain-steps", static_cast<long long>(result.cost.runs),
                                 count_text(result.cost.grain_steps));
  if (result.equal_grid)
    text += fmt::format(
        "; without leaving layouts out early (Rinott's procedure) it would be {} runs, {} grain-steps for the same "
        "confidence",
        static_cast<long long>(result.equal_grid->runs), count_text(result.equal_grid->grain_steps));
  return text + ".";
}

std::string correlation_sentence(const DecisionResult& result) {
  if (!result.correlation) return "";
  return fmt::format("Runs of different layouts under one random seed correlate by {:.2f}{}.", *result.correlation,
                     *result.correlation > 0 ? ": differences are surer than each value" : "");
}

std::string drafts_sentence(const DraftFindings& drafts) {
  if (!drafts.correlation)
    return fmt::format("Drafts: only {} of the pilot layouts have the goal both ways; they decide nothing.",
                       drafts.pilots);
  const auto ruled_out = std::ranges::count(drafts.taking_part, false);
  const std::string so =
      drafts.screens ? fmt::format("{} layouts are ruled out by them, which the confidence does not cover", ruled_out)
                     : fmt::format("below {:g} they decide nothing", DraftScreen::least_correlation);
  return fmt::format(
      "Drafts: means of {} pilot layouts correlate by {:.2f} with those at the study's accuracy; {}. They took {} "
      "runs, {} grain-steps.",
      drafts.pilots, *drafts.correlation, so, static_cast<long long>(drafts.cost.runs),
      count_text(drafts.cost.grain_steps));
}

std::string clogging_untested_sentence() {
  return "Clogging is not tested: no layout has run.end_after_pause.";
}

}  // namespace vibrosow
