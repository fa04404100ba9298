#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/repose_band.hpp"

namespace vibrosow {

/// What a user weighed and measured of a crop.
struct NewCrop {
  std::string name;
  double mass = 0;                              // kg, of one seed
  double length = 0, width = 0, thickness = 0;  // m, length >= width >= thickness > 0
  bool thickness_assumed = false;               // taken to be the width
  std::optional<double> bulk_density{};         // kg/m3
  std::optional<double> angle_of_repose{};      // rad
  std::optional<double> moisture{};             // share of the wet mass
};

/// How well these are taken to be measured (standard deviations), where the user says nothing of it.
inline constexpr double assumed_angle_error = 0.02618;  // rad, 1.5 degrees: heaps of one seed differ by that and more
inline constexpr double assumed_packing_error = 0.06;   // share: a volume from three lengths that are good to 2 %

/// What the atlas makes of it.
struct CropEstimate {
  double aspect_ratio = 1;           // length over the geometric mean of width and thickness; 1: taken for a ball
  double aspect_ratio_in_atlas = 1;  // the same, or the largest there
  double seed_density = 0;           // kg/m3, as an ellipsoid
  std::optional<double> packing{};   // bulk density over seed density
  MeasuredBulk used{};               // what the band is from
  Reachable reachable{};
  ReposeBand band{};
  int own_runs = 0;                   // of the crop itself, that refined it
  double fitting_angle = 0;           // rad, at which the material that is taken stands in 3D
  double shell_compression = 0;       // as in the shipped contact models, for a tray of 9 Hz and 1 cm
  std::vector<std::string> doubts{};  // sentences
  bool is_ball() const { return aspect_ratio == 1; }
};

/// Throws InputError "--OPTION: .." for sizes out of order, a seed more than five times as long as thick, a density
/// that no seed has, and an angle that no material of the atlas comes near.
CropEstimate estimate(const NewCrop& crop, const ShippedAtlas& atlas);

}  // namespace vibrosow
