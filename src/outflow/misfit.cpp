#include "outflow/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrosow {
namespace {

bool comparable(const std::vector<double>& simulated, const std::vector<double>& measured) {
  if (simulated.size() != measured.size())
    throw std::invalid_argument("simulated and measured values differ in number");
  const auto finite = [](double value) { return std::isfinite(value); };
  return !simulated.empty() && std::ranges::all_of(simulated, finite) && std::ranges::all_of(measured, finite);
}

double root_mean_square(double squares, std::size_t count) {
  return std::sqrt(squares / static_cast<double>(count));
}

}  // namespace

std::optional<double> rate_misfit_percent(const std::vector<double>& simulated, const std::vector<double>& measured,
                                          double scale) {
  if (!comparable(simulated, measured) || std::ranges::count(measured, 0.0) > 0) return std::nullopt;
  double squares = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double error = (simulated[i] * scale - measured[i]) / measured[i];
    squares += error * error;
  }
  return 100 * root_mean_square(squares, measured.size());
}

std::optional<double> best_rate_scale(const std::vector<double>& simulated, const std::vector<double>& measured) {
  if (!comparable(simulated, measured) || std::ranges::count(measured, 0.0) > 0) return std::nullopt;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double ratio = simulated[i] / measured[i];
    sum += ratio;
    squares += ratio * ratio;
  }
  if (squares == 0) return std::nullopt;
  return sum / squares;
}

std::optional<double> curve_misfit_percent(const std::vector<double>& simulated, const std::vector<double>& measured,
                                           double scale) {
  if (!comparable(simulated, measured)) return std::nullopt;
  const double largest = std::ranges::max(measured);
  if (largest <= 0) return std::nullopt;
  double squares = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double error = simulated[i] * scale - measured[i];
    squares += error * error;
  }
  return 100 * root_mean_square(squares, measured.size()) / largest;
}

std::optional<double> best_curve_scale(const std::vector<double>& simulated, const std::vector<double>& measured) {
  if (!comparable(simulated, measured)) return std::nullopt;
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    products += simulated[i] * measured[i];
    squares += simulated[i] * simulated[i];
  }
  if (squares == 0) return std::nullopt;
  return products / squares;
}

}  // namespace vibrosow
