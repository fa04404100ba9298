#include "storage/case_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

Scene small_scene() {
  Scene scene;
  scene.lots = {{"a", 6e-3, 2e-4, Shape::ball, 1}};
  scene.tray.name = "tray";
  scene.tray.length = 0.1, scene.tray.height = 0.1;
  scene.run.duration = 1;
  return scene;
}

/// With something in every field.
Run made_up_run() {
  Run run;
  run.status = RunStatus::stopped_by_guard;
  run.stop_reason = "too deep", run.end_reason = "a pause", run.warnings = {"one", "two"};
  run.outside_the_model = true;
  run.random_seed = 7, run.dt = 1.5e-5, run.steps = 12, run.end_time = 1.8e-4, run.grain_steps = 120;
  run.force_evaluations = 77, run.slip_speed_raised = 3, run.let_pass = {4, 5, 6};
  run.max_relative_overlap = 0.01, run.tray_empty_since = 0.5;
  run.energy = {1, 2, 3, 4, 5, 6, 7};
  run.balance = {10, 4, 3, 2, 1};
  for (int k = 0; k < 100; ++k) run.events.push_back({0.1 * k, 1 + k % 3, 0, k, 2e-4, 0.01 * k, 1.5, 0.002 * k});
  Snapshot snapshot;
  snapshot.time = 0.25, snapshot.x = {1, 2, 3}, snapshot.lot = {0, 0, 0};
  run.snapshots = {snapshot};
  run.wall_time = 3;
  return run;
}

const std::string identity = case_identity(small_scene(), 7);

TEST(CaseFile, GivesTheRunBackWithoutItsTimes) {
  const vibrosow::Run run = made_up_run(), read = read_case(case_bytes(identity, run)).run;
  EXPECT_EQ(case_bytes(identity, read), case_bytes(identity, run));
  EXPECT_EQ(read.status, RunStatus::stopped_by_guard);
  EXPECT_EQ(read.stop_reason, "too deep");
  EXPECT_EQ(read.warnings, run.warnings);
  EXPECT_EQ(read.let_pass.energy_accounts, 6);
  EXPECT_EQ(read.energy.made_by_numerics, 7);
  EXPECT_EQ(read.balance.lost, 1);
  EXPECT_EQ(read.max_relative_overlap, 0.01);
  EXPECT_EQ(read.steps, 12);
  EXPECT_EQ(read.force_evaluations, 77);
  ASSERT_EQ(read.events.size(), 100u);
  EXPECT_EQ(read.events[42].z, run.events[42].z);
  EXPECT_EQ(read.snapshots.at(0).x, run.snapshots[0].x);
  EXPECT_EQ(read.wall_time, 0);
}

TEST(CaseFile, IsNamedByWhatItIsOf) {
  const auto name = [](const Scene& scene, std::uint64_t seed) { return case_name(case_identity(scene, seed)); };
  Scene other = small_scene();
  other.run.duration = 2;
  EXPECT_EQ(name(small_scene(), 7), name(small_scene(), 7));
  EXPECT_NE(name(small_scene(), 7), name(small_scene(), 8));
  EXPECT_NE(name(small_scene(), 7), name(other, 7));
  EXPECT_THAT(name(other, 7), testing::MatchesRegex("[0-9a-f]{32}"));
}

TEST(CaseFile, EveryFlippedBitAndEveryLengthIsNoticed) {
  const std::string bytes = case_bytes(identity, made_up_run());
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << at % 8));
    EXPECT_THROW(read_case(flipped), InputError) << at;
    EXPECT_THROW(read_case(bytes.substr(0, at)), InputError) << at;
  }
}

TEST(CaseFile, SaysWhatItIsOf) {
  EXPECT_EQ(read_case(case_bytes(identity, made_up_run())).identity, identity);
}

}  // namespace
}  // namespace vibrosow
