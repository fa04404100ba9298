#include "input/presets.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "files/whole_file.hpp"
#include "input/read_scene.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped(const fs::path& directory) {
  std::vector<std::string> names;
  if (!fs::is_directory(directory)) return names;
  for (const fs::path& file : toml_files(directory)) names.push_back(file.stem().string());
  return names;
}

/// Names of version 0.2 that mean something else now, or the same as another one.
struct Renamed {
  std::string_view kind, name, now, meaning;
};
constexpr Renamed renamed[] = {
    {"crops", "wheat", "wheat",
     "\"wheat\" is the grain, of five balls; in version 0.1 it was a ball, which is \"wheat-ball\" now"},
    {"crops", "wheat-grain", "wheat", "\"wheat-grain\" is called \"wheat\" now"},
    {"crops", "barley-grain", "barley", "\"barley-grain\" is called \"barley\" now"},
};

const Renamed* find_renamed(const std::string& name, const std::string& kind) {
  const auto found =
      std::ranges::find_if(renamed, [&](const Renamed& one) { return one.kind == kind && one.name == name; });
  return found == std::end(renamed) ? nullptr : found;
}

fs::path preset_file(const Table& table, const std::string& key, const std::string& name, const std::string& kind) {
  if (!has_extension(name, ".toml")) {
    if (const auto meaning = changed_meaning(name, kind)) table.files()->note(table.where(key) + ": " + *meaning);
    try {
      return shipped_preset(name, kind);
    } catch (const InputError& error) {
      table.fail(key, error.what());
    }
  }
  return table.directory(key) / name;
}

std::array<double, 2> range_of(const Table& table, const std::string& key, const std::vector<double>& ends) {
  if (ends.size() != 2 || ends[0] > ends[1]) table.fail(key, "is a range: [least, most]");
  return {ends[0], ends[1]};
}

std::optional<std::array<double, 2>> read_range(Table& table, const std::string& key, Dimension dimension, double least,
                                                double most) {
  if (!table.has(key)) return std::nullopt;
  return range_of(table, key, table.quantities(key, dimension, least, most));
}

std::optional<std::array<double, 2>> read_range(Table& table, const std::string& key, double least, double most) {
  if (!table.has(key)) return std::nullopt;
  return range_of(table, key, table.numbers(key, least, most));
}

}  // namespace

std::vector<fs::path> toml_files(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

PresetFile named_preset(Table& table, const std::string& key, const std::string& kind) {
  const std::optional<std::string> name = table.text(key);
  if (!name) return {};
  const fs::path file = preset_file(table, key, *name, kind);
  return {file.stem().string(), file.lexically_normal().string()};
}

Table read_preset(const PresetFile& preset, const Table& table, const std::string& key) {
  if (!table.files()->has(preset.file)) table.fail(key, fmt::format("there is no file {}", preset.file));
  Table read(Document::read(preset.file, {}, table.files()));
  read.skip("title");
  read_reference(read);
  read.skip("sources");
  return read;
}

PresetFile use_preset(Table& table, const std::string& key, const std::string& kind) {
  PresetFile preset = named_preset(table, key, kind);
  if (preset.is_known()) table.set_fallback(read_preset(preset, table, key));
  return preset;
}

std::optional<std::string> changed_meaning(const std::string& name, const std::string& kind) {
  const Renamed* const known = find_renamed(name, kind);
  return known != nullptr ? std::optional(std::string(known->meaning)) : std::nullopt;
}

Reference read_reference(Table& preset) {
  auto table = preset.table("reference");
  if (!table) return {};
  Reference reference;
  reference.true_density = table->quantity("true_density", Dimension::density, 1, 3e4);
  reference.bulk_density = read_range(*table, "bulk_density_range", Dimension::bulk_density, 1, 3e4);
  reference.angle_of_repose = read_range(*table, "angle_of_repose_range", Dimension::angle, 1 * degree, 89 * degree);
  reference.friction = read_range(*table, "friction_range", 1e-3, 10);
  reference.rolling_friction = read_range(*table, "rolling_friction_range", 0, 10);
  const std::vector<std::string> methods{"drained", "piled", "turning drum", "tilted box", "not said"};
  if (const auto method = table->choice("angle_of_repose_method", methods))
    reference.angle_of_repose_method = methods[*method];
  return reference;
}

fs::path shipped_preset(const std::string& name, const std::string& kind) {
  const fs::path directory = data_directory() / "models" / kind;
  const std::vector<std::string> names = shipped(directory);
  if (const Renamed* const known = find_renamed(name, kind)) return directory / (std::string(known->now) + ".toml");
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
