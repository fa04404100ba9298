#pragma once

#include <string>

#include "design/accuracy.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// One row per setting; a setting that gave no rate has its cells empty.
std::string accuracy_csv(const AccuracyResult& result, CsvFormat format = {});

/// Wall times of this machine, mean of a setting's runs.
std::string accuracy_timing_csv(const AccuracyResult& result, CsvFormat format = {});

/// The same rows for a terminal, scheme by scheme, with the reason where a setting gave no rate.
std::string accuracy_table(const AccuracyResult& result);

/// What 1 % of outflow costs: the cheapest setting whose |error| and interval together make up at most 1 %, and the
/// cheaper one, if any, of which the replicates do not tell.
std::string accuracy_sentence(const AccuracyResult& result);

/// What the files of the command hold.
std::vector<FileText> accuracy_file_texts();

/// Its files: accuracy.csv, accuracy_timing.csv and timing.json. `wall_time`: s, from beginning to end.
std::vector<OutputFile> accuracy_files(const AccuracyResult& result, double wall_time, int jobs, CsvFormat format = {});

}  // namespace vibrosow
