#include "plan/predicted_grains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vibrosow {
namespace {

/// A bin of 4 mm discs with one hole in the middle of a floor 20 cm long, 1000 of them, for 10 s.
Scene bin(double hole_width) {
  Scene scene;
  scene.lots = {{"grain", 4e-3, 40e-6, Shape::ball, 1.0}};
  scene.contact.seed.friction = 0.5;
  scene.tray.name = "tray";
  scene.tray.length = 0.2;
  scene.tray.height = 0.5;
  scene.tray.fill = Fill{1000, Packing::poured, 1e-3, false};
  if (hole_width > 0) scene.tray.holes = {{0.1, hole_width, 0}};
  scene.run.duration = 10;
  return scene;
}

double grain_seconds(const Scene& scene) {
  return 1e-5 * predicted_grain_steps(scene, 1e-5);
}

TEST(PredictedGrains, AClosedBedStays) {
  EXPECT_NEAR(predicted_grain_steps(bin(0), 1e-5), 1000 * 10 / 1e-5, 1);
}

TEST(PredictedGrains, KeptToppedUpStays) {
  Scene scene = bin(0.04);
  scene.tray.fill->keep = true;
  EXPECT_NEAR(grain_seconds(scene), 10000, 1e-6);
}

TEST(PredictedGrains, ASlotPassesWhatTheSiloPassed) {
  // reports/silo: grains/s through slots of 7, 10, 14 and 20 diameters of 4 mm.
  for (const auto& [slot, rate] : {std::pair{7, 700.3}, {10, 1397.9}, {14, 2575.5}, {20, 4770.0}}) {
    const Scene scene = bin(slot * 4e-3);
    EXPECT_NEAR(predicted_outflow(scene, scene.tray, 0) / rate, 1, 0.1) << slot;
  }
}

TEST(PredictedGrains, ShakingHelpsThroughNarrowHoles) {
  // reports/paper-a-fig3, stiff: 295 discs/s of 8 mm through three holes of three diameters.
  Scene scene = bin(0);
  scene.lots.front().diameter = 8e-3;
  for (const double centre : {0.05, 0.1, 0.15}) scene.tray.holes.push_back({centre, 24e-3, 0});
  const double at_rest = predicted_outflow(scene, scene.tray, 0);
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  const double shaken = predicted_outflow(scene, scene.tray, 0);
  EXPECT_NEAR(shaken / 295, 1, 0.15);
  EXPECT_LT(at_rest, 0.7 * shaken);
}

TEST(PredictedGrains, AFunnelDrainsToTheLastAndAFlatFloorKeepsItsHeaps) {
  Scene scene = bin(0.04);
  scene.tray.funnel = 0.5;
  const double rate = predicted_outflow(scene, scene.tray, 0);
  EXPECT_NEAR(grain_seconds(scene), 1000 * 1000 / (2 * rate), 0.01 * 1000 * 1000 / rate);
  scene.tray.funnel = 0;
  // Two heaps 8 cm long against the end walls, of slope 0.35.
  const double area = 0.25 * std::numbers::pi * 16e-6, left = 0.08 * 0.08 * 0.35 * 0.82 / area;
  const double draining = (1000 * 1000 - left * left) / (2 * rate), emptied = (1000 - left) / rate;
  EXPECT_NEAR(grain_seconds(scene), draining + left * (10 - emptied), 0.002 * 10 * left);
  scene.tray.sides = Sides::open;  // heaps that slope to both sides are half as large
  EXPECT_LT(grain_seconds(scene), draining + 0.55 * left * 10);
}

TEST(PredictedGrains, AGateHoldsThemBack) {
  Scene scene = bin(0.04);
  const double open = grain_seconds(scene);
  scene.tray.holes.front().open_at = 3;
  EXPECT_EQ(predicted_outflow(scene, scene.tray, 2.9), 0);
  const double left = 0.08 * 0.08 * 0.35 * 0.82 / (0.25 * std::numbers::pi * 16e-6);
  EXPECT_NEAR(grain_seconds(scene) - open, 3 * (1000 - left), 20);  // all drained by 10 s either way
}

TEST(PredictedGrains, RainAddsUpWhileItFalls) {
  Scene scene = bin(0);
  scene.tray.fill.reset();
  scene.tray.rain = Rain{.rate = 100, .from = 0, .to = 0.2, .height = 0.4, .start = 2, .stop = 6};
  // 400 grains, 4 s in coming and then 4 s there.
  EXPECT_NEAR(grain_seconds(scene), 400 * 2 + 400 * 4, 5);
}

TEST(PredictedGrains, RainTakesItsTimeToAHole) {
  Scene scene = bin(0.04);
  scene.tray.fill.reset();
  scene.tray.holes.front().centre = 0.18;
  scene.tray.rain = Rain{.rate = 100, .from = 0.02, .to = 0.04, .height = 0.05};
  scene.tray.motion = HarmonicMotion{0.5, 0.01, 10, 0};
  // 13 cm to the hole at 0.55 of 2 pi 10 Hz 1 cm, after a fall of 5 cm.
  const double way = 0.13 / (0.55 * 0.6283) + std::sqrt(2 * 0.05 / standard_gravity);
  EXPECT_NEAR(grain_seconds(scene), 100 * way * (10 - 0.5 * way), 0.01 * 1000 * way);
  scene.tray.motion.reset();  // what does not move rests on the floor
  EXPECT_GT(grain_seconds(scene), 2 * 100 * way * 10);
}

TEST(PredictedGrains, AKeptHopperHeapsTheTrayUpToItself) {
  Scene scene = bin(0.04);
  scene.tray.motion = HarmonicMotion{0, 0.01, 9, 0};
  scene.hopper = scene.tray;
  scene.hopper->motion.reset();
  scene.hopper->origin = {0, 0.05};
  scene.hopper->fill = Fill{300, Packing::poured, 1e-3, true};
  scene.hopper->holes = {{0.1, 0.08, 0}};
  EXPECT_NEAR(grain_seconds(scene), 13000, 150);  // a heap of 5 cm is less than the tray's fill
  scene.hopper->origin = {0, 0.1};
  const double heaped = 0.2 * (0.1 - 0.25 * 0.13 * 0.2) * 0.82 / (0.25 * std::numbers::pi * 16e-6);
  EXPECT_NEAR(grain_seconds(scene), 10 * (300 + heaped), 150);
  scene.hopper->fill->keep = false;  // both drain
  EXPECT_LT(grain_seconds(scene), 2000);
}

}  // namespace
}  // namespace vibrosow
