#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/repose_metrics.hpp"

namespace vibrosow {

/// A figure over random seeds: mean and standard deviation.
struct MeanAndScatter {
  double mean = 0, scatter = 0;
};

/// What was simulated of one material.
struct AtlasPoint {
  double aspect_ratio = 1, friction = 0, rolling_friction = 0;
  int runs = 0;              // that drained
  int clogged = 0;           // runs whose slot clogged: in no figure but the packing fraction
  MeanAndScatter angle;      // rad
  MeanAndScatter packing;    // packing fraction
  MeanAndScatter discharge;  // C of `repose_figures`
};

/// A material's figures, interpolated: means and their standard errors.
struct AtlasMetric {
  double mean, error;
};
struct AtlasMetrics {
  AtlasMetric angle;  // rad
  AtlasMetric packing, discharge;
};

/// Drained angle of repose, packing fraction and free discharge over a grid of aspect ratio, friction and rolling
/// friction, linear in each between the points.
class ReposeAtlas {
 public:
  /// Throws InputError, naming the point, where the grid has gaps or a point less than two runs that drained.
  explicit ReposeAtlas(const std::vector<AtlasPoint>& points);

  /// Throws std::out_of_range outside the grid.
  AtlasMetrics at(double aspect_ratio, double friction, double rolling_friction) const;

  const std::vector<double>& aspect_ratios() const { return aspect_ratios_; }  // ascending, as the two below
  const std::vector<double>& frictions() const { return frictions_; }
  const std::vector<double>& rolling_frictions() const { return rolling_frictions_; }
  const std::vector<AtlasPoint>& points() const { return points_; }
  int runs() const;  // of all points, those that clogged too

 private:
  std::vector<double> aspect_ratios_, frictions_, rolling_frictions_;
  std::vector<AtlasPoint> points_;  // rolling friction fastest, then friction
};

/// The point of a scene from its runs' figures, at least one.
AtlasPoint atlas_point(const Scene& scene, const std::vector<ReposeMetrics>& runs);

/// Points as a CSV file, and back. Reading throws InputError "FILE:LINE: .." for a missing column or a field that is
/// not a number.
std::string atlas_csv(const std::vector<AtlasPoint>& points);
std::vector<AtlasPoint> read_atlas_points(const std::filesystem::path& file);

/// What to add to the plane's angle, and by what to multiply its packing fraction and discharge, to have those of balls
/// in 3D; each with its scatter over the materials that were run in both.
struct PlaneToSpace {
  MeanAndScatter angle_offset;  // rad
  MeanAndScatter packing_factor, discharge_factor;
  int materials = 0;
  bool of_the_crop = false;  // found with a crop's own shape around its own band, not with balls all over the atlas
};

/// From points in 3D, each at friction and rolling friction within the atlas, at least three. Throws InputError for
/// fewer.
PlaneToSpace plane_to_space(const ReposeAtlas& plane, const std::vector<AtlasPoint>& space);

/// The shipped atlas, models/atlas/atlas.csv, and plane_to_space of it and models/atlas/space.csv.
struct ShippedAtlas {
  ReposeAtlas atlas;
  PlaneToSpace to_space;
};
ShippedAtlas shipped_atlas();

}  // namespace vibrosow
