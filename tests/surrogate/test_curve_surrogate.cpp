#include "surrogate/curve_surrogate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "surrogate/hypercube.hpp"

namespace vibrosow {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index times = 30;

/// A curve that two numbers shape.
VectorXd curve(double rise, double bend) {
  VectorXd values(times);
  for (Index t = 0; t < times; ++t) {
    const double time = static_cast<double>(t) / (times - 1);
    values(t) = 1 + rise * time + 0.5 * bend * time * time;
  }
  return values;
}

class CurveSurrogates : public testing::Test {
 protected:
  const MatrixXd points = hypercube(40, 2, 1);
  MatrixXd values{40, times};
  void SetUp() override {
    for (Index i = 0; i < 40; ++i) values.row(i) = curve(std::sin(points(i, 0)), points(i, 1)).transpose();
  }
};

TEST_F(CurveSurrogates, FollowsACurveByAsManyComponentsAsShapeIt) {
  const CurveSurrogate surrogate = curve_surrogate(points, values);
  ASSERT_LE(surrogate.basis.cols(), 2);
  EXPECT_TRUE((surrogate.basis.transpose() * surrogate.basis).isIdentity(1e-12));
  const MatrixXd at{{0.3, 0.6}};
  VectorXd scores(surrogate.basis.cols());
  for (Index k = 0; k < scores.size(); ++k) scores(k) = surrogate.scores[static_cast<std::size_t>(k)].at(at).mean(0);
  const VectorXd expected = curve(std::sin(0.3), 0.6);
  EXPECT_LT((surrogate.centre + surrogate.basis * scores - expected).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((surrogate.scores_of(expected) - scores).cwiseAbs().maxCoeff(), 0.02);
}

TEST_F(CurveSurrogates, SaysWhatNoCurveFollows) {
  const CurveSurrogate surrogate = curve_surrogate(points, values);
  EXPECT_LT(surrogate.off_components2(curve(0.4, 0.2)), 1e-4);
  VectorXd strange = curve(0.4, 0.2);
  for (Index t = 0; t < times; ++t) strange(t) += t % 2 == 0 ? 0.1 : -0.1;
  EXPECT_NEAR(surrogate.off_components2(strange), 0.01, 5e-4);
}

TEST_F(CurveSurrogates, TakesAValueAloneForItsOwnScore) {
  const CurveSurrogate surrogate = curve_surrogate(points, values.col(times - 1));
  ASSERT_EQ(surrogate.basis.size(), 1);
  EXPECT_EQ(surrogate.basis(0, 0), 1);
  EXPECT_EQ(surrogate.off_components2(VectorXd::Constant(1, 7.0)), 0);
}

/// Rise and bend scatter together: a run's scores share its chance.
TEST_F(CurveSurrogates, ScoresOfARunShareItsChance) {
  for (Index i = 0; i < 40; ++i) {
    const double chance = 0.05 * static_cast<double>((7 * i) % 5 - 2),
                 own = 0.02 * static_cast<double>((3 * i) % 7 - 3);
    values.row(i) = curve(points(i, 0) + chance, points(i, 1) - 4 * chance + own).transpose();
  }
  const CurveSurrogate surrogate = curve_surrogate(points, values);
  ASSERT_EQ(surrogate.scores.size(), 2U);
  const VectorXd first = surrogate.scores[0].left_out_errors(), second = surrogate.scores[1].left_out_errors();
  const double correlation = first.dot(second) / (first.norm() * second.norm());
  EXPECT_GT(std::abs(correlation), 0.3);
  EXPECT_EQ(surrogate.chance(0, 0), surrogate.scores[0].noise());
  EXPECT_EQ(surrogate.chance(1, 1), surrogate.scores[1].noise());
  const double expected = correlation * std::sqrt(surrogate.scores[0].noise() * surrogate.scores[1].noise());
  EXPECT_NEAR(surrogate.chance(0, 1), expected, 1e-12 * std::abs(expected));
  EXPECT_EQ(surrogate.chance(1, 0), surrogate.chance(0, 1));
}

TEST_F(CurveSurrogates, RefusesTooFewRuns) {
  EXPECT_THROW(curve_surrogate(points.topRows(4), values.topRows(4)), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
