#include "report/output_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw InputError(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

/// Complete content under a temporary name beside `path`; removed again unless it is put in place.
class StagedFile {
 public:
  StagedFile(const fs::path& path, std::string_view content)
      : path_(path), temporary_(path.parent_path() / fmt::format(".{}.{}", path.filename().string(), getpid())) {
    if (fs::is_directory(path_)) fail(path_, std::strerror(EISDIR));
    const int descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(path_, std::strerror(errno));
    const int error = write_all(descriptor, content);
    const int close_error = close(descriptor) == 0 ? 0 : errno;
    if (error == 0 && close_error == 0) return;
    unlink(temporary_.c_str());
    fail(path_, std::strerror(error ? error : close_error));
  }
  StagedFile(StagedFile&& other) noexcept
      : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})) {}
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  StagedFile& operator=(StagedFile&&) = delete;
  ~StagedFile() {
    if (!temporary_.empty()) unlink(temporary_.c_str());
  }

  void put_in_place() {
    if (rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, std::strerror(errno));
    temporary_.clear();
  }

 private:
  /// 0, or the errno of what failed.
  static int write_all(int descriptor, std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = write(descriptor, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    // A full disk may show only here.
    return fsync(descriptor) == 0 ? 0 : errno;
  }

  fs::path path_;
  fs::path temporary_;
};

}  // namespace

void write_files_atomically(const fs::path& directory, const std::vector<OutputFile>& files) {
  std::error_code error;
  if (!directory.empty()) fs::create_directories(directory, error);
  if (error) fail(directory, error.message());
  std::vector<StagedFile> staged;
  staged.reserve(files.size());
  for (const OutputFile& file : files) staged.emplace_back(directory / file.name, file.content);
  for (StagedFile& file : staged) file.put_in_place();
}

void write_file_atomically(const fs::path& path, const std::string& content) {
  write_files_atomically(path.parent_path(), {{path.filename().string(), content}});
}

}  // namespace vibrosow
