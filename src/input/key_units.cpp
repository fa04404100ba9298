#include "input/key_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace vibrosow {
namespace {

constexpr ColumnUnit millimetre{Dimension::length, "mm", "mm"};
constexpr ColumnUnit second{Dimension::time, "s", "s"};
constexpr ColumnUnit hertz{Dimension::frequency, "Hz", "Hz"};
constexpr ColumnUnit rpm{Dimension::frequency, "rpm", "rpm"};
constexpr ColumnUnit gram{Dimension::mass, "g", "g"};
constexpr ColumnUnit gram_per_second{Dimension::mass_rate, "g_per_s", "g/s"};
constexpr ColumnUnit millimetre_per_second{Dimension::speed, "mm_per_s", "mm/s"};
constexpr ColumnUnit metre_per_second{Dimension::speed, "m_per_s", "m/s"};
constexpr ColumnUnit kilometre_per_hour{Dimension::speed, "km_per_h", "km/h"};
constexpr ColumnUnit millinewton{Dimension::force, "mN", "mN"};
constexpr ColumnUnit megapascal{Dimension::pressure, "MPa", "MPa"};
constexpr ColumnUnit per_second{Dimension::rate, "per_s", "1/s"};
constexpr ColumnUnit degree{Dimension::angle, "degree", "degree"};
constexpr ColumnUnit density{Dimension::density, "kg_per_m3", "kg/m3"};
constexpr ColumnUnit percent{Dimension::fraction, "percent", "%"};

struct KeyWord {
  std::string_view word;
  std::optional<ColumnUnit> unit;
};

/// Last words of the keys of a seeder file that a table may carry. One word means one thing in every table, but where
/// it stands here with its table.
constexpr std::array key_words = {
    // seeds
    KeyWord{"crop", {}},
    KeyWord{"diameter", millimetre},
    KeyWord{"distance", millimetre},
    KeyWord{"distribution", {}},
    KeyWord{"deviation", millimetre},
    KeyWord{"least", millimetre},
    KeyWord{"most", millimetre},
    KeyWord{"mass", gram},
    KeyWord{"thousand_grain_weight", gram},
    KeyWord{"density", density},
    KeyWord{"bulk_density", density},
    KeyWord{"angle_of_repose", degree},
    KeyWord{"moisture", percent},
    KeyWord{"shape", {}},
    KeyWord{"mass_fraction", percent},
    KeyWord{"number_fraction", percent},
    // contact
    KeyWord{"law", {}},
    KeyWord{"shell_compression", {}},
    KeyWord{"friction", {}},
    KeyWord{"restitution", {}},
    KeyWord{"slip_speed", millimetre_per_second},
    KeyWord{"drag", gram_per_second},
    KeyWord{"rotation", {}},
    KeyWord{"friction_arm", {}},
    KeyWord{"youngs_modulus", megapascal},
    KeyWord{"poisson_ratio", {}},
    KeyWord{"damping_rate", per_second},
    KeyWord{"cohesion", millinewton},
    KeyWord{"friction_model", {}},
    KeyWord{"tangential_ratio", {}},
    KeyWord{"tangential_damping", {}},
    KeyWord{"rolling", {}},
    KeyWord{"rolling_friction", {}},
    KeyWord{"twisting_friction", {}},
    KeyWord{"rolling_damping", {}},
    // vessels and their holes, fill and motion
    KeyWord{"length", millimetre},
    KeyWord{"height", millimetre},
    KeyWord{"depth", millimetre},
    KeyWord{"across", millimetre},
    KeyWord{"front", millimetre},
    KeyWord{"rows", {}},
    KeyWord{"plan", {}},
    KeyWord{"front_and_back", {}},
    KeyWord{"space", {}},
    KeyWord{"accuracy", {}},
    KeyWord{"tilt", degree},
    KeyWord{"funnel", degree},
    KeyWord{"left", millimetre},
    KeyWord{"above", millimetre},
    KeyWord{"count", {}},
    KeyWord{"width", millimetre},
    KeyWord{"span", millimetre},
    KeyWord{"pitch", millimetre},
    KeyWord{"centre", millimetre},
    KeyWord{"at", millimetre},
    KeyWord{"packing", {}},
    KeyWord{"jitter", {}},
    KeyWord{"keep", {}},
    KeyWord{"kind", {}},
    KeyWord{"direction", degree},
    KeyWord{"amplitude", millimetre},
    KeyWord{"frequency", hertz},
    KeyWord{"ramp", second},
    KeyWord{"stop", second},
    KeyWord{"stop_ramp", second},
    KeyWord{"phase", degree},
    KeyWord{"angle", degree},
    KeyWord{"drill.speed", kilometre_per_hour},  // before a motion's speed
    KeyWord{"speed", rpm},
    KeyWord{"axis", {}},
    KeyWord{"file", {}},
    KeyWord{"box", {}},
    KeyWord{"sides", {}},
    KeyWord{"open_at", second},
    KeyWord{"rate", per_second},
    KeyWord{"from", millimetre},
    KeyWord{"to", millimetre},
    KeyWord{"rain.start", second},  // before run.start, which is a name
    // numerics, guard, run and record
    KeyWord{"integrator", {}},
    KeyWord{"steps_per_contact", {}},
    KeyWord{"dt", second},
    KeyWord{"impact_speed", metre_per_second},
    KeyWord{"allow_long_step", {}},
    KeyWord{"warn_relative_overlap", {}},
    KeyWord{"stop_relative_overlap", {}},
    KeyWord{"energy_tolerance", {}},
    KeyWord{"duration", second},
    KeyWord{"measure_from", second},
    KeyWord{"count_below", millimetre},
    KeyWord{"end_after_pause", second},
    KeyWord{"start", {}},
    KeyWord{"times", second},
    KeyWord{"every", second},
    KeyWord{"cell", millimetre},
    // drill
    KeyWord{"row_spacing", millimetre},
    KeyWord{"rows_per_hole", {}},
    KeyWord{"hole_to_row", {}},
    KeyWord{"reference_spacing", millimetre},
    KeyWord{"multiples_below", {}},
    KeyWord{"skips_above", {}},
    KeyWord{"cv_limit", percent},
};

const KeyWord* find_word(std::string_view key) {
  const auto ends_key = [key](const KeyWord& word) {
    return key == word.word || (key.ends_with(word.word) && key[key.size() - word.word.size() - 1] == '.');
  };
  const auto found = std::ranges::find_if(key_words, ends_key);
  return found == key_words.end() ? nullptr : &*found;
}

}  // namespace

std::optional<ColumnUnit> column_unit(std::string_view key) {
  const KeyWord* word = find_word(key);
  return word ? word->unit : std::nullopt;
}

std::string condition_column(const std::string& key) {
  const auto unit = column_unit(key);
  return unit ? fmt::format("{}_{}", key, unit->suffix) : key;
}

std::optional<std::string> key_of_column(const std::string& column) {
  if (column.find('.') == std::string::npos) return std::nullopt;
  for (const KeyWord& word : key_words) {
    const std::string key = column.substr(0, column.rfind('.') + 1) + std::string(word.word);
    if (condition_column(key) == column) return key;
  }
  return std::nullopt;
}

std::vector<std::string> columns_beside(const std::string& column) {
  std::vector<std::string> columns;
  for (const KeyWord& word : key_words)
    if (word.word.find('.') == std::string_view::npos)
      columns.push_back(condition_column(column.substr(0, column.rfind('.') + 1) + std::string(word.word)));
  return columns;
}

double to_column_unit(std::string_view key, double value_in_si) {
  const auto unit = column_unit(key);
  return unit ? value_in_si / unit_size(unit->unit, unit->dimension) : value_in_si;
}

TomlValue value_of_column(std::string_view key, std::string_view text, std::optional<double> number) {
  if (!number && (text == "true" || text == "false")) return {text == "true"};
  if (!number) return {std::string(text)};
  if (const auto unit = column_unit(key)) return {Quantity{*number, std::string(unit->unit)}};
  constexpr double exact = 9007199254740992;  // 2^53: up to here a whole double is one whole number
  const bool whole = std::round(*number) == *number && std::abs(*number) <= exact;
  return whole ? TomlValue{static_cast<std::int64_t>(*number)} : TomlValue{*number};
}

}  // namespace vibrosow
