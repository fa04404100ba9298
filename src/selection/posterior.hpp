#pragma once

#include <optional>
#include <vector>

#include "selection/moments.hpp"
#include "selection/procedure.hpp"

namespace vibrosow {

/// What many variances of equally many values say of variances in general: scaled inverse chi squared, fitted by the
/// moments of their logarithms (Smyth 2004, Statistical Applications in Genetics and Molecular Biology 3(1),
/// section 6.2).
struct VariancePrior {
  double degrees_of_freedom = 0;  // 0: nothing is known; infinite: all are equal
  double variance = 0;
};

/// `degrees_of_freedom`: of each of the variances. Variances of zero are left out; nothing is known by fewer than
/// three.
VariancePrior variance_prior(const std::vector<double>& variances, double degrees_of_freedom);

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

  std::vector<int> wanted() override;
  void take(std::size_t system, const Observation& observation) override;
  int least_observations() const override;
  Decision decision() const override;

 private:
  struct System {
    int observations = 0, clogged = 0;
    Moments goal{}, rate{};
    bool failed = false;
  };
  /// A mean as it is known.
  struct Known {
    double mean = 0, variance = 0, degrees_of_freedom = 0;  // of one observation; infinite: it is known
    double count = 0;                                       // observations, those that are on their way included
    double error_squared() const { return variance / count; }
  };
  struct Belief {
    std::vector<Known> goals{};
    std::vector<double> feasible{};  // probability that it meets the constraints
    std::optional<std::size_t> best{};
    double margin = 0;
  };

  static Known known(const Moments& moments, const VariancePrior& prior);
  static double probability_within(const Known& better, const Known& other, double margin);
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
