#include "report/output_files.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() : directory_(fs::path(testing::TempDir()) / ("output-" + std::to_string(getpid()))) {}
  ~OutputFiles() override { fs::remove_all(directory_); }

  static std::string content(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::size_t files_in_directory() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
  }
  fs::path directory_;
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(OutputFiles, AreWrittenIntoNewDirectoriesAndReplaced) {
  const fs::path path = directory_ / "deep" / "a.csv";
  write_file_atomically(path, "first, longer\n");
  write_file_atomically(path, "second\n");
  EXPECT_EQ(content(path), "second\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), fs::directory_iterator()), 1);
}

/// A limit on the size of files fails in write() as a full disk does. Ends the process: 7 when the error was
/// as it should be.
[[noreturn]] void write_beyond_the_limit(const fs::path& directory) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{1000, 1000};
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string message = message_of([&] {
    write_files_atomically(directory, {{"a.csv", "new\n"}, {"b.csv", std::string(5000, 'x')}});
  });
  std::_Exit(message == (directory / "b.csv").string() + ": cannot be written: File too large" ? 7 : 1);
}

TEST_F(OutputFiles, NothingIsLeftWhenTheDiskIsFull) {
  fs::create_directories(directory_);
  std::ofstream(directory_ / "a.csv") << "old\n";
  // In a child: the limit cannot be taken back.
  EXPECT_EXIT(write_beyond_the_limit(directory_), testing::ExitedWithCode(7), "");
  EXPECT_EQ(content(directory_ / "a.csv"), "old\n");
  EXPECT_EQ(files_in_directory(), 1U);
}

TEST_F(OutputFiles, SayWhichPathCannotBeWritten) {
  write_file_atomically(directory_ / "file", "x");
  EXPECT_EQ(message_of([&] { write_file_atomically(directory_ / "file" / "a.csv", "x"); }),
            (directory_ / "file").string() + ": cannot be written: Not a directory");
  fs::create_directories(directory_ / "taken.csv");
  EXPECT_EQ(message_of([&] {
              write_files_atomically(directory_, {{"a.csv", "x"}, {"taken.csv", "x"}});
            }),
            (directory_ / "taken.csv").string() + ": cannot be written: Is a directory");
  EXPECT_FALSE(fs::exists(directory_ / "a.csv"));
  EXPECT_EQ(files_in_directory(), 2U);
}

}  // namespace
}  // namespace vibrosow
