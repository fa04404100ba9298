#include "scene/describe_scene.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace vibrosow {
namespace {

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
      [](Scene& s) { s.lots[0].number_share = 0.5; },
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
  };
  const std::string plain = describe_scene(example()).dump();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Scene changed = example();
    changes[i](changed);
    EXPECT_NE(describe_scene(changed).dump(), plain) << "change number " << i;
  }
}

}  // namespace
}  // namespace vibrosow
