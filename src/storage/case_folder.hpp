#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "storage/case_file.hpp"

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

  /// What lies under a name; none where nothing does, or it cannot be read, is damaged or belongs to another name.
  std::optional<Case> named(const std::string& name) const;

  /// Names of all cases here, sound or not, in order.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path file_of(const std::string& name) const;

  std::filesystem::path path_;
};

}  // namespace vibrosow
