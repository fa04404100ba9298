#include "input/source_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "scene/input_error.hpp"

namespace vibrosow {

namespace {

std::string key_of(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::absolute(file, none).lexically_normal().string();
}

std::string text_on_disk(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& reason) { throw InputError(file.string() + ": " + reason); };
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();
  if (kind == std::filesystem::file_type::not_found) fail("there is no such file");
  if (error) fail("cannot be read: " + error.message());
  if (kind == std::filesystem::file_type::directory) fail("cannot be read: it is a directory");
  if (kind != std::filesystem::file_type::regular) fail("cannot be read: it is not a plain file");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(std::string("cannot be read: ") + std::strerror(errno));
  std::string text;
  std::array<char, 65536> part;
  while (in.read(part.data(), part.size()) || in.gcount() > 0)
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) fail(std::string("cannot be read: ") + std::strerror(EIO));
  return text;
}

}  // namespace

const std::string& SourceFiles::read(const std::filesystem::path& file) {
  ++reads_;
  const std::string key = key_of(file);
  const auto frozen = frozen_.find(key);
  return texts_[key] = frozen != frozen_.end() ? frozen->second : text_on_disk(file);
}

bool SourceFiles::has(const std::filesystem::path& file) const {
  std::error_code none;
  return frozen_.contains(key_of(file)) || std::filesystem::is_regular_file(file, none);
}

const TomlTable& SourceFiles::toml(const std::filesystem::path& file) {
  const auto known = toml_.find(file);
  if (known != toml_.end()) return known->second;
  const std::string& text = read(file);
  try {
    return toml_.emplace(file, parse_toml(text)).first->second;
  } catch (const TomlError& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file.string(), error.line, error.what()));
  }
}

const std::string& SourceFiles::text(const std::filesystem::path& file) {
  const auto known = texts_.find(key_of(file));
  return known != texts_.end() ? known->second : read(file);
}

const CsvLines& SourceFiles::csv(const std::filesystem::path& file) {
  const auto known = csv_.find(file);
  if (known != csv_.end()) return known->second;
  return csv_.emplace(file, parse_csv_lines(read(file), file.string())).first->second;
}

}  // namespace vibrosow
