// One scene in 2D and in 3D.
#include "scene/spaces.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

SeedLot ball(double diameter, double fraction, double density = 1200) {
  return {"ball", diameter, std::numbers::pi / 6 * std::pow(diameter, 3) * density, Shape::ball, fraction};
}

Scene tray_3d() {
  Scene scene;
  scene.space = Space::three_dimensional;
  scene.lots = {ball(3e-3, 1)};
  scene.tray.name = "tray";
  scene.tray.length = 0.5, scene.tray.height = 0.1, scene.tray.depth = 0.06;
  scene.tray.holes = {{0.2, 0.01, 0, HoleShape::slot, 0.03, 0.06}, {0.3, 0.01, 0, HoleShape::slot, 0.03, 0.06}};
  scene.tray.fill = Fill{10000, Packing::poured, 0, false};
  scene.tray.rain = Rain{2000, 0, 0.5, 0.1};
  return scene;
}

TEST(Spaces, ASliceIsCutOutOfTheDepth) {
  const Scene plane = in_plane(tray_3d());
  EXPECT_EQ(plane.space, Space::two_dimensional);
  EXPECT_EQ(plane.tray.fill->count, 500);
  EXPECT_NEAR(plane.tray.rain->rate, 100, 1e-9);
  EXPECT_EQ(plane.tray.holes[0].across_length, 0);
  EXPECT_TRUE(in_plane(plane) == plane);
}

TEST(Spaces, RowsOfRoundHolesBecomeSlotsAndARoundVesselIsCutThroughItsMiddle) {
  Scene scene = tray_3d();
  scene.tray.holes = {{0.2, 0.01, 0, HoleShape::round, 0.015, 0},
                      {0.2, 0.01, 0, HoleShape::round, 0.045, 0},
                      {0.3, 0.01, 0, HoleShape::round, 0.015, 0}};
  Vessel hopper;
  hopper.name = "hopper";
  hopper.plan = Plan::round;
  hopper.length = 0.06, hopper.depth = 0.06, hopper.height = 0.1, hopper.front = 0.01;
  hopper.fill = Fill{1000, Packing::poured, 0, true};
  scene.hopper = hopper;
  const Scene plane = in_plane(scene);
  ASSERT_EQ(plane.tray.holes.size(), 2u);
  EXPECT_EQ(plane.tray.holes[0].shape, HoleShape::slot);
  EXPECT_EQ(plane.tray.fill->count, 500);
  // The chord through the middle over the mean chord is 4 / pi.
  EXPECT_EQ(plane.hopper->fill->count, std::lround(1000 / 20.0 * 4 / std::numbers::pi));
  EXPECT_EQ(plane.hopper->plan, Plan::rectangle);
}

TEST(Spaces, WithoutADepthThereAreNoSlices) {
  Scene scene = tray_3d();
  EXPECT_EQ(slices_of_tray(scene), 0.06 / 3e-3);
  scene.tray.depth.reset();
  EXPECT_FALSE(slices_of_tray(scene));
}

TEST(SliceThickness, OfOneSizeIsTheSeedsOwnToTheBit) {
  EXPECT_EQ(slice_thickness({ball(3.7e-3, 1)}), 3.7e-3);
  SeedLot clump{"clump", 0, 4e-5, Shape::clump, 1};
  make_clump(clump, elongated(6.1e-3, 3.3e-3), Space::two_dimensional);
  EXPECT_EQ(slice_thickness({clump}), mean_thickness(clump));
}

TEST(SliceThickness, OfAMixtureIsTheSauterMean) {
  EXPECT_NEAR(slice_thickness({ball(4e-3, 0.5), ball(2e-3, 0.5)}), (64.0 + 8) / (16 + 4) * 1e-3, 1e-15);
  // Half clover, half pea by mass: 216 seeds of clover for one pea. By number it would be 1.02 mm.
  EXPECT_NEAR(slice_thickness({ball(1e-3, 216.0 / 217), ball(6e-3, 1.0 / 217)}), 12.0 / 7 * 1e-3, 1e-15);
}

TEST(SliceThickness, OfALotOfManySizesIsThatOfAMixtureOfThem) {
  SeedLot table = ball(3e-3, 1);
  table.sizes = {SizeDistribution::Kind::table, 0, 0, 0, 0, {2e-3, 4e-3}, {0.5, 0.5}};
  EXPECT_NEAR(slice_thickness({table}), slice_thickness({ball(4e-3, 0.5), ball(2e-3, 0.5)}), 1e-15);
}

TEST(SliceThickness, OfClumpsOfManySizesIsAsOfBallsOfThem) {
  SeedLot clump{"clump", 0, 4e-5, Shape::clump, 1};
  make_clump(clump, elongated(6e-3, 3e-3), Space::two_dimensional);
  clump.sizes = {SizeDistribution::Kind::table, 0, 0, 0, 0, {0.5 * clump.diameter, 1.5 * clump.diameter}, {0.5, 0.5}};
  EXPECT_NEAR(slice_thickness({clump}), 3e-3 * (0.125 + 3.375) / (0.25 + 2.25), 1e-9);
}

TEST(ImpliedBulkDensity, OfBallsOfOneDensityIsTheSameForEveryMixture) {
  EXPECT_TRUE(rc::check("two thirds of what is filled", [] {
    const auto part = [] { return *rc::gen::map(rc::gen::inRange(1, 1000), [](int k) { return k * 1e-3; }); };
    const double fraction = part(), large = 10e-3 * part(), small = 2e-3 * part();
    const std::vector<SeedLot> lots{ball(large, fraction), ball(small, 1 - fraction)};
    RC_ASSERT(std::abs(implied_bulk_density(lots, 0.84) / (1200 * 0.84 * 2 / 3) - 1) < 1e-12);
    RC_ASSERT(std::abs(*solid_density(lots) / 1200 - 1) < 1e-12);
  }));
  SeedLot disc = ball(3e-3, 1);
  disc.shape = Shape::disc;
  EXPECT_FALSE(solid_density({disc}));
}

}  // namespace
}  // namespace vibrosow
