#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "selection/known_mean.hpp"
#include "selection/procedure.hpp"

namespace vibrosow {

/// What the mean of a figure is to be: the least, or the nearest to a value.
struct Aim {
  std::optional<double> nearest_to{};
  bool is_exact = false;  // every observation of a system gives the same: it needs no second
  /// The less the better.
  double of(double mean) const { return nearest_to ? std::abs(mean - *nearest_to) : mean; }
};

/// Which of several systems no other dominates: is as good in every goal and better in one (Pareto).
struct FrontQuestion {
  std::vector<Aim> goals{};
  std::vector<Band> bands{};               // of the means of further figures; an end may be infinite
  std::optional<double> clogging_limit{};  // the share of observations that may clog; none: any, but not each
  double confidence = 0.95;
  int first = 3;  // observations that a system begins with, at least 2
};

struct FrontObservation {
  RunEnd end = RunEnd::flowed;
  std::vector<double> goals{}, banded{};
};

enum class FrontStanding {
  on_front,
  may_be_on_front,
  dominated,
  misses_a_band,
  clogs,
  failed,
};

/// What is known of systems that come one by one, by their observations. Variances are shared (`variance_prior` of the
/// first observations), and systems are compared as if they were independent.
class Front {
 public:
  explicit Front(FrontQuestion question) : question_(std::move(question)), first_variances_(metrics()) {}

  void add_system() { systems_.emplace_back(System{.metrics = std::vector<Moments>(metrics())}); }
  /// Throws std::out_of_range for a system that is none, or an observation of other than the question's figures.
  void take(std::size_t system, const FrontObservation& observation);

  std::size_t size() const { return systems_.size(); }
  int observations(std::size_t system) const { return systems_.at(system).observations; }
  int clogged(std::size_t system) const { return systems_.at(system).clogged; }
  bool has_failed(std::size_t system) const { return systems_.at(system).failed; }
  /// The goals, then what has bands; each with a count of 0 where no observation flowed.
  std::vector<KnownMean> known(std::size_t system) const;

  /// By the means alone, best first: the systems that no other dominates, those that only the former dominate, and so
  /// on, at least until `enough` systems are in; then those that miss a constraint by their means, each for itself, the
  /// nearest first (Deb 2000, Computer Methods in Applied Mechanics and Engineering 186). Failed ones are in none.
  std::vector<std::vector<std::size_t>> layers(std::size_t enough) const;

  /// Whether each system's means meet the constraints.
  std::vector<bool> meets_by_means() const;

  /// Of each, whether it would be in the first layer, were it better by one standard error in everything.
  std::vector<bool> nearly_on_front() const;

  /// Each a claim of its own with the confidence asked for. A system is dominated where one that surely meets the bands
  /// is surely better in each goal: the error is shared out among the others. It is on the front where it surely meets
  /// the bands and is, against every other, surely better in some goal: the error is shared out among the goals. That a
  /// system clogs seldom enough is taken as counted. The tests are those of a fixed number of observations: where these
  /// went by what was seen before, the confidence is no proof.
  std::vector<FrontStanding> standings() const;

  /// Of each, whether it surely meets the bands, as a system on the front must.
  std::vector<bool> surely_in_bands() const;

 private:
  struct System {
    int observations = 0, clogged = 0;
    bool failed = false;
    std::vector<Moments> metrics{};
  };
  /// Everything of a system that comparisons ask for.
  struct Known {
    std::vector<KnownMean> metrics;
    double violation;  // of the constraints, by the means; 0: they are met
  };

  std::size_t metrics() const { return question_.goals.size() + question_.bands.size(); }
  bool is_exact(std::size_t metric) const {
    return metric < question_.goals.size() && question_.goals[metric].is_exact;
  }
  double value(const Known& of, std::size_t goal) const;
  double violation(const System& system, const std::vector<KnownMean>& metrics) const;
  std::vector<Known> all_known() const;
  bool dominates(const Known& one, const Known& other) const;
  bool is_surely_better(const Known& one, const Known& other, std::size_t goal, double error) const;
  bool surely_dominates(const Known& one, const Known& other, double error) const;
  bool is_in_bands(const Known& of, double error) const;
  bool is_outside(const Known& of, double error) const;
  bool surely_clogs(const System& system, double error) const;

  FrontQuestion question_;
  std::vector<System> systems_;
  std::vector<std::vector<double>> first_variances_;  // of each figure, of the systems whose first observations flowed
};

}  // namespace vibrosow
