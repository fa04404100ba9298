#include "input/named_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include "input/key_units.hpp"
#include "input/wording.hpp"
#include "scene/input_error.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

/// A name without a unit, what it may measure, and the column that states it.
struct Quantities {
  std::string_view name;
  Dimension dimension;
  std::string_view unit;
  std::string_view column;
};

constexpr std::array quantities = {
    Quantities{"rate", Dimension::mass_rate, "g/s", "rate_g_per_s"},
    Quantities{"rate", Dimension::seed_rate, "1/s", "seeds_per_s"},
    Quantities{"caught", Dimension::mass, "g", "caught_g"},
    Quantities{"mass", Dimension::mass, "g", "mass_g"},
    Quantities{"remaining", Dimension::mass, "g", "remaining_g"},
    Quantities{"gross", Dimension::mass, "g", "gross_g"},
    Quantities{"discharged", Dimension::fraction, "%", "discharged_percent"},
    Quantities{"duration", Dimension::time, "s", "duration_s"},
    Quantities{"time", Dimension::time, "s", "time_s"},
};

/// How a column is read: its new name, and what its numbers are multiplied by.
struct Reading {
  std::string column;
  double factor = 1;
};

/// What stands in brackets at the end of a header; empty without.
std::string unit_in(const std::string& header) {
  if (header.empty() || (header.back() != ']' && header.back() != ')')) return "";
  const auto open = header.rfind(header.back() == ']' ? '[' : '(');
  return open == std::string::npos ? "" : header.substr(open + 1, header.size() - open - 2);
}

std::optional<double> factor_of(const std::string& unit, Dimension dimension, std::string_view wanted) {
  try {
    return unit_size(unit, dimension) / unit_size(wanted, dimension);
  } catch (const UnitError&) {
    return std::nullopt;
  }
}

Reading reading_of(const ColumnName& name, const std::string& where) {
  const std::string unit = unit_in(name.column);
  std::string wanted;
  for (const Quantities& quantity : quantities) {
    if (quantity.name != name.name) continue;
    if (const auto factor = factor_of(unit, quantity.dimension, quantity.unit))
      return {std::string(quantity.column), *factor};
    wanted += fmt::format("{}{}", wanted.empty() ? "" : " or ", expected(quantity.dimension));
  }
  if (const auto key_unit = column_unit(name.name)) {
    if (const auto factor = factor_of(unit, key_unit->dimension, key_unit->unit))
      return {condition_column(name.name), *factor};
    wanted = expected_at(name.name, key_unit->dimension);
  }
  if (wanted.empty()) return {name.name};  // a column of `read_measured`, or one that it refuses
  throw InputError(fmt::format("{}: {}: {}; expected {}, with its unit in brackets at the end of the header", where,
                               name.column, unit.empty() ? "states no unit" : fmt::format("is in \"{}\"", unit),
                               wanted));
}

void convert(CsvLines& csv, std::size_t column, double factor) {
  if (factor == 1) return;
  for (CsvLines::Row& row : csv.rows) {
    const auto number = csv_number(row.fields[column], csv.decimal_comma);
    if (!number) continue;  // `read_measured` tells it as it stands
    std::string text = fmt::format("{}", *number * factor);
    if (csv.decimal_comma) std::ranges::replace(text, '.', ',');
    row.fields[column] = std::move(text);
  }
}

/// Seconds of "12:30:01" or "12:30:01.5".
std::optional<double> seconds_of(const std::string& clock, bool decimal_comma) {
  const auto hours_end = clock.find(':'), minutes_end = clock.find(':', hours_end + 1);
  if (hours_end == std::string::npos || minutes_end == std::string::npos) return std::nullopt;
  const auto part = [&](std::size_t from, std::size_t to, double below) -> std::optional<double> {
    const auto number = csv_number(clock.substr(from, to - from), decimal_comma);
    return number && *number >= 0 && *number < below ? number : std::nullopt;
  };
  const auto hours = part(0, hours_end, 24), minutes = part(hours_end + 1, minutes_end, 60),
             seconds = part(minutes_end + 1, clock.size(), 60);
  if (!hours || !minutes || !seconds) return std::nullopt;
  return 3600 * *hours + 60 * *minutes + *seconds;
}

/// What tells a run of the table from its others.
std::vector<std::size_t> columns_of_run(const CsvLines& csv) {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < csv.header.fields.size(); ++i)
    if (csv.header.fields[i] == "repeat" || key_of_column(csv.header.fields[i])) columns.push_back(i);
  return columns;
}

/// Seconds since the first row of a run; past midnight they go on.
class RunClock {
 public:
  double operator()(double time_of_day) {
    constexpr double day = 86400;
    if (before_ && time_of_day < *before_) days_ += day;
    before_ = time_of_day;
    if (!first_) first_ = time_of_day;
    return time_of_day + days_ - *first_;
  }

 private:
  std::optional<double> first_, before_;
  double days_ = 0;
};

/// Of a table whose other columns are named.
void read_clock(CsvLines& csv, std::size_t column) {
  const std::vector<std::size_t> of_run = columns_of_run(csv);
  std::map<std::vector<std::string>, RunClock> clocks;
  for (CsvLines::Row& row : csv.rows) {
    const auto time_of_day = seconds_of(row.fields[column], csv.decimal_comma);
    if (!time_of_day)
      throw InputError(fmt::format("{}:{}: {}: \"{}\" is no time of day such as 12:30:01", csv.file, row.line,
                                   csv.header.fields[column], shortened(row.fields[column])));
    std::vector<std::string> run;
    for (const std::size_t i : of_run) run.push_back(row.fields[i]);
    std::string text = fmt::format("{}", clocks[std::move(run)](*time_of_day));
    if (csv.decimal_comma) std::ranges::replace(text, '.', ',');
    row.fields[column] = std::move(text);
  }
  csv.header.fields[column] = "time_s";
}

void remove(CsvLines& csv, std::size_t column) {
  const auto at = static_cast<std::ptrdiff_t>(column);
  csv.header.fields.erase(csv.header.fields.begin() + at);
  for (CsvLines::Row& row : csv.rows) row.fields.erase(row.fields.begin() + at);
}

std::size_t column_at(const CsvLines& csv, const std::string& name, const std::string& where) {
  const auto found = std::ranges::find(csv.header.fields, name);
  if (found == csv.header.fields.end())
    throw InputError(
        fmt::format("{}: {}: there is no such column{}", where, name, did_you_mean(name, csv.header.fields)));
  return static_cast<std::size_t>(found - csv.header.fields.begin());
}

}  // namespace

ColumnName parse_column_name(const std::string& column_is_name) {
  const auto equals = column_is_name.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(
        fmt::format("--column {}: expected COLUMN=NAME such as \"Menge [g/min]=rate\"", shortened(column_is_name)));
  return {column_is_name.substr(0, equals), column_is_name.substr(equals + 1)};
}

CsvLines with_named_columns(CsvLines csv, const std::vector<ColumnName>& names) {
  const std::string where = fmt::format("{}:{}", csv.file, csv.header.line);
  std::vector<std::string> clocks;
  for (const ColumnName& name : names) {
    const std::size_t column = column_at(csv, name.column, where);
    if (name.name.empty()) {
      remove(csv, column);
    } else if (name.name == "clock") {
      clocks.push_back(name.column);
    } else {
      Reading reading = reading_of(name, where);
      convert(csv, column, reading.factor);
      csv.header.fields[column] = std::move(reading.column);
    }
  }
  for (const std::string& clock : clocks) read_clock(csv, column_at(csv, clock, where));
  return csv;
}

}  // namespace vibrosow
