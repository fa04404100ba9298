// Neighbour lists at their very margins: what comes nearer as fast as lists allow for is felt from its first touch on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/bench.hpp"
#include "vessel/nearest_on_face.hpp"
#include "vessel/nearest_point.hpp"

namespace vibrosow {
namespace {

constexpr double ball_diameter = 2 * Bench::radius, speed = 1,
                 dt = 2e-6;          // m, m/s, s; a margin lasts hundreds of steps
constexpr double largest_gap = 2.3;  // diameters: beyond the wide list
constexpr int axis_x = 0, axis_y = 1, axis_z = 2;

std::vector<int> axes_of(Space space) {
  return space == Space::two_dimensional ? std::vector{axis_x, axis_y} : std::vector{axis_x, axis_y, axis_z};
}

class ListsAtTheirMargin : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Spaces, ListsAtTheirMargin, testing::ValuesIn(both_spaces), named_by_space);

/// 0.01, 0.02, ... m, so that at every renewal some are just within a margin and some just beyond.
std::vector<double> gaps() {
  std::vector<double> all;
  for (double gap = 0.01; gap < largest_gap; gap += 0.01) all.push_back(gap * ball_diameter);
  return all;
}

/// Steps in which both sides of a gap come half of it nearer, and some more.
std::int64_t steps_to_close() {
  return static_cast<std::int64_t>((0.5 * largest_gap + 0.05) * ball_diameter / (speed * dt));
}

// Both grains move half of what a margin allows for.
TEST_P(ListsAtTheirMargin, MissNoPairThatFliesAtEachOther) {
  for (const int axis : axes_of(GetParam())) {
    SCOPED_TRACE(axis);
    Bench bench(GetParam());
    const int aside = axis == axis_x ? axis_y : axis_x;
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis), across = Eigen::Vector3d::Unit(aside);
    const std::vector<double> all = gaps();
    constexpr int in_row = 18;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const int number = static_cast<int>(k);
      const Eigen::Vector3d middle = Eigen::Vector3d::Constant(0.5) + (0.05 * (number % in_row) - 0.44) * along +
                                     (0.02 * (number / in_row) - 0.44) * across;
      const Eigen::Vector3d arm = 0.5 * (ball_diameter + all[k]) * along;
      bench.place(middle - arm, speed * along).place(middle + arm, -speed * along);
    }
    Simulation& run = bench.start(dt);
    std::vector<bool> met(all.size());
    for (std::int64_t step = 0; step < steps_to_close(); ++step) {
      ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
      for (std::size_t k = 0; k < all.size(); ++k) {
        const double apart = (place_of(run.grains(), 2 * k) - place_of(run.grains(), 2 * k + 1)).norm();
        if (apart >= ball_diameter) continue;
        met[k] = true;
        ASSERT_GT(force_on(run, 2 * k).norm(), 0) << "gap of " << all[k] / ball_diameter << " diameters, step " << step;
      }
    }
    EXPECT_TRUE(std::ranges::all_of(met, [](bool one) { return one; }));
    EXPECT_GE(run.field().neighbours().searches(), 2);
    EXPECT_GT(run.field().neighbours().prunes(), 10);
  }
}

/// m, from place to place the shortest way where a direction is periodic (1 m).
Eigen::Vector3d around(Eigen::Vector3d apart, int periodic) {
  apart[periodic] = std::remainder(apart[periodic], 1.0);
  return apart;
}

// The same across the seam of a periodic tray, which they meet at.
TEST_P(ListsAtTheirMargin, MissNoPairThatFliesAtEachOtherAcrossTheSeam) {
  for (const int axis : {axis_x, axis_z}) {
    if (axis == axis_z && GetParam() == Space::two_dimensional) continue;
    SCOPED_TRACE(axis);
    Bench bench(GetParam());
    bench.scene.tray.height = 3;
    (axis == axis_x ? bench.scene.tray.sides : bench.scene.tray.front_and_back) = Sides::periodic;
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    const std::vector<double> all = gaps();
    for (std::size_t k = 0; k < all.size(); ++k) {
      Eigen::Vector3d right(0.5, 0.02 + 0.0105 * static_cast<double>(k), 0.5), left = right;
      right[axis] = 0.5 * (ball_diameter + all[k]), left[axis] = 1 - right[axis];
      bench.place(left, speed * along).place(right, -speed * along);
    }
    Simulation& run = bench.start(dt);
    std::size_t met = 0;
    for (std::int64_t step = 0; step < steps_to_close(); ++step) {
      ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (around(place_of(run.grains(), 2 * k) - place_of(run.grains(), 2 * k + 1), axis).norm() >= ball_diameter)
          continue;
        ++met;
        ASSERT_GT(force_on(run, 2 * k).norm(), 0) << "gap of " << all[k] / ball_diameter << " diameters, step " << step;
      }
    }
    EXPECT_GT(met, all.size());
    EXPECT_LT(run.field().neighbours().searches(), 10) << "none was carried over";
  }
}

/// A hopper that stands still beside or under grains that fly at one of its walls, in a frame that goes the other way.
struct HopperWall {
  int axis;
  double side;                   // in which direction of the axis the grains fly
  double direction;              // rad, of the tray's motion in 2D
  double across;                 // rad, and out of it
  double length, height, depth;  // m, of the hopper
  int aside;                     // the axis along which the grains stand in a row
};

HopperWall hopper_wall(int axis) {
  constexpr double half_turn = std::numbers::pi, long_edge = 2.5, short_edge = 0.3;
  if (axis == axis_x) return {axis, 1, 0, 0, short_edge, long_edge, short_edge, axis_y};
  if (axis == axis_y) return {axis, -1, -0.5 * half_turn, 0, long_edge, short_edge, short_edge, axis_x};
  return {axis, 1, 0, 0.5 * half_turn, long_edge, short_edge, short_edge, axis_x};
}

// Lists are kept in the tray's frame: a grain moves half of what a margin allows for, and the hopper's wall the other.
TEST_P(ListsAtTheirMargin, MissNoWallOfAnotherVesselThatComesNearer) {
  for (const int axis : axes_of(GetParam())) {
    SCOPED_TRACE(axis);
    const HopperWall wall = hopper_wall(axis);
    Bench bench(GetParam());
    bench.scene.tray.motion = HarmonicMotion{.direction = wall.direction,
                                             .amplitude = speed / (2 * std::numbers::pi * 0.5),
                                             .frequency = 0.5,
                                             .across = wall.across};
    Vessel hopper;
    hopper.name = "hopper", hopper.origin = {0, 1.5};
    hopper.length = wall.length, hopper.height = wall.height;
    if (GetParam() == Space::three_dimensional) hopper.depth = wall.depth;
    bench.scene.hopper = hopper;
    // The wall's place along the axis: right, floor or back.
    const double at = axis == axis_x ? wall.length : axis == axis_y ? hopper.origin.y() : wall.depth;
    const std::vector<double> all = gaps();
    const Eigen::Vector3d velocity = 2 * speed * wall.side * Eigen::Vector3d::Unit(axis);
    for (std::size_t k = 0; k < all.size(); ++k) {
      Eigen::Vector3d place(0.15, hopper.origin.y() + 0.15, 0.15);
      place[wall.aside] = (wall.aside == axis_y ? hopper.origin.y() : 0) + 0.02 + 0.0105 * static_cast<double>(k);
      place[axis] = at - wall.side * (Bench::radius + all[k]);
      bench.place(place, velocity);
    }
    Simulation& run = bench.start(dt);
    std::size_t met = 0;
    for (std::int64_t step = 0; step < steps_to_close(); ++step) {
      ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
      for (std::size_t k = 0; k < all.size(); ++k) {
        const double left = wall.side * (at - place_of(run.grains(), k)[axis]) - Bench::radius;
        if (left >= 0) continue;
        ++met;
        ASSERT_GT(force_on(run, k).norm(), 0) << "gap of " << all[k] / ball_diameter << " diameters, step " << step;
      }
    }
    EXPECT_GT(met, all.size());
  }
}

/// m, from a grain's centre to the nearest wall.
double distance_to_walls(const Simulation& run, std::size_t i) {
  double nearest2 = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d at = place_of(run.grains(), i);
  const Walls& walls = run.field().walls();
  for (std::size_t w = 0; w < walls.count(); ++w)
    nearest2 = std::min(nearest2, run.grains().is_3d ? nearest_on_face(walls.placed_faces()[w], at).distance2
                                                     : nearest_point(walls.placed()[w], at.x(), at.y()).distance2);
  return std::sqrt(nearest2);
}

/// A grain flies at the far end of a wall of a low tray that turns towards it.
void expect_felt_from_the_first_touch(const Scene& scene, const Eigen::Vector3d& touching, const Eigen::Vector3d& out,
                                      double gap) {
  Bench bench;
  bench.scene = scene;
  bench.place(touching + gap * out, -speed * out);
  Simulation& run = bench.start(dt);
  bool met = false;
  for (std::int64_t step = 0; step < steps_to_close(); ++step) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    if (distance_to_walls(run, 0) >= Bench::radius) continue;
    met = true;
    ASSERT_GT(force_on(run, 0).norm(), 0) << "gap of " << gap / ball_diameter << " diameters, step " << step;
  }
  EXPECT_TRUE(met) << gap / ball_diameter;
}

std::vector<double> some_gaps() {
  std::vector<double> all;
  for (double gap = 0.01; gap < 0.2; gap += 0.01) all.push_back(gap * ball_diameter);
  for (double gap = 0.6; gap < 2.1; gap += 0.1) all.push_back(gap * ball_diameter);
  return all;
}

TEST_P(ListsAtTheirMargin, MissNoWallThatTurnsTowardsAGrain) {
  Scene scene = Bench(GetParam()).scene;
  scene.tray.height = 0.05;
  scene.tray.motion = RockingMotion{{0, 0}, 0.2, speed / (0.2 * 2 * std::numbers::pi)};  // 1 m/s at its right end
  for (const double gap : some_gaps())
    expect_felt_from_the_first_touch(scene, {0.985, Bench::radius, 0.5}, Eigen::Vector3d::UnitY(), gap);
}

/// Whatever comes to touch a wall, far from where that stood at rest, is pushed at once.
void expect_pushed_far_from_rest(Bench& bench) {
  Simulation& run = bench.start(1e-5);
  bool met = false;
  while (run.time() < 0.15) {
    ASSERT_TRUE(run.step()) << *run.guard().stop_reason();
    if (distance_to_walls(run, 0) >= Bench::radius) continue;
    met = true;
    ASSERT_GT(force_on(run, 0).norm(), 0) << "at " << run.time() << " s";
  }
  EXPECT_TRUE(met);
}

TEST_P(ListsAtTheirMargin, FindAWallWhereverItsVesselHasGone) {
  Bench rocking(GetParam());
  rocking.scene.tray.motion = RockingMotion{{0, 0}, 0.2, speed / (0.2 * 2 * std::numbers::pi)};
  rocking.place(0.9, 0.09);  // the floor comes there when it has turned by 0.1 rad
  expect_pushed_far_from_rest(rocking);
  // A grain that goes along with the tray, in whose frame lists are kept, meets a hopper's wall that stands still.
  const HarmonicMotion stroke{0, 0.3, 0.5};
  for (const int axis : {axis_x, axis_z}) {
    if (axis == axis_z && GetParam() == Space::two_dimensional) continue;
    Bench moved_past(GetParam());
    HarmonicMotion motion = stroke;
    if (axis == axis_z) motion.across = 0.5 * std::numbers::pi;
    moved_past.scene.tray.motion = motion;
    Vessel hopper;
    hopper.name = "hopper", hopper.origin = {0, 1.5}, hopper.length = hopper.height = 0.3;
    if (GetParam() == Space::three_dimensional) hopper.depth = 0.3;
    moved_past.scene.hopper = hopper;
    Eigen::Vector3d at(0.15, 1.6, 0.15);
    at[axis] = 0.3 - Bench::radius - 0.07;
    const double fastest = 2 * std::numbers::pi * stroke.frequency * stroke.amplitude;
    moved_past.place(at, fastest * Eigen::Vector3d::Unit(axis));
    expect_pushed_far_from_rest(moved_past);
  }
}

TEST(Lists3d, MissNoWallThatTurnsAboutAnUprightAxis) {
  Scene scene = Bench(Space::three_dimensional).scene;
  scene.tray.depth = 0.05;
  scene.tray.motion = TurningMotion{{0, 0}, speed, TurningAxis::upright};
  for (const double gap : some_gaps())
    expect_felt_from_the_first_touch(scene, {0.985, 0.5, Bench::radius}, Eigen::Vector3d::UnitZ(), gap);
}

}  // namespace
}  // namespace vibrosow
