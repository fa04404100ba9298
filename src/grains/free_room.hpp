#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <vector>

#include "grains/places.hpp"
#include "scene/scene.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {

/// Where the seeds of a vessel may be put, in its own frame: what is connected with its open top by a way that the
/// seed can go, so nothing beneath a funnel or within a closed box of pieces. The lid of a drum counts as
/// open. Nothing leads out through holes or open sides, and around again. Of a vessel without a box room is only what
/// lies between its drawn walls: not what lies beside them.
class FreeRoom {
 public:
  static constexpr double usual_most_cells = 2e7;

  /// `least_radius` (m): half the least width of a seed (`half_width`). A seed that is asked for is
  /// told by the centre of its thickest disc, which keeps that far from every wall. With fewer cells at most, narrow
  /// ways of larger vessels count as closed (`missed_width`).
  FreeRoom(const Vessel& vessel, Space space, double least_radius, double most_cells = usual_most_cells);

  /// Whether the centre of a seed that touches nothing (m) lies in the room, or above it.
  bool holds(const Eigen::Vector3d& centre) const;

  /// m, of ways that may be taken for closed though seeds pass: where the vessel is too large for cells as small as
  /// they ask for. Otherwise none is.
  std::optional<double> missed_width() const;

  /// Whether it does, below the vessel's top.
  bool holds_below_top(const Eigen::Vector3d& centre) const { return centre.y() <= vessel_.height && holds(centre); }

  /// The part of the vessel's plan, in the plane of its length, that is room at a height (m), up to the walls' very
  /// surfaces: from 0 to 1, by places on a grid.
  double share_at(double height) const;

 private:
  /// A straight part of a drawn wall, m; of one turned about an upright axis that passes at `about` (x, z): its
  /// profile.
  struct Stroke {
    Eigen::Vector2d a, b;
    std::optional<Eigen::Vector2d> about{};
  };
  static std::vector<Stroke> drawn_walls(const Vessel& vessel, Space space);

  /// Cells whose centres a seed can reach from the top; one across where a cut says all.
  struct Grid {
    Eigen::Vector3d cell;  // m
    Eigen::Array3i cells;
    double radius;  // m, of the seed: larger than its own where there would be too many cells
    std::vector<char> reached{};

    std::size_t index(const Eigen::Array3i& at) const {
      return static_cast<std::size_t>(at.x()) +
             static_cast<std::size_t>(cells.x()) *
                 (static_cast<std::size_t>(at.y()) +
                  static_cast<std::size_t>(cells.y()) * static_cast<std::size_t>(at.z()));
    }
    Eigen::Vector3d centre(const Eigen::Array3i& at) const {
      return (at.cast<double>() + 0.5).matrix().cwiseProduct(cell);
    }
  };
  bool is_in_plan(const Eigen::Vector3d& centre, double clear) const;
  std::optional<bool> is_between(const Eigen::Vector3d& centre) const;
  bool is_between_drawn(const Eigen::Vector3d& centre) const;
  Eigen::Vector3d in_cut(const Eigen::Vector3d& centre) const;
  bool holds_beside_walls(const Eigen::Vector3d& place) const;
  bool is_open_above(const Eigen::Vector3d& centre) const;
  bool is_reached(const Eigen::Vector3d& centre) const;
  std::vector<char> free_cells(const Grid& grid) const;
  Eigen::Array3i carried_over(Eigen::Array3i at, const Grid& grid) const;
  void flood(std::vector<char> cells, Grid& grid) const;
  double cell() const;
  Grid made_grid() const;

  Vessel vessel_;
  bool is_3d_;
  bool turned_;          // whether all is turned about the upright axis of a round vessel
  bool cut_;             // whether a cut in the middle of the depth says all: of what is turned so, or drawn out
  int cells_in_radius_;  // of the grid, in the least radius
  double kept_clear_;    // part of a seed's radius that a cell's centre keeps from every wall
  double least_radius_, most_cells_, top_;
  Obstacles obstacles_;
  std::optional<DrumCircle> drum_;
  std::vector<Stroke> drawn_;         // of a vessel without a box that is no drum
  mutable std::optional<Grid> grid_;  // made when it is first asked for
};

/// The free room of a vessel by the width of seeds: where small ones come through a slit, large ones do not. Each is
/// made when it is first asked for.
class FreeRooms {
 public:
  FreeRooms(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space);

  /// Of seeds of this half width (m, `half_width`), or up to a fifth narrower: of the least of the lot, or a step more.
  const FreeRoom& of(double half_width) const;

  /// Where the smallest of all come to.
  const FreeRoom& of_smallest() const { return of(0); }

 private:
  Vessel vessel_;
  Space space_;
  std::vector<double> half_widths_;  // m, rising
  mutable std::deque<std::optional<FreeRoom>> rooms_;
};

}  // namespace vibrosow
