#include "files/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "files/whole_file.hpp"
#include "storage/case_folder.hpp"
#include "storage/checkpoint_folder.hpp"
#include "storage/run_leases.hpp"
#include "storage/study_plan.hpp"
#include "support/temporary_folder.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

template <class Action>
std::string message_of_writing(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// A folder of results in which one directory is a link to somebody's own.
class LinkedFolder : public testing::Test {
 protected:
  LinkedFolder() {
    fs::create_directories(results() / "cases");
    fs::create_directories(own());
    std::ofstream(own() / "mine.txt") << "mine";
  }
  fs::path results() const { return folder_.path() / "results"; }
  fs::path own() const { return folder_.path() / "own"; }
  void link(const std::string& below) const { fs::create_directory_symlink(own(), results() / below); }
  std::size_t files_of_own() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(own()), fs::directory_iterator()));
  }

  TemporaryFolder folder_;
};

TEST_F(LinkedFolder, NothingIsWrittenThroughALink) {
  for (const char* below : {"cases/b2", "cases/plans", "cases/checkpoints", "cases/running", "cases/segments"}) {
    link(below);
    EXPECT_THAT(message_of_writing([&] { write_file_atomically(PathInFolder(results()) / below / "a", "x"); }),
                HasSubstr("is a link"));
    EXPECT_THAT(message_of_writing([&] { make_directories(PathInFolder(results()) / below / "a", "a"); }),
                HasSubstr("is a link"));
    EXPECT_EQ(files_of_own(), 1u) << below;
  }
}

TEST_F(LinkedFolder, NothingIsRemovedThroughALink) {
  link("cases/checkpoints"), link("cases/b2");
  const std::string name = "b2" + std::string(30, '0');
  std::ofstream(own() / (name + ".case")) << "x";
  std::ofstream(own() / "a.9.checkpoint") << "x";
  const PathInFolder cases = cases_of(results());
  CheckpointFolder(cases / "checkpoints").remove("a");
  CaseFolder(cases).remove(name);
  EXPECT_TRUE(CaseFolder(cases).names().empty()) << "what lies behind a link is not packed";
  EXPECT_EQ(files_of_own(), 3u);
}

TEST_F(LinkedFolder, OneThatItsUserNamedIsFollowed) {
  const fs::path named = folder_.path() / "named";
  fs::create_directory_symlink(results(), named);
  write_file_atomically(cases_of(named) / "a", "x");
  EXPECT_EQ(text_of_file(results() / "cases" / "a"), "x");
}

TEST_F(LinkedFolder, ALinkInThePlaceOfAFileIsReplacedItself) {
  fs::create_symlink(own() / "mine.txt", results() / "cases" / "plan");
  write_file_atomically(cases_of(results()) / "plan", "x");
  remove_file(cases_of(results()) / "plan");
  EXPECT_EQ(text_of_file(own() / "mine.txt"), "mine");
}

TEST(AtomicFile, PlainNamesLeadNowhere) {
  for (const char* name : {"a", "a.csv", "..a", "grains_001.csv"}) EXPECT_TRUE(is_plain_name(name)) << name;
  for (const char* name : {"", ".", "..", "../a", "/a", "a/b", "a\nb", "\x1b"})
    EXPECT_FALSE(is_plain_name(name)) << name;
  EXPECT_TRUE(is_hash_name("0123456789abcdef", 16));
  for (const char* name : {"0123456789abcde", "0123456789abcdeF", "../456789abcdefg"})
    EXPECT_FALSE(is_hash_name(name, 16)) << name;
}

TEST(WholeFile, OfSomeSizeAndPlainAloneIsRead) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a") << "12345";
  EXPECT_EQ(text_of_file(folder.path() / "a", 5), "12345");
  EXPECT_EQ(text_of_file(folder.path() / "a", 4), std::nullopt);
  EXPECT_EQ(text_of_file(folder.path()), std::nullopt);
  EXPECT_EQ(text_of_file("/dev/zero"), std::nullopt);
  EXPECT_EQ(text_of_wanted_file(folder.path() / "a"), "12345");
  EXPECT_THAT([&] { text_of_wanted_file(folder.path() / "none"); },
              testing::ThrowsMessage<InputError>((folder.path() / "none").string() + ": there is no such file"));
  EXPECT_THAT([&] { text_of_wanted_file(folder.path()); },
              testing::ThrowsMessage<InputError>(folder.path().string() + ": cannot be read: it is a directory"));
}

/// What a process leaves that ends while it writes.
void leave_a_temporary_file(const fs::path& folder) {
  const pid_t child = fork();
  if (child == 0) {
    std::ofstream(folder / temporary_name("a.csv")) << "half";
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

TEST(AtomicFile, WhatTheKilledLeftIsSweptAndNothingElse) {
  const TemporaryFolder folder;
  leave_a_temporary_file(folder.path());
  std::ofstream(folder.path() / temporary_name("of-this-process")) << "x";
  std::ofstream(folder.path() / ".a.0123456789abcdef") << "of the same form, and somebody's";
  std::ofstream(folder.path() / ".profile") << "x";
  ASSERT_EQ(entries_of(folder.path()).size(), 4u);
  sweep_temporary_files(folder.path());
  EXPECT_EQ(entries_of(folder.path()).size(), 3u);
  for (const fs::path& left : entries_of(folder.path()))
    EXPECT_FALSE(left.filename().string().starts_with(".a.csv.")) << left;
}

TEST_F(LinkedFolder, NothingIsSweptBehindALink) {
  link("cases/running");
  leave_a_temporary_file(own());
  sweep_temporary_files(cases_of(results()) / "running");
  EXPECT_EQ(files_of_own(), 2u);
}

TEST(RunNotesReadBack, NoProcessAndNoShareThatIsNone) {
  const TemporaryFolder folder;
  const auto note = [&](const std::string& json) { std::ofstream(folder.path() / "a") << json; };
  const RunLeases notes(folder.path());
  note(R"({"host":"\u001b[2J","place":"x","pid":7,"started":"","since":"s","fraction":0.5,"from_fraction":-1})");
  ASSERT_EQ(notes.all().size(), 1u);
  EXPECT_EQ(notes.all()[0].host, "\\x1b[2J");
  for (const char* bad :
       {R"("pid":1e300)", R"("pid":-4)", R"("pid":99999999999)", R"("fraction":1e308)", R"("fraction":-1)"}) {
    note(std::string(R"({"host":"h","place":"x","pid":7,"started":"","since":"s","fraction":0.5,"from_fraction":-1,)") +
         bad + "}");
    EXPECT_TRUE(notes.all().empty()) << bad;
  }
}

}  // namespace
}  // namespace vibrosow
