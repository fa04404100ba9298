// Where a vessel's seeds can come to from its open top.
#include "grains/free_room.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace vibrosow {
namespace {

constexpr double radius = 2e-3;  // m

class Room : public testing::TestWithParam<Space> {
 protected:
  static Vessel box() {
    Vessel v;
    v.name = "tray";
    v.length = 0.1, v.height = 0.06;
    if (GetParam() == Space::three_dimensional) v.depth = 0.04;
    return v;
  }
  static bool holds(const Vessel& v, double x, double y) {
    return FreeRoom(v, GetParam(), radius).holds({x, y, v.depth.value_or(0) / 2});
  }
};
INSTANTIATE_TEST_SUITE_P(Spaces, Room, testing::Values(Space::two_dimensional, Space::three_dimensional),
                         [](const auto& info) { return info.param == Space::two_dimensional ? "plane" : "space"; });

TEST_P(Room, OfABoxIsTheBox) {
  EXPECT_TRUE(holds(box(), 0.05, 0.01));
  EXPECT_TRUE(holds(box(), 0.05, 0.2)) << "over it";
  EXPECT_FALSE(holds(box(), -0.01, 0.01));
  EXPECT_FALSE(holds(box(), 0.05, -0.01));
}

TEST_P(Room, LiesOverTheSlopesOfAFunnel) {
  Vessel v = box();
  const double depth = v.depth.value_or(0);
  v.holes = {{.centre = 0.05, .width = 0.02, .across = depth / 2, .across_length = depth}};
  v.funnel = std::numbers::pi / 4;
  EXPECT_TRUE(holds(v, 0.05, 0.003));
  EXPECT_TRUE(holds(v, 0.01, 0.04));
  EXPECT_FALSE(holds(v, 0.01, 0.01)) << "beneath";
  EXPECT_FALSE(holds(v, 0.09, 0.01));
}

TEST_P(Room, GoesRoundAShelfAndThroughWhatASeedPasses) {
  Vessel v = box();
  v.pieces = {{.a = {0, 0.03}, .b = {0.09, 0.03}}};
  EXPECT_TRUE(holds(v, 0.02, 0.01)) << "by way of a gap of 10 mm";
  v.pieces[0].b.x() = 0.0965;
  EXPECT_FALSE(holds(v, 0.02, 0.01)) << "a gap of 3.5 mm, for seeds of 4";
  v.pieces[0].b.x() = 0.0959;
  EXPECT_TRUE(holds(v, 0.02, 0.01)) << "a gap of 4.1 mm";
}

/// A wall down to a hole in the floor, and a lid over all behind it: a seed that sinks into the hole is out, and does
/// not come up again behind the wall.
TEST_P(Room, DoesNotGoRoundThroughAHole) {
  Vessel v = box();
  const double depth = v.depth.value_or(0);
  v.holes = {{.centre = 0.05, .width = 0.04, .across = depth / 2, .across_length = depth}};
  v.pieces = {{.a = {0.05, 0.003}, .b = {0.05, 0.03}}, {.a = {0.05, 0.03}, .b = {0.1, 0.03}}};
  EXPECT_TRUE(holds(v, 0.04, 0.01));
  EXPECT_FALSE(holds(v, 0.06, 0.01)) << "3 mm over the hole, for seeds of 4";
  v.pieces[0].a.y() = 0.005;
  EXPECT_TRUE(holds(v, 0.06, 0.01)) << "5 mm over it";
}

TEST(Room3d, LiesOverAGrooveAlongTheVessel) {
  Vessel v;
  v.name = "tray";
  v.length = 0.1, v.height = 0.06, v.depth = 0.04;
  v.pieces = {{.a = {0, 0.02}, .b = {0.02, 0}}, {.a = {0.02, 0}, .b = {0.04, 0.02}}};
  for (WallPiece& piece : v.pieces) piece.drawn_out = DrawnOut::along;
  const FreeRoom room(v, Space::three_dimensional, radius);
  EXPECT_TRUE(room.holds({0.05, 0.005, 0.02}));
  EXPECT_FALSE(room.holds({0.05, 0.005, 0.005})) << "beneath";
  EXPECT_FALSE(room.holds({0.05, 0.005, 0.035}));
}

TEST(Room3d, GoesOnAcrossThePeriodOfItsDepth) {
  Vessel v;
  v.name = "tray";
  v.length = 0.1, v.height = 0.06, v.depth = 0.04;
  v.front_and_back = Sides::periodic;
  v.pieces = {{.a = {0.012, 0}, .b = {0.012, 0.058}}, {.a = {0.012, 0.058}, .b = {0.04, 0.03}}};
  for (WallPiece& piece : v.pieces) piece.drawn_out = DrawnOut::along;
  EXPECT_TRUE(FreeRoom(v, Space::three_dimensional, radius).holds({0.05, 0.01, 0.025})) << "from the next image";
  v.front_and_back = Sides::walls;
  EXPECT_FALSE(FreeRoom(v, Space::three_dimensional, radius).holds({0.05, 0.01, 0.025}));
}

TEST_P(Room, IsNotWithinWhatIsClosed) {
  Vessel v = box();
  v.pieces = {{.centre = {0.05, 0.03}, .radius = 0.02, .from = 0, .to = 2 * std::numbers::pi}};
  EXPECT_FALSE(holds(v, 0.05, 0.03));
  EXPECT_TRUE(holds(v, 0.05, 0.005));
  v.pieces[0].to = 1.9 * std::numbers::pi;  // a gap of 6 mm, on the right
  EXPECT_TRUE(holds(v, 0.05, 0.03));
}

TEST_P(Room, OfADrumIsReachedAsIfItsUpperHalfWereOpen) {
  Vessel v = box();
  v.length = v.height = 0.06, v.box = false;
  v.pieces = {{.centre = {0.03, 0.03}, .radius = 0.03, .from = 0, .to = 2 * std::numbers::pi},
              {.centre = {0.03, 0.03}, .radius = 0.01, .from = 0, .to = 2 * std::numbers::pi}};
  EXPECT_TRUE(holds(v, 0.03, 0.005));
  EXPECT_TRUE(holds(v, 0.03, 0.055));
  EXPECT_FALSE(holds(v, 0.03, 0.03)) << "in its shaft";
  EXPECT_FALSE(holds(v, 0.002, 0.002)) << "in the corner beside it";
  EXPECT_FALSE(holds(v, 0.002, 0.058)) << "in the corner over it, open above as it is";
  EXPECT_FALSE(holds(v, 0.058, 0.058));
}

/// Two slopes that end over an outlet, and beside them places that lie as open above.
TEST_P(Room, OfDrawnWallsAloneLiesBetweenThem) {
  Vessel v = box();
  v.box = false;
  v.pieces = {{.a = {0.01, 0.05}, .b = {0.04, 0.001}}, {.a = {0.06, 0.001}, .b = {0.09, 0.05}}};
  EXPECT_TRUE(holds(v, 0.05, 0.004)) << "over the outlet";
  EXPECT_TRUE(holds(v, 0.05, 0.0005)) << "in it";
  EXPECT_FALSE(holds(v, 0.02, 0.0005)) << "beside it";
  EXPECT_TRUE(holds(v, 0.02, 0.045));
  EXPECT_TRUE(holds(v, 0.02, 0.055)) << "heaped over the rim";
  EXPECT_FALSE(holds(v, 0.01, 0.01)) << "beside and beneath a slope";
  EXPECT_FALSE(holds(v, 0.005, 0.04));
  EXPECT_FALSE(holds(v, 0.095, 0.055));
  v.pieces = {{.a = {0.01, 0.02}, .b = {0.09, 0.02}}};
  EXPECT_TRUE(holds(v, 0.05, 0.03)) << "on a plate";
  EXPECT_FALSE(holds(v, 0.005, 0.03));
  EXPECT_FALSE(holds(v, 0.05, 0.01)) << "beneath it";
}

TEST(Room3d, OfADrawnConeLiesWithinIt) {
  Vessel v;
  v.name = "hopper";
  v.length = v.depth.emplace(0.1), v.height = 0.06, v.box = false;
  v.pieces = {{.a = {0.01, 0}, .b = {0.04, 0.05}, .about = Eigen::Vector2d(0.05, 0.05)}};
  const FreeRoom room(v, Space::three_dimensional, radius);
  EXPECT_TRUE(room.holds({0.05, 0.01, 0.05}));
  EXPECT_TRUE(room.holds({0.07, 0.04, 0.06}));
  EXPECT_FALSE(room.holds({0.05, 0.02, 0.09})) << "beside it, and between its front and its back";
  EXPECT_FALSE(room.holds({0.09, 0.02, 0.05}));
}

/// A slit of 3 mm, and seeds of 2 and of 4 mm.
/// A disc over the middle of a round vessel, and the slopes of a cone: about the vessel's own axis as beside it.
TEST(Room3d, OfARoundVesselGoesUnderWhatIsTurnedAboutItsAxis) {
  Vessel v;
  v.name = "tray", v.plan = Plan::round;
  v.length = 0.1, v.height = 0.06, v.depth = 0.1;
  for (const double beside : {0.0, 1e-6}) {
    const Eigen::Vector2d axis(0.05 + beside, 0.05);
    v.pieces = {{.a = {0, 0.03}, .b = {0.03, 0.03}, .about = axis}};
    const FreeRoom under_a_disc(v, Space::three_dimensional, radius);
    for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.05, 0.01, 0.05), Eigen::Vector3d(0.06, 0.01, 0.04)})
      EXPECT_TRUE(under_a_disc.holds(at)) << at.transpose() << ", beside by " << beside;
    v.pieces[0].b.x() = 0.05;
    EXPECT_FALSE(FreeRoom(v, Space::three_dimensional, radius).holds({0.05, 0.01, 0.05})) << "from wall to wall";
    v.pieces = {{.a = {0.01, 0.01}, .b = {0.04, 0.04}, .about = axis}};
    const FreeRoom over_a_cone(v, Space::three_dimensional, radius);
    EXPECT_TRUE(over_a_cone.holds({0.05, 0.03, 0.06}));
    EXPECT_TRUE(over_a_cone.holds({0.085, 0.01, 0.05})) << "by way of the gap at the wall";
  }
}

TEST_P(Room, IsOfEachWidthOfSeed) {
  Vessel v = box();
  v.pieces = {{.a = {0, 0.03}, .b = {0.0485, 0.03}}, {.a = {0.0515, 0.03}, .b = {0.1, 0.03}}};
  std::vector<SeedLot> lots = {{"large", 2 * radius, 4e-5, Shape::ball, 0.5},
                               {"small", radius, 5e-6, Shape::ball, 0.5}};
  const FreeRooms rooms(v, lots, GetParam());
  const Eigen::Vector3d beneath(0.02, 0.01, v.depth.value_or(0) / 2), above(0.02, 0.05, v.depth.value_or(0) / 2);
  EXPECT_TRUE(rooms.of(0.5 * radius).holds(beneath));
  EXPECT_TRUE(rooms.of_smallest().holds(beneath));
  EXPECT_FALSE(rooms.of(radius).holds(beneath));
  EXPECT_TRUE(rooms.of(radius).holds(above));
}

/// As few cells as they are, a gap of four seeds' widths is none that is known of.
TEST_P(Room, SaysHowNarrowWaysItMisses) {
  Vessel v = box();
  v.pieces = {{.a = {0, 0.03}, .b = {0.084, 0.03}}};
  const FreeRoom fine(v, GetParam(), radius), coarse(v, GetParam(), radius, 200);
  const Eigen::Vector3d beneath(0.02, 0.01, v.depth.value_or(0) / 2);
  EXPECT_TRUE(fine.holds(beneath));
  EXPECT_FALSE(fine.missed_width());
  EXPECT_FALSE(coarse.holds(beneath));
  EXPECT_GT(coarse.missed_width(), 0.016);
  v.pieces.clear();
  EXPECT_FALSE(FreeRoom(v, GetParam(), radius, 200).missed_width()) << "nothing is in the way";
}

TEST_P(Room, ReachesUnderWhatStandsOverTheTop) {
  Vessel v = box();
  v.pieces = {{.a = {0.02, 0.05}, .b = {0.05, 0.08}}, {.a = {0.05, 0.08}, .b = {0.08, 0.05}}};
  EXPECT_TRUE(holds(v, 0.05, 0.055)) << "a roof that is open below";
  v.pieces.push_back({.a = {0.02, 0.05}, .b = {0.08, 0.05}});
  EXPECT_FALSE(holds(v, 0.05, 0.06)) << "and one that is not";
}

TEST_P(Room, GoesOnAcrossPeriodicEnds) {
  Vessel v = box();
  v.sides = Sides::periodic;
  v.pieces = {{.a = {0.03, 0}, .b = {0.03, 0.058}}, {.a = {0.03, 0.058}, .b = {0.1, 0.03}}};
  EXPECT_TRUE(holds(v, 0.06, 0.01)) << "open to the next image's left part";
  v.pieces.push_back({.a = {0.03, 0.02}, .b = {0.05, 0.02}});
  v.pieces.push_back({.a = {0.05, 0.02}, .b = {0.05, 0}});
  for (const double period : {-v.length, 0.0, v.length}) {
    EXPECT_TRUE(holds(v, period + 0.06, 0.01)) << "where a seed lies that is not carried over yet: " << period;
    EXPECT_FALSE(holds(v, period + 0.04, 0.01)) << "in a closed box: " << period;
  }
  v.sides = Sides::walls;
  EXPECT_FALSE(holds(v, 0.06, 0.01));
}

}  // namespace
}  // namespace vibrosow
