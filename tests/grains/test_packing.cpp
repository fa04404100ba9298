#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "grains/packing.hpp"
#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

constexpr double diameter = 4e-3;

Vessel vessel(Packing packing, int count, double jitter = 1e-3) {
  Vessel v;
  v.name = "tray";
  v.length = 0.1;
  v.height = 0.3;
  v.fill = Fill{count, packing, jitter, false};
  return v;
}

std::vector<SeedLot> one_lot() {
  return {{"a", diameter, 4e-5, Shape::ball, 1.0}};
}
std::vector<SeedLot> two_lots() {
  return {{"a", diameter, 4e-5, Shape::ball, 0.7}, {"b", 0.5 * diameter, 1e-5, Shape::ball, 0.3}};
}

std::vector<SeedLot> scattered_lots() {
  std::vector<SeedLot> lots = two_lots();
  lots[0].sizes = {SizeDistribution::Kind::normal, diameter, 0.2 * diameter, 0.5 * diameter, 1.5 * diameter, {}, {}};
  lots[1].shape = Shape::clump;
  lots[1].discs = {{-0.5e-3, 0, 0.5e-3}, {0.5e-3, 0, 0.5e-3}};
  return lots;
}

/// A cylinder lying in 2D, 20 mm long and 5 mm wide, of nine discs.
SeedLot cylinder() {
  SeedLot lot{"cylinder", 0, 4e-4, Shape::clump, 1.0};
  for (int k = -4; k <= 4; ++k) lot.discs.push_back({k * 15e-3 / 8, 0, 2.5e-3});
  lot.diameter = 2 * holding_radius(lot.discs);
  return lot;
}

/// Not symmetric, in many sizes, among single grains.
std::vector<SeedLot> hooks_and_balls() {
  SeedLot hook{"hook", 0, 4e-5, Shape::clump, 0.6};
  hook.discs = about_centre_of_mass({{0, 0, 1.5e-3}, {3e-3, 0, 1.5e-3}, {6e-3, 0, 1.5e-3}, {7e-3, 3e-3, 1e-3}});
  hook.diameter = 2 * holding_radius(hook.discs);
  hook.sizes = {SizeDistribution::Kind::uniform, hook.diameter, 0, 0.7 * hook.diameter, 1.3 * hook.diameter, {}, {}};
  return {hook, {"ball", diameter, 4e-5, Shape::ball, 0.4}};
}

struct Disc {
  double x, y, radius;
  std::size_t grain;
};

/// What was packed, disc by disc.
std::vector<Disc> discs_of(const std::vector<PackedGrain>& packed, const std::vector<SeedLot>& lots) {
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const PackedGrain& grain = packed[i];
    const SeedLot& lot = lots[static_cast<std::size_t>(grain.lot)];
    const double c = grain.size * std::cos(grain.turned.angle), s = grain.size * std::sin(grain.turned.angle);
    if (lot.discs.empty()) discs.push_back({grain.x, grain.y, 0.5 * grain.size * lot.diameter, i});
    for (const ClumpDisc& disc : lot.discs)
      discs.push_back(
          {grain.x + c * disc.x - s * disc.y, grain.y + s * disc.x + c * disc.y, grain.size * disc.radius, i});
  }
  return discs;
}

/// Deepest overlap of two grains' discs, or of one and a wall, in m; negative when nothing touches.
double deepest_overlap(const Vessel& v, const std::vector<PackedGrain>& packed, const std::vector<SeedLot>& lots) {
  double deepest = -1;
  const std::vector<Disc> discs = discs_of(packed, lots);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& a = discs[i];
    for (std::size_t j = 0; j < i; ++j) {
      const Disc& b = discs[j];
      if (a.grain != b.grain) deepest = std::max(deepest, a.radius + b.radius - std::hypot(a.x - b.x, a.y - b.y));
    }
    for (const WallSegment& wall : vessel_walls(v))
      deepest = std::max(deepest, a.radius - distance_to_wall(wall, {a.x, a.y}));
  }
  return deepest;
}

TEST(Packing, NoPackingOverlaps) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal})
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
      for (const auto& lots : {one_lot(), two_lots(), scattered_lots()}) {
        Random random(seed);
        const Vessel v = vessel(packing, 250, packing == Packing::poured ? 0 : 0.02);
        const std::vector<PackedGrain> packed = pack(v, lots, Space::two_dimensional, random);
        ASSERT_EQ(packed.size(), 250u);
        EXPECT_LT(deepest_overlap(v, packed, lots), 1e-5 * diameter) << "seed " << seed;
      }
}

TEST(Packing, PouredGrainsRestOnTwoContactsOrTheFloor) {
  Random random(3);
  const Vessel v = vessel(Packing::poured, 300);
  const std::vector<PackedGrain> packed = pack(v, one_lot(), Space::two_dimensional, random);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const double touch = 1e-5 * diameter;
    bool left = packed[i].x <= 0.5 * diameter + touch, right = packed[i].x >= v.length - 0.5 * diameter - touch;
    for (std::size_t j = 0; j < i; ++j) {
      if (std::hypot(packed[i].x - packed[j].x, packed[i].y - packed[j].y) > diameter + touch) continue;
      left |= packed[j].x <= packed[i].x;
      right |= packed[j].x >= packed[i].x;
    }
    EXPECT_TRUE(packed[i].y <= 0.5 * diameter + touch || (left && right)) << "grain " << i;
  }
}

TEST(Packing, PouredBedIsAsDenseAsRandomDiscsAre) {
  Random random(5);
  Vessel v = vessel(Packing::poured, 2000);
  v.height = 1;
  const std::vector<PackedGrain> packed = pack(v, one_lot(), Space::two_dimensional, random);
  double inside = 0;
  const double low = 0.05, high = 0.2;
  for (const PackedGrain& g : packed) inside += g.y > low && g.y < high ? 1 : 0;
  const double fraction = inside * 3.14159265 * diameter * diameter / 4 / (v.length * (high - low));
  EXPECT_GT(fraction, 0.76);
  EXPECT_LT(fraction, 0.87);
}

TEST(Packing, PouredIntoAFunnelStaysClearOfItsSlopes) {
  Vessel v = vessel(Packing::poured, 150);
  v.holes = {{0.05, 0.02}};
  v.funnel = 0.8;
  Random random(2);
  const auto lots = one_lot();
  const std::vector<PackedGrain> packed = pack(v, lots, Space::two_dimensional, random);
  EXPECT_LT(deepest_overlap(v, packed, lots), 1e-5 * diameter);
}

TEST(Packing, CylindersFillATrayThatTheirCirclesWouldNot) {
  Vessel v = vessel(Packing::poured, 2200);
  v.length = 0.57, v.height = 0.6;
  const std::vector<SeedLot> lots{cylinder()};
  Random random(1);
  const std::vector<PackedGrain> packed = pack(v, lots, Space::two_dimensional, random);
  const auto highest =
      std::ranges::max(discs_of(packed, lots), {}, [](const Disc& disc) { return disc.y + disc.radius; });
  EXPECT_LT(highest.y, 0.5);
  EXPECT_GT(highest.y, 0.4) << "the cylinders' own area is 37 cm of the tray's height";
}

TEST(Packing, ClumpsOfAnyShapeAndSizeTouchButDoNotOverlap) {
  Vessel funnel = vessel(Packing::poured, 150);
  funnel.holes = {{0.05, 0.02}};
  funnel.funnel = 0.8;
  Vessel open = vessel(Packing::poured, 150);
  open.sides = Sides::open;
  open.pieces = {{{0.02, 0.02}, {0.06, 0.04}}, {.centre = {0.08, 0.02}, .radius = 0.01, .from = 0, .to = 3.14}};
  Vessel periodic = open;
  periodic.sides = Sides::periodic;
  Vessel hopper = vessel(Packing::poured, 150);
  hopper.holes = {{0.03, 0.02}, {0.07, 0.01, 1.0}};
  for (const Vessel& v : {funnel, open, periodic, hopper})
    for (const auto& lots : {std::vector{cylinder()}, hooks_and_balls()})
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        const std::vector<PackedGrain> packed = pack(v, lots, Space::two_dimensional, random);
        ASSERT_EQ(packed.size(), 150u);
        const double deepest = deepest_overlap(v, packed, lots);
        EXPECT_LT(deepest, 1e-5 * diameter) << "seed " << seed;
        EXPECT_GT(deepest, -1e-5 * diameter) << "seed " << seed;
        for (const Disc& disc : discs_of(packed, lots)) {
          EXPECT_GT(disc.y, disc.radius - 1e-5 * diameter) << "holes are closed";
          EXPECT_NEAR(disc.x, 0.5 * v.length, 0.5 * v.length - disc.radius + 1e-5 * diameter) << "between the ends";
        }
      }
}

TEST(Packing, ClumpsArePouredIntoADrumUpToItsWall) {
  Vessel drum = vessel(Packing::poured, 20);
  drum.height = drum.length, drum.box = false;
  drum.pieces = {{.centre = {0.05, 0.05}, .radius = 0.05, .from = 0, .to = 2 * std::numbers::pi}};
  for (const auto& lots : {std::vector{cylinder()}, hooks_and_balls()}) {
    Random random(1);
    EXPECT_LT(deepest_overlap(drum, pack(drum, lots, Space::two_dimensional, random), lots), 1e-5 * diameter);
  }
}

/// As two arcs that close, as many, turned, and twice, the second time a hair larger.
TEST(Packing, ADrumIsOneHoweverItsCircleIsDrawn) {
  constexpr double pi = std::numbers::pi;
  Vessel drum = vessel(Packing::poured, 60);
  drum.height = drum.length, drum.box = false;
  const auto arc = [](double from, double to, double radius = 0.05) {
    return WallPiece{.centre = {0.05, 0.05}, .radius = radius, .from = from, .to = to};
  };
  const std::vector<WallPiece> circle = {arc(0, 2 * pi)};
  const std::vector<std::vector<WallPiece>> others = {
      {arc(0, pi), arc(pi, 2 * pi)},
      {arc(0.5 * pi, 1.5 * pi), arc(-0.5 * pi, 0.5 * pi)},
      {arc(pi, 2 * pi), arc(0, 0.7 * pi), arc(0.7 * pi, pi)},
      {arc(0, 2 * pi), arc(0, 2 * pi)},
      {arc(0, 2 * pi, 0.0500001), arc(0, 2 * pi)},
      {arc(0, pi), arc(0, 2 * pi)},
  };
  for (const Packing packing : {Packing::poured, Packing::hexagonal}) {
    drum.fill->packing = packing;
    const auto packed = [&](const std::vector<WallPiece>& pieces) {
      drum.pieces = pieces;
      Random random(1);
      return pack(drum, one_lot(), Space::two_dimensional, random);
    };
    const std::vector<PackedGrain> once = packed(circle);
    for (std::size_t k = 0; k < others.size(); ++k) {
      const std::vector<PackedGrain> all = packed(others[k]);
      for (std::size_t i = 0; i < all.size(); ++i)
        ASSERT_LT(std::hypot(all[i].x - once[i].x, all[i].y - once[i].y), k == 4 || k == 1 ? 1e-3 : 1e-12)
            << "circle " << k << ", grain " << i;
    }
  }
  for (const std::vector<WallPiece>& open : {std::vector{arc(0, pi)}, std::vector{arc(0, pi), arc(1.1 * pi, 2 * pi)},
                                             std::vector{arc(0, pi), arc(pi, 2 * pi, 0.051)}}) {
    drum.pieces = open;
    EXPECT_FALSE(drum_of(drum));
  }
}

/// On lifters at the axis and above it seeds lie outside of the circle, whose upper half is open to them.
TEST(Packing, ADrumIsPouredIntoBesideItsLifters) {
  Vessel drum = vessel(Packing::poured, 40);
  drum.height = drum.length, drum.box = false;
  for (const double height : {0.05, 0.07}) {
    drum.pieces = {{.centre = {0.05, 0.05}, .radius = 0.05, .from = 0, .to = 2 * std::numbers::pi},
                   {.a = {0.005, height}, .b = {0.02, height}},
                   {.a = {0.08, height}, .b = {0.095, height}}};
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
      for (const auto& lots : {one_lot(), hooks_and_balls()}) {
        Random random(seed);
        const std::vector<PackedGrain> packed = pack(drum, lots, Space::two_dimensional, random);
        EXPECT_EQ(packed.size(), 40u);
        for (const Disc& disc : discs_of(packed, lots))
          EXPECT_LT(std::hypot(disc.x - 0.05, disc.y - 0.05), 0.05 - 0.99 * disc.radius);
      }
  }
  drum.fill->count = 2000;
  Random random(1);
  EXPECT_THROW(pack(drum, one_lot(), Space::two_dimensional, random), InputError);
}

/// On a block seeds heap up, above the end walls while there is room beside.
TEST(Packing, AHeapIsLevelledAtTheTop) {
  Vessel block = vessel(Packing::poured, 183);
  block.height = 0.06;
  block.pieces = {
      {.a = {0.03, 0}, .b = {0.03, 0.03}}, {.a = {0.03, 0.03}, .b = {0.07, 0.03}}, {.a = {0.07, 0.03}, .b = {0.07, 0}}};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    for (const PackedGrain& grain : pack(block, one_lot(), Space::two_dimensional, random))
      EXPECT_LE(grain.y + diameter / 2, block.height);
  }
}

TEST(Packing, DrawnWallsMayTakeUpLittleOfTheLength) {
  Vessel drawn = vessel(Packing::poured, 40);
  drawn.length = 2.5, drawn.box = false;
  drawn.pieces = {
      {.a = {0.25, 0.06}, .b = {0.25, 0}}, {.a = {0.25, 0}, .b = {0.266, 0}}, {.a = {0.266, 0}, .b = {0.266, 0.06}}};
  Vessel drum = drawn;
  drum.height = 0.02;
  drum.pieces = {{.centre = {0.258, 0.01}, .radius = 0.01, .from = 0, .to = 2 * std::numbers::pi}};
  drum.fill->count = 5;
  for (const Vessel& v : {drawn, drum})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Random random(seed);
      const std::vector<PackedGrain> packed = pack(v, one_lot(), Space::two_dimensional, random);
      EXPECT_EQ(static_cast<int>(packed.size()), v.fill->count);
      for (const PackedGrain& grain : packed) EXPECT_NEAR(grain.x, 0.258, 0.008);
    }
}

TEST(Packing, RandomSeedActsAndRepeats) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal}) {
    const auto first = [&](std::uint64_t seed) {
      Random random(seed);
      return pack(vessel(packing, 50), one_lot(), Space::two_dimensional, random).front().x;
    };
    EXPECT_EQ(first(1), first(1));
    EXPECT_NE(first(1), first(2));
  }
}

TEST(Packing, EachGrainHasItsOwnSizeAndEachClumpItsAngle) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal}) {
    Random random(4);
    std::set<double> sizes, angles;
    for (const PackedGrain& grain : pack(vessel(packing, 200), scattered_lots(), Space::two_dimensional, random)) {
      if (grain.lot == 0) sizes.insert(grain.size);
      if (grain.lot == 1) angles.insert(grain.turned.angle);
      EXPECT_TRUE(grain.lot == 0 ? grain.turned.angle == 0 : grain.size == 1);
    }
    EXPECT_EQ(sizes.size(), 140u);
    EXPECT_EQ(angles.size(), 60u);
    EXPECT_GE(*sizes.begin(), 0.5);
    EXPECT_LE(*sizes.rbegin(), 1.5);
  }
}

TEST(Packing, LotsComeMixed) {
  const std::vector<SeedLot> halves{{"a", diameter, 4e-5, Shape::ball, 0.5}, {"b", diameter, 4e-5, Shape::ball, 0.5}};
  for (const Packing packing : {Packing::poured, Packing::layers}) {
    Random random(1);
    double height[2] = {0, 0};
    for (const PackedGrain& grain : pack(vessel(packing, 400), halves, Space::two_dimensional, random))
      height[grain.lot] += grain.y / 200;
    EXPECT_NEAR(height[0] / height[1], 1, 0.2);
  }
}

TEST(Packing, TooMuchForTheVesselIsRefusedByName) {
  Vessel v = vessel(Packing::poured, 3000);
  Random random(1);
  try {
    pack(v, one_lot(), Space::two_dimensional, random);
    FAIL() << "3000 grains cannot fit";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("tray.fill.count: 3000"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vibrosow
