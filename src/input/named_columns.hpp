#pragma once

#include <string>
#include <vector>

#include "input/csv_lines.hpp"

namespace vibrosow {

/// What a column of somebody's table is to be read as.
struct ColumnName {
  std::string column;  // as the header has it: "Menge [g/min]"
  std::string name;    // what it holds: "rate"; empty: the column is left out
};

/// Of "COLUMN=NAME", cut at the last "=". Throws InputError without "=" or without a column.
ColumnName parse_column_name(const std::string& column_is_name);

/// The table with its columns named as `read_measured` knows them. A NAME is rate, caught, mass, remaining, gross,
/// discharged, duration, time or a full key: the header states the unit in brackets at its end, and numbers are
/// converted from it; clock: the time of day, "12:30:01", of which seconds are made since the first row of its run, the
/// rows of the same conditions and repeat; or one of `read_measured`'s own columns, whose name states the unit. Throws
/// InputError for a column that the table has not (with the nearest), a name that is none, and a unit that is missing
/// or of another dimension.
CsvLines with_named_columns(CsvLines csv, const std::vector<ColumnName>& names);

}  // namespace vibrosow
