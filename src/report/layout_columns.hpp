#pragma once

#include <vector>

#include "design/sweep.hpp"
#include "report/columns.hpp"

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

template <class Row>
Column<Row> replicates_column() {
  return text_column<Row>("replicates", "runs that finished, of which the figures are",
                          [](const Row& r) { return r.of().replicates; });
}

}  // namespace vibrosow
