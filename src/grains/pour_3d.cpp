#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "grains/free_room.hpp"
#include "grains/heap_3d.hpp"
#include "grains/pour.hpp"
#include "grains/size_distribution.hpp"
#include "grains/turned_discs.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

/// How a seed lies, or might: the height of its centre (m) and its balls, from there.
struct PlacedSeed {
  FloorPlace place;
  double height;
  Turn turned;
  std::vector<ClumpDisc> balls;

  FloorPlace place_of(const ClumpDisc& ball, const Vessel& vessel) const {
    return within_period(vessel, place + FloorPlace(ball.x, ball.z));
  }
};

/// The lowest place that is found near where a seed is dropped. One that rolls or tips goes downhill all the way too.
class LowestPlace {
 public:
  LowestPlace(const Vessel& vessel, const std::vector<SeedLot>& lots, const Heap3d& heap)
      : vessel_(vessel),
        heap_(heap),
        obstacles_(without_lid(vessel), Space::three_dimensional),
        rooms_(vessel, lots, Space::three_dimensional),
        only_drawn_(is_only_drawn(vessel)),
        drum_(drum_of(vessel)),
        drops_(vessel, Space::three_dimensional) {}

  /// Looked for anew where a seed came down nowhere: a piece that reaches the top is in its way, and it is wide, or it
  /// fell beside the walls; or where it rises above them, or reaches out of a drum. None: again and again.
  std::optional<PlacedSeed> find(const SeedLot& seeds, double size, Random& random) {
    const auto lies_well = [&](const PlacedSeed& seed) {
      const bool is_below_top = std::ranges::all_of(
          seed.balls, [&](const ClumpDisc& ball) { return seed.height + ball.y + ball.radius <= vessel_.height; });
      return is_below_top && !reaches_out(drum_, {seed.place.x(), seed.height}, seed.balls);
    };
    return drops_.until(lies_well,
                        [&](const std::optional<Plot>& plot) { return found_below(seeds, size, plot, random); });
  }

 private:
  PlacedSeed found_below(const SeedLot& seeds, double size, const std::optional<Plot>& plot, Random& random) const {
    constexpr double first = 1, growth = 1.6;  // step, in radii, and after one down
    const double radius = 0.5 * size * seeds.diameter;
    const bool turns = is_solid_clump(seeds);
    // After a step that fails, and the last. A clump has five directions to search, a ball two.
    const auto [shrinkage, last] = turns ? std::pair(0.97, 1e-2) : std::pair(0.85, 1e-3);
    const FloorPlace fallen = plot ? place_in(*plot, radius, random) : random_place(vessel_, radius, random);
    PlacedSeed lowest{fallen, 0, draw_turn(seeds, random), {}};
    lowest.balls = turned_discs(seeds, size, lowest.turned);
    lowest.height = height_of(lowest, std::numeric_limits<double>::infinity());
    PlacedSeed next = lowest;
    for (double step = first; step > last;) {
      const double aside = step * radius * random.uniform(-1, 1);
      next.place = lowest.place + FloorPlace(aside, step * radius * random.uniform(-1, 1));
      if (turns) next.turned.orientation = tilted(lowest.turned.orientation, step, random);
      if (turns) next.balls = turned_discs(seeds, size, next.turned);
      next.place = between_ends(vessel_, next.balls, next.place);
      next.height = height_of(next, lowest.height);
      const bool lower = next.height < lowest.height;
      if (lower) std::swap(lowest, next);
      step = lower ? std::min(first, growth * step) : shrinkage * step;
    }
    return lowest;
  }

  FloorPlace place_in(const Plot& plot, double radius, Random& random) const {
    const double x = random.uniform(plot.low.x(), plot.high.x());
    return between_ends(vessel_, radius, {x, random.uniform(plot.low.y(), plot.high.y())});
  }

  /// Turned on about any axis, by up to 120 degrees at a `step` of 1.
  static Orientation tilted(const Orientation& orientation, double step, Random& random) {
    const double a = step * random.uniform(-1, 1), b = step * random.uniform(-1, 1), c = step * random.uniform(-1, 1);
    return of_unit_length(Orientation{1, a, b, c} * orientation);
  }

  /// Height at which the first ball of a seed that is dropped touches; or some height from `limit` to that one.
  double height_of(const PlacedSeed& seed, double limit) const {
    double height = 0;
    for (const ClumpDisc& ball : seed.balls) {
      if (height >= limit) return height;
      const double least = std::max(ball.radius, height + ball.y);  // the floor, and what other balls touch
      height = std::max(height, heap_.touching_height(seed.place_of(ball, vessel_), ball.radius, least) - ball.y);
    }
    for (const ClumpDisc& ball : seed.balls) {
      if (height >= limit) return height;
      const FloorPlace place = seed.place_of(ball, vessel_);
      const double least = height + ball.y, from = std::max(least, vessel_.height - ball.radius);
      height = std::max(height, obstacles_.touching_height(place, ball.radius, from, least) - ball.y);
    }
    // What reaches over the top, from where seeds fall, may shelter a place; beside drawn walls is none.
    const ClumpDisc& ball = thickest(seed.balls);
    const FloorPlace place = seed.place_of(ball, vessel_);
    if (height < limit && (only_drawn_ || obstacles_.top() > vessel_.height) &&
        !rooms_.of(ball.radius).holds({place.x(), height + ball.y, place.y()}))
      return std::numeric_limits<double>::infinity();
    return height;
  }

  const Vessel& vessel_;
  const Heap3d& heap_;
  Obstacles obstacles_;
  FreeRooms rooms_;
  bool only_drawn_;
  std::optional<DrumCircle> drum_;
  Drops drops_;
};

}  // namespace

std::vector<PackedGrain> pour_3d(const Vessel& vessel, const std::vector<SeedLot>& lots, const std::vector<int>& order,
                                 Random& random, StopRequest stop) {
  Heap3d heap(vessel, largest_disc(lots));
  LowestPlace lowest(vessel, lots, heap);
  std::vector<PackedGrain> packed;
  for (const int lot : order) {
    stop.throw_if_set();
    const SeedLot& seeds = lots[static_cast<std::size_t>(lot)];
    const double size = draw_size(seeds, random);
    const std::optional<PlacedSeed> seed = lowest.find(seeds, size, random);
    if (!seed) refuse_fill(vessel);
    for (const ClumpDisc& ball : seed->balls) {
      const FloorPlace place = seed->place_of(ball, vessel);
      heap.add({place.x(), seed->height + ball.y, place.y()}, ball.radius);
    }
    packed.push_back({seed->place.x(), seed->height, lot, size, seed->turned, seed->place.y()});
  }
  return packed;
}

}  // namespace vibrosow
