#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace vibrosow {

/// What a plain file holds; none where there is no such file, it is no plain file, or it holds more than `most` bytes.
std::optional<std::string> text_of_file(const std::filesystem::path& file, std::uint64_t most = std::uint64_t{1} << 32);

/// The same of a file that there has to be. Throws InputError, with its name and the reason.
std::string text_of_wanted_file(const std::filesystem::path& file, std::uint64_t most = std::uint64_t{1} << 32);

/// The same, but none where there is no such file.
std::optional<std::string> text_of_file_or_none(const std::filesystem::path& file,
                                                std::uint64_t most = std::uint64_t{1} << 32);

/// Whether a file is called by an `extension` in small letters (".dxf"), itself in small letters or capitals.
bool has_extension(const std::filesystem::path& file, std::string_view extension);

}  // namespace vibrosow
