#pragma once

namespace vibrosow {

/// Restitution of a head-on impact of a linear spring and dashpot whose force never pulls: the contact ends when the
/// force has fallen to zero, at omega_d t = pi - 2 asin(zeta), which gives e = exp(-zeta (pi - 2 asin zeta) / sqrt(1 -
/// zeta^2)), and its continuation for zeta > 1 (derived from m x'' + c x' + k x = 0; the same condition as Schwager &
/// Poeschel 2007). `damping_ratio` = c / (2 sqrt(k m)) >= 0.
double linear_restitution(double damping_ratio);

/// The inverse of `linear_restitution`: the damping ratio that gives `restitution`. Throws std::domain_error outside
/// (0, 1].
double linear_damping_ratio(double restitution);

}  // namespace vibrosow
