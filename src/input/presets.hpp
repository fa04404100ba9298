#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "input/table.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// The preset that `table` names under `key`, empty where it does not: a shipped one of models/`kind`/NAME.toml, or a
/// path ending in .toml relative to the file that names it, which need not be there. What a name means now, if that has
/// changed, is noted in the table's files. Throws InputError with the shipped names for another name.
PresetFile named_preset(Table& table, const std::string& key, const std::string& kind);

/// The keys of a preset that `table` names under `key`. Throws InputError where it is not there or wrong.
Table read_preset(const PresetFile& preset, const Table& table, const std::string& key);

/// Lays the preset that `table` names under `key` (if it does) behind the table.
PresetFile use_preset(Table& table, const std::string& key, const std::string& kind);

/// What a preset's name means since version 0.3, where it meant something else before.
std::optional<std::string> changed_meaning(const std::string& name, const std::string& kind);

/// The file models/`kind`/NAME.toml. Throws InputError with the shipped names when there is none.
std::filesystem::path shipped_preset(const std::string& name, const std::string& kind);

/// The files of a folder that end in .toml, by name. Throws std::filesystem::filesystem_error where there is no such
/// folder.
std::vector<std::filesystem::path> toml_files(const std::filesystem::path& directory);

/// The content of a page that reports are made of: NAME of pages/ in the shipped data, or in the source tree of
/// build/web/, where scripts/web makes all of them, or of web/made/, where the one is kept that has no simulator.
std::optional<std::string> shipped_page(const std::string& name);

/// What is known of a preset's seeds that changes no scene, its table [reference]: a crop is tried against it.
struct Reference {
  std::optional<double> true_density;                    // kg/m3, of the seeds themselves
  std::optional<std::array<double, 2>> bulk_density;     // kg/m3, least and most over sources
  std::optional<std::array<double, 2>> angle_of_repose;  // rad, the same
  std::optional<std::string> angle_of_repose_method;     // how the preset's own angle was measured, "not said" too
  std::optional<std::array<double, 2>> friction, rolling_friction;  // of a contact model, between seeds: 95 %
};

/// Throws InputError out of range, where a range is not of two values in order, and for a method without a name here.
Reference read_reference(Table& preset);

}  // namespace vibrosow
