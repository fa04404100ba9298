// One scene in the plane and in space.
#include "scene/spaces.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

Scene tray() {
  Scene scene;
  scene.lots = {{"a", 4e-3, 4e-5, Shape::ball, 0.5}, {"b", 2e-3, 1e-5, Shape::ball, 0.5}};
  scene.tray.name = "tray";
  scene.tray.length = 0.5, scene.tray.height = 0.1, scene.tray.depth = 0.06;
  scene.tray.holes = {{0.2, 0.01}, {0.3, 0.01}};
  scene.tray.fill = Fill{500, Packing::poured, 0, false};
  scene.tray.rain = Rain{100, 0, 0.5, 0.1};
  return scene;
}

TEST(Spaces, ASliceIsDrawnOutOverTheDepthAndCutAgain) {
  const Scene plane = tray(), space = in_space(plane);
  EXPECT_NEAR(slices_of_tray(plane).value(), 20, 1e-12);  // of seeds 3 mm thick in the mean
  EXPECT_EQ(space.space, Space::three_dimensional);
  EXPECT_EQ(space.tray.fill->count, 10000);
  EXPECT_NEAR(space.tray.rain->rate, 2000, 1e-9);
  EXPECT_EQ(space.tray.holes[0].across_length, 0.06);
  EXPECT_EQ(space.tray.holes[0].across, 0.03);
  EXPECT_TRUE(in_plane(space) == plane);
}

TEST(Spaces, ASceneStaysInItsOwnSpace) {
  const Scene plane = tray(), space = in_space(plane);
  EXPECT_TRUE(in_plane(plane) == plane);
  EXPECT_TRUE(in_space(space) == space);
}

TEST(Spaces, RowsOfRoundHolesBecomeSlotsAndARoundVesselIsCutThroughItsMiddle) {
  Scene scene = in_space(tray());
  scene.tray.holes = {{0.2, 0.01, 0, HoleShape::round, 0.015, 0},
                      {0.2, 0.01, 0, HoleShape::round, 0.045, 0},
                      {0.3, 0.01, 0, HoleShape::round, 0.015, 0}};
  Vessel hopper;
  hopper.name = "hopper";
  hopper.plan = Plan::round;
  hopper.length = 0.06, hopper.depth = 0.06, hopper.height = 0.1, hopper.front = 0.01;
  hopper.fill = Fill{1000, Packing::poured, 0, true};
  scene.hopper = hopper;
  const Scene plane = in_plane(scene);
  ASSERT_EQ(plane.tray.holes.size(), 2u);
  EXPECT_EQ(plane.tray.holes[0].shape, HoleShape::slot);
  EXPECT_EQ(plane.tray.fill->count, 500);
  // The chord through the middle over the mean chord is 4 / pi.
  EXPECT_EQ(plane.hopper->fill->count, std::lround(1000 / 20.0 * 4 / std::numbers::pi));
  EXPECT_EQ(plane.hopper->plan, Plan::rectangle);
}

TEST(Spaces, WithoutADepthThereIsNoSpace) {
  Scene scene = tray();
  scene.tray.depth.reset();
  EXPECT_FALSE(slices_of_tray(scene));
  EXPECT_THROW(in_space(scene), InputError);
}

}  // namespace
}  // namespace vibrosow
