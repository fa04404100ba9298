#include "grains/free_room.hpp"

#include <algorithm>
#include <cmath>

#include "grains/turned_discs.hpp"
#include "portable_math/functions.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_walls.hpp"
#include "vessel/wall_points.hpp"

namespace vibrosow {
namespace {

/// Whether all that stands in a round vessel is turned about its own axis.
bool is_turned(const Vessel& vessel, Space space) {
  const Eigen::Vector2d axis = Eigen::Vector2d::Constant(0.5 * vessel.length);
  return space == Space::three_dimensional && vessel.plan == Plan::round &&
         std::ranges::all_of(vessel.pieces, [&](const WallPiece& piece) {
           return piece.about && piece.axis == PieceAxis::upright && *piece.about == axis;
         });
}

bool is_drawn_out(const Vessel& vessel, Space space) {
  return space == Space::two_dimensional ||
         (vessel.plan == Plan::rectangle && std::ranges::all_of(vessel.pieces, is_of_plane));
}

}  // namespace

/// Two neighbouring cells, `1 / cells` of the seed's radius apart, never lie on two sides of a wall from which both
/// keep `kept_clear` of that radius. Cells lie beside the middle of a passage: one as wide as the seed is always open,
/// one of that part of its width is closed.
FreeRoom::FreeRoom(const Vessel& vessel, Space space, double least_radius, double most_cells)
    : vessel_(vessel),
      is_3d_(space == Space::three_dimensional),
      turned_(is_turned(vessel, space)),
      cut_(turned_ || is_drawn_out(vessel, space)),
      cells_in_radius_(cut_ ? 8 : 4),
      kept_clear_(cut_ ? 0.9 : 0.8),
      least_radius_(least_radius),
      most_cells_(most_cells),
      obstacles_(without_lid(vessel), space),
      drum_(drum_of(vessel)),
      drawn_(drawn_walls(vessel, space)) {
  top_ = std::max(vessel.height, obstacles_.top() + least_radius);
}

bool FreeRoom::is_in_plan(const Eigen::Vector3d& centre, double clear) const {
  if (is_3d_ && vessel_.plan == Plan::round) {
    const double middle = 0.5 * vessel_.length;
    return Eigen::Vector2d(centre.x() - middle, centre.z() - middle).norm() <= middle - clear;
  }
  const auto between = [clear](Sides sides, double at, double length) {
    const double margin = sides == Sides::walls ? clear : 0;
    return sides == Sides::periodic || (at >= margin && at <= length - margin);
  };
  return between(vessel_.sides, centre.x(), vessel_.length) &&
         (!is_3d_ || between(vessel_.front_and_back, centre.z(), *vessel_.depth));
}

std::vector<FreeRoom::Stroke> FreeRoom::drawn_walls(const Vessel& vessel, Space space) {
  std::vector<Stroke> strokes;
  if (!is_only_drawn(vessel)) return strokes;
  for (const WallSegment& wall : vessel_walls(vessel)) {
    const std::vector<Eigen::Vector2d> points = wall_points(wall);
    for (std::size_t k = 1; k < points.size(); ++k) strokes.push_back({points[k - 1], points[k]});
  }
  for (const WallPiece& piece : vessel.pieces)
    if (space == Space::three_dimensional && piece.about && piece.axis == PieceAxis::upright)
      strokes.push_back({piece.a, piece.b, piece.about});
  return strokes;
}

/// Whether drawn walls stand to the left and to the right at the centre's height; on one side alone: it lies beside
/// them. None: on neither.
std::optional<bool> FreeRoom::is_between(const Eigen::Vector3d& centre) const {
  bool left = false, right = false;
  const auto meet = [&](double x) { (x <= centre.x() ? left : right) = true; };
  for (const Stroke& stroke : drawn_) {
    if ((stroke.a.y() < centre.y()) == (stroke.b.y() < centre.y())) continue;
    const double part = (centre.y() - stroke.a.y()) / (stroke.b.y() - stroke.a.y());
    const double at = stroke.a.x() + part * (stroke.b.x() - stroke.a.x());
    if (!stroke.about) {
      meet(at);
    } else if (const double aside = centre.z() - stroke.about->y(); std::abs(aside) < at) {
      const double half = std::sqrt(at * at - aside * aside);
      meet(stroke.about->x() - half), meet(stroke.about->x() + half);
    }
  }
  return left || right ? std::optional(left && right) : std::nullopt;
}

/// Above drawn walls it is as at the rim beneath, below them, in an outlet, as at their foot; over one with no rim
/// beside, as on a plate, it is within too.
bool FreeRoom::is_between_drawn(const Eigen::Vector3d& centre) const {
  if (drawn_.empty()) return true;
  if (const std::optional<bool> between = is_between(centre)) return *between;
  double rim = -1e300, ground = -1e300;  // m, the highest beneath
  double foot = 1e300;                   // m, the lowest of all
  for (const Stroke& stroke : drawn_) {
    const double top = std::max(stroke.a.y(), stroke.b.y());
    foot = std::min({foot, stroke.a.y(), stroke.b.y()});
    if (top > centre.y()) continue;
    rim = std::max(rim, top);
    const double x = stroke.about ? portable_math::hypot(centre.x() - stroke.about->x(), centre.z() - stroke.about->y())
                                  : centre.x();
    const double along = stroke.b.x() - stroke.a.x(), part = along == 0 ? -1 : (x - stroke.a.x()) / along;
    if (part >= 0 && part <= 1) ground = std::max(ground, stroke.a.y() + part * (stroke.b.y() - stroke.a.y()));
  }
  if (rim < foot) return is_between({centre.x(), std::nextafter(foot, 1e300), centre.z()}).value_or(false);
  if (ground >= rim) return true;
  return is_between({centre.x(), rim, centre.z()}).value_or(false);
}

/// Where the centre lies in the cut, if there is one.
Eigen::Vector3d FreeRoom::in_cut(const Eigen::Vector3d& centre) const {
  if (!cut_) return centre;
  const double middle = 0.5 * vessel_.depth.value_or(0);
  const double aside = turned_ ? portable_math::hypot(centre.x() - middle, centre.z() - middle) : centre.x() - middle;
  return {middle + aside, centre.y(), middle};
}

bool FreeRoom::is_open_above(const Eigen::Vector3d& centre) const {
  constexpr double slack = 1e-6, least_stride = 0.05;  // of the radius; a seed that slides up along a wall goes on
  Eigen::Vector3d at = centre;
  while (at.y() < top_) {
    const double gap = obstacles_.distance(at) - least_radius_;
    if (gap < -slack * least_radius_) return false;
    at.y() += std::max(gap, least_stride * least_radius_);
  }
  return true;
}

bool FreeRoom::holds(const Eigen::Vector3d& centre) const {
  if (!is_in_plan(centre, 0) || centre.y() < 0) return false;
  if (drum_ && (centre.head<2>() - drum_->centre).norm() > drum_->radius) return false;
  return is_between_drawn(centre) && (obstacles_.none() || is_open_above(centre) || is_reached(centre));
}

/// Of any place: one that is nearer to a wall than a seed's centre comes is asked of that far away, on its own side.
bool FreeRoom::holds_beside_walls(const Eigen::Vector3d& place) const {
  constexpr double beyond = 1.02, difference = 1e-3;  // of the radius: more than what `is_reached` forgives
  const double clear = beyond * least_radius_, gap = obstacles_.distance(place);
  if (gap >= clear) return holds(place);
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < (is_3d_ ? 3 : 2); ++axis) {
    const Eigen::Vector3d step = difference * least_radius_ * Eigen::Vector3d::Unit(axis);
    away[axis] = obstacles_.distance(place + step) - obstacles_.distance(place - step);
  }
  const double slope = away.norm();
  Eigen::Vector3d asked = place;
  if (slope > 0) asked += (clear - gap) / slope * away;
  const double depth = vessel_.depth.value_or(0);
  return holds(asked.cwiseMax(Eigen::Vector3d::Zero()).cwiseMin(Eigen::Vector3d(vessel_.length, top_, depth)));
}

double FreeRoom::share_at(double height) const {
  constexpr int along_a_cut = 200, along_and_across = 40;
  const int along = cut_ && !turned_ ? along_a_cut : along_and_across;
  const int across = cut_ && !turned_ ? 1 : along_and_across;
  int places = 0, held = 0;
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < across; ++k) {
      const Eigen::Vector3d place((i + 0.5) / along * vessel_.length, height,
                                  (k + 0.5) / across * vessel_.depth.value_or(0));
      if (!is_in_plan(place, 0)) continue;
      ++places;
      held += holds_beside_walls(place) ? 1 : 0;
    }
  return static_cast<double>(held) / places;
}

/// The cells near enough that no wall can lie between.
bool FreeRoom::is_reached(const Eigen::Vector3d& place) const {
  if (!grid_) grid_ = made_grid();
  const Eigen::Vector3d centre = in_cut(place);
  const double near = least_radius_ + kept_clear_ * grid_->radius;
  Eigen::Array3i own = (centre.array() / grid_->cell.array()).floor().cast<int>();
  if (cut_) own.z() = 0;
  Eigen::Array3i reach = (near / grid_->cell.array()).ceil().cast<int>();
  if (cut_) reach.z() = 0;
  const auto is_near_one = [&](const Eigen::Array3i& at) {
    const Eigen::Array3i kept = carried_over(at, *grid_);
    if ((kept < 0).any() || (kept >= grid_->cells).any() || !grid_->reached[grid_->index(kept)]) return false;
    Eigen::Vector3d apart = grid_->centre(at) - centre;
    if (cut_) apart.z() = 0;
    return apart.norm() < near;
  };
  if (is_near_one(own)) return true;  // as of most that are held
  for (int k = -reach.z(); k <= reach.z(); ++k)
    for (int j = -reach.y(); j <= reach.y(); ++j)
      for (int i = -reach.x(); i <= reach.x(); ++i)
        if (is_near_one(own + Eigen::Array3i(i, j, k))) return true;
  return false;
}

Eigen::Array3i FreeRoom::carried_over(Eigen::Array3i at, const Grid& grid) const {
  const auto within = [](int k, int cells) { return (k % cells + cells) % cells; };
  if (vessel_.sides == Sides::periodic) at.x() = within(at.x(), grid.cells.x());
  if (!cut_ && vessel_.front_and_back == Sides::periodic) at.z() = within(at.z(), grid.cells.z());
  return at;
}

/// Looked at by blocks: where the middle of one is far from everything, all of it is free.
std::vector<char> FreeRoom::free_cells(const Grid& grid) const {
  constexpr int block = 4;
  std::vector<char> free(static_cast<std::size_t>(grid.cells.cast<std::int64_t>().prod()), 0);
  const double clear = kept_clear_ * grid.radius, depth = vessel_.depth.value_or(0);
  // Of a cut the cells lie in its plane already, across the middle of the vessel.
  const auto in_vessel = [&](Eigen::Vector3d at) {
    if (cut_) at.z() = 0.5 * depth;
    return at;
  };
  for (int k = 0; k < grid.cells.z(); k += block)
    for (int j = 0; j < grid.cells.y(); j += block)
      for (int i = 0; i < grid.cells.x(); i += block) {
        const Eigen::Array3i first(i, j, k), end = (first + block).min(grid.cells);
        const Eigen::Vector3d middle = 0.5 * (first + end).cast<double>().matrix().cwiseProduct(grid.cell);
        const Eigen::Vector3d half = 0.5 * (end - first).cast<double>().matrix().cwiseProduct(grid.cell);
        const bool all_free = obstacles_.distance(in_vessel(middle)) >= clear + half.norm();
        for (int z = k; z < end.z(); ++z)
          for (int y = j; y < end.y(); ++y)
            for (int x = i; x < end.x(); ++x) {
              const Eigen::Array3i at(x, y, z);
              const Eigen::Vector3d centre = in_vessel(grid.centre(at));
              const bool inside = is_in_plan(centre, clear) && centre.y() >= clear && is_between_drawn(centre);
              free[grid.index(at)] = inside && (all_free || obstacles_.distance(centre) >= clear) ? 1 : 0;
            }
      }
  return free;
}

/// `cells`: 1 where free. By runs along x, whose cells lie side by side in memory: of millions of cells, each reached
/// by itself, nearly every look is one at memory that is far away.
void FreeRoom::flood(std::vector<char> cells, Grid& grid) const {
  constexpr char free = 1, reached = 2;
  struct Run {
    int from, to, y, z;  // `to` is past its end
  };
  const Eigen::Array3i count = grid.cells;
  const bool round_z = !cut_ && vessel_.front_and_back == Sides::periodic;
  std::vector<Run> runs;
  const auto reach = [&](int from, int to, int y, int z) {
    if (round_z) z = (z + count.z()) % count.z();
    if (y < 0 || y >= count.y() || z < 0 || z >= count.z()) return;
    char* row = cells.data() + grid.index({0, y, z});
    for (int x = from; x < to; ++x) {
      if (row[x] != free) continue;
      Run run{x, x + 1, y, z};
      while (run.from > 0 && row[run.from - 1] == free) --run.from;
      while (run.to < count.x() && row[run.to] == free) ++run.to;
      std::fill(row + run.from, row + run.to, reached);
      runs.push_back(run);
    }
  };
  for (int k = 0; k < count.z(); ++k) reach(0, count.x(), count.y() - 1, k);
  while (!runs.empty()) {
    const Run run = runs.back();
    runs.pop_back();
    for (const int step : {-1, 1}) {
      reach(run.from, run.to, run.y + step, run.z);
      reach(run.from, run.to, run.y, run.z + step);
    }
    if (vessel_.sides != Sides::periodic) continue;
    if (run.from == 0) reach(count.x() - 1, count.x(), run.y, run.z);
    if (run.to == count.x()) reach(0, 1, run.y, run.z);
  }
  for (char& cell : cells) cell = cell == reached ? 1 : 0;
  grid.reached = std::move(cells);
}

double FreeRoom::cell() const {
  const double in_plane = vessel_.length * top_;
  const double least_cell =
      cut_ ? std::sqrt(in_plane / most_cells_) : portable_math::pow(in_plane * *vessel_.depth / most_cells_, 1.0 / 3);
  return std::max(least_radius_ / cells_in_radius_, least_cell);
}

std::optional<double> FreeRoom::missed_width() const {
  const double radius = cells_in_radius_ * cell();
  return obstacles_.none() || radius <= least_radius_ ? std::nullopt : std::optional(2 * radius);
}

FreeRoom::Grid FreeRoom::made_grid() const {
  const double edge = cell(), depth = cut_ ? 0 : *vessel_.depth;
  Grid grid{
      .cell = Eigen::Vector3d::Constant(edge), .cells = Eigen::Array3i::Ones(), .radius = cells_in_radius_ * edge};
  const Eigen::Array3d room(vessel_.length, top_ + grid.radius, depth);
  grid.cells = (room / edge).ceil().cast<int>().max(1);
  // Along a period just as many cells as fill it.
  for (const int axis : {0, 2})
    if (room[axis] > 0) grid.cell[axis] = room[axis] / grid.cells[axis];
  flood(free_cells(grid), grid);
  return grid;
}

FreeRooms::FreeRooms(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space)
    : vessel_(vessel), space_(space) {
  constexpr double step = 1.25;  // of the half width, within a lot
  for (const SeedLot& lot : lots)
    for (double size = least_size(lot); size <= most_size(lot); size *= step)
      half_widths_.push_back(half_width(lot, size));
  std::ranges::sort(half_widths_);
  rooms_.resize(half_widths_.size());
}

const FreeRoom& FreeRooms::of(double half_width) const {
  constexpr double rounding = 1e-9;
  const auto wider = std::ranges::upper_bound(half_widths_, half_width * (1 + rounding));
  const std::size_t k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, wider - half_widths_.begin() - 1));
  if (!rooms_[k]) rooms_[k].emplace(vessel_, space_, half_widths_[k]);
  return *rooms_[k];
}

}  // namespace vibrosow
