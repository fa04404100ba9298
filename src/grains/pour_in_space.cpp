#include <algorithm>
#include <cmath>

#include "grains/places.hpp"
#include "grains/pour.hpp"
#include "grains/size_distribution.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

struct Ball {
  double x, y, z, radius;  // m
};

/// Balls that lie, in columns at least as wide as the largest of them.
class HeapInSpace {
 public:
  HeapInSpace(const Vessel& vessel, double largest)
      : largest_(largest), x_(vessel.length, largest, vessel.sides), z_(*vessel.depth, largest, vessel.front_and_back) {
    columns_.resize(x_.count * z_.count);
  }

  void add(const Ball& ball) {
    std::vector<std::vector<Ball>>& column = columns_[x_.at(ball.x) * z_.count + z_.at(ball.z)];
    const std::size_t row = static_cast<std::size_t>(std::max(ball.y, 0.0) / largest_);
    if (column.size() <= row) column.resize(row + 1);
    column[row].push_back(ball);
  }

  /// Height of the centre of a ball that falls at `place` when it first touches another; at least `least`.
  double touching_height(const FloorPlace& place, double radius, double least) const {
    x_.for_each_near(place.x(), [&](std::size_t i) {
      z_.for_each_near(place.y(), [&](std::size_t k) {
        const std::vector<std::vector<Ball>>& column = columns_[i * z_.count + k];
        for (std::size_t row = column.size(); row-- > 0 && (static_cast<double>(row) + 2) * largest_ > least;)
          for (const Ball& ball : column[row]) least = std::max(least, touching_height(ball, place, radius));
      });
    });
    return least;
  }

 private:
  /// The columns along one direction.
  struct Direction {
    std::size_t count;
    double width, length;  // m
    bool periodic;

    Direction(double whole, double largest, Sides sides)
        : count(std::max<std::size_t>(1, static_cast<std::size_t>(whole / largest))),
          width(whole / static_cast<double>(count)),
          length(whole),
          periodic(sides == Sides::periodic) {}

    std::size_t at(double place) const {
      return std::min(static_cast<std::size_t>(std::max(place, 0.0) / width), count - 1);
    }
    double apart(double a, double b) const { return periodic ? std::remainder(a - b, length) : a - b; }
    /// The column of a place and those beside it, each once.
    template <class Visit>
    void for_each_near(double place, Visit visit) const {
      const std::size_t middle = at(place);
      visit(middle);
      if (middle > 0 || (periodic && count > 2)) visit(middle > 0 ? middle - 1 : count - 1);
      if (middle + 1 < count || (periodic && count > 2)) visit(middle + 1 < count ? middle + 1 : 0);
    }
  };

  double touching_height(const Ball& ball, const FloorPlace& place, double radius) const {
    const double dx = x_.apart(place.x(), ball.x), dz = z_.apart(place.y(), ball.z), reach = radius + ball.radius;
    const double left2 = reach * reach - dx * dx - dz * dz;
    return left2 > 0 ? ball.y + std::sqrt(left2) : 0;
  }

  double largest_;  // m, diameter
  Direction x_, z_;
  std::vector<std::vector<std::vector<Ball>>> columns_;  // [column][row] -> balls
};

/// The lowest place that is found near where a ball is dropped. A ball that rolls goes downhill all the way too.
class LowestPlace {
 public:
  LowestPlace(const Vessel& vessel, const HeapInSpace& heap, const Obstacles& obstacles)
      : vessel_(vessel), heap_(heap), obstacles_(obstacles) {}

  Ball find(double radius, Random& random) const {
    constexpr double first = 1, last = 1e-3;          // step, in radii
    constexpr double growth = 1.6, shrinkage = 0.85;  // after a step down, after one that fails
    FloorPlace lowest = random_place(vessel_, radius, random);
    double height = height_at(lowest, radius);
    for (double step = first; step > last;) {
      const double aside = step * radius * random.uniform(-1, 1);
      const FloorPlace next =
          between_ends(vessel_, radius, lowest + FloorPlace(aside, step * radius * random.uniform(-1, 1)));
      const double there = height_at(next, radius);
      const bool lower = there < height;
      if (lower) lowest = next, height = there;
      step = lower ? std::min(first, growth * step) : shrinkage * step;
    }
    return {lowest.x(), height, lowest.y(), radius};
  }

 private:
  double height_at(const FloorPlace& place, double radius) const {
    const double on_heap = heap_.touching_height(place, radius, radius);
    return obstacles_.touching_height(place, radius, std::max(on_heap, vessel_.height - radius), on_heap);
  }

  const Vessel& vessel_;
  const HeapInSpace& heap_;
  const Obstacles& obstacles_;
};

}  // namespace

std::vector<PackedGrain> pour_in_space(const Vessel& vessel, const std::vector<SeedLot>& lots,
                                       const std::vector<int>& order, Random& random, StopRequest stop) {
  HeapInSpace heap(vessel, largest_diameter(lots));
  const Obstacles obstacles(vessel);
  const LowestPlace lowest(vessel, heap, obstacles);
  std::vector<PackedGrain> packed;
  for (const int lot : order) {
    stop.throw_if_set();
    const SeedLot& seeds = lots[static_cast<std::size_t>(lot)];
    const double size = draw_size(seeds, random);
    const Ball ball = lowest.find(0.5 * size * seeds.diameter, random);
    if (!(ball.y + ball.radius <= vessel.height)) refuse_fill(vessel);
    heap.add(ball);
    packed.push_back({ball.x, ball.y, lot, size, draw_turn(seeds, random), ball.z});
  }
  return packed;
}

}  // namespace vibrosow
