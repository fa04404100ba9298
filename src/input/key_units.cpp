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
constexpr ColumnUnit gram{Dimension::seed_mass, "g", "g"};
constexpr ColumnUnit gram_per_second{Dimension::drag, "g_per_s", "g/s"};
constexpr ColumnUnit millimetre_per_second{Dimension::speed, "mm_per_s", "mm/s"};
constexpr ColumnUnit metre_per_second{Dimension::speed, "m_per_s", "m/s"};
constexpr ColumnUnit kilometre_per_hour{Dimension::travel_speed, "km_per_h", "km/h"};
constexpr ColumnUnit millinewton{Dimension::force, "mN", "mN"};
constexpr ColumnUnit megapascal{Dimension::pressure, "MPa", "MPa"};
constexpr ColumnUnit per_second{Dimension::rate, "per_s", "1/s"};
constexpr ColumnUnit seeds_per_second{Dimension::seed_rate, "per_s", "1/s"};
constexpr ColumnUnit angle_degree{Dimension::angle, "degree", "degree"};
constexpr ColumnUnit density{Dimension::density, "kg_per_m3", "kg/m3"};
constexpr ColumnUnit bulk_density{Dimension::bulk_density, "kg_per_m3", "kg/m3"};
constexpr ColumnUnit percent{Dimension::fraction, "percent", "%"};

struct KeyWord {
  std::string_view word;
  std::optional<ColumnUnit> unit;
  std::string_view example = {};  // of a value, where its dimension's is far from what the key takes
};

/// Last words of the keys of a seeder file that a table may carry. One word means one thing in every table, but where
/// it stands here with its table.
constexpr std::array key_words = {
    // seeds
    KeyWord{"crop", {}},
    KeyWord{"diameter", millimetre},
    KeyWord{"distance", millimetre},
    KeyWord{"distribution", {}},
    KeyWord{"thickness", millimetre},
    KeyWord{"diameters", millimetre},
    KeyWord{"lengths", millimetre},
    KeyWord{"fractions", percent, "20 %"},
    KeyWord{"mass_fractions", percent, "20 %"},
    KeyWord{"deviation", millimetre},
    KeyWord{"least", millimetre},
    KeyWord{"most", millimetre},
    KeyWord{"mass", gram, "45 mg"},
    KeyWord{"thousand_grain_weight", gram, "45 g"},
    KeyWord{"density", density},
    KeyWord{"bulk_density", bulk_density},
    KeyWord{"angle_of_repose", angle_degree, "25 degree"},
    KeyWord{"moisture", percent, "12 %"},
    KeyWord{"shape", {}},
    KeyWord{"mass_fraction", percent, "70 %"},
    KeyWord{"number_fraction", percent},
    // contact
    KeyWord{"model", {}},
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
    KeyWord{"length", millimetre, "40 cm"},
    KeyWord{"height", millimetre, "10 cm"},
    KeyWord{"depth", millimetre, "6 cm"},
    KeyWord{"across", millimetre, "6 mm"},
    KeyWord{"front", millimetre, "2 cm"},
    KeyWord{"rows", {}},
    KeyWord{"plan", {}},
    KeyWord{"front_and_back", {}},
    KeyWord{"space", {}},
    KeyWord{"accuracy", {}},
    KeyWord{"tilt", angle_degree, "2 degree"},
    KeyWord{"funnel", angle_degree, "30 degree"},
    KeyWord{"left", millimetre, "10 cm"},
    KeyWord{"above", millimetre, "8 cm"},
    KeyWord{"count", {}},
    KeyWord{"width", millimetre},
    KeyWord{"span", millimetre, "30 cm"},
    KeyWord{"pitch", millimetre, "5 cm"},
    KeyWord{"centre", millimetre, "20 cm"},
    KeyWord{"at", millimetre, "10 cm"},
    KeyWord{"packing", {}},
    KeyWord{"jitter", {}},
    KeyWord{"keep", {}},
    KeyWord{"kind", {}},
    KeyWord{"direction", angle_degree, "90 degree"},
    KeyWord{"amplitude", millimetre, "5 mm"},
    KeyWord{"frequency", hertz},
    KeyWord{"ramp", second, "1 s"},
    KeyWord{"stop", second, "5 s"},
    KeyWord{"stop_ramp", second, "1 s"},
    KeyWord{"phase", angle_degree, "90 degree"},
    KeyWord{"angle", angle_degree, "3 degree"},
    KeyWord{"pivot", millimetre, "10 cm"},
    KeyWord{"drill.speed", kilometre_per_hour},  // before a motion's speed
    KeyWord{"speed", rpm, "6 rpm"},
    KeyWord{"axis", {}},
    KeyWord{"file", {}},
    KeyWord{"box", {}},
    KeyWord{"sides", {}},
    KeyWord{"open_at", second, "2 s"},
    KeyWord{"chamfer", millimetre, "0.5 mm"},
    KeyWord{"rate", seeds_per_second},
    KeyWord{"from", millimetre, "5 cm"},
    KeyWord{"to", millimetre, "35 cm"},
    KeyWord{"rain.start", second, "1 s"},  // before run.start, which is a name
    // numerics, guard, run and record
    KeyWord{"integrator", {}},
    KeyWord{"steps_per_contact", {}},
    KeyWord{"dt", second, "1e-5 s"},
    KeyWord{"impact_speed", metre_per_second, "0.5 m/s"},
    KeyWord{"allow_long_step", {}},
    KeyWord{"warn_relative_overlap", {}},
    KeyWord{"stop_relative_overlap", {}},
    KeyWord{"energy_tolerance", {}},
    KeyWord{"duration", second, "10 s"},
    KeyWord{"measure_from", second, "2 s"},
    KeyWord{"count_below", millimetre, "20 mm"},
    KeyWord{"end_after_pause", second, "5 s"},
    KeyWord{"start", {}},
    KeyWord{"times", second, "2 s"},
    KeyWord{"every", second, "0.5 s"},
    KeyWord{"cell", millimetre},
    KeyWord{"view", {}},
    // drill
    KeyWord{"row_spacing", millimetre, "15 cm"},
    KeyWord{"rows_per_hole", {}},
    KeyWord{"hole_to_row", {}},
    KeyWord{"reference_spacing", millimetre, "3 cm"},
    KeyWord{"multiples_below", {}},
    KeyWord{"skips_above", {}},
    KeyWord{"cv_limit", percent, "5 %"},
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

std::string expected_at(std::string_view key, Dimension dimension) {
  return expected(dimension, example_at(key, dimension));
}

std::string_view example_at(std::string_view key, Dimension dimension) {
  if (key.starts_with("seeds.") && dimension == Dimension::length) return "4 mm";  // a tray's length is another
  const KeyWord* word = find_word(key);
  return word && word->unit && word->unit->dimension == dimension ? word->example : std::string_view();
}

std::string condition_column(const std::string& key) {
  const auto unit = column_unit(key);
  return unit ? fmt::format("{}_{}", key, unit->suffix) : key;
}

std::optional<std::string> key_of_column(const std::string& column) {
  if (column.find('.') == std::string::npos) return std::nullopt;
  for (const KeyWord& word : key_words) {
    std::string key = column.substr(0, column.rfind('.') + 1) + std::string(word.word);
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
