#pragma once

#include <string>

#include "design/sweep.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// One row per layout: what tells it apart, and each figure with its 95 % half width. Percent are percent.
std::string sweep_csv(const StudyResult& result, CsvFormat format = {});

/// One row per layout, hole and lot. `measured` is in the unit of the measured table's quantity.
std::string sweep_holes_csv(const StudyResult& result, CsvFormat format = {});

/// One row per layout and random seed; a scene shared by several layouts is listed under each and says so.
std::string sweep_runs_csv(const StudyResult& result, CsvFormat format = {});

/// One row per layout, record time and lot, of layouts that record: packing fraction of the bed's inside with its
/// change since the first record, where the lot is "all"; the lot's segregation index.
std::string sweep_records_csv(const StudyResult& result, CsvFormat format = {});

/// One row per layout and measured value. Simulated values are scaled, in the unit of the measured column.
std::string comparison_csv(const StudyResult& result, CsvFormat format = {});

/// What the sweep took on this machine. `wall_time`: s, from beginning to end.
std::string sweep_timing_json(const StudyResult& result, double wall_time, int jobs);

/// What the files of a sweep hold; the keys that a study varies stand as one column KEY.
std::vector<FileText> sweep_file_texts();

/// Its files: sweep.csv, sweep_holes.csv, sweep_runs.csv, timing.json, with a record sweep_records.csv and, with
/// measured outflow, comparison.csv.
std::vector<OutputFile> sweep_files(const StudyResult& result, double wall_time, int jobs, CsvFormat format = {});

}  // namespace vibrosow
