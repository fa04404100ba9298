#include "grains/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "grains/pour.hpp"
#include "grains/seats.hpp"
#include "grains/size_distribution.hpp"
#include "scene/input_error.hpp"
#include "scene/mixture.hpp"
#include "scene/plane_alone.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

void refuse_fill(const Vessel& vessel) {
  if (drum_of(vessel))
    throw InputError(fmt::format(
        "{}: {} grains do not all lie within the circle of the {}'s pieces; take fewer, or a {} just as long and high "
        "as its circle",
        vessel.fill->where.or_key(vessel.name + ".fill.count"), vessel.fill->count, vessel.name, vessel.name));
  if (is_only_drawn(vessel))
    throw InputError(
        fmt::format("{}: {} grains do not all lie between the {}'s pieces, where they come to from above; take fewer, "
                    "or draw walls "
                    "to the left and right of them (pieces that close all round are a drum where they are a circle)",
                    vessel.fill->where.or_key(vessel.name + ".fill.count"), vessel.fill->count, vessel.name));
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

std::vector<PackedGrain> pack_rows(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space,
                                   const std::vector<int>& order, Random& random) {
  std::vector<PackedGrain> packed;
  if (order.empty()) return packed;
  const double shift = SeatWidth(vessel, lots, space).shift;
  const bool all = visit_seats(vessel, lots, space, [&](const Eigen::Vector3d& seat) {
    const double dx = shift * random.uniform(-1, 1), dy = shift * random.uniform(-1, 1);
    const double dz = space == Space::two_dimensional ? 0 : shift * random.uniform(-1, 1);
    const int lot = order[packed.size()];
    const SeedLot& seeds = lots[static_cast<std::size_t>(lot)];
    const double size = draw_size(seeds, random);
    packed.push_back({seat.x() + dx, seat.y() + dy, lot, size, draw_turn(seeds, random), seat.z() + dz});
    return packed.size() < order.size();
  });
  if (!all) refuse_fill(vessel);
  return packed;
}

constexpr std::size_t large_bed = 20000;  // grains whose state is more than a core's cache holds

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
  const bool poured = vessel.fill->packing == Packing::poured, is_3d = space == Space::three_dimensional;
  if (diameter > vessel.length)
    throw InputError(fmt::format("{}.length: a grain of {:.6g} mm does not fit in", vessel.name, diameter * 1e3));
  if (is_3d && diameter > *vessel.depth)
    throw InputError(fmt::format("{}.depth: a grain of {:.6g} mm does not fit in", vessel.name, diameter * 1e3));
  const std::vector<int> order = shuffled_lots(lots, vessel.fill->count, random);
  const auto pour_in = plane_alone || !is_3d ? pour : pour_3d;
  std::vector<PackedGrain> grains =
      poured ? pour_in(vessel, lots, order, random, stop) : pack_rows(vessel, lots, space, order, random);
  constexpr double in_plane = 64, across_columns = 8;  // diameters
  if (grains.size() > large_bed) order_by_columns((is_3d ? across_columns : in_plane) * diameter, grains);
  return grains;
}

}  // namespace vibrosow
