#pragma once

#include <string>
#include <vector>

#include "design/study.hpp"
#include "input/key_units.hpp"
#include "report/columns.hpp"

namespace vibrosow {

/// The first columns of every file of a study; a `Row` has its layout().
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

}  // namespace vibrosow
