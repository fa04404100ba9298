#pragma once

namespace vibrosow {

/// Mean and variance of values that come one by one (Welford 1962).
class Moments {
 public:
  void add(double value) {
    ++count_;
    const double from_mean = value - mean_;
    mean_ += from_mean / count_;
    squares_ += from_mean * (value - mean_);
  }
  int count() const { return count_; }
  double mean() const { return mean_; }
  /// Of the sample (n - 1); 0 for fewer than two values.
  double variance() const { return count_ < 2 ? 0 : squares_ / (count_ - 1); }

 private:
  int count_ = 0;
  double mean_ = 0, squares_ = 0;
};

}  // namespace vibrosow
