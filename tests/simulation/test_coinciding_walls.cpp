// Walls that lie on each other push once: drawings draw lines twice.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "scene/si_units.hpp"
#include "support/bench.hpp"

namespace vibrosow::coinciding_walls_test {
namespace {

constexpr double full_turn = 2 * Bench::pi, tolerance = 1e-3 * Bench::radius;

WallPiece drawn_line(double ax, double ay, double bx, double by) {
  WallPiece piece;
  piece.a = {ax, ay}, piece.b = {bx, by};
  return piece;
}

WallPiece drawn_arc(double radius, double from, double to) {
  WallPiece piece;
  piece.centre = {0.5, 0.5}, piece.radius = radius, piece.from = from, piece.to = to;
  return piece;
}

/// A line of (distance from the axis, height) turned about an upright axis through the middle.
WallPiece turned_line(double ra, double ha, double rb, double hb) {
  WallPiece piece = drawn_line(ra, ha, rb, hb);
  piece.about = {0.5, 0.5};
  return piece;
}

struct CoincidingCase {
  std::string name;
  std::vector<WallPiece> pieces;
  bool box = true;
  HitWall hit{};
  bool space_alone = false;
  bool round = false;
  std::optional<Vessel> other{};
};

Vessel lower_box() {
  Vessel hopper;
  hopper.name = "hopper";
  hopper.origin = {0.3, 0}, hopper.length = 0.4, hopper.height = 0.1, hopper.depth = 1;
  return hopper;
}

/// What a ball hits of which two walls lie there, or the end of one in the middle of another.
std::vector<CoincidingCase> coinciding_cases() {
  const HitWall left{{0, 0.5, 0.5}, {1, 0, 0}, {0, 1, 0}};
  const HitWall below{{0.5, 0.1, 0.5}, {0, 1, 0}, {1, 0, 0}}, beside{{0.9, 0.5, 0.5}, {-1, 0, 0}, {0, 1, 0}};
  const HitWall wall_all_round{{0.5, 0.5, 1}, {0, 0, -1}, {1, 0, 0}};
  const HitWall table{{0.6, 0.2, 0.5}, {0, 1, 0}, {1, 0, 0}};
  const double half = 0.5 * tolerance;
  return {
      {"floor_twice", {drawn_line(0, 0, 1, 0)}},
      {"floor_backwards", {drawn_line(1, 0, 0, 0)}},
      {"floor_three_times", {drawn_line(0, 0, 1, 0), drawn_line(0.1, 0, 0.9, 0)}},
      {"part_of_the_floor", {drawn_line(0.37, 0, 0.71, 0)}},
      {"little_above", {drawn_line(0.1, half, 0.9, half)}},
      {"little_below", {drawn_line(0.1, -half, 0.9, -half)}},
      {"behind_the_floor", {drawn_line(0, -4 * half, 1, -4 * half), drawn_line(0, -20 * half, 1, -20 * half)}},
      {"little_askew", {drawn_line(0.4, -1e-4 * 0.1, 0.6, 1e-4 * 0.1)}},
      {"overlapping_pieces", {drawn_line(0.2, 0, 0.6, 0), drawn_line(0.4, 0, 0.8, 0)}, false},
      {"end_in_the_middle", {drawn_line(0.2, 0, 0.5, 0)}},
      {"end_above_the_middle", {drawn_line(0.2, half, 0.5, half)}},
      {"end_below_the_middle", {drawn_line(0.2, -half, 0.5, -half)}},
      {"two_ends", {drawn_line(0.2, 0, 0.5, 0), drawn_line(0.5, 0, 0.7, 0)}},
      {"rib_from_below", {drawn_line(0.5, 0, 0.5, -0.2)}},
      {"end_wall_twice", {drawn_line(0, 0.3, 0, 0.7)}, true, left},
      {"arc_twice", {drawn_arc(0.4, 0, full_turn), drawn_arc(0.4, 0, full_turn)}, false, below},
      {"arcs_that_overlap", {drawn_arc(0.4, 4, 5), drawn_arc(0.4, 4.5, 6)}, false, below},
      {"arcs_of_nearly_one_radius", {drawn_arc(0.4, 4, 5), drawn_arc(0.4 + half, 3, 6)}, false, below},
      {"arc_and_its_part", {drawn_arc(0.4, -0.2, 0.1), drawn_arc(0.4, -1, 1)}, false, beside},
      {"hopper_floor_on_tray_floor", {}, true, {}, false, false, lower_box()},
      {"cylinder_twice", {turned_line(0.5, 0.1, 0.5, 0.9)}, true, wall_all_round, true, true},
      {"cylinder_in_part", {turned_line(0.5, 0.9, 0.5, 0.5)}, true, wall_all_round, true, true},
      {"disc_twice", {turned_line(0, 0.2, 0.3, 0.2), turned_line(0.05, 0.2, 0.2, 0.2)}, true, table, true},
      {"disc_on_plate", {turned_line(0, 0, 0.3, 0)}, true, {}, true},
      {"rim_of_disc_on_plate", {turned_line(0, 0, 0.1, 0)}, true, {{0.6, 0, 0.5}, {0, 1, 0}, {1, 0, 0}}, true},
      {"disc_on_round_floor", {turned_line(0, 0, 0.3, 0)}, true, {}, true, true},
  };
}

Bench bench_of(const CoincidingCase& of, Space space) {
  Bench bench(space);
  bench.scene.tray.pieces = of.pieces, bench.scene.tray.box = of.box;
  if (of.round) bench.scene.tray.plan = Plan::round;
  bench.scene.hopper = of.other;
  bench.scene.contact.wall.restitution = 0.5;
  return bench;
}

class CoincidingWalls : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Both, CoincidingWalls, testing::ValuesIn(both_spaces), named_by_space);

TEST_P(CoincidingWalls, GiveTheRestitutionThatWasAskedFor) {
  for (const CoincidingCase& of : coinciding_cases()) {
    if (of.space_alone && GetParam() == Space::two_dimensional) continue;
    Bench bench = bench_of(of, GetParam());
    const ImpactResult hit = wall_impact(bench, 0.4, 0, bench.contact_time() / 200, 0, 2.37, of.hit);
    EXPECT_NEAR(hit.vy / 0.4, 0.5, 0.005) << of.name;
    EXPECT_LT(std::abs(hit.vx) + hit.aside, 0.4 * 2e-3) << of.name;
  }
}

TEST_P(CoincidingWalls, AreAsStiffAsOne) {
  for (const CoincidingCase& of : coinciding_cases()) {
    if (of.space_alone && GetParam() == Space::two_dimensional) continue;
    Bench bench = bench_of(of, GetParam());
    const double depth = 2e-3 * Bench::radius;
    bench.place(of.hit.point + (Bench::radius - depth) * of.hit.normal);
    const double force = force_on(bench.start(1e-6), 0).dot(of.hit.normal);
    const double stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
    // Walls apart by half the tolerance push with the nearer one.
    EXPECT_NEAR(force / (stiffness * depth), 1,
                of.name.find("nearly") == of.name.npos && of.name.find("above") == of.name.npos ? 1e-2 : 0.26)
        << of.name;
  }
}

/// Pressed in at a fold of the floor by `angle`, which rises on both sides of the middle, over what one wall gives.
double force_at_a_fold(double angle, Space space) {
  Bench bench(space);
  const double rise = std::tan(0.5 * angle) * 0.3, depth = 6e-3 * Bench::radius;
  bench.scene.tray.pieces = {drawn_line(0.2, rise, 0.5, 0), drawn_line(0.5, 0, 0.8, rise)};
  bench.scene.tray.box = false;
  bench.place(0.5, (Bench::radius - depth) / std::cos(0.5 * angle));
  const double stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
  return force_on(bench.start(1e-6), 0).y() / (stiffness * depth * std::cos(0.5 * angle));
}

TEST_P(CoincidingWalls, InDirectionsFurtherApartThanTenDegreesAreTwo) {
  EXPECT_NEAR(force_at_a_fold(9.9 * degree, GetParam()), 1, 1e-9);
  EXPECT_NEAR(force_at_a_fold(10.1 * degree, GetParam()), 2, 1e-9);
}

TEST_P(CoincidingWalls, OneBehindTheOtherPushAsTheNearer) {
  for (const double apart : {2e-3, 1e-2, 5e-2}) {
    Bench bench(GetParam());
    bench.scene.tray.pieces = {drawn_line(0, -apart * Bench::radius, 1, -apart * Bench::radius)};
    bench.place(0.5, 0.9 * Bench::radius);
    const double stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
    EXPECT_NEAR(force_on(bench.start(1e-6), 0).y() / (stiffness * 0.1 * Bench::radius), 1, 1e-9) << apart;
  }
}

/// Pressed in deep, a ball touches the floor's middle and the end of a line to the right of it, so much above it.
double push_of_an_end(double above, Space space) {
  Bench bench(space);
  bench.scene.tray.pieces = {drawn_line(0.5 + 0.3 * Bench::radius, above * Bench::radius, 0.6, above * Bench::radius)};
  bench.place(0.5, 0.9 * Bench::radius);
  return -force_on(bench.start(1e-6), 0).x() / (Bench::mass * standard_gravity / (1e-4 * Bench::radius));
}

TEST_P(CoincidingWalls, AnEndOnAFloorDoesNotPush) {
  EXPECT_NEAR(push_of_an_end(0, GetParam()), 0, 1e-12);
  EXPECT_NEAR(push_of_an_end(0.9e-3, GetParam()), 0, 1e-12);
  const double distance = std::hypot(0.3, 0.9 - 2e-3);
  EXPECT_NEAR(push_of_an_end(2e-3, GetParam()), (1 - distance) * Bench::radius * 0.3 / distance, 1e-9);
}

/// Lines of so many degrees, as a curve is drawn by, about the middle; one of them lies at the bottom.
std::vector<WallPiece> chords(double radius, double angle) {
  std::vector<WallPiece> lines;
  const auto at = [&](int k) {
    const double turned = (k - 0.5) * angle;
    return Eigen::Vector2d(0.5 + radius * std::sin(turned), 0.5 - radius * std::cos(turned));
  };
  for (int k = -20; k <= 20; ++k) lines.push_back(drawn_line(at(k).x(), at(k).y(), at(k + 1).x(), at(k + 1).y()));
  return lines;
}

TEST_P(CoincidingWalls, LinesOfACurvePushAsItDoesHoweverFineTheyAre) {
  for (const double radius : {0.05, 0.2, 0.4})
    for (const double angle : {0.1, 0.3, 1.0, 3.0}) {
      Bench bench(GetParam());
      bench.scene.tray.pieces = chords(radius, angle * degree), bench.scene.tray.box = false;
      bench.scene.contact.wall.restitution = 0.5;
      const double bottom = 0.5 - radius * std::cos(0.5 * angle * degree);
      const ImpactResult hit =
          wall_impact(bench, 0.4, 0, bench.contact_time() / 200, 0, 2.37, {{0.5, bottom, 0.5}, {0, 1, 0}, {1, 0, 0}});
      EXPECT_NEAR(hit.vy / 0.4, 0.5, 0.005) << radius << " m by " << angle << " degrees";
    }
}

// In a bowl hardly wider than the seed lines touch it that lie far from the nearest, each like the one before it.
TEST_P(CoincidingWalls, OfTheLinesOfANarrowBowlTheNearestPushesAlone) {
  Bench bench(GetParam());
  const double radius = 1.02 * Bench::radius, angle = 3 * degree, overlap = 1e-3 * Bench::radius;
  bench.scene.tray.pieces = chords(radius, angle), bench.scene.tray.box = false;
  bench.place(0.5, 0.5 - radius * std::cos(0.5 * angle) + Bench::radius - overlap);
  const double stiffness = Bench::mass * standard_gravity / (1e-4 * Bench::radius);
  EXPECT_NEAR(force_on(bench.start(1e-6), 0).y() / (stiffness * overlap), 1, 1e-9);
}

/// Pulled down and to the right, a ball slides and rolls over walls with springs; where it is and how fast, for a
/// while.
std::vector<double> slides_over(const std::vector<WallPiece>& pieces, Space space, bool rotation, bool rolling) {
  Bench bench(space);
  bench.scene.tray.pieces = pieces, bench.scene.tray.box = false;
  bench.scene.contact.wall = {.friction = 0.3, .restitution = 0.5, .rolling_friction = rolling ? 0.1 : 0.0};
  if (rolling) bench.scene.contact.rolling = Rolling::spring;
  bench.scene.contact.friction_model = FrictionModel::spring;
  bench.scene.contact.rotation = rotation;
  bench.gravity = {0.25 * standard_gravity, -standard_gravity};
  bench.place(0.47, Bench::radius * (1 - 1e-4), 0.2, 0);
  Simulation& run = bench.start(5e-5);
  std::vector<double> seen;
  for (int step = 0; step < 5000 && run.step(); ++step)
    for (const double value : {run.grains().x[0], run.grains().y[0], run.grains().vx[0], run.grains().vy[0]})
      seen.push_back(value);
  EXPECT_GT(run.grains().x[0], 0.502);
  EXPECT_EQ(seen.size(), 20000u);
  return seen;
}

TEST_P(CoincidingWalls, KeepTheirSpringsWhereOneOfThemBeginsAndEnds) {
  const std::vector<std::vector<WallPiece>> doubled = {
      {drawn_line(0, 0, 1, 0), drawn_line(0.48, 0, 0.5, 0)},    // a piece on a long one
      {drawn_line(0.48, 0, 0.5, 0), drawn_line(0, 0, 1, 0)},    // and before it
      {drawn_line(0, 0, 0.5, 0), drawn_line(0.48, 0, 1, 0)},    // one takes over from the other
      {drawn_line(0.48, 0, 1, 0), drawn_line(0, 0, 0.5, 0)},    //
      {drawn_line(0.5, 0, 0, 0), drawn_line(1, 0, 0.48, 0)},    // drawn backwards
      {drawn_line(0, 0, 0.5, 0), drawn_line(0.48, 0, 0.52, 0),  // three
       drawn_line(0.49, 0, 1, 0)},
  };
  for (const bool rotation : {false, true})
    for (const bool rolling : {false, true}) {
      if (rolling && !rotation) continue;
      const std::vector<double> once = slides_over({drawn_line(0, 0, 1, 0)}, GetParam(), rotation, rolling);
      for (std::size_t k = 0; k < doubled.size(); ++k) {
        const std::vector<double> twice = slides_over(doubled[k], GetParam(), rotation, rolling);
        ASSERT_EQ(once.size(), twice.size());
        double largest = 0;
        for (std::size_t n = 0; n < once.size(); ++n) largest = std::max(largest, std::abs(once[n] - twice[n]));
        EXPECT_LT(largest, 1e-9) << "pieces " << k << (rotation ? ", rotation" : "") << (rolling ? ", rolling" : "");
      }
    }
}

TEST_P(CoincidingWalls, AnOpenedGateLeavesWhatIsDrawnAcrossItsHole) {
  // A ball that must not slip down a tilted tray, on a gate and a line across its hole: the gate opens under it.
  const auto end = [](double open_at, Space space) {
    Bench bench(space);
    bench.scene.tray.holes = {{.centre = 0.5, .width = 0.1, .open_at = open_at, .across = 0.5, .across_length = 1}};
    bench.scene.tray.pieces = {drawn_line(0.4, 0, 0.6, 0)};
    bench.scene.contact.wall = {.friction = 0.5, .restitution = 0.5};
    bench.scene.contact.friction_model = FrictionModel::spring;
    bench.scene.contact.rotation = false;
    bench.gravity = {0.3 * standard_gravity, -standard_gravity};
    bench.place(0.5, Bench::radius);
    Simulation& run = bench.start(2e-5);
    run.steps(10000);
    return place_of(run.grains(), 0);
  };
  const Eigen::Vector3d never_there = end(0, GetParam()), opened = end(0.1, GetParam());
  EXPECT_NEAR(never_there.y(), Bench::radius, 1e-3 * Bench::radius);
  EXPECT_LT((never_there - opened).norm(), 1e-12);
}

TEST_P(CoincidingWalls, AreAlikeInAMirror) {
  // Of pieces that overlap a little askew; all numbers have a mirror image without rounding.
  const auto fly = [](double sign, Space space) {
    Bench bench(space);
    bench.scene.tray.origin = {-0.5, 0};
    const auto x = [sign](double at) { return 0.5 + sign * (at - 0.5); };
    const auto mirrored = [&](double ax, double ay, double bx, double by) {
      return sign > 0 ? drawn_line(ax, ay, bx, by) : drawn_line(x(ax), ay, x(bx), by);
    };
    const double up = 1.0 / (1 << 20);
    bench.scene.tray.pieces = {mirrored(0.25, 0, 0.625, 0), mirrored(0.375, up, 0.75, up), mirrored(0.5, 0, 0.75, 0)};
    bench.scene.contact.wall = {.friction = 0.3, .restitution = 0.5};
    bench.scene.contact.friction_model = FrictionModel::spring;
    bench.gravity = {0, -standard_gravity};
    bench.place({sign * 0.125, Bench::radius + 0.001, 0.5}, {-sign * 0.5, -0.1, 0}, {0, 0, sign * 3});
    Simulation& run = bench.start(5e-5);
    run.steps(10000);
    const Grains& grains = run.grains();
    return std::array{sign * grains.x[0], grains.y[0], sign * grains.vx[0], grains.vy[0],
                      sign * turning_of(grains, 0).z()};
  };
  EXPECT_EQ(fly(1, GetParam()), fly(-1, GetParam()));
  EXPECT_LT(fly(1, GetParam())[0], 0) << "it has passed the seams";
}

}  // namespace
}  // namespace vibrosow::coinciding_walls_test
