// Atlases of heaps; what is read is looked up.

#include "calibration/repose_atlas.hpp"
#include "fuzz/try_bytes.hpp"
#include "input/temporary_file.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

void try_bytes(const std::string& bytes) {
  static const TemporaryFolder folder;
  try {
    const std::vector<AtlasPoint> points = read_atlas_points(folder.write("atlas.csv", bytes));
    plane_to_space(ReposeAtlas(points), points);
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
