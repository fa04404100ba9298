#include "storage/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <system_error>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// 0, or the errno of what failed. A full disk may show only at fsync.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

void cannot_write(const fs::path& path, const std::string& reason) {
  throw CannotWrite(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

void write_new_file(const fs::path& path, std::string_view content, const fs::path& as) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) cannot_write(as, std::strerror(errno));
  const int error = write_all(descriptor, content);
  const int close_error = close(descriptor) == 0 ? 0 : errno;
  if (error || close_error) cannot_write(as, std::strerror(error ? error : close_error));
}

void sync_directory(const fs::path& directory) {
  const int descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

std::string temporary_name(const std::string& stem) {
  std::random_device device;  // names of files alone: no result depends on it
  return fmt::format(".{}.{:08x}{:08x}", stem, device(), device());
}

std::vector<fs::path> entries_of(const fs::path& directory) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    entries.push_back(entry->path());
  return entries;
}

void move_file(const fs::path& from, const fs::path& to) {
  if (rename(from.c_str(), to.c_str()) == 0) return;
  const int reason = errno;
  std::error_code none;
  if (fs::exists(from, none) || !fs::exists(to, none)) cannot_write(to, std::strerror(reason));
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  const fs::path directory = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const fs::path temporary = directory / temporary_name(path.filename().string());
  try {
    write_new_file(temporary, content, path);
    move_file(temporary, path);
  } catch (const InputError&) {
    unlink(temporary.c_str());
    throw;
  }
  sync_directory(directory);
}

}  // namespace vibrosow
