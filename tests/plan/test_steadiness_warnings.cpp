#include "plan/steadiness_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

/// Shaken at 10 Hz, measured from 0.3 to 0.8 s.
Scene steady() {
  Scene scene;
  scene.tray.name = "tray";
  scene.tray.length = 0.1;
  scene.tray.holes = {{0.03, 0.02}, {0.07, 0.02}};
  scene.tray.motion = HarmonicMotion{.amplitude = 3e-3, .frequency = 10, .ramp = 0.2};
  scene.tray.rain = Rain{.rate = 5, .start = 0.1};
  scene.run.measure_from = 0.3;
  scene.run.duration = 0.8;
  return scene;
}

std::vector<std::string> of(const std::function<void(Scene&)>& change) {
  Scene scene = steady();
  change(scene);
  return steadiness_warnings(scene);
}

const HarmonicMotion shaken{.amplitude = 3e-3, .frequency = 10};

TEST(SteadinessWarnings, ThereAreNoneOfWhatGoesOnEvenly) {
  EXPECT_THAT(of([](Scene&) {}), IsEmpty());
  EXPECT_THAT(of([](Scene& scene) { scene.tray.motion = SumMotion{{shaken, shaken}}; }), IsEmpty());
  EXPECT_THAT(of([](Scene& scene) { scene.tray.holes[0].open_at = 0.3; }), IsEmpty());
  EXPECT_THAT(of([](Scene& scene) { scene.tray.holes.clear(), scene.tray.rain->stop = 0.5; }), IsEmpty())
      << "nothing is measured";
  EXPECT_THAT(of([](Scene& scene) {
                scene.tray.motion = HarmonicMotion{.amplitude = 3e-3, .frequency = 10, .stop = 0.1, .stop_ramp = 0.2};
              }),
              IsEmpty())
      << "it has ended before";
}

TEST(SteadinessWarnings, NameAMotionThatBuildsUpOrEnds) {
  EXPECT_THAT(
      of([](Scene& scene) { std::get<HarmonicMotion>(*scene.tray.motion).ramp = 0.7; }),
      ElementsAre("tray.motion.ramp: the motion builds up until 0.7 s, and rates are measured from 0.3 to 0.8 s: "
                  "they are means of two conditions"));
  EXPECT_THAT(of([](Scene& scene) { std::get<HarmonicMotion>(*scene.tray.motion).stop = 0.4; }),
              ElementsAre(StartsWith("tray.motion.stop: the motion ends from 0.4 s on")));
  EXPECT_THAT(of([](Scene& scene) {
                HarmonicMotion brief = shaken;
                brief.stop = 0.4;
                scene.tray.motion = SumMotion{{shaken, brief}};
              }),
              ElementsAre(StartsWith("tray.motion.stop")));
  EXPECT_THAT(of([](Scene& scene) { scene.tray.motion = TurningMotion{.angular_velocity = 70, .ramp = 0.75}; }),
              ElementsAre(StartsWith("tray.motion.ramp")));
  const std::vector<double> still(4, 0.0), moved = {0, 1e-3, 0, 1e-3};
  EXPECT_THAT(
      of([&](Scene& scene) {
        scene.tray.motion = TableMotion{{0, 0.1, 0.2, 0.24}, moved, still, still, {}};
      }),
      ElementsAre("tray.motion.file: the table of the motion ends at 0.24 s, and rates are measured from 0.3 to "
                  "0.8 s: after that"));
  EXPECT_THAT(of([&](Scene& scene) {
                scene.tray.motion = TableMotion{{5, 5.1, 5.2, 5.3}, moved, still, still, {}};
              }),
              ElementsAre(StartsWith("tray.motion.file: the table of the motion begins at 5 s")));
}

TEST(SteadinessWarnings, NameGatesAndRain) {
  EXPECT_THAT(of([](Scene& scene) { scene.tray.holes[1].open_at = 0.9; }),
              ElementsAre("tray.holes.open_at: hole 2 opens at 0.9 s, and rates are measured from 0.3 to 0.8 s: before "
                          "that"))
      << "after the run";
  EXPECT_THAT(of([](Scene& scene) {
                scene.hopper = scene.tray;
                scene.hopper->name = "hopper";
                scene.hopper->motion.reset();
                scene.hopper->holes[0].open_at = 0.5;
              }),
              ElementsAre(StartsWith("hopper.holes.open_at: hole 1 opens at 0.5 s")));
  EXPECT_THAT(of([](Scene& scene) { scene.tray.rain->stop = 0.5; }),
              ElementsAre(StartsWith("tray.rain.stop: it rains until 0.5 s")));
  EXPECT_THAT(of([](Scene& scene) { scene.tray.rain->start = 0.4; }),
              ElementsAre(StartsWith("tray.rain.start: it rains from 0.4 s on")));
}

}  // namespace
}  // namespace vibrosow
