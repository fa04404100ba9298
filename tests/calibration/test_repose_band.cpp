#include "calibration/repose_band.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "grains/random.hpp"
#include "support/made_up_atlas.hpp"

namespace vibrosow {
namespace {

TEST(ReposeBand, NothingMeasuredGivesThePriorBack) {
  const ReposeBand band = repose_band(plain_atlas(), 1, {});
  EXPECT_NEAR(band.friction.mean, 0.55, 1e-9);
  EXPECT_NEAR(band.friction.low, 0.1 + 0.025 * 0.9, 1e-9);
  EXPECT_NEAR(band.friction.high, 1 - 0.025 * 0.9, 1e-9);
  EXPECT_NEAR(band.friction.contraction, 0, 1e-9);
  EXPECT_NEAR(band.rolling_friction.mean, 0.15, 1e-9);
  EXPECT_NEAR(band.correlation, 0, 1e-9);
}

TEST(ReposeBand, AnAngleThatFrictionAloneMakesTellsFrictionAlone) {
  const ShippedAtlas atlas{made_up_atlas([](double, double f, double) { return 0.2 + 0.4 * f; },
                                         [](double, double, double) { return 0.8; }, 0, 0),
                           {{-0.05, 0}, {0.7, 0}, {1, 0}, 4}};
  const double error = 0.02, friction = 0.6;
  const ReposeBand band = repose_band(atlas, 1, {0.2 + 0.4 * friction - 0.05, error, {}, 0});
  EXPECT_NEAR(band.friction.mean, friction, 1e-3);
  EXPECT_NEAR(band.friction.high - band.friction.low, 2 * 1.96 * error / 0.4, 2e-3) << "a normal's";
  EXPECT_NEAR(band.friction.contraction, 1 - error / 0.4 / (0.9 / std::sqrt(12.0)), 0.01);
  EXPECT_NEAR(band.rolling_friction.contraction, 0, 1e-6);
}

TEST(ReposeBand, OneAngleCannotTellFrictionFromRolling) {
  const ShippedAtlas atlas = plain_atlas();
  const double angle = atlas.atlas.at(1, 0.5, 0.15).angle.mean - 0.05;
  const ReposeBand one = repose_band(atlas, 1, {angle, 0.005, {}, 0});
  EXPECT_LT(one.correlation, -0.7);
  const ReposeBand both = repose_band(atlas, 1, {angle, 0.005, 0.7 * 0.82, 0.002});
  EXPECT_GT(both.friction.contraction, one.friction.contraction + 0.1);
  EXPECT_GT(both.rolling_friction.contraction, one.rolling_friction.contraction);
  EXPECT_NEAR(both.friction.mean, 0.5, 0.1);
}

TEST(ReposeBand, WhatFitsStandsAsMeasuredAmidTheBand) {
  const ShippedAtlas atlas = plain_atlas();
  const double angle = atlas.atlas.at(1, 0.15, 0.03).angle.mean - 0.05;  // near the corner, where the means do not fit
  const ReposeBand band = repose_band(atlas, 1, {angle, 0.02, {}, 0});
  const auto off = [&](double friction, double rolling) {
    return std::abs(atlas.atlas.at(1, friction, rolling).angle.mean - 0.05 - angle);
  };
  EXPECT_GT(off(band.friction.mean, band.rolling_friction.mean), 0.01);
  EXPECT_LT(off(band.fitting.friction, band.fitting.rolling_friction), 0.006);
  EXPECT_GT(band.fitting.friction, band.friction.low);
  EXPECT_GT(band.fitting.rolling_friction, band.rolling_friction.low);
  const ReposeBand nothing = repose_band(atlas, 1, {});
  EXPECT_NEAR(nothing.fitting.friction, 0.55, 1e-9);
  EXPECT_NEAR(nothing.fitting.rolling_friction, 0.15, 1e-9);
}

TEST(ReposeBand, LargerErrorsWidenIt) {
  ShippedAtlas atlas = plain_atlas();
  const MeasuredBulk measured{0.42, 0.02, {}, 0};
  const double sure = repose_band(atlas, 1, measured).friction.contraction;
  atlas.to_space.angle_offset.scatter = 0.06;
  EXPECT_LT(repose_band(atlas, 1, measured).friction.contraction, sure);
}

/// Standard normal, by Box and Muller.
double normal(Random& random) {
  return std::sqrt(-2 * std::log(1 - random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
}

TEST(ReposeBand, NineteenOfTwentyBandsHoldWhatWasMeasured) {
  const ShippedAtlas atlas = plain_atlas();
  Random random(20200211);
  constexpr int truths = 200;
  int friction_held = 0, rolling_held = 0;
  for (int k = 0; k < truths; ++k) {
    const double friction = random.uniform(0.1, 1), rolling = random.uniform(0, 0.3);
    const AtlasMetrics plane = atlas.atlas.at(1, friction, rolling);
    const double angle_error = std::hypot(0.02, plane.angle.error, angle_error_3d(atlas.to_space));
    const double packing = 0.7 * plane.packing.mean;
    const double packing_error =
        std::hypot(0.01, 0.7 * plane.packing.error, packing * packing_error_3d(atlas.to_space));
    const ReposeBand band = repose_band(
        atlas, 1,
        {plane.angle.mean - 0.05 + angle_error * normal(random), 0.02, packing + packing_error * normal(random), 0.01});
    friction_held += friction >= band.friction.low && friction <= band.friction.high;
    rolling_held += rolling >= band.rolling_friction.low && rolling <= band.rolling_friction.high;
  }
  for (const int held : {friction_held, rolling_held}) {
    EXPECT_GE(held, 0.92 * truths);
    EXPECT_LE(held, 0.98 * truths);
  }
}

TEST(ReposeBand, FewMaterialsComparedAreLessSure) {
  PlaneToSpace to_space{{-0.05, 0.02}, {0.7, 0.014}, {1, 0}, 4};
  EXPECT_DOUBLE_EQ(angle_error_3d(to_space), 0.02 * std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(packing_error_3d(to_space), 0.02 * std::sqrt(1.25));
}

TEST(ReposeBand, WhatIsReachableIsTheAtlas3d) {
  const Reachable range = reachable(plain_atlas(), 1.5);
  EXPECT_NEAR(range.least_angle, 0.25 + 0.03 + 0.05 - 0.05, 1e-12);
  EXPECT_NEAR(range.most_angle, 0.25 + 0.3 + 0.15 + 0.05 - 0.05, 1e-12);
  EXPECT_NEAR(range.least_packing, 0.7 * 0.78, 1e-12);
  EXPECT_NEAR(range.most_packing, 0.7 * 0.852, 1e-12);
  EXPECT_THROW(reachable(plain_atlas(), 2.5), std::out_of_range);
}

TEST(ReposeBand, MaterialsSpreadOverIt) {
  const MeasuredBulk measured{0.42, 0.02, {}, 0};
  const ReposeBand band = repose_band(plain_atlas(), 1, measured);
  constexpr int count = 64;
  const std::vector<Rubbing> materials = materials_of_band(plain_atlas(), 1, measured, count);
  ASSERT_EQ(materials.size(), std::size_t(count));
  double friction = 0, rolling = 0, off = 0;
  for (const auto& [f, r] : materials) {
    friction += f / count;
    rolling += r / count;
    off = std::max(off, std::abs(plain_atlas().atlas.at(1, f, r).angle.mean - 0.05 - 0.42));
  }
  EXPECT_NEAR(friction, band.friction.mean, 0.01);
  EXPECT_NEAR(rolling, band.rolling_friction.mean, 0.01);
  EXPECT_LT(off, 3.5 * 0.02) << "none stands far from what was measured";
  for (const auto& [f, r] : materials_of_band(plain_atlas(), 1, {}, count)) {
    EXPECT_GT(f, 0.1);
    EXPECT_LT(f, 1);
    EXPECT_GT(r, 0);
    EXPECT_LT(r, 0.3);
  }
}

}  // namespace
}  // namespace vibrosow
