// Seeder files: what is read is prepared too, and is the same scene after a way through JSON.

#include <cstdlib>

#include "fuzz/try_bytes.hpp"
#include "input/read_scene.hpp"
#include "input/temporary_file.hpp"
#include "plan/model.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {

void try_bytes(const std::string& bytes) {
  static const TemporaryFolder folder;
  static const auto motion = folder.write("motion.csv", "time_s,y_mm\n0,0\n0.1,1\n0.2,0\n0.3,-1\n0.4,0\n");
  try {
    const Scene scene = read_scene(folder.write("seeder.toml", bytes));
    const std::string json = scene_to_json(scene);
    if (scene_to_json(scene_from_json(json)) != json) std::abort();
    prepare(scene);
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
