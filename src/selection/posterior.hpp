#pragma once

#include <optional>
#include <vector>

#include "selection/known_mean.hpp"
#include "selection/moments.hpp"
#include "selection/procedure.hpp"

namespace vibrosow {

/// A posterior rule: normal observations, no prior knowledge of means, variances by `variance_prior` of the first
/// observations. It stops when the best is within the margin of every other with the confidence asked for, by the
/// product of the posterior probabilities of the pairs (PGS_Slep of Branke, Chick & Schmidt 2007, Management Science
/// 53(12); Welch's degrees of freedom), each system weighted with the probability that it meets
/// the constraints: Jeffreys' beta for clogging, Student's t for the rate. Observations go to the best or to the other
/// of which that product suffers most (top two, Russo 2020, Operations Research 68(6)).
///
/// There is no guarantee: where many means lie a margin apart from the best it is wrong more often than the confidence
/// says (reports/selection).
class Posterior : public Procedure {
 public:
  static constexpr int first_observations = 3;

  /// Throws std::invalid_argument for fewer than two systems.
  explicit Posterior(const Question& question);

  void request_next_round() override;
  void take(std::size_t system, const Observation& observation) override;
  int least_observations() const override;
  Decision decision() const override;

 private:
  struct System {
    int observations = 0, clogged = 0;
    Moments goal{}, rate{};
    bool failed = false;
  };
  struct Belief {
    std::vector<KnownMean> goals{};  // observations on their way count already
    std::vector<double> feasible{};  // probability that it meets the constraints
    std::optional<std::size_t> best{};
    double margin = 0;
  };

  static double probability_within(const KnownMean& better, const KnownMean& other, double margin);
  double clogging_of(const System& system) const;
  double rate_in_band(const System& system) const;
  double feasibility(const System& system) const;
  void set_priors();
  Belief belief() const;
  std::optional<std::size_t> best_of(const Belief& belief) const;
  double factor_of(const Belief& belief, std::size_t system) const;
  std::vector<double> factors_of(const Belief& belief) const;
  bool is_sure(const std::vector<double>& factors) const;
  bool may_go_on(std::size_t system, const std::vector<int>& wanted) const;
  std::size_t one_of_two(const Belief& belief, std::size_t other, const std::vector<int>& wanted) const;
  std::optional<std::size_t> most_doubtful(const Belief& belief, const std::vector<double>& factors,
                                           const std::vector<int>& wanted) const;

  Question question_;
  std::vector<System> systems_;
  bool is_begun_ = false;  // the first observations are there
  VariancePrior goal_prior_, rate_prior_;
};

}  // namespace vibrosow
