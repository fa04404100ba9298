#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "grains/packing.hpp"
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

double radius_of(const PackedGrain& grain, const std::vector<SeedLot>& lots) {
  return 0.5 * grain.size * lots[static_cast<std::size_t>(grain.lot)].diameter;
}

/// Deepest overlap of two grains, or of a grain and a wall, in m; negative when nothing touches.
double deepest_overlap(const Vessel& v, const std::vector<PackedGrain>& packed, const std::vector<SeedLot>& lots) {
  double deepest = -1;
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const double r = radius_of(packed[i], lots);
    for (std::size_t j = 0; j < i; ++j)
      deepest = std::max(
          deepest, r + radius_of(packed[j], lots) - std::hypot(packed[i].x - packed[j].x, packed[i].y - packed[j].y));
    for (const WallSegment& wall : vessel_walls(v)) {
      const Eigen::Vector2d p(packed[i].x, packed[i].y), along = wall.b - wall.a;
      const double part = std::clamp((p - wall.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      deepest = std::max(deepest, r - (p - wall.a - part * along).norm());
    }
  }
  return deepest;
}

TEST(Packing, NoPackingOverlaps) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal})
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
      for (const auto& lots : {one_lot(), two_lots(), scattered_lots()}) {
        Random random(seed);
        const Vessel v = vessel(packing, 250, packing == Packing::poured ? 0 : 0.02);
        const std::vector<PackedGrain> packed = pack(v, lots, random);
        ASSERT_EQ(packed.size(), 250u);
        EXPECT_LT(deepest_overlap(v, packed, lots), 1e-5 * diameter) << "seed " << seed;
      }
}

TEST(Packing, PouredGrainsRestOnTwoContactsOrTheFloor) {
  Random random(3);
  const Vessel v = vessel(Packing::poured, 300);
  const std::vector<PackedGrain> packed = pack(v, one_lot(), random);
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
  const std::vector<PackedGrain> packed = pack(v, one_lot(), random);
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
  const std::vector<PackedGrain> packed = pack(v, lots, random);
  EXPECT_LT(deepest_overlap(v, packed, lots), 1e-5 * diameter);
}

TEST(Packing, RandomSeedActsAndRepeats) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal}) {
    const auto first = [&](std::uint64_t seed) {
      Random random(seed);
      return pack(vessel(packing, 50), one_lot(), random).front().x;
    };
    EXPECT_EQ(first(1), first(1));
    EXPECT_NE(first(1), first(2));
  }
}

TEST(Packing, EachGrainHasItsOwnSizeAndEachClumpItsAngle) {
  for (const Packing packing : {Packing::poured, Packing::layers, Packing::hexagonal}) {
    Random random(4);
    std::set<double> sizes, angles;
    for (const PackedGrain& grain : pack(vessel(packing, 200), scattered_lots(), random)) {
      if (grain.lot == 0) sizes.insert(grain.size);
      if (grain.lot == 1) angles.insert(grain.angle);
      EXPECT_TRUE(grain.lot == 0 ? grain.angle == 0 : grain.size == 1);
    }
    EXPECT_EQ(sizes.size(), 140u);
    EXPECT_EQ(angles.size(), 60u);
    EXPECT_GE(*sizes.begin(), 0.5);
    EXPECT_LE(*sizes.rbegin(), 1.5);
  }
}

TEST(Packing, LotsComeInExactShares) {
  EXPECT_EQ(lot_counts(two_lots(), 714), (std::vector<int>{500, 214}));
  EXPECT_EQ(lot_counts(one_lot(), 714), (std::vector<int>{714}));
  const std::vector<SeedLot> thirds{
      {"a", 1, 1, Shape::ball, 1.0 / 3}, {"b", 1, 1, Shape::ball, 1.0 / 3}, {"c", 1, 1, Shape::ball, 1.0 / 3}};
  const std::vector<int> counts = lot_counts(thirds, 100);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 100);
}

TEST(Packing, TooMuchForTheVesselIsRefusedByName) {
  Vessel v = vessel(Packing::poured, 3000);
  Random random(1);
  try {
    pack(v, one_lot(), random);
    FAIL() << "3000 grains cannot fit";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("tray.fill.count: 3000"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vibrosow
