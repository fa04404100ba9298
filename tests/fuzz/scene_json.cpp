// Scenes as JSON: what is read is written, read and written again as the same text.

#include <cstdlib>

#include "fuzz/try_bytes.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {

void try_bytes(const std::string& bytes) {
  try {
    const std::string json = scene_to_json(scene_of_any_numbers(bytes));
    if (scene_to_json(scene_of_any_numbers(json)) != json) std::abort();
    scene_from_json(json);
  } catch (const InputError&) {
  }
}

}  // namespace vibrosow
