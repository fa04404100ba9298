#include "optimise/draft_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "distributions/distributions.hpp"
#include "laws/law.hpp"
#include "plan/softness.hpp"
#include "scene/input_error.hpp"
#include "selection/moments.hpp"

namespace vibrosow {
namespace {

std::vector<Scene> drafts_of(const Study& study) {
  std::vector<Scene> drafts;
  for (const Scene& scene : study.scenes) {
    Scene draft = scene;
    draft.numerics.accuracy = AccuracyLevel::draft;
    draft.numerics.dt.reset();
    draft.numerics.allow_long_step = false;
    const LawTraits& law = traits_of(scene.contact.law);
    if (softness_of(resolve_accuracy_level(draft), law) <= softness_of(resolve_accuracy_level(scene), law))
      throw InputError(fmt::format("--drafts: {}: its layouts are as soft as drafts already", study.title));
    drafts.push_back(std::move(draft));
  }
  return drafts;
}

std::vector<std::size_t> spread_evenly(std::size_t count, std::size_t among) {
  std::vector<std::size_t> those;
  const std::size_t taken = std::min(count, among);
  for (std::size_t i = 0; i < taken; ++i) those.push_back(i * (among - 1) / std::max<std::size_t>(1, taken - 1));
  return those;
}

}  // namespace

DraftScreen::DraftScreen(const Study& study, const DecideOptions& options)
    : study_(study),
      options_(options),
      tests_clogging_(tests_clogging(study, options)),
      drafts_(drafts_of(study)),
      own_(study, study.scenes, options.first_random_seed),
      as_drafts_(study, drafts_, options.first_random_seed),
      pilots_(spread_evenly(pilots, study.scenes.size())),
      own_counts_(study.scenes.size(), 0),
      draft_counts_(study.scenes.size(), 0) {
  options_.goal = &goal_between(*options.goal, study.scenes);
  for (const std::size_t scene : pilots_) own_counts_[scene] = draft_counts_[scene] = runs;
}

void DraftScreen::request_next_round() {
  if (missing().empty() && correlation().value_or(0) >= least_correlation)
    draft_counts_.assign(draft_counts_.size(), runs);
}

std::vector<WantedRun> DraftScreen::missing() const {
  std::vector<WantedRun> missing = as_drafts_.missing(draft_counts_), others = own_.missing(own_counts_);
  missing.insert(missing.end(), others.begin(), others.end());
  return missing;
}

bool DraftScreen::take(const KeptRuns& kept, int jobs) {
  return as_drafts_.take(draft_counts_, kept, jobs) && own_.take(own_counts_, kept, jobs);
}

std::vector<PlannedRun> DraftScreen::plan() const {
  std::vector<PlannedRun> plan = as_drafts_.plan(draft_counts_), others = own_.plan(own_counts_);
  plan.insert(plan.end(), others.begin(), others.end());
  return plan;
}

std::optional<double> DraftScreen::mean_of(const SceneRuns& of, std::size_t scene) const {
  Moments moments;
  for (const Evaluation& run : of.runs()[scene]) {
    if (!run.is_sound()) return std::nullopt;
    const auto goal = options_.goal->of(run.outflow);
    if (has_clogged(run) && (tests_clogging_ || !goal)) continue;
    if (!goal) return std::nullopt;
    moments.add(*goal);
  }
  return moments.count() > 0 ? std::optional(moments.mean()) : std::nullopt;
}

/// As a draft: none of its runs clogged, where that is tested, and the mean rate is in the band.
bool DraftScreen::met_the_constraints(std::size_t scene) const {
  Moments rates;
  for (const Evaluation& run : as_drafts_.runs()[scene]) {
    if (has_clogged(run) && tests_clogging_) return false;
    if (!options_.rate) continue;
    if (const auto rate = rate_as_wanted(*options_.rate, run.outflow)) rates.add(*rate);
  }
  return !options_.rate || (rates.mean() >= options_.rate->low && rates.mean() <= options_.rate->high);
}

std::optional<DraftScreen::Line> DraftScreen::line() const {
  Moments draft, own;
  double products = 0;
  for (const std::size_t scene : pilots_) {
    const auto x = mean_of(as_drafts_, scene), y = mean_of(own_, scene);
    if (!x || !y) continue;
    const double from_mean = *x - draft.mean();
    draft.add(*x);
    own.add(*y);
    products += from_mean * (*y - own.mean());
  }
  if (draft.count() < 4 || !(draft.variance() > 0) || !(own.variance() > 0)) return std::nullopt;
  const double x_squares = draft.variance() * (draft.count() - 1), y_squares = own.variance() * (own.count() - 1);
  const double unexplained = std::max(0.0, y_squares - products * products / x_squares);
  Line line;
  line.slope = products / x_squares;
  line.deviation = std::sqrt(unexplained / (draft.count() - 2));
  line.middle = draft.mean();
  line.squares = x_squares;
  line.points = draft.count();
  return line;
}

/// Of the pilots, by the line: slope and what it leaves unexplained.
std::optional<double> DraftScreen::correlation() const {
  const auto fitted = line();
  if (!fitted) return std::nullopt;
  const double explained = fitted->slope * fitted->slope * fitted->squares;
  const double unexplained = fitted->deviation * fitted->deviation * (fitted->points - 2);
  return std::copysign(std::sqrt(explained / (explained + unexplained)), fitted->slope);
}

DraftFindings DraftScreen::findings() const {
  DraftFindings findings;
  findings.taking_part.assign(study_.scenes.size(), true);
  findings.cost = {static_cast<double>(as_drafts_.count()), as_drafts_.grain_steps()};
  findings.correlation = correlation();
  const auto fitted = line();
  if (fitted) findings.pilots = fitted->points;
  findings.screens = findings.correlation.value_or(0) >= least_correlation;
  if (!findings.screens) return findings;
  std::vector<std::optional<double>> means;
  std::optional<double> best;
  std::vector<double> known;
  for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene) {
    means.push_back(mean_of(as_drafts_, scene));
    if (means.back()) known.push_back(*means.back());
    if (means.back() && met_the_constraints(scene) && (!best || *means.back() < *best)) best = means.back();
  }
  if (!best) return findings;
  std::ranges::sort(known);
  const double others = static_cast<double>(std::max<std::size_t>(2, means.size()) - 1);
  const double t = students_t_quantile_above(fitted->points - 2.0, (1 - options_.confidence) / others);
  for (std::size_t scene = 0; scene < means.size(); ++scene) {
    if (!means[scene]) continue;  // a draft that says nothing rules nothing out; and two are left at least
    const double behind = *means[scene] - *best;
    const double error = fitted->deviation * std::sqrt(2 + behind * behind / fitted->squares);
    findings.taking_part[scene] = fitted->slope * behind <= t * error || *means[scene] <= known[1];
  }
  return findings;
}

}  // namespace vibrosow
