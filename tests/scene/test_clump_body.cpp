#include "scene/clump_body.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/clump_shape.hpp"

namespace vibrosow {
namespace {

constexpr double pi = std::numbers::pi;

/// By the angle `turn` about an axis through the origin (Rodrigues), then moved.
std::vector<ClumpDisc> turned(std::vector<ClumpDisc> balls, const Eigen::Vector3d& axis, double turn,
                              const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  const Eigen::Vector3d e = axis / axis.norm();
  Eigen::Matrix3d cross;
  cross << 0, -e.z(), e.y(), e.z(), 0, -e.x(), -e.y(), e.x(), 0;
  const Eigen::Matrix3d r =
      Eigen::Matrix3d::Identity() + std::sin(turn) * cross + (1 - std::cos(turn)) * (cross * cross);
  for (ClumpDisc& ball : balls) {
    const Eigen::Vector3d at = r * centre_of(ball) + shift;
    ball.x = at.x(), ball.y = at.y(), ball.z = at.z();
  }
  return balls;
}

/// Two balls on x, the first at 0, by the integrals of a ball cut off by the plane in which they meet.
struct TwoBalls {
  double volume = 0, centre = 0, along = 0, across = 0;

  TwoBalls(double r, double s, double distance) {
    const double cut = (distance * distance + r * r - s * s) / (2 * distance);
    const double meet = std::clamp(cut, -r, r), other = distance - std::clamp(cut, distance - s, distance + s);
    double first = 0, second = 0;
    const auto add = [&](double radius, double up_to, double at, double side) {
      const double a = radius * radius;
      const auto between = [&](auto primitive) { return primitive(up_to) - primitive(-radius); };
      const double v = pi * between([&](double x) { return a * x - std::pow(x, 3) / 3; });
      const double x1 = pi * between([&](double x) { return a * x * x / 2 - std::pow(x, 4) / 4; });
      const double x2 = pi * between([&](double x) { return a * std::pow(x, 3) / 3 - std::pow(x, 5) / 5; });
      const double y2 =
          pi / 4 * between([&](double x) { return a * a * x - 2 * a * std::pow(x, 3) / 3 + std::pow(x, 5) / 5; });
      volume += v, first += at * v + side * x1, second += at * at * v + 2 * at * side * x1 + x2, across += y2;
    };
    add(r, meet, 0, 1), add(s, other, distance, -1);
    centre = first / volume, along = second / volume - centre * centre, across /= volume;
  }
};

/// Eigenvalues, ascending.
Eigen::Vector3d spreads(const std::vector<ClumpDisc>& balls) {
  const Eigen::Vector3d g = solid_clump(balls).gyration2;
  Eigen::Vector3d spread = Eigen::Vector3d::Constant(g.sum() / 2) - g;
  std::sort(spread.begin(), spread.end());
  return spread;
}

TEST(ClumpBody, OneBall) {
  const Body body = body_of_balls({{0.3, -0.4, 2, 7}});
  EXPECT_NEAR(body.volume, 4 * pi / 3 * 8, 1e-13 * 32);
  EXPECT_NEAR((body.centre - Eigen::Vector3d(0.3, -0.4, 7)).norm(), 0, 1e-15);
  EXPECT_NEAR((body.spread - Eigen::Matrix3d::Identity() * 4 / 5).norm(), 0, 1e-14);
  EXPECT_NEAR((solid_clump({{0, 0, 2}}).gyration2 - Eigen::Vector3d::Constant(0.4 * 4)).norm(), 0, 1e-14);
}

TEST(ClumpBody, TwoBallsLoseTheirLensExactly) {
  for (const auto& [r, s, distance] :
       {std::tuple(2.0, 1.0, 2.5), std::tuple(1.5, 1.5, 0.7), std::tuple(1.0, 3.0, 3.9), std::tuple(1.0, 2.0, 5.0)}) {
    const TwoBalls exact(r, s, distance);
    const std::vector<ClumpDisc> on_x = {{0, 0, r}, {distance, 0, s}};
    for (const double angle : {0.0, 0.4, 2.0}) {
      const Eigen::Vector3d axis(0.3, -1, 0.8), shift(4, -2, 3);
      const Body body = body_of_balls(turned(on_x, axis, angle, shift));
      EXPECT_NEAR(body.volume, exact.volume, 1e-13 * exact.volume);
      const ClumpDisc centre = turned({{exact.centre, 0, 1}}, axis, angle, shift).front();
      EXPECT_NEAR((body.centre - centre_of(centre)).norm(), 0, 1e-14 * 10);
      const Eigen::Vector3d spread = spreads(turned(on_x, axis, angle, shift));
      EXPECT_NEAR(spread[2], exact.along, 1e-13 * exact.along);
      EXPECT_NEAR(spread[0], exact.across, 1e-13 * exact.across);
      EXPECT_NEAR(spread[1], exact.across, 1e-13 * exact.across);
    }
  }
}

/// A third ball, hidden in the first and off the line, leaves the body what it is and has it integrated by sections.
TEST(ClumpBody, SectionsAgreeWithTheExactValueOfTwoBalls) {
  for (const auto& [r, s, distance] :
       {std::tuple(2.0, 1.0, 2.5), std::tuple(1.5, 1.5, 0.7), std::tuple(1.0, 3.0, 3.9)}) {
    const TwoBalls exact(r, s, distance);
    for (const double angle : {0.0, 0.3, 1.1, pi / 2, 2.5}) {
      const std::vector<ClumpDisc> balls =
          turned({{0, 0, r}, {distance, 0, s}, {0.1, 0.2, 0.3}}, {0.2, 1, 0.1 * angle}, angle, {3, 2, 1});
      const Body body = body_of_balls(balls);
      EXPECT_NEAR(body.volume, exact.volume, 1e-10 * exact.volume) << angle;
      EXPECT_NEAR(body.spread.trace(), exact.along + 2 * exact.across, 1e-10 * exact.along) << angle;
      const Eigen::Vector3d spread = spreads(balls);
      EXPECT_NEAR(spread[2], exact.along, 1e-10 * exact.along) << angle;
      EXPECT_NEAR(spread[0], exact.across, 1e-10 * exact.along) << angle;
    }
  }
}

TEST(ClumpBody, BallsApartFollowFromParallelAxes) {
  const std::vector<ClumpDisc> balls = {{0, 0, 1}, {5, 1, 2, 1}, {-1, 6, 1.5, -3}};
  double volume = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const ClumpDisc& ball : balls) {
    const double v = 4 * pi / 3 * std::pow(ball.radius, 3);
    volume += v, centre += v * centre_of(ball);
  }
  centre /= volume;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const ClumpDisc& ball : balls) {
    const double part = 4 * pi / 3 * std::pow(ball.radius, 3) / volume;
    const Eigen::Vector3d from = centre_of(ball) - centre;
    spread += part * (from * from.transpose() + Eigen::Matrix3d::Identity() * ball.radius * ball.radius / 5);
  }
  const Body body = body_of_balls(balls);
  EXPECT_NEAR(body.volume, volume, 1e-12 * volume);
  EXPECT_NEAR((body.centre - centre).norm(), 0, 1e-12);
  EXPECT_NEAR((body.spread - spread).norm(), 0, 1e-12 * spread.norm());
}

TEST(ClumpBody, HiddenAndRepeatedBallsCountOnce) {
  const std::vector<ClumpDisc> three = {{0, 0, 1}, {1, 0.2, 0.9}, {0.2, 0.9, 0.8, 0.4}};
  std::vector<ClumpDisc> more = three;
  more.push_back(three[1]), more.push_back({0.1, 0.1, 0.3}), more.push_back(three[0]);
  const Body body = body_of_balls(three), same = body_of_balls(more);
  EXPECT_NEAR(same.volume, body.volume, 1e-10 * body.volume);
  EXPECT_NEAR((same.spread - body.spread).norm(), 0, 1e-10 * body.spread.norm());
}

/// However the sections lie, they give the same body: their error.
TEST(ClumpBody, TurningAndScalingAClump) {
  EXPECT_TRUE(rc::check("volume and moments turn with nothing, and scale", [] {
    std::vector<ClumpDisc> balls;
    const int count = *rc::gen::inRange(3, 7);
    const auto number = [](int least, int most) { return *rc::gen::inRange(least, most) / 10.0; };
    for (int k = 0; k < count; ++k) balls.push_back({number(-20, 20), number(-20, 20), number(5, 20), number(-20, 20)});
    const double factor = number(2, 50);
    std::vector<ClumpDisc> other = turned(balls, {number(1, 10), number(-10, 10), number(-10, 10)}, number(0, 60));
    for (ClumpDisc& ball : other) ball.x *= factor, ball.y *= factor, ball.z *= factor, ball.radius *= factor;
    const Body body = body_of_balls(balls), there = body_of_balls(other);
    RC_ASSERT(std::abs(there.volume / std::pow(factor, 3) - body.volume) < 1e-10 * body.volume);
    RC_ASSERT((spreads(other) / (factor * factor) - spreads(balls)).norm() < 1e-9 * body.spread.trace());
  }));
}

/// The same by upright columns, in each of which the balls cover intervals.
TEST(ClumpBody, AgreesWithColumns) {
  const std::vector<ClumpDisc> balls = {{0, 0, 1}, {1.2, 0.3, 0.8, 0.2}, {-0.4, 1.1, 0.9, -0.5}, {0.3, 0.5, 0.7, 1.1}};
  constexpr int columns = 600;
  const double low = -1.6, step = 4.0 / columns;
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < columns; ++j) {
      const double x = low + (i + 0.5) * step, y = low + (j + 0.5) * step;
      std::vector<std::pair<double, double>> spans;
      for (const ClumpDisc& b : balls) {
        const double half2 = b.radius * b.radius - (x - b.x) * (x - b.x) - (y - b.y) * (y - b.y);
        if (half2 > 0) spans.emplace_back(b.z - std::sqrt(half2), b.z + std::sqrt(half2));
      }
      std::sort(spans.begin(), spans.end());
      double reached = -1e300;
      for (auto [a, b] : spans) {
        a = std::max(a, reached);
        if (b <= a) continue;
        reached = b;
        const double z0 = (b - a) * step * step, z1 = (b * b - a * a) / 2 * step * step,
                     z2 = (b * b * b - a * a * a) / 3 * step * step;
        volume += z0, first += Eigen::Vector3d(x * z0, y * z0, z1);
        second +=
            Eigen::Matrix3d{{x * x * z0, x * y * z0, x * z1}, {x * y * z0, y * y * z0, y * z1}, {x * z1, y * z1, z2}};
      }
    }
  const Eigen::Vector3d centre = first / volume;
  const Body body = body_of_balls(balls);
  EXPECT_NEAR(body.volume, volume, 2e-5 * volume);
  EXPECT_NEAR((body.centre - centre).norm(), 0, 2e-5);
  EXPECT_NEAR((body.spread - (second / volume - centre * centre.transpose())).norm(), 0, 5e-5 * body.spread.norm());
}

TEST(SolidClump, StandsAlongItsPrincipalAxes) {
  const std::vector<ClumpDisc> given =
      turned({{0, 0, 5e-3}, {6e-3, 1e-3, 3e-3}, {-3e-3, 5e-3, 2e-3, 1e-3}, {0, 2e-3, 3e-3, 4e-3}}, {1, 2, -1}, 0.7);
  const SolidClump clump = solid_clump(given);
  const Body body = body_of_balls(clump.balls);
  EXPECT_NEAR(body.centre.norm(), 0, 1e-12 * 5e-3);
  const double size2 = body.spread.trace();
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
    EXPECT_NEAR(body.spread(i, j), 0, 1e-9 * size2);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(clump.gyration2[k], size2 - body.spread(k, k), 1e-9 * size2);
  // Distances are kept, and so is which hand the clump is.
  const auto volume_between = [](const std::vector<ClumpDisc>& b) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = centre_of(b[static_cast<std::size_t>(k) + 1]) - centre_of(b[0]);
    return edges.determinant();
  };
  EXPECT_NEAR(volume_between(clump.balls), volume_between(given), 1e-9 * std::abs(volume_between(given)));
}

TEST(SolidClump, ARowComesToLieAlongX) {
  for (const SolidClump& clump :
       {solid_clump({{0, 0, 2}, {0, 3, 2}}), solid_clump({{1, 0, 2, -1}, {1, 0, 2, 2}}), solid_clump(dipole(4, 3))}) {
    EXPECT_NEAR(clump.balls[0].x, -1.5, 1e-14);
    EXPECT_NEAR(clump.balls[1].x, 1.5, 1e-14);
    for (const ClumpDisc& ball : clump.balls) EXPECT_EQ(Eigen::Vector2d(ball.y, ball.z), Eigen::Vector2d(0, 0));
    EXPECT_LT(clump.gyration2.x(), clump.gyration2.y());
    EXPECT_EQ(clump.gyration2.y(), clump.gyration2.z());
  }
  // Paper A's dipole, two balls apart: 2/5 r^2 about its axis, (d / 2)^2 more across.
  const SolidClump apart = solid_clump(dipole(4, 7));
  EXPECT_NEAR(apart.gyration2.x(), 0.4 * 4, 1e-14);
  EXPECT_NEAR(apart.gyration2.y(), 0.4 * 4 + 3.5 * 3.5, 1e-13);
}

struct Extent {
  double x = 0, y = 0, z = 0;
  explicit Extent(const std::vector<ClumpDisc>& balls) {
    double low[3] = {}, high[3] = {};
    for (const ClumpDisc& ball : balls)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], centre_of(ball)[k] - ball.radius);
        high[k] = std::max(high[k], centre_of(ball)[k] + ball.radius);
      }
    x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  }
};

TEST(SolidShapes, HaveLengthWidthAndThickness) {
  for (const auto& [length, width, thickness, balls] :
       {std::tuple(9.13e-3, 3.38e-3, 2.64e-3, 14u), std::tuple(8e-3, 6e-3, 3e-3, 15u),
        std::tuple(5e-3, 4e-3, 1.3e-3, 28u)}) {
    const std::vector<ClumpDisc> seed = elongated_solid(length, width, thickness);
    EXPECT_EQ(seed.size(), balls);
    const Extent extent(seed);
    EXPECT_NEAR(extent.x, length, 1e-15);
    EXPECT_NEAR(extent.y, width, 1e-15);
    EXPECT_NEAR(extent.z, thickness, 1e-15);
  }
  const Extent drop(drop_solid(11.93e-3, 5.69e-3, 3.79e-3));
  EXPECT_NEAR(drop.x, 11.93e-3, 1e-15);
  EXPECT_NEAR(drop.y, 5.69e-3, 1e-15);
  EXPECT_NEAR(drop.z, 3.79e-3, 1e-15);
  // Nearly as thick as wide: one row between the two.
  const std::vector<ClumpDisc> wheat = elongated_solid(6.32e-3, 2.92e-3, 2.66e-3);
  EXPECT_EQ(wheat, elongated(6.32e-3, std::sqrt(2.92e-3 * 2.66e-3)));
  EXPECT_EQ(elongated_solid(7e-3, 3e-3, 3e-3), elongated(7e-3, 3e-3));
  EXPECT_TRUE(elongated_solid(7e-3, 3e-3, 0.25 * 3e-3).empty()) << "too thin";
  EXPECT_FALSE(elongated_solid(4e-3, 3e-3, (thinnest + 1e-9) * 3e-3).empty());
  EXPECT_TRUE(elongated_solid(30e-3, 3e-3, 3e-3).empty()) << "too slender";
}

}  // namespace
}  // namespace vibrosow
