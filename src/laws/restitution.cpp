#include "laws/restitution.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "portable_math/functions.hpp"

namespace vibrosow {

double linear_restitution(double damping_ratio) {
  const double z = damping_ratio;
  if (std::abs(1 - z) < 1e-7) return portable_math::exp(-2.0);  // both branches tend to it
  if (z < 1) return portable_math::exp(-z * (std::numbers::pi - 2 * portable_math::asin(z)) / std::sqrt(1 - z * z));
  return portable_math::exp(-2 * z * portable_math::acosh(z) / std::sqrt(z * z - 1));
}

double linear_damping_ratio(double restitution) {
  if (!(restitution > 0 && restitution <= 1)) throw std::domain_error("restitution must lie in (0, 1]");
  if (restitution == 1) return 0;
  const auto excess = [restitution](double z) { return linear_restitution(z) - restitution; };
  const double largest = 1 / std::sqrt(restitution) + 1;  // e falls like 1 / (2 zeta)^2
  std::uintmax_t iterations = 200;
  const auto [low, high] = boost::math::tools::toms748_solve(excess, 0.0, largest,
                                                             boost::math::tools::eps_tolerance<double>(50), iterations);
  return 0.5 * (low + high);
}

}  // namespace vibrosow
