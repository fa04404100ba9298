#include "vessel/vessel_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vibrosow {
namespace {

Vessel box(std::vector<Hole> holes, double funnel = 0) {
  Vessel vessel;
  vessel.name = "tray";
  vessel.length = 10;
  vessel.height = 4;
  vessel.holes = std::move(holes);
  vessel.funnel = funnel;
  return vessel;
}

std::vector<std::string> names(const std::vector<WallSegment>& walls) {
  std::vector<std::string> found;
  for (const WallSegment& wall : walls) found.push_back(wall.name);
  return found;
}

TEST(VesselWalls, ClosedBoxIsOneChain) {
  const auto walls = vessel_walls(box({}));
  EXPECT_EQ(names(walls), (std::vector<std::string>{"tray left wall", "tray floor 1", "tray right wall"}));
  EXPECT_EQ(walls[0].a, Eigen::Vector2d(0, 4));
  EXPECT_EQ(walls[0].b, Eigen::Vector2d(0, 0));
  EXPECT_EQ(walls[1].b, Eigen::Vector2d(10, 0));
  EXPECT_EQ(walls[2].b, Eigen::Vector2d(10, 4));
  for (std::size_t i = 1; i < walls.size(); ++i) EXPECT_EQ(walls[i].a, walls[i - 1].b);
}

TEST(VesselWalls, HolesBreakTheChain) {
  const auto walls = vessel_walls(box({{2, 1}, {7, 2}}));
  ASSERT_EQ(walls.size(), 5U);
  EXPECT_EQ(walls[1].b, Eigen::Vector2d(1.5, 0));
  EXPECT_EQ(walls[2].a, Eigen::Vector2d(2.5, 0));
  EXPECT_EQ(walls[2].b, Eigen::Vector2d(6, 0));
  EXPECT_EQ(walls[3].a, Eigen::Vector2d(8, 0));
  EXPECT_EQ(walls[3].b, walls[4].a);
}

TEST(VesselWalls, HoleMayReachTheEndWall) {
  const auto walls = vessel_walls(box({{1, 2}}));
  EXPECT_EQ(names(walls), (std::vector<std::string>{"tray left wall", "tray floor 2", "tray right wall"}));
  EXPECT_EQ(names(vessel_walls(box({{5, 10}}))), (std::vector<std::string>{"tray left wall", "tray right wall"}));
}

TEST(VesselWalls, FunnelFallsToEveryHolesEdge) {
  const double slope = 0.5;
  const auto walls = vessel_walls(box({{3, 2}, {7, 2}}, std::atan(slope)));
  ASSERT_EQ(names(walls), (std::vector<std::string>{"tray left wall", "tray floor 1", "tray floor 2 rising",
                                                    "tray floor 2 falling", "tray floor 3", "tray right wall"}));
  EXPECT_NEAR(walls[0].b.y(), 2 * slope, 1e-15);
  EXPECT_EQ(walls[1].b, Eigen::Vector2d(2, 0));
  EXPECT_EQ(walls[2].a, Eigen::Vector2d(4, 0));
  EXPECT_NEAR((walls[2].b - Eigen::Vector2d(5, slope)).norm(), 0, 1e-15);
  EXPECT_EQ(walls[2].b, walls[3].a);
  EXPECT_EQ(walls[3].b, Eigen::Vector2d(6, 0));
  EXPECT_NEAR(walls[4].b.y(), 2 * slope, 1e-15);
  EXPECT_NEAR(highest_floor(box({{3, 2}, {7, 2}}, std::atan(slope))), 2 * slope, 1e-15);
}

TEST(VesselWalls, InsideLiesLeftOfEverySegment) {
  const Eigen::Vector2d inside(5, 3);
  for (const WallSegment& wall : vessel_walls(box({{2, 1}, {7, 2}}, 0.3))) {
    const Eigen::Vector2d along = wall.b - wall.a, to = inside - wall.a;
    EXPECT_GT(along.x() * to.y() - along.y() * to.x(), 0) << wall.name;
  }
}

TEST(VesselWalls, PiecesComeAfterTheBox) {
  Vessel vessel = box({});
  WallPiece arc;
  arc.centre = {2, 1}, arc.radius = 1, arc.from = std::numbers::pi,
  arc.to = 1.5 * std::numbers::pi;  // from (1, 1) to the floor at (2, 0)
  vessel.pieces = {{{0, 4}, {1, 3}}, {{1, 3}, {1, 1}}, arc};
  const auto walls = vessel_walls(vessel);
  ASSERT_EQ(walls.size(), 6U);
  EXPECT_EQ(walls[3].b, walls[4].a);
  EXPECT_EQ(walls[5].name, "tray piece 3");
  EXPECT_NEAR((walls[5].b - Eigen::Vector2d(2, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR(distance_to_wall(walls[5], {2, 1}), 1, 1e-15);
  EXPECT_NEAR(distance_to_wall(walls[5], {1.5, 0.5}), 1 - std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(distance_to_wall(walls[5], {3, 1}), std::sqrt(2.0), 1e-15) << "its nearer end is (2, 0)";
  vessel.box = false;
  EXPECT_EQ(names(vessel_walls(vessel)), (std::vector<std::string>{"tray piece 1", "tray piece 2", "tray piece 3"}));
}

}  // namespace
}  // namespace vibrosow
