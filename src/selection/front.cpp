#include "selection/front.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace vibrosow {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Whether `above` standard errors are enough to be sure with an error of at most `error`.
bool is_surely_positive(double difference, double error_squared, double degrees, double error) {
  if (!(error_squared > 0)) return difference > 0;
  return degrees > 0 && probability_below(difference / std::sqrt(error_squared), degrees) > 1 - error;
}

bool is_known(const KnownMean& mean) {
  return mean.count > 0 && mean.degrees_of_freedom > 0;
}

}  // namespace

double Band::outside_by(double mean) const {
  const double by = std::max({0.0, low - mean, mean - high});
  if (by == 0) return 0;
  const double half = (high - low) / 2, end = std::abs(std::isfinite(high) ? high : low);
  const double unit = std::isfinite(half) ? half : end;
  return unit > 0 ? by / unit : by;
}

void Front::take(std::size_t index, const FrontObservation& observation) {
  System& system = systems_.at(index);
  ++system.observations;
  system.failed |= observation.end == RunEnd::failed;
  system.clogged += observation.end == RunEnd::clogged;
  if (observation.end != RunEnd::flowed) return;
  if (observation.goals.size() != question_.goals.size() || observation.banded.size() != question_.bands.size())
    throw std::out_of_range("an observation of other figures than the question's");
  for (std::size_t f = 0; f < metrics(); ++f) {
    const std::size_t goals = question_.goals.size();
    Moments& metric = system.metrics[f];
    metric.add(f < goals ? observation.goals[f] : observation.banded[f - goals]);
    if (metric.count() == question_.first) first_variances_[f].push_back(metric.variance());
  }
}

std::vector<KnownMean> Front::known(std::size_t system) const {
  std::vector<KnownMean> known;
  for (std::size_t f = 0; f < metrics(); ++f) {
    const Moments& metric = systems_.at(system).metrics[f];
    if (is_exact(f))
      known.push_back({metric.mean(), 0, endless, static_cast<double>(metric.count())});
    else
      known.push_back(known_mean(metric, variance_prior(first_variances_[f], question_.first - 1.0)));
  }
  return known;
}

double Front::value(const Known& of, std::size_t goal) const {
  return question_.goals[goal].of(of.metrics[goal].mean);
}

double Front::violation(const System& system, const std::vector<KnownMean>& metrics) const {
  if (system.failed || system.observations == system.clogged) return endless;
  double sum = 0;
  for (std::size_t b = 0; b < question_.bands.size(); ++b)
    sum += question_.bands[b].outside_by(metrics[question_.goals.size() + b].mean);
  const double share = static_cast<double>(system.clogged) / system.observations;
  if (const auto limit = question_.clogging_limit; limit && share > *limit) sum += share / *limit - 1;
  return sum;
}

std::vector<Front::Known> Front::all_known() const {
  std::vector<Known> all;
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    std::vector<KnownMean> metrics = known(i);
    const double by = violation(systems_[i], metrics);
    all.push_back({std::move(metrics), by});
  }
  return all;
}

bool Front::dominates(const Known& one, const Known& other) const {
  bool is_better = false;
  for (std::size_t g = 0; g < question_.goals.size(); ++g) {
    const double ours = value(one, g), theirs = value(other, g);
    if (ours > theirs) return false;
    is_better |= ours < theirs;
  }
  return is_better;
}

std::vector<std::vector<std::size_t>> Front::layers(std::size_t enough) const {
  const std::vector<Known> all = all_known();
  std::vector<std::size_t> meeting, missing;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].violation == 0)
      meeting.push_back(i);
    else if (!systems_[i].failed)
      missing.push_back(i);
  std::vector<std::vector<std::size_t>> layers;
  std::size_t taken = 0;
  while (!meeting.empty() && taken < enough) {
    std::vector<std::size_t> layer, rest;
    for (const std::size_t i : meeting) {
      const bool is_behind = std::ranges::any_of(meeting, [&](std::size_t j) { return dominates(all[j], all[i]); });
      (is_behind ? rest : layer).push_back(i);
    }
    taken += layer.size();
    layers.push_back(std::move(layer));
    meeting = std::move(rest);
  }
  std::ranges::stable_sort(missing, {}, [&](std::size_t i) { return all[i].violation; });
  for (std::size_t k = 0; k < missing.size() && taken < enough; ++k, ++taken) layers.push_back({missing[k]});
  return layers;
}

std::vector<bool> Front::meets_by_means() const {
  std::vector<bool> meets;
  for (const Known& of : all_known()) meets.push_back(of.violation == 0);
  return meets;
}

std::vector<bool> Front::nearly_on_front() const {
  const std::vector<Known> all = all_known();
  const auto meets_nearly = [&](const Known& of) {
    for (std::size_t b = 0; b < question_.bands.size(); ++b) {
      const KnownMean& metric = of.metrics[question_.goals.size() + b];
      const double error = std::sqrt(metric.error_squared());
      if (metric.mean + error < question_.bands[b].low || metric.mean - error > question_.bands[b].high) return false;
    }
    return true;
  };
  const auto plainly_dominates = [&](const Known& one, const Known& other) {
    bool is_better = false;
    for (std::size_t g = 0; g < question_.goals.size(); ++g) {
      const double error = std::sqrt(one.metrics[g].error_squared() + other.metrics[g].error_squared());
      const double ahead = value(other, g) - value(one, g) - error;
      if (ahead < 0) return false;
      is_better |= ahead > 0;
    }
    return is_better;
  };
  std::vector<bool> nearly;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool may_be = !systems_[i].failed && all[i].violation < endless && meets_nearly(all[i]);
    nearly.push_back(may_be && std::ranges::none_of(all, [&](const Known& other) {
                       return other.violation == 0 && plainly_dominates(other, all[i]);
                     }));
  }
  return nearly;
}

/// Of a distance from a wanted value, whose side is one of two, each side has half of the error: |m - w| exceeds the
/// true distance only where m - w does or w - m.
bool Front::is_surely_better(const Known& one, const Known& other, std::size_t goal, double error) const {
  const KnownMean &ours = one.metrics[goal], &theirs = other.metrics[goal];
  if (!is_known(ours) || !is_known(theirs)) return false;
  const double sides = question_.goals[goal].nearest_to ? 2 : 1;
  return is_surely_positive(value(other, goal) - value(one, goal), ours.error_squared() + theirs.error_squared(),
                            degrees_of_difference(ours, theirs), error / sides);
}

/// In no goal worse, where neither scatters at all, and surely better in the others. Each test at the whole error: all
/// of them must be wrong for the claim to be wrong where it matters (Berger 1982, Technometrics 24(4)).
bool Front::surely_dominates(const Known& one, const Known& other, double error) const {
  bool is_better = false;
  for (std::size_t g = 0; g < question_.goals.size(); ++g) {
    const KnownMean &ours = one.metrics[g], &theirs = other.metrics[g];
    const bool are_equal = is_known(ours) && is_known(theirs) && ours.variance == 0 && theirs.variance == 0 &&
                           value(one, g) == value(other, g);
    if (are_equal) continue;
    if (!is_surely_better(one, other, g, error)) return false;
    is_better = true;
  }
  return is_better;
}

bool Front::is_in_bands(const Known& of, double error) const {
  for (std::size_t b = 0; b < question_.bands.size(); ++b) {
    const KnownMean& metric = of.metrics[question_.goals.size() + b];
    const auto [low, high] = question_.bands[b];
    const double squared = metric.error_squared(), degrees = metric.degrees_of_freedom;
    if (!is_known(metric)) return false;
    if (squared == 0 && metric.mean >= low && metric.mean <= high) continue;
    if (low > -endless && !is_surely_positive(metric.mean - low, squared, degrees, error)) return false;
    if (high < endless && !is_surely_positive(high - metric.mean, squared, degrees, error)) return false;
  }
  return true;
}

bool Front::is_outside(const Known& of, double error) const {
  for (std::size_t b = 0; b < question_.bands.size(); ++b) {
    const KnownMean& metric = of.metrics[question_.goals.size() + b];
    const auto [low, high] = question_.bands[b];
    const double squared = metric.error_squared(), degrees = metric.degrees_of_freedom;
    if (!is_known(metric)) continue;
    if (low > -endless && is_surely_positive(low - metric.mean, squared, degrees, error)) return true;
    if (high < endless && is_surely_positive(metric.mean - high, squared, degrees, error)) return true;
  }
  return false;
}

bool Front::surely_clogs(const System& system, double error) const {
  if (system.observations > 0 && system.clogged == system.observations) return system.observations >= question_.first;
  using Binomial = boost::math::binomial_distribution<>;
  return question_.clogging_limit && system.clogged > 0 &&
         Binomial::find_lower_bound_on_p(system.observations, system.clogged, error) > *question_.clogging_limit;
}

std::vector<FrontStanding> Front::standings() const {
  const std::vector<Known> all = all_known();
  const double error = 1 - question_.confidence;
  const double of_constraint = error / static_cast<double>(2 * question_.bands.size() + 1);
  const double of_pair = error / std::max(1.0, static_cast<double>(all.size()) - 1);
  const double of_goal = error / static_cast<double>(question_.goals.size());
  std::vector<FrontStanding> standings(all.size(), FrontStanding::may_be_on_front);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (systems_[i].failed)
      standings[i] = FrontStanding::failed;
    else if (surely_clogs(systems_[i], of_constraint))
      standings[i] = FrontStanding::clogs;
    else if (is_outside(all[i], of_constraint))
      standings[i] = FrontStanding::misses_a_band;
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (standings[i] == FrontStanding::may_be_on_front) candidates.push_back(i);
  for (const std::size_t i : candidates) {
    const auto is_better_somewhere = [&](std::size_t j) {
      if (j == i) return true;
      for (std::size_t g = 0; g < question_.goals.size(); ++g)
        if (is_surely_better(all[i], all[j], g, of_goal)) return true;
      return false;
    };
    const auto dominates_it = [&](std::size_t j) {
      return j != i && all[j].violation == 0 && is_in_bands(all[j], of_pair) &&
             surely_dominates(all[j], all[i], of_pair);
    };
    if (std::ranges::any_of(candidates, dominates_it))
      standings[i] = FrontStanding::dominated;
    else if (all[i].violation == 0 && is_in_bands(all[i], error) &&
             std::ranges::all_of(candidates, is_better_somewhere))
      standings[i] = FrontStanding::on_front;
  }
  return standings;
}

std::vector<bool> Front::surely_in_bands() const {
  std::vector<bool> meets;
  for (const Known& of : all_known()) meets.push_back(of.violation == 0 && is_in_bands(of, 1 - question_.confidence));
  return meets;
}

}  // namespace vibrosow
