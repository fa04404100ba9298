#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "input/table.hpp"

namespace vibrosow {

/// Lays the preset that `table` names under `key` (if it does) behind the table: a shipped one of
/// models/`kind`/NAME.toml, or a path ending in .toml relative to the file that names it. Throws InputError
/// with the shipped names when there is none.
void use_preset(Table& table, const std::string& key, const std::string& kind);

/// The file models/`kind`/NAME.toml. Throws InputError with the shipped names when there is none.
std::filesystem::path shipped_preset(const std::string& name, const std::string& kind);

/// The files of a folder that end in .toml, by name. Throws std::filesystem::filesystem_error where there is no such
/// folder.
std::vector<std::filesystem::path> toml_files(const std::filesystem::path& directory);

/// The content of a page that reports are made of: NAME of pages/ in the shipped data, or in the source tree of
/// build/web/, where scripts/web makes all of them, or of web/made/, where the one is kept that has no simulator.
std::optional<std::string> shipped_page(const std::string& name);

/// Density of a preset's seeds themselves, kg/m3: reference.true_density. It changes no scene; a crop's mass is checked
/// against it.
std::optional<double> read_true_density(Table& preset);

}  // namespace vibrosow
