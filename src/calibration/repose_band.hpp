#pragma once

#include <optional>
#include <vector>

#include "calibration/repose_atlas.hpp"

namespace vibrosow {

/// What was measured of a heap and a poured bed, with how well (standard deviations).
struct MeasuredBulk {
  std::optional<double> angle;    // rad, drained angle of repose
  double angle_error = 0;         // rad
  std::optional<double> packing;  // packing fraction of the poured bed
  double packing_error = 0;
};

/// What is known of one parameter.
struct ParameterBand {
  double mean, low, high;  // 95 % between low and high
  double contraction;      // 1 - deviation / the prior's: 0 where nothing was learnt, 1 where all is known
};

/// Friction and rolling friction of a material.
struct Rubbing {
  double friction, rolling_friction;
};

struct ReposeBand {
  ParameterBand friction, rolling_friction;
  double correlation;  // between the two
  Rubbing fitting{};   // of the materials that stand and lie as measured, the nearest to both means
};

/// Of a material of that aspect ratio in 3D, over all of the atlas: what could have been measured.
struct Reachable {
  double least_angle, most_angle;  // rad
  double least_packing, most_packing;
};
Reachable reachable(const ShippedAtlas& atlas, double aspect_ratio);

/// How far the atlas' figures are from a material's in 3D (standard deviations): from the plane to space, with
/// few materials compared, sd sqrt(1 + 1/n).
double angle_error_3d(const PlaneToSpace& to_space);    // rad
double packing_error_3d(const PlaneToSpace& to_space);  // share of the packing fraction

/// Friction and rolling friction from bulk measurements: posterior over a fine grid of the atlas' range, with a uniform
/// prior and normal errors: of the measurement, of the atlas' mean over random seeds, and from the plane to space.
/// Nothing measured gives the prior back. Throws std::out_of_range for an aspect ratio outside the atlas.
ReposeBand repose_band(const ShippedAtlas& atlas, double aspect_ratio, const MeasuredBulk& measured);

/// So many materials spread evenly over what the measurements leave open: Hammersley's points, carried to the posterior
/// by its quantiles (Rosenblatt 1952). Throws as `repose_band`.
std::vector<Rubbing> materials_of_band(const ShippedAtlas& atlas, double aspect_ratio, const MeasuredBulk& measured,
                                       int count);

}  // namespace vibrosow
