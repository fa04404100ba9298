#include "scene/spaces.hpp"

#include <gtest/gtest.h>

#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

TEST(Spaces, ClumpsOfDiscsBecomeTheBallsWithThemAsSections) {
  Scene plane;
  plane.tray.name = "tray";
  plane.tray.length = plane.tray.height = 0.1, plane.tray.depth = 0.05;
  SeedLot lot{"drop", 0, 8e-5, Shape::clump, 1};
  make_clump(lot, drop(12e-3, 6e-3), Space::plane);
  lot.sizes = {SizeDistribution::Kind::uniform, 0, 0, 0.9 * lot.diameter, 1.1 * lot.diameter, {}, {}};
  plane.lots = {lot};
  const Scene space = in_space(plane);
  const SeedLot& solid = space.lots[0];
  EXPECT_TRUE(is_solid_clump(solid));
  EXPECT_NE(solid.diameter, lot.diameter) << "the centre of mass of the body is not the plate's";
  EXPECT_NEAR(least_size(solid), 0.9, 1e-14);
  EXPECT_NEAR(most_size(solid), 1.1, 1e-14);
  EXPECT_NEAR(solid.discs[1].x - solid.discs[0].x, lot.discs[1].x - lot.discs[0].x, 1e-16);
  EXPECT_EQ(solid.mass, lot.mass);
  EXPECT_GT(solid.gyration2, solid.gyration2_x);

  const SeedLot back = in_plane(space).lots[0];
  EXPECT_FALSE(is_solid_clump(back));
  EXPECT_NEAR(back.gyration2, lot.gyration2, 1e-13 * lot.gyration2);
  EXPECT_NEAR(back.diameter, lot.diameter, 1e-15);
  EXPECT_NEAR(least_size(back), 0.9, 1e-14);
}

TEST(Spaces, AFlatSeedIsSeenFromAbove) {
  Scene space;
  space.space = Space::three_dimensional;
  space.tray.length = space.tray.height = 0.1, space.tray.depth = 0.05;
  SeedLot lot{"flat", 0, 8e-5, Shape::clump, 1};
  make_clump(lot, elongated_solid(9e-3, 5e-3, 3e-3), Space::three_dimensional);
  space.lots = {lot};
  const SeedLot seen = in_plane(space).lots[0];
  double widest = 0;
  for (const ClumpDisc& disc : seen.discs) {
    EXPECT_EQ(disc.z, 0);
    widest = std::max(widest, disc.y + disc.radius);
  }
  EXPECT_NEAR(widest, 2.5e-3, 1e-9);
}

}  // namespace
}  // namespace vibrosow
