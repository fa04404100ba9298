// Velocity and displacement gradients of motions that are known exactly.
#include "fields/gradient.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fields/made_up_bed.hpp"
#include "fields/motion.hpp"

namespace vibrosow {
namespace {

using V = Eigen::Vector2d;
const auto stay = [](const V& at) { return at; };
const auto at_rest = [](const V&) { return V(0, 0); };

Eigen::Matrix2d matrix(double xx, double xy, double yx, double yy) {
  Eigen::Matrix2d m;
  m << xx, xy, yx, yy;
  return m;
}

/// Shear and dilation rates of every cell of a bed that moves with v = (0.3, -0.2) + G x.
void expect_rates(const Eigen::Matrix2d& gradient, double shear_rate, double dilation_rate) {
  const Snapshot s = hexagonal_bed(12, stay, [&](const V& at) -> V { return V(0.3, -0.2) + gradient * at; });
  const Grid grid = grid_over({&s}, 6e-3);
  const auto cells = cell_motion(s, grid, fit_reach(s));
  ASSERT_EQ(cells.size(), 72u);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    ASSERT_TRUE(cells[k] && cells[k]->gradient) << k;
    EXPECT_TRUE(cells[k]->gradient->isApprox(gradient, 1e-11)) << *cells[k]->gradient;
    EXPECT_NEAR(shear(*cells[k]->gradient), shear_rate, 1e-10);
    EXPECT_NEAR(dilation(*cells[k]->gradient), dilation_rate, 1e-10);
  }
}

TEST(VelocityGradient, RotationHasNeitherShearNorDilation) {
  expect_rates(matrix(0, -7, 7, 0), 0, 0);
}
TEST(VelocityGradient, SimpleShearHasItsRate) {
  expect_rates(matrix(0, 4, 0, 0), 4, 0);
  expect_rates(matrix(0, 0, -4, 0), 4, 0);
}
TEST(VelocityGradient, PureShearOfTwoStretchRatesHasTheirDifference) {
  expect_rates(matrix(3, 0, 0, -3), 6, 0);
}
TEST(VelocityGradient, ExpansionHasDilationAlone) {
  expect_rates(matrix(2.5, 0, 0, 2.5), 0, 5);
}

TEST(VelocityGradient, FitIsTheLeastSquaresOne) {
  // v_x = 1, 2, 6 and 3 at the corners of a unit square: du/dx = ((2 - 1) + (6 - 3)) / 2, du/dy = ((6 - 2) + (3 - 1))
  // / 2.
  const Points at = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, v = {{1, 0}, {2, 0}, {6, 0}, {3, 0}};
  const auto gradient = fit_gradient<2>(at, v, {0, 1, 2, 3});
  ASSERT_TRUE(gradient);
  EXPECT_TRUE(gradient->isApprox(matrix(2, 3, 0, 0), 1e-14));
}

TEST(VelocityGradient, NeedsThreePointsOffALine) {
  const Points at = {{0, 0}, {1, 0}, {2, 0}, {0, 1}};
  EXPECT_FALSE(fit_gradient<2>(at, at, {0, 3}));
  EXPECT_FALSE(fit_gradient<2>(at, at, {0, 1, 2}));
  EXPECT_TRUE(fit_gradient<2>(at, at, {0, 1, 3}));
}

TEST(VelocityGradient, NeedsFourPointsOffAPlane3d) {
  const PointsOf<3> at = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  EXPECT_FALSE(fit_gradient<3>(at, at, {0, 1, 4}));
  EXPECT_FALSE(fit_gradient<3>(at, at, {0, 1, 2, 3}));
  EXPECT_TRUE(fit_gradient<3>(at, at, {0, 1, 2, 4})->isIdentity(1e-14));
}

using V3 = Eigen::Vector3d;
const auto stay_3d = [](const V3& at) { return at; };
const auto at_rest_3d = [](const V3&) { return V3(0, 0, 0); };

TEST(VelocityGradient, OfABedInSpaceIsThatOfItsProjection) {
  const Eigen::Matrix2d gradient = matrix(1, 4, 0, -2);
  const Snapshot s = body_centred_bed(11, stay_3d, [&](const V3& at) -> V3 {
    const V in_map = gradient * V(at.x(), at.y());
    return {in_map.x() + 0.3, in_map.y(), 0.5 + 3 * at.x()};
  });
  const Grid grid = grid_over({&s}, 6e-3);
  for (const MapPart& part : {MapPart{0, 60e-3, false}, MapPart{25e-3, 35e-3, true}}) {
    const auto cells = cell_motion(s, grid, fit_reach(s), part);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      ASSERT_TRUE(cells[k] && cells[k]->gradient) << k;
      EXPECT_TRUE(cells[k]->gradient->isApprox(gradient, 1e-11)) << *cells[k]->gradient;
      EXPECT_NEAR(shear(*cells[k]->gradient), 5, 1e-10);
    }
    const std::size_t middle = grid.index(grid.columns / 2, grid.rows / 2);
    EXPECT_NEAR(cells[middle]->velocity.z(), 0.5 + 3 * grid.centre(middle).x(), 0.003);
  }
}

TEST(CellVelocity, OfASliceIsThatOfTheGrainsInIt) {
  Snapshot s;
  put_ball(s, V3(2e-3, 2e-3, 3e-3), V3(1, 0, 2)), put_ball(s, V3(2e-3, 2e-3, 9e-3), V3(3, 0, -2));
  const Grid grid{.cell = 4e-3, .first_column = 0, .first_row = 0, .columns = 1, .rows = 1};
  EXPECT_NEAR(cell_motion(s, grid, 6e-3, {0, 12e-3, false})[0]->velocity.x(), 2, 1e-14);
  EXPECT_NEAR(cell_motion(s, grid, 6e-3, {0, 12e-3, false})[0]->velocity.z(), 0, 1e-14);
  EXPECT_NEAR(cell_motion(s, grid, 6e-3, {0, 6e-3, true})[0]->velocity.x(), 1, 1e-14);
  EXPECT_NEAR(cell_motion(s, grid, 6e-3, {0, 6e-3, true})[0]->velocity.z(), 2, 1e-14);
}

TEST(CellVelocity, HeavyAndNearGrainsCountMore) {
  Snapshot s;
  const double q = 0.5, reach = 6e-3;
  put(s, 2e-3, 2e-3, 1, 0, 0, 1e-3, 30e-6);
  put(s, 2e-3 + q * reach, 2e-3, 0, 2, 0, 1e-3, 90e-6);
  const Grid grid{.cell = 4e-3, .first_column = 0, .first_row = 0, .columns = 1, .rows = 1};
  const double weight = 3 * (1 + 3 * q) * (1 - q) * (1 - q) * (1 - q);  // of the second, to the first's 1
  const auto cells = cell_motion(s, grid, reach);
  ASSERT_TRUE(cells[0]);
  EXPECT_NEAR(cells[0]->velocity.x(), 1 / (1 + weight), 1e-14);
  EXPECT_NEAR(cells[0]->velocity.y(), 2 * weight / (1 + weight), 1e-14);
  EXPECT_FALSE(cells[0]->gradient);
}

TEST(CellVelocity, NoneOutOfReach) {
  Snapshot s;
  put(s, 30e-3, 2e-3, 1, 0);
  EXPECT_FALSE(cell_motion(s, {.cell = 4e-3, .first_column = 0, .first_row = 0, .columns = 1, .rows = 1}, 6e-3)[0]);
}

/// Shear strain of every grain of a bed deformed by x -> F x.
void expect_strain(const Eigen::Matrix2d& deformation, double strain) {
  const Snapshot before = hexagonal_bed(10, stay, at_rest);
  const Snapshot after = hexagonal_bed(
      10, [&](const V& at) -> V { return deformation * at + V(0.1, 0); }, at_rest);
  for (const auto& one : shear_strain(before, after, fit_reach(before))) {
    ASSERT_TRUE(one);
    EXPECT_NEAR(*one, strain, 1e-11);
  }
}

TEST(ShearStrain, OfKnownDeformations) {
  expect_strain(Eigen::Rotation2Dd(1.2).toRotationMatrix(), 0);
  expect_strain(matrix(1.3, 0, 0, 1.3), 0);
  expect_strain(matrix(1, 0.7, 0, 1), 0.7);
  expect_strain(Eigen::Rotation2Dd(-0.4) * matrix(1, 0.7, 0, 1), 0.7);
  expect_strain(matrix(1.5, 0, 0, 0.8), 0.7);
}

/// The same in 3D.
void expect_strain_3d(const Eigen::Matrix3d& deformation, double strain) {
  const Snapshot before = body_centred_bed(6, stay_3d, at_rest_3d);
  const Snapshot after = body_centred_bed(
      6, [&](const V3& at) -> V3 { return deformation * at + V3(0.1, 0, 0.2); }, at_rest_3d);
  for (const auto& one : shear_strain(before, after, fit_reach(before))) {
    ASSERT_TRUE(one);
    EXPECT_NEAR(*one, strain, 1e-11);
  }
}

TEST(ShearStrain, OfKnownDeformations3d) {
  const Eigen::Matrix3d none = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, V3(1, 2, -2).normalized()).toRotationMatrix();
  Eigen::Matrix3d along_across = none, stretches = none;
  along_across(0, 2) = 0.7;
  stretches.diagonal() = V3(1.1, 1.5, 0.8);
  expect_strain_3d(turn, 0);
  expect_strain_3d(1.3 * none, 0);
  expect_strain_3d(along_across, 0.7);
  expect_strain_3d(turn * along_across * turn.transpose(), 0.7);
  expect_strain_3d(turn * stretches, 0.7);
}

TEST(ShearStrain, ASlipLineStandsOutBetweenTwoBlocks) {
  const double line = 30e-3;
  const Snapshot before = hexagonal_bed(16, stay, at_rest);
  const Snapshot after = hexagonal_bed(
      16, [&](const V& at) -> V { return at.y() > line ? at + V(4e-3, 0) : at; }, at_rest);
  const double reach = fit_reach(before);
  const auto strain = shear_strain(before, after, reach);
  double largest = 0;
  for (std::size_t i = 0; i < strain.size(); ++i) {
    ASSERT_TRUE(strain[i]);
    const bool within_a_block = std::abs(before.y[i] - line) > reach;
    EXPECT_TRUE(!within_a_block || *strain[i] < 1e-12) << *strain[i];
    largest = std::max(largest, *strain[i]);
  }
  // A step s at the middle of an evenly covered disc of radius R: the mean of s y over y > 0 is 2 s R / (3 pi), that of
  // y^2 over all R^2 / 4.
  EXPECT_NEAR(largest, 8 * 4e-3 / (3 * 3.14159265358979 * reach), 0.03);
}

TEST(ShearStrain, ABedThatMovesOnOverAPeriodicSeamHasNone) {
  const double period = 40e-3;  // of ten grains in each row
  const Snapshot before = hexagonal_bed(10, stay, at_rest);
  Snapshot after = before;
  for (double& x : after.x) x = std::fmod(x + 7e-3, period);
  const double reach = fit_reach(before);
  for (const auto& one : shear_strain(before, after, reach, {.along = period})) EXPECT_NEAR(one.value(), 0, 1e-11);
}

TEST(ShearStrain, ABedThatMovesByHalfAPeriodHasNone) {
  const double period = 40e-3;
  const Snapshot before = hexagonal_bed(10, stay, at_rest);
  Snapshot after = before;
  for (std::size_t i = 0; i < after.size(); ++i)
    after.x[i] = std::fmod(after.x[i] + 20e-3 + (i % 2 == 0 ? 1e-9 : -1e-9), period);
  for (const auto& one : shear_strain(before, after, fit_reach(before), {.along = period}))
    EXPECT_NEAR(one.value(), 0, 1e-6);
}

TEST(ShearStrain, GoesOnOverAPeriodicSeam) {
  // Rows that slide over each other: one shear everywhere, also of the grains at the seam, which see both sides.
  const double period = 40e-3;
  const Snapshot before = hexagonal_bed(10, stay, at_rest);
  Snapshot after = before;
  for (std::size_t i = 0; i < after.size(); ++i) after.x[i] = std::fmod(after.x[i] + 0.3 * after.y[i], period);
  const auto strain = shear_strain(before, after, fit_reach(before), {.along = period});
  for (const auto& one : strain) EXPECT_NEAR(one.value(), 0.3, 1e-11);
}

TEST(ShearStrain, NoneForAGrainThatWasNotThere) {
  Snapshot before = hexagonal_bed(4, stay, at_rest), after = before;
  put(after, 0.1, 0.1);
  // A grain that left changes no other's number.
  const auto drop_first = [](auto& array) { array.erase(array.begin()); };
  drop_first(after.x), drop_first(after.y), drop_first(after.id), drop_first(after.radius);
  const auto strain = shear_strain(before, after, fit_reach(before));
  ASSERT_EQ(strain.size(), 16u);
  for (std::size_t i = 0; i < 15; ++i) EXPECT_NEAR(strain[i].value(), 0, 1e-12) << i;
  EXPECT_FALSE(strain[15]);
}

}  // namespace
}  // namespace vibrosow
