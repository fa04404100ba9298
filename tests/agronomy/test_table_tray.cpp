#include "agronomy/table_tray.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "scene/input_error.hpp"
#include "support/made_up_hole_table.hpp"
#include "support/table_tray_scene.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

TEST(TableTray, OfATrayThatTheTableKnows) {
  const TableTray tray = table_tray(table_tray_scene());
  EXPECT_EQ(tray.holes, 2);
  EXPECT_NEAR(tray.at.width, 4, 1e-12);
  EXPECT_NEAR(tray.at.depth, 6, 1e-3);
  EXPECT_NEAR(tray.at.peak_speed, 2 * std::numbers::pi * 5 * 8e-3 / std::sqrt(standard_gravity * 4e-3), 1e-12);
  EXPECT_EQ(tray.at.aspect, 1);
}

/// As many balls of 2 mm as of 4 mm: half the volume of both together.
Scene mixed_scene() {
  Scene scene = table_tray_scene();
  scene.lots.push_back({.name = "small", .diameter = 2e-3, .mass = 5e-6});
  for (SeedLot& lot : scene.lots) lot.number_fraction = 0.5;
  return scene;
}

TEST(TableTray, AMixtureIsSeedsOfItsMeanVolume) {
  const TableTray tray = table_tray(mixed_scene());
  EXPECT_NEAR(tray.seed.mass, 22.5e-6, 1e-15);
  EXPECT_NEAR(std::pow(tray.seed.diameter, 3), 0.5 * (64e-9 + 8e-9), 1e-18);
  EXPECT_NEAR(tray.seed.largest, 4e-3, 1e-15);
  EXPECT_NEAR(tray.at.width, 16e-3 / tray.seed.diameter, 1e-12);
}

TEST(TableTray, RefusesWhatTheTableDoesNotTellOf) {
  const std::pair<const char*, std::function<void(Scene&)>> cases[] = {
      {"space: the tray is in 2D", [](Scene& scene) { scene.space = Space::two_dimensional; }},
      {"hopper: a hopper feeds", [](Scene& scene) { scene.hopper = scene.tray; }},
      {"tray.fill: the bed is not a fill", [](Scene& scene) { scene.tray.fill.reset(); }},
      {"tray.tilt: the floor slopes", [](Scene& scene) { scene.tray.tilt = 0.1; }},
      {"tray.holes: there are none", [](Scene& scene) { scene.tray.holes.clear(); }},
      {"tray.holes.shape: holes are not round", [](Scene& scene) { scene.tray.holes[1].shape = HoleShape::slot; }},
      {"tray.holes.width: holes are unequal", [](Scene& scene) { scene.tray.holes[1].width = 15e-3; }},
      {"tray.holes.open_at: a gate", [](Scene& scene) { scene.tray.holes[1].open_at = 1; }},
      {"tray.holes.chamfer: a hole is chamfered", [](Scene& scene) { scene.tray.holes[1].chamfer = 1e-3; }},
      {"tray.pieces: the tray is drawn", [](Scene& scene) { scene.tray.pieces.emplace_back(); }},
      {"tray.pieces: the tray is drawn", [](Scene& scene) { scene.tray.box = false; }},
      {"tray.plan: the tray is round", [](Scene& scene) { scene.tray.plan = Plan::round; }},
      {"tray.sides: a side is open", [](Scene& scene) { scene.tray.sides = Sides::open; }},
      {"tray.motion.stop: the motion ends",
       [](Scene& scene) { std::get<HarmonicMotion>(*scene.tray.motion).stop = 3; }},
      {"tray.motion: the tray stands still", [](Scene& scene) { scene.tray.motion.reset(); }},
      {"tray.motion.kind: is not harmonic", [](Scene& scene) { scene.tray.motion = RockingMotion{}; }},
      {"tray.motion.direction", [](Scene& scene) { std::get<HarmonicMotion>(*scene.tray.motion).direction = 0.3; }},
  };
  for (const auto& [message, change] : cases) {
    Scene scene = table_tray_scene();
    change(scene);
    EXPECT_THAT([&] { table_tray(scene); }, ThrowsMessage<InputError>(HasSubstr(message)));
  }
}

class Tolerance : public testing::Test {
 protected:
  /// With one of its holes as wide as this.
  static Scene with_width(double width) {
    Scene scene = table_tray_scene();
    scene.tray.holes.resize(1);
    scene.tray.holes[0].width = width;
    return scene;
  }
  static HarmonicMotion& motion(Scene& scene) { return std::get<HarmonicMotion>(*scene.tray.motion); }

  const HoleTable table{made_up_records()};
  static constexpr BuildTolerance width_alone{0.1e-3, 0};
};

TEST_F(Tolerance, IsThatOfTheTablesLaw) {
  // ln of (w - d)^(5/2) grows with the width by 2.5 / (w - d).
  const TrayTolerance found = tray_tolerance(table_tray_scene(), table, width_alone);
  EXPECT_THAT(found.outside, IsEmpty());
  EXPECT_NEAR(*found.deviation * normal_95, 2.5 / (16e-3 - 4e-3) * 0.1e-3, 2e-6);
  const TableTray tray = table_tray(table_tray_scene());
  EXPECT_NEAR(*tray_tolerance(table_tray_scene(), table, {0, 0.02}).deviation * normal_95,
              std::abs(table.slopes(tray.at).peak_speed) * 0.02, 1e-12);
}

TEST_F(Tolerance, IsAPlansAtThePlacesOfAPlan) {
  const TableTray tray = table_tray(table_tray_scene());
  EXPECT_NEAR(*tray_tolerance(table_tray_scene(), table).deviation,
              table_error(table, tray.at, tray.seed.diameter, {}).tolerance, 1e-12);
}

TEST_F(Tolerance, OfUnequalHolesEachCountsByItsOutflow) {
  Scene scene = table_tray_scene();
  scene.tray.holes[1].width = 20e-3;
  const double narrow = std::pow(4 - 1, 2.5), wide = std::pow(5 - 1, 2.5);
  const double slope = (narrow * 2.5 / 12e-3 + wide * 2.5 / 16e-3) / (narrow + wide);
  EXPECT_NEAR(*tray_tolerance(scene, table, width_alone).deviation * normal_95, slope * 0.1e-3, 2e-6);
}

TEST_F(Tolerance, OutsideTheTableIsItsNearestPlacesAndSaysSo) {
  const TrayTolerance wide = tray_tolerance(with_width(40e-3), table, width_alone);
  EXPECT_THAT(wide.outside, HasSubstr("tray.holes.width: 10 seeds is outside the table of one hole"));
  EXPECT_NEAR(*wide.deviation * 40e-3, *tray_tolerance(with_width(26e-3), table, width_alone).deviation * 26e-3, 1e-12);
  Scene fast = table_tray_scene();
  motion(fast).frequency = 50;
  EXPECT_THAT(tray_tolerance(fast, table).outside, HasSubstr("tray.motion.frequency"));
  Scene slanting = table_tray_scene();
  motion(slanting).direction = 0.3;
  EXPECT_THAT(tray_tolerance(slanting, table).outside, HasSubstr("tray.motion.direction"));
  EXPECT_EQ(tray_tolerance(slanting, table).deviation, tray_tolerance(table_tray_scene(), table).deviation);
  Scene mean = table_tray_scene();
  mean.lots[0].diameter = planned_seed(mixed_scene().lots).diameter;
  EXPECT_THAT(tray_tolerance(mixed_scene(), table).outside, HasSubstr("seeds: there are several lots"));
  EXPECT_NEAR(*tray_tolerance(mixed_scene(), table).deviation, *tray_tolerance(mean, table).deviation, 1e-12);
}

TEST_F(Tolerance, HowTheBedIsFedAndHowDeepItIsAreLeftAside) {
  const std::function<void(Scene&)> changes[] = {
      [](Scene& scene) { scene.hopper = scene.tray; }, [](Scene& scene) { scene.tray.fill->count *= 5; },
      [](Scene& scene) { scene.tray.fill.reset(); }, [](Scene& scene) { scene.tray.tilt = 0.1; },
      [](Scene& scene) { scene.tray.holes[0].open_at = 1; }};
  for (const auto& change : changes) {
    Scene scene = table_tray_scene();
    change(scene);
    const TrayTolerance found = tray_tolerance(scene, table);
    EXPECT_THAT(found.outside, IsEmpty());
    EXPECT_NEAR(*found.deviation, *tray_tolerance(table_tray_scene(), table).deviation, 1e-9);
  }
}

TEST_F(Tolerance, IsNotKnownOfSlotsAndOfTraysThatAreNotShakenToAndFro) {
  const std::pair<const char*, std::function<void(Scene&)>> cases[] = {
      {"tray.holes.shape", [](Scene& scene) { scene.tray.holes[1].shape = HoleShape::slot; }},
      {"tray.holes.shape", [](Scene& scene) { scene.tray.holes.clear(); }},
      {"tray.motion", [](Scene& scene) { scene.tray.motion.reset(); }},
      {"tray.motion", [](Scene& scene) { scene.tray.motion = RockingMotion{}; }},
      {"tray.motion", [](Scene& scene) { motion(scene).amplitude = 0; }}};
  for (const auto& [key, change] : cases) {
    Scene scene = table_tray_scene();
    change(scene);
    const TrayTolerance found = tray_tolerance(scene, table);
    EXPECT_FALSE(found.deviation) << key;
    EXPECT_THAT(found.outside, HasSubstr(key));
  }
}

}  // namespace
}  // namespace vibrosow
