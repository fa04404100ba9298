#include "answer/answer.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

namespace vibrosow {
namespace {

using enum LayoutStanding;
using Values = std::vector<std::optional<MeanWithInterval>>;

LayoutStanding standing_of(const SceneDecision& of) {
  if (of.is_screened_out) return ruled_out_by_drafts;
  switch (of.standing) {
    case Standing::best:
      return best;
    case Standing::not_shown_worse:
      return not_shown_worse;
    case Standing::worse:
      return worse;
    case Standing::misses_the_rate:
      return misses_the_rate;
    case Standing::clogs:
      return clogs;
    case Standing::failed:
      return failed;
    case Standing::undecided:
      break;
  }
  return undecided;
}

LayoutStanding standing_of(const FrontLayout& of, const OptimiseOptions& options) {
  switch (of.standing) {
    case FrontStanding::on_front:
      return on_front;
    case FrontStanding::may_be_on_front:
      return may_be_on_front;
    case FrontStanding::dominated:
      return dominated;
    case FrontStanding::misses_a_band:
      if (options.rate) return options.spilled_limit ? misses_the_rate_or_spills : misses_the_rate;
      return spills;
    case FrontStanding::clogs:
      return clogs;
    case FrontStanding::failed:
      break;
  }
  return failed;
}

AnswerMetric metric_of(const Metric& metric) {
  return {metric.name, metric.heading, metric.unit, metric.unit_size, metric.description, !metric.is_pooled()};
}

AnswerMetric clogged() {
  return {.name = clogged_metric,
          .unit = "%",
          .unit_size = 1e-2,
          .description = "share of its runs that clogged; the other figures are of the rest",
          .has_interval = false,
          .wanted = Wanted::low};
}

std::optional<MeanWithInterval> share(int part, int of) {
  return MeanWithInterval{static_cast<double>(part) / of, std::nullopt};
}

bool has(const std::vector<AnswerMetric>& metrics, std::string_view name) {
  return std::ranges::find(metrics, name, &AnswerMetric::name) != metrics.end();
}

/// Of some layouts, those with a value of a figure, the least first or the most.
void sort_by(Answer& answer, std::size_t metric, bool most_first) {
  const auto mean = [&](std::size_t layout) { return answer.layouts[layout].values[metric]->mean; };
  std::erase_if(answer.best_first, [&](std::size_t layout) {
    const Values& values = answer.layouts[layout].values;
    return values.empty() || !values[metric];
  });
  std::ranges::stable_sort(answer.best_first, {},
                           [&](std::size_t layout) { return (most_first ? -1 : 1) * mean(layout); });
}

AnsweredLayout that_cannot_be_built(std::size_t index, const Layout& layout) {
  return {.layout = index, .reason = layout.invalid};
}

}  // namespace

/// Of the figures those that any layout has. The largest rates are worth a look.
Answer answer_of(const StudyResult& result, std::uint64_t first_random_seed) {
  Answer answer{.kind = AnswerKind::sweep, .study = &result.study, .first_random_seed = first_random_seed};
  std::vector<const Metric*> known;
  for (const Metric& metric : metrics())
    if (std::ranges::any_of(result.layouts, [&](const LayoutResult& one) { return one.metrics[metric].has_value(); }))
      known.push_back(&metric), answer.metrics.push_back(metric_of(metric));
  const auto rate = std::ranges::find(answer.metrics, "rate_g_per_s", &AnswerMetric::name);
  if (rate != answer.metrics.end()) rate->is_goal = true, rate->wanted = Wanted::high;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const LayoutResult& of = result.layouts[i];
    AnsweredLayout one{.layout = i,
                       .standing = of.status,
                       .reason = of.reason,
                       .doubts = of.doubts,
                       .runs = of.replicates,
                       .is_named = true,
                       .holes = of.holes,
                       .misfit_percent = of.misfit_percent,
                       .expected = of.expected};
    for (const Metric* metric : known) one.values.push_back(of.metrics[*metric]);
    if (is_compared(one.standing)) answer.best_first.push_back(i);
    answer.layouts.push_back(std::move(one));
  }
  if (rate == answer.metrics.end())
    answer.best_first.clear();
  else
    sort_by(answer, static_cast<std::size_t>(rate - answer.metrics.begin()), true);
  return answer;
}

/// The best, then those that are not shown to be worse, or are undecided, by their means.
Answer answer_of(const DecisionResult& result) {
  const DecideOptions& options = result.options;
  Answer answer{.kind = AnswerKind::decision, .study = &result.study, .first_random_seed = options.first_random_seed};
  AnswerMetric goal = metric_of(metric_named(options.goal->metric));
  goal.description = options.goal->description, goal.has_interval = true, goal.is_goal = true;
  goal.wanted = options.goal->is_most ? Wanted::high : Wanted::low;
  answer.metrics.push_back(goal);
  const Metric& rate = rate_metric(options.rate);
  const bool shows_rate = !has(answer.metrics, rate.name);
  if (shows_rate) answer.metrics.push_back(metric_of(rate));
  answer.metrics.push_back(clogged());
  for (std::size_t i = 0; i < result.study.layouts.size(); ++i) {
    const Layout& layout = result.study.layouts[i];
    if (!layout.scene) {
      answer.layouts.push_back(that_cannot_be_built(i, layout));
      continue;
    }
    const SceneDecision& of = result.scenes[*layout.scene];
    AnsweredLayout one{
        .layout = i, .standing = standing_of(of), .reason = of.reason, .doubts = of.doubts, .runs = of.runs};
    one.expected = of.expected;
    one.is_named = one.standing == best || one.standing == not_shown_worse || one.standing == undecided;
    if (of.runs > 0) {
      one.values.push_back(of.goal);
      if (shows_rate) one.values.push_back(of.rate);
      one.values.push_back(share(of.clogged, of.runs));
    }
    if (one.is_named) answer.best_first.push_back(i);
    answer.layouts.push_back(std::move(one));
  }
  sort_by(answer, 0, options.goal->is_most);
  std::stable_partition(answer.best_first.begin(), answer.best_first.end(),
                        [&](std::size_t i) { return result.study.layouts[i].scene == result.best; });
  return answer;
}

/// Those that lead, in the order in which they were tried.
Answer answer_of(const OptimiseResult& result) {
  const OptimiseOptions& options = result.options;
  Answer answer{.kind = AnswerKind::search, .study = &result.study, .first_random_seed = options.first_random_seed};
  for (const FrontGoal* goal : options.goals) {
    const bool is_most = goal->metric != nullptr && goal->metric->is_most;
    answer.metrics.push_back({.name = goal->column,
                              .unit = goal->unit,
                              .unit_size = goal->unit_size,
                              .description = goal->description,
                              .wanted = is_most ? Wanted::high : Wanted::low,
                              .is_goal = true});
  }
  const Metric& rate = rate_metric(options.rate);
  const bool shows_rate = !has(answer.metrics, rate.name);
  if (shows_rate) answer.metrics.push_back(metric_of(rate));
  answer.metrics.push_back(clogged());
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const Layout& layout = result.study.layouts[i];
    if (!layout.scene) {
      answer.layouts.push_back(that_cannot_be_built(i, layout));
      continue;
    }
    const FrontLayout& of = result.layouts[i];
    AnsweredLayout one{.layout = i,
                       .standing = standing_of(of, options),
                       .reason = of.reason,
                       .doubts = of.doubts,
                       .runs = of.runs,
                       .is_named = leads(of),
                       .is_first_by_means = of.is_first_by_means,
                       .at_edge = of.at_edge,
                       .expected = of.expected};
    if (of.runs > 0) {
      one.values = of.goals;
      if (shows_rate) one.values.push_back(of.rate);
      one.values.push_back(share(of.clogged, of.runs));
    }
    if (one.is_named) answer.best_first.push_back(i);
    answer.layouts.push_back(std::move(one));
  }
  return answer;
}

bool has_failed(LayoutStanding standing) {
  return standing == LayoutStanding::failed || standing == LayoutStanding::invalid;
}

std::vector<SharedDoubt> doubts_about(const Answer& answer) {
  const bool names_any = std::ranges::any_of(answer.layouts, &AnsweredLayout::is_named);
  const auto rests_on = [&](const AnsweredLayout& one) { return names_any ? one.is_named : !has_failed(one.standing); };
  std::vector<LayoutDoubts> doubts;
  for (const AnsweredLayout& one : answer.layouts)
    if (rests_on(one)) doubts.push_back({answer.study->layouts[one.layout].number, one.doubts});
  return shared_doubts(doubts);
}

}  // namespace vibrosow
