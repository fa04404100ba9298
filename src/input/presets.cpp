#include "input/presets.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "files/whole_file.hpp"
#include "input/read_scene.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped(const fs::path& directory) {
  std::vector<std::string> names;
  if (!fs::is_directory(directory)) return names;
  for (const fs::path& file : toml_files(directory)) names.push_back(file.stem().string());
  return names;
}

fs::path preset_file(const Table& table, const std::string& key, const std::string& name, const std::string& kind) {
  if (!name.ends_with(".toml")) {
    try {
      return shipped_preset(name, kind);
    } catch (const InputError& error) {
      table.fail(key, error.what());
    }
  }
  fs::path file = table.directory(key) / name;
  if (!table.files()->has(file)) table.fail(key, fmt::format("there is no file {}", file.string()));
  return file;
}

}  // namespace

std::vector<fs::path> toml_files(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

void use_preset(Table& table, const std::string& key, const std::string& kind) {
  const std::optional<std::string> name = table.text(key);
  if (!name) return;
  Table preset(Document::read(preset_file(table, key, *name, kind), {}, table.files()));
  preset.skip("title");
  read_true_density(preset);
  preset.skip("sources");
  table.set_fallback(preset);
}

std::optional<double> read_true_density(Table& preset) {
  auto reference = preset.table("reference");
  return reference ? reference->quantity("true_density", Dimension::density, 1, 3e4) : std::nullopt;
}

fs::path shipped_preset(const std::string& name, const std::string& kind) {
  const fs::path directory = data_directory() / "models" / kind;
  const std::vector<std::string> names = shipped(directory);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError(fmt::format("\"{}\" is not shipped; there are {}, or give a path ending in .toml{}", name,
                                 fmt::join(names, ", "), did_you_mean(name, names)));
  }
  return directory / (name + ".toml");
}

std::optional<std::string> shipped_page(const std::string& name) {
  const fs::path data = data_directory();
  for (const fs::path& folder : {data / "pages", data / "build/web", data / "web/made"}) {
    if (std::optional<std::string> text = text_of_file(folder / name)) return text;
  }
  return std::nullopt;
}

fs::path data_directory() {
  const auto holds_models = [](const fs::path& directory) { return fs::is_directory(directory / "models"); };
  if (const char* given = std::getenv("VIBROSOW_DATA")) {
    if (!holds_models(given)) throw InputError(fmt::format("VIBROSOW_DATA={}: holds no folder \"models\"", given));
    return given;
  }
  std::error_code no_proc;
  const fs::path program = fs::read_symlink("/proc/self/exe", no_proc);
  fs::path installed = program.parent_path().parent_path() / "share" / "vibrosow";
  if (!no_proc && holds_models(installed)) return installed;
  for (const char* directory : {VIBROSOW_SOURCE_DIR, VIBROSOW_INSTALLED_DATA})  // the second: of other programs
    if (holds_models(directory)) return directory;
  throw InputError(fmt::format(
      "the shipped models are neither in {} nor in {} nor in {}; set VIBROSOW_DATA to the folder that holds "
      "\"models\"",
      installed.string(), VIBROSOW_SOURCE_DIR, VIBROSOW_INSTALLED_DATA));
}

}  // namespace vibrosow
