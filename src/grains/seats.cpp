#include "grains/seats.hpp"

#include <algorithm>
#include <cmath>

#include "grains/free_room.hpp"
#include "grains/turned_discs.hpp"
#include "scene/plane_alone.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

/// Where in a vessel a row may have a place: each is one for every seed, so for the widest.
class Room {
 public:
  Room(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space)
      : obstacles_(vessel, space), room_(vessel, space, most_half_width(lots)), drum_(drum_of(vessel)) {}

  /// Whether a ball of diameter `clear` (m) has room at `seat`.
  bool holds(const Eigen::Vector3d& seat, double clear) const {
    return obstacles_.distance(seat) >= 0.5 * clear && !is_outside_of_drum(drum_, seat.head<2>(), 0.5 * clear) &&
           room_.holds(seat);
  }

 private:
  Obstacles obstacles_;
  FreeRoom room_;
  std::optional<DrumCircle> drum_;
};

/// Places side by side along one direction of a vessel.
struct SeatRow {
  int places;
  double spacing;  // m

  SeatRow(double length, double clear)
      : places(static_cast<int>(std::floor(length / clear))), spacing(length / std::max(1, places)) {}

  int of_layer(bool offset) const { return places - (offset ? 1 : 0); }
  double at(int k, bool offset) const { return (k + (offset ? 1.0 : 0.5)) * spacing; }
};

/// m, from a layer to the next, whose places lie `aside` (m) of it where they are hexagonal.
double rise(bool hexagonal, double clear, double aside) {
  return hexagonal ? std::sqrt(std::max(clear * clear - aside * aside, 0.25 * clear * clear)) : clear;
}

}  // namespace

SeatWidth::SeatWidth(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space)
    : clear(largest_diameter(lots) * (1 + 2 * vessel.fill->jitter)),
      shift(largest_diameter(lots) * vessel.fill->jitter / std::sqrt(space == Space::two_dimensional ? 2 : 3)) {}

/// In 3D layers are square: one above the other, or closest packed.
bool visit_seats(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space,
                 const std::function<bool(const Eigen::Vector3d&)>& visit) {
  const bool hexagonal = vessel.fill->packing == Packing::hexagonal;
  const bool is_3d = !plane_alone && space == Space::three_dimensional;
  const double clear = SeatWidth(vessel, lots, space).clear;
  const SeatRow along(vessel.length, clear), across(is_3d ? *vessel.depth : clear, clear);
  if (along.places < 2 || across.places < (is_3d && hexagonal ? 2 : 1)) return false;
  const Room room(vessel, lots, space);
  const double aside = 0.5 * (is_3d ? FloorPlace(along.spacing, across.spacing).norm() : along.spacing);
  double y = (is_3d ? 0 : highest_floor(vessel)) + 0.5 * clear;
  for (int layer = 0; y + 0.5 * clear <= vessel.height; ++layer, y += rise(hexagonal, clear, aside)) {
    const bool offset = hexagonal && layer % 2 == 1;
    const int in_row = along.of_layer(offset), in_layer = in_row * (is_3d ? across.of_layer(offset) : 1);
    for (int k = 0; k < in_layer; ++k) {
      const FloorPlace place(along.at(k % in_row, offset), is_3d ? across.at(k / in_row, offset) : 0);
      if (is_3d && between_ends(vessel, 0.5 * clear * (1 - 1e-9), place) != place) continue;
      const Eigen::Vector3d seat(place.x(), y, place.y());
      if (room.holds(seat, clear) && !visit(seat)) return true;
    }
  }
  return false;
}

bool is_outside_of_drum(const std::optional<DrumCircle>& drum, const Eigen::Vector2d& seat, double radius) {
  constexpr double slack = 1e-9;  // of the radius: what is put in may overlap a wall by no more
  return drum && (seat - drum->centre).norm() + (1 - slack) * radius >= drum->radius;
}

}  // namespace vibrosow
