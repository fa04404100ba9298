#include "grains/fill_height.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "grains/free_room.hpp"
#include "grains/seats.hpp"
#include "grains/turned_discs.hpp"
#include "scene/seed_lot.hpp"
#include "scene/spaces.hpp"

namespace vibrosow {
namespace {

constexpr double rounding = 1e-9;  // of a height, forgiven

/// The room of a vessel from its floor up, m3, in 2D m2.
class RoomBelow {
 public:
  RoomBelow(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space) : height_(vessel.height) {
    const bool flat = space == Space::two_dimensional;
    const double plan = flat ? vessel.length : floor_area(vessel);
    if (Obstacles(vessel, space).none()) {
      room_ = {0, plan * vessel.height};
      return;
    }
    constexpr int layers = 40;
    constexpr double most_cells = 1e6;  // quick enough to be asked of each layout of a study
    const FreeRoom free(vessel, space, least_half_width(lots), most_cells);
    for (int k = 0; k < layers; ++k)
      room_.push_back(room_.back() + plan * free.share_at((k + 0.5) / layers * height_) * height_ / layers);
  }

  double below(double height) const {
    const double layer = std::clamp(height / height_, 0.0, 1.0) * layers();
    const auto whole = static_cast<std::size_t>(std::min(std::floor(layer), layers() - 1));
    return room_[whole] + (layer - static_cast<double>(whole)) * (room_[whole + 1] - room_[whole]);
  }

  /// m, of the room below a height, at the mean.
  double mean_height(double height) const {
    const double layer = height_ / layers();
    double moment = 0;
    for (double from = 0; from < height; from += layer) {
      const double to = std::min(height, from + layer);
      moment += (below(to) - below(from)) * 0.5 * (from + to);
    }
    return moment / below(height);
  }

  double height_of(double room) const {
    const auto above = std::ranges::find_if(room_, [room](double one) { return one >= room; });
    if (above == room_.begin()) return 0;
    if (above == room_.end()) return height_;
    const double part = (room - *std::prev(above)) / (*above - *std::prev(above));
    return (static_cast<double>(above - room_.begin()) - 1 + part) / layers() * height_;
  }

 private:
  double layers() const { return static_cast<double>(room_.size() - 1); }

  double height_;                   // m
  std::vector<double> room_ = {0};  // below the top of each layer
};

/// Share of its volume that a bed as `pour_3d` makes it fills: measured in beds 3 cm high of balls of 4 mm and of
/// clumps 3 mm thick and 1.5, 2.25, 3, 3.75 and 4.9 times as long (0.545, 0.590, 0.558, 0.530, 0.508, 0.466), the loose
/// layer on the floor included.
double poured_share_3d(const SeedLot& lot) {
  constexpr double of_balls = 0.545, densest = 0.59, densest_at = 1.5, less = 0.0365;  // less for each thickness more
  const double slenderness = std::max(1.0, lot.diameter * size_moment(lot, 1) / mean_thickness(lot));
  if (slenderness < densest_at) return of_balls + (slenderness - 1) / (densest_at - 1) * (densest - of_balls);
  return densest - less * (slenderness - densest_at);
}

/// Room that a poured seed takes with what is left free beside it, m3, in 2D m2.
double room_of_seed(const std::vector<SeedLot>& lots, Space space) {
  if (space == Space::two_dimensional) return mean_area(lots) / poured_share;
  double room = 0;
  for (const SeedLot& lot : lots) room += mean_volume({lot}) / poured_share_3d(lot);
  return room;
}

}  // namespace

double seeds_to_height(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space, double height) {
  if (vessel.fill->packing == Packing::poured)
    return RoomBelow(vessel, lots, space).below(height) / room_of_seed(lots, space);
  const double most = height * (1 + rounding) - 0.5 * SeatWidth(vessel, lots, space).clear;
  double places = 0;
  visit_seats(vessel, lots, space, [&](const Eigen::Vector3d& seat) {
    const bool below = seat.y() <= most;
    places += below ? 1 : 0;
    return below;
  });
  return places;
}

double height_of_fill(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space) {
  const int count = vessel.fill->count;
  if (vessel.fill->packing == Packing::poured) {
    double height = RoomBelow(vessel, lots, space).height_of(count * room_of_seed(lots, space));
    for (const SeedLot& lot : lots) height = std::max(height, mean_thickness(lot));  // of a layer that is not full
    return std::min(height, vessel.height);
  }
  double highest = 0;
  int places = 0;
  visit_seats(vessel, lots, space, [&](const Eigen::Vector3d& seat) {
    highest = seat.y();
    return ++places < count;
  });
  return std::min(vessel.height, highest + 0.5 * SeatWidth(vessel, lots, space).clear);
}

double mean_height_of_poured(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space) {
  return RoomBelow(vessel, lots, space).mean_height(height_of_fill(vessel, lots, space));
}

}  // namespace vibrosow
