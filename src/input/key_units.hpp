#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/toml_value.hpp"
#include "units/quantity.hpp"

namespace vibrosow {

/// A value that tables carry for a key: its dimension, and the one unit in which every CSV file states it.
struct ColumnUnit {
  Dimension dimension;
  std::string_view suffix;  // as a column's name ends: "mm_per_s"
  std::string_view unit;    // as a quantity is written: "mm/s"
};

/// The unit of a full key such as "tray.motion.frequency", decided by its last word. None for counts, plain
/// numbers, names and words that no seeder file knows.
std::optional<ColumnUnit> column_unit(std::string_view key);

/// An example of a key's value, "8 km/h" of drill.speed; empty where the dimension's own does, or the key has another.
std::string_view example_at(std::string_view key, Dimension dimension);

/// What a message says is expected of a key: "a speed such as \"8 km/h\"".
std::string expected_at(std::string_view key, Dimension dimension);

/// The column that carries a key: "tray.motion.frequency_Hz", "tray.holes.count".
std::string condition_column(const std::string& key);

/// The key that a column carries, or none when its last word or its unit is not the one `condition_column`
/// gives.
std::optional<std::string> key_of_column(const std::string& column);

/// Every column that a key of the same table could have: for "tray.holes.x", "tray.holes.count",
/// "tray.holes.width_mm", ...
std::vector<std::string> columns_beside(const std::string& column);

/// An SI value in the unit of the key's column; unchanged where the column has no unit.
double to_column_unit(std::string_view key, double value_in_si);

/// A value in the column's unit as a file would have it: 9 of a frequency is 9 Hz; a whole number, a number, true,
/// false or a text where the column has no unit. `number`: what `text` is, if it is one.
TomlValue value_of_column(std::string_view key, std::string_view text, std::optional<double> number);

}  // namespace vibrosow
