#include "files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <system_error>

#include "files/this_machine.hpp"
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

void refuse_links(const PathInFolder& place, bool whole) {
  if (const auto link = place.link_on_the_way(whole))
    throw InputError(
        fmt::format("{}: is a link, and in a folder of results none is followed to write; put a folder in its place",
                    link->string()));
}

constexpr std::size_t owner_digits = 8, name_end = 4 * owner_digits;  // a temporary name's last

/// What a process's temporary names have in common: a number for the machine, and the process's.
std::string owner_of_names(pid_t process) {
  static const std::string machine = fmt::format("{:08x}", [] {
    const std::string place = place_of_processes();
    return static_cast<std::uint32_t>(XXH3_64bits(place.data(), place.size()));
  }());
  return machine + fmt::format("{:08x}", static_cast<std::uint32_t>(process));
}

/// Whether there is no such process on this machine.
bool is_gone(pid_t process) {
  return process > 0 && process != getpid() && kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

PathInFolder PathInFolder::operator/(const fs::path& below) const {
  PathInFolder more = *this;
  more.below_ /= below;
  return more;
}

std::optional<fs::path> PathInFolder::link_on_the_way(bool whole) const {
  fs::path way = folder_;
  for (auto part = below_.begin(); part != below_.end(); ++part) {
    way /= *part;
    std::error_code none;
    if ((whole || std::next(part) != below_.end()) && fs::is_symlink(fs::symlink_status(way, none))) return way;
  }
  return std::nullopt;
}

void make_directories(const PathInFolder& place, const fs::path& as) {
  refuse_links(place, true);
  std::error_code error;
  fs::create_directories(place.path(), error);
  if (error) cannot_write(as, error.value());
}

void remove_file(const PathInFolder& place) {
  if (!place.link_on_the_way(false)) unlink(place.path().c_str());
}

bool is_plain_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && std::ranges::none_of(name, [](char letter) {
    return letter == '/' || static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
  });
}

bool is_hash_name(std::string_view name, std::size_t digits) {
  return name.size() == digits && name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

CannotWrite::CannotWrite(const fs::path& path, int error)
    : InputError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(error))),
      for_want_of_room(error == ENOSPC || error == EDQUOT) {}

void cannot_write(const fs::path& path, int error) {
  throw CannotWrite(path, error);
}

void write_new_file(const fs::path& path, std::string_view content, const fs::path& as) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) cannot_write(as, errno);
  const int error = write_all(descriptor, content);
  const int close_error = close(descriptor) == 0 ? 0 : errno;
  if (error || close_error) cannot_write(as, error ? error : close_error);
}

void sync_directory(const fs::path& directory) {
  const int descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

std::string temporary_name(const std::string& stem) {
  std::random_device device;  // names of files alone: no result depends on it
  return fmt::format(".{}.{}{:08x}{:08x}", stem, owner_of_names(getpid()), device(), device());
}

bool is_left_behind(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.size() < name_end + 2 || name.front() != '.') return false;
  const std::string end = name.substr(name.size() - name_end);
  if (name[name.size() - name_end - 1] != '.' || !is_hash_name(end, name_end)) return false;
  std::uint32_t process = 0;
  std::from_chars(end.data() + owner_digits, end.data() + 2 * owner_digits, process, 16);
  if (end.starts_with(owner_of_names(static_cast<pid_t>(process)))) return is_gone(static_cast<pid_t>(process));
  std::error_code error;
  const auto touched = fs::last_write_time(file, error);
  return !error && fs::file_time_type::clock::now() - touched > std::chrono::hours(24);
}

void sweep_temporary_files(const PathInFolder& directory) {
  if (directory.link_on_the_way(true)) return;
  for (const fs::path& file : entries_of(directory.path()))
    if (is_left_behind(file)) remove_file(directory / file.filename());
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
  if (fs::exists(from, none) || !fs::exists(to, none)) cannot_write(to, reason);
}

void write_file_atomically(const PathInFolder& place, std::string_view content) {
  refuse_links(place, false);
  const fs::path path = place.path();
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
