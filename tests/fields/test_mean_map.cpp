#include "fields/mean_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fields/made_up_bed.hpp"

namespace vibrosow {
namespace {

constexpr double cell = 10e-3;  // m

Scene scene_of_a_tray() {
  Scene scene;
  scene.tray = made_up_tray(0.03);
  scene.lots = {{"grain", 4e-3, 30e-6, Shape::disc, 1.0}};
  scene.record = Record{{}, cell, MapView::projection};
  return scene;
}

TEST(MeanMap, PackingIsTheMeanOfAllLooks) {
  const Scene scene = scene_of_a_tray();
  MeanMapSum sum(scene);
  Snapshot one, other;
  put(one, 5e-3, 5e-3);
  put(other, 5e-3, 5e-3), put(other, 15e-3, 5e-3), put(other, 15e-3, 15e-3);
  one.time = 1, other.time = 3;
  sum.add(one), sum.add(other);
  const MeanMap map = sum.mean();
  EXPECT_EQ(map.looks, 2);
  EXPECT_EQ(map.from, 1);
  EXPECT_EQ(map.to, 3);
  EXPECT_EQ(map.grid.columns, 3);
  ASSERT_EQ(map.grid.rows, 2) << "none above the highest grain";
  const double full = std::numbers::pi * 2e-3 * 2e-3 / (cell * cell);
  EXPECT_NEAR(map.packing[map.grid.index(0, 0)], full, 1e-12);
  EXPECT_NEAR(map.packing[map.grid.index(1, 0)], full / 2, 1e-12);
  EXPECT_NEAR(map.packing[map.grid.index(1, 1)], full / 2, 1e-12);
  EXPECT_EQ(map.packing[map.grid.index(2, 0)], 0);
}

TEST(MeanMap, AVelocityIsWeighedByWhatFillsTheCell) {
  const Scene scene = scene_of_a_tray();
  MeanMapSum sum(scene);
  Snapshot few, many;
  put(few, 5e-3, 5e-3, 0.1, -0.4);
  put(many, 4e-3, 5e-3, 0.4, 0.2), put(many, 6e-3, 5e-3, 0.4, 0.2);
  sum.add(few), sum.add(many);
  const MeanMap map = sum.mean();
  EXPECT_NEAR(map.vx[0], 0.3, 1e-12);
  EXPECT_NEAR(map.vy[0], 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(map.vx[map.grid.index(2, 0)])) << "no grain was there";
}

TEST(MeanMap, APeriodicTrayHasNoGapAtItsSeam) {
  Scene scene = scene_of_a_tray();
  scene.tray.sides = Sides::periodic;
  MeanMapSum sum(scene);
  Snapshot bed;
  for (int k = 0; k < 6; ++k) put(bed, 5e-3 * k, 5e-3, 0.1 * (k == 0));  // the first on the seam
  sum.add(bed);
  const MeanMap map = sum.mean();
  const double full = std::numbers::pi * 2e-3 * 2e-3 / (cell * cell);
  for (std::int64_t column = 0; column < 3; ++column)
    EXPECT_NEAR(map.packing[map.grid.index(column, 0)], 2 * full, 1e-12);
  EXPECT_NEAR(map.vx[0], map.vx[2], 1e-12) << "half of the first is in each";
}

TEST(MeanMap, OfNoLooksOrNoGrainsHasNoCells) {
  const Scene scene = scene_of_a_tray();
  MeanMapSum sum(scene);
  EXPECT_EQ(sum.mean().grid.size(), 0u);
  sum.add(Snapshot{});
  EXPECT_EQ(sum.mean().grid.size(), 0u);
  EXPECT_EQ(sum.mean().looks, 1);
}

}  // namespace
}  // namespace vibrosow
