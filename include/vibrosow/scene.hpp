#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vibrosow {
struct Scene;
}

namespace vibrosow::api {

/// A seeder, its seeds, its motion and what is to be run: a value that never changes, cheap to copy.
class Scene {
 public:
  /// Reads a seeder file. `changes` are laid over it, each "KEY=VALUE" as after `vibrosow run --set`:
  /// "tray.motion.frequency=12 Hz". Throws std::runtime_error with file, line and key for anything wrong.
  static Scene read(const std::filesystem::path& file, const std::vector<std::string>& changes = {});

  /// The same of the text of a seeder file that is nowhere: "space = \"3d\"\n[tray]\n..". Files that it names are
  /// looked for from the working directory; messages call it "scene.toml".
  static Scene from_toml(std::string_view text, const std::vector<std::string>& changes = {});

  /// From what `json` gave. Throws std::runtime_error with the path of the first thing that is wrong.
  static Scene from_json(std::string_view json);

  /// The whole scene as one line of JSON, in SI; the same text for equal scenes.
  std::string json() const;

  std::string title() const;
  double duration() const;  // s
  int holes() const;        // of the tray

  explicit Scene(std::shared_ptr<const vibrosow::Scene> scene) : scene_(std::move(scene)) {}
  const vibrosow::Scene& value() const { return *scene_; }

 private:
  std::shared_ptr<const vibrosow::Scene> scene_;
};

}  // namespace vibrosow::api
