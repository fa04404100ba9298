#pragma once

#include <string>
#include <vector>

#include "calibration/bench_plan.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// A plan of measurements with what it is for.
struct BenchSource {
  const CalibrationTask& task;
  const BenchLimits& limits;
  const BenchPlan& plan;
  std::vector<std::string> choices;  // sentences: what it does without, so that it is not dear
  std::string command;               // that reads the table when it is filled in
};

/// The plan for a terminal: what to set, and what it is expected to tell.
std::string bench_table(const BenchSource& source);

std::vector<FileText> bench_file_texts();

/// Its files: bench-sheet.html to print, bench.csv to fill in, bench_candidates.csv.
std::vector<OutputFile> bench_files(const BenchSource& source, CsvFormat format = {});

}  // namespace vibrosow
