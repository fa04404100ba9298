#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grains/places.hpp"
#include "simulation/seed_places.hpp"
#include "simulation/state.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Puts grains in during a run: where it is clear of every grain and wall and belongs to the vessel (`SeedPlaces`), and
/// only there. Each is looked at once more when it is in (`fault`).
///
/// Nothing is put into a vessel that does not stand (`stands`); it waits.
///
/// Rain: see `Rain`; the arrivals up to now, lots drawn by the fractions. Each waiting grain is tried once each time,
/// at another place.
///
/// Keeps vessels topped up (`fill.keep`): each missing grain is laid above the heap, as low as there is room, at a
/// random place of the floor, at rest with its vessel, of a lot drawn by the fractions, its size and how a clump is
/// turned drawn too; a clump takes the room of the circle that holds it. Where there is none below the vessel's top, it
/// waits, and is tried again at another place, a clump turned anew: a seed that is drawn is fed before any other, for
/// else what is fed would be what fits. Grains of the heap touch others (`touching`, one flag a grain); between those
/// that are still falling there may be room.
class Feeder {
 public:
  Feeder(const Model& model, FeederState& state);

  /// Whether any vessel is kept topped up, or rained into.
  bool feeds() const { return feeds_; }
  bool rains() const { return rains_; }

  /// Adds what is missing at `time` (s); returns how many grains were added at the end of `grains`.
  int top_up(Grains& grains, const std::vector<char>& touching, const Walls& walls, double time);

  /// Adds what has rained up to `time` (s); returns how many grains were added at the end of `grains`.
  int rain(Grains& grains, const Walls& walls, double time);

  const SeedPlaces& places() const { return places_; }

  /// What was wrong with how a grain was put in, of the first that was; none: nothing ever.
  const std::optional<std::string>& fault() const { return fault_; }

  /// That more than a quarter of a fill was missing, and since when; that more than a twentieth of the rain that was
  /// due by `time` (s) still waits.
  std::vector<std::string> warnings(double time) const;

 private:
  struct Inside;
  Inside grains_inside(std::size_t vessel, const Walls& walls, const Grains& grains,
                       const std::vector<char>& touching) const;
  std::optional<double> free_height(const Inside& inside, const FloorPlace& place, const DrawnSeed& seed,
                                    std::size_t vessel, const Walls& walls) const;
  bool belongs(const DrawnSeed& seed, const Eigen::Vector3d& at, std::size_t vessel, const Walls& walls) const;
  int rain(std::size_t vessel, Grains& grains, const Walls& walls, double time);
  void put(const DrawnSeed& seed, const Eigen::Vector3d& at, const Eigen::Vector3d& velocity, std::size_t vessel,
           const Walls& walls, Grains& grains);
  int draw_lot(Random& random) const;
  const SeedLot& lot_of(const DrawnSeed& seed) const;
  DrawnSeed draw(Random& random) const;  // its lot and size
  double radius_of(const DrawnSeed& seed) const;
  /// `stands`: whether the vessel does; in one that is tipped over nothing is put.
  void note_waiting(std::size_t vessel, int waiting, double time, bool stands);

  const Model& model_;
  FeederState& state_;
  SeedPlaces places_;
  std::optional<std::string> fault_;
  bool feeds_ = false, rains_ = false;
};

}  // namespace vibrosow
