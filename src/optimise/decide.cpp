#include "optimise/decide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outflow/outflow.hpp"
#include "scene/input_error.hpp"
#include "scene/spaces.hpp"
#include "selection/kim_nelson.hpp"
#include "selection/moments.hpp"
#include "selection/posterior.hpp"
#include "selection/rinott.hpp"
#include "study/layout_doubts.hpp"

namespace vibrosow {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

void check_rates(const Study& study, const DecideOptions& options) {
  if (!options.rate) return;
  for (const Layout& layout : study.layouts)
    if (layout.scene && study.scenes[*layout.scene].space == Space::two_dimensional &&
        !slices_of_tray(study.scenes[*layout.scene]))
      throw InputError(
          fmt::format("--rate: is of the whole tray, and layout {} is in 2D without tray.depth", layout.number));
}

std::unique_ptr<Procedure> procedure_of(SelectionRule rule, const Question& question) {
  if (rule == SelectionRule::posterior) return std::make_unique<Posterior>(question);
  return std::make_unique<KimNelson>(question);
}

/// Of the observations that two systems have in common; none for fewer than three, or without scatter.
std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  Moments of_a, of_b;
  double products = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    const double from_mean = a[i] - of_a.mean();
    of_a.add(a[i]);
    of_b.add(b[i]);
    products += from_mean * (b[i] - of_b.mean());
  }
  const double scatter = std::sqrt(of_a.variance() * of_b.variance());
  if (of_a.count() < 3 || !(scatter > 0)) return std::nullopt;
  return products / (of_a.count() - 1) / scatter;
}

}  // namespace

bool has_clogged(const Evaluation& run) {
  const HoleOutflow* const all = find_row(run.outflow, "all", "all");
  return run.finished() && (run.stopped_flowing() || !all || all->grains == 0);
}

bool tests_clogging(const Study& study, const DecideOptions& options) {
  return options.clogging_limit < 1 &&
         std::ranges::any_of(study.scenes, [](const Scene& scene) { return scene.run.end_after_pause.has_value(); });
}

std::string first_stop(const std::vector<Evaluation>& runs) {
  const auto stopped = std::ranges::find(runs, EvaluationStatus::stopped, &Evaluation::status);
  return stopped == runs.end() ? "" : fmt::format("random seed {}: {}", stopped->random_seed, stopped->reason);
}

std::optional<double> mean_correlation(const std::vector<std::vector<double>>& values) {
  Moments over_pairs;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const auto of_pair = correlation(values[i], values[j])) over_pairs.add(*of_pair);
  return over_pairs.count() > 0 ? std::optional(over_pairs.mean()) : std::nullopt;
}

StudyDecision::StudyDecision(const Study& study, const DecideOptions& options, const std::vector<bool>& taking_part)
    : study_(study),
      options_(options),
      runs_(study, study.scenes, options.first_random_seed),
      failures_(study.scenes.size()),
      counts_(study.scenes.size(), 0),
      tests_clogging_(tests_clogging(study, options)) {
  check_rates(study, options);
  options_.goal = &goal_between(*options.goal, study.scenes);
  for (std::size_t scene = 0; scene < study.scenes.size(); ++scene) {
    if (!taking_part.empty() && !taking_part[scene]) continue;
    systems_.push_back(scene);
  }
  if (systems_.size() < 2)
    throw InputError(fmt::format("{}: there is nothing to decide: it has one layout", study.title));
  Question question;
  question.systems = systems_.size();
  question.margin = options.margin;
  question.confidence = options.confidence;
  question.most = options.most;
  if (options.rate) question.band = Band{options.rate->low, options.rate->high};
  if (tests_clogging_) question.clogging_limit = options.clogging_limit;
  procedure_ = procedure_of(options.rule, question);
  if (const int least = procedure_->least_observations(); least > options.most)
    throw InputError(fmt::format("--most: the best takes {} runs at least, were none of them to clog; {} cannot decide",
                                 least, options.most));
}

void StudyDecision::request_next_round() {
  procedure_->request_next_round();
  for (std::size_t i = 0; i < systems_.size(); ++i) counts_[systems_[i]] = procedure_->counts()[i];
}

bool StudyDecision::take(const KeptRuns& kept, int jobs) {
  std::vector<std::size_t> had;
  for (const auto& of_scene : runs_.runs()) had.push_back(of_scene.size());
  if (!runs_.take(counts_, kept, jobs)) return false;
  for (std::size_t i = 0; i < systems_.size(); ++i)
    for (auto r = had[systems_[i]]; r < runs_.runs()[systems_[i]].size(); ++r)
      procedure_->take(i, observed(systems_[i], runs_.runs()[systems_[i]][r]));
  return true;
}

bool StudyDecision::is_left_out(const Evaluation& run) const {
  return has_clogged(run) && (tests_clogging_ || !options_.goal->of(run.outflow));
}

Observation StudyDecision::observed(std::size_t scene, const Evaluation& run) {
  const auto failed = [&](const std::string& reason) {
    if (failures_[scene].empty()) failures_[scene] = fmt::format("random seed {}: {}", run.random_seed, reason);
    return Observation{RunEnd::failed};
  };
  if (!run.finished()) return failed(run.reason);
  if (run.outside_the_model) return failed("outside the model");
  if (is_left_out(run)) return {RunEnd::clogged};
  const auto goal = options_.goal->of(run.outflow);
  if (!goal) return failed(std::string(options_.goal->if_none));
  const auto rate = options_.rate ? rate_as_wanted(*options_.rate, run.outflow) : std::optional(0.0);
  if (!rate) return failed(fmt::format("it has no {}", rate_metric(options_.rate).name));
  return {RunEnd::flowed, *goal, *rate};
}

std::size_t StudyDecision::left() const {
  const Decision decision = procedure_->decision();
  return static_cast<std::size_t>(std::ranges::count_if(decision.standings, [](Standing standing) {
    return standing == Standing::undecided || standing == Standing::best;
  }));
}

SceneDecision StudyDecision::metrics_of(std::size_t scene, const std::optional<RateKnowledge>& knowledge) const {
  SceneDecision metrics;
  metrics.reason = failures_[scene];
  metrics.stopped = first_stop(runs_.runs()[scene]);
  metrics.doubts = doubts_of_layout(study_.scenes[scene], runs_.runs()[scene], options_.clogging_limit < 1);
  const bool goal_is_rate = metric_named(options_.goal->metric).kind == Metric::Kind::rate;
  std::vector<CountedRate> goal_values, rates;
  std::vector<const Outflow*> counted, flowed;
  const auto rate_of = [&](const Outflow& outflow) {
    return options_.rate ? rate_as_wanted(*options_.rate, outflow) : metric_named("rate_g_per_s").of({outflow});
  };
  for (const Evaluation& run : runs_.runs()[scene]) {
    ++metrics.runs;
    metrics.clogged += has_clogged(run);
    if (!run.is_sound() || is_left_out(run)) continue;
    counted.push_back(&run.outflow);
    if (!has_clogged(run)) flowed.push_back(&run.outflow);
    if (const auto goal = options_.goal->of(run.outflow))
      goal_values.push_back({options_.goal->is_most ? -*goal : *goal, goal_is_rate ? run.outflow.seeds() : 0});
    if (const auto rate = rate_of(run.outflow)) rates.push_back({*rate, run.outflow.seeds()});
  }
  if (!goal_values.empty()) metrics.goal = mean_of_rates(goal_values);
  if (!rates.empty()) metrics.rate = mean_of_rates(rates);
  metrics.unevenness = unevenness_of(flowed);
  const ExpectedWithDoubts expected = expected_of(study_.scenes[scene], counted, knowledge);
  metrics.expected = expected.rate;
  for (const Doubt& doubt : expected.doubts) metrics.doubts.push_back({doubt.kind, 0, 0, doubt.text});
  return metrics;
}

/// By scene and random seed; not a number where the run is in no mean.
std::vector<std::vector<double>> StudyDecision::goals_by_run() const {
  std::vector<std::vector<double>> values;
  for (const std::size_t scene : systems_) {
    values.emplace_back();
    for (const Evaluation& run : runs_.runs()[scene]) {
      const bool counts = run.is_sound() && !is_left_out(run);
      values.back().push_back(counts ? options_.goal->of(run.outflow).value_or(none) : none);
    }
  }
  return values;
}

/// By the variances of at most the first ten runs that are in the means.
std::optional<DecisionCost> StudyDecision::equal_grid() const {
  constexpr int first = KimNelson::first_observations;
  std::vector<Moments> goals(systems_.size());
  double least = HUGE_VAL;
  const std::vector<std::vector<double>> values = goals_by_run();
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    for (const double value : values[i])
      if (!std::isnan(value) && goals[i].count() < first) goals[i].add(value);
    if (goals[i].count() > 1) least = std::min(least, goals[i].mean());
  }
  const double margin = options_.margin * std::abs(least);
  if (!(margin > 0) || !std::isfinite(margin)) return std::nullopt;
  const double h = rinott_h(systems_.size(), first, options_.confidence);
  DecisionCost cost;
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    const auto& runs = runs_.runs()[systems_[i]];
    if (runs.empty()) return std::nullopt;
    double steps = 0;
    for (const Evaluation& run : runs) steps += static_cast<double>(run.grain_steps) / static_cast<double>(runs.size());
    const double count = rinott_observations(h, goals[i].variance(), margin, first);
    cost.runs += count;
    cost.grain_steps += count * steps;
  }
  return cost;
}

DecisionResult StudyDecision::result() const {
  DecisionResult result;
  result.options = options_;
  result.study = study_;
  result.tests_clogging = tests_clogging_;
  const std::optional<RateKnowledge> knowledge = knowledge_for(study_);
  for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene) {
    result.scenes.push_back(metrics_of(scene, knowledge));
    result.scenes.back().is_screened_out = std::ranges::find(systems_, scene) == systems_.end();
  }
  const Decision decision = procedure_->decision();
  if (decision.best) result.best = systems_[*decision.best];
  result.is_sure = decision.is_sure;
  result.has_margin = decision.has_margin;
  for (std::size_t i = 0; i < systems_.size(); ++i) result.scenes[systems_[i]].standing = decision.standings[i];
  result.correlation = mean_correlation(goals_by_run());
  result.cost = {static_cast<double>(runs_.count()), runs_.grain_steps()};
  result.equal_grid = equal_grid();
  return result;
}

}  // namespace vibrosow
