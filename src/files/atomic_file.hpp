#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/input_error.hpp"

namespace vibrosow {

/// "PATH: cannot be written: REASON": a full disk, no right to write.
class CannotWrite : public InputError {
 public:
  CannotWrite(const std::filesystem::path& path, int error);

  bool for_want_of_room;  // a full disk or quota, which may pass; else it lasts
};

/// Where something is in a folder that a user named. The folder may be reached over links; below it no link is followed
/// to write or to remove, since somebody else may have made what is in it.
class PathInFolder {
 public:
  /// The folder itself; or any path that a user named, over whatever links.
  template <std::convertible_to<std::filesystem::path> Path>
  PathInFolder(Path folder) : folder_(std::move(folder)) {}

  std::filesystem::path path() const { return below_.empty() ? folder_ : folder_ / below_; }
  PathInFolder operator/(const std::filesystem::path& below) const;

  /// The first directory on the way below the folder, or what is there itself where `whole`, that is a link; none
  /// where there is none.
  std::optional<std::filesystem::path> link_on_the_way(bool whole) const;

 private:
  std::filesystem::path folder_, below_;
};

/// Writes one file: under a temporary name, down to the disk, then renamed. Throws CannotWrite, or InputError where a
/// link is on the way; then a file that was there is as it was.
void write_file_atomically(const PathInFolder& place, std::string_view content);

/// Makes a directory and those above it. Throws CannotWrite, naming `as`, or InputError where one of them is a link.
void make_directories(const PathInFolder& place, const std::filesystem::path& as);

/// Removes a file that is there: a link itself, not what it leads to; nothing where a link is on the way, nor a
/// directory.
void remove_file(const PathInFolder& place);

/// A new file with this content on the disk. Errors name `as`, the path that the file will have.
void write_new_file(const std::filesystem::path& path, std::string_view content, const std::filesystem::path& as);

/// A name that no other file has, of this process or of another on any machine: ".STEM.", 16 hexadecimal digits that
/// say whose it is, and 16 by chance.
std::string temporary_name(const std::string& stem);

/// Whether such a name was given by a process that is no more: of this machine; or whoever's, where the file has not
/// been touched for a day.
bool is_left_behind(const std::filesystem::path& file);

/// Removes files of a directory that processes left behind which were killed while they wrote them.
void sweep_temporary_files(const PathInFolder& directory);

/// What a directory holds, in no order; what cannot be listed is left out.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory);

/// Whether a name that was read may be the name of a file: not empty, no separator, no control character, not "." or
/// "..".
bool is_plain_name(std::string_view name);

/// Whether a name is of so many of the digits 0 to 9 and a to f, as those of cases (32) and plans (16).
bool is_hash_name(std::string_view name, std::size_t digits);

/// Brings what a directory lists down to the disk. Some file systems know no such thing: then nothing is to be done.
void sync_directory(const std::filesystem::path& directory);

/// Renames; errors name `to`. A rename that was done is no error, whatever a network file system reports that repeated
/// it.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Throws CannotWrite; `error` is an errno.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

}  // namespace vibrosow
