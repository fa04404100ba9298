#include "storage/run_leases.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "files/atomic_file.hpp"
#include "storage/checkpoint_folder.hpp"
#include "support/temporary_folder.hpp"

namespace vibrosow {
namespace {

using std::chrono::milliseconds;

TEST(RunLeases, OneAtATime) {
  const TemporaryFolder folder;
  RunLeases first(folder.path()), second(folder.path());
  EXPECT_TRUE(first.claim("a"));
  EXPECT_FALSE(second.claim("a"));
  EXPECT_TRUE(second.claim("b"));
  first.release("a");
  EXPECT_TRUE(second.claim("a"));
}

TEST(RunLeases, SayWhereAndHowFar) {
  const TemporaryFolder folder;
  RunLeases notes(folder.path());
  notes.claim("a");
  std::ofstream(folder.path() / "b") << "no note";
  const std::vector<RunNote> all = notes.all();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].run, "a");
  EXPECT_EQ(all[0].process, getpid());
  EXPECT_FALSE(all[0].host.empty());
  EXPECT_EQ(all[0].since.size(), std::string("2000-01-01T00:00:00Z").size());
}

TEST(RunLeases, OfADeadProcessIsTakenOverAtOnce) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    RunLeases(folder.path()).claim("a");
    _exit(0);
  }
  siginfo_t ended;
  waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);  // dead, and its parent has not looked
  RunLeases notes(folder.path(), std::chrono::hours(1));
  EXPECT_TRUE(notes.all().empty());
  EXPECT_TRUE(notes.claim("a"));
  waitpid(child, nullptr, 0);
}

TEST(RunLeases, OfASilentOneOfAnotherMachineAfterItsPatience) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a") << R"({"place":"elsewhere","pid":1,"started":"7","beat":1})";
  RunLeases notes(folder.path(), milliseconds(60));
  EXPECT_FALSE(notes.claim("a"));
  std::this_thread::sleep_for(milliseconds(80));
  std::ofstream(folder.path() / "a") << R"({"place":"elsewhere","pid":1,"started":"7","beat":2})";
  EXPECT_FALSE(notes.claim("a")) << "it has beaten meanwhile";
  std::this_thread::sleep_for(milliseconds(80));
  EXPECT_TRUE(notes.claim("a"));
}

TEST(RunLeases, NothingIsClaimedInAFolderThatCannotBeMade) {
  RunLeases leases("/proc/nowhere");
  EXPECT_THROW(leases.claim("a"), CannotWrite);
}

TEST(CheckpointFolder, TheLatestFirstAndEarlierOnesGo) {
  const TemporaryFolder folder;
  const CheckpointFolder checkpoints(folder.path() / "checkpoints");
  checkpoints.keep("a", 90, "x");
  checkpoints.keep("b", 1, "y");
  std::ofstream(folder.path() / "checkpoints/a.100.checkpoint") << "of another process";
  checkpoints.keep("a", 95, "z");
  ASSERT_EQ(checkpoints.of("a").size(), 2u);
  EXPECT_EQ(checkpoints.of("a")[0].filename(), "a.100.checkpoint");
  EXPECT_EQ(checkpoints.runs(), (std::vector<std::string>{"a", "b"}));
  checkpoints.remove("a");
  EXPECT_EQ(checkpoints.runs(), std::vector<std::string>{"b"});
}

}  // namespace
}  // namespace vibrosow
