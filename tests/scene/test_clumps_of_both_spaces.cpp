#include "scene/spaces.hpp"

#include <gtest/gtest.h>

#include "scene/clump_shape.hpp"
#include "scene/make_clump.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

TEST(Spaces, ClumpsOfBallsBecomeTheDiscsThatAreTheirSections) {
  SeedLot lot{"drop", 0, 8e-5, Shape::clump, 1}, solid = lot;
  make_clump(lot, drop(12e-3, 6e-3), Space::two_dimensional);
  make_clump(solid, drop(12e-3, 6e-3), Space::three_dimensional);
  EXPECT_NE(solid.diameter, lot.diameter) << "the centre of mass of the body is not the plate's";
  solid.sizes = {SizeDistribution::Kind::uniform, 0, 0, 0.9 * solid.diameter, 1.1 * solid.diameter, {}, {}};
  Scene space;
  space.space = Space::three_dimensional;
  space.tray.length = space.tray.height = 0.1, space.tray.depth = 0.05;
  space.lots = {solid};
  const SeedLot seen = in_plane(space).lots[0];
  EXPECT_FALSE(is_solid_clump(seen));
  EXPECT_EQ(seen.mass, solid.mass);
  EXPECT_NEAR(seen.gyration2, lot.gyration2, 1e-13 * lot.gyration2);
  EXPECT_NEAR(seen.diameter, lot.diameter, 1e-15);
  EXPECT_NEAR(least_size(seen), 0.9, 1e-14);
  EXPECT_NEAR(most_size(seen), 1.1, 1e-14);
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
