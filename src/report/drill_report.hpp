#pragma once

#include <string>
#include <vector>

#include "agronomy/row_metrics.hpp"
#include "report/columns.hpp"
#include "study/trade.hpp"

namespace vibrosow {

/// Why a row has no spacings, for a reader; empty where it has.
std::string spacings_note(NoSpacings why);

/// One row per drill row, and one of all.
std::string rows_csv(const DrillMetrics& metrics, CsvFormat format = {});
FileText rows_file_text();

/// One row per layout that has a drill, and drill row, and one of all: each figure with its 95 % half width.
std::string sweep_rows_csv(const StudyResult& result, CsvFormat format = {});
FileText sweep_rows_file_text();

/// One row per line of layouts.
std::string trade_csv(const StudyResult& result, const std::vector<TradeLine>& lines, CsvFormat format = {});
FileText trade_file_text();

}  // namespace vibrosow
