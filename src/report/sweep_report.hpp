#pragma once

#include <string>
#include <vector>

#include "answer/answer.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// What the runs of a sweep took on this machine.
struct SweepTiming {
  double wall_time = 0;    // s, from beginning to end
  int jobs = 1;            // runs side by side
  std::int64_t runs = 0;   // that were made now
  double run_time = 0;     // s, their wall times, summed
  double grain_steps = 0;  // theirs, summed
};

/// Why a layout is not ok; else what to know about its runs; and what in its scene can hardly be meant.
std::string layout_note(const LayoutResult& layout);

/// One row per layout: what tells it apart, and each figure with its 95 % half width. Percent are percent.
std::string sweep_csv(const StudyResult& result, CsvFormat format = {});

/// One row per layout, hole and lot. `measured` is in the unit of the measured table's quantity.
std::string sweep_holes_csv(const StudyResult& result, CsvFormat format = {});

/// sweep_runs.csv, made scene by scene (`SweepOptions::on_runs`): one row per layout and random seed; a scene shared by
/// several layouts is listed under each and says so. Of a study that outlives it.
class SweepRunsCsv {
 public:
  explicit SweepRunsCsv(const Study& study, CsvFormat format = {});
  void add(std::size_t scene, const std::vector<Evaluation>& runs);
  std::string text() const;

 private:
  const Study& study_;
  CsvFormat format_;
  std::vector<std::vector<std::size_t>> layouts_;  // of each scene
  std::string head_;
  std::vector<std::string> rows_;  // of each layout
};

/// One row per layout, record time and lot, of layouts that record: packing fraction of the bed's inside with its
/// change since the first record, where the lot is "all"; the lot's segregation index.
std::string sweep_records_csv(const StudyResult& result, CsvFormat format = {});

/// One row per layout and measured value. Simulated values are scaled, in the unit of the measured column.
std::string comparison_csv(const StudyResult& result, CsvFormat format = {});

std::string sweep_timing_json(const SweepTiming& timing);

/// What the files of a sweep hold; the keys that a study varies stand as one column KEY.
std::vector<FileText> sweep_file_texts();

/// Its files: sweep.csv, sweep_holes.csv, sweep_runs.csv, doubts.json, timing.json, with a record sweep_records.csv,
/// with measured outflow comparison.csv, and with a drill sweep_rows.csv and, where it is varied what they follow,
/// trade.csv.
std::vector<OutputFile> sweep_files(const Answer& answer, const StudyResult& result, const SweepRunsCsv& runs,
                                    const SweepTiming& timing, CsvFormat format = {});

}  // namespace vibrosow
