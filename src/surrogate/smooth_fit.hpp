#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vibrosow {

/// A value that was seen at a point of the unit cube, and the variance of its error.
struct SeenValue {
  std::vector<double> place{};
  double value = 0, variance = 0;
};

/// A smooth function through values with known errors: a Gaussian process with a constant mean and Matern's covariance
/// of order 5/2, a length of its own along each axis (Rasmussen & Williams 2006, Gaussian Processes for Machine
/// Learning, equations 2.25, 2.26 and 4.17). Lengths and scale are of short lists: a fit begins with those of the
/// last; where there are a tenth more values than at the last search, it tries the neighbours of each in turn and keeps
/// what is likelier, until nothing is.
class SmoothFit {
 public:
  struct Prediction {
    double mean, deviation;
  };

  explicit SmoothFit(std::size_t axes);
  /// Replaces what was known; two values at least, or std::invalid_argument.
  void fit(std::vector<SeenValue> seen);
  Prediction at(const std::vector<double>& place) const;

 private:
  struct Shape {
    std::vector<std::size_t> lengths;  // index of the list
    std::size_t scale = 0;             // likewise
  };
  double covariance(const std::vector<double>& one, const std::vector<double>& other) const;
  double log_likelihood();

  Shape shape_;
  std::size_t shaped_for_ = 0;  // values
  std::vector<SeenValue> seen_;
  double middle_ = 0, spread_ = 1;  // mean and variance of the values
  Eigen::MatrixXd root_;            // its lower half: Cholesky's factor of the covariances
  Eigen::VectorXd weights_;
};

}  // namespace vibrosow
