#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vibrosow {

struct OutputFile {
  std::string name;  // within the directory
  std::string content;
};

/// Writes files into `directory` (made where it is missing): each under a temporary name first, down to the
/// disk, and only when all are complete are they renamed. Throws InputError "PATH: cannot be written: REASON"
/// on any failure; then no file of the new set is visible and the temporary ones are gone (a failing rename,
/// the last step, may leave some renamed).
void write_files_atomically(const std::filesystem::path& directory, const std::vector<OutputFile>& files);

/// The same for one file.
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

}  // namespace vibrosow
