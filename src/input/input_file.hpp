#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace vibrosow {

enum class FileKind { seeder, study };

/// A study has a `base`. Throws InputError when the file cannot be read.
FileKind kind_of(const std::filesystem::path& file);

/// The file that a user means: a path, or the name of a shipped seeder or study without ".toml" where there is no such
/// file. Of a seeder and a study of one name the `wanted` one, without a wish the seeder. Throws InputError when there
/// is none, with the nearest shipped name, and for a file of the other kind, with the command that takes it.
std::filesystem::path input_file(const std::string& name, std::optional<FileKind> wanted = std::nullopt);

}  // namespace vibrosow
