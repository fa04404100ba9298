#include "distributions/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace vibrosow {

using boost::math::chi_squared;
using boost::math::fisher_f;
using boost::math::normal;
using boost::math::students_t;

double normal_below(double deviate) {
  return cdf(normal(), deviate);
}

double normal_quantile(double below) {
  return quantile(normal(), below);
}

double students_t_below(double freedom, double t) {
  return cdf(students_t(freedom), t);
}

double students_t_quantile(double freedom, double below) {
  return quantile(students_t(freedom), below);
}

double students_t_quantile_above(double freedom, double above) {
  return quantile(complement(students_t(freedom), above));
}

double chi_squared_density(double freedom, double value) {
  return pdf(chi_squared(freedom), value);
}

double chi_squared_above(double freedom, double value) {
  return cdf(complement(chi_squared(freedom), value));
}

double chi_squared_quantile(double freedom, double below) {
  return quantile(chi_squared(freedom), below);
}

double chi_squared_quantile_above(double freedom, double above) {
  return quantile(complement(chi_squared(freedom), above));
}

double fisher_f_above(double freedom, double freedom_below_line, double ratio) {
  return cdf(complement(fisher_f(freedom, freedom_below_line), ratio));
}

}  // namespace vibrosow
