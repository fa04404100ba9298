#include "scene/make_clump.hpp"

#include <utility>

#include "scene/clump_body.hpp"
#include "scene/clump_shape.hpp"

namespace vibrosow {

void make_clump(SeedLot& lot, const std::vector<ClumpDisc>& discs, Space space) {
  lot.shape = Shape::clump;
  if (space == Space::two_dimensional) {
    lot.discs = about_centre_of_mass(discs);
    for (ClumpDisc& disc : lot.discs) disc.z = 0;
    lot.gyration2 = plate_of(lot.discs).gyration2, lot.gyration2_x = lot.gyration2_y = 0;
  } else {
    SolidClump clump = solid_clump(discs);
    lot.discs = std::move(clump.balls);
    lot.gyration2_x = clump.gyration2.x(), lot.gyration2_y = clump.gyration2.y(), lot.gyration2 = clump.gyration2.z();
  }
  lot.diameter = 2 * holding_radius(lot.discs);
}

}  // namespace vibrosow
