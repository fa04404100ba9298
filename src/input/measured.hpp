#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/csv_lines.hpp"
#include "input/override.hpp"
#include "outflow/statistics.hpp"

namespace vibrosow {

/// What a table of measured outflow states. Values are SI: kg/s, 1/s; curves are cumulative: kg, seeds, a
/// fraction.
enum class MeasuredQuantity { mass_rate, seed_rate, mass_curve, seed_curve, fraction_curve };

bool is_curve(MeasuredQuantity quantity);

/// Column in which results state the quantity: "rate_g_per_s", "seeds_per_s", "mass_g", "seeds",
/// "discharged_percent".
std::string_view column_of(MeasuredQuantity quantity);

/// An SI value in the unit of that column.
double to_column_unit(MeasuredQuantity quantity, double value);

/// One condition of a measurement: a full key and its value in the unit of the key's column.
struct Condition {
  std::string key;               // "tray.motion.frequency"
  std::string text;              // "9": decimal point, shortest form of a number; a name as it was written
  std::optional<double> number;  // 9; none for a name
  bool operator==(const Condition&) const = default;
};

/// The condition as a change to a seeder file: tray.motion.frequency = "9 Hz". `where` is for messages.
Override override_of(const Condition& condition, const std::string& where);

/// Measured outflow of one hole and lot under one set of conditions, repeats averaged.
struct MeasuredSeries {
  std::vector<Condition> conditions;  // in the order of the columns
  std::string hole = "all";           // number from the left, or "all"
  std::string lot = "all";
  std::vector<double> times;             // s, rising, of a curve; empty for a rate
  std::vector<MeanWithInterval> values;  // one for each time; a single one for a rate
  std::vector<int> repeats;              // of each value, over which it is the mean
  std::string where;                     // "FILE:LINE" of its first row
};

struct MeasuredTable {
  MeasuredQuantity quantity = MeasuredQuantity::mass_rate;
  std::vector<std::string> condition_keys;  // in the order of the columns
  std::vector<MeasuredSeries> series;       // in the order of their first rows
};

/// Reads a table of measured outflow. Condition columns are those of `condition_column`; `hole`, `lot`,
/// `repeat` and `note` may follow (`repeat` tells apart the fills of a balance that shows something else than what has
/// left, `note` is for the reader of the file), and exactly one
/// quantity must: caught_g or caught_seeds with duration_s; rate_g_per_s; seeds_per_s; or time_s with mass_g,
/// seeds or discharged_percent; instead of mass_g remaining_g, of a balance under the vessel, or gross_g, of one under
/// what catches that was not tared: what has left is reckoned from their first reading. Rows alike in conditions, hole,
/// lot and time are repeats. Throws InputError "FILE:LINE: COLUMN: ..." for anything else, an unknown column (with the
/// nearest known one), a value that is not a finite number, negative, over 100 % or beyond any seeder, a rate of zero,
/// which has no relative misfit, and a curve that falls or does not begin near nothing.
MeasuredTable read_measured(const CsvLines& csv);

}  // namespace vibrosow
