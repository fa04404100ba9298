#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "distributions/distributions.hpp"

namespace vibrosow {
namespace {

TEST(Distributions, AreThoseOfTheirClosedForms) {
  for (const double x : {0.01, 0.3, 1.0, 4.0, 30.0}) {
    EXPECT_NEAR(normal_below(x), std::erfc(-x / std::sqrt(2.0)) / 2, 1e-14);
    EXPECT_NEAR(normal_quantile(normal_below(-x)), -x, 1e-10 * x);
    EXPECT_NEAR(students_t_below(1, x), 0.5 + std::atan(x) / std::acos(-1.0), 1e-14);
    EXPECT_NEAR(students_t_below(2, x), 0.5 + x / (2 * std::sqrt(2 + x * x)), 1e-14);
    EXPECT_NEAR(chi_squared_density(2, x), std::exp(-x / 2) / 2, 1e-14);
    EXPECT_NEAR(chi_squared_above(2, x), std::exp(-x / 2), 1e-14);
    EXPECT_NEAR(fisher_f_above(2, 7, x), std::pow(1 + 2 * x / 7, -3.5), 1e-14);
  }
  for (const double p : {1e-12, 0.01, 0.5, 0.9}) {
    EXPECT_NEAR(chi_squared_quantile(2, p) / (-2 * std::log1p(-p)), 1, 1e-9);
    EXPECT_NEAR(chi_squared_quantile_above(2, p) / (-2 * std::log(p)), 1, 1e-12);
    const double t = (2 * p - 1) * std::sqrt(1 / (2 * p * (1 - p)));
    EXPECT_NEAR(students_t_quantile(2, p), t, 1e-9 * std::abs(t) + 1e-14);
    EXPECT_NEAR(students_t_quantile_above(2, p), -t, 1e-9 * std::abs(t) + 1e-14);
  }
}

TEST(Distributions, KeepTheirDigitsFarOut) {
  EXPECT_NEAR(chi_squared_above(2, 200) / std::exp(-100.0), 1, 1e-10);
  EXPECT_NEAR(chi_squared_quantile_above(2, 1e-100) / (200 * std::log(10.0)), 1, 1e-12);
  EXPECT_NEAR(students_t_quantile_above(1, 1e-100) * std::acos(-1.0) / 1e100, 1, 1e-10);
}

TEST(Distributions, RefuseWhatIsNone) {
  EXPECT_THROW(students_t_quantile(0, 0.975), std::domain_error);
  EXPECT_THROW(chi_squared_quantile(3, 1.5), std::domain_error);
  EXPECT_THROW(fisher_f_above(-1, 3, 1), std::domain_error);
}

}  // namespace
}  // namespace vibrosow
