#pragma once

#include <string>

#include "calibration/new_crop.hpp"

namespace vibrosow {

/// A crop as a file of models/crops is, each value with where it comes from.
std::string crop_toml(const NewCrop& crop, const CropEstimate& estimate);

/// The contact model that goes with it, likewise.
std::string contact_toml(const NewCrop& crop, const CropEstimate& estimate);

/// What was learnt and what was not, for a terminal.
std::string crop_table(const NewCrop& crop, const CropEstimate& estimate, const ShippedAtlas& atlas);

}  // namespace vibrosow
