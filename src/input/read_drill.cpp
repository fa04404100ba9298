#include "input/read_drill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

constexpr int most_rows = 1000;

std::vector<int> read_hole_to_row(Table& table, std::size_t holes) {
  std::vector<int> rows;
  for (const double row : table.numbers("hole_to_row", 1, most_rows)) {
    if (row != std::round(row)) table.fail("hole_to_row", fmt::format("{:g} is no row; rows are 1, 2, ..", row));
    rows.push_back(static_cast<int>(row));
  }
  if (rows.size() != holes)
    table.fail("hole_to_row", fmt::format("lists {} row{} for the tray's {} hole{}; expected one each", rows.size(),
                                          rows.size() == 1 ? "" : "s", holes, holes == 1 ? "" : "s"));
  const int last = std::ranges::max(rows);
  for (int row = 1; row < last; ++row)
    if (std::ranges::find(rows, row) == rows.end())
      table.fail("hole_to_row", fmt::format("no hole feeds row {}, of {} rows", row, last));
  return rows;
}

/// Each hole the first of the rows that are its own.
std::vector<int> rows_in_order(std::size_t holes, int rows_per_hole) {
  std::vector<int> rows;
  for (std::size_t hole = 0; hole < holes; ++hole) rows.push_back(static_cast<int>(hole) * rows_per_hole + 1);
  return rows;
}

}  // namespace

Drill read_drill(Table table, std::size_t holes) {
  table.reject_keys_other_than({"row_spacing", "speed", "rows_per_hole", "hole_to_row", "reference_spacing",
                                "multiples_below", "skips_above", "cv_limit"});
  if (holes == 0) table.fail("", "the tray has no hole that could feed a row");
  Drill drill;
  drill.pace.row_spacing = table.required_quantity("row_spacing", Dimension::length, 1e-3, 100);
  drill.pace.speed = table.required_quantity("speed", Dimension::travel_speed, 1e-3, 100);
  const auto rows_per_hole = table.whole_number("rows_per_hole", 1, most_rows);
  const bool listed = table.has("hole_to_row");
  if (rows_per_hole && listed)
    table.fail("rows_per_hole", "contradicts hole_to_row, which gives the one row of each hole; give one of them");
  drill.rows_per_hole = static_cast<int>(rows_per_hole.value_or(1));
  drill.hole_to_row = listed ? read_hole_to_row(table, holes) : rows_in_order(holes, drill.rows_per_hole);
  drill.reference_spacing = table.quantity("reference_spacing", Dimension::length, 1e-4, 100);
  SpacingLimits& limits = drill.limits;
  limits.multiples_below = table.number("multiples_below", 1e-3, 1).value_or(limits.multiples_below);
  limits.skips_above = table.number("skips_above", 1, 100).value_or(limits.skips_above);
  if (limits.skips_above <= limits.multiples_below)
    table.fail("skips_above",
               fmt::format("{:g} is not above multiples_below, {:g}", limits.skips_above, limits.multiples_below));
  drill.cv_limit = table.quantity("cv_limit", Dimension::fraction, 1e-4, 10).value_or(drill.cv_limit);
  return drill;
}

}  // namespace vibrosow
