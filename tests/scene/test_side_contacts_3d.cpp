#include "scene/side_contacts_3d.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/clump_body.hpp"
#include "scene/cross_product.hpp"

namespace vibrosow::side_contacts_3d_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Calls `look` for unit vectors all over the sphere.
template <class Look>
void for_each_direction(int steps, Look look) {
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j < 2 * steps; ++j) {
      const double polar = pi * i / steps, around = pi * j / steps;
      look(Eigen::Vector3d(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)));
    }
}

double yield(const Eigen::Vector3d& at, const Eigen::Vector3d& direction, const Eigen::Vector3d& gyration2) {
  const Eigen::Vector3d arm = cross(at, direction);
  return arm.dot(arm.cwiseQuotient(gyration2));
}

SideContacts leaning(const std::vector<ClumpDisc>& balls, const Eigen::Vector3d& gyration2, double depth = 0) {
  return side_contacts_3d(balls, std::vector<double>(balls.size(), 1.0), gyration2, depth);
}

TEST(SideContacts3d, OfABallIsOne) {
  const SideContacts ball = leaning({{0, 0, 2e-3}}, Eigen::Vector3d::Constant(0.4 * 4e-6));
  EXPECT_EQ(ball.discs, 1);
  EXPECT_EQ(ball.at_a_tip, 1);
  EXPECT_EQ(ball.on_a_side, 1);
  EXPECT_NEAR(ball.turning, 2.5, 1e-12);
}

TEST(SideContacts3d, OfADipole) {
  // Balls of 3 mm, 4 mm from the centre; touched at one of them it yields by 16 / g_y more.
  const std::vector<ClumpDisc> balls = {{-4e-3, 0, 3e-3}, {4e-3, 0, 3e-3}};
  const SideContacts pair = leaning(balls, {5e-6, 20e-6, 20e-6});
  EXPECT_EQ(pair.discs, 2);
  EXPECT_NEAR(pair.at_a_tip, 1 + 16.0 / 20, 1e-12);
  EXPECT_GE(pair.on_a_side, 2 * (1 - 1e-12)) << "straight up is its fastest way";
  EXPECT_LE(pair.on_a_side, 2 * 1.023);
  const double furthest = 4 / std::sqrt(20) + 3 / std::sqrt(5);
  EXPECT_NEAR(pair.turning, std::max(2 * 9.0 / 5, furthest * furthest), 1e-12);
  const SideContacts slim = leaning(balls, {5e-6, 8e-6, 8e-6});
  EXPECT_GE(slim.on_a_side, 4 * (1 - 1e-12)) << "turning is";
  EXPECT_LE(slim.on_a_side, 4 * 1.023);
}

TEST(SideContacts3d, AFlatSideOfFourBalls) {
  // A square of balls: the four of them at once, from above.
  std::vector<ClumpDisc> square;
  for (const double x : {-2e-3, 2e-3})
    for (const double y : {-2e-3, 2e-3}) square.push_back({x, y, 1e-3});
  const SideContacts side = leaning(square, {6e-6, 6e-6, 10e-6});
  EXPECT_EQ(side.discs, 4);
  EXPECT_GE(side.on_a_side, 4 * (1 - 1e-12));
  EXPECT_LE(side.on_a_side, 4 * 1.023);
  // One 2 % of its radius lower counts from that depth on.
  square.push_back({0, 0, 1e-3, -0.02e-3}), square.push_back({0, 0, 1e-3, 0});
  EXPECT_EQ(leaning(square, {6e-6, 6e-6, 10e-6}, 0.001).discs, 5);
  EXPECT_EQ(leaning(square, {6e-6, 6e-6, 10e-6}, 0.03).discs, 6);
}

TEST(SideContacts3d, NoDirectionYieldsMoreThanATip) {
  const SolidClump clump = solid_clump({{0, 0, 5e-3}, {6e-3, 1e-3, 3e-3}, {-3e-3, 5e-3, 2e-3, 3e-3}});
  double most = 0, furthest = 0;
  for (const ClumpDisc& ball : clump.balls)
    for_each_direction(90, [&](const Eigen::Vector3d& n) {
      most = std::max(most, yield({ball.x, ball.y, ball.z}, n, clump.gyration2));
      const Eigen::Vector3d surface = centre_of(ball) + ball.radius * n;
      for_each_direction(
          12, [&](const Eigen::Vector3d& t) { furthest = std::max(furthest, yield(surface, t, clump.gyration2)); });
    });
  const double at_a_tip = leaning(clump.balls, clump.gyration2).at_a_tip;
  EXPECT_GE(at_a_tip, (1 + most) * (1 - 1e-12));
  EXPECT_LE(at_a_tip, 1.001 * (1 + most));
  EXPECT_GE(furthest_yield(clump.balls, clump.gyration2), furthest);
  EXPECT_LE(furthest_yield(clump.balls, clump.gyration2), 1.5 * furthest);
}

}  // namespace
}  // namespace vibrosow::side_contacts_3d_test
