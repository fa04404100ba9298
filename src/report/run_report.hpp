#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agronomy/row_metrics.hpp"
#include "outflow/outflow.hpp"
#include "report/columns.hpp"
#include "report/output_folder.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"
#include "study/expected_rate.hpp"

namespace vibrosow {

/// One row per grain leaving; `hole` is "spilled" for a grain that passed no hole.
std::string outflow_csv(const Scene& scene, const Run& run, CsvFormat format = {});

/// One row per hole and lot. The tray's rate is the plane's times the depth factor; both are empty without
/// `tray.depth`. With what the rate is expected to be, the last row has that too.
std::string summary_csv(const Outflow& outflow, CsvFormat format = {},
                        const std::optional<ExpectedRate>& expected = {});

/// What the run was and how it went, with the whole scene. Holds nothing that depends on a clock. `effects`:
/// names of those present.
std::string run_json(const Scene& scene, const Run& run, const Outflow& outflow,
                     const std::vector<std::string>& effects, const std::optional<ExpectedRate>& expected = {});

/// What the run took on this machine.
std::string timing_json(const Run& run);

/// What the files of a run hold.
std::vector<FileText> run_file_texts();

/// Its files: outflow.csv, summary.csv, run.json, timing.json, those of a record and, with a drill, rows.csv.
std::vector<OutputFile> run_files(const Scene& scene, const Run& run, const Outflow& outflow,
                                  const std::vector<std::string>& effects, CsvFormat format = {},
                                  const std::optional<DrillMetrics>& drill = {},
                                  const std::optional<ExpectedRate>& expected = {});

}  // namespace vibrosow
