#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "accuracy/accuracy_settings.hpp"
#include "outflow/statistics.hpp"

namespace vibrosow {

/// A difference of rates as a part of the limit's rate, percent, and the half width of its 95 % band.
struct RateError {
  double percent;
  double band;
  /// What |error| is below, at 95 %.
  double bound() const { return std::abs(percent) + band; }
};

/// Why a rate errs, beside chance.
enum class ErrorSource { softness, slip_speed, step, scheme };

/// What changing one part of a setting did to the rate.
struct MainEffect {
  ErrorSource source;
  AccuracySetting from, to;  // differ in this part alone
  RateError error;           // rate of `to` less that of `from`; band of this effect alone
};

/// Main effects of settings on the rate, by least squares over independent runs:
///   rate = limit + a duration + b overlap + c slip speed + d(scheme) / steps per contact + chance,
/// where softness acts through the contact duration and, with four softnesses or more, the overlap at rest too. So the
/// limit is that of step 0, rigid grains and Coulomb's friction, the same for all schemes. The step's error is taken to
/// fall with its first power, though all schemes are of a higher order on smooth motion: contacts begin and end within
/// a step, and the first power says most of what is left at the finest step. A part that was not varied has no term
/// (`part_of_one_value`); of a scheme with one number of steps beside others with several the runs are left out.
/// However equal the runs are, a count of n seeds leaves 1 / (n sqrt(12)) of the rate open, as any rounding does.
class ErrorFit {
 public:
  /// From the runs that have a rate. None where they are not at least two more than the terms, or nothing flows.
  static std::optional<ErrorFit> of(const std::vector<AccuracySetting>& settings, const std::vector<AccuracyRun>& runs);

  /// Whether the error of a setting is known: its scheme has two numbers of steps, or none has.
  bool tells(std::size_t setting) const;
  /// kg/s, at step 0, with the half width of its 95 % interval.
  const MeanWithInterval& limit() const { return limit_; }
  /// Systematic error of a setting against the limit. Its band is simultaneous: 95 % for all settings at once (maximum
  /// of the moduli of a multivariate t, by draws; Hothorn, Bretz & Westfall 2008).
  RateError error(std::size_t setting) const;
  /// What its band would be had other runs been made, of this `covariance` over the variance of a run.
  double band_with(std::size_t setting, const Eigen::MatrixXd& covariance) const;
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  /// What a run of a setting adds to the information, the inverse of the covariance, as row by row.
  Eigen::VectorXd row_of(std::size_t setting) const;
  /// How the error of a setting goes with the coefficients.
  Eigen::VectorXd gradient_of(std::size_t setting) const { return gradient_of(terms_of(settings_[setting])); }
  /// Of each part that was varied, from its finest level to its coarsest at the first setting's other parts.
  std::vector<MainEffect> effects() const;
  /// Chance of one run over the scene's window: standard deviation, percent of the limit.
  double scatter_percent() const { return 100 * scatter_ / limit_.mean; }
  int degrees_of_freedom() const { return degrees_of_freedom_; }
  /// Probability of so large a lack of fit by chance, by the scatter of equal runs; none where hardly any were equal.
  /// Below 5 % the bands are those of the settings' scatter about the fit.
  std::optional<double> lack_of_fit() const { return lack_of_fit_; }
  bool fits() const { return !lack_of_fit_ || *lack_of_fit_ >= 0.05; }

 private:
  struct Term {
    ErrorSource source;
    Integrator integrator{};  // of a step's
    bool overlap = false;     // of softness
    double scale = 1;
    double value(const AccuracySetting& setting) const;
  };
  ErrorFit() = default;
  Eigen::VectorXd terms_of(const AccuracySetting& setting) const;
  RateError error_of(const Eigen::VectorXd& terms, double factor) const;
  Eigen::VectorXd gradient_of(const Eigen::VectorXd& terms) const;
  void choose_terms(const std::vector<AccuracyRun>& runs);
  /// Coefficients and covariance; returns the residuals.
  Eigen::VectorXd solve(const std::vector<AccuracyRun>& runs);
  /// Scatter of a run and lack of fit.
  void judge(const std::vector<AccuracyRun>& runs, const Eigen::VectorXd& residuals);
  MainEffect effect(ErrorSource source, const AccuracySetting& from, const AccuracySetting& to) const;
  double simultaneous_factor() const;

  std::vector<AccuracySetting> settings_, observed_;  // all, and one for each run that was fitted
  std::map<Integrator, std::set<double>> steps_;      // a contact, of the runs of each scheme
  std::vector<Term> terms_;
  Eigen::VectorXd coefficients_;  // kg/s: the limit, then of each term
  Eigen::MatrixXd covariance_;    // over the variance of a run
  MeanWithInterval limit_;
  double scatter_ = 0;          // kg/s, of a run
  double spread_ = 0;           // kg/s, of which bands are made
  int degrees_of_freedom_ = 0;  // of `scatter_`
  int spread_freedom_ = 0;      // of `spread_`
  double simultaneous_ = 0;
  std::optional<double> lack_of_fit_;
};

/// What all runs with a rate have one value of, so that what it errs by is not known: "softness" or, of every scheme,
/// "number of steps a contact", or "number of steps a contact for each softness" where the one goes with the other;
/// empty: none of these, or no run has a rate.
std::string_view part_of_one_value(const std::vector<AccuracySetting>& settings, const std::vector<AccuracyRun>& runs);

}  // namespace vibrosow
