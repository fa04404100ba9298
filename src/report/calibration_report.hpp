#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"

namespace vibrosow {

/// A calibration with what it is of.
struct CalibrationSource {
  const CalibrationTask& task;
  const CalibrationDesign& design;
  const std::vector<ReducedRun>& runs;
  const Calibration& calibration;
};

/// A fitted key, or the depth factor, with what is known of it.
struct ValueRow {
  std::string name, unit;
  std::optional<double> low, high;  // of the prior
  FittedValue value;
  std::string confused_with;
};
std::vector<ValueRow> value_rows(const CalibrationSource& source);

/// The name of the key, or the depth factor, that a FittedPair means.
std::string fitted_name(const CalibrationSource& source, std::size_t index);

/// "tray.motion.frequency = 9 Hz; tray.holes.count = 5"
std::string conditions_text(const std::vector<Condition>& conditions);

/// The fitted values for a terminal, what was predicted of what was held out, and what is doubtful.
std::string calibration_table(const CalibrationSource& source);

/// Whether the best point misses the table by more than three times its noise: then nothing was fitted.
bool is_beyond_its_noise(const CalibrationSource& source);

/// Whether a contact model may be made of it: the table is met within its noise, no value lies at the edge of its
/// range, and no run that counts lost seeds through walls.
bool gives_a_contact(const CalibrationSource& source);

/// What is doubtful about it, each a sentence; none where all is well.
std::vector<std::string> calibration_doubts(const CalibrationSource& source);

std::vector<FileText> calibration_file_texts();

/// Its files: calibration.csv, prediction.csv, posterior.csv, calibration_runs.csv and, where `gives_a_contact`,
/// contact.toml, the seeder's contact with the means of the fitted values.
std::vector<OutputFile> calibration_files(const CalibrationSource& source, const Contact& fitted,
                                          CsvFormat format = {});

}  // namespace vibrosow
