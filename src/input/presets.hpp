#pragma once

#include <string>

#include "input/table.hpp"

namespace vibrosow {

/// Lays the preset that `table` names under `key` (if it does) behind the table: a shipped one of
/// models/`kind`/NAME.toml, or a path ending in .toml relative to the file that names it. Throws InputError
/// with the shipped names when there is none.
void use_preset(Table& table, const std::string& key, const std::string& kind);

}  // namespace vibrosow
