#include "fields/packing_fraction.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "fields/made_up_bed.hpp"

namespace vibrosow {
namespace {

constexpr double pi = std::numbers::pi;
using V = Eigen::Vector2d;

TEST(DiscInRectangle, KnownAreas) {
  EXPECT_NEAR(disc_in_rectangle(2, V(-3, -3), V(3, 3)), 4 * pi, 1e-14) << "the whole disc";
  EXPECT_NEAR(disc_in_rectangle(2, V(-0.5, -0.5), V(0.5, 0.5)), 1, 1e-14) << "the whole rectangle";
  EXPECT_NEAR(disc_in_rectangle(1, V(0, 0), V(2, 2)), pi / 4, 4e-15) << "a quarter";
  EXPECT_NEAR(disc_in_rectangle(1, V(0.5, -2), V(2, 2)), pi / 3 - std::sqrt(3) / 4, 4e-15) << "a segment";
  // The sector of 30 degrees between the corner's two points on the circle, and two triangles less.
  EXPECT_NEAR(disc_in_rectangle(1, V(0.5, 0.5), V(2, 2)), pi / 12 - 0.5 * (std::sqrt(3) / 2 - 0.5), 4e-15);
  EXPECT_EQ(disc_in_rectangle(1, V(0.8, 0.8), V(2, 2)), 0) << "a corner outside the disc, inside its box";
  EXPECT_EQ(disc_in_rectangle(1, V(1, -2), V(2, 2)), 0) << "it touches";
  // Both sides of a narrow strip through the middle.
  EXPECT_NEAR(disc_in_rectangle(1, V(-0.1, -5), V(0.1, 5)), 2 * (0.1 * std::sqrt(0.99) + std::asin(0.1)), 4e-15);
}

RC_GTEST_PROP(PackingFraction, CellsSumToTheDisc, ()) {
  const double x = *rc::gen::inRange(-10000, 10000) * 1e-6, y = *rc::gen::inRange(-10000, 10000) * 1e-6;
  const double radius = *rc::gen::inRange(1, 9000) * 1e-6, cell = *rc::gen::inRange(800, 9000) * 1e-6;
  Snapshot s;
  put(s, x, y, 0, 0, 0, radius);
  double area = 0;
  const Grid grid = grid_over({&s}, cell);
  for (const double fraction : packing_fraction(s, {}, grid)) area += fraction * cell * cell;
  RC_ASSERT(std::abs(area - pi * radius * radius) < 1e-13 * std::max(radius * radius, cell * cell));
}

TEST(PackingFraction, HexagonalPackingFillsPiOverTwoRootThree) {
  const auto same = [](const V& at) { return at; };
  const Snapshot s = hexagonal_bed(40, same, [](const V&) { return V(0, 0); });
  // A cell of whole periods in x, and as near as may be in y: the sum over rows of a period is taken by a wide cell.
  const Grid grid{.cell = 40e-3, .first_column = 1, .first_row = 1, .columns = 1, .rows = 1};
  EXPECT_NEAR(packing_fraction(s, {}, grid).front(), pi / (2 * std::sqrt(3)), 0.005);
}

TEST(PackingFraction, AGrainAtTheCornerOfFourCellsIsSharedEvenly) {
  Snapshot s;
  put(s, 5e-3, 5e-3);
  const Grid grid = grid_over({&s}, 5e-3);
  EXPECT_EQ(grid.columns, 2);
  EXPECT_EQ(grid.rows, 2);
  EXPECT_EQ(grid.centre(3), V(7.5e-3, 7.5e-3));
  for (const double fraction : packing_fraction(s, {}, grid)) EXPECT_NEAR(fraction, pi * 4e-6 / 4 / 25e-6, 1e-14);
}

TEST(PackingFraction, ChangeShowsWhereTheBedLoosens) {
  Snapshot before, after;
  put(before, 2.5e-3, 2.5e-3);
  put(after, 12.5e-3, 2.5e-3);
  const Grid grid = grid_over({&before, &after}, 5e-3);
  const double fraction = pi * 4e-6 / 25e-6;
  const std::vector<double> change = packing_change(before, after, {}, grid);
  ASSERT_EQ(change.size(), 3u);
  EXPECT_NEAR(change[0], -fraction, 1e-14);
  EXPECT_EQ(change[1], 0);
  EXPECT_NEAR(change[2], fraction, 1e-14);
}

/// Two discs of 2 mm radius at (-1 mm, 0) and (1 mm, 0): they overlap.
SeedLot overlapping_pair() {
  SeedLot lot{.name = "pair", .diameter = 6e-3, .shape = Shape::clump};
  lot.discs = {{-1e-3, 0, 2e-3}, {1e-3, 0, 2e-3}};
  return lot;
}
constexpr double pair_area =
    4e-6 * (2 * pi - (2 * pi / 3 - 0.8660254037844386));  // less the lens of two sectors of 120 degrees

TEST(PackingFraction, AClumpIsItsDiscsWithOverlapsCountedOnce) {
  Snapshot s;
  put(s, 0, 1e-3, 0, 0, 0, 6e-3);  // twice the lot's size
  s.angle = {pi / 2};
  s.area = {4 * pair_area};
  const auto covering = covering_discs(s, {overlapping_pair()});
  ASSERT_EQ(covering.size(), 2u);
  double area = 0;
  for (const CoveringDisc& disc : covering) {
    EXPECT_NEAR(disc.x, 0, 1e-18);
    EXPECT_EQ(disc.radius, 4e-3);
    area += disc.fraction * pi * disc.radius * disc.radius;
  }
  EXPECT_NEAR(covering[0].y, -1e-3, 1e-18) << "turned by a right angle";
  EXPECT_NEAR(covering[1].y, 3e-3, 1e-18);
  EXPECT_NEAR(area, 4 * pair_area, 1e-18);
  double in_cells = 0;
  const Grid grid = grid_over({&s}, 1e-3);
  for (const double fraction : packing_fraction(s, {overlapping_pair()}, grid)) in_cells += fraction * 1e-6;
  EXPECT_NEAR(in_cells, 4 * pair_area, 1e-17);
}

using V3 = Eigen::Vector3d;

TEST(BallInBox, KnownVolumes) {
  const double far = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(ball_in_box(2, V3(-3, -3, -3), V3(3, 3, 3)), 32 * pi / 3, 1e-13) << "the whole ball";
  EXPECT_NEAR(ball_in_box(2, V3(-far, -far, -far), V3(far, far, far)), 32 * pi / 3, 1e-13);
  EXPECT_NEAR(ball_in_box(2, V3(-0.5, -0.25, -1), V3(0.5, 0.5, 0.5)), 1.125, 1e-13) << "the whole box";
  EXPECT_NEAR(ball_in_box(1, V3(0, 0, 0), V3(2, 2, 2)), pi / 6, 1e-14) << "an eighth";
  // A cap of height h is pi h^2 (3 - h) / 3.
  const double cap = pi * 0.16 * 2.6 / 3;
  EXPECT_NEAR(ball_in_box(1, V3(0.6, -2, -2), V3(2, 2, 2)), cap, 1e-14);
  EXPECT_NEAR(ball_in_box(1, V3(-2, 0.6, -2), V3(2, 2, 2)), cap, 1e-14);
  EXPECT_NEAR(ball_in_box(1, V3(-2, -2, -2), V3(2, 2, -0.6)), cap, 1e-14);
  EXPECT_NEAR(ball_in_box(1, V3(-2, -2, 0.6), V3(0, 2, 2)), cap / 2, 1e-14) << "half a cap";
  EXPECT_NEAR(ball_in_box(1, V3(-0.3, -2, -2), V3(0.3, 2, 2)), pi * (0.6 - 2 * 0.027 / 3), 1e-14) << "a disc";
  EXPECT_EQ(ball_in_box(1, V3(0.6, 0.6, 0.6), V3(2, 2, 2)), 0) << "a corner outside the ball, inside its box";
  EXPECT_EQ(ball_in_box(1, V3(1, -2, -2), V3(2, 2, 2)), 0) << "it touches";
}

/// By the midpoint rule over discs.
double ball_in_box_by_discs(double radius, const V3& low, const V3& high, int discs) {
  const double from = std::max(low.z(), -radius), to = std::min(high.z(), radius), step = (to - from) / discs;
  double volume = 0;
  for (int k = 0; k < discs && step > 0; ++k) {
    const double z = from + (k + 0.5) * step;
    volume += step * disc_in_rectangle(std::sqrt(radius * radius - z * z), low.head<2>(), high.head<2>());
  }
  return volume;
}

RC_GTEST_PROP(BallInBox, IsTheSumOfItsDiscsWhicheverAxisTheyAreCutAlong, ()) {
  const auto any_place = [] { return *rc::gen::inRange(-130, 131) * 1e-2; };
  V3 low(any_place(), any_place(), any_place()), high(any_place(), any_place(), any_place());
  for (int axis = 0; axis < 3; ++axis)
    if (low[axis] > high[axis]) std::swap(low[axis], high[axis]);
  const double volume = ball_in_box(1, low, high);
  RC_ASSERT(std::abs(volume - ball_in_box_by_discs(1, low, high, 3000)) < 2e-6);
  for (int turn = 0; turn < 2; ++turn) {
    low = V3(low.y(), low.z(), low.x()), high = V3(high.y(), high.z(), high.x());
    RC_ASSERT(std::abs(ball_in_box(1, low, high) - volume) < 1e-13);
  }
}

RC_GTEST_PROP(PackingFraction, CellsSumToTheBallInProjectionAndInSlices, ()) {
  const auto any_place = [] { return *rc::gen::inRange(-10000, 10000) * 1e-6; };
  const double radius = *rc::gen::inRange(1, 9000) * 1e-6, cell = *rc::gen::inRange(800, 9000) * 1e-6;
  Snapshot s;
  put_ball(s, V3(any_place(), any_place(), any_place()), V3::Zero(), 0, radius);
  const Grid grid = grid_over({&s}, cell);
  const auto filled = [&](const MapPart& part) {
    double volume = 0;
    for (const double fraction : packing_fraction(s, {}, grid, part)) volume += fraction * cell * cell * part.depth();
    return volume;
  };
  const double rounding = 1e-13 * std::max(radius, cell) * std::max(radius, cell) * std::max(radius, cell);
  RC_ASSERT(std::abs(filled({-20e-3, 20e-3, false}) - s.volume[0]) < rounding);
  double sliced = 0;
  for (int k = -4; k < 4; ++k) sliced += filled({k * 5e-3, (k + 1) * 5e-3, true});
  RC_ASSERT(std::abs(sliced - s.volume[0]) < 10 * rounding);
}

TEST(PackingFraction, AProjectionIsTheMeanOverTheDepth) {
  Snapshot s;
  put_ball(s, V3(5e-3, 5e-3, 3e-3)), put_ball(s, V3(2.5e-3, 2.5e-3, 19e-3));
  put_ball(s, V3(5e-3, 5e-3, 25e-3));  // fallen over the back
  const Grid grid = grid_over({&s}, 5e-3);
  const auto fraction = packing_fraction(s, {}, grid, {0, 20e-3, false});
  const double ball = s.volume[0] / (25e-6 * 20e-3);
  ASSERT_EQ(fraction.size(), 4u);
  EXPECT_NEAR(fraction[0], 1.25 * ball, 1e-14) << "a ball of which a part is behind the back is whole";
  for (const std::size_t k : {1u, 2u, 3u}) EXPECT_NEAR(fraction[k], 0.25 * ball, 1e-14);
}

TEST(MapPart, IsAllOfTheDepthOrACellInItsMiddle) {
  Scene scene;
  scene.record = Record{{0}, 5e-3};
  EXPECT_FALSE(map_part(scene).cut);
  scene.space = Space::three_dimensional;
  scene.tray.depth = 0.06;
  EXPECT_EQ(map_part(scene).front, 0);
  EXPECT_EQ(map_part(scene).back, 0.06);
  scene.record->view = MapView::slice;
  EXPECT_TRUE(map_part(scene).cut);
  EXPECT_NEAR(map_part(scene).front, 0.0275, 1e-15);
  EXPECT_NEAR(map_part(scene).depth(), 5e-3, 1e-15);
  scene.tray.depth = 2e-3;
  EXPECT_EQ(map_part(scene).depth(), 2e-3) << "no thicker than the tray";
}

TEST(PackingFraction, AClumpInSpaceIsItsBallsWithOverlapsCountedOnce) {
  SeedLot lot = overlapping_pair();
  lot.discs[0].z = lot.discs[1].z = 0.5e-3;
  Snapshot s;
  put_ball(s, V3(0, 1e-3, 2e-3), V3::Zero(), 0, 6e-3);  // twice the lot's size
  // Its x axis lies across, its z axis upright: a third of a turn about the diagonal, z to y, y to x, x to z.
  s.q_w = {0.5}, s.q_x = s.q_y = s.q_z = {-0.5};
  // Less the lens of two caps of half the overlap's height, pi h^2 (3 r - h) / 3 each.
  s.volume[0] = 2 * (256e-9 * pi / 3) - 2 * (pi * 4e-6 * 10e-3 / 3);
  const auto covering = covering_discs(s, {lot});
  ASSERT_EQ(covering.size(), 2u);
  double volume = 0;
  for (const CoveringDisc& ball : covering) {
    EXPECT_NEAR(ball.x, 0, 1e-18);
    EXPECT_NEAR(ball.y, 2e-3, 1e-18);
    EXPECT_EQ(ball.radius, 4e-3);
    volume += ball.fraction * 4 * pi / 3 * 64e-9;
  }
  EXPECT_NEAR(covering[0].z, 0, 1e-18);
  EXPECT_NEAR(covering[1].z, 4e-3, 1e-18);
  EXPECT_NEAR(volume, s.volume[0], 1e-20);
  double in_cells = 0;
  const Grid grid = grid_over({&s}, 1e-3);
  for (const double fraction : packing_fraction(s, {lot}, grid, {-5e-3, 10e-3, false})) in_cells += fraction * 15e-9;
  EXPECT_NEAR(in_cells, s.volume[0], 1e-19);
}

TEST(BedPacking, OfABodyCentredPacking3d) {
  const auto same = [](const V3& at) { return at; };
  Snapshot s = body_centred_bed(24, same, [](const V3&) { return V3(0, 0, 0); });
  Vessel tray = made_up_tray(0.12);
  tray.depth = 0.12;
  // Two balls a cell of 5 mm; 60 mm are twelve cells along and across, and what remains is part of a layer of 2.5 mm.
  const double fraction = 2 * s.volume[0] / 125e-9;
  EXPECT_NEAR(bed_packing(s, {}, tray, 10e-3).value(), fraction, 0.03 * fraction);
  for (std::size_t i = 0; i < s.size(); ++i)
    if (s.z[i] < 27e-3 || s.z[i] > 93e-3) s.radius[i] = 1e-6;
  EXPECT_NEAR(bed_packing(s, {}, tray, 10e-3).value(), fraction, 0.03 * fraction) << "front and back do not count";
}

TEST(BedPacking, IsThatOfTheMiddleBelowThreeQuarters) {
  const auto same = [](const V& at) { return at; };
  Snapshot s = hexagonal_bed(40, same, [](const V&) { return V(0, 0); });  // 156 mm wide and 135 mm high
  Vessel tray = made_up_tray(0.16);
  tray.height = 0.2;
  // 80 mm are twenty periods in x; what remains is half a row, at most, of the 22 between the heights.
  EXPECT_NEAR(bed_packing(s, {}, tray, 20e-3).value(), pi / (2 * std::sqrt(3)), 0.02);
  const double full = bed_packing(s, {}, tray, 20e-3).value();
  for (std::size_t i = 0; i < s.size(); ++i)
    if (s.x[i] < 36e-3 || s.x[i] > 124e-3 || s.y[i] < 15e-3) s.area[i] = 0, s.radius[i] = 1e-6;
  EXPECT_NEAR(bed_packing(s, {}, tray, 20e-3).value(), full, 0.02) << "walls and floor do not count";
  for (std::size_t i = 0; i < s.size(); i += 2) s.x[i] = -1;
  EXPECT_LT(bed_packing(s, {}, tray, 20e-3).value(), 0.6 * full);
}

TEST(BedPacking, NoneForABedTooLow) {
  Snapshot s;
  put(s, 20e-3, 2e-3);
  EXPECT_FALSE(bed_packing(s, {}, made_up_tray(0.04), 5e-3));
  EXPECT_FALSE(bed_packing(Snapshot{}, {}, made_up_tray(0.04), 5e-3));
}

TEST(Grid, CoversNothingWithoutGrainsAndRefusesACellOfNothing) {
  const Snapshot s;
  EXPECT_EQ(grid_over({&s}, 1e-3).size(), 0u);
  EXPECT_THROW(grid_over({&s}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
