#pragma once

#include "grains/grains.hpp"
#include "grains/random.hpp"
#include "simulation/walls.hpp"

namespace vibrosow {

/// Keeps vessels topped up (`fill.keep`): each missing grain is laid just above the heap at a random place, at rest
/// with its vessel, of a lot drawn by the shares, its size and a clump's angle drawn too. Where the heap reaches the
/// vessel's top there is no room, and it waits.
class Feeder {
 public:
  Feeder(const Scene& scene, std::uint64_t random_seed);

  /// Whether any vessel is kept topped up.
  bool feeds() const { return feeds_; }

  /// Adds what is missing at `time` (s); returns how many grains were added at the end of `grains`.
  int top_up(Grains& grains, const Walls& walls, double time);

 private:
  int draw_lot();

  std::vector<SeedLot> lots_;
  Law law_;
  Random random_;
  bool feeds_;
};

}  // namespace vibrosow
