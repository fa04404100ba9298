#include "selection/posterior.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <cmath>
#include <stdexcept>

namespace vibrosow {
namespace {

constexpr double hardly_feasible = 0.1;  // a system of less than this probability is no candidate

}  // namespace

Posterior::Posterior(const Question& question) : question_(question), systems_(question.systems) {
  if (question_.systems < 2) throw std::invalid_argument("a decision is between two systems at least");
}

void Posterior::take(std::size_t index, const Observation& observation) {
  System& system = systems_.at(index);
  ++system.observations;
  system.failed |= observation.end == RunEnd::failed;
  system.clogged += observation.end == RunEnd::clogged;
  if (observation.end != RunEnd::flowed) return;
  system.goal.add(observation.goal);
  system.rate.add(observation.rate);
}

/// Probability that few enough runs clog (Jeffreys).
double Posterior::clogging_of(const System& system) const {
  if (!question_.clogging_limit) return system.goal.count() > 0 ? 1 : 0;
  return cdf(boost::math::beta_distribution(0.5 + system.clogged, 0.5 + system.observations - system.clogged),
             *question_.clogging_limit);
}

/// Probability that the rate is in the band.
double Posterior::rate_in_band(const System& system) const {
  if (!question_.band) return 1;
  const KnownMean rate = known_mean(system.rate, rate_prior_);
  const auto [low, high] = *question_.band;
  if (rate.count == 0 || rate.degrees_of_freedom == 0) return 0.5;
  const double error = std::sqrt(rate.error_squared());
  if (error == 0) return rate.mean >= low && rate.mean <= high ? 1 : 0;
  return probability_below((high - rate.mean) / error, rate.degrees_of_freedom) -
         probability_below((low - rate.mean) / error, rate.degrees_of_freedom);
}

double Posterior::feasibility(const System& system) const {
  return system.failed ? 0 : clogging_of(system) * rate_in_band(system);
}

/// By the systems of which all first observations flowed.
void Posterior::set_priors() {
  if (is_begun_) return;
  is_begun_ = true;
  std::vector<double> goals, rates;
  const int first = std::min(first_observations, question_.most);
  for (const System& system : systems_) {
    if (system.goal.count() != first) continue;
    goals.push_back(system.goal.variance());
    rates.push_back(system.rate.variance());
  }
  if (first < 2) return;
  goal_prior_ = variance_prior(goals, first - 1.0);
  rate_prior_ = variance_prior(rates, first - 1.0);
}

Posterior::Belief Posterior::belief() const {
  Belief belief;
  for (const System& system : systems_) {
    belief.goals.push_back(known_mean(system.goal, goal_prior_));
    belief.feasible.push_back(feasibility(system));
  }
  belief.best = best_of(belief);
  if (belief.best) belief.margin = question_.margin * std::abs(belief.goals[*belief.best].mean);
  return belief;
}

/// The least mean among the candidates.
std::optional<std::size_t> Posterior::best_of(const Belief& belief) const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    if (belief.feasible[i] < hardly_feasible || belief.goals[i].count == 0) continue;
    if (!best || belief.goals[i].mean < belief.goals[*best].mean) best = i;
  }
  return best;
}

/// Probability that the mean of `better` is at most `margin` above that of `other`.
double Posterior::probability_within(const KnownMean& better, const KnownMean& other, double margin) {
  if (better.count == 0 || other.count == 0) return 0;
  const double a = better.error_squared(), b = other.error_squared(), ahead = other.mean - better.mean + margin;
  if (!(a + b > 0)) return ahead > 0 ? 1 : ahead < 0 ? 0 : 0.5;
  const double degrees = degrees_of_difference(better, other);
  return degrees > 0 ? probability_below(ahead / std::sqrt(a + b), degrees) : 0.5;
}

/// How sure it is that a system does not stand against the decision: that the best meets the constraints, that another
/// fails them or is no better by the margin. Without a best, that it fails the constraints.
double Posterior::factor_of(const Belief& belief, std::size_t system) const {
  const double feasible = belief.feasible[system];
  if (belief.best == system) return feasible;
  if (!belief.best) return 1 - feasible;
  return 1 - feasible * (1 - probability_within(belief.goals[*belief.best], belief.goals[system], belief.margin));
}

std::vector<double> Posterior::factors_of(const Belief& belief) const {
  std::vector<double> factors;
  for (std::size_t i = 0; i < systems_.size(); ++i) factors.push_back(factor_of(belief, i));
  return factors;
}

bool Posterior::is_sure(const std::vector<double>& factors) const {
  double product = 1;
  for (const double factor : factors) product *= factor;
  return product >= question_.confidence;
}

/// The best, or the other that stands against it.
std::size_t Posterior::one_of_two(const Belief& belief, std::size_t other, const std::vector<int>& wanted) const {
  if (!belief.best || other == *belief.best || !may_go_on(*belief.best, wanted)) return other;
  if (!may_go_on(other, wanted)) return *belief.best;
  const KnownMean &ours = belief.goals[*belief.best], &theirs = belief.goals[other];
  if (theirs.count == 0 || theirs.mean < ours.mean) return other;  // whether it meets the constraints is in question
  const auto gain = [](const KnownMean& of) { return of.error_squared() / (of.count + 1); };
  return gain(ours) > gain(theirs) ? *belief.best : other;
}

bool Posterior::may_go_on(std::size_t system, const std::vector<int>& wanted) const {
  return !systems_[system].failed && wanted[system] < question_.most;
}

/// The smallest factor among those that an observation can still change; none: all have the most they may.
std::optional<std::size_t> Posterior::most_doubtful(const Belief& belief, const std::vector<double>& factors,
                                                    const std::vector<int>& wanted) const {
  const bool best_may = belief.best && may_go_on(*belief.best, wanted);
  std::optional<std::size_t> most;
  for (std::size_t i = 0; i < systems_.size(); ++i)
    if (factors[i] < 1 && (best_may || may_go_on(i, wanted)) && (!most || factors[i] < factors[*most])) most = i;
  return most;
}

void Posterior::request_next_round() {
  counts_.clear();
  for (const System& system : systems_) counts_.push_back(system.observations);
  const int first = std::min(first_observations, question_.most);
  bool is_first = false;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (!systems_[i].failed && counts_[i] < first) counts_[i] = first, is_first = true;
  if (is_first) return;
  set_priors();
  Belief belief = this->belief();
  std::vector<double> factors = factors_of(belief);
  if ((belief.best && belief.margin == 0) || is_sure(factors)) return;
  for (int i = 0; i < question_.batch; ++i) {
    const auto doubtful = most_doubtful(belief, factors, counts_);
    if (!doubtful) break;
    const std::size_t next = one_of_two(belief, *doubtful, counts_);
    ++counts_[next];
    ++belief.goals[next].count;
    factors[*doubtful] = factor_of(belief, *doubtful);
  }
}

int Posterior::least_observations() const {
  System system;
  for (system.observations = first_observations;
       question_.clogging_limit && clogging_of(system) < question_.confidence;)
    ++system.observations;
  return system.observations;
}

Decision Posterior::decision() const {
  Decision decision;
  const Belief belief = this->belief();
  decision.best = belief.best;
  decision.has_margin = !decision.best || belief.margin > 0;
  decision.is_sure = decision.has_margin && is_sure(factors_of(belief));
  const double error = (1 - question_.confidence) / static_cast<double>(systems_.size() - 1);
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    Standing standing = decision.is_sure ? Standing::not_shown_worse : Standing::undecided;
    if (systems_[i].failed)
      standing = Standing::failed;
    else if (belief.feasible[i] < hardly_feasible)
      standing = clogging_of(systems_[i]) < hardly_feasible ? Standing::clogs : Standing::misses_the_rate;
    else if (decision.best == i)
      standing = decision.is_sure ? Standing::best : Standing::undecided;
    else if (decision.best && probability_within(belief.goals[*decision.best], belief.goals[i], 0) > 1 - error)
      standing = Standing::worse;
    decision.standings.push_back(standing);
  }
  return decision;
}

}  // namespace vibrosow
