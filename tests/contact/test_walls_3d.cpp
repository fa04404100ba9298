// Which faces push a ball, and how.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "contact/wall_contacts_3d.hpp"
#include "grains/random.hpp"
#include "vessel/walls.hpp"

namespace vibrosow::walls_3d_test {
namespace {

constexpr double radius = 2e-3;

/// A tray of 6 x 4 x 3 cm (length, height, depth).
Vessel tray(std::vector<Hole> holes = {}) {
  Vessel vessel;
  vessel.name = "tray";
  vessel.length = 0.06, vessel.height = 0.04, vessel.depth = 0.03;
  vessel.holes = std::move(holes);
  return vessel;
}

Grains one_ball(const Eigen::Vector3d& centre) {
  Grains grains({{radius, 1e-5, 1e5, 1e10, 1e-3}}, false, true);
  grains.is_3d = true;
  grains.add(centre, Eigen::Vector3d::Zero(), 0, grains.kinds.front());
  return grains;
}

/// Normals of all contacts of one ball with a vessel.
std::vector<Eigen::Vector3d> pushed_by(const Vessel& vessel, const Eigen::Vector3d& centre) {
  const Walls walls({vessel}, Space::three_dimensional);
  const Grains grains = one_ball(centre);
  std::vector<WallCandidate> candidates;
  for (std::size_t wall = 0; wall < walls.count(); ++wall) candidates.push_back({0, static_cast<int>(wall), 1});
  WallContacts3d contacts;
  WallFinder3d().find(grains, candidates, 0, walls.placed_faces(), contacts);
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t k = 0; k < static_cast<std::size_t>(contacts.count); ++k)
    normals.emplace_back(contacts.normal.x[k], contacts.normal.y[k], contacts.normal.z[k]);
  return normals;
}

/// How many faces of a vessel one ball is seen to cross that is at these places, one after the other.
std::size_t crossings(const Vessel& vessel, const std::vector<Eigen::Vector3d>& places) {
  const Walls walls({vessel}, Space::three_dimensional);
  std::vector<WallCandidate> candidates;
  for (std::size_t wall = 0; wall < walls.count(); ++wall)
    candidates.push_back({0, static_cast<int>(wall), nearest_on_face(walls.placed_faces()[wall], places.front()).side});
  WallFinder3d finder;
  WallContacts3d contacts;
  std::vector<int> crossed;
  for (const Eigen::Vector3d& place : places) {
    finder.find(one_ball(place), candidates, 0, walls.placed_faces(), contacts);
    finder.watch_crossings(candidates, crossed);
  }
  return crossed.size();
}

TEST(Walls3d, ABallIsSeenToCrossAPlateHoweverFarItIs) {
  const Eigen::Vector3d above(0.03, 0.0025, 0.015);
  EXPECT_EQ(crossings(tray(), {above, {0.03, 0.0005, 0.015}, above}), 0u);
  EXPECT_EQ(crossings(tray(), {above, {0.03, -0.0005, 0.015}}), 1u);
  EXPECT_EQ(crossings(tray(), {above, {0.03, -0.0105, 0.015}}), 1u);
  // Through a hole, or around the floor, it comes to the other side.
  const Hole hole{.centre = 0.03, .width = 0.008, .shape = HoleShape::round, .across = 0.015};
  EXPECT_EQ(crossings(tray({hole}), {above, {0.03, -0.003, 0.015}, {0.04, -0.003, 0.015}}), 0u);
  EXPECT_EQ(crossings(tray({hole}), {above, {0.03, -0.003, 0.015}, {0.04, -0.003, 0.015}, {0.04, 0.003, 0.015}}), 1u);
  EXPECT_EQ(crossings(tray(), {{-0.003, -0.003, 0.015}, {-0.003, 0.003, 0.015}, {-0.003, -0.003, 0.015}}), 0u);
}

TEST(Walls3d, VectorsFindWhatTheFaceSays) {
  // Of 3000 places around a tilted tray with two holes: the finder's contacts are those of the nearest points.
  Vessel vessel = tray({{.centre = 0.02, .width = 0.008, .shape = HoleShape::round, .across = 0.01},
                        {.centre = 0.04, .width = 0.01, .shape = HoleShape::round, .across = 0.02}});
  vessel.tilt = 0.2;
  const Walls walls({vessel}, Space::three_dimensional);
  Random random(11);
  std::size_t touching = 0;
  for (int k = 0; k < 3000; ++k) {
    const double x = random.uniform(-0.005, 0.065), y = random.uniform(-0.02, 0.02), z = random.uniform(-0.005, 0.035);
    const Grains ball = one_ball({x, y, z});
    for (std::size_t wall = 0; wall < walls.count(); ++wall) {
      const NearestOnFace nearest = nearest_on_face(walls.placed_faces()[wall], {x, y, z});
      const WallCandidate candidate{0, static_cast<int>(wall), nearest.side};
      const bool touches = nearest.distance2 < radius * radius;
      touching += touches;
      for (const InstructionSet set : instruction_sets) {
        if (!is_available(set)) continue;
        WallContacts3d contacts;
        WallFinder3d(set).find(ball, {&candidate, 1}, 0, walls.placed_faces(), contacts);
        ASSERT_EQ(contacts.count, touches) << wall;
        if (!touches) continue;
        const Eigen::Vector3d normal(contacts.normal.x[0], contacts.normal.y[0], contacts.normal.z[0]);
        EXPECT_LT((contacts.distance[0] * normal - nearest.apart).norm(), 1e-16);
      }
    }
  }
  EXPECT_GT(touching, 400u);
}

TEST(Walls3d, AFloorAnEdgeAndACorner) {
  EXPECT_THAT(pushed_by(tray(), {0.03, 0.0019, 0.015}), testing::ElementsAre(Eigen::Vector3d(0, -1, 0)));
  EXPECT_THAT(pushed_by(tray(), {0.0019, 0.0019, 0.015}),
              testing::UnorderedElementsAre(Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(-1, 0, 0)));
  EXPECT_THAT(
      pushed_by(tray(), {0.0581, 0.0019, 0.0281}),
      testing::UnorderedElementsAre(Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)));
  EXPECT_THAT(pushed_by(tray(), {0.03, 0.02, 0.015}), testing::IsEmpty());
}

TEST(Walls3d, OverARoundHoleItTouchesTheRimAlone) {
  const Hole hole{.centre = 0.03, .width = 0.008, .shape = HoleShape::round, .across = 0.015};
  EXPECT_THAT(pushed_by(tray({hole}), {0.03, 0.0005, 0.015}), testing::IsEmpty());
  const auto normals = pushed_by(tray({hole}), {0.0325, 0.0005, 0.015});
  ASSERT_EQ(normals.size(), 1u);
  EXPECT_LT((normals[0] - Eigen::Vector3d(0.0015, -0.0005, 0).normalized()).norm(), 1e-12);
}

TEST(Walls3d, PlatesThatMeetPushOnce) {
  // Slots that do not reach the front: the floor is several plates whose long side meets short ones.
  const Hole slot{.centre = 0.03, .width = 0.01, .across = 0.015, .across_length = 0.01};
  for (const double x : {0.0249, 0.025, 0.0251})
    EXPECT_THAT(pushed_by(tray({slot}), {x, 0.0019, 0.005}), testing::ElementsAre(Eigen::Vector3d(0, -1, 0))) << x;
  EXPECT_THAT(pushed_by(tray({slot}), {0.03, 0.0019, 0.015}), testing::IsEmpty());
  // In a corner of the slot it meets two edges.
  EXPECT_EQ(pushed_by(tray({slot}), {0.0262, 0.0003, 0.0112}).size(), 2u);
}

TEST(Walls3d, AboveAWallItsEdgePushesOnce) {
  const auto normals = pushed_by(tray(), {-0.0005, 0.0415, 0.015});
  ASSERT_EQ(normals.size(), 1u);
  EXPECT_LT((normals[0] - Eigen::Vector3d(0.0005, -0.0015, 0).normalized()).norm(), 1e-12);
  EXPECT_EQ(pushed_by(tray(), {-0.0005, 0.0415, -0.0005}).size(), 1u);  // where three faces' corners meet
}

TEST(Walls3d, AGateClosesItsHole) {
  const Hole hole{.centre = 0.03, .width = 0.008, .open_at = 1, .shape = HoleShape::round, .across = 0.015};
  EXPECT_THAT(pushed_by(tray({hole}), {0.03, 0.0019, 0.015}), testing::ElementsAre(Eigen::Vector3d(0, -1, 0)));
  EXPECT_THAT(pushed_by(tray({hole}), {0.034, 0.0019, 0.015}), testing::ElementsAre(Eigen::Vector3d(0, -1, 0)));
}

TEST(Walls3d, ADrumPushesFromInsideAndOutside) {
  Vessel drum = tray();
  drum.box = false;
  drum.pieces = {{.centre = {0.03, 0.02}, .radius = 0.02, .from = 0, .to = 2 * 3.14159265358979323846}};
  for (const double y : {0.0019, -0.0019}) {
    const auto normals = pushed_by(drum, {0.03, y, 0.015});
    ASSERT_EQ(normals.size(), 1u);
    EXPECT_LT((normals[0] - Eigen::Vector3d(0, std::copysign(1, -y), 0)).norm(), 1e-12);
  }
}

TEST(Walls3d, APeriodicFloorGoesOnWithItsHoles) {
  Vessel vessel = tray({{.centre = 0.005, .width = 0.008, .shape = HoleShape::round, .across = 0.004}});
  vessel.sides = vessel.front_and_back = Sides::periodic;
  EXPECT_THAT(pushed_by(vessel, {0.065, 0.0005, 0.034}), testing::IsEmpty());
  EXPECT_THAT(pushed_by(vessel, {-0.001, 0.0019, 0.031}), testing::ElementsAre(Eigen::Vector3d(0, -1, 0)));
}

TEST(Walls3d, ARoundVesselsFloorEndsAtItsWall) {
  Vessel round = tray({{.centre = 0.02, .width = 0.01, .shape = HoleShape::round, .across = 0.03}});
  round.plan = Plan::round, round.depth = round.length;
  EXPECT_THAT(pushed_by(round, {0.045, 0.0019, 0.03}), testing::ElementsAre(Eigen::Vector3d(0, -1, 0)));
  EXPECT_THAT(pushed_by(round, {0.03, 0.0019, 0.0581}),
              testing::UnorderedElementsAre(Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1)));
  EXPECT_THAT(pushed_by(round, {0.02, 0.0005, 0.03}), testing::IsEmpty()) << "over its hole";
  EXPECT_EQ(pushed_by(round, {0.0235, 0.0005, 0.03}).size(), 1u) << "on the hole's rim";
  EXPECT_THAT(pushed_by(round, {0.002, 0.0019, 0.002}), testing::IsEmpty()) << "in the corner of a square";
  EXPECT_EQ(pushed_by(round, {0.03, -0.0005, -0.0015}).size(), 1u) << "floor and wall end in one rim";
}

}  // namespace
}  // namespace vibrosow::walls_3d_test
