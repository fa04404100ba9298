#pragma once

#include <cstddef>

namespace vibrosow {

/// Rinott's two-stage procedure (1978), Communications in Statistics A7(8): from the
/// variance S^2 of `first` observations of each system it takes max(first, ceil((h S / margin)^2)) of each and chooses
/// the least mean. What it takes is the yardstick of procedures that stop early.
///
/// h solves: integral over y of (integral over x of Phi(h / sqrt(nu (1/x + 1/y))) f(x) dx)^(systems - 1) f(y) dy =
/// confidence, f the density of chi squared with nu = first - 1 degrees of freedom. Throws std::invalid_argument for
/// fewer than two systems or first observations, or a confidence that is not above 1 / systems and below 1.
double rinott_h(std::size_t systems, int first, double confidence);

/// Observations of a system of that variance.
double rinott_observations(double h, double variance, double margin, int first);

}  // namespace vibrosow
