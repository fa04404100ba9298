// Prints the JSON of a seeder's scene: scene_json FILE [KEY=VALUE...]
#include <cstdio>
#include <exception>
#include <vector>

#include "input/read_scene.hpp"
#include "scene/scene_json.hpp"

int main(int count, char** arguments) try {
  using namespace vibrosow;
  if (count < 2) return 2;
  std::vector<Override> overrides;
  for (int k = 2; k < count; ++k) overrides.push_back(parse_override(arguments[k]));
  std::puts(scene_to_json(read_scene(arguments[1], overrides)).c_str());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "scene_json: %s\n", error.what());
  return 1;
}
