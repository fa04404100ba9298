#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/atomic_file.hpp"
#include "storage/case_file.hpp"
#include "storage/segments.hpp"

namespace vibrosow {

/// Runs on the disk, each in a file of its own named by what it is of ("3f/3f0a..b2.case"), written under a temporary
/// name and renamed, until they are packed into segments. So any number of processes may read and write one folder,
/// without locks: a run that two of them make is the same file. For several threads at a time.
class CaseFolder {
 public:
  explicit CaseFolder(PathInFolder path) : path_(std::move(path)), segments_(path_ / "segments") {}

  /// The run of an identity (`case_identity`); none where it is not there, or cannot be read or is damaged: then it is
  /// to be made again, which mends it.
  std::optional<Run> find(std::string_view identity) const;

  /// Throws InputError "PATH: cannot be written: REASON", or where another run of this identity is there: two programs
  /// do not agree then.
  void keep(std::string_view identity, const Run& run) const;

  /// What lies under a name; none where nothing does, or it cannot be read, is damaged or belongs to another name.
  std::optional<Case> named(const std::string& name) const;

  /// Whether `named` has one.
  bool has(const std::string& name) const;

  /// Whether what lies under a name is a case as another version of the program writes it, which this one cannot read.
  bool is_of_other_version(const std::string& name) const;

  /// File names of segments that are damaged: what they held is missing.
  std::vector<std::string> unreadable_segments() const;

  /// Takes a case away where it lies in a file of its own.
  void remove(const std::string& name) const;

  /// Names of all cases here, sound or not, in order; none of directories that are links.
  std::vector<std::string> names() const;

  /// How many cases make a segment full.
  static constexpr std::size_t full_segment = 4096;

  /// Moves all sound cases of finished runs that have a file of their own (those that failed may be made anew), where
  /// there are as many as `at_least`, into segments and gives their number. They are deleted only after the segment is
  /// on the disk. Throws CannotWrite.
  std::size_t pack(std::size_t at_least = 1) const;

 private:
  struct Copy {
    std::string bytes;
    Case read;
  };
  PathInFolder file_of(const std::string& name) const;
  std::vector<std::string> loose_names() const;
  std::string loose_bytes(const std::string& name) const;
  std::optional<Copy> sound_copy(const std::string& name) const;

  PathInFolder path_;
  mutable std::shared_mutex mutex_;
  mutable Segments segments_;
};

}  // namespace vibrosow
