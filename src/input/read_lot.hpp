#pragma once

#include <string>

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// One lot of seeds from its table [seeds.NAME]: crop, shape and measures, sizes, mass. Throws InputError on keys that
/// are missing, out of range, contradict each other or go with another shape or distribution. Fractions are not read.
/// In space a clump is one of balls; in the plane a seed's thickness is passed over.
SeedLot read_lot(Table& seeds, const std::string& name, Space space);

}  // namespace vibrosow
