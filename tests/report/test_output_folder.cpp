#include "report/output_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

#include "files/atomic_file.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Names = std::set<std::string>;

class OutputFolders : public testing::Test {
 protected:
  OutputFolders()
      : parent_(fs::path(testing::TempDir()) / ("folders-" + std::to_string(getpid()))), folder_(parent_ / "out") {
    fs::create_directories(parent_);
  }
  ~OutputFolders() override { fs::remove_all(parent_); }

  static std::string content(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static Names names_in(const fs::path& directory) {
    Names names;
    for (const auto& entry : fs::directory_iterator(directory)) names.insert(entry.path().filename().string());
    return names;
  }
  void write(const std::vector<OutputFile>& files, const std::string& command = "run") const {
    OutputFolder(folder_, command, {}).write(files);
  }
  fs::path parent_, folder_;
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

ino_t number_of(const fs::path& path) {
  struct stat about = {};
  stat(path.c_str(), &about);
  return about.st_ino;
}

TEST_F(OutputFolders, ASetIsReplacedWholeByOneRename) {
  write({{"a.csv", "first\n"}, {"grains_002.csv", "stale\n"}});
  const ino_t first = number_of(folder_);
  write({{"a.csv", "second\n"}, {"b.csv", "new\n"}});
  EXPECT_EQ(content(folder_ / "a.csv"), "second\n");
  EXPECT_EQ(names_in(folder_), (Names{"a.csv", "b.csv", "files.json"}));  // nothing of the former set
  EXPECT_NE(number_of(folder_), first);                                   // another folder took its place
  EXPECT_EQ(names_in(parent_), Names{"out"});
  EXPECT_THAT(content(folder_ / "files.json"), HasSubstr("\"complete\": true"));
}

TEST_F(OutputFolders, ForeignFilesStayAndAreNeverOverwritten) {
  write({{"a.csv", "first\n"}, {"old.csv", "stale\n"}});
  std::ofstream(folder_ / "notes.txt") << "mine\n";
  const ino_t first = number_of(folder_);
  write({{"a.csv", "second\n"}});
  EXPECT_EQ(number_of(folder_), first);
  EXPECT_EQ(names_in(folder_), (Names{"a.csv", "files.json", "notes.txt"}));
  EXPECT_EQ(content(folder_ / "a.csv"), "second\n");
  EXPECT_EQ(content(folder_ / "notes.txt"), "mine\n");
  EXPECT_THAT(content(folder_ / "files.json"), HasSubstr("\"complete\": true"));

  std::ofstream(folder_ / "b.csv") << "mine too\n";
  EXPECT_THAT(message_of([&] {
                write({{"a.csv", "third\n"}, {"b.csv", "x\n"}});
              }),
              HasSubstr("out/b.csv would be overwritten"));
  EXPECT_EQ(content(folder_ / "b.csv"), "mine too\n");
  EXPECT_EQ(content(folder_ / "a.csv"), "second\n");
  EXPECT_EQ(names_in(parent_), Names{"out"});
}

TEST_F(OutputFolders, TheWorkingDirectoryIsNotExchanged) {
  write({{"a.csv", "first\n"}, {"old.csv", "stale\n"}});
  const fs::path before = fs::current_path();
  const ino_t first = number_of(folder_);
  fs::current_path(folder_);
  OutputFolder(".", "run", {}).write({{"a.csv", "second\n"}});
  fs::current_path(before);
  EXPECT_EQ(number_of(folder_), first);
  EXPECT_EQ(content(folder_ / "a.csv"), "second\n");
  EXPECT_EQ(names_in(folder_), (Names{"a.csv", "files.json"}));
}

TEST_F(OutputFolders, RefuseBeforeAnythingIsRun) {
  write({{"sweep.csv", "x\n"}}, "sweep");
  EXPECT_THAT(message_of([&] { OutputFolder(folder_, "run", {"run.json"}); }),
              HasSubstr("out holds the reports of vibrosow sweep, not of run; choose another --out"));
  fs::remove(folder_ / "files.json");
  EXPECT_THAT(message_of([&] { OutputFolder(folder_, "sweep", {"sweep.csv"}); }), HasSubstr("would be overwritten"));
  EXPECT_EQ(message_of([&] { OutputFolder(folder_, "run", {"run.json", "sweep_*.csv"}); }), "no error");
  std::ofstream(folder_ / "grains_007.csv") << "mine\n";
  EXPECT_THAT(message_of([&] { OutputFolder(folder_, "run", {"grains_*.csv"}); }), HasSubstr("grains_007.csv would"));
  std::ofstream(folder_ / "files.json") << "[1, 2]\n";
  EXPECT_THAT(message_of([&] { OutputFolder(folder_, "run", {"run.json"}); }),
              HasSubstr("files.json was not written by vibrosow"));
}

TEST_F(OutputFolders, AHalfMovedSetCanBeReplaced) {
  write({{"a.csv", "first\n"}});
  // What a loss of power leaves while files are moved in one by one.
  std::ofstream(folder_ / "files.json")
      << R"({"command": "run", "complete": false, "files": ["a.csv", "b.csv", "old.csv"]})";
  std::ofstream(folder_ / "b.csv") << "half of the second\n";
  write({{"a.csv", "third\n"}});
  EXPECT_EQ(names_in(folder_), (Names{"a.csv", "files.json"}));
}

/// A limit on the size of files fails in write() as a full disk does. Ends the process: 7 when the error was as it
/// should be.
[[noreturn]] void write_beyond_the_limit(const fs::path& folder) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{1000, 1000};
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string message = message_of([&] {
    OutputFolder(folder, "run", {}).write({{"a.csv", "new\n"}, {"b.csv", std::string(5000, 'x')}});
  });
  std::_Exit(message == (folder / "b.csv").string() + ": cannot be written: File too large" ? 7 : 1);
}

TEST_F(OutputFolders, AFullDiskLeavesTheFormerSet) {
  write({{"a.csv", "old\n"}});
  // In a child: the limit cannot be taken back.
  EXPECT_EXIT(write_beyond_the_limit(folder_), testing::ExitedWithCode(7), "");
  EXPECT_EQ(content(folder_ / "a.csv"), "old\n");
  EXPECT_EQ(names_in(folder_), (Names{"a.csv", "files.json"}));
  EXPECT_EQ(names_in(parent_), Names{"out"});
}

TEST_F(OutputFolders, SayWhichPathCannotBeUsed) {
  std::ofstream(parent_ / "file") << "x";
  EXPECT_EQ(message_of([&] { OutputFolder(parent_ / "file" / "out", "run", {}); }),
            (parent_ / "file" / "out").string() + ": cannot be made: Not a directory");
}

TEST_F(OutputFolders, ASingleFileIsReplacedWhole) {
  write_file_atomically(parent_ / "a.csv", "first, longer\n");
  write_file_atomically(parent_ / "a.csv", "second\n");
  EXPECT_EQ(content(parent_ / "a.csv"), "second\n");
  EXPECT_EQ(message_of([&] { write_file_atomically(parent_ / "a.csv" / "b.csv", "x"); }),
            (parent_ / "a.csv" / "b.csv").string() + ": cannot be written: Not a directory");
  EXPECT_EQ(names_in(parent_), Names{"a.csv"});
}

TEST_F(OutputFolders, AFileIsAddedToTheSetThatIsThere) {
  write({{"a.csv", "a"}, {"report.html", "old"}});
  const OutputFolder folder(folder_, "run", {"report.html"});
  folder.add({"report.html", "new"});
  folder.add({"more.txt", "more"});
  EXPECT_EQ(content(folder_ / "a.csv"), "a");
  EXPECT_EQ(content(folder_ / "report.html"), "new");
  EXPECT_THAT(content(folder_ / "files.json"), HasSubstr("\"complete\": true"));
  write({{"a.csv", "b"}});  // what was added belongs to the set, and goes with it
  EXPECT_EQ(names_in(folder_), (Names{"a.csv", "files.json"}));
}

TEST_F(OutputFolders, NothingIsAddedInThePlaceOfAForeignFile) {
  write({{"a.csv", "a"}});
  std::ofstream(folder_ / "report.html") << "mine";
  const OutputFolder folder(folder_, "run", {});
  EXPECT_THAT(message_of([&] { folder.add({"report.html", "new"}); }), HasSubstr("would be overwritten"));
  EXPECT_EQ(content(folder_ / "report.html"), "mine");
}

}  // namespace
}  // namespace vibrosow
