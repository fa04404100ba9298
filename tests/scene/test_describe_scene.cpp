#include "scene/describe_scene.hpp"

#include <gtest/gtest.h>

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

TEST(DescribeScene, TitleDoesNotCount) {
  Scene other = example();
  other.title = "another";
  EXPECT_EQ(describe_scene(other), describe_scene(example()));
}

TEST(DescribeScene, EverythingThatActsCounts) {
  const std::vector<std::function<void(Scene&)>> changes = {
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
      [](Scene& s) { s.tray.holes[0].open_at = 1; },
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
        s.tray.motion = TableMotion{{0, 1, 2, 3}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}};
      },
      [](Scene& s) { s.tray.motion.reset(); },
      [](Scene& s) { s.hopper->height = 1; },
      [](Scene& s) { s.hopper.reset(); },
      [](Scene& s) { s.numerics.integrator = Integrator::rk2_midpoint; },
      [](Scene& s) { s.numerics.steps_per_contact = 7; },
      [](Scene& s) { s.numerics.dt = 1e-5; },
      [](Scene& s) { s.numerics.allow_long_step = true; },
      [](Scene& s) { s.guard.warn_compression = 0.1; },
      [](Scene& s) { s.guard.stop_compression = 0.1; },
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
  };
  std::map<std::string, std::size_t> known{{describe_scene(example()).dump(), changes.size()}};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene changed = example();
    changes[i](changed);
    const auto [same, is_new] = known.emplace(describe_scene(changed).dump(), i);
    EXPECT_TRUE(is_new) << "change number " << i << " is described like number " << same->second;
  }
}

TEST(DescribeScene, EveryMeasureOfSizesAndClumpsCounts) {
  const auto text = [](const SeedLot& lot) {
    Scene scene = example();
    scene.lots = {lot};
    return describe_scene(scene).dump();
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
  expect_change(lot, [](SeedLot& l) { l.discs.pop_back(); });
  expect_change(lot, [](SeedLot& l) { l.gyration2 = 1e-6; });
}

}  // namespace
}  // namespace vibrosow
