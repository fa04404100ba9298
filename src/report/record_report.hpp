#pragma once

#include <string>
#include <vector>

#include "report/columns.hpp"
#include "report/output_folder.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a scene's record adds to a run's report; nothing without one. Places and velocities are in the tray's frame.
///  - grains_NNN.csv, of each snapshot: its grains, with the shear strain since the snapshot before;
///  - fields_NNN.csv: maps by cell, with the change of the packing fraction since the snapshot before; cells that hold
///    no part of a grain in either are left out;
///  - records.csv: when each snapshot was taken, where the lots lie, left against right, and the packing fraction of
///  the
///    bed's inside;
///  - profile.csv: the lots by height;
///  - flow.csv: asymmetry and pauses of the outflow over time.
/// Numbers that are not defined are left empty.
std::vector<OutputFile> record_files(const Scene& scene, const Run& run, CsvFormat format = {});

std::string grains_csv(const Scene& scene, const Snapshot& snapshot, const Snapshot* before, CsvFormat format = {});
std::string fields_csv(const Scene& scene, const Snapshot& snapshot, const Snapshot* before, CsvFormat format = {});
std::string records_csv(const Scene& scene, const std::vector<Snapshot>& snapshots, CsvFormat format = {});
std::string profile_csv(const Scene& scene, const std::vector<Snapshot>& snapshots, CsvFormat format = {});
std::string flow_csv(const Scene& scene, const Run& run, CsvFormat format = {});

/// What these files hold.
std::vector<FileText> record_file_texts();

}  // namespace vibrosow
