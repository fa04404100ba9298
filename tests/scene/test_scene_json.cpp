#include "scene/scene_json.hpp"

#include "input/input_file.hpp"
#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "scene/list_limits.hpp"
#include "study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace vibrosow {
namespace {

using Kind = SizeDistribution::Kind;

Scene example() {
  Scene scene;
  scene.lots = {{"pea", 0.007, 2e-4, Shape::ball, 1}};
  scene.tray.name = "tray";
  scene.tray.length = 0.1;
  scene.tray.holes = {{0.05, 0.02}};
  scene.tray.fill = Fill{100, Packing::layers, 1e-3, false};
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  scene.hopper = scene.tray;
  return scene;
}

void use_spring(Scene& scene) {
  scene.contact.friction_model = FrictionModel::spring;
}

void use_hertz(Scene& scene) {
  scene.contact.law = Law::hertz_viscous;
}

TEST(SceneJson, EveryChangeHasItsOwnText) {
  const std::vector<std::function<void(Scene&)>> changes = {
      [](Scene& s) { s.title = "another"; },
      [](Scene& s) { s.tray.name = "trough"; },
      [](Scene& s) { s.lots[0].diameter *= 1 + 1e-15; },
      [](Scene& s) { s.lots[0].mass *= 2; },
      [](Scene& s) { s.lots[0].shape = Shape::disc; },
      [](Scene& s) { s.lots[0].number_fraction = 0.5; },
      [](Scene& s) { s.lots[0].shape = Shape::clump; },
      [](Scene& s) { s.lots[0].sizes = {Kind::uniform, 0.007, 0, 0.006, 0.008, {}, {}}; },
      [](Scene& s) { s.lots[0].sizes = {Kind::normal, 0.007, 0.001, 0.004, 0.01, {}, {}}; },
      [](Scene& s) {
        s.lots[0].sizes = {Kind::table, 0.007, 0, 0, 0, {0.006, 0.008}, {0.5, 0.5}};
      },
      [](Scene& s) { s.contact.shell_compression *= 2; },
      [](Scene& s) { s.contact.seed.friction = 0.1; },
      [](Scene& s) { s.contact.seed.restitution = 0.9; },
      [](Scene& s) { s.contact.wall.friction = 0.1; },
      [](Scene& s) { s.contact.wall.restitution = 0.9; },
      [](Scene& s) { s.contact.slip_speed *= 2; },
      [](Scene& s) { s.contact.drag = 1; },
      [](Scene& s) { s.contact.rotation = false; },
      [](Scene& s) { s.contact.friction_arm = FrictionArm::rim; },
      [](Scene& s) { s.tray.origin.x() = 1; },
      [](Scene& s) { s.tray.origin.y() = 1; },
      [](Scene& s) { s.tray.length *= 2; },
      [](Scene& s) { s.tray.height = 1; },
      [](Scene& s) { s.tray.tilt = 0.1; },
      [](Scene& s) { s.tray.funnel = 0.1; },
      [](Scene& s) { s.tray.depth = 0.1; },
      [](Scene& s) { s.tray.holes[0].centre = 0.04; },
      [](Scene& s) { s.tray.holes[0].width = 0.04; },
      [](Scene& s) { s.tray.holes.clear(); },
      [](Scene& s) {
        s.tray.pieces.push_back({{0, 0}, {1, 0}});
      },
      [](Scene& s) {
        s.tray.pieces.push_back({{0, 0}, {1, 0}});
        s.tray.pieces.back().about = {1, 1};
      },
      [](Scene& s) {
        s.tray.pieces.push_back({{0, 0}, {1, 0}});
        s.tray.pieces.back().about = {1, 1};
        s.tray.pieces.back().axis = PieceAxis::along;
      },
      [](Scene& s) {
        s.tray.pieces.push_back({{0, 0}, {1, 0}});
        s.tray.pieces.back().drawn_out = DrawnOut::along;
      },
      [](Scene& s) { s.tray.holes[0].open_at = 1; },
      [](Scene& s) { s.tray.holes[0].thickness = 2e-3; },
      [](Scene& s) { s.tray.holes[0].thickness = 2e-3, s.tray.holes[0].chamfer = 1e-3; },
      [](Scene& s) {
        s.tray.rain = Rain{200, 0, 0.1, 0.1};
      },
      [](Scene& s) { s.tray.box = false; },
      [](Scene& s) { s.tray.sides = Sides::periodic; },
      [](Scene& s) { s.tray.fill->count = 2; },
      [](Scene& s) { s.tray.fill->packing = Packing::hexagonal; },
      [](Scene& s) { s.tray.fill->jitter = 0; },
      [](Scene& s) { s.tray.fill->keep = true; },
      [](Scene& s) { s.tray.fill.reset(); },
      [](Scene& s) { std::get<HarmonicMotion>(*s.tray.motion).direction = 1; },
      [](Scene& s) { std::get<HarmonicMotion>(*s.tray.motion).amplitude = 1; },
      [](Scene& s) { std::get<HarmonicMotion>(*s.tray.motion).frequency = 1; },
      [](Scene& s) { std::get<HarmonicMotion>(*s.tray.motion).ramp = 1; },
      [](Scene& s) { std::get<HarmonicMotion>(*s.tray.motion).phase = 1; },
      [](Scene& s) { std::get<HarmonicMotion>(*s.tray.motion).stop = 1; },
      [](Scene& s) { std::get<HarmonicMotion>(*s.tray.motion).stop_ramp = 1; },
      [](Scene& s) {
        s.tray.motion = SumMotion{{HarmonicMotion{0, 0.01, 9, 0}}};
      },
      [](Scene& s) {
        s.tray.motion = RockingMotion{{0, 0}, 0.01, 9, 0};
      },
      [](Scene& s) {
        s.tray.motion = TurningMotion{{0, 0}, 1};
      },
      [](Scene& s) {
        s.tray.motion = TurningMotion{{0, 0}, 1, TurningAxis::upright};
      },
      [](Scene& s) {
        s.tray.motion = TableMotion{{0, 1, 2, 3}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}, {}};
      },
      [](Scene& s) { s.tray.motion.reset(); },
      [](Scene& s) { s.hopper->height = 1; },
      [](Scene& s) { s.hopper.reset(); },
      [](Scene& s) { s.numerics.integrator = Integrator::rk2_midpoint; },
      [](Scene& s) { s.numerics.steps_per_contact = 7; },
      [](Scene& s) { s.numerics.accuracy = AccuracyLevel::design; },
      [](Scene& s) { s.numerics.dt = 1e-5; },
      [](Scene& s) { s.numerics.allow_long_step = true; },
      [](Scene& s) { s.guard.warn_relative_overlap = 0.1; },
      [](Scene& s) { s.guard.stop_relative_overlap = 0.1; },
      [](Scene& s) { s.guard.energy_tolerance = 0.1; },
      [](Scene& s) { s.run.duration = 9; },
      [](Scene& s) { s.run.measure_from = 9; },
      [](Scene& s) { s.run.count_below = 9; },
      [](Scene& s) { s.run.start = Start::with_tray; },
      [](Scene& s) { s.lots[0].shell_compression = 1e-5; },
      [](Scene& s) { s.contact.seed.rolling_friction = 0.1; },
      [](Scene& s) { s.contact.wall.rolling_friction = 0.1; },
      [](Scene& s) { s.contact.seed.cohesion = 1e-3; },
      [](Scene& s) { s.contact.wall.cohesion = 1e-3; },
      [](Scene& s) {
        s.contact.overrides = {{0, -1, s.contact.wall}};
      },
      [](Scene& s) {
        s.contact.overrides = {{0, 0, s.contact.seed}};
      },
      [](Scene& s) {
        s.contact.overrides = {{0, -1, {0.1, 1}}};
      },
      [](Scene& s) {
        s.contact.overrides = {{0, -1, {0, 0.1}}};
      },
      [](Scene& s) {
        s.contact.overrides = {{0, -1, {0, 1, 0.1}}};
      },
      [](Scene& s) {
        s.contact.overrides = {{0, -1, {0, 1, 0, 0.1}}};
      },
      [](Scene& s) { s.contact.friction_model = FrictionModel::spring; },
      [](Scene& s) { use_spring(s), s.contact.tangential_ratio = 0.5; },
      [](Scene& s) { use_spring(s), s.contact.tangential_damping = 0.1; },
      [](Scene& s) { s.contact.rolling = Rolling::constant_torque; },
      [](Scene& s) { s.contact.rolling = Rolling::spring; },
      [](Scene& s) { s.contact.rolling = Rolling::spring, s.contact.rolling_damping = 0.1; },
      [](Scene& s) { s.contact.law = Law::hertz; },
      [](Scene& s) { s.contact.law = Law::hertz_viscous; },
      [](Scene& s) { use_hertz(s), s.contact.youngs_modulus = 1e9; },
      [](Scene& s) { use_hertz(s), s.contact.poisson_ratio = 0.1; },
      [](Scene& s) { use_hertz(s), s.contact.damping_rate = 1e4; },
      [](Scene& s) { use_hertz(s), s.contact.wall_youngs_modulus = 1e9; },
      [](Scene& s) { use_hertz(s), s.contact.wall_youngs_modulus = 1e9, s.contact.wall_poisson_ratio = 0.1; },
      [](Scene& s) { use_hertz(s), s.lots[0].youngs_modulus = 1e9; },
      [](Scene& s) { use_hertz(s), s.lots[0].poisson_ratio = 0.1; },
      [](Scene& s) { s.numerics.integrator = Integrator::gear5; },
      [](Scene& s) { s.numerics.impact_speed = 1; },
      [](Scene& s) {
        s.record = Record{{}, 0.01};
      },
      [](Scene& s) {
        s.record = Record{{1, 2}, 0.01};
      },
      [](Scene& s) {
        s.record = Record{{1, 2}, 0.02};
      },
      [](Scene& s) {
        s.record = Record{{1, 2}, 0.02, MapView::slice};
      },
  };
  std::map<std::string, std::size_t> known{{scene_to_json(example()), changes.size()}};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene changed = example();
    changes[i](changed);
    const auto [same, is_new] = known.emplace(scene_to_json(changed), i);
    EXPECT_TRUE(is_new) << "change number " << i << " has the text of number " << same->second;
  }
}

TEST(SceneJson, EveryMeasureOfSizesAndClumpsHasItsOwnText) {
  const auto text = [](const SeedLot& lot) {
    Scene scene = example();
    scene.lots = {lot};
    return scene_to_json(scene);
  };
  const auto expect_change = [&](const SeedLot& lot, const std::function<void(SeedLot&)>& change) {
    SeedLot changed = lot;
    change(changed);
    EXPECT_NE(text(changed), text(lot));
  };
  SeedLot lot = example().lots[0];
  lot.sizes = {Kind::normal, 0.007, 0.001, 0.004, 0.01, {}, {}};
  expect_change(lot, [](SeedLot& l) { l.sizes.kind = Kind::lognormal; });
  expect_change(lot, [](SeedLot& l) { l.sizes.mean *= 1.1; });
  expect_change(lot, [](SeedLot& l) { l.sizes.deviation *= 1.1; });
  expect_change(lot, [](SeedLot& l) { l.sizes.least *= 1.1; });
  expect_change(lot, [](SeedLot& l) { l.sizes.most *= 1.1; });
  lot.sizes = {Kind::table, 0.007, 0, 0, 0, {0.006, 0.008}, {0.5, 0.5}};
  expect_change(lot, [](SeedLot& l) { l.sizes.diameter[1] *= 1.1; });
  expect_change(lot, [](SeedLot& l) { l.sizes.fraction = {0.4, 0.6}; });
  lot.sizes = {};
  lot.shape = Shape::clump;
  lot.discs = {{0, 0, 1e-3}, {1e-3, 0, 1e-3}};
  expect_change(lot, [](SeedLot& l) { l.discs[0].x = 1e-4; });
  expect_change(lot, [](SeedLot& l) { l.discs[1].y = 1e-4; });
  expect_change(lot, [](SeedLot& l) { l.discs[1].radius = 1e-4; });
  expect_change(lot, [](SeedLot& l) { l.discs[1].z = 1e-4; });
  expect_change(lot, [](SeedLot& l) { l.discs.pop_back(); });
  expect_change(lot, [](SeedLot& l) { l.gyration2 = 1e-6; });
  expect_change(lot, [](SeedLot& l) { l.gyration2_x = 1e-6; });
  expect_change(lot, [](SeedLot& l) { l.gyration2_y = 1e-6; });
}

// Random scenes. Structured bindings: a field that is added does not compile until it is here.

/// Any double but infinities and NaN, and often a round one.
double any_number() {
  const double value = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
  return std::isfinite(value) ? value : static_cast<double>(*rc::gen::arbitrary<int>());
}

double any_time() {
  return *rc::gen::arbitrary<bool>() ? any_number() : never;
}

bool any_choice() {
  return *rc::gen::arbitrary<bool>();
}

template <class E>
E any_of_first(int count) {
  return static_cast<E>(*rc::gen::inRange(0, count));
}

std::string any_text() {
  return *rc::gen::elementOf(std::vector<std::string>{"", "pea", "Kamut (\"Khorasan\")", "\xc3\xbc\n\t\\"});
}

Eigen::Vector2d any_point() {
  return {any_number(), any_number()};
}

template <class F>
auto any_list(F make, int least = 0) {
  std::vector<decltype(make())> list;
  for (int count = *rc::gen::inRange(least, least + 3); count > 0; --count) list.push_back(make());
  return list;
}

template <class F>
auto maybe(F make) {
  std::optional<decltype(make())> value;
  if (any_choice()) value = make();
  return value;
}

SizeDistribution any_sizes() {
  SizeDistribution sizes;
  auto& [kind, mean, deviation, least, most, diameter, fraction] = sizes;
  kind = any_of_first<Kind>(5);
  for (double* number : {&mean, &deviation, &least, &most}) *number = any_choice() ? any_number() : 0;
  diameter = any_list(any_number, kind == Kind::table ? 1 : 0);
  for (std::size_t k = 0; k < diameter.size(); ++k) fraction.push_back(any_number());
  return sizes;
}

ClumpDisc any_disc() {
  ClumpDisc disc{};
  auto& [x, y, radius, z] = disc;
  for (double* number : {&x, &y, &radius}) *number = any_number();
  z = any_choice() ? any_number() : 0;
  return disc;
}

SeedLot any_lot() {
  SeedLot lot;
  auto& [name, diameter, mass, shape, fraction, sizes, discs, gyration2, gyration2_x, gyration2_y, shell, modulus,
         ratio, crop, contact] = lot;
  name = any_text();
  for (double* number : {&diameter, &mass, &fraction, &gyration2}) *number = any_number();
  for (double* number : {&gyration2_x, &gyration2_y}) *number = any_choice() ? any_number() : 0;
  shape = any_of_first<Shape>(3);
  if (any_choice()) sizes = any_sizes();
  discs = any_list(any_disc, shape == Shape::clump ? 1 : 0);
  for (std::optional<double>* number : {&shell, &modulus, &ratio}) *number = maybe(any_number);
  for (PresetFile* preset : {static_cast<PresetFile*>(&crop), &contact}) *preset = {any_text(), any_text()};
  return lot;
}

Surface any_surface() {
  Surface surface;
  auto& [friction, restitution, rolling_friction, cohesion, twisting_friction] = surface;
  for (double* number : {&friction, &restitution, &rolling_friction, &cohesion, &twisting_friction})
    *number = any_number();
  return surface;
}

Contact any_contact(int lots) {
  Contact contact;
  auto& [law, shell, modulus, ratio, wall_modulus, wall_ratio, damping_rate, seed, wall, overrides, friction_model,
         tangential_ratio, tangential_damping, rolling, rolling_damping, slip_speed, drag, rotation, arm, model] =
      contact;
  law = any_of_first<Law>(3);
  for (double* number : {&shell, &modulus, &ratio, &wall_ratio, &damping_rate, &tangential_damping, &rolling_damping,
                         &slip_speed, &drag})
    if (any_choice()) *number = any_number();
  wall_modulus = maybe(any_number);
  tangential_ratio = maybe(any_number);
  seed = any_surface();
  wall = any_surface();
  overrides = any_list([lots] {
    return SurfaceOverride{*rc::gen::inRange(0, lots), *rc::gen::inRange(-1, lots), any_surface()};
  });
  friction_model = any_of_first<FrictionModel>(2);
  rolling = any_of_first<Rolling>(3);
  rotation = any_choice();
  arm = any_of_first<FrictionArm>(2);
  model = {{any_text(), any_text()}};
  return contact;
}

Hole any_hole() {
  Hole hole;
  auto& [centre, width, open_at, shape, across, across_length, thickness, chamfer] = hole;
  centre = any_number(), width = any_number(), open_at = any_time();
  shape = any_of_first<HoleShape>(2);
  across = any_number(), across_length = any_number(), thickness = any_number();
  if (any_choice()) chamfer = 0.5 * thickness;
  return hole;
}

WallPiece any_piece() {
  WallPiece piece;
  auto& [a, b, centre, radius, from, to, about, axis, drawn_out] = piece;
  about = maybe(any_point);
  axis = any_of_first<PieceAxis>(2);
  if (!about) drawn_out = any_of_first<DrawnOut>(2);
  for (Eigen::Vector2d* point : {&a, &b, &centre}) *point = any_point();
  for (double* number : {&radius, &from, &to})
    if (any_choice()) *number = any_number();
  return piece;
}

Fill any_fill() {
  Fill fill;
  auto& [count, packing, jitter, keep, where] = fill;
  count = *rc::gen::arbitrary<int>();
  packing = any_of_first<Packing>(3);
  jitter = any_number();
  keep = any_choice();
  where = WrittenAt("file.toml:3: tray.fill.count");
  return fill;
}

Rain any_rain() {
  Rain rain;
  auto& [rate, from, to, height, start, stop] = rain;
  for (double* number : {&rate, &from, &to, &height, &start}) *number = any_number();
  stop = any_time();
  return rain;
}

HarmonicMotion any_harmonic() {
  HarmonicMotion motion;
  auto& [direction, amplitude, frequency, ramp, phase, stop, stop_ramp, across] = motion;
  for (double* number : {&direction, &amplitude, &frequency, &ramp, &phase, &stop_ramp, &across})
    *number = any_number();
  stop = any_time();
  return motion;
}

RockingMotion any_rocking() {
  RockingMotion motion;
  auto& [pivot, angle, frequency, ramp, stop, stop_ramp] = motion;
  pivot = any_point();
  for (double* number : {&angle, &frequency, &ramp, &stop_ramp}) *number = any_number();
  stop = any_time();
  return motion;
}

TableMotion any_table() {
  TableMotion motion;
  auto& [times, x, y, angle, z] = motion;
  times = {-1e300, 0, 4e-324, 1, 1.7e308};
  for (std::vector<double>* list : {&x, &y, &angle})
    for (std::size_t k = 0; k < times.size(); ++k) list->push_back(any_number());
  if (any_choice()) z = angle;
  return motion;
}

TurningMotion any_turning() {
  TurningMotion motion;
  auto& [pivot, angular_velocity, axis, ramp, stop, stop_ramp, phase] = motion;
  pivot = any_point();
  axis = any_of_first<TurningAxis>(2);
  for (double* number : {&angular_velocity, &ramp, &stop_ramp, &phase}) *number = any_number();
  stop = any_time();
  return motion;
}

VesselMotion any_motion() {
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return any_harmonic();
    case 1:
      return SumMotion{any_list(any_harmonic)};
    case 2:
      return any_rocking();
    case 3:
      return any_turning();
    default:
      return any_table();
  }
}

Vessel any_vessel() {
  Vessel vessel;
  auto& [name, origin, length, height, tilt, funnel, depth, holes, slots_in_3d, pieces, box, sides, front_and_back,
         front, plan, fill, rain, motion] = vessel;
  name = *rc::gen::elementOf(std::vector<std::string>{"", "tray", "hopper"});
  origin = any_point();
  for (double* number : {&length, &height, &tilt, &funnel, &front}) *number = any_number();
  depth = maybe(any_number);
  holes = any_list(any_hole);
  slots_in_3d = {*rc::gen::inRange(1, 4), *rc::gen::element(1.0, 0.5)};
  pieces = any_list(any_piece);
  box = any_choice();
  sides = any_of_first<Sides>(3);
  front_and_back = any_of_first<Sides>(3);
  plan = any_of_first<Plan>(2);
  fill = maybe(any_fill);
  rain = maybe(any_rain);
  motion = maybe(any_motion);
  return vessel;
}

Scene any_scene() {
  Scene scene;
  auto& [title, space, lots, contact, tray, hopper, numerics, guard, run, record, of_reader] = scene;
  of_reader.sentences = any_list(any_text, 0);
  space = any_of_first<Space>(2);
  title = any_text();
  lots = any_list(any_lot, 1);
  contact = any_contact(static_cast<int>(lots.size()));
  tray = any_vessel();
  hopper = maybe(any_vessel);
  auto& [accuracy, integrator, steps, dt, impact_speed, allow_long_step, where] = numerics;
  accuracy = any_of_first<AccuracyLevel>(4);
  integrator = any_of_first<Integrator>(3);
  if (any_choice()) steps = any_number();
  dt = maybe(any_number);
  impact_speed = maybe(any_number);
  allow_long_step = any_choice();
  where = WrittenAt("file.toml:3: numerics.dt");
  auto& [warn, stop, tolerance] = guard;
  warn = any_number(), stop = any_number(), tolerance = any_number();
  auto& [duration, measure_from, count_below, start, pause] = run;
  for (double* number : {&duration, &measure_from, &count_below}) *number = any_number();
  start = any_of_first<Start>(2);
  pause = maybe(any_number);
  record = maybe([] {
    Record one;
    auto& [times, cell, view] = one;
    times = any_list(any_number), cell = any_number();
    view = any_of_first<MapView>(2);
    return one;
  });
  return scene;
}

void expect_round_trip(const Scene& scene) {
  const std::string text = scene_to_json(scene);
  const Scene back = scene_from_json(text);
  EXPECT_TRUE(back == scene) << text;
  EXPECT_EQ(scene_to_json(back), text);  // to the bit, where 0 == -0
}

TEST(SceneJson, AnySceneReadsBack) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene = any_scene();
    const std::string text = scene_to_json(scene);
    const Scene back = scene_of_any_numbers(text);
    RC_ASSERT(back == scene);
    RC_ASSERT(scene_to_json(back) == text);  // to the bit, where 0 == -0
  }));
}

TEST(SceneJson, EveryShippedSceneReadsBack) {
  int scenes = 0, studies = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data_directory() / "seeders")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().string());
    if (kind_of(entry.path()) == FileKind::seeder) {
      expect_round_trip(read_scene(entry.path()));
      ++scenes;
      continue;
    }
    for (const Scene& scene : read_study(entry.path()).scenes) expect_round_trip(scene);
    ++studies;
  }
  EXPECT_GE(scenes, 10);
  EXPECT_GE(studies, 10);
}

TEST(SceneJson, ManyAWayToLayItOut) {
  const std::string text = scene_to_json(example());
  std::string spaced;
  for (const char c : text) spaced += c == ',' ? std::string(" ,\n\t") : std::string(1, c);
  EXPECT_TRUE(scene_from_json(spaced) == example());
}

TEST(SceneJson, WhatCannotBeWrittenIsRefused) {
  const auto refused = [](const std::function<void(Scene&)>& change, const std::string& message) {
    Scene scene = example();
    change(scene);
    try {
      scene_to_json(scene);
      ADD_FAILURE() << "written all the same; expected " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(message));
    }
  };
  refused([](Scene& s) { s.tray.length = never; }, "scene.tray.length_m: inf");
  refused([](Scene& s) { s.tray.depth = never; }, "scene.tray.depth_m: inf");
  refused([](Scene& s) { s.tray.holes[0].open_at = -never; }, "scene.tray.holes[0].open_at_s: -inf");
  refused([](Scene& s) { s.lots[0].mass = std::nan(""); }, "scene.lots[0].mass_kg: nan");
  refused([](Scene& s) { s.title = "\xff"; }, "scene: cannot be written as JSON");
}

struct Edit {
  std::string from, to, message;
};

TEST(SceneJson, WhatIsWrongIsSaidWithItsPath) {
  Scene scene = example();
  scene.contact.overrides = {{0, -1, {0.1, 1}}};
  scene.hopper->motion = TableMotion{{0, 1, 2, 3}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}, {}};
  scene.lots[0].sizes = {Kind::table, 0, 0, 0, 0, {0.006, 0.008}, {0.5, 0.5}};
  const std::string text = scene_to_json(scene);
  const std::vector<Edit> edits = {
      {"\"width_m\":0.02", "\"width_m\":\"2 cm\"", "scene.tray.holes[0].width_m: expected a number, not a text"},
      {"\"width_m\":0.02", "\"width_m\":null", "scene.tray.holes[0].width_m: expected a number, not null"},
      {"\"width_m\":0.02,", "", "scene.tray.holes[0].width_m: is missing"},
      {"\"width_m\"", "\"widht_m\"", "scene.tray.holes[0].width_m: is missing"},
      {"\"width_m\":", "\"wide\":1,\"width_m\":",
       "scene.tray.holes[0].wide: unknown key; known here are centre_m, width_m, open_at_s"},
      {"\"width_m\":", "\"width_m\":1,\"width_m\":", "scene: the key \"width_m\" stands twice"},
      {"\"count\":100", "\"count\":100.5", "scene.tray.fill.count: expected a whole number of 32 bits"},
      {"\"count\":100", "\"count\":3000000000", "scene.tray.fill.count: expected a whole number of 32 bits"},
      {"\"count\":100", "\"count\":-3000000000", "scene.tray.fill.count: expected a whole number of 32 bits"},
      {"\"keep\":false", "\"keep\":0", "scene.tray.fill.keep: expected true or false, not this number"},
      {"\"name\":\"pea\"", "\"name\":[]", "scene.lots[0].name: expected a text, not a list"},
      {"\"shape\":\"ball\"", "\"shape\":\"cube\"", "scene.lots[0].shape: \"cube\" is not one of disc, ball, clump"},
      {"\"shape\":\"ball\"", "\"shape\":\"clump\"", "scene.lots[0].discs: is missing"},
      {"\"fractions\":[0.5,0.5]", "\"fractions\":[1.0]", "scene.lots[0].sizes.fractions: has not as many numbers"},
      {"\"lot\":0", "\"lot\":1", "scene.contact.pairs: names a lot that does not exist"},
      {"\"other\":-1", "\"other\":-2", "scene.contact.pairs: names a lot that does not exist"},
      {"\"tray\":{", "\"tray\":7,\"x\":{", "scene.tray: expected an object, not this number"},
      {"\"holes\":[", "\"holes\":{},\"x\":[", "scene.tray.holes: expected a list, not an object"},
      {"\"kind\":\"table\"", "\"kind\":\"harmonic\"", "scene.hopper.motion.direction_rad: is missing"},
      {"\"time_s\":[0.0,1.0,2.0,3.0]", "\"time_s\":[0.0,1.0,2.0]", "scene.hopper.motion.time_s: has fewer than 4"},
      {"\"time_s\":[0.0,1.0,2.0,3.0]", "\"time_s\":[0.0,1.0,1.0,3.0]", "scene.hopper.motion.time_s: does not ascend"},
      {"\"x_m\":[0.0,0.0,", "\"x_m\":[0.0,", "scene.hopper.motion.x_m: has not as many numbers as time_s"},
      {"{\"lots\"", "[{\"lots\"", "scene: not JSON"},
      {"\"restitution\":", "\"restitution\":-0.0,\"x\":", "scene.contact.seed.restitution: is out of range"},
      {"\"width_m\":0.02", "\"width_m\":-1e308", "scene.tray.holes[0].width_m: -1e+308 is out of range"},
      {"\"count\":100", "\"count\":-1", "scene.tray.fill.count: is out of range"},
      {"\"name\":\"pea\"", "\"name\":\"\\u001b[2J\"", "scene.lots[0].name: has other characters"},
      {text, "[1,2]", "scene: expected an object, not a list"},
      {text, "", "scene: not JSON"},
      {"\"width_m\":0.02", "\"width_m\":1e999", "scene: not JSON"},
      {"\"width_m\":0.02", "\"width_m\":NaN", "scene: not JSON"},
  };
  for (const Edit& edit : edits) {
    std::string changed = text;
    const std::size_t at = changed.find(edit.from);
    ASSERT_NE(at, std::string::npos) << edit.from;
    changed.replace(at, edit.from.size(), edit.to);
    try {
      scene_from_json(changed);
      ADD_FAILURE() << "read all the same; expected " << edit.message;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(edit.message));
    }
  }
}

TEST(SceneJson, ListsHaveAnEnd) {
  const auto said = [](const std::function<void(Scene&)>& change) {
    Scene scene = example();
    change(scene);
    try {
      scene_from_json(scene_to_json(scene));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto lots = [](std::size_t count) {
    return [count](Scene& scene) { scene.lots.resize(count, scene.lots[0]); };
  };
  EXPECT_EQ(said(lots(list_limits::lots)), "");
  EXPECT_EQ(said(lots(list_limits::lots + 1)), "scene.lots: lists too many");
  const std::vector<double> sizes(list_limits::sizes + 1, 0.006);
  EXPECT_EQ(said([&](Scene& scene) { scene.lots[0].sizes = {Kind::table, 0, 0, 0, 0, sizes, sizes}; }),
            "scene.lots[0].sizes.diameters_m: lists too many");
  EXPECT_EQ(said([](Scene& scene) {
              scene.tray.motion = SumMotion{std::vector<HarmonicMotion>(list_limits::components + 1)};
            }),
            "scene.tray.motion.components: lists too many");
  EXPECT_EQ(said([](Scene& scene) { scene.tray.pieces.resize(list_limits::pieces + 1); }),
            "scene.tray.pieces: lists too many");
  EXPECT_EQ(said([](Scene& scene) { scene.record.emplace().times.assign(list_limits::snapshots + 1, 0.0); }),
            "scene.record.times_s: lists too many");
}

}  // namespace
}  // namespace vibrosow
