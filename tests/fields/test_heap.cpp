#include "fields/heap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "made_up_bed.hpp"

namespace vibrosow {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double slot_left = 0.06, slot_right = 0.1, length = 0.16;  // m

Vessel box_with_slot() {
  Vessel tray = made_up_tray(length);
  tray.depth = 0.02;
  Hole slot;
  slot.centre = 0.5 * (slot_left + slot_right);
  slot.width = slot_right - slot_left;
  tray.holes = {slot};
  return tray;
}

/// Height of a heap's surface that rises from the slot's edges to both end walls, m.
double made_up_surface(double x, double left_angle, double right_angle) {
  if (x < slot_left) return (slot_left - x) * std::tan(left_angle);
  return x > slot_right ? (x - slot_right) * std::tan(right_angle) : 0;
}

/// Small grains in rows wherever they fit under that surface.
Snapshot heaps(double left_angle, double right_angle, double radius = 2e-4) {
  Snapshot s;
  for (double y = radius; y < 0.1; y += 2 * radius)
    for (double x = radius; x < length; x += 2 * radius)
      if (y < made_up_surface(x, left_angle, right_angle)) put(s, x, y, 0, 0, 0, radius);
  return s;
}

std::vector<SeedLot> balls() {
  return std::vector<SeedLot>(1);
}

TEST(Heap, TheAngleOfMadeUpHeapsIsFound) {
  for (const double angle : {15.0, 25.0, 40.0})
    EXPECT_NEAR(drained_angle(heaps(angle * degree, angle * degree), balls(), box_with_slot(), 4e-3).value() / degree,
                angle, 0.7);
}

TEST(Heap, UnequalHeapsCountTheSame) {
  const double angle = drained_angle(heaps(20 * degree, 30 * degree), balls(), box_with_slot(), 4e-3).value();
  EXPECT_NEAR(angle / degree, 25, 0.7);
}

TEST(Heap, AMirroredBedHasTheSameAngle) {
  Snapshot bed = heaps(20 * degree, 33 * degree);
  const double angle = drained_angle(bed, balls(), box_with_slot(), 4e-3).value();
  for (double& x : bed.x) x = length - x;
  EXPECT_NEAR(drained_angle(bed, balls(), box_with_slot(), 4e-3).value(), angle, 1e-12);
}

TEST(Heap, NothingOrALevelBedHasNoAngle) {
  EXPECT_EQ(drained_angle({}, balls(), box_with_slot(), 4e-3), 0.0);
  Snapshot level;
  for (int k = 0; k < 40; ++k)
    if (k < 15 || k >= 25) put(level, 2e-3 + 4e-3 * k, 2e-3);
  EXPECT_NEAR(drained_angle(level, balls(), box_with_slot(), 4e-3).value(), 0, 2 * degree);
}

TEST(Heap, SeedsOverTheSlotAreNoDrainedBed) {
  Snapshot bed = heaps(20 * degree, 20 * degree);
  put(bed, 0.5 * length, -0.01);
  EXPECT_TRUE(drained_angle(bed, balls(), box_with_slot(), 4e-3)) << "it has left";
  put(bed, 0.5 * length, 0.02);
  EXPECT_FALSE(drained_angle(bed, balls(), box_with_slot(), 4e-3));
}

TEST(Heap, OneSlotAndRoomBesideItAreNeeded) {
  Vessel tray = box_with_slot();
  EXPECT_FALSE(drained_angle({}, balls(), tray, 0.016)) << "heaps of less than 4 margins";
  tray.holes.push_back(tray.holes[0]);
  EXPECT_FALSE(drained_angle({}, balls(), tray, 4e-3));
  tray.holes.clear();
  EXPECT_FALSE(drained_angle({}, balls(), tray, 4e-3));
}

TEST(Heap, ASlopeInSpaceIsThatAlongX) {
  Snapshot bed;
  const double radius = 5e-4;
  for (int layer = 0; layer < 60; ++layer)  // each layer's balls over the gaps of the one below
    for (double z = radius * (layer % 2); z < 0.02; z += 2 * radius)
      for (double x = radius * (layer % 2); x < length; x += 2 * radius) {
        const double y = radius * (layer + 1);
        if (y < made_up_surface(x, 30 * degree, 30 * degree)) put_ball(bed, {x, y, z}, {0, 0, 0}, 0, radius);
      }
  EXPECT_NEAR(drained_angle(bed, balls(), box_with_slot(), 4e-3).value() / degree, 30, 1);
}

TEST(Heap, TheSlopeIsOfTheHighestDiscs) {
  // A stair of one step: 2 mm of disc tops beside the floor; the line through half 0, half about h has slope 1.5 h / L.
  std::vector<CoveringDisc> discs;
  for (double x = 0.05; x < 0.1; x += 1e-5) discs.push_back({x, 1e-3, 1e-3, 1});
  EXPECT_NEAR(surface_slope(discs, {0, 0.1}), 1.5 * 2e-3 / 0.1, 2e-3);
}

}  // namespace
}  // namespace vibrosow
