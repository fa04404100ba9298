#include "fields/segregation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fields/made_up_bed.hpp"

namespace vibrosow::segregation_test {
namespace {

const Vessel tray = made_up_tray(0.5);

TEST(LotProfile, CountsAndWeighsEachLotByLayer) {
  Snapshot s;
  put(s, 0.1, 2e-3, 0, 0, 0, 2e-3, 30e-6);
  put(s, 0.2, 3e-3, 0, 0, 1, 2e-3, 10e-6);
  put(s, 0.3, 4e-3, 0, 0, 1, 2e-3, 10e-6);
  put(s, 0.3, 12e-3, 0, 0, 1, 2e-3, 10e-6);
  put(s, 0.3, -12e-3, 0, 0, 1);  // fallen through a hole
  put(s, 0.3, 150e-3, 0, 0, 1);  // in a hopper above
  const auto profile = lot_profile(s, tray, 2, 5e-3);
  ASSERT_EQ(profile.size(), 6u) << "three layers of two lots, the middle one empty";
  EXPECT_DOUBLE_EQ(profile[0].height, 2.5e-3);
  EXPECT_EQ(profile[0].grains, 1);
  EXPECT_DOUBLE_EQ(profile[0].mass_fraction, 0.6);
  EXPECT_EQ(profile[1].lot, 1);
  EXPECT_EQ(profile[1].grains, 2);
  EXPECT_DOUBLE_EQ(profile[1].mass, 20e-6);
  EXPECT_DOUBLE_EQ(profile[1].mass_fraction, 0.4);
  EXPECT_TRUE(std::isnan(profile[2].mass_fraction));
  EXPECT_DOUBLE_EQ(profile[5].height, 12.5e-3);
  EXPECT_DOUBLE_EQ(profile[5].mass_fraction, 1);
}

/// Ten even layers of ten grains, of a lot that `lot_of` makes of layer and place.
template <typename LotOf>
Snapshot layered(LotOf lot_of) {
  Snapshot s;
  for (int layer = 0; layer < 10; ++layer)
    for (int k = 0; k < 10; ++k) put(s, 4e-3 * (k + 1), 2e-3 + 4e-3 * layer, 0, 0, lot_of(layer, k));
  return s;
}

TEST(SegregationIndex, IsOneOnTopOfTheOthersWhateverItsShare) {
  for (const int under : {1, 5, 9}) {
    const Snapshot s = layered([&](int layer, int) { return layer >= under ? 1 : 0; });
    EXPECT_NEAR(segregation_index(s, tray, 1).value(), 1, 1e-12);
    EXPECT_NEAR(segregation_index(s, tray, 0).value(), -1, 1e-12);
  }
}

TEST(SegregationIndex, IsZeroWhereMixed) {
  EXPECT_NEAR(segregation_index(layered([](int, int k) { return k % 2; }), tray, 1).value(), 0, 1e-12);
}

TEST(SegregationIndex, IsThreeQuartersOfTheWayWhereAQuarterIsAstray) {
  // Half on top but for one in eight: mean height 7/8 x 3/4 + 1/8 x 1/4 of the bed's, the others' the mirror image.
  Snapshot s;
  for (int layer = 0; layer < 2; ++layer)
    for (int k = 0; k < 8; ++k) put(s, 4e-3 * (k + 1), 2e-3 + 4e-3 * layer, 0, 0, (k == 0) == (layer == 0) ? 1 : 0);
  EXPECT_NEAR(segregation_index(s, tray, 1).value(), 0.75, 1e-12);
}

TEST(SegregationIndex, AGrainCountsByItsOwnArea) {
  Snapshot s;
  put(s, 0.1, 2e-3, 0, 0, 0), put(s, 0.2, 8e-3, 0, 0, 1), put(s, 0.3, 2e-3, 0, 0, 1);
  s.area = {1e-6, 1e-6, 2e-6};  // as of clumps, all in circles of 2 mm
  // The lot's mean height is 4 mm, the other's 2 mm, of all (2 + 8 + 4) / 4 = 3.5 mm.
  EXPECT_NEAR(segregation_index(s, tray, 1).value(), 2 / 3.5, 1e-12);
}

TEST(SegregationIndex, ABallCountsByItsVolume) {
  Vessel deep = tray;
  deep.depth = 0.06;
  Snapshot s;
  put_ball(s, {0.1, 2e-3, 0.01}, {0, 0, 0}, 0), put_ball(s, {0.2, 8e-3, 0.02}, {0, 0, 0}, 1);
  put_ball(s, {0.3, 2e-3, 0.03}, {0, 0, 0}, 1);
  s.volume = {1e-9, 1e-9, 2e-9};
  EXPECT_NEAR(segregation_index(s, deep, 1).value(), 2 / 3.5, 1e-12);
}

TEST(SegregationIndex, NoneForALotAlone) {
  EXPECT_FALSE(segregation_index(layered([](int, int) { return 0; }), tray, 0));
  EXPECT_FALSE(segregation_index(layered([](int, int) { return 0; }), tray, 1));
}

}  // namespace
}  // namespace vibrosow::segregation_test
