#include "vibrosow/scene.hpp"

#include <map>

#include "input/read_scene.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow::api {
namespace {

std::vector<Override> overrides_of(const std::vector<std::string>& changes) {
  std::vector<Override> overrides;
  for (const std::string& change : changes) overrides.push_back(parse_override(change));
  return overrides;
}

}  // namespace

Scene Scene::read(const std::filesystem::path& file, const std::vector<std::string>& changes) {
  return Scene(std::make_shared<const vibrosow::Scene>(read_scene(file, overrides_of(changes))));
}

Scene Scene::from_toml(std::string_view text, const std::vector<std::string>& changes) {
  const std::filesystem::path file = "scene.toml";
  const auto files = std::make_shared<SourceFiles>(std::map<std::string, std::string>{
      {std::filesystem::absolute(file).lexically_normal().string(), std::string(text)}});
  return Scene(std::make_shared<const vibrosow::Scene>(read_scene(file, overrides_of(changes), files)));
}

Scene Scene::from_json(std::string_view json) {
  return Scene(std::make_shared<const vibrosow::Scene>(scene_from_json(json)));
}

std::string Scene::json() const {
  return scene_to_json(*scene_);
}
std::string Scene::title() const {
  return scene_->title;
}
double Scene::duration() const {
  return scene_->run.duration;
}
int Scene::holes() const {
  return static_cast<int>(scene_->tray.holes.size());
}

}  // namespace vibrosow::api
