#pragma once

#include <string>

#include "simulation/state.hpp"
#include "vessel/walls.hpp"

namespace vibrosow {

/// Puts grains in during a run.
///
/// Rain: see `Rain`; the arrivals up to now, lots drawn by the fractions. Only a place clear of every grain and wall is
/// taken; each waiting grain is tried once each time, at another place.
///
/// Keeps vessels topped up (`fill.keep`): each missing grain is laid just above the heap at a random place, at rest
/// with its vessel, of a lot drawn by the fractions, its size and how a clump is turned drawn too. Where the heap
/// reaches the vessel's top there is no room, and it waits. Grains of the heap touch others (`touching`, one flag a
/// grain); between those that are still falling there may be room.
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

  /// That more than a quarter of a fill was missing, and since when; empty if it never was.
  const std::string& warning() const { return state_.warning; }

 private:
  using Shower = FeederState::Shower;
  int rain(const Vessel& vessel, Shower& shower, Grains& grains, const Walls& walls, const Pose& pose, double time);
  int draw_lot(Random& random) const;
  void draw_next(Shower& shower) const;
  void note_waiting(const Vessel& vessel, int waiting, double time);

  const Model& model_;
  FeederState& state_;
  bool feeds_ = false, rains_ = false;
};

}  // namespace vibrosow
