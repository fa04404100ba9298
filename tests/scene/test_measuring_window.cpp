#include "scene/measuring_window.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace vibrosow {
namespace {

using Drive = MeasuringWindow::Drive;

/// Measured from 1 to 4 s.
Scene shaken(std::optional<VesselMotion> motion) {
  Scene scene;
  scene.run.measure_from = 1, scene.run.duration = 4;
  scene.tray.holes.resize(1);
  scene.tray.motion = std::move(motion);
  return scene;
}

HarmonicMotion at(double frequency) {
  return {.amplitude = 0.01, .frequency = frequency};
}

TEST(MeasuringWindow, OfWholePeriodsIsAsItWasWritten) {
  const MeasuringWindow window = measuring_window(shaken(at(9)));
  EXPECT_EQ(window.from, 1);
  EXPECT_EQ(window.to, 4);
  EXPECT_EQ(window.drive, Drive::periodic);
  EXPECT_EQ(window.periods, 27);
  EXPECT_EQ(measuring_window(shaken(at(49))).from, 1) << "4 - 147 periods is a rounding later";
}

TEST(MeasuringWindow, BeginsLaterToHoldWholePeriods) {
  const MeasuringWindow window = measuring_window(shaken(at(2.5)));
  EXPECT_DOUBLE_EQ(window.from, 1.2);  // 7 periods of 0.4 s
  EXPECT_EQ(window.to, 4);
  EXPECT_EQ(window.periods, 7);
}

TEST(MeasuringWindow, IsOfTheSlowestPartOfAllDrives) {
  SumMotion sum{{at(23), at(2.5)}};
  sum.components.push_back({.amplitude = 0, .frequency = 0.9});
  EXPECT_DOUBLE_EQ(measuring_window(shaken(sum)).from, 1.2);
  Scene scene = shaken(at(9));
  scene.hopper.emplace().motion = RockingMotion{.angle = 0.1, .frequency = 2.5};
  EXPECT_DOUBLE_EQ(measuring_window(scene).from, 1.2);
  EXPECT_DOUBLE_EQ(measuring_window(shaken(TurningMotion{.angular_velocity = -5 * std::numbers::pi})).from, 1.2);
}

TEST(MeasuringWindow, IsLeftAloneWhereNothingIsPeriodic) {
  const auto left_alone = [](const Scene& scene, Drive drive) {
    const MeasuringWindow window = measuring_window(scene);
    EXPECT_EQ(window.from, 1);
    EXPECT_EQ(window.periods, 0);
    EXPECT_EQ(window.drive, drive);
  };
  left_alone(shaken(std::nullopt), Drive::still);
  left_alone(shaken(HarmonicMotion{.amplitude = 0, .frequency = 2.5}), Drive::still);
  HarmonicMotion stopped = at(2.5);
  stopped.stop = 0.5, stopped.stop_ramp = 0.5;
  left_alone(shaken(stopped), Drive::still);
  const TableMotion table{{0, 1, 2, 3}, {0, 1e-3, 0, 1e-3}, {0, 0, 0, 0}, {0, 0, 0, 0}, {}};
  left_alone(shaken(table), Drive::aperiodic);
  left_alone(shaken(at(0.3)), Drive::periodic);  // the window is shorter than a period
  Scene closed = shaken(at(2.5));
  closed.tray.holes.clear();
  left_alone(closed, Drive::still);
}

TEST(MeasuringWindow, OfARunThatEndedEarlyEndsWithIt) {
  const MeasuringWindow window = measuring_window(shaken(at(2.5))).until(2.1);
  EXPECT_DOUBLE_EQ(window.from, 1.2);
  EXPECT_DOUBLE_EQ(window.to, 2.1);
  EXPECT_EQ(window.periods, 2);
  EXPECT_TRUE(measuring_window(shaken(at(2.5))).until(0.5).empty());
  EXPECT_EQ(measuring_window(shaken(at(2.5))).until(0.5).periods, 0);
}

TEST(BlockEnds, AreFiveOrSixOfWholePeriods) {
  const auto ends_of = [](double frequency) { return block_ends(measuring_window(shaken(at(frequency)))); };
  const std::vector<double> six = ends_of(10);  // 30 periods
  ASSERT_EQ(six.size(), 7u);
  EXPECT_DOUBLE_EQ(six[0], 1);
  EXPECT_DOUBLE_EQ(six[1], 1.5);
  EXPECT_EQ(six[6], 4);
  const std::vector<double> five = ends_of(9);  // 27 periods: 5 of 5 leave 2, 6 of 4 leave 3
  ASSERT_EQ(five.size(), 6u);
  EXPECT_DOUBLE_EQ(five[0], 4 - 25.0 / 9);
  EXPECT_DOUBLE_EQ(five[5] - five[4], 5.0 / 9);
  const std::vector<double> still = block_ends(measuring_window(shaken(std::nullopt)));
  ASSERT_EQ(still.size(), 6u);
  EXPECT_DOUBLE_EQ(still[1], 1.6);
  EXPECT_EQ(ends_of(1.4).size(), 6u);  // 4 periods are too few: blocks of time
  EXPECT_TRUE(block_ends(measuring_window(shaken(at(9))).until(0.5)).empty());
}

TEST(InstabilityEnds, AreOfWholePeriodsNearATenthOfTheWindow) {
  const auto ends_of = [](double frequency) { return instability_ends(measuring_window(shaken(at(frequency)))); };
  const std::vector<double> ten = ends_of(10);  // 30 periods
  ASSERT_EQ(ten.size(), 11u);
  EXPECT_DOUBLE_EQ(ten[0], 1);
  EXPECT_DOUBLE_EQ(ten[1], 1.3);
  EXPECT_EQ(ten[10], 4);
  EXPECT_EQ(ends_of(5).size(), 8u) << "15 periods: seven parts of two, and one is left";
  EXPECT_DOUBLE_EQ(ends_of(5)[0], 1.2);
  EXPECT_EQ(ends_of(14.0 / 3).size(), 15u) << "14 periods";
  const std::vector<double> five = ends_of(5.0 / 3);
  ASSERT_EQ(five.size(), 6u) << "five periods";
  EXPECT_DOUBLE_EQ(five[1] - five[0], 0.6);
  EXPECT_TRUE(ends_of(0.5).empty()) << "one period";
  EXPECT_TRUE(ends_of(0.1).empty()) << "a part of one";
  EXPECT_EQ(instability_ends(measuring_window(shaken(std::nullopt))).size(), 11u);
}

}  // namespace
}  // namespace vibrosow
