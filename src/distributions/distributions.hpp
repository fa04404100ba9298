#pragma once

namespace vibrosow {

// Distributions, by Boost.Math, whose templates take seconds to compile for each file: so it is done here once. `below`
// and `above` are probabilities of what is below and above a value; a quantile takes one and gives the value. Degrees
// of freedom are above zero, and probabilities between 0 and 1; std::domain_error otherwise. Above is not 1 - below,
// which has no digits left far out.

double normal_below(double deviate);
double normal_quantile(double below);

double students_t_below(double freedom, double t);
double students_t_quantile(double freedom, double below);
double students_t_quantile_above(double freedom, double above);

double chi_squared_density(double freedom, double value);
double chi_squared_above(double freedom, double value);
double chi_squared_quantile(double freedom, double below);
double chi_squared_quantile_above(double freedom, double above);

/// Of a ratio of two variances, with the degrees of freedom of the one above and of the one below the line.
double fisher_f_above(double freedom, double freedom_below_line, double ratio);

}  // namespace vibrosow
