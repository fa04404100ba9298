#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

namespace vibrosow {

/// The place between `from` and `to` at which `value(place)` is `wanted`, to 30 bits. One end must give more and the
/// other less, or one of them just that: boost::math::evaluation_error otherwise.
template <class Value>
double place_giving(double wanted, double from, double to, Value value) {
  const auto excess = [&](double place) { return value(place) - wanted; };
  const double at_from = excess(from), at_to = excess(to);
  if (at_from == 0) return from;
  if (at_to == 0) return to;
  std::uintmax_t most_steps = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(excess, from, to, at_from, at_to,
                                                             boost::math::tools::eps_tolerance<double>(30), most_steps);
  return 0.5 * (low + high);
}

}  // namespace vibrosow
