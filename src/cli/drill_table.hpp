#pragma once

#include <string>

#include "agronomy/row_metrics.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// "drill: 5 rows, 150 mm apart, at 8 km/h; each hole feeds a row".
std::string drill_sentence(const Drill& drill);

/// What a run is to its drill: a table of rows, how far they differ, and what spacings stand for.
void print_drill(const DrillMetrics& metrics, Space space);

/// What a layout sows, in a sentence. It has rows. `beside`: stands beside the rate.
std::string sown_sentence(const std::vector<RowMeans>& rows, std::string_view beside);

/// Turn-down and sensitivity to slope, where the study says something of them.
void print_trade(const StudyResult& result);

}  // namespace vibrosow
