#pragma once

#include <optional>
#include <vector>

#include "selection/moments.hpp"

namespace vibrosow {

/// On which side of zero a mean lies, by observations that come one by one and are normal with unknown variance: a
/// random walk between the sides of a triangle, the test of Kim & Nelson (2001), ACM TOMACS 11(3),
/// doi 10.1145/502109.502111, section 4, with c = 1. With S^2 of the first n0 observations, the sum of r of them has
/// left the triangle when it is at least max(0, (h^2 S^2 / delta^2 - r) delta / 2) from zero, h^2 = 2 eta (n0 - 1), eta
/// = ((2 error)^(-2/(n0-1)) - 1) / 2. A mean that is `tolerance` or more from zero is put on the wrong side with at
/// most the probability `error`.
class SideTest {
 public:
  enum class Side { open, below, above };

  /// Throws std::invalid_argument for fewer than two first observations, an error that is not between 0 and 1/2.
  SideTest(int first_observations, double error);

  /// Before the first observations are complete, `tolerance` counts for nothing. Ends with the first verdict.
  void add(double value, double tolerance);
  Side side() const { return side_; }

 private:
  int first_;
  double h_squared_;
  Moments moments_;
  double variance_ = 0, sum_ = 0;
  Side side_ = Side::open;
};

/// Whether a mean is above zero, looked at after 10, 20, 40, .. observations: Student's t at the k-th look leaves
/// `error` / 2^k, so that a mean of zero or below is called above with at most the probability `error` however long it
/// is looked at. For normal observations; by no scale but their own.
class LookTest {
 public:
  explicit LookTest(double error) : error_(error) {}
  void add(double value);
  bool is_above() const { return is_above_; }

 private:
  double error_;
  int look_ = 10;
  Moments moments_;
  bool is_above_ = false;
};

/// Whether a mean lies in a band, by a test at either end. The tests' zeros lie a fifth of the band's half width inside
/// of its ends and that is their tolerance: a mean outside of the band is called inside with at most the probability
/// `error_inside`, one of its inner three fifths is called outside with at most `error_outside`. (Andradottir & Kim
/// 2010, Naval Research Logistics 57(5), with the zone of tolerance laid inside of the band.) What is far off is told
/// by looks, with half of `error_outside`: a small tolerance makes the triangle long, however far off a mean is.
class BandTest {
 public:
  enum class Verdict { open, inside, outside };
  BandTest(double low, double high, int first_observations, double error_inside, double error_outside);
  void add(double value);
  Verdict verdict() const;

 private:
  double low_, high_, tolerance_;
  SideTest at_low_, at_high_;
  LookTest below_, above_;
};

/// Whether something happens in less than a share of all trials: Wald's sequential test of a binomial (1945), of
/// `limit` against a tenth of it. A probability of `limit` or more is called less with at most the probability
/// `error_less`, one of a tenth of it or below is called too much with at most `error_much`.
class ShareTest {
 public:
  enum class Verdict { open, less, much };
  /// Throws std::invalid_argument for a limit that is not between 0 and 1.
  ShareTest(double limit, double error_less, double error_much);
  void add(bool happened);
  Verdict verdict() const { return verdict_; }
  /// After how many trials in which it did not happen the verdict is `less`.
  int least_trials() const;

 private:
  double by_event_, by_none_;  // what a trial adds to the logarithm of the likelihoods' ratio
  double enough_for_less_, enough_for_much_;
  double log_ratio_ = 0;
  Verdict verdict_ = Verdict::open;
};

/// Whether one system's mean is above another's, by looks at the differences of the observations in which both have a
/// value. `values` and `of_other`: by observation, not a number where there is none.
bool is_surely_above(const std::vector<double>& values, const std::vector<double>& of_other, double error);

}  // namespace vibrosow
