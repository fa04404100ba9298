#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outflow/metrics.hpp"
#include "outflow/statistics.hpp"
#include "outflow/unevenness.hpp"
#include "report/csv.hpp"

namespace vibrosow {

/// What a reader is told of a column.
struct ColumnText {
  std::string name;         // with its unit
  std::string unit;         // empty for names, counts and plain numbers
  std::string description;  // a clause without a full stop
};

/// A column of a table whose rows are made of `Row`s: header, documentation and content in one place.
template <class Row>
struct Column {
  ColumnText text;
  std::function<CsvField(const Row&)> field;
};

template <class Row>
using Columns = std::vector<Column<Row>>;

/// A unit in which columns state quantities, and its size in SI.
struct Unit {
  std::string_view name;
  double size;
};
inline constexpr Unit plain{"", 1}, seconds{"s", 1}, grams{"g", 1e-3}, grams_per_second{"g/s", 1e-3},
    millimetres{"mm", 1e-3}, metres_per_second{"m/s", 1}, millimetres_per_second{"mm/s", 1e-3}, per_second{"1/s", 1},
    radians{"rad", 1}, radians_per_second{"rad/s", 1}, megapascals{"MPa", 1e6}, percent{"%", 1e-2};

/// An SI value in `unit`, as every CSV file has it; empty where there is none.
inline CsvField in_unit(const std::optional<double>& value, Unit unit) {
  return value ? csv_number(*value / unit.size) : CsvField();
}

/// A text or a count: `get` gives a string or a whole number.
template <class Row, class Get>
Column<Row> text_column(std::string name, std::string description, Get get) {
  return {{std::move(name), "", std::move(description)}, [get](const Row& row) { return csv_field(get(row)); }};
}

/// A quantity: `get` gives SI, as a double or an optional one.
template <class Row, class Get>
Column<Row> quantity_column(std::string name, Unit unit, std::string description, Get get) {
  return {{std::move(name), std::string(unit.name), std::move(description)},
          [get = std::move(get), unit](const Row& row) { return in_unit(get(row), unit); }};
}

/// How uneven holes are, chance taken out, with its 95 % interval. `get` gives an optional Unevenness.
template <class Row, class Get>
void add_unevenness_columns(Columns<Row>& columns, const std::string& whose, Get get) {
  const auto add = [&](const char* name, const std::string& description, auto of) {
    columns.push_back(quantity_column<Row>(name, percent, description, [get, of](const Row& row) {
      const std::optional<Unevenness> unevenness = get(row);
      return unevenness ? of(*unevenness) : std::nullopt;
    }));
  };
  using U = const Unevenness&;
  add("unevenness_cv_percent", whose + " without chance; empty: no difference beyond chance",
      [](U of) { return of.cv; });
  add("unevenness_cv_percent_low", "lower end of its 95 % interval", [](U of) { return std::optional(of.low); });
  add("unevenness_cv_percent_high", "upper end: what it may be up to where it is empty",
      [](U of) { return std::optional(of.high); });
}

/// A mean over replicates and, in a second column, the half width of its 95 % interval. `get` gives an optional
/// MeanWithInterval in SI.
template <class Row, class Get>
void add_mean_columns(Columns<Row>& columns, const std::string& name, Unit unit, const std::string& description,
                      Get get) {
  columns.push_back(
      {{name, std::string(unit.name), description + ": mean over the replicates"}, [get, unit](const Row& row) {
         const std::optional<MeanWithInterval>& value = get(row);
         return value ? in_unit(value->mean, unit) : CsvField();
       }});
  columns.push_back(
      {{name + "_ci95", std::string(unit.name), "half width of its 95 % interval"}, [get, unit](const Row& row) {
         const std::optional<MeanWithInterval>& value = get(row);
         return value ? in_unit(value->half_width_95, unit) : CsvField();
       }});
}

/// Every figure of `means(row)`, a mean with its interval.
template <class Row, class Get>
void add_metric_columns(Columns<Row>& columns, Get means) {
  for (const Metric& metric : metrics()) {
    const Unit unit{metric.unit, metric.unit_size};
    const std::string name(metric.name), description(metric.description);
    if (!metric.is_pooled())
      add_mean_columns(
          columns, name, unit, description,
          [ means, &metric ](const Row& row) -> const auto& { return means(row)[metric]; });
    else
      columns.push_back(quantity_column<Row>(name, unit, description, [means, &metric](const Row& row) {
        const std::optional<MeanWithInterval>& value = means(row)[metric];
        return value ? std::optional(value->mean) : std::nullopt;
      }));
  }
}

template <class Row>
void append(Columns<Row>& columns, Columns<Row> more) {
  std::move(more.begin(), more.end(), std::back_inserter(columns));
}

/// A CSV file that is filled row by row.
template <class Row>
class Csv {
 public:
  explicit Csv(Columns<Row> columns, CsvFormat format = {})
      : columns_(std::move(columns)), table_(names_of(columns_), format) {}
  void add(const Row& row) {
    std::vector<CsvField> fields;
    fields.reserve(columns_.size());
    for (const Column<Row>& column : columns_) fields.push_back(column.field(row));
    table_.add_row(fields);
  }
  const std::string& text() const { return table_.text(); }

 private:
  static std::vector<std::string> names_of(const Columns<Row>& columns) {
    std::vector<std::string> names;
    for (const Column<Row>& column : columns) names.push_back(column.text.name);
    return names;
  }
  Columns<Row> columns_;
  CsvTable table_;
};

/// A CSV file of these rows.
template <class Row>
std::string csv_of(Columns<Row> columns, const std::vector<Row>& rows, CsvFormat format = {}) {
  Csv<Row> csv(std::move(columns), format);
  for (const Row& row : rows) csv.add(row);
  return csv.text();
}

/// What a reader is told of a file.
struct FileText {
  std::string name;
  std::string description;  // what it holds, of a CSV file what a row is; without a full stop
  std::vector<ColumnText> columns;
};

template <class Row>
FileText file_text(std::string name, std::string description, const Columns<Row>& columns) {
  FileText text{std::move(name), std::move(description), {}};
  for (const Column<Row>& column : columns) text.columns.push_back(column.text);
  return text;
}

}  // namespace vibrosow
