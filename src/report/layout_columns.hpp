#pragma once

#include <string>
#include <vector>

#include "input/key_units.hpp"
#include "report/columns.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// A layout of a study with what came of it.
struct LayoutRow {
  const StudyResult* result;
  std::size_t index;
  const Layout& layout() const { return result->study.layouts[index]; }
  const LayoutResult& of() const { return result->layouts[index]; }
};

inline std::vector<LayoutRow> layout_rows(const StudyResult& result) {
  std::vector<LayoutRow> rows;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) rows.push_back({&result, i});
  return rows;
}

/// The first columns of every file; a `Row` has its layout().
template <class Row>
Columns<Row> layout_columns() {
  return {text_column<Row>("layout", "number of the layout, in the order of the study",
                           [](const Row& r) { return r.layout().number; }),
          text_column<Row>("name", "of its [[layout]]; empty without", [](const Row& r) { return r.layout().name; })};
}

/// What tells the layouts of a study apart.
template <class Row>
Columns<Row> key_columns(const std::vector<std::string>& keys) {
  Columns<Row> columns;
  for (const std::string& key : keys)
    columns.push_back(
        {{condition_column(key), "", "value of this key of the seeder file, in the unit that its column names"},
         [key](const Row& r) {
           const auto value = r.layout().values.find(key);
           return value == r.layout().values.end() ? CsvField() : csv_text_or_number(value->second);
         }});
  return columns;
}

template <class Row>
Column<Row> replicates_column() {
  return text_column<Row>("replicates", "runs that finished, of which the figures are",
                          [](const Row& r) { return r.of().replicates; });
}

}  // namespace vibrosow
