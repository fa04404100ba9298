#include "surrogate/sobol_points.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace vibrosow {
namespace {

TEST(SobolPoints, AreThoseOfJoeAndKuo) {
  const Eigen::MatrixXd points = sobol_points(7, 2);
  const double expected[7][2] = {{0.5, 0.5},     {0.75, 0.25},   {0.25, 0.75},  {0.375, 0.375},
                                 {0.875, 0.875}, {0.625, 0.125}, {0.125, 0.625}};
  for (int i = 0; i < 7; ++i)
    for (int d = 0; d < 2; ++d) EXPECT_NEAR(points(i, d), expected[i][d], 1e-15) << i << " " << d;
}

TEST(SobolPoints, FillEveryDyadicBoxEqually) {
  const Eigen::MatrixXd points = sobol_points(1023, 3);  // and the zero that is left out
  int below = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (points(i, 2) < 0.25) ++below;
  EXPECT_EQ(below, 255);
}

TEST(SobolPoints, NeedADimension) {
  EXPECT_THROW(sobol_points(4, 0), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
