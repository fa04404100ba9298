#include "selection/sequential_tests.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "distributions/distributions.hpp"

namespace vibrosow {
namespace {

constexpr double tolerance_share = 0.2;  // of a band's half width

}  // namespace

SideTest::SideTest(int first_observations, double error) : first_(first_observations) {
  if (first_ < 2) throw std::invalid_argument("a variance takes two observations");
  if (!(error > 0 && error < 0.5)) throw std::invalid_argument("an error is between 0 and 1/2");
  const double eta = (std::pow(2 * error, -2.0 / (first_ - 1)) - 1) / 2;
  h_squared_ = 2 * eta * (first_ - 1);
}

void SideTest::add(double value, double tolerance) {
  if (side_ != Side::open) return;
  moments_.add(value);
  sum_ += value;
  if (moments_.count() < first_) return;
  if (moments_.count() == first_) variance_ = moments_.variance();
  const double away = (h_squared_ * variance_ / (tolerance * tolerance) - moments_.count()) * tolerance / 2;
  // Beyond the triangle's tip there is no difference that matters.
  if (std::abs(sum_) >= away) side_ = sum_ > 0 ? Side::above : Side::below;
}

void LookTest::add(double value) {
  if (is_above_) return;
  moments_.add(value);
  if (moments_.count() < look_) return;
  look_ *= 2;
  error_ /= 2;
  const double t = students_t_quantile_above(moments_.count() - 1.0, error_);
  is_above_ = moments_.mean() > t * std::sqrt(moments_.variance() / moments_.count());
}

BandTest::BandTest(double low, double high, int first_observations, double error_inside, double error_outside)
    : low_(low),
      high_(high),
      tolerance_(tolerance_share * (high - low) / 2),
      at_low_(first_observations, std::min(error_inside, error_outside / 4)),
      at_high_(first_observations, std::min(error_inside, error_outside / 4)),
      below_(error_outside / 4),
      above_(error_outside / 4) {
  if (!(low < high)) throw std::invalid_argument("a band has a width");
}

void BandTest::add(double value) {
  at_low_.add(value - (low_ + tolerance_), tolerance_);
  at_high_.add(value - (high_ - tolerance_), tolerance_);
  below_.add(low_ - value);
  above_.add(value - high_);
}

BandTest::Verdict BandTest::verdict() const {
  using Side = SideTest::Side;
  const bool is_off = at_low_.side() == Side::below || at_high_.side() == Side::above;
  if (is_off || below_.is_above() || above_.is_above()) return Verdict::outside;
  const bool inside = at_low_.side() == Side::above && at_high_.side() == Side::below;
  return inside ? Verdict::inside : Verdict::open;
}

ShareTest::ShareTest(double limit, double error_less, double error_much)
    : enough_for_less_(-std::log(error_less)), enough_for_much_(-std::log(error_much)) {
  if (!(limit > 0 && limit < 1)) throw std::invalid_argument("a share is between 0 and 1");
  const double small = limit / 10;
  by_event_ = std::log(small / limit);
  by_none_ = std::log1p(-small) - std::log1p(-limit);
}

void ShareTest::add(bool happened) {
  if (verdict_ != Verdict::open) return;
  log_ratio_ += happened ? by_event_ : by_none_;
  if (log_ratio_ >= enough_for_less_) verdict_ = Verdict::less;
  if (-log_ratio_ >= enough_for_much_) verdict_ = Verdict::much;
}

int ShareTest::least_trials() const {
  return static_cast<int>(std::ceil(enough_for_less_ / by_none_));
}

bool is_surely_above(const std::vector<double>& values, const std::vector<double>& of_other, double error) {
  LookTest test(error);
  for (std::size_t i = 0; i < std::min(values.size(), of_other.size()); ++i)
    if (const double difference = values[i] - of_other[i]; !std::isnan(difference)) test.add(difference);
  return test.is_above();
}

}  // namespace vibrosow
