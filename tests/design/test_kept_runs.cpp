#include "design/kept_runs.hpp"

#include <gtest/gtest.h>

#include "input/read_scene.hpp"
#include "study_files.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// A sweep's folder and how often something was really run.
class KeptRunsOf : public testing::Test {
 protected:
  vibrosow::Run run(KeptRuns& kept, std::uint64_t random_seed) {
    SimulationOptions options;
    options.random_seed = random_seed;
    return kept.around(simulator_)(model_, options);
  }
  fs::path folder(const std::string& name) const { return files_.seeder().parent_path() / name; }
  std::vector<fs::path> cases(const std::string& name) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder(name)))
      if (entry.is_regular_file()) found.push_back(entry.path());
    return found;
  }

  StudyFiles files_;
  Model model_ = prepare(read_scene(files_.seeder()));
  int made_ = 0;
  RunStatus status_ = RunStatus::finished;
  Simulator simulator_ = [this](const Model& model, const SimulationOptions& options) {
    ++made_;
    vibrosow::Run run = quick_run(model, options);
    run.status = status_;
    return run;
  };
};

TEST_F(KeptRunsOf, MakesNoRunTwice) {
  KeptRuns first(folder("a"), {});
  const vibrosow::Run made = run(first, 1);
  run(first, 2);
  EXPECT_EQ(made_, 2);
  EXPECT_EQ(first.taken(), 0);
  KeptRuns again(folder("a"), {});
  const vibrosow::Run kept = run(again, 1);
  EXPECT_EQ(made_, 2);
  EXPECT_EQ(again.taken(), 1);
  ASSERT_EQ(kept.events.size(), made.events.size());
  EXPECT_EQ(kept.events.back().time, made.events.back().time);
}

TEST_F(KeptRunsOf, TakesWhatOtherSweepsMadeAndKeepsItToo) {
  KeptRuns other(folder("other"), {});
  run(other, 1);
  KeptRuns own(folder("own"), {folder("other")});
  run(own, 1);
  EXPECT_EQ(made_, 1);
  EXPECT_EQ(own.taken(), 1);
  EXPECT_EQ(cases("own").size(), 1u);
}

TEST_F(KeptRunsOf, KeepsWhatTheGuardStoppedButNothingInterrupted) {
  KeptRuns kept(folder("a"), {});
  status_ = RunStatus::interrupted;
  run(kept, 1);
  EXPECT_FALSE(fs::exists(folder("a")));
  status_ = RunStatus::stopped_by_guard;
  run(kept, 1);
  EXPECT_EQ(run(kept, 1).status, RunStatus::stopped_by_guard);
  EXPECT_EQ(made_, 2);
}

TEST_F(KeptRunsOf, ADamagedRunIsMadeAgainAndMended) {
  KeptRuns kept(folder("a"), {});
  run(kept, 1);
  fs::resize_file(cases("a").at(0), 100);
  run(kept, 1);
  EXPECT_EQ(made_, 2);
  run(kept, 1);
  EXPECT_EQ(made_, 2);
}

TEST_F(KeptRunsOf, ARunUnderAnotherName) {
  KeptRuns kept(folder("a"), {});
  run(kept, 1);
  run(kept, 2);
  const std::vector<fs::path> files = cases("a");
  ASSERT_EQ(files.size(), 2u);
  fs::copy_file(files[0], files[1], fs::copy_options::overwrite_existing);
  run(kept, 1), run(kept, 2);
  EXPECT_EQ(made_, 3) << "is that of its own name alone";
}

TEST_F(KeptRunsOf, ARunThatCannotBeWrittenIsGivenAndSaid) {
  files_.write("a", "no folder");
  KeptRuns kept(folder("a"), {});
  EXPECT_FALSE(run(kept, 1).events.empty());
  EXPECT_NE(kept.not_kept().find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace vibrosow
