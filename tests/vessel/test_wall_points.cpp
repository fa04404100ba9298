#include "vessel/wall_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vessel/vessel_faces.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

using std::numbers::pi;

TEST(WallPoints, OfAnArcLieOnItFourDegreesApart) {
  WallSegment wall{{0, 0}, {0, 0}, "arc"};
  wall.centre = {0.1, 0.2}, wall.radius = 0.05, wall.from = 0.5 * pi, wall.to = 1.5 * pi;
  const auto points = wall_points(wall);
  ASSERT_EQ(points.size(), 46u + 1);
  EXPECT_LT((points.front() - Eigen::Vector2d(0.1, 0.25)).norm(), 1e-15);
  EXPECT_LT((points.back() - Eigen::Vector2d(0.1, 0.15)).norm(), 1e-15);
  for (const Eigen::Vector2d& at : points) EXPECT_NEAR((at - wall.centre).norm(), 0.05, 1e-15);
  EXPECT_EQ(wall_points({{0, 0}, {1, 2}, "line"}), (std::vector<Eigen::Vector2d>{{0, 0}, {1, 2}}));
}

TEST(FaceLines, OfAPlateAreItsEdgesAndTheRimsOfItsHoles) {
  Face plate{.name = "floor", .origin = {0, 0, 1}};
  plate.length_u = 2, plate.length_v = 1, plate.holes = {{0.5, 0.5, 0.1}};
  const auto lines = face_lines(plate);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_EQ(lines[0][2], Eigen::Vector3d(2, 1, 1));
  for (const Eigen::Vector3d& at : lines[1]) EXPECT_NEAR((at - Eigen::Vector3d(0.5, 0.5, 1)).norm(), 0.1, 1e-15);
}

TEST(FaceLines, OfASurfaceOfRevolutionAreItsRimsAndLinesBetweenThem) {
  Face cone{.kind = Face::Kind::revolved, .name = "cone"};
  cone.radius_a = 0.1, cone.height_a = 0, cone.radius_b = 0.3, cone.height_b = 0.5, cone.half_angle = pi;
  const auto lines = face_lines(cone);
  ASSERT_EQ(lines.size(), 10u);
  for (const Eigen::Vector3d& at : lines[1]) {
    EXPECT_NEAR(at.head<2>().norm(), 0.3, 1e-15);
    EXPECT_EQ(at.z(), 0.5);
  }
  for (std::size_t k = 2; k < lines.size(); ++k) {
    ASSERT_EQ(lines[k].size(), 2u);
    EXPECT_LT((lines[k][0].head<2>().normalized() - lines[k][1].head<2>().normalized()).norm(), 1e-12)
        << "straight down";
  }
}

TEST(FaceLines, OfARoundVesselsFloorAreItsRimAndItsHoles) {
  Vessel vessel;
  vessel.name = "tray", vessel.length = 0.2, vessel.height = 0.1, vessel.depth = 0.2, vessel.plan = Plan::round;
  vessel.holes = {{.centre = 0.06, .width = 0.02, .shape = HoleShape::round, .across = 0.1}};
  for (const Face& face : vessel_faces(vessel)) {
    if (face.name != "tray floor 1") continue;
    const auto lines = face_lines(face);
    ASSERT_EQ(lines.size(), 2u);
    for (const Eigen::Vector3d& at : lines[0]) {
      EXPECT_NEAR(std::hypot(at.x() - 0.1, at.z() - 0.1), 0.1, 1e-15);
      EXPECT_NEAR(at.y(), 0, 1e-15);
    }
    for (const Eigen::Vector3d& at : lines[1]) EXPECT_NEAR(std::hypot(at.x() - 0.06, at.z() - 0.1), 0.01, 1e-15);
    return;
  }
  ADD_FAILURE() << "no floor";
}

TEST(VesselFaces, OfARoundHoleInAThickFloorAreItsChamferAndItsWall) {
  Vessel vessel;
  vessel.name = "tray", vessel.length = 0.1, vessel.height = 0.1, vessel.depth = 0.06;
  vessel.front_and_back = Sides::periodic;
  vessel.holes = {
      {.centre = 0.05, .width = 0.02, .shape = HoleShape::round, .across = 0.03, .thickness = 3e-3, .chamfer = 1e-3}};
  std::vector<double> images;
  for (const Face& face : vessel_faces(vessel)) {
    for (const RoundHole& hole : face.holes) EXPECT_DOUBLE_EQ(hole.radius, 0.011);
    if (face.name != "tray hole 1") continue;
    EXPECT_EQ(face.normal, Eigen::Vector3d::UnitY());
    EXPECT_DOUBLE_EQ(face.origin.x(), 0.05);
    images.push_back(face.origin.z());
    const bool is_chamfer = face.height_a == 0;
    EXPECT_DOUBLE_EQ(face.radius_a, is_chamfer ? 0.011 : 0.01);
    EXPECT_DOUBLE_EQ(face.radius_b, 0.01);
    EXPECT_DOUBLE_EQ(face.height_a, is_chamfer ? 0 : -1e-3);
    EXPECT_DOUBLE_EQ(face.height_b, is_chamfer ? -1e-3 : -3e-3);
  }
  EXPECT_EQ(images.size(), 6u) << "with those of a period in front and behind";
  EXPECT_EQ(std::ranges::count(images, 0.03), 2);
}

TEST(LargestRadius, IsThatOfTheFurthestPointOfAPieceAboutEitherAxis) {
  for (const PieceAxis axis : {PieceAxis::upright, PieceAxis::along}) {
    Vessel vessel;
    vessel.name = "tray", vessel.length = 1, vessel.height = 0.1, vessel.depth = 1, vessel.box = false;
    vessel.front_and_back = Sides::open;
    vessel.pieces = {{.a = {0.1, 0.2}, .b = {0.3, 0.7}, .about = Eigen::Vector2d(0.6, 0.5), .axis = axis}};
    double furthest = 0, furthest_in_plan = 0;
    for (const Face& face : vessel_faces(vessel))
      for (const auto& line : face_lines(face))
        for (const Eigen::Vector3d& at : line) {
          furthest = std::max(furthest, at.head<2>().norm());
          furthest_in_plan = std::max(furthest_in_plan, std::hypot(at.x(), at.z()));
        }
    const double radius = largest_radius(vessel, Eigen::Vector2d::Zero());
    EXPECT_NEAR(radius, furthest, 1e-3);
    EXPECT_GE(radius, furthest * (1 - 1e-12));
    EXPECT_GE(largest_radius_in_plan(vessel, Eigen::Vector2d::Zero()), furthest_in_plan * (1 - 1e-12));
  }
}

WallPiece along(WallPiece piece) {
  piece.drawn_out = DrawnOut::along;
  return piece;
}

TEST(PiecesAlong, AreDrawnOutFromTheLeftEndToTheRight) {
  Vessel vessel;
  vessel.name = "tray", vessel.length = 1, vessel.height = 0.5, vessel.depth = 0.4, vessel.box = false;
  vessel.front_and_back = Sides::open;
  vessel.pieces = {along({.a = {0.1, 0.2}, .b = {0.3, 0.1}}),
                   along({.centre = {0.2, 0.3}, .radius = 0.1, .from = 0, .to = std::numbers::pi / 2})};
  EXPECT_TRUE(vessel_walls(vessel).empty()) << "there is nothing of them in the plane";
  const std::vector<Face> faces = vessel_faces(vessel);
  ASSERT_EQ(faces.size(), 2u);
  const auto ends = [&](const Face& face) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(9), high = -low;
    for (const auto& line : face_lines(face))
      for (const Eigen::Vector3d& at : line) low = low.cwiseMin(at), high = high.cwiseMax(at);
    return std::pair(low, high);
  };
  const auto [low, high] = ends(faces[0]);
  EXPECT_TRUE(low.isApprox(Eigen::Vector3d(0, 0.1, 0.1), 1e-12)) << low.transpose();
  EXPECT_TRUE(high.isApprox(Eigen::Vector3d(1, 0.2, 0.3), 1e-12)) << high.transpose();
  EXPECT_GT(faces[0].normal.y(), 0);
  EXPECT_NEAR(faces[0].normal.dot(Eigen::Vector3d(0, -0.1, 0.2)), 0, 1e-15);
  const auto [arc_low, arc_high] = ends(faces[1]);  // from straight back of its axis to straight above
  EXPECT_TRUE(arc_low.isApprox(Eigen::Vector3d(0, 0.3, 0.2), 1e-12)) << arc_low.transpose();
  EXPECT_TRUE(arc_high.isApprox(Eigen::Vector3d(1, 0.4, 0.3), 1e-12)) << arc_high.transpose();
  EXPECT_NEAR(largest_radius(vessel, Eigen::Vector2d::Zero()), std::hypot(1, 0.4), 1e-12);
  vessel.sides = vessel.front_and_back = Sides::periodic;
  const std::vector<Face> endless = vessel_faces(vessel);
  ASSERT_EQ(endless.size(), 6u) << "its images in front and behind";
  EXPECT_DOUBLE_EQ(ends(endless[0]).first.z(), 0.1 - 0.4);
  EXPECT_DOUBLE_EQ(ends(endless[1]).first.x(), -1);
  EXPECT_DOUBLE_EQ(ends(endless[1]).second.x(), 2);
}

TEST(PiecesAlong, AreSeenFromTheFrontByTheirEdges) {
  Vessel vessel;
  vessel.name = "tray", vessel.length = 1, vessel.height = 0.5, vessel.depth = 0.4;
  const std::size_t box = walls_from_the_front(vessel).size();
  vessel.pieces = {along({.a = {0, 0.2}, .b = {0.2, 0.1}}), along({.a = {0.2, 0.1}, .b = {0.4, 0.2}})};
  const std::vector<WallSegment> walls = walls_from_the_front(vessel);
  ASSERT_EQ(walls.size(), box + 2);
  EXPECT_EQ(walls[box].a, Eigen::Vector2d(0, 0.1));
  EXPECT_EQ(walls[box].b, Eigen::Vector2d(1, 0.1));
  EXPECT_EQ(walls[box + 1].a, Eigen::Vector2d(0, 0.2));
}

TEST(DrawnOnce, APeriodicVesselHasNoCopiesBesideIt) {
  Vessel vessel;
  vessel.name = "tray", vessel.length = 1, vessel.height = 1, vessel.sides = Sides::periodic;
  vessel.holes = {{0.5, 0.1}};
  EXPECT_EQ(vessel_walls(vessel).size(), 4u);
  EXPECT_EQ(vessel_walls(drawn_once(vessel)).size(), 2u);
}

}  // namespace
}  // namespace vibrosow
