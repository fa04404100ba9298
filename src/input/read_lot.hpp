#pragma once

#include <optional>
#include <string>

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What is measured of many seeds together.
struct BulkProperties {
  std::optional<double> bulk_density;     // kg/m3, of the poured bed
  std::optional<double> angle_of_repose;  // rad
  std::optional<double> moisture;         // share of the wet mass
};

/// Those of a crop or of one of a seeder's lots. Throws InputError out of range.
BulkProperties read_bulk_properties(Table& seeds);

/// Mass of one seed, kg, from that of a thousand. Throws InputError where the key is missing or out of range.
double read_thousand_grain_weight(Table& seeds);

/// One lot of seeds from its table [seeds.NAME]: crop, shape and measures, sizes, mass. Throws InputError on keys that
/// are missing, out of range, contradict each other or go with another shape or distribution. Fractions are not read.
/// In 3D a clump is one of balls; in 2D a seed's thickness is passed over.
SeedLot read_lot(Table& seeds, const std::string& name, Space space);

}  // namespace vibrosow
