// Beds of balls in space: nothing overlaps, and they are as dense as such beds are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grains/packing.hpp"
#include "grains/places.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
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

double radius_of(const PackedGrain& grain, const std::vector<SeedLot>& lots) {
  return 0.5 * grain.size * lots[static_cast<std::size_t>(grain.lot)].diameter;
}

/// Deepest overlap of two balls, one and the box, or one and what stands in it, m.
double deepest_overlap(const Vessel& v, const std::vector<PackedGrain>& grains, const std::vector<SeedLot>& lots) {
  const Obstacles obstacles(v);
  const auto apart = [](double a, double b, double length, Sides sides) {
    return sides == Sides::periodic ? std::remainder(a - b, length) : a - b;
  };
  double deepest = -1;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const PackedGrain& a = grains[i];
    const double r = radius_of(a, lots);
    for (std::size_t j = 0; j < i; ++j) {
      const PackedGrain& b = grains[j];
      const double dx = apart(a.x, b.x, v.length, v.sides), dz = apart(a.z, b.z, *v.depth, v.front_and_back);
      deepest = std::max(deepest, r + radius_of(b, lots) - std::hypot(dx, a.y - b.y, dz));
    }
    deepest = std::max({deepest, r - a.y, r - obstacles.distance({a.x, a.y, a.z})});
    const FloorPlace place(a.x, a.z);
    deepest = std::max(deepest, (between_ends(v, r, place) - place).norm());
  }
  return deepest;
}

TEST(PackingInSpace, NothingOverlaps) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal})
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      for (const auto& lots : {one_lot(), two_lots()}) {
        const Vessel v = box(packing, 600);
        const std::vector<PackedGrain> grains = packed(v, lots, seed);
        ASSERT_EQ(grains.size(), 600u);
        EXPECT_LT(deepest_overlap(v, grains, lots), 1e-9 * diameter) << "seed " << seed;
      }
}

TEST(PackingInSpace, NothingOverlapsAcrossPeriodicEnds) {
  Vessel v = box(Packing::poured, 600);
  v.sides = v.front_and_back = Sides::periodic;
  EXPECT_LT(deepest_overlap(v, packed(v, one_lot()), one_lot()), 1e-9 * diameter);
}

TEST(PackingInSpace, PouredIntoAFunnelAndARoundVessel) {
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

/// Of the whole vessel between two heights, balls cut at them left out where their centres are beyond.
double packing_fraction(const Vessel& v, const std::vector<PackedGrain>& grains, double margin, double low,
                        double high) {
  double volume = 0;
  for (const PackedGrain& g : grains)
    if (g.x > margin && g.x < v.length - margin && g.z > margin && g.z < *v.depth - margin && g.y > low && g.y < high)
      volume += std::numbers::pi / 6 * std::pow(diameter, 3);
  return volume / ((v.length - 2 * margin) * (*v.depth - 2 * margin) * (high - low));
}

TEST(PackingInSpace, PouredBedIsAsDenseAsLoosePackingsAre) {
  Vessel v = box(Packing::poured, 4000);
  v.height = 1;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    sum += packing_fraction(v, packed(v, one_lot(), seed), 2.5 * diameter, 0.03, 0.1);
  EXPECT_GT(sum / 3, 0.55);  // random loose packing
  EXPECT_LT(sum / 3, 0.63);
}

TEST(PackingInSpace, ClosestPackingIsClosest) {
  Vessel v = box(Packing::hexagonal, 3000);
  v.length = 12 * diameter, v.depth = 12 * diameter, v.height = 1;
  v.fill->jitter = 0;
  const double layer = diameter / std::numbers::sqrt2, low = 4 * layer, high = 16 * layer;
  // From and to between the places of even and of odd layers.
  EXPECT_NEAR(packing_fraction(v, packed(v, one_lot()), 2.25 * diameter, low, high),
              std::numbers::pi / (3 * std::numbers::sqrt2), 0.02);
}

TEST(PackingInSpace, LotsAreExactAndTheSameSeedGivesTheSameBed) {
  const Vessel v = box(Packing::poured, 500);
  const std::vector<PackedGrain> a = packed(v, two_lots(), 7), b = packed(v, two_lots(), 7);
  EXPECT_EQ(std::ranges::count(a, 1, &PackedGrain::lot), 150);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].x, b[i].x);
    EXPECT_EQ(a[i].y, b[i].y);
    EXPECT_EQ(a[i].z, b[i].z);
  }
}

TEST(PackingInSpace, WhatDoesNotFitIsRefused) {
  Vessel v = box(Packing::poured, 6000);
  EXPECT_THROW(packed(v, one_lot()), InputError);
  v.depth = 3e-3;
  v.fill->count = 10;
  EXPECT_THROW(packed(v, one_lot()), InputError);
}

}  // namespace
}  // namespace vibrosow
