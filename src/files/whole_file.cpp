#include "files/whole_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// None where it cannot be read, or holds more than `most` bytes, whatever its size is said to be.
std::optional<std::string> text_within(const fs::path& file, std::uint64_t most) {
  std::ifstream in(file, std::ios::binary);
  std::string text;
  std::array<char, 65536> part;
  while (in && text.size() <= most) {
    in.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  }
  return in.eof() && text.size() <= most ? std::optional(std::move(text)) : std::nullopt;
}

}  // namespace

std::optional<std::string> text_of_file(const fs::path& file, std::uint64_t most) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || error || fs::file_size(file, error) > most) return std::nullopt;
  return text_within(file, most);
}

std::string text_of_wanted_file(const fs::path& file, std::uint64_t most) {
  const auto fail = [&](const std::string& reason) { throw InputError(file.string() + ": " + reason); };
  std::error_code error;
  const fs::file_type kind = fs::status(file, error).type();
  if (kind == fs::file_type::not_found) fail("there is no such file");
  if (error) fail("cannot be read: " + error.message());
  if (kind == fs::file_type::directory) fail("cannot be read: it is a directory");
  if (kind != fs::file_type::regular) fail("cannot be read: it is not a plain file");
  errno = 0;
  std::optional<std::string> text = text_within(file, most);
  if (!text)
    fail(errno ? std::string("cannot be read: ") + std::strerror(errno)
               : fmt::format("holds more than {} bytes", most));
  return *text;
}

std::optional<std::string> text_of_file_or_none(const fs::path& file, std::uint64_t most) {
  std::error_code error;
  if (fs::status(file, error).type() == fs::file_type::not_found) return std::nullopt;
  return text_of_wanted_file(file, most);
}

bool has_extension(const std::filesystem::path& file, std::string_view extension) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(file.extension().string(), extension, {}, small);
}

}  // namespace vibrosow
