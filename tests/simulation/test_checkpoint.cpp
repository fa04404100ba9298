// A run that is cut anywhere and restored goes on as if it had not been: compared with ==, on other threads and with
// other vector instructions.
#include "simulation/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "simulation/simulation.hpp"
#include "support/bench.hpp"

namespace vibrosow {
namespace {

/// Everything a report is made of, as bits.
std::vector<double> outcome(const Simulation& simulation) {
  const Run run = simulation.result();
  const Grains& g = simulation.grains();
  std::vector<double> all;
  for (const auto* array : {&g.x, &g.y, &g.vx, &g.vy, &g.omega, &g.angle})
    all.insert(all.end(), array->begin(), array->end());
  for (const OutflowEvent& e : run.events)
    all.insert(all.end(), {e.time, static_cast<double>(e.hole), static_cast<double>(e.grain), e.x, e.speed});
  for (const Snapshot& s : run.snapshots) all.insert(all.end(), s.start_x.begin(), s.start_x.end());
  const EnergyAccount& e = run.energy;
  all.insert(all.end(), {e.kinetic, e.potential, e.elastic, e.wall_work, e.inserted, e.removed, e.made_by_numerics});
  const Balance& b = run.balance;
  for (const std::int64_t count :
       {b.put_in, b.inside, b.counted, b.spilled, b.lost, run.grain_steps, run.force_evaluations})
    all.push_back(static_cast<double>(count));
  all.insert(all.end(), {run.max_relative_overlap, run.tray_empty_since, run.end_time,
                         static_cast<double>(run.tray_at_begin), static_cast<double>(run.tray_at_end)});
  for (const DrawnSeeds& drawn : run.drawn) all.insert(all.end(), {static_cast<double>(drawn.seeds), drawn.mass});
  return all;
}

Scene shaken_tray() {
  Scene scene;
  scene.lots = {{"a", 6e-3, 2e-4, Shape::ball, 0.6}, {"b", 5e-3, 1.2e-4, Shape::ball, 0.4}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.4, 0.5, 0.1, 0};
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.rolling = Rolling::spring;
  scene.tray.name = "tray";
  scene.tray.length = 0.12, scene.tray.height = 0.2;
  scene.tray.holes = {{0.03, 0.02, 0}, {0.09, 0.02, 0.04}};
  scene.tray.fill = Fill{120, Packing::layers, 1e-3, true};
  scene.tray.motion = HarmonicMotion{0.3, 4e-3, 12, 0.02};
  scene.record = Record{{0, 0.03, 0.06}, 0.01};
  scene.run.duration = 0.1;
  return scene;
}

void expect_resumes(const char* what, const Scene& scene, double dt) {
  const Model model = with_step(prepare(scene), dt);
  Simulation whole(model, 5);
  const auto steps = static_cast<std::int64_t>(0.08 / dt);
  const std::int64_t cut = steps * 45 / 100 + 7;
  whole.steps(cut);
  const std::string bytes = save(model, whole.state());
  whole.steps(steps - cut);
  ASSERT_FALSE(whole.guard().stop_reason()) << what << ": " << *whole.guard().stop_reason();
  for (const int threads : {1, 3}) {
    Simulation resumed(
        model, restore(model, bytes),
        {.instructions = threads == 1 ? InstructionSet::generic : best_instruction_set(), .threads = threads});
    resumed.steps(steps - cut);
    EXPECT_EQ(outcome(resumed), outcome(whole)) << what << ", " << threads << " threads";
    EXPECT_TRUE(save(model, resumed.state()) == save(model, whole.state())) << what;
  }
}

TEST(Checkpoint, GoesOnToTheLastBitWithEverySchemeAndEffect) {
  Scene scene = shaken_tray();
  expect_resumes("springs, rolling, feeding, gate, record", scene, 2e-5);
  scene.numerics.integrator = Integrator::rk2_midpoint;
  expect_resumes("midpoint scheme", scene, 2e-5);
  scene.numerics.integrator = Integrator::gear5;
  expect_resumes("Gear's scheme", scene, 1e-5);
  scene = shaken_tray();
  scene.contact.law = Law::hertz;
  scene.contact.youngs_modulus = 1e7;
  expect_resumes("Hertz", scene, 1e-5);
  scene = shaken_tray();
  scene.tray.sides = Sides::periodic;
  scene.tray.fill->keep = false;
  scene.tray.rain = Rain{2000, 0, 0.12, 0.15, 0.01, never};
  expect_resumes("periodic sides, rain", scene, 2e-5);
  scene.lots[1].sizes = {SizeDistribution::Kind::table, 0, 0, 0, 0, {4e-3, 6e-3}, {0.9, 0.1}};
  expect_resumes("a table of sizes", scene, 2e-5);
}

TEST(Checkpoint, GoesOnToTheLastBitWithClumps) {
  Scene scene = shaken_tray();
  scene.lots = {{"dipole", 0.01, 2e-4, Shape::clump, 1.0}};
  scene.lots[0].discs = dipole(4e-3, 6e-3);
  scene.lots[0].diameter = 2 * holding_radius(scene.lots[0].discs);
  scene.lots[0].gyration2 = plate_of(scene.lots[0].discs).gyration2;
  scene.tray.fill->count = 40;
  for (const Integrator scheme : {Integrator::velocity_verlet, Integrator::rk2_midpoint}) {
    scene.numerics.integrator = scheme;
    expect_resumes("clumps", scene, 1e-5);
  }
}

TEST(Checkpoint, RemembersWhatWasDrivenFromOutside) {
  Scene scene = shaken_tray();
  scene.tray.holes[1].open_at = 1000;
  const Model model = with_step(prepare(scene), 2e-5);
  Simulation whole(model, 5);
  whole.steps(1500);
  whole.open_gate("tray", 2);
  whole.set_motion(0, HarmonicMotion{0, 2e-3, 20, 0});
  whole.steps(500);
  Simulation resumed(model, restore(model, save(model, whole.state())));
  whole.steps(1500), resumed.steps(1500);
  EXPECT_EQ(outcome(resumed), outcome(whole));
  EXPECT_TRUE(resumed.state().vessels.motion[0].has_value());
}

std::string refusal(const Model& model, const std::string& bytes) {
  try {
    restore(model, bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Checkpoint, WhatDoesNotFitIsRefusedWithItsReason) {
  using testing::HasSubstr;
  Scene scene = shaken_tray();
  const Model model = with_step(prepare(scene), 2e-5);
  Simulation run(model, 5);
  run.steps(50);
  const std::string bytes = save(model, run.state());
  EXPECT_THAT(refusal(model, "something else"), HasSubstr("no checkpoint"));
  EXPECT_THAT(refusal(model, bytes.substr(0, bytes.size() / 2)), HasSubstr("damaged"));
  EXPECT_THAT(refusal(model, bytes.substr(0, 22)), HasSubstr("too early"));
  std::string changed = bytes;
  changed[changed.size() / 2] ^= 1;
  EXPECT_THAT(refusal(model, changed), HasSubstr("damaged"));
  scene.tray.holes[0].width = 0.021;
  EXPECT_THAT(refusal(with_step(prepare(scene), 2e-5), bytes), HasSubstr("/tray/holes/0/width_m"));
  Model finer = model;
  finer.step.dt = 1e-5;
  EXPECT_THAT(refusal(finer, bytes), HasSubstr("step"));
  std::string other_version = bytes;
  other_version[21] = 77;
  EXPECT_THAT(refusal(model, other_version), HasSubstr("version"));
}

}  // namespace
}  // namespace vibrosow
