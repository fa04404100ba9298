#include "calibration/repose_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../fields/made_up_bed.hpp"

namespace vibrosow::repose_metrics_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A box of 160 mm with a slot of 40 mm, and grains of 1 mm: filled in square rows, drained to heaps of 25 degrees.
struct MadeUp {
  Scene scene;
  Run run;
};

MadeUp made_up(double area_per_second) {
  MadeUp made;
  made.scene.lots.resize(1);
  made.scene.tray = made_up_tray(0.16);
  Hole slot;
  slot.centre = 0.08, slot.width = 0.04;
  made.scene.tray.holes = {slot};
  Snapshot filled, drained;
  for (double y = 5e-4; y < 0.05; y += 1e-3)
    for (double x = 5e-4; x < 0.16; x += 1e-3) put(filled, x, y, 0, 0, 0, 5e-4);
  for (std::size_t i = 0; i < filled.size(); ++i) {
    const double x = filled.x[i], beside = x < 0.06 ? 0.06 - x : x - 0.1;
    if (beside > 0 && filled.y[i] < beside * std::tan(25 * degree)) put(drained, x, filled.y[i], 0, 0, 0, 5e-4);
  }
  const double area = filled.area[0];
  made.run.snapshots = {filled, drained};
  for (int k = 0; k < 1000; ++k) made.run.events.push_back({0.4 + k * area / area_per_second, 1, 0, k, 3e-5, 0.08, 1});
  return made;
}

TEST(ReposeMetrics, OfAMadeUpBox) {
  const double rate = 0.5 * (std::numbers::pi / 4) * std::sqrt(standard_gravity) * std::pow(0.04, 1.5);
  const MadeUp made = made_up(rate);
  const ReposeMetrics metrics = repose_metrics(made.scene, made.run);
  EXPECT_NEAR(metrics.angle.value() / degree, 25, 1);
  EXPECT_NEAR(metrics.packing.value(), std::numbers::pi / 4, 0.01);
  EXPECT_NEAR(metrics.discharge.value(), 0.5, 0.01);
}

TEST(ReposeMetrics, ACloggedSlotHasNeitherAngleNorDischarge) {
  MadeUp made = made_up(1e-2);
  made.run.snapshots.back() = made.run.snapshots.front();
  const ReposeMetrics metrics = repose_metrics(made.scene, made.run);
  EXPECT_FALSE(metrics.angle || metrics.discharge);
  EXPECT_TRUE(metrics.packing);
}

TEST(ReposeMetrics, TwoRecordsAndOneHoleAreNeeded) {
  MadeUp made = made_up(1e-2);
  made.run.snapshots.pop_back();
  EXPECT_THROW(repose_metrics(made.scene, made.run), std::invalid_argument);
}

TEST(AspectRatio, IsLengthOverWidth) {
  Scene scene;
  scene.lots.resize(1);
  EXPECT_EQ(aspect_ratio(scene), 1);
  scene.lots[0].discs = {{-1e-3, 0, 1e-3}, {1e-3, 0, 1e-3}};
  scene.lots[0].diameter = 4e-3;
  EXPECT_DOUBLE_EQ(aspect_ratio(scene), 2);
}

}  // namespace
}  // namespace vibrosow::repose_metrics_test
