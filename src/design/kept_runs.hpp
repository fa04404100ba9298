#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "design/evaluate.hpp"
#include "storage/case_folder.hpp"

namespace vibrosow {

/// Keeps every run that has ended in a folder, and takes from it, or from others, what is there already. So a study
/// that was killed goes on where it was, and no run is made twice. For several threads at a time.
class KeptRuns {
 public:
  /// `own` is written into; `others` are only read.
  KeptRuns(const std::filesystem::path& own, const std::vector<std::filesystem::path>& others);

  /// Gives the run that is kept, else `simulator`'s, which it keeps if it ended, be it stopped by the guard; what was
  /// interrupted is not kept. A run that cannot be written is given nevertheless: `not_kept` says why.
  Simulator around(const Simulator& simulator);

  std::int64_t taken() const { return taken_; }  // runs that were there
  /// Why the first run that could not be written could not; empty where all could.
  std::string not_kept() const;

 private:
  void keep(const std::string& identity, const Run& run);
  Run run(const Simulator& simulator, const Model& model, const SimulationOptions& options);

  std::vector<CaseFolder> folders_;  // one's own first
  std::atomic<std::int64_t> taken_ = 0;
  mutable std::mutex mutex_;
  std::string not_kept_;
};

}  // namespace vibrosow
