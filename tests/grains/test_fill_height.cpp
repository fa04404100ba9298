// How many seeds fill a vessel to a height, beside closed forms and beside what is put in.
#include "grains/fill_height.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "grains/packing.hpp"
#include "scene/input_error.hpp"
#include "scene/make_clump.hpp"
#include "support/solid_lots.hpp"

namespace vibrosow::fill_height_test {
namespace {

using std::numbers::pi;

constexpr double diameter = 4e-3;              // m
constexpr double plane = 0.82, space = 0.545;  // of a poured bed of balls

std::vector<SeedLot> balls() {
  return {{"a", diameter, 4e-5, Shape::ball, 1.0}};
}
std::vector<SeedLot> mixture() {
  return {{"a", diameter, 4e-5, Shape::ball, 0.25}, {"b", 0.5 * diameter, 5e-6, Shape::ball, 0.75}};
}

class FillHeight : public testing::TestWithParam<Space> {
 protected:
  static bool is_flat() { return GetParam() == Space::two_dimensional; }

  static Vessel box(Packing packing = Packing::poured) {
    Vessel v;
    v.name = "tray";
    v.length = 0.1, v.height = 0.08;
    if (!is_flat()) v.depth = 0.03;
    v.fill = Fill{1, packing, packing == Packing::poured ? 0 : 0.02};
    return v;
  }
  static WallPiece line(double x0, double y0, double x1, double y1) { return {.a = {x0, y0}, .b = {x1, y1}}; }

  static double seeds(const Vessel& v, double height, const std::vector<SeedLot>& lots = balls()) {
    return seeds_to_height(v, lots, GetParam(), height);
  }
  /// Of balls over an area (m2) of the plane, in 3D over all of the box's depth.
  static double over(double area) {
    return is_flat() ? plane * area / (pi / 4 * diameter * diameter)
                     : space * area * 0.03 / (pi / 6 * std::pow(diameter, 3));
  }
  /// The vessel with as many seeds as lie up to `height`.
  static Vessel filled(Vessel v, double height, const std::vector<SeedLot>& lots = balls()) {
    v.fill->count = static_cast<int>(std::round(seeds(v, height, lots)));
    return v;
  }
  static std::vector<PackedGrain> put_in(const Vessel& v, const std::vector<SeedLot>& lots = balls()) {
    Random random(3);
    return pack(v, lots, GetParam(), random);
  }
};
INSTANTIATE_TEST_SUITE_P(Spaces, FillHeight, testing::Values(Space::two_dimensional, Space::three_dimensional),
                         [](const auto& info) { return info.param == Space::two_dimensional ? "plane" : "space"; });

TEST_P(FillHeight, OfABoxIsItsFloorTimesTheHeight) {
  EXPECT_NEAR(seeds(box(), 0.03), over(0.1 * 0.03), 1e-6);
  EXPECT_NEAR(seeds(box(), 0.06), 2 * over(0.1 * 0.03), 1e-6);
  Vessel tilted = box();
  tilted.tilt = 0.1, tilted.sides = Sides::periodic;
  EXPECT_EQ(seeds(tilted, 0.03), seeds(box(), 0.03)) << "measured in the vessel's own frame";
  const double mean =
      is_flat() ? 0.25 + 0.75 / 4 : 0.25 + 0.75 / 8;  // area or volume by number, over the larger ball's
  EXPECT_NEAR(seeds(box(), 0.03, mixture()), over(0.1 * 0.03) / mean, 1e-6);
}

/// The centres of a level bed lie half as high as the bed, on the mean.
double height_of_bed(const std::vector<PackedGrain>& bed, const std::vector<SeedLot>& lots) {
  double sum = 0, weight = 0;
  for (const PackedGrain& grain : bed) {
    const double mass = lots[static_cast<std::size_t>(grain.lot)].mass;
    sum += mass * grain.y, weight += mass;
  }
  return 2 * sum / weight;
}

TEST_P(FillHeight, IsThatOfThePouredBed) {
  constexpr double height = 0.04;
  for (const std::vector<SeedLot>& lots : {balls(), mixture()})
    EXPECT_NEAR(height_of_bed(put_in(filled(box(), height, lots), lots), lots), height, 0.06 * height);
}

TEST_P(FillHeight, OfRowsIsTheLastOfTheirPlaces) {
  for (const Packing packing : {Packing::layers, Packing::hexagonal})
    for (const bool shelf : {false, true}) {
      Vessel v = box(packing);
      if (shelf) v.pieces = {line(0, 0.02, 0.06, 0.03)};
      v = filled(v, 0.05);
      EXPECT_GT(v.fill->count, 100);
      for (const PackedGrain& grain : put_in(v)) EXPECT_LE(grain.y + diameter / 2, 0.05);
      EXPECT_LE(height_of_fill(v, balls(), GetParam()), 0.05);
      EXPECT_GT(height_of_fill(v, balls(), GetParam()), 0.05 - 1.05 * diameter);
      v.height = 0.05;
      EXPECT_NO_THROW(put_in(v));
      ++v.fill->count;
      EXPECT_THROW(put_in(v), InputError) << "one more";
    }
}

TEST_P(FillHeight, LeavesOutWhatIsBeneathSlopesAndNotBeneathShelves) {
  constexpr double height = 0.04;
  const double whole = over(0.1 * height);
  Vessel slope = box();
  slope.pieces = {line(0, 0.03, 0.06, 0)};
  EXPECT_NEAR(seeds(slope, height), whole - over(0.5 * 0.06 * 0.03), 0.01 * whole);
  slope.pieces = {line(0, 0.06, 0.06, 0)};  // higher than the bed
  EXPECT_NEAR(seeds(slope, height), whole - over(0.5 * (0.06 + 0.02) * height), 0.015 * whole);
  Vessel shelf = box();
  shelf.pieces = {line(0, 0.03, 0.07, 0.03), line(0.08, 0, 0.08, 0.05)};
  EXPECT_NEAR(seeds(shelf, height), whole, 0.01 * whole);
  Vessel closed = box();
  closed.pieces = {{.centre = {0.05, 0.02}, .radius = 0.015, .from = 0, .to = 2 * pi}};
  EXPECT_NEAR(seeds(closed, height), whole - over(pi * 0.015 * 0.015), 0.01 * whole);
}

TEST_P(FillHeight, LeavesOutWhatIsBeneathAFunnel) {
  Vessel v = box();
  const double depth = v.depth.value_or(0);
  v.holes = {{.centre = 0.05, .width = 0.02, .across = depth / 2, .across_length = depth}};
  v.funnel = std::atan(0.5);  // 0.02 high at both ends
  const double beneath = 0.04 * 0.02;
  EXPECT_NEAR(seeds(v, 0.05), over(0.1 * 0.05 - beneath), 0.01 * over(0.1 * 0.05));
  EXPECT_NEAR(seeds(v, 0.01), over(0.02 * 0.01 + 2 * 0.5 * 0.02 * 0.01), 0.02 * over(0.1 * 0.01));
}

TEST_P(FillHeight, OfADrumIsASegmentOfItsCircle) {
  Vessel v = box();
  v.box = false, v.height = v.length = 0.1;
  v.pieces = {{.centre = {0.05, 0.05}, .radius = 0.05, .from = 0, .to = 2 * pi}};
  EXPECT_NEAR(seeds(v, 0.05), over(0.5 * pi * 0.05 * 0.05), 0.01 * over(pi * 0.05 * 0.05));
}

TEST_P(FillHeight, IsFoundAgainFromTheCount) {
  Vessel slope = box();
  slope.pieces = {line(0, 0.03, 0.06, 0)};
  for (const Vessel& v : {box(), slope})
    for (const double height : {0.011, 0.03, 0.0625})
      EXPECT_NEAR(height_of_fill(filled(v, height), balls(), GetParam()), height,
                  height / filled(v, height).fill->count);
  Vessel full = box();
  full.fill->count = 1'000'000;
  EXPECT_EQ(height_of_fill(full, balls(), GetParam()), full.height);
}

TEST(FillHeight3d, IsThatOfThePouredBedOfGrains) {
  constexpr double height = 0.02;
  Vessel v;
  v.name = "tray";
  v.sides = v.front_and_back = Sides::periodic;
  v.height = 0.1, v.fill = Fill{1};
  for (const SeedLot& lot : {wheat_grains(), solid_lot(elongated_solid(9e-3, 2.25e-3, 2.25e-3), 3e-5)}) {
    v.length = v.depth.emplace(4 * lot.diameter);
    v.fill->count = static_cast<int>(seeds_to_height(v, {lot}, Space::three_dimensional, height));
    Random random(3);
    EXPECT_NEAR(height_of_bed(pack(v, {lot}, Space::three_dimensional, random), {lot}), height, 0.08 * height);
  }
}

TEST(FillHeight3d, OfARoundVesselWithACone) {
  Vessel v;
  v.name = "hopper";
  v.plan = Plan::round;
  v.length = 0.1, v.depth = 0.1, v.height = 0.08;
  v.fill = Fill{1};
  const double per_volume = space / (pi / 6 * std::pow(diameter, 3));
  EXPECT_NEAR(seeds_to_height(v, balls(), Space::three_dimensional, 0.05), per_volume * pi * 0.05 * 0.05 * 0.05, 1e-6);
  v.holes = {{.centre = 0.05, .width = 0.02, .shape = HoleShape::round, .across = 0.05}};
  v.funnel = pi / 4;  // from 0.01 to 0.05 at a height of 0.04
  const double frustum = pi / 3 * 0.04 * (0.01 * 0.01 + 0.01 * 0.05 + 0.05 * 0.05);
  const double above = pi * 0.05 * 0.05 * 0.02;
  EXPECT_NEAR(seeds_to_height(v, balls(), Space::three_dimensional, 0.06), per_volume * (frustum + above),
              0.015 * per_volume * (frustum + above));
}

TEST(FillHeight3d, OfAGrooveAlongTheVessel) {
  Vessel v;
  v.name = "tray";
  v.length = 0.1, v.depth = 0.06, v.height = 0.05;
  v.fill = Fill{1};
  v.pieces = {{.a = {0, 0.02}, .b = {0.03, 0}}, {.a = {0.03, 0}, .b = {0.06, 0.02}}};
  for (WallPiece& piece : v.pieces) piece.drawn_out = DrawnOut::along;
  const double volume = 0.1 * (0.06 * 0.04 - 0.03 * 0.02);
  const double count = space * volume / (pi / 6 * std::pow(diameter, 3));
  EXPECT_NEAR(seeds_to_height(v, balls(), Space::three_dimensional, 0.04), count, 0.015 * count);
}

}  // namespace
}  // namespace vibrosow::fill_height_test
