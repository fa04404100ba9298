#pragma once

#include <string>

#include "grains/grains.hpp"
#include "grains/random.hpp"
#include "simulation/walls.hpp"

namespace vibrosow {

/// Keeps vessels topped up (`fill.keep`): each missing grain is laid just above the heap at a random place, at rest
/// with its vessel, of a lot drawn by the shares, its size and a clump's angle drawn too. Where the heap reaches the
/// vessel's top there is no room, and it waits. Laid at rest, grains cannot follow a fast outflow: a vessel takes in
/// some 0.7 length / d sqrt(g / (2 d)) a second at most.
class Feeder {
 public:
  Feeder(const Scene& scene, std::uint64_t random_seed);

  /// Whether any vessel is kept topped up.
  bool feeds() const { return feeds_; }

  /// Adds what is missing at `time` (s); returns how many grains were added at the end of `grains`.
  int top_up(Grains& grains, const Walls& walls, double time);

  /// That more than a quarter of a fill was missing, and since when; empty if it never was.
  const std::string& warning() const { return warning_; }

 private:
  int draw_lot();
  void note_waiting(const Vessel& vessel, int waiting, double time);

  std::vector<SeedLot> lots_;
  Law law_;
  Random random_;
  bool feeds_;
  std::string warning_;
};

}  // namespace vibrosow
