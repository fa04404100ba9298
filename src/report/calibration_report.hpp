#pragma once

#include <string>
#include <vector>

#include "calibration/calibration_answer.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// "tray.motion.frequency = 9 Hz; tray.holes.count = 5"
std::string conditions_text(const std::vector<Condition>& conditions);

/// For a terminal: what is doubtful, the fitted values, and what was predicted of what was held out.
std::string calibration_table(const CalibrationAnswer& answer);

std::vector<FileText> calibration_file_texts();

/// Its files: calibration.csv, prediction.csv, posterior.csv, calibration_runs.csv and, where
/// `CalibrationAnswer::gives_a_contact`, contact.toml, the seeder's contact with the means of the fitted values.
std::vector<OutputFile> calibration_files(const CalibrationAnswer& answer, const Contact& fitted,
                                          CsvFormat format = {});

}  // namespace vibrosow
