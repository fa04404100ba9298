#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/input_error.hpp"

namespace vibrosow {

/// "PATH: cannot be written: REASON": a full disk, no right to write.
class CannotWrite : public InputError {
 public:
  using InputError::InputError;
};

/// Writes one file: under a temporary name, down to the disk, then renamed. Throws CannotWrite; then a file that was
/// there is as it was.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// A new file with this content on the disk. Errors name `as`, the path that the file will have.
void write_new_file(const std::filesystem::path& path, std::string_view content, const std::filesystem::path& as);

/// A name that no other file has, of this process or of another on any machine: ".STEM." and 16 hexadecimal digits.
std::string temporary_name(const std::string& stem);

/// What a directory holds, in no order; what cannot be listed is left out.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory);

/// Brings what a directory lists down to the disk. Some file systems know no such thing: then nothing is to be done.
void sync_directory(const std::filesystem::path& directory);

/// Renames; errors name `to`. A rename that was done is no error, whatever a network file system reports that repeated
/// it.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Throws CannotWrite.
[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& reason);

}  // namespace vibrosow
