#include "scene/seed_lot.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace vibrosow {
namespace {

using Kind = SizeDistribution::Kind;

SeedLot lot_with(const SizeDistribution& sizes, Shape shape = Shape::ball) {
  SeedLot lot{"a", 4e-3, 3e-5, shape, 1};
  lot.sizes = sizes;
  return lot;
}

TEST(SizeMoments, SingleSizeIsExactlyOne) {
  const SeedLot lot = lot_with({});
  for (const int power : {1, 2, 3}) EXPECT_EQ(size_moment(lot, power), 1.0);
  EXPECT_EQ(mean_mass(lot), 3e-5);
  EXPECT_EQ(mean_thickness(lot), 4e-3);
  EXPECT_EQ(least_size(lot), 1.0);
  EXPECT_EQ(most_size(lot), 1.0);
}

TEST(SizeMoments, Uniform) {
  const SeedLot lot = lot_with({Kind::uniform, 4e-3, 0, 3e-3, 5e-3, {}, {}});
  EXPECT_NEAR(size_moment(lot, 1), 1, 1e-15);
  EXPECT_NEAR(size_moment(lot, 2), 1 + 0.25 * 0.25 / 3, 1e-15);  // mean^2 + (half width)^2 / 3
  EXPECT_NEAR(size_moment(lot, 3), 1 + 0.25 * 0.25, 1e-15);      // + 3 mean variance
  EXPECT_NEAR(mean_mass(lot), 3e-5 * 1.0625, 1e-18);
  EXPECT_NEAR(mean_mass(lot_with(lot.sizes, Shape::disc)), 3e-5 * (1 + 0.0625 / 3), 1e-18);
}

TEST(SizeMoments, NormalCutAlikeOnBothSides) {
  const SeedLot lot = lot_with({Kind::normal, 4e-3, 0.4e-3, 2.8e-3, 5.2e-3, {}, {}});
  const boost::math::normal unit;
  const double variance = 0.01 * (1 - 6 * pdf(unit, 3) / (2 * cdf(unit, 3) - 1));
  EXPECT_NEAR(size_moment(lot, 1), 1, 1e-13);
  EXPECT_NEAR(size_moment(lot, 2), 1 + variance, 1e-13);
  EXPECT_NEAR(size_moment(lot, 3), 1 + 3 * variance, 1e-13);
}

TEST(SizeMoments, NarrowNormalBetweenWideCuts) {
  const SeedLot lot = lot_with({Kind::normal, 4e-3, 4e-7, 1e-3, 9e-3, {}, {}});
  EXPECT_NEAR(size_moment(lot, 2), 1 + 1e-8, 1e-13);
}

TEST(SizeMoments, LognormalIsOfTheDiameterItself) {
  const SeedLot lot = lot_with({Kind::lognormal, 4e-3, 2e-3, 4e-8, 400, {}, {}});
  const double variance = std::log(1.25);
  EXPECT_NEAR(size_moment(lot, 1), 1, 1e-11);
  EXPECT_NEAR(size_moment(lot, 2), 1.25, 1e-11);
  EXPECT_NEAR(size_moment(lot, 3), std::exp(3 * variance), 1e-10);
}

TEST(SizeMoments, Table) {
  const SeedLot lot = lot_with({Kind::table, 4e-3, 0, 0, 0, {3e-3, 5e-3}, {0.5, 0.5}});
  EXPECT_NEAR(size_moment(lot, 3), (27 + 125) / 128.0, 1e-15);
  EXPECT_EQ(least_size(lot), 0.75);
  EXPECT_EQ(most_size(lot), 1.25);
}

TEST(LargestAndSmallest, AreOfTheSeedsThatCanBe) {
  std::vector<SeedLot> lots = {{"a", 4e-3, 3e-5, Shape::ball, 0.5}, {"b", 2e-3, 1e-5, Shape::disc, 0.5}};
  EXPECT_EQ(largest_diameter(lots), 4e-3);
  EXPECT_EQ(smallest_radius(lots), 1e-3);
  lots[0].sizes = {Kind::normal, 4e-3, 1e-3, 1e-3, 7e-3, {}, {}};
  EXPECT_DOUBLE_EQ(largest_diameter(lots), 7e-3);
  EXPECT_DOUBLE_EQ(smallest_radius(lots), 0.5e-3);
}

TEST(LargestAndSmallest, ClumpByItsSmallestDisc) {
  SeedLot clump{"c", 8e-3, 3e-5, Shape::clump, 1};
  clump.discs = {{-2e-3, 0, 2e-3}, {3e-3, 0, 1e-3}};
  EXPECT_EQ(smallest_radius({clump}), 1e-3);
  EXPECT_EQ(largest_diameter({clump}), 8e-3);
  EXPECT_EQ(mean_thickness(clump), 4e-3);
  clump.sizes = {Kind::uniform, 8e-3, 0, 4e-3, 12e-3, {}, {}};
  EXPECT_DOUBLE_EQ(smallest_radius({clump}), 0.5e-3);
  EXPECT_DOUBLE_EQ(largest_diameter({clump}), 12e-3);
  EXPECT_NEAR(mean_mass(clump), 3e-5 * (1 + 0.25), 1e-18) << "E[s^3] of s from 1/2 to 3/2, as of a ball";
}

}  // namespace
}  // namespace vibrosow
