#include "grains/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "grains/free_room.hpp"
#include "grains/pour.hpp"
#include "grains/size_distribution.hpp"
#include "grains/turned_discs.hpp"
#include "scene/input_error.hpp"
#include "scene/mixture.hpp"
#include "scene/plane_alone.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

void refuse_fill(const Vessel& vessel) {
  if (drum_of(vessel) != nullptr)
    throw InputError(fmt::format(
        "{}: {} grains do not all lie within the circle of the {}'s pieces; take fewer, or a {} just as long and high "
        "as its circle",
        vessel.fill->where.or_key(vessel.name + ".fill.count"), vessel.fill->count, vessel.name, vessel.name));
  throw InputError(
      fmt::format("{}: {} grains rise above the end walls ({}.height = {:.6g} mm); take fewer, or a higher {}",
                  vessel.fill->where.or_key(vessel.name + ".fill.count"), vessel.fill->count, vessel.name,
                  vessel.height * 1e3, vessel.name));
}

namespace {

std::vector<int> shuffled_lots(const std::vector<SeedLot>& lots, int count, Random& random) {
  const std::vector<int> counts = lot_counts(lots, count);
  std::vector<int> order;
  for (std::size_t lot = 0; lot < counts.size(); ++lot)
    order.insert(order.end(), static_cast<std::size_t>(counts[lot]), static_cast<int>(lot));
  if (lots.size() > 1)
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
  return order;
}

/// Whether a grain of `radius` at `seat` does not lie within its drum.
bool is_outside_of_drum(const Vessel& vessel, const Eigen::Vector2d& seat, double radius) {
  constexpr double slack = 1e-3;  // of the radius
  const WallPiece* drum = drum_of(vessel);
  return drum != nullptr && (seat - drum->centre).norm() + (1 - slack) * radius >= drum->radius;
}

/// Where in a vessel a row may have a place.
class Seats {
 public:
  Seats(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space)
      : vessel_(vessel), obstacles_(vessel, space), room_(vessel, space, least_half_width(lots)) {}

  /// Whether a ball of diameter `clear` (m) has room at `seat`.
  bool take(const Eigen::Vector3d& seat, double clear) const {
    return obstacles_.distance(seat) >= 0.5 * clear && !is_outside_of_drum(vessel_, seat.head<2>(), 0.5 * clear) &&
           room_.holds(seat);
  }

 private:
  const Vessel& vessel_;
  Obstacles obstacles_;
  FreeRoom room_;
};

/// Places side by side along one direction of a vessel.
struct PackedRow {
  int places;
  double spacing;  // m

  PackedRow(double length, double clear)
      : places(static_cast<int>(std::floor(length / clear))), spacing(length / std::max(1, places)) {}

  int of_layer(bool offset) const { return places - (offset ? 1 : 0); }
  double at(int k, bool offset) const { return (k + (offset ? 1.0 : 0.5)) * spacing; }
};

/// How rows of a fill lie.
struct RowPlan {
  bool hexagonal;  // every other layer is offset by half a place
  double clear;    // m, so wide that jitter never makes an overlap
  double shift;    // m, each way

  RowPlan(const Fill& fill, const std::vector<SeedLot>& lots, double directions)
      : hexagonal(fill.packing == Packing::hexagonal),
        clear(largest_diameter(lots) * (1 + 2 * fill.jitter)),
        shift(largest_diameter(lots) * fill.jitter / std::sqrt(directions)) {}

  /// m, from a layer to the next whose places lie `aside` (m) of it.
  double rise(double aside) const {
    return hexagonal ? std::sqrt(std::max(clear * clear - aside * aside, 0.25 * clear * clear)) : clear;
  }
};

std::vector<PackedGrain> pack_rows(const Vessel& vessel, const std::vector<SeedLot>& lots,
                                   const std::vector<int>& order, Random& random) {
  const RowPlan plan(*vessel.fill, lots, 2);
  const PackedRow row(vessel.length, plan.clear);
  if (row.places < 2) refuse_fill(vessel);
  const Seats seats(vessel, lots, Space::plane);
  std::vector<PackedGrain> packed;
  double y = highest_floor(vessel) + 0.5 * plan.clear;
  for (int layer = 0; packed.size() < order.size(); ++layer, y += plan.rise(0.5 * row.spacing)) {
    const bool offset = plan.hexagonal && layer % 2 == 1;
    for (int k = 0; k < row.of_layer(offset) && packed.size() < order.size(); ++k) {
      const double x = row.at(k, offset);
      if (!seats.take({x, y, 0}, plan.clear)) continue;
      const double dx = plan.shift * random.uniform(-1, 1), dy = plan.shift * random.uniform(-1, 1);
      const int lot = order[packed.size()];
      const SeedLot& seeds = lots[static_cast<std::size_t>(lot)];
      const double size = draw_size(seeds, random);
      packed.push_back({x + dx, y + dy, lot, size, draw_turn(seeds, random)});
    }
    if (y + 0.5 * plan.clear > vessel.height) refuse_fill(vessel);
  }
  return packed;
}

/// Square layers: one above the other, or closest packed.
std::vector<PackedGrain> pack_layers(const Vessel& vessel, const std::vector<SeedLot>& lots,
                                     const std::vector<int>& order, Random& random) {
  const RowPlan plan(*vessel.fill, lots, 3);
  const PackedRow along(vessel.length, plan.clear), across(*vessel.depth, plan.clear);
  if (along.places < 2 || across.places < (plan.hexagonal ? 2 : 1)) refuse_fill(vessel);
  const Seats seats(vessel, lots, Space::three_dimensional);
  const double rise = plan.rise(0.5 * FloorPlace(along.spacing, across.spacing).norm());
  std::vector<PackedGrain> packed;
  double y = 0.5 * plan.clear;
  for (int layer = 0; packed.size() < order.size(); ++layer, y += rise) {
    const bool offset = plan.hexagonal && layer % 2 == 1;
    const int in_row = along.of_layer(offset), in_layer = in_row * across.of_layer(offset);
    for (int k = 0; k < in_layer && packed.size() < order.size(); ++k) {
      const FloorPlace place(along.at(k % in_row, offset), across.at(k / in_row, offset));
      if (between_ends(vessel, 0.5 * plan.clear * (1 - 1e-9), place) != place) continue;
      if (!seats.take({place.x(), y, place.y()}, plan.clear)) continue;
      const double dx = plan.shift * random.uniform(-1, 1), dy = plan.shift * random.uniform(-1, 1);
      const double dz = plan.shift * random.uniform(-1, 1);
      const int lot = order[packed.size()];
      const SeedLot& seeds = lots[static_cast<std::size_t>(lot)];
      const double size = draw_size(seeds, random);
      packed.push_back({place.x() + dx, y + dy, lot, size, draw_turn(seeds, random), place.y() + dz});
    }
    if (y + 0.5 * plan.clear > vessel.height) refuse_fill(vessel);
  }
  return packed;
}

constexpr std::size_t large_bed = 20000;  // grains whose state is more than a core's cache holds

std::vector<PackedGrain> pack_poured(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space,
                                     const std::vector<int>& order, Random& random, StopRequest stop) {
  const auto poured = plane_alone || space == Space::plane ? pour : pour_in_space;
  std::vector<PackedGrain> grains = poured(vessel, lots, order, random, stop);
  for (const PackedGrain& grain : grains)
    for (const ClumpDisc& disc : turned_discs(lots[static_cast<std::size_t>(grain.lot)], grain.size, grain.turned))
      if (is_outside_of_drum(vessel, {grain.x + disc.x, grain.y + disc.y}, disc.radius)) refuse_fill(vessel);
  return grains;
}

/// Lists a bed column by column instead of row by row, so that neighbours are near each other in memory.
void order_by_columns(double width, std::vector<PackedGrain>& grains) {
  std::ranges::stable_sort(grains, {}, [width](const PackedGrain& grain) {
    return std::pair(std::floor(grain.x / width), std::floor(grain.z / width));
  });
}

}  // namespace

std::vector<PackedGrain> pack(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space, Random& random,
                              StopRequest stop) {
  if (!vessel.fill) return {};
  stop.throw_if_set();
  const double diameter = largest_diameter(lots);
  const bool poured = vessel.fill->packing == Packing::poured, in_space = space == Space::three_dimensional;
  if (diameter > vessel.length)
    throw InputError(fmt::format("{}.length: a grain of {:.6g} mm does not fit in", vessel.name, diameter * 1e3));
  if (in_space && diameter > *vessel.depth)
    throw InputError(fmt::format("{}.depth: a grain of {:.6g} mm does not fit in", vessel.name, diameter * 1e3));
  const std::vector<int> order = shuffled_lots(lots, vessel.fill->count, random);
  std::vector<PackedGrain> grains = poured                     ? pack_poured(vessel, lots, space, order, random, stop)
                                    : !plane_alone && in_space ? pack_layers(vessel, lots, order, random)
                                                               : pack_rows(vessel, lots, order, random);
  constexpr double in_plane = 64, across_columns = 8;  // diameters
  if (grains.size() > large_bed) order_by_columns((in_space ? across_columns : in_plane) * diameter, grains);
  return grains;
}

}  // namespace vibrosow
