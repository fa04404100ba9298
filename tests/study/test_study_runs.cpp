#include "study/study_runs.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <set>

#include "input/read_scene.hpp"
#include "result/results_version.hpp"
#include "scene/input_error.hpp"
#include "simulation/checkpoint.hpp"
#include "study/planned_study.hpp"
#include "support/study_files.hpp"

namespace {
int error_of_fsync = 0;  // 0: as it is
}

/// In the place of libc's: a full disk may show only here.
extern "C" int fsync(int descriptor) {
  if (error_of_fsync == 0) return static_cast<int>(syscall(SYS_fsync, descriptor));
  errno = error_of_fsync;
  return -1;
}

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

/// A sweep's folder and how often something was really run.
class StudyRunsOf : public testing::Test {
 protected:
  std::vector<WantedRun> wanted(std::initializer_list<std::uint64_t> random_seeds) const {
    std::vector<WantedRun> runs;
    for (const std::uint64_t seed : random_seeds)
      runs.push_back({&scene_, seed, case_name(case_identity(model_.scene, seed))});
    return runs;
  }
  BatchSummary make(StudyRuns& runs, std::initializer_list<std::uint64_t> random_seeds, bool retry = false) {
    BatchOptions options;
    options.jobs = 1, options.retry = retry;
    return runs.make(wanted(random_seeds), simulator_, options);
  }
  vibrosow::Run kept(const StudyRuns& runs, std::uint64_t random_seed) const {
    vibrosow::Run none;
    none.status = RunStatus::interrupted;
    return runs.kept()(name_of_run(scene_, random_seed)).value_or(none);
  }
  fs::path folder(const std::string& name) const { return files_.seeder().parent_path() / name; }
  std::vector<fs::path> cases(const std::string& name) const {
    std::vector<fs::path> found;
    if (!fs::exists(folder(name))) return found;
    for (const auto& entry : fs::recursive_directory_iterator(folder(name)))
      if (entry.path().extension() == ".case") found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
  }

  StudyFiles files_;
  Scene scene_ = read_scene(files_.seeder());
  Model model_ = prepare(scene_);
  int made_ = 0;
  RunStatus status_ = RunStatus::finished;
  Simulator simulator_ = [this](const Model& model, const SimulationOptions& options) {
    ++made_;
    vibrosow::Run run = quick_run(model, options);
    run.status = status_;
    return run;
  };
};

TEST_F(StudyRunsOf, MakesNoRunTwice) {
  StudyRuns first(folder("a"));
  EXPECT_EQ(make(first, {1, 2}).made, 2);
  const vibrosow::Run before = kept(first, 1);
  StudyRuns again(folder("a"));
  const BatchSummary batch = make(again, {1, 2, 3});
  EXPECT_EQ(batch.made, 1);
  EXPECT_EQ(batch.there, 2);
  EXPECT_EQ(made_, 3);
  ASSERT_FALSE(before.events.empty());
  EXPECT_EQ(kept(again, 1).events.back().time, before.events.back().time);
}

TEST_F(StudyRunsOf, ARunOfAnotherVersionIsMadeAgain) {
  StudyRuns first(folder("a"));
  make(first, {1});
  const fs::path kept_case = cases("a").at(0);
  std::ifstream file(kept_case, std::ios::binary);
  const Case today = read_case(std::string(std::istreambuf_iterator<char>(file), {}));
  const std::string of_today = fmt::format(R"("results_version":{},)", results_version);
  std::string before = today.identity;
  ASSERT_NE(before.find(of_today), std::string::npos);
  before.replace(before.find(of_today), of_today.size(), fmt::format(R"("results_version":{},)", results_version - 1));
  for (const std::string& name : {case_name(before), kept_case.stem().string()}) {  // as it was, and renamed
    const fs::path old_case = folder("b") / "cases" / name.substr(0, 2) / (name + ".case");
    fs::create_directories(old_case.parent_path());
    std::ofstream(old_case, std::ios::binary) << case_bytes(before, today.run);
  }
  StudyRuns again(folder("b"));
  EXPECT_EQ(make(again, {1}).made, 1);
}

TEST_F(StudyRunsOf, WhatWasThereIsNoMeasureOfWhatIsLeft) {
  StudyRuns runs(folder("a"));
  make(runs, {1, 2});
  std::vector<std::pair<double, double>> told;
  BatchOptions options;
  options.jobs = 1;
  options.progress = [&](double done, double there) { told.emplace_back(done, there); };
  runs.make(wanted({1, 2, 3, 4}), simulator_, options);
  const std::vector<std::pair<double, double>> wanted_to_hear{{0.25, 0.25}, {0.5, 0.5}, {0.75, 0.5}, {1, 0.5}};
  EXPECT_EQ(told, wanted_to_hear);
}

TEST_F(StudyRunsOf, TakesWhatOtherSweepsMadeAndKeepsItToo) {
  StudyRuns other(folder("other"));
  make(other, {1});
  StudyRuns own(folder("own"), {folder("other")});
  EXPECT_EQ(make(own, {1}).there, 1);
  EXPECT_EQ(made_, 1);
  EXPECT_EQ(cases("own").size(), 1u);
}

TEST_F(StudyRunsOf, KeepsWhatFailedButNothingInterrupted) {
  StudyRuns runs(folder("a"));
  status_ = RunStatus::interrupted;
  EXPECT_EQ(make(runs, {1}).interrupted, 1);
  EXPECT_TRUE(cases("a").empty());
  status_ = RunStatus::stopped_by_guard;
  make(runs, {1});
  EXPECT_EQ(make(runs, {1}).made, 0);
  EXPECT_EQ(kept(runs, 1).status, RunStatus::stopped_by_guard);
  EXPECT_EQ(CaseFolder(folder("a")).pack(), 0u) << "it may be made anew";
  status_ = RunStatus::finished;
  EXPECT_EQ(make(runs, {1}, true).made, 1) << "is to be tried again";
  EXPECT_EQ(kept(runs, 1).status, RunStatus::finished);
  EXPECT_EQ(make(runs, {1}, true).made, 0);
}

TEST_F(StudyRunsOf, ASimulatorThatKeepsMakesNoRunTwice) {
  SimulationOptions options;
  options.random_seed = 3;
  StudyRuns runs(folder("a"));
  status_ = RunStatus::interrupted;
  runs.caching_simulator(simulator_)(model_, options);
  EXPECT_TRUE(cases("a").empty());
  status_ = RunStatus::finished;
  const vibrosow::Run made = runs.caching_simulator(simulator_)(model_, options);
  EXPECT_EQ(made_, 2);
  StudyRuns again(folder("a"));
  const vibrosow::Run kept = again.caching_simulator(simulator_)(model_, options);
  EXPECT_EQ(made_, 2);
  ASSERT_FALSE(made.events.empty());
  EXPECT_EQ(kept.events.back().time, made.events.back().time);
  EXPECT_EQ(kept.wall_time, 0) << "tells a run that was kept";
  options.random_seed = 4;
  EXPECT_EQ(again.caching_simulator(simulator_)(model_, options).random_seed, 4u);
  EXPECT_EQ(made_, 3);
}

TEST_F(StudyRunsOf, WhatCannotBeginIsKeptWithItsReason) {
  simulator_ = [](const Model&, const SimulationOptions&) -> vibrosow::Run { throw InputError("does not fit"); };
  StudyRuns runs(folder("a"));
  EXPECT_EQ(make(runs, {1}).made, 1);
  EXPECT_EQ(kept(runs, 1).status, RunStatus::refused);
  EXPECT_EQ(kept(runs, 1).stop_reason, "does not fit");
}

TEST_F(StudyRunsOf, ADamagedRunIsMadeAgainAndMended) {
  StudyRuns runs(folder("a"));
  make(runs, {1});
  fs::resize_file(cases("a").at(0), 100);
  EXPECT_EQ(kept(runs, 1).status, RunStatus::interrupted);
  EXPECT_EQ(make(runs, {1}).made, 1);
  EXPECT_EQ(make(runs, {1}).made, 0);
}

TEST_F(StudyRunsOf, ARunUnderAnotherNameIsNotTaken) {
  StudyRuns runs(folder("a"));
  make(runs, {1, 2});
  const std::vector<fs::path> files = cases("a");
  ASSERT_EQ(files.size(), 2u);
  fs::copy_file(files[0], files[1], fs::copy_options::overwrite_existing);
  const std::set<RunStatus> of_both = {kept(runs, 1).status, kept(runs, 2).status};
  EXPECT_EQ(of_both, (std::set<RunStatus>{RunStatus::finished, RunStatus::interrupted}));
  EXPECT_EQ(make(runs, {1, 2}).made, 1) << "in whose place it lies";
  EXPECT_EQ(make(runs, {1, 2}).made, 0);
}

TEST_F(StudyRunsOf, ARunPackedUnderAnotherNameIsMadeAgain) {
  StudyRuns runs(folder("a"));
  make(runs, {1, 2});
  const CaseFolder cases_folder(folder("a"));
  const std::string name = wanted({2}).front().name;
  const std::vector<fs::path> files = cases("a");
  const fs::path of_one = files.at(files.at(0).stem() == name ? 1 : 0);
  std::ifstream file(of_one, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  cases_folder.remove(name);
  Segments(PathInFolder(folder("a")) / "segments").write({{name, bytes}});
  EXPECT_FALSE(cases_folder.has(name));
  EXPECT_EQ(make(runs, {1, 2}).made, 1);
  EXPECT_TRUE(cases_folder.has(name));
  EXPECT_EQ(make(runs, {1, 2}).made, 0);
  fs::create_directories(folder("a") / "aa");
  fs::copy_file(of_one, folder("a") / "aa" / (std::string(32, 'a') + ".case"));
  EXPECT_EQ(cases_folder.pack(), 2u) << "none that lies under another name";
}

TEST_F(StudyRunsOf, ARunThatCannotBeWrittenIsInMemoryUntilItCan) {
  StudyRuns runs(folder("a"));
  error_of_fsync = ENOSPC;
  make(runs, {1});
  EXPECT_EQ(kept(runs, 1).status, RunStatus::finished);
  EXPECT_THAT(runs.not_kept(), testing::HasSubstr("cannot be written"));
  BatchOptions options;
  options.jobs = 1, options.wait_for_room = 0;
  EXPECT_EQ(runs.make(wanted({2}), simulator_, options).interrupted, 1) << "no other is begun";
  options.wait_for_room = 600;
  options.on_not_kept = [&](const std::string&) { error_of_fsync = 0; };  // then there is room
  EXPECT_EQ(runs.make(wanted({2}), simulator_, options).made, 1);
  EXPECT_EQ(runs.not_kept(), "");
  EXPECT_EQ(cases("a").size(), 2u);
}

TEST_F(StudyRunsOf, OnlyRoomIsWaitedFor) {
  StudyRuns runs(folder("a"));
  BatchOptions options;
  options.jobs = 1, options.wait_for_room = 600;
  options.on_not_kept = [&](const std::string& reason) { ADD_FAILURE() << reason; };
  error_of_fsync = EACCES;
  EXPECT_EQ(runs.make(wanted({1, 2}), simulator_, options).made, 1);
  error_of_fsync = 0;
  EXPECT_THAT(runs.not_kept(), testing::HasSubstr("cannot be written: Permission denied"));
}

TEST_F(StudyRunsOf, WithoutARightToWriteNoRunIsBegun) {
  files_.write("a", "no folder");
  StudyRuns runs(folder("a"));
  EXPECT_THROW(make(runs, {1}), CannotWrite);
  EXPECT_EQ(made_, 0);
}

TEST_F(StudyRunsOf, AnotherRunOfTheSameNameIsAnError) {
  StudyRuns first(folder("a")), second(folder("b"));
  make(first, {1});
  simulator_ = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = quick_run(model, options);
    run.grain_steps += 1;
    return run;
  };
  make(second, {1});
  fs::copy(folder("b"), folder("both"), fs::copy_options::recursive);
  CaseFolder both(folder("both"));
  const vibrosow::Run other = kept(first, 1);
  EXPECT_THROW(both.keep(case_identity(model_.scene, 1), other), InputError);
  EXPECT_NO_THROW(both.keep(case_identity(model_.scene, 1), kept(second, 1)));
}

TEST_F(StudyRunsOf, ARunThatAnotherProcessMakesIsTakenOverOnlyWhenItIsSilent) {
  const std::string name = wanted({1}).front().name;
  RunLeases other(folder("a") / "running");
  ASSERT_TRUE(other.claim(name));  // of this process, which lives, and never beats
  StudyRuns runs(folder("a"), {}, std::chrono::milliseconds(300));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(make(runs, {1, 2}).made, 2);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(300));
}

TEST_F(StudyRunsOf, ARunOfADeadProcessIsTakenOverAtOnce) {
  const std::string name = wanted({1}).front().name;
  RunLeases other(folder("a") / "running");
  ASSERT_TRUE(other.claim(name));
  std::ifstream in(folder("a") / "running" / name);
  std::string note(std::istreambuf_iterator<char>(in), {});
  const std::size_t at = note.find("\"started\":\"") + 11;
  note.insert(at, "1");  // as if a process of this number had been started at another time
  std::ofstream(folder("a") / "running" / name) << note;
  StudyRuns runs(folder("a"), {}, std::chrono::hours(1));
  EXPECT_EQ(make(runs, {1}).made, 1);
}

TEST_F(StudyRunsOf, AnInterruptedRunGoesOnFromWhereItWas) {
  std::atomic<bool> interrupt = false;
  BatchOptions options;
  options.jobs = 1, options.save_every = 1e9;
  options.interrupt = &interrupt;
  options.progress = [&](double fraction, double) { interrupt = interrupt || fraction > 0.3; };
  std::int64_t begun_at = -1;
  simulator_ = [&](const Model& model, const SimulationOptions& simulation) {
    begun_at = simulation.from ? simulation.from->step : 0;
    return run_model(model, simulation);
  };
  scene_.run.duration = 0.2, scene_.run.measure_from = 0;
  model_ = prepare(scene_);
  StudyRuns cut(folder("cut")), whole(folder("whole"));
  EXPECT_EQ(cut.make(wanted({1}), simulator_, options).interrupted, 1);
  EXPECT_EQ(begun_at, 0);
  interrupt = false, options.progress = nullptr;
  EXPECT_EQ(cut.make(wanted({1}), simulator_, options).made, 1);
  EXPECT_GT(begun_at, 0);
  whole.make(wanted({1}), simulator_, options);
  std::ifstream a(cases("cut").at(0)), b(cases("whole").at(0));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(a), {}), std::string(std::istreambuf_iterator<char>(b), {}));
  EXPECT_TRUE(fs::is_empty(folder("cut") / "checkpoints"));
}

TEST_F(StudyRunsOf, ADamagedCheckpointIsLeftOut) {
  const std::string name = wanted({1}).front().name;
  fs::create_directories(folder("a") / "checkpoints");
  std::ofstream(folder("a") / "checkpoints" / (name + ".12.checkpoint")) << "no checkpoint";
  StudyRuns runs(folder("a"));
  EXPECT_EQ(make(runs, {1}).made, 1);
}

TEST_F(StudyRunsOf, PackedRunsAreFoundAndMended) {
  StudyRuns runs(folder("a"));
  make(runs, {1, 2, 3});
  EXPECT_EQ(CaseFolder(folder("a")).pack(4), 0u);
  EXPECT_EQ(CaseFolder(folder("a")).pack(3), 3u);
  EXPECT_TRUE(cases("a").empty());
  EXPECT_EQ(make(runs, {1, 2, 3, 4}).made, 1) << "also by who looked before they were packed";
  const CaseFolder fresh(folder("a"));
  EXPECT_EQ(fresh.names().size(), 4u);
  for (const std::string& one : fresh.names()) EXPECT_TRUE(fresh.named(one)) << one;
  const auto segment = *fs::directory_iterator(folder("a") / "segments");
  fs::resize_file(segment.path(), segment.file_size() - 10);
  EXPECT_EQ(make(runs, {1, 2, 3}).made, 1) << "the last is cut off";
}

TEST(PlannedStudy, IsWhatItWasWhateverBecomesOfItsFiles) {
  const StudyFiles files;
  const fs::path study = files.write(
      "study.toml", "base = \"seeder.toml\"\nreplicates = 2\n[vary]\n\"run.duration\" = [\"1 s\", \"2 s\"]\n");
  const PlannedStudy planned = plan_study(study, {"run.measure_from=0 s"}, 5);
  ASSERT_EQ(planned.plan.runs.size(), 4u);
  const fs::path out = files.seeder().parent_path() / "out";
  const std::string name = freeze_plan(out, planned.plan);
  EXPECT_EQ(current_plan(out), name);
  files.write("study.toml", "base = \"seeder.toml\"\nreplicates = 3\n");
  fs::remove(files.seeder());
  const PlannedStudy read = study_of_plan(read_plan(out));
  EXPECT_EQ(read.study.layouts.size(), 2u);
  EXPECT_EQ(read.plan.runs.at(3).random_seed, 6u);
  EXPECT_EQ(read.plan.runs.at(3).name, planned.plan.runs.at(3).name);
  EXPECT_GT(read.plan.runs.at(3).grain_steps, read.plan.runs.at(1).grain_steps);
}

TEST(PlannedStudy, ShardsAreSharesOfEqualCost) {
  StudyPlan plan;
  for (int k = 0; k < 103; ++k) plan.runs.push_back({std::to_string(k), 1, 1, 100.0 + 7 * (k * 37 % 50)});
  std::multiset<std::size_t> all;
  std::vector<double> costs;
  for (std::size_t k = 1; k <= 8; ++k) {
    double cost = 0;
    for (const std::size_t run : shard_of(plan, k, 8)) {
      all.insert(run);
      cost += plan.runs[run].grain_steps;
    }
    costs.push_back(cost);
  }
  EXPECT_EQ(all.size(), 103u);
  EXPECT_EQ(std::set<std::size_t>(all.begin(), all.end()).size(), 103u);
  EXPECT_LT(std::ranges::max(costs) / std::ranges::min(costs), 1.1);
}

TEST(PlannedStudy, IsNoneOfASearch) {
  StudyPlan plan;
  plan.question = OptimiseQuestion{{"rate", "power"}};
  EXPECT_THAT([&] { study_of_plan(plan); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("chooses its layouts as it goes")));
}

TEST(PlannedStudy, ADamagedPlanIsRefused) {
  const StudyFiles files;
  const fs::path out = files.seeder().parent_path() / "out";
  EXPECT_THROW(read_plan(out), InputError);
  const std::string name =
      freeze_plan(out, {"study.toml", {}, 1, {{"a.csv", "\xff\n"}}, {{std::string(32, 'a'), 1, 1, 5}}});
  EXPECT_EQ(read_plan(out).files.at("a.csv"), "\xff\n");
  std::ofstream(plan_file(out, name + ".json").path(), std::ios::app) << " ";
  EXPECT_THROW(read_plan(out), InputError);
}

}  // namespace
}  // namespace vibrosow
