#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vibrosow {

/// Writes one file: under a temporary name, down to the disk, then renamed. Throws InputError "PATH: cannot be written:
/// REASON"; then a file that was there is as it was.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// A new file with this content on the disk. Errors name `as`, the path that the file will have.
void write_new_file(const std::filesystem::path& path, std::string_view content, const std::filesystem::path& as);

/// Brings what a directory lists down to the disk. Some file systems know no such thing: then nothing is to be done.
void sync_directory(const std::filesystem::path& directory);

/// Renames; errors name `to`.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Throws InputError "PATH: cannot be written: REASON".
[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& reason);

}  // namespace vibrosow
