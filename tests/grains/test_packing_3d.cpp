// Beds of balls in 3D: nothing overlaps, and they are as dense as such beds are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grains/packing.hpp"
#include "grains/places.hpp"
#include "scene/input_error.hpp"
#include "scene/seed_lot.hpp"
#include "support/solid_lots.hpp"

namespace vibrosow::packing_in_space_test {
namespace {

constexpr double diameter = 4e-3;

Vessel box(Packing packing, int count) {
  Vessel v;
  v.name = "tray";
  v.length = 0.05, v.depth = 0.036, v.height = 0.2;
  v.fill = Fill{count, packing, packing == Packing::poured ? 0 : 0.02, false};
  return v;
}

std::vector<SeedLot> one_lot() {
  return {{"a", diameter, 4e-5, Shape::ball, 1.0}};
}
std::vector<SeedLot> two_lots() {
  std::vector<SeedLot> lots = {{"a", diameter, 4e-5, Shape::ball, 0.7}, {"b", 2e-3, 1e-5, Shape::ball, 0.3}};
  lots[0].sizes = {SizeDistribution::Kind::normal, diameter, 0.2 * diameter, 0.5 * diameter, 1.5 * diameter, {}, {}};
  return lots;
}

std::vector<PackedGrain> packed(const Vessel& v, const std::vector<SeedLot>& lots, std::uint64_t seed = 1) {
  Random random(seed);
  return pack(v, lots, Space::three_dimensional, random);
}

struct PackedBall {
  Eigen::Vector3d centre;  // m
  double radius;           // m
  std::size_t grain;
};

/// What was packed, ball by ball.
std::vector<PackedBall> balls_of(const std::vector<PackedGrain>& grains, const std::vector<SeedLot>& lots) {
  std::vector<PackedBall> balls;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const PackedGrain& grain = grains[i];
    const SeedLot& lot = lots[static_cast<std::size_t>(grain.lot)];
    const Eigen::Vector3d centre(grain.x, grain.y, grain.z);
    const Eigen::Matrix3d axes = rotation_matrix(grain.turned.orientation);
    if (lot.discs.empty()) balls.push_back({centre, 0.5 * grain.size * lot.diameter, i});
    for (const ClumpDisc& ball : lot.discs) {
      const Eigen::Vector3d arm = grain.size * axes * centre_of(ball);
      balls.push_back({centre + arm, grain.size * ball.radius, i});
    }
  }
  return balls;
}

/// Overlaps of two grains' balls, of one and the box, or of one and what stands in it, m; negative where they are
/// apart.
struct Overlaps {
  double deepest = -1;
  double loosest = 1;  // the deepest of the grain where that is least

  Overlaps(const Vessel& v, const std::vector<PackedGrain>& grains, const std::vector<SeedLot>& lots) {
    const Obstacles obstacles(v, Space::three_dimensional);
    const std::vector<PackedBall> balls = balls_of(grains, lots);
    std::vector<double> of_grain(grains.size(), -1);
    const auto note = [&](const PackedBall& a, double overlap) {
      of_grain[a.grain] = std::max(of_grain[a.grain], overlap);
    };
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const PackedBall& a = balls[i];
      for (std::size_t j = 0; j < i && balls[j].grain != a.grain; ++j) {
        const double overlap = a.radius + balls[j].radius - apart(v, a.centre - balls[j].centre).norm();
        note(a, overlap), note(balls[j], overlap);
      }
      note(a, a.radius - a.centre.y());
      note(a, a.radius - obstacles.distance(a.centre));
      const FloorPlace place(a.centre.x(), a.centre.z());
      const double outside = (between_ends(v, a.radius, place) - within_period(v, place)).norm();
      if (outside > 0) note(a, outside);
    }
    for (const double overlap : of_grain) deepest = std::max(deepest, overlap), loosest = std::min(loosest, overlap);
  }

 private:
  static Eigen::Vector3d apart(const Vessel& v, Eigen::Vector3d from) {
    if (v.sides == Sides::periodic) from.x() = std::remainder(from.x(), v.length);
    if (v.front_and_back == Sides::periodic) from.z() = std::remainder(from.z(), *v.depth);
    return from;
  }
};

double deepest_overlap(const Vessel& v, const std::vector<PackedGrain>& grains, const std::vector<SeedLot>& lots) {
  return Overlaps(v, grains, lots).deepest;
}

TEST(Packing3d, NothingOverlaps) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal})
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      for (const auto& lots : {one_lot(), two_lots()}) {
        const Vessel v = box(packing, 600);
        const std::vector<PackedGrain> grains = packed(v, lots, seed);
        ASSERT_EQ(grains.size(), 600u);
        EXPECT_LT(deepest_overlap(v, grains, lots), 1e-9 * diameter) << "seed " << seed;
      }
}

TEST(Packing3d, NothingOverlapsAcrossPeriodicEnds) {
  Vessel v = box(Packing::poured, 600);
  v.sides = v.front_and_back = Sides::periodic;
  EXPECT_LT(deepest_overlap(v, packed(v, one_lot()), one_lot()), 1e-9 * diameter);
}

TEST(Packing3d, PouredIntoAFunnelAndARoundVessel) {
  Vessel wedge = box(Packing::poured, 400);
  wedge.holes = {{0.025, 0.01, 0, HoleShape::slot, 0.018, 0.036}};
  wedge.funnel = 0.8;
  EXPECT_LT(deepest_overlap(wedge, packed(wedge, one_lot()), one_lot()), 1e-9 * diameter);

  Vessel round = box(Packing::poured, 400);
  round.plan = Plan::round, round.depth = round.length;
  round.holes = {{0.025, 0.01, 0, HoleShape::round, 0.025, 0}};
  EXPECT_LT(deepest_overlap(round, packed(round, one_lot()), one_lot()), 1e-9 * diameter);
  round.funnel = 0.8;
  const std::vector<PackedGrain> grains = packed(round, one_lot());
  EXPECT_LT(deepest_overlap(round, grains, one_lot()), 1e-9 * diameter);
  // It reaches down into the cone.
  EXPECT_LT(std::ranges::min_element(grains, {}, &PackedGrain::y)->y, 0.6 * diameter);
}

/// Of the whole vessel between two heights, seeds of one lot cut at them left out where their centres are beyond.
double packing_fraction(const Vessel& v, const std::vector<PackedGrain>& grains, double margin, double low, double high,
                        double volume = std::numbers::pi / 6 * diameter * diameter * diameter) {
  const auto inside = std::ranges::count_if(grains, [&](const PackedGrain& g) {
    return g.x > margin && g.x < v.length - margin && g.z > margin && g.z < *v.depth - margin && g.y > low &&
           g.y < high;
  });
  return static_cast<double>(inside) * volume / ((v.length - 2 * margin) * (*v.depth - 2 * margin) * (high - low));
}

TEST(Packing3d, PouredBedIsAsDenseAsLoosePackingsAre) {
  Vessel v = box(Packing::poured, 4000);
  v.height = 1;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    sum += packing_fraction(v, packed(v, one_lot(), seed), 2.5 * diameter, 0.03, 0.1);
  EXPECT_GT(sum / 3, 0.55);  // random loose packing
  EXPECT_LT(sum / 3, 0.63);
}

TEST(Packing3d, ClosestPackingIsClosest) {
  Vessel v = box(Packing::hexagonal, 3000);
  v.length = 12 * diameter, v.depth = 12 * diameter, v.height = 1;
  v.fill->jitter = 0;
  const double layer = diameter / std::numbers::sqrt2, low = 4 * layer, high = 16 * layer;
  // From and to between the places of even and of odd layers.
  EXPECT_NEAR(packing_fraction(v, packed(v, one_lot()), 2.25 * diameter, low, high),
              std::numbers::pi / (3 * std::numbers::sqrt2), 0.02);
}

TEST(Packing3d, LotsAreExactAndTheSameSeedGivesTheSameBed) {
  const Vessel v = box(Packing::poured, 500);
  std::vector<SeedLot> with_clumps = two_lots();
  with_clumps[1] = wheat_grains(), with_clumps[1].number_fraction = 0.3;
  for (const auto& lots : {two_lots(), with_clumps}) {
    const std::vector<PackedGrain> a = packed(v, lots, 7), b = packed(v, lots, 7);
    EXPECT_EQ(std::ranges::count(a, 1, &PackedGrain::lot), 150);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].x, b[i].x);
      EXPECT_EQ(a[i].y, b[i].y);
      EXPECT_EQ(a[i].z, b[i].z);
      EXPECT_EQ(a[i].turned.orientation, b[i].turned.orientation);
    }
  }
}

TEST(Packing3d, WhatDoesNotFitIsRefused) {
  Vessel v = box(Packing::poured, 6000);
  EXPECT_THROW(packed(v, one_lot()), InputError);
  v.depth = 3e-3;
  v.fill->count = 10;
  EXPECT_THROW(packed(v, one_lot()), InputError);
}

// Clumps.

double height_of(const std::vector<PackedGrain>& grains) {
  double sum = 0;
  for (const PackedGrain& grain : grains) sum += grain.y;
  return 2 * sum / static_cast<double>(grains.size());
}

/// Not symmetric, in many sizes, among balls.
std::vector<SeedLot> odd_clumps_and_balls() {
  SeedLot odd = solid_lot(odd_balls(), 1e-3);
  odd.number_fraction = 0.6;
  odd.sizes = {SizeDistribution::Kind::uniform, odd.diameter, 0, 0.4 * odd.diameter, 0.8 * odd.diameter, {}, {}};
  return {odd, {"ball", diameter, 4e-5, Shape::ball, 0.4}};
}

TEST(Packing3d, ClumpsTouchButDoNotOverlap) {
  const Vessel walls = box(Packing::poured, 200);
  Vessel periodic = walls;
  periodic.sides = periodic.front_and_back = Sides::periodic;
  Vessel wedge = walls;
  wedge.holes = {{0.025, 0.01, 0, HoleShape::slot, 0.018, 0.036}};
  wedge.funnel = 0.8;
  Vessel cone = walls;
  cone.plan = Plan::round, cone.depth = cone.length;
  cone.holes = {{0.025, 0.01, 0, HoleShape::round, 0.025, 0}};
  cone.funnel = 0.8;
  Vessel pieces = walls;
  pieces.sides = Sides::open;
  pieces.pieces = {{{0.01, 0.01}, {0.03, 0.02}}, {.centre = {0.04, 0.02}, .radius = 0.006, .from = 0, .to = 3.14}};
  for (const Vessel& v : {walls, periodic, wedge, cone, pieces})
    for (const auto& lots : {std::vector{wheat_grains()}, odd_clumps_and_balls()})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const std::vector<PackedGrain> grains = packed(v, lots, seed);
        ASSERT_EQ(grains.size(), 200u);
        const Overlaps overlaps(v, grains, lots);
        EXPECT_LT(overlaps.deepest, 1e-9 * diameter) << "seed " << seed;
        EXPECT_GT(overlaps.loosest, -1e-3 * diameter) << "seed " << seed;  // as near as places are found above pieces
      }
}

TEST(Packing3d, ClumpsArePouredIntoADrumUpToItsWall) {
  Vessel drum = box(Packing::poured, 60);
  drum.length = drum.height = 0.04, drum.box = false;
  drum.pieces = {{.centre = {0.02, 0.02}, .radius = 0.02, .from = 0, .to = 2 * std::numbers::pi}};
  const std::vector<SeedLot> lots = {wheat_grains()};
  const std::vector<PackedGrain> grains = packed(drum, lots);
  EXPECT_LT(deepest_overlap(drum, grains, lots), 1e-9 * diameter);
  EXPECT_LT(std::ranges::min_element(grains, {}, &PackedGrain::y)->y, 0.25 * lots[0].diameter) << "it lies";
}

// Above its middle a drum grows narrower: what touches its side at the widest place and lies a little higher is in it.
TEST(Packing3d, ADrumIsFilledAboveItsMiddle) {
  Vessel drum = box(Packing::poured, 90);
  drum.length = drum.height = 0.03, drum.depth = 0.012, drum.box = false;
  drum.pieces = {{.centre = {0.015, 0.015}, .radius = 0.015, .from = 0, .to = 2 * std::numbers::pi}};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    double furthest = 0;
    for (const PackedGrain& grain : packed(drum, one_lot(), seed))
      furthest = std::max(furthest, std::hypot(grain.x - 0.015, grain.y - 0.015));
    EXPECT_LT(furthest, 0.015 - (1 - 1e-9) * diameter / 2) << "seed " << seed;
  }
}

TEST(Packing3d, ADrumIsPouredIntoBesideItsLifters) {
  Vessel drum = box(Packing::poured, 40);
  drum.length = drum.height = 0.1, drum.depth = 0.012, drum.box = false;
  drum.pieces = {{.centre = {0.05, 0.05}, .radius = 0.05, .from = 0, .to = 2 * std::numbers::pi},
                 {.a = {0, 0.05}, .b = {0.015, 0.05}}};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::vector<PackedGrain> grains = packed(drum, one_lot(), seed);
    EXPECT_EQ(grains.size(), 40u);
    for (const PackedGrain& grain : grains)
      EXPECT_LT(std::hypot(grain.x - 0.05, grain.y - 0.05), 0.05 - 0.99 * diameter / 2);
  }
}

TEST(Packing3d, DrawnWallsMayTakeUpLittleOfTheFloor) {
  Vessel silo = box(Packing::poured, 30);
  silo.length = 1, silo.depth = 0.8, silo.height = 0.1, silo.box = false;
  const Eigen::Vector2d about(0.25, 0.6);
  silo.pieces = {{.a = {0.01, 0}, .b = {0.01, 0.1}, .about = about}, {.a = {0, 0}, .b = {0.01, 0}, .about = about}};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::vector<PackedGrain> grains = packed(silo, one_lot(), seed);
    EXPECT_EQ(grains.size(), 30u);
    for (const PackedGrain& grain : grains) EXPECT_LT(std::hypot(grain.x - 0.25, grain.z - 0.6), 0.01);
  }
}

/// Ellipsoids of wheat's proportions jam at random at 0.7 (Donev et al., Science 303, 990, 2004), rough seeds looser,
/// at about 0.6, and a poured bed is a tenth above where it settles.
TEST(Packing3d, PouredWheatIsNearlyAsDenseAsItLies) {
  const std::vector<SeedLot> lots = {wheat_grains()};
  Vessel v = box(Packing::poured, 2500);
  const std::vector<PackedGrain> grains = packed(v, lots);
  const double fraction = packing_fraction(v, grains, 1.5 * lots[0].diameter, 0.01, 0.045, clump_volume(lots[0]));
  EXPECT_GT(fraction, 0.55);
  EXPECT_LT(fraction, 0.65);
}

TEST(Packing3d, WheatLiesLowerThanTheBallsThatHoldIt) {
  Vessel v = box(Packing::poured, 600);
  v.height = 1;
  const std::vector<PackedGrain> grains = packed(v, {wheat_grains()});
  const std::vector<PackedGrain> holders = packed(v, {{"holder", wheat_grains().diameter, 29.6e-6, Shape::ball, 1}});
  EXPECT_LT(height_of(grains), 0.25 * height_of(holders)) << "m: " << height_of(grains) << " of " << height_of(holders);
}

TEST(Packing3d, PiecesThatReachTheTopAreNoReasonToRefuse) {
  Vessel split = box(Packing::poured, 40), coned = split;
  split.height = coned.height = 0.04;
  split.pieces = {{.a = {0.025, 0}, .b = {0.025, 0.04}}};
  coned.depth = coned.length, coned.plan = Plan::round;
  coned.pieces = {{.a = {0.025, 0.04}, .b = {0.007, 0.001}, .about = Eigen::Vector2d(0.025, 0.025)}};
  for (const Vessel& vessel : {split, coned})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) EXPECT_EQ(packed(vessel, one_lot(), seed).size(), 40u) << seed;
}

}  // namespace
}  // namespace vibrosow::packing_in_space_test
