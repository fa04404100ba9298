#pragma once

#include <string>
#include <vector>

#include "report/columns.hpp"
#include "result/frame.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// A run's snapshots as extended XYZ, for OVITO: one frame each, in the lab frame and SI, numbers with the digits that
/// read back to the same. The species is the lot's name; the lattice is the box about the vessels at rest, along
/// periodic sides their length.
std::string grains_xyz(const Scene& scene, const std::vector<Frame>& frames);

/// What the file holds.
FileText xyz_file_text();

}  // namespace vibrosow
