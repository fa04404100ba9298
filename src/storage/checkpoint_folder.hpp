#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/atomic_file.hpp"

namespace vibrosow {

/// Where runs under way have got to, on the disk: "NAME.STEP.checkpoint", so that no process overwrites what another
/// has reached. What the bytes mean is the simulation's (`save`, `restore`).
class CheckpointFolder {
 public:
  explicit CheckpointFolder(PathInFolder path) : path_(std::move(path)) {}

  /// Throws InputError where it cannot be written; else earlier ones of the run go.
  void keep(const std::string& run, std::int64_t step, std::string_view bytes) const;

  /// Those of a run, the latest first.
  std::vector<std::filesystem::path> of(const std::string& run) const;

  void remove(const std::string& run) const;

  /// Names of all runs that have any.
  std::vector<std::string> runs() const;

 private:
  using Steps = std::vector<std::pair<std::int64_t, std::filesystem::path>>;
  Steps steps_of(const std::string& run) const;

  PathInFolder path_;
};

}  // namespace vibrosow
