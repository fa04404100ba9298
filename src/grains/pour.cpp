#include "grains/pour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "grains/free_room.hpp"
#include "grains/places.hpp"
#include "grains/seats.hpp"
#include "grains/size_distribution.hpp"
#include "grains/turned_discs.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/directions.hpp"
#include "vessel/vessel_walls.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

/// Discs of grains and fixed points that a dropped grain can touch, found through square cells as wide as the largest.
class Heap {
 public:
  struct Disc {
    double x, y, radius;
  };

  Heap(double length, double cell) : cell_(cell), columns_(static_cast<std::size_t>(length / cell) + 1) {}

  void add(const Disc& disc) {
    std::vector<std::vector<int>>& column = columns_[column_of(disc.x)];
    const std::size_t row = row_of(disc.y);
    if (column.size() <= row) column.resize(row + 1);
    column[row].push_back(static_cast<int>(discs_.size()));
    discs_.push_back(disc);
  }

  const Disc& operator[](int k) const { return discs_[static_cast<std::size_t>(k)]; }

  /// The first disc that a grain falling along `x` from `from` touches, with the height of its centre then.
  int first_below(double x, double from, double radius, double& height) const {
    int first = -1;
    const std::size_t centre = column_of(x);
    for (std::size_t c = centre == 0 ? 0 : centre - 1; c <= std::min(centre + 1, columns_.size() - 1); ++c) {
      for (std::size_t row = columns_[c].size(); row-- > 0;) {
        if (first >= 0 && static_cast<double>(row + 1) * cell_ + 2 * cell_ < height) break;
        for (int k : columns_[c][row]) {
          const Disc& disc = (*this)[k];
          const double reach = radius + disc.radius, dx = x - disc.x;
          if (std::abs(dx) >= reach) continue;
          const double touch = disc.y + std::sqrt(reach * reach - dx * dx);
          if (touch <= from + 1e-6 * cell_ && (first < 0 || touch > height)) first = k, height = touch;
        }
      }
    }
    return first;
  }

  /// Height of the centre of a disc that falls along `x` when it first touches another; at least `least`.
  double touching_height(double x, double radius, double least) const {
    const double furthest = radius + 0.5 * cell_;
    for (std::size_t c = column_of(x - furthest); c <= column_of(x + furthest); ++c)
      for (std::size_t row = columns_[c].size(); row-- > 0 && static_cast<double>(row + 1) * cell_ + furthest > least;)
        for (int k : columns_[c][row]) {
          const Disc& disc = (*this)[k];
          const double reach = radius + disc.radius, dx = x - disc.x;
          if (std::abs(dx) < reach && disc.y + reach > least)
            least = std::max(least, disc.y + std::sqrt(reach * reach - dx * dx));
        }
    return least;
  }

  /// Calls `visit(k)` for every disc within two cells of (x, y).
  template <class Visit>
  void near(double x, double y, Visit visit) const {
    const std::size_t column = column_of(x), row = row_of(y);
    for (std::size_t c = column < 2 ? 0 : column - 2; c <= std::min(column + 2, columns_.size() - 1); ++c)
      for (std::size_t r = row < 2 ? 0 : row - 2; r <= row + 2 && r < columns_[c].size(); ++r)
        for (int k : columns_[c][r]) visit(k);
  }

 private:
  std::size_t column_of(double x) const {
    return std::min(static_cast<std::size_t>(std::max(x, 0.0) / cell_), columns_.size() - 1);
  }
  std::size_t row_of(double y) const { return static_cast<std::size_t>(std::max(y, 0.0) / cell_); }

  double cell_;
  std::vector<std::vector<std::vector<int>>> columns_;  // [column][row] -> discs
  std::vector<Disc> discs_;
};

struct Rolled {
  Eigen::Vector2d centre;
  int met;     // the disc that stopped the roll; -1: a wall, the floor, or nothing
  bool rests;  // held from both sides; otherwise it rolls on over `met`, or falls
};

/// Rolls a grain of `radius` that touches disc `support` at height `y` down on its side, to the first thing it meets.
Rolled roll_down(const Heap& heap, int support, double length, double side, double y, double radius) {
  const Heap::Disc& on = heap[support];
  const double reach = radius + on.radius;
  // In a perfect lattice a grain touches several others at once: places closer than this are the same.
  const double tolerance = 1e-6 * reach;
  Rolled first{{on.x + side * reach, on.y}, -1, false};  // nothing met: it comes off at the disc's equator
  const auto meet = [&](const Eigen::Vector2d& at, int disc, bool rests) {
    const bool on_the_way = at.y() <= y + tolerance && side * (at.x() - on.x) >= -tolerance;
    if (on_the_way && at.y() >= first.centre.y() - (first.met < 0 && !first.rests ? tolerance : 0))
      first = {at, disc, rests};
  };
  heap.near(on.x, on.y, [&](int k) {
    if (k == support) return;
    const Heap::Disc& other = heap[k];
    const double reach_other = radius + other.radius;
    const Eigen::Vector2d to_other(other.x - on.x, other.y - on.y);
    const double gap = to_other.norm();
    const double along = (gap * gap + reach * reach - reach_other * reach_other) / (2 * gap);
    if (gap >= reach + reach_other || along * along >= reach * reach) return;
    const double across = std::sqrt(reach * reach - along * along);
    const Eigen::Vector2d u = to_other / gap, left(-u.y(), u.x());
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector2d arm = along * u + sign * across * left;
      const Eigen::Vector2d at = Eigen::Vector2d(on.x, on.y) + arm;
      const Eigen::Vector2d downhill(side * arm.y(), -side * arm.x());
      const Eigen::Vector2d towards(other.x - at.x(), other.y - at.y());
      if (downhill.dot(towards) > 0) meet(at, k, side * towards.x() > 0);
    }
  });
  const double wall_x = side > 0 ? length - radius : radius;
  const double to_wall = wall_x - on.x;
  if (std::abs(to_wall) < reach) meet({wall_x, on.y + std::sqrt(reach * reach - to_wall * to_wall)}, -1, true);
  const double to_floor = radius - on.y;
  if (to_floor >= 0 && to_floor < reach)
    meet({on.x + side * std::sqrt(reach * reach - to_floor * to_floor), radius}, -1, true);
  return first;
}

/// How a seed lies: its centre, m, and how far it is turned, rad.
struct Rest {
  double x, y, angle;
};

/// Where a grain of `radius` dropped at `x` comes to rest.
Rest drop_and_roll(const Heap& heap, double length, double x, double radius) {
  constexpr int most_moves = 100000;  // never reached: each move goes down
  double y = 0;
  int support = heap.first_below(x, std::numeric_limits<double>::max(), radius, y);
  for (int move = 0; move < most_moves && support >= 0 && y > radius; ++move) {
    const double side = x >= heap[support].x ? 1 : -1;
    const Rolled rolled = roll_down(heap, support, length, side, y, radius);
    x = std::clamp(rolled.centre.x(), radius, length - radius);
    y = rolled.centre.y();
    if (rolled.rests) return {x, y, 0};
    support = rolled.met >= 0 ? rolled.met : heap.first_below(x + side * 1e-9 * radius, y, radius, y);
  }
  return {x, radius, 0};
}

/// Points of a wall no further apart than `pitch`.
std::vector<Eigen::Vector2d> points_along(const WallSegment& wall, double pitch) {
  const bool arc = wall.radius > 0;
  const double length = arc ? wall.radius * (wall.to - wall.from) : (wall.b - wall.a).norm();
  const int points = static_cast<int>(std::ceil(length / pitch));
  std::vector<Eigen::Vector2d> along;
  for (int k = 0; k <= points; ++k) {
    const double part = static_cast<double>(k) / points, angle = wall.from + part * (wall.to - wall.from);
    const Eigen::Vector2d on_arc = wall.centre + wall.radius * unit_vector(angle);
    along.push_back(on_arc);
    if (!arc) along.back() = wall.a + (wall.b - wall.a) * part;
  }
  return along;
}

/// Fixed points along the sloping walls and the pieces, so close that a grain between two of them stays within 1/800 of
/// its radius of the wall, and never overlaps it. An arc bulges between two points towards a grain outside of it; in a
/// drum there is none.
void add_slopes(Heap& heap, const Vessel& vessel, double smallest_radius) {
  const double pitch = 0.1 * smallest_radius;
  const std::optional<DrumCircle> drum = drum_of(vessel);
  for (const WallSegment& wall : vessel_walls(without_lid(vessel))) {
    const Eigen::Vector2d along = wall.b - wall.a;
    if (!wall.is_piece && (along.x() == 0 || along.y() == 0)) continue;
    const bool of_drum = drum && drum->has(wall.centre, wall.radius);
    const double curvature = wall.radius > 0 && !of_drum ? 1 / wall.radius : 0;
    const double inflation = pitch * pitch / (8 * smallest_radius) + pitch * pitch / 8 * curvature;
    for (const Eigen::Vector2d& p : points_along(wall, pitch)) {
      const bool beside = p.x() < -0.1 * vessel.length || p.x() > 1.1 * vessel.length;
      if (!beside) heap.add({p.x(), p.y(), inflation});
    }
  }
}

/// A seed as it is turned: its discs, from its centre, and how far they reach.
struct TurnedSeed {
  std::vector<ClumpDisc> discs;
  double left = 0, right = 0, top = 0;  // m

  TurnedSeed(const SeedLot& lot, double size, double angle) : discs(turned_discs(lot, size, {angle})) {
    for (const ClumpDisc& disc : discs) {
      left = std::max(left, disc.radius - disc.x), right = std::max(right, disc.radius + disc.x);
      top = std::max(top, disc.radius + disc.y);
    }
  }
};

/// Height of a seed's centre when, dropped at `x`, its first disc touches; or some height from `limit` to that one.
double touching_height(const Heap& heap, const TurnedSeed& seed, double x, double limit) {
  double height = 0;
  for (const ClumpDisc& disc : seed.discs) {
    if (height >= limit) break;
    const double least = std::max(disc.radius, height + disc.y);  // the floor, and what other discs touch
    height = std::max(height, heap.touching_height(x + disc.x, disc.radius, least) - disc.y);
  }
  return height;
}

/// Where a clump dropped at `x` comes to rest: it is dropped again a little aside and turned a little, at random,
/// less and less, and stays where its centre lies lowest. A search for the lowest place near where it fell, since a
/// clump, unlike a disc, has no closed form for where it rolls to.
Rest drop_and_search(const Heap& heap, double length, const SeedLot& lot, double size, double x, double angle,
                     Random& random) {
  constexpr int tries = 60;        // fills 0.79 of the plane with seeds of four widths, as poured discs do; 30: 0.73
  constexpr double shrink = 0.95;  // of the steps, which begin with the seed's diameter and a quarter turn
  Rest lowest{0, std::numeric_limits<double>::infinity(), 0};
  const auto drop = [&](double at, double turned) {
    const TurnedSeed seed(lot, size, turned);
    at = std::max(seed.left, std::min(at, length - seed.right));
    const double y = touching_height(heap, seed, at, lowest.y);
    if (y < lowest.y) lowest = {at, y, turned};
  };
  drop(x, angle);
  double step = 1;
  for (int k = 0; k < tries; ++k, step *= shrink) {
    const double aside = step * size * lot.diameter * random.uniform(-1, 1);
    const double turn = step * 0.5 * std::numbers::pi * random.uniform(-1, 1);
    drop(lowest.x + aside, lowest.angle + turn);
  }
  return lowest;
}

}  // namespace

Drops::Drops(const Vessel& vessel, Space space) {
  if (vessel.box) return;
  const BoundingBox box = reach_of(vessel, space);
  const double depth = vessel.depth.value_or(0);
  over_pieces_ = Plot{{std::max(0.0, box.low.x()), std::max(0.0, box.low.z())},
                      {std::min(vessel.length, box.high.x()), std::min(depth, box.high.z())}};
}

bool reaches_out(const std::optional<DrumCircle>& drum, const Eigen::Vector2d& centre,
                 const std::vector<ClumpDisc>& discs) {
  return drum && std::ranges::any_of(discs, [&](const ClumpDisc& disc) {
           return is_outside_of_drum(drum, centre + Eigen::Vector2d(disc.x, disc.y), disc.radius);
         });
}

std::vector<PackedGrain> pour(const Vessel& vessel, const std::vector<SeedLot>& lots, const std::vector<int>& order,
                              Random& random, StopRequest stop) {
  Heap heap(vessel.length, largest_disc(lots));
  add_slopes(heap, vessel, smallest_radius(lots));
  const bool only_drawn = is_only_drawn(vessel);
  const FreeRooms rooms(vessel, lots, Space::two_dimensional);
  const std::optional<DrumCircle> drum = drum_of(vessel);
  Drops drops(vessel, Space::two_dimensional);
  std::vector<PackedGrain> packed;
  for (const int lot : order) {
    stop.throw_if_set();
    const SeedLot& seeds = lots[static_cast<std::size_t>(lot)];
    const double size = draw_size(seeds, random), angle = draw_angle(seeds, random);
    const double radius = 0.5 * size * seeds.diameter;
    const auto drop = [&](const std::optional<Plot>& plot) {
      const double most = vessel.length - radius;
      const double x =
          plot ? std::clamp(random.uniform(plot->low.x(), plot->high.x()), radius, most) : random.uniform(radius, most);
      return seeds.discs.empty() ? drop_and_roll(heap, vessel.length, x, radius)
                                 : drop_and_search(heap, vessel.length, seeds, size, x, angle, random);
    };
    const auto lies_well = [&](const Rest& at) {
      const TurnedSeed seed(seeds, size, at.angle);
      if (at.y + seed.top > vessel.height || reaches_out(drum, {at.x, at.y}, seed.discs)) return false;
      const ClumpDisc& disc = thickest(seed.discs);
      return !only_drawn || rooms.of(disc.radius).holds({at.x + disc.x, at.y + disc.y, 0});
    };
    const std::optional<Rest> at = drops.until(lies_well, drop);
    if (!at) refuse_fill(vessel);
    for (const ClumpDisc& disc : turned_discs(seeds, size, {at->angle}))
      heap.add({at->x + disc.x, at->y + disc.y, disc.radius});
    packed.push_back({at->x, at->y, lot, size, {at->angle}});
  }
  return packed;
}

}  // namespace vibrosow
