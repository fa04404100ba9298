#include "scene/clump_shape.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vibrosow::clump_shape_test {
namespace {

constexpr double pi = std::numbers::pi;

void expect_plate(const std::vector<ClumpDisc>& discs, double area, double x, double y, double gyration2) {
  const Plate plate = plate_of(discs);
  const double size = std::sqrt(area);
  EXPECT_NEAR(plate.area, area, 1e-13 * area);
  EXPECT_NEAR(plate.centre.x(), x, 1e-13 * size);
  EXPECT_NEAR(plate.centre.y(), y, 1e-13 * size);
  EXPECT_NEAR(plate.gyration2, gyration2, 1e-12 * gyration2);
}

/// The same by thin level strips, in each of which the discs cover intervals.
Plate plate_by_strips(const std::vector<ClumpDisc>& discs, int strips) {
  double low = 1e300, high = -1e300;
  for (const ClumpDisc& d : discs) low = std::min(low, d.y - d.radius), high = std::max(high, d.y + d.radius);
  const double step = (high - low) / strips;
  double area = 0, sx = 0, sy = 0, polar = 0;
  for (int k = 0; k < strips; ++k) {
    const double y = low + (k + 0.5) * step;
    std::vector<std::pair<double, double>> spans;
    for (const ClumpDisc& d : discs) {
      const double half2 = d.radius * d.radius - (y - d.y) * (y - d.y);
      if (half2 > 0) spans.emplace_back(d.x - std::sqrt(half2), d.x + std::sqrt(half2));
    }
    std::sort(spans.begin(), spans.end());
    double reached = -1e300;
    for (auto [a, b] : spans) {
      a = std::max(a, reached);
      if (b <= a) continue;
      reached = b;
      area += (b - a) * step;
      sx += (b * b - a * a) / 2 * step;
      sy += (b - a) * y * step;
      polar += ((b * b * b - a * a * a) / 3 + (b - a) * y * y) * step;
    }
  }
  const Eigen::Vector2d centre(sx / area, sy / area);
  return {area, centre, polar / area - centre.squaredNorm()};
}

double cap(double r, double height) {
  return pi * height * height * (3 * r - height) / 3;
}

TEST(VolumeOfBalls, OneAndSeveralApartOrWithinEachOther) {
  EXPECT_NEAR(volume_of_balls({{0.3, -0.4, 2}}), 4 * pi / 3 * 8, 1e-9 * 32);
  EXPECT_NEAR(volume_of_balls({{0, 0, 2}, {5, 0, 1}}), 4 * pi / 3 * 9, 1e-9 * 36);
  EXPECT_NEAR(volume_of_balls({{0, 0, 2}, {0.5, 0.5, 1}, {0, 0, 2}}), 4 * pi / 3 * 8, 1e-9 * 32);
}

TEST(VolumeOfBalls, TwoThatOverlapLoseTheirLens) {
  const double d = 2.5, r = 2, s = 1, x = (d * d + r * r - s * s) / (2 * d);
  const double lens = cap(r, r - x) + cap(s, s - (d - x));
  EXPECT_NEAR(volume_of_balls({{0, 0, r}, {d, 0, s}}), 4 * pi / 3 * (r * r * r + s * s * s) - lens, 1e-8);
}

TEST(VolumeOfBalls, ARowIsItsBodyOfRevolution) {
  for (const auto& row : {elongated(7e-3, 3e-3), drop(9e-3, 3e-3)}) {
    const int strips = 400000;
    double low = 1, high = -1, volume = 0;
    for (const ClumpDisc& d : row) low = std::min(low, d.x - d.radius), high = std::max(high, d.x + d.radius);
    for (int k = 0; k < strips; ++k) {
      const double x = low + (k + 0.5) * (high - low) / strips;
      double radius2 = 0;
      for (const ClumpDisc& d : row) radius2 = std::max(radius2, d.radius * d.radius - (x - d.x) * (x - d.x));
      volume += pi * radius2 * (high - low) / strips;
    }
    EXPECT_NEAR(volume_of_balls(row), volume, 1e-8 * volume);
  }
}

TEST(VolumeOfBalls, TurningAndScalingAClump) {
  EXPECT_TRUE(rc::check("volume turns with nothing and scales with the cube", [] {
    std::vector<ClumpDisc> discs, turned;
    const double angle = *rc::gen::inRange(0, 628) / 100.0, factor = *rc::gen::inRange(1, 50) / 10.0;
    const int count = *rc::gen::inRange(1, 6);
    for (int k = 0; k < count; ++k) {
      const double x = *rc::gen::inRange(-20, 20) / 10.0, y = *rc::gen::inRange(-20, 20) / 10.0;
      const double r = *rc::gen::inRange(5, 20) / 10.0;
      discs.push_back({x, y, r});
      turned.push_back({factor * (x * std::cos(angle) - y * std::sin(angle)),
                        factor * (x * std::sin(angle) + y * std::cos(angle)), factor * r});
    }
    const double volume = volume_of_balls(discs);
    RC_ASSERT(std::abs(volume_of_balls(turned) - volume * factor * factor * factor) <
              1e-7 * volume * factor * factor * factor);
  }));
}

TEST(Plate, OneDisc) {
  expect_plate({{0, 0, 2e-3}}, pi * 4e-6, 0, 0, 2e-6);
  expect_plate({{0.3, -0.4, 2e-3}}, pi * 4e-6, 0.3, -0.4, 2e-6);
}

TEST(Plate, DiscsApartFollowFromParallelAxes) {
  const double r1 = 1, r2 = 2, d = 5;
  const double a1 = pi, a2 = 4 * pi, x = a2 * d / (a1 + a2);
  const double polar = a1 * (r1 * r1 / 2 + x * x) + a2 * (r2 * r2 / 2 + (d - x) * (d - x));
  expect_plate({{0, 1, r1}, {d, 1, r2}}, a1 + a2, x, 1, polar / (a1 + a2));
  // Paper A's dipole: two equal discs on a rod, r^2 / 2 + (d / 2)^2, touching or apart.
  for (const double distance : {2.0, 7.0})
    expect_plate(dipole(2, distance), 2 * pi, 0, 0, 0.5 + distance * distance / 4);
}

TEST(Plate, OverlappingDiscsAgreeWithTheLens) {
  const double r = 1.5;
  for (const double d : {0.01, 0.5, 1.5, 2.9}) {
    // The lens is two segments of half angle alpha; each has its centroid and polar moment about its disc's centre.
    const double alpha = std::acos(d / (2 * r)), c = std::cos(alpha), s = std::sin(alpha);
    const double segment = r * r * (alpha - s * c);
    const double centroid = 2.0 / 3 * r * r * r * s * s * s / segment;
    const double polar = r * r * r * r / 2 * (alpha - c * c * c * s - c * s * s * s / 3);
    const double about_middle = polar + segment * ((centroid - d / 2) * (centroid - d / 2) - centroid * centroid);
    const double area = 2 * pi * r * r - 2 * segment;
    const double whole = 2 * pi * r * r * (r * r / 2 + d * d / 4) - 2 * about_middle;
    expect_plate(dipole(2 * r, d), area, 0, 0, whole / area);
  }
}

TEST(Plate, ContainedAndRepeatedDiscsCountOnce) {
  const ClumpDisc big{0.1, 0.2, 1};
  const Plate alone = plate_of({big});
  for (const std::vector<ClumpDisc>& discs :
       std::vector<std::vector<ClumpDisc>>{{big, big},
                                           {big, big, big},
                                           {{0.3, 0.2, 0.5}, big},
                                           {big, {0.6, 0.2, 0.5}},  // touches inside
                                           {{0.1, 0.2, 0.5}, big, {0.1, 0.2, 0.2}}})
    expect_plate(discs, alone.area, alone.centre.x(), alone.centre.y(), alone.gyration2);
}

TEST(Plate, HoleBetweenDiscsIsNotFilled) {
  // Six unit discs in a ring that touch: the hole between them is no part of the plate.
  std::vector<ClumpDisc> ring;
  for (int k = 0; k < 6; ++k) ring.push_back({2 * std::cos(k * pi / 3), 2 * std::sin(k * pi / 3), 1});
  expect_plate(ring, 6 * pi, 0, 0, 4.5);
  for (ClumpDisc& disc : ring) disc.radius = 1.1;
  const double lens = 2 * 1.21 * std::acos(1 / 1.1) - 2 * std::sqrt(1.21 - 1);
  EXPECT_NEAR(plate_of(ring).area, 6 * pi * 1.21 - 6 * lens, 1e-12);
}

TEST(Plate, RandomDiscsAgreeWithStrips) {
  EXPECT_TRUE(rc::check("area, centre and moment as by strips, wherever the clump stands", [] {
    std::vector<ClumpDisc> discs;
    const int count = *rc::gen::inRange(1, 9);
    for (int k = 0; k < count; ++k)
      discs.push_back(
          {*rc::gen::inRange(-20, 21) / 10.0, *rc::gen::inRange(-20, 21) / 10.0, *rc::gen::inRange(1, 16) / 10.0});
    const Plate exact = plate_of(discs), strips = plate_by_strips(discs, 20000);
    RC_ASSERT(std::abs(exact.area - strips.area) < 1e-4 * exact.area);
    RC_ASSERT((exact.centre - strips.centre).norm() < 1e-4);
    RC_ASSERT(std::abs(exact.gyration2 - strips.gyration2) < 2e-4 * exact.gyration2);

    const double angle = *rc::gen::inRange(0, 628) / 100.0, dx = *rc::gen::inRange(-50, 51), dy = 7.3;
    std::vector<ClumpDisc> moved = discs;
    for (ClumpDisc& d : moved)
      d = {dx + std::cos(angle) * d.x - std::sin(angle) * d.y, dy + std::sin(angle) * d.x + std::cos(angle) * d.y,
           d.radius};
    const Plate same = plate_of(moved);
    const Eigen::Vector2d at(dx + std::cos(angle) * exact.centre.x() - std::sin(angle) * exact.centre.y(),
                             dy + std::sin(angle) * exact.centre.x() + std::cos(angle) * exact.centre.y());
    RC_ASSERT(std::abs(same.area - exact.area) < 1e-6 * exact.area);
    RC_ASSERT((same.centre - at).norm() < 1e-6);
    RC_ASSERT(std::abs(same.gyration2 - exact.gyration2) < 1e-6 * exact.gyration2);
  }));
}

TEST(Plate, KeepsItsDigitsFarFromTheOrigin) {
  std::vector<ClumpDisc> grain = elongated(7e-3, 3e-3);
  const Plate here = plate_of(grain);
  for (ClumpDisc& disc : grain) disc.x += 1000;
  EXPECT_NEAR(plate_of(grain).gyration2, here.gyration2, 1e-9 * here.gyration2);
}

TEST(ClumpShape, AboutTheCentreOfMass) {
  const std::vector<ClumpDisc> discs = about_centre_of_mass({{1, 2, 1}, {4, 2, 0.5}});
  EXPECT_NEAR(plate_of(discs).centre.norm(), 0, 1e-14);
  EXPECT_NEAR(discs[1].x - discs[0].x, 3, 1e-14);
  EXPECT_NEAR(discs[0].x, -3 * 0.25 / 1.25, 1e-14);
  EXPECT_NEAR(holding_radius(discs), 2.4 + 0.5, 1e-14);
}

TEST(ClumpShape, ValleyBetweenEqualDiscs) {
  EXPECT_NEAR(valley_depth({0, 0, 5}, {8, 0, 5}), 2, 1e-14);  // rims cross at height 3, the tangent lies at 5
  EXPECT_EQ(valley_depth({0, 0, 5}, {1, 0, 2}), 0);
  EXPECT_TRUE(std::isinf(valley_depth({0, 0, 1}, {2.1, 0, 1})));
}

double deepest_valley_of(const std::vector<ClumpDisc>& row) {
  double deepest = 0;
  for (std::size_t k = 1; k < row.size(); ++k) deepest = std::max(deepest, valley_depth(row[k - 1], row[k]));
  return deepest;
}

TEST(ClumpShape, ElongatedLiesWithinItsEllipseAndTouchesItsEnds) {
  std::size_t before = 3;
  for (const double length : {1.05, 1.3, 1.9, 2.4, 3.1, 4.0, 4.9}) {
    const std::vector<ClumpDisc> row = elongated(length, 1);
    ASSERT_FALSE(row.empty()) << length;
    EXPECT_EQ(row.size() % 2, 1u);
    EXPECT_GE(row.size(), before);
    before = row.size();
    EXPECT_LE(deepest_valley_of(row), deepest_valley);
    EXPECT_NEAR(row.front().x - row.front().radius, -length / 2, 1e-14);
    EXPECT_NEAR(row.back().x + row.back().radius, length / 2, 1e-14);
    EXPECT_DOUBLE_EQ(row[row.size() / 2].radius, 0.5);
    for (const ClumpDisc& disc : row) {
      double outermost = 0;
      for (int k = 0; k < 3600; ++k) {
        const double x = (disc.x + disc.radius * std::cos(k * pi / 1800)) / (length / 2);
        const double y = disc.radius * std::sin(k * pi / 1800) / 0.5;
        outermost = std::max(outermost, std::hypot(x, y));
      }
      EXPECT_NEAR(outermost, 1, 1e-5) << "touches the ellipse from within";
    }
    const double fraction = plate_of(row).area / (pi / 4 * length);
    EXPECT_GT(fraction, 0.90);
    EXPECT_LT(fraction, 1);
  }
  EXPECT_EQ(elongated(7.08, 3.27).size(), 5u) << "wheat";
  EXPECT_EQ(elongated(8.91, 3.30).size(), 7u) << "barley";
  EXPECT_TRUE(elongated(6, 1).empty());
}

TEST(ClumpShape, DropTapersToATip) {
  for (const double length : {1.1, 2.1, 3.8}) {
    const std::vector<ClumpDisc> row = drop(length, 1);
    ASSERT_FALSE(row.empty()) << length;
    EXPECT_LE(deepest_valley_of(row), deepest_valley);
    EXPECT_NEAR(row.front().x - row.front().radius, -0.5, 1e-14);
    EXPECT_NEAR(row.back().x + row.back().radius, length - 0.5, 1e-14);
    EXPECT_NEAR(row.back().radius, 0.125, 1e-15);
    const double slope = (row.front().radius - row.back().radius) / (row.back().x - row.front().x);
    for (std::size_t k = 1; k < row.size(); ++k) {
      EXPECT_LT(row[k].radius, row[k - 1].radius);
      EXPECT_NEAR((row[k - 1].radius - row[k].radius) / (row[k].x - row[k - 1].x), slope, 1e-13) << "common tangents";
    }
  }
  EXPECT_TRUE(drop(5, 1).empty());
}

/// With discs that are equally stiff.
SideContacts leaning(const std::vector<ClumpDisc>& discs, double gyration2, double depth = 0) {
  return side_contacts(discs, std::vector<double>(discs.size(), 1.0), gyration2, depth);
}

TEST(SideContacts, OfADiscADipoleAndARow) {
  const SideContacts disc = leaning({{0, 0, 2e-3}}, 2e-6);
  EXPECT_EQ(disc.discs, 1);
  EXPECT_EQ(disc.on_a_side, 1);
  EXPECT_EQ(disc.at_a_tip, 1);
  EXPECT_NEAR(disc.turning, 2, 1e-12);
  // Two discs on their common tangent, each 4 mm from the centre.
  const SideContacts pair = leaning({{-4e-3, 0, 3e-3}, {4e-3, 0, 3e-3}}, 20e-6);
  EXPECT_EQ(pair.discs, 2);
  EXPECT_NEAR(pair.at_a_tip, 1 + 16.0 / 20, 1e-12);
  EXPECT_NEAR(pair.on_a_side, 2, 1e-12) << "straight up is its fastest way";
  EXPECT_NEAR(pair.turning, 2 * 9.0 / 20, 1e-12);
  EXPECT_NEAR(leaning({{-4e-3, 0, 3e-3}, {4e-3, 0, 3e-3}}, 8e-6).on_a_side, 4, 1e-12) << "turning is";
  // A soft disc beside a stiff one: [1.5, 2; 2, 6] in displacement and turn.
  const SideContacts uneven = side_contacts({{-4e-3, 0, 3e-3}, {4e-3, 0, 3e-3}}, {0.5, 1}, 4e-6, 0);
  EXPECT_NEAR(uneven.on_a_side, 0.5 * (1.5 + 6 + std::sqrt(4.5 * 4.5 + 4 * 1)), 1e-12);
  // Of different sizes, aslant: the tangent of the outer two leaves the third out.
  const double c = std::cos(0.7), s = std::sin(0.7);
  EXPECT_EQ(leaning({{-4e-3 * c, -4e-3 * s, 3e-3}, {4e-3 * c, 4e-3 * s, 1e-3}, {0, 0, 1e-3}}, 20e-6).discs, 2);
  // Eleven discs in a row, the middle one 2 % of its radius lower: it counts from that depth on.
  std::vector<ClumpDisc> row;
  for (int k = -5; k <= 5; ++k) row.push_back({1e-3 * k, k == 0 ? -0.02e-3 : 0, 1e-3});
  EXPECT_EQ(leaning(row, 10e-6, 0.01).discs, 10);
  EXPECT_EQ(leaning(row, 10e-6, 0.03).discs, 11);
  EXPECT_NEAR(leaning(row, 5e-6, 0.03).on_a_side, 110e-6 / 5e-6, 1e-6);
}

}  // namespace
}  // namespace vibrosow::clump_shape_test
