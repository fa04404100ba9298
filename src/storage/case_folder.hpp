#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "result/run.hpp"

namespace vibrosow {

/// Runs on the disk, each in a file of its own named by what it is of ("3f/3f0a..b2.case"), written under a temporary
/// name and renamed. So any number of processes may read and write one folder, without locks: a run that two of them
/// make is the same file.
class CaseFolder {
 public:
  explicit CaseFolder(std::filesystem::path path) : path_(std::move(path)) {}

  /// The run of an identity (`case_identity`); none where it is not there, or cannot be read or is damaged: then it is
  /// to be made again, which mends it.
  std::optional<Run> find(std::string_view identity) const;

  /// Throws InputError "PATH: cannot be written: REASON".
  void keep(std::string_view identity, const Run& run) const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path file_of(std::string_view identity) const;

  std::filesystem::path path_;
};

}  // namespace vibrosow
