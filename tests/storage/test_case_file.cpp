#include "storage/case_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

Scene small_scene() {
  Scene scene;
  scene.lots = {{"a", 6e-3, 2e-4, Shape::ball, 1}};
  scene.tray.name = "tray";
  scene.tray.length = 0.1, scene.tray.height = 0.1;
  scene.tray.holes.resize(3);
  scene.run.duration = 10;
  return scene;
}

Snapshot snapshot_of_three() {
  Snapshot s;
  s.time = 0.25, s.x = {1, 2, 3}, s.lot = {0, 0, 0}, s.id = {0, 1, 4};
  for (std::vector<double>* array : {&s.y, &s.vx, &s.vy, &s.omega, &s.radius, &s.mass, &s.area, &s.start_x, &s.start_y})
    *array = {0.1, 0.2, 0.3};
  return s;
}

/// With something in every field.
Run made_up_run() {
  Run run;
  run.status = RunStatus::stopped_by_guard;
  run.stop_reason = "too deep", run.end_reason = "a pause",
  run.warnings = {{DoubtKind::guard_warned, "one"}, {DoubtKind::feeder_behind, "two"}};
  run.outside_the_model = true;
  run.random_seed = 7, run.dt = 1.5e-5, run.steps = 12, run.end_time = 1.8e-4, run.grain_steps = 120;
  run.force_evaluations = 77, run.slip_speed_raised = 3, run.let_pass = {4, 5, 6};
  run.max_relative_overlap = 0.01, run.tray_empty_since = 0.5;
  run.tray_at_begin = 8, run.tray_at_end = 9;
  run.energy = {1, 2, 3, 4, 5, 6, 7};
  run.balance = {10, 4, 3, 2, 1};
  for (int k = 0; k < 100; ++k) run.events.push_back({0.1 * k, 1 + k % 3, 0, k, 2e-4, 0.01 * k, 1.5, 0.002 * k});
  run.snapshots = {snapshot_of_three()};
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
  EXPECT_EQ(read.tray_at_begin, 8);
  EXPECT_EQ(read.tray_at_end, 9);
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

std::string message_of(const std::string& bytes) {
  try {
    read_case(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CaseFile, BehindARightChecksumNoIndexCountOrTimeIsBelieved) {
  const std::string impossible = "the case does not fit: no run of its scene is such";
  const auto refused = [&](auto change) {
    vibrosow::Run run = made_up_run();
    change(run);
    EXPECT_EQ(message_of(case_bytes(identity, run)), impossible);
  };
  refused([](auto& run) { run.events[3].lot = 1; });
  refused([](auto& run) { run.events[3].lot = -1; });
  refused([](auto& run) { run.events[3].hole = 4; });
  refused([](auto& run) { run.events[3].time = 1e308; });
  refused([](auto& run) { run.balance.counted = -1; });
  refused([](auto& run) { ++run.balance.put_in; });
  refused([](auto& run) { run.balance.inside = run.balance.put_in = std::int64_t{1} << 62; });
  for (const double mass : {-1.0, 0.0, 1e300, std::nan(""), HUGE_VAL})
    refused([&](auto& run) { run.events[3].mass = mass; });
  refused([](auto& run) { run.events[3].speed = -1; });
  refused([](auto& run) { run.events[3].x = HUGE_VAL; });
  refused([](auto& run) { run.max_relative_overlap = -3.1e231; });
  refused([](auto& run) { run.status = static_cast<RunStatus>(7); });
  refused([](auto& run) { run.end_time = 1e300; });
  for (const double dt : {0.0, 1.4e-5, 1e-300}) refused([&](auto& run) { run.dt = dt; });
  refused([](auto& run) { run.steps = 13; });
  refused([](auto& run) { run.grain_steps = 12 * run.balance.put_in + 1; });
  refused([](auto& run) { run.random_seed = 8; });
  refused([](auto& run) { run.snapshots[0].lot[2] = 9; });
  refused([](auto& run) { run.snapshots[0].vy.pop_back(); });
  refused([](auto& run) { run.snapshots[0].x[0] = std::nan(""); });
  refused([](auto& run) { run.snapshots[0].radius[0] = 0; });
  EXPECT_EQ(message_of(case_bytes("no scene", made_up_run())), "the case does not fit: its scene is none");
}

TEST(CaseFile, ItsTextsAreShownAsTheyMayBe) {
  vibrosow::Run run = made_up_run();
  run.stop_reason = "\x1b[31mred";
  run.warnings = {{DoubtKind::guard_warned, std::string("\xe2\x80\xae") + "backwards"}};
  const vibrosow::Run read = read_case(case_bytes(identity, run)).run;
  EXPECT_EQ(read.stop_reason, "\\x1b[31mred");
  EXPECT_EQ(read.warnings[0].text, "\\xe2\\x80\\xaebackwards");
}

/// A few kilobytes that become a gigabyte are given up long before, and what they become is not kept.
TEST(CaseFile, WhatUnpacksWithoutEndIsRefused) {
  vibrosow::Run run = made_up_run();
  run.stop_reason = std::string(std::size_t{1} << 27, 'x');
  const std::string bytes = case_bytes(identity, run);
  EXPECT_LT(bytes.size(), 100'000u);
  EXPECT_EQ(message_of(bytes), "the case does not fit: it is damaged");
}

TEST(CaseFile, SaysWhatItIsOf) {
  EXPECT_EQ(read_case(case_bytes(identity, made_up_run())).identity, identity);
}

}  // namespace
}  // namespace vibrosow
