#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "input/source_files.hpp"

namespace vibrosow {

enum class FileKind { seeder, study };

/// A study has a `base`. Throws InputError when the file cannot be read.
FileKind kind_of(const std::filesystem::path& file,
                 const std::shared_ptr<SourceFiles>& files = std::make_shared<SourceFiles>());

/// A file that was looked into, so that reading it through `files` opens it no second time.
struct InputFile {
  std::filesystem::path path;
  FileKind kind;
  std::shared_ptr<SourceFiles> files;
};

/// The file that a user means: a path, or the name of a shipped seeder or study without ".toml" where there is no such
/// file. Of a seeder and a study of one name the `wanted` one, without a wish the seeder. Throws InputError when there
/// is none, with the nearest shipped name, and for a file of the other kind, with the command that takes it.
InputFile input_file(const std::string& name, std::optional<FileKind> wanted = std::nullopt);

/// `warnings_of_files_outside` of the file's own folder and, of a study, of its seeder's, after all was read.
std::vector<std::string> warnings_of_files_outside(const InputFile& file);

}  // namespace vibrosow
