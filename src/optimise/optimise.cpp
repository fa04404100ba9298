#include "optimise/optimise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "outflow/outflow.hpp"
#include "scene/input_error.hpp"
#include "scene/spaces.hpp"
#include "selection/known_mean.hpp"
#include "study/layout_doubts.hpp"
#include "study/study_grid.hpp"

namespace vibrosow {
namespace {

using Kind = FrontGoal::Kind;

constexpr double endless = HUGE_VAL;

/// As they are, then those that goals ask for.
std::vector<Variant> variants_of(const std::vector<const FrontGoal*>& goals) {
  std::vector<Variant> variants{Variant::as_it_is};
  for (const FrontGoal* goal : goals) variants.insert(variants.end(), goal->asks_for.begin(), goal->asks_for.end());
  return variants;
}

FrontQuestion question_of(const OptimiseOptions& options) {
  FrontQuestion question;
  question.first = StudyOptimisation::first_runs;
  question.confidence = options.confidence;
  if (options.clogging_limit < 1) question.clogging_limit = options.clogging_limit;
  for (const FrontGoal* goal : options.goals) {
    Aim aim{std::nullopt, goal->kind == Kind::power};
    if (goal->kind == Kind::rate_error) aim.nearest_to = 1;  // the rate over the wanted one
    if (!goal->asks_for.empty()) aim.nearest_to = 0;
    question.goals.push_back(aim);
  }
  if (options.rate) question.bands.push_back({options.rate->low, options.rate->high});
  if (options.spilled_limit) question.bands.push_back({-endless, *options.spilled_limit});
  return question;
}

bool has(const OptimiseOptions& options, Kind kind) {
  return std::ranges::any_of(options.goals, [&](const FrontGoal* goal) { return goal->kind == kind; });
}

/// A Latin hypercube of four points an axis, ten at least, on which a quarter of the runs is spent at most.
std::size_t first_points(const StudySpace& space, int observations) {
  if (space.proposals) return *space.proposals;
  const std::size_t most = static_cast<std::size_t>(observations / 4 / StudyOptimisation::first_runs);
  return std::max<std::size_t>(2, std::min(std::max<std::size_t>(10, 4 * space.values.size()), most));
}

std::optional<MeanWithInterval> in_interval(const KnownMean& known) {
  if (known.count == 0) return std::nullopt;
  if (known.variance == 0 && std::isinf(known.degrees_of_freedom)) return MeanWithInterval{known.mean, std::nullopt};
  if (known.degrees_of_freedom <= 0) return MeanWithInterval{known.mean, std::nullopt};
  const double degrees = std::min(known.degrees_of_freedom, 1e6);
  return MeanWithInterval{known.mean, student_t_95(degrees) * std::sqrt(known.error_squared())};
}

/// Whether a goal is the metric that rates are shown as where none is wanted.
bool is_rate(const FrontGoal* goal) {
  return goal->metric != nullptr && goal->metric->metric == rate_metric(std::nullopt).name;
}

}  // namespace

bool leads(const FrontLayout& layout) {
  return layout.standing == FrontStanding::on_front || layout.is_first_by_means;
}

StudyOptimisation::StudyOptimisation(StudySource source, const OptimiseOptions& options)
    : source_(std::move(source)),
      options_(options),
      space_(read_study_space(source_.file, source_.overrides, source_.files)),
      variants_(variants_of(options.goals)) {
  if (has(options_, Kind::rate_error) && !options_.rate)
    throw InputError("--goals: rate_error needs the rate that is wanted (--rate)");
  FrontSearchOptions search;
  search.values = space_.values;
  search.budget = options_.runs / static_cast<int>(variants_.size());
  search.first_points = first_points(space_, search.budget);
  if (static_cast<int>(search.first_points) * first_runs > search.budget)
    throw InputError(fmt::format("--runs: {} do not take {} first layouts {} times each, of {} variants", options_.runs,
                                 search.first_points, first_runs, variants_.size()));
  search.question = question_of(options_);
  search_ = std::make_unique<FrontSearch>(std::move(search));
  search_->request_next_round();
  build_new_layouts();
  if (generations_.front()->study.scenes.empty()) throw InputError(generations_.front()->study.layouts.front().invalid);
  warnings_ = study_warnings(generations_.front()->study);
}

std::vector<double> StudyOptimisation::share_of(const FrontSearch::Point& point) const {
  std::vector<double> share;
  for (std::size_t axis = 0; axis < point.size(); ++axis)
    share.push_back((static_cast<double>(point[axis]) + 0.5) / static_cast<double>(space_.values[axis]));
  return share;
}

/// What goals and constraints ask of every scene.
void StudyOptimisation::check(const Study& study) const {
  for (const Scene& scene : study.scenes) {
    if (options_.rate && scene.space == Space::two_dimensional && !slices_of_tray(scene))
      throw InputError("--rate: is of the whole tray, and the seeder is in 2D without tray.depth");
    if (has(options_, Kind::power)) drive_power(scene);
  }
  std::vector<Scene> all = study.scenes;  // beside one of the first, which was like all before these
  if (!generations_.empty() && !generations_.front()->study.scenes.empty())
    all.push_back(generations_.front()->study.scenes.front());
  for (const FrontGoal* goal : options_.goals)
    if (goal->metric != nullptr && &goal_between(*goal->metric, all) != goal->metric)
      throw InputError("--goals: rate is of a 2D slice, and slices of these layouts differ; take space = \"3d\"");
}

void StudyOptimisation::build_new_layouts() {
  if (trials_.size() == search_->points().size()) return;
  std::vector<std::vector<double>> points;
  for (std::size_t i = trials_.size(); i < search_->points().size(); ++i)
    points.push_back(share_of(search_->points()[i]));
  auto generation = std::make_unique<Generation>();
  generation->study = read_study_at(source_.file, source_.overrides, source_.files, points);
  check(generation->study);
  for (Layout& layout : generation->study.layouts) {
    const std::size_t point = trials_.size();
    layout.number = static_cast<int>(point) + 1;
    trials_.push_back({generations_.size(), layout.scene});
    if (!layout.scene) search_->leave_out(point);
  }
  for (const Variant variant : variants_) {
    generation->scenes.emplace_back();
    for (const Scene& scene : generation->study.scenes) generation->scenes.back().push_back(variant_of(scene, variant));
  }
  for (const std::vector<Scene>& scenes : generation->scenes)
    generation->runs.emplace_back(generation->study, scenes, options_.first_random_seed);
  generation->counts.assign(generation->study.scenes.size(), 0);
  generations_.push_back(std::move(generation));
}

void StudyOptimisation::request_next_round() {
  do {
    search_->request_next_round();
    build_new_layouts();
    const std::vector<int>& counts = search_->counts();
    for (std::size_t i = 0; i < trials_.size(); ++i)
      if (const auto scene = trials_[i].scene) {
        int& count = generations_[trials_[i].generation]->counts[*scene];
        count = std::max(count, counts[i]);
      }
  } while (missing().empty() && tell_search());
}

std::vector<WantedRun> StudyOptimisation::missing() const {
  std::vector<WantedRun> all;
  for (const auto& generation : generations_)
    for (const SceneRuns& runs : generation->runs) {
      std::vector<WantedRun> missing = runs.missing(generation->counts);
      all.insert(all.end(), std::make_move_iterator(missing.begin()), std::make_move_iterator(missing.end()));
    }
  return all;
}

bool StudyOptimisation::take(const KeptRuns& kept, int jobs) {
  for (const auto& generation : generations_)
    for (SceneRuns& runs : generation->runs)
      if (!runs.take(generation->counts, kept, jobs)) return false;
  tell_search();
  return true;
}

/// Of the runs that are there what it asked for; false where that is nothing. Layouts of one scene share its runs.
bool StudyOptimisation::tell_search() {
  search_->request_next_round();
  const std::vector<int> counts = search_->counts();
  bool is_new = trials_.size() < counts.size();  // layouts of which none could be built
  for (std::size_t i = 0; i < trials_.size(); ++i)
    if (trials_[i].scene)
      for (int r = search_->front().observations(i); r < counts[i]; ++r, is_new = true)
        search_->take(i, observed(trials_[i], static_cast<std::size_t>(r)));
  return is_new;
}

const Evaluation& StudyOptimisation::evaluation(Variant variant, const Trial& trial, std::size_t run) const {
  const auto index = static_cast<std::size_t>(std::ranges::find(variants_, variant) - variants_.begin());
  return generations_[trial.generation]->runs.at(index).runs()[trial.scene.value()].at(run);
}

double StudyOptimisation::rate_as(Variant variant, const Trial& trial, std::size_t run) const {
  return metric_named("rate_g_per_s").of({evaluation(variant, trial, run).outflow}).value_or(0);
}

/// None where the run has no such figure.
std::optional<double> StudyOptimisation::goal_of(const FrontGoal& goal, const Trial& trial, std::size_t run) const {
  const Outflow& outflow = evaluation(Variant::as_it_is, trial, run).outflow;
  if (goal.kind == Kind::metric) return goal.metric->of(outflow);
  if (goal.kind == Kind::power) return drive_power(generations_[trial.generation]->study.scenes[trial.scene.value()]);
  if (goal.kind == Kind::rate_error) {
    const auto rate = rate_as_wanted(*options_.rate, outflow);
    return rate ? std::optional(2 * *rate / (options_.rate->low + options_.rate->high)) : std::nullopt;
  }
  const double rate = rate_as(Variant::as_it_is, trial, run);
  if (!(rate > 0)) return std::nullopt;
  if (goal.kind == Kind::fill_sensitivity) return (1 - rate_as(Variant::less_fill, trial, run) / rate) / fill_change;
  return (rate_as(Variant::faster, trial, run) - rate_as(Variant::slower, trial, run)) / rate / (2 * frequency_change);
}

FrontObservation StudyOptimisation::observed(Trial& trial, std::size_t run) const {
  const auto failed = [&](std::uint64_t random_seed, const std::string& reason) {
    if (trial.failure.empty()) trial.failure = fmt::format("random seed {}: {}", random_seed, reason);
    return FrontObservation{RunEnd::failed};
  };
  bool clogged = false;
  for (const Variant variant : variants_) {
    const Evaluation& one = evaluation(variant, trial, run);
    if (!one.finished()) return failed(one.random_seed, one.reason);
    if (one.outside_the_model) return failed(one.random_seed, "outside the model");
    clogged |= has_clogged(one);
  }
  if (clogged && options_.clogging_limit < 1) return {RunEnd::clogged};
  const Evaluation& whole = evaluation(Variant::as_it_is, trial, run);
  FrontObservation seen;
  for (const FrontGoal* goal : options_.goals) {
    const auto value = goal_of(*goal, trial, run);
    if (!value && clogged) return {RunEnd::clogged};
    if (!value) return failed(whole.random_seed, fmt::format("it has no {}", goal->column));
    seen.goals.push_back(*value);
  }
  const auto add = [&](const std::optional<double>& value) { seen.banded.push_back(value.value_or(0)); };
  if (options_.rate) add(rate_as_wanted(*options_.rate, whole.outflow));
  if (options_.spilled_limit) add(metric_named("spilled_percent").of({whole.outflow}));
  return seen;
}

/// Of a continuum the last fiftieth counts as its end; a key of two values has no other than its ends.
std::vector<std::string> StudyOptimisation::keys_at_edge(const FrontSearch::Point& point) const {
  std::vector<std::string> keys;
  for (std::size_t axis = 0; axis < point.size(); ++axis) {
    const std::size_t values = space_.values[axis], end = values / 50;
    if (values > 2 && (point[axis] <= end || point[axis] + 1 + end >= values)) keys.push_back(space_.keys[axis]);
  }
  return keys;
}

FrontLayout StudyOptimisation::layout_result(std::size_t layout, FrontStanding standing, bool is_first,
                                             const std::optional<RateKnowledge>& knowledge) const {
  const Trial& trial = trials_[layout];
  FrontLayout result;
  result.standing = standing;
  result.is_first_by_means = is_first;
  result.at_edge = keys_at_edge(search_->points()[layout]);
  result.reason = trial.failure;
  result.goals.resize(options_.goals.size());
  if (!trial.scene) return result;
  for (const SceneRuns& runs : generations_[trial.generation]->runs)
    if (result.stopped.empty()) result.stopped = first_stop(runs.runs()[*trial.scene]);
  const Generation& generation = *generations_[trial.generation];
  std::vector<Evaluation> of_all_variants;
  for (const SceneRuns& runs : generation.runs)
    std::ranges::copy(runs.runs()[*trial.scene], std::back_inserter(of_all_variants));
  result.doubts = doubts_of_layout(generation.study.scenes[*trial.scene], of_all_variants, options_.clogging_limit < 1);
  result.runs = search_->front().observations(layout);
  const std::vector<KnownMean> known = search_->front().known(layout);
  for (std::size_t g = 0; g < options_.goals.size(); ++g) {
    const FrontGoal& goal = *options_.goals[g];
    result.goals[g] = in_interval(known[g]);
    if (!result.goals[g]) continue;
    double& mean = result.goals[g]->mean;
    if (goal.kind == Kind::rate_error) mean = std::abs(mean - 1);
    if (!goal.asks_for.empty()) mean = std::abs(mean);
    if (goal.metric != nullptr && goal.metric->is_most) mean = -mean;
  }
  std::vector<CountedRate> rates;
  std::vector<const Outflow*> counted, flowed;
  for (std::size_t r = 0; r < static_cast<std::size_t>(result.runs); ++r) {
    const Evaluation& run = evaluation(Variant::as_it_is, trial, r);
    result.clogged +=
        std::ranges::any_of(variants_, [&](Variant variant) { return has_clogged(evaluation(variant, trial, r)); });
    if (!run.is_sound() || (has_clogged(run) && options_.clogging_limit < 1)) continue;
    rates.push_back({rate_as(Variant::as_it_is, trial, r), run.outflow.seeds()});
    counted.push_back(&run.outflow);
    if (!has_clogged(run)) flowed.push_back(&run.outflow);
  }
  result.unevenness = unevenness_of(flowed);
  const ExpectedWithDoubts expected = expected_of(generation.study.scenes[*trial.scene], counted, knowledge);
  result.expected = expected.rate;
  for (const Doubt& doubt : expected.doubts) result.doubts.push_back({doubt.kind, 0, 0, doubt.text});
  if (options_.rate)
    result.rate = in_interval(known[options_.goals.size()]);
  else if (const auto goal = std::ranges::find_if(options_.goals, is_rate); goal != options_.goals.end())
    result.rate = result.goals[static_cast<std::size_t>(goal - options_.goals.begin())];
  else if (!rates.empty())
    result.rate = mean_of_rates(rates);
  return result;
}

std::vector<PlannedRun> StudyOptimisation::plan() const {
  std::vector<PlannedRun> all;
  for (const auto& generation : generations_)
    for (const SceneRuns& runs : generation->runs) {
      const std::vector<PlannedRun> plan = runs.plan(generation->counts);
      all.insert(all.end(), plan.begin(), plan.end());
    }
  return all;
}

OptimiseResult StudyOptimisation::result() const {
  OptimiseResult result;
  result.options = options_;
  for (const auto& generation : generations_) {
    const Study& study = generation->study;
    if (result.study.layouts.empty()) {
      result.study = study;
      result.study.layouts.clear();
      result.study.scenes.clear();
    }
    for (Layout layout : study.layouts) {
      if (layout.scene) *layout.scene += result.study.scenes.size();
      result.study.layouts.push_back(std::move(layout));
    }
    result.study.scenes.insert(result.study.scenes.end(), study.scenes.begin(), study.scenes.end());
    for (const SceneRuns& runs : generation->runs) {
      result.cost.runs += static_cast<double>(runs.count());
      result.cost.grain_steps += runs.grain_steps();
    }
  }
  const Front& front = search_->front();
  const std::vector<FrontStanding> standings = front.standings();
  const std::vector<bool> meets = front.meets_by_means(), surely_meets = front.surely_in_bands();
  const auto layers = front.layers(1);
  const std::optional<RateKnowledge> knowledge = knowledge_for(result.study);
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    const bool is_first = !layers.empty() && meets[i] && std::ranges::find(layers.front(), i) != layers.front().end();
    result.layouts.push_back(layout_result(i, standings[i], is_first, knowledge));
    result.layouts.back().surely_meets = surely_meets[i];
  }
  return result;
}

}  // namespace vibrosow
