#include "fields/tray_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fields/made_up_bed.hpp"

namespace vibrosow {
namespace {

TEST(TrayFrame, TakesOffDisplacementVelocityAndTilt) {
  Vessel tray = made_up_tray(0.4);
  tray.origin = {0.1, 0.2};
  tray.tilt = std::asin(0.6);
  Snapshot lab;
  lab.tray_x = 0.01, lab.tray_vy = 0.5;
  // 50 mm along the floor, which rises by 3 in 4, and 10 mm off it.
  put(lab, 0.11 + 0.04 - 0.006, 0.2 + 0.03 + 0.008, 0.8, 0.5 + 0.6);
  put(lab, 0.11 - 0.04, 0.2 - 0.03, 0, 0.5);
  lab.start_x[0] = 0.1, lab.start_y[0] = 0.2;
  const Snapshot own = in_tray_frame(lab, tray);
  EXPECT_NEAR(own.x[0], 0.05, 1e-15);
  EXPECT_NEAR(own.y[0], 0.01, 1e-15);
  EXPECT_NEAR(own.vx[0], 1, 1e-15);
  EXPECT_NEAR(own.vy[0], 0, 1e-15);
  EXPECT_NEAR(own.start_x[0], 0, 1e-15);
  EXPECT_NEAR(own.vy[1], 0, 1e-15);
  EXPECT_EQ(own.tray_x, 0);
  EXPECT_EQ(grains_in_tray(own, tray), std::vector<std::size_t>{0});
}

TEST(TrayFrame, AGrainThatTurnsWithTheTrayIsAtRestInIt) {
  const Vessel tray = made_up_tray(0.4);
  Snapshot lab;
  lab.tray_y = 0.01, lab.tray_angle = 0.5, lab.tray_spin = 3, lab.tray_vx = 0.2;
  put(lab, 0.1 * std::cos(0.5), 0.01 + 0.1 * std::sin(0.5), 0.2 - 0.3 * std::sin(0.5), 0.3 * std::cos(0.5));
  lab.omega[0] = 3;
  lab.angle = {0.7};
  const Snapshot own = in_tray_frame(lab, tray);
  EXPECT_NEAR(own.x[0], 0.1, 1e-15);
  EXPECT_NEAR(own.y[0], 0, 1e-15);
  EXPECT_NEAR(own.vx[0], 0, 1e-15);
  EXPECT_NEAR(own.vy[0], 0, 1e-15);
  EXPECT_EQ(own.omega[0], 0);
  EXPECT_NEAR(own.angle[0], 0.2, 1e-15);
}

TEST(TrayFrame, OfATrayThatTurnsOverAndOverItIsTheFrameAtRest) {
  Vessel tray = made_up_tray(0.4);
  tray.origin = {0.1, 0.2}, tray.motion = TurningMotion{{0.2, 0.2}, 3};
  Snapshot lab;
  lab.tray_x = 0.4, lab.tray_y = 0.4, lab.tray_angle = 3.1, lab.tray_vx = 0.6, lab.tray_vy = -0.6, lab.tray_spin = 3;
  put(lab, 0.15, 0.22, 0.5, -0.1);
  const Snapshot own = in_tray_frame(lab, tray);
  EXPECT_NEAR(own.x[0], 0.05, 1e-15);
  EXPECT_NEAR(own.y[0], 0.02, 1e-15);
  EXPECT_EQ(own.vx[0], 0.5);
  EXPECT_EQ(own.vy[0], -0.1);
  EXPECT_EQ(own.tray_angle, 0);
}

TEST(TrayFrame, AClumpInSpaceIsTurnedBackWithTheTray) {
  Vessel tray = made_up_tray(0.4);
  tray.depth = 0.06;
  tray.tilt = 0.2;
  Snapshot lab;
  lab.tray_angle = 0.3;
  put_ball(lab, {0, 0, 0.03});
  // By 0.7 about the axis across, after half a turn about x.
  lab.q_w = {0}, lab.q_x = {std::cos(0.35)}, lab.q_y = {std::sin(0.35)}, lab.q_z = {0};
  const Snapshot own = in_tray_frame(lab, tray);
  EXPECT_NEAR(own.q_w[0], 0, 1e-15);
  EXPECT_NEAR(own.q_x[0], std::cos(0.1), 1e-15);
  EXPECT_NEAR(own.q_y[0], std::sin(0.1), 1e-15);
  EXPECT_NEAR(own.q_z[0], 0, 1e-15);
}

TEST(TrayFrame, TakesOffWhatIsAcrossAndTurnsSpinsWithTheTray) {
  Vessel tray = made_up_tray(0.4);
  tray.depth = 0.06;
  tray.front = -0.1;
  tray.tilt = std::asin(0.6);
  Snapshot lab;
  lab.tray_z = 0.01, lab.tray_vz = -0.2;
  put_ball(lab, {0, 0, -0.07}, {0, 0, 0.3});
  put_ball(lab, {0.04 - 0.006, 0.03 + 0.008, -0.07});
  put_ball(lab, {0.04 - 0.006, 0.03 + 0.008, -0.029});
  lab.omega_x = {0.8, 0, 0}, lab.omega_y = {0.6, 0, 0};  // about the floor's length
  const Snapshot own = in_tray_frame(lab, tray);
  EXPECT_NEAR(own.z[0], 0.02, 1e-15);
  EXPECT_NEAR(own.vz[0], 0.5, 1e-15);
  EXPECT_NEAR(own.omega_x[0], 1, 1e-15);
  EXPECT_NEAR(own.omega_y[0], 0, 1e-15);
  EXPECT_NEAR(own.start_z[0], 0.03, 1e-15);
  EXPECT_EQ(own.tray_z, 0);
  EXPECT_TRUE(own.q_w.empty());
  EXPECT_EQ(grains_in_tray(own, tray), (std::vector<std::size_t>{0, 1})) << "the last is behind the back";
}

TEST(TrayFrame, InAPeriodicTrayEachGrainIsWhereItsImageLiesWithin) {
  Vessel tray = made_up_tray(0.06);
  tray.origin = {0.1, 0}, tray.sides = Sides::periodic;
  Snapshot lab;
  lab.tray_x = 0.01;
  put(lab, 0.11 - 0.003, 0.01), put(lab, 0.11 + 0.03, 0.01), put(lab, 0.11 + 0.062, 0.01);
  const Snapshot own = in_tray_frame(lab, tray);
  EXPECT_NEAR(own.x[0], 0.057, 1e-15);
  EXPECT_NEAR(own.x[1], 0.03, 1e-15);
  EXPECT_NEAR(own.x[2], 0.002, 1e-15);
  EXPECT_EQ(grains_in_tray(own, tray).size(), 3u);
  tray.sides = Sides::walls;
  EXPECT_EQ(grains_in_tray(in_tray_frame(lab, tray), tray).size(), 1u);
}

TEST(TrayFrame, InSpaceAPeriodicDepthToo) {
  Vessel tray = made_up_tray(0.06);
  tray.depth = 0.02, tray.front = -0.1, tray.sides = tray.front_and_back = Sides::periodic;
  Snapshot lab;
  put_ball(lab, {-0.001, 0.01, -0.1 + 0.021}), put_ball(lab, {0.03, 0.01, -0.1 - 0.002});
  const Snapshot own = in_tray_frame(lab, tray);
  EXPECT_NEAR(own.x[0], 0.059, 1e-15);
  EXPECT_NEAR(own.z[0], 0.001, 1e-15);
  EXPECT_NEAR(own.z[1], 0.018, 1e-15);
  EXPECT_EQ(grains_in_tray(own, tray).size(), 2u);
}

TEST(Images, StandBeyondBothSeamsAsFarAsAsked) {
  Snapshot own;
  put_ball(own, {0.001, 0.01, 0.019}), put_ball(own, {0.03, 0.01, 0.01});
  own.q_w = {1, 0}, own.q_x = {0, 1}, own.q_y = own.q_z = {0, 0};
  const Snapshot bed = with_images(own, {0.06, 0.02}, 0.002);
  ASSERT_EQ(bed.size(), 5u) << "along, across and both of the first";
  EXPECT_EQ(bed.id, (std::vector<std::int64_t>{0, 1, 0, 0, 0}));
  EXPECT_EQ(bed.x, (std::vector<double>{0.001, 0.03, 0.001, 0.001 + 0.06, 0.001 + 0.06}));
  EXPECT_EQ(bed.z, (std::vector<double>{0.019, 0.01, 0.019 - 0.02, 0.019 - 0.02, 0.019}));
  EXPECT_EQ(bed.volume.size(), 5u);
  EXPECT_EQ(bed.q_w, (std::vector<double>{1, 0, 1, 1, 1}));
  EXPECT_TRUE(bed.area.empty());
  EXPECT_EQ(with_images(own, {}, 0.002).size(), 2u);
  EXPECT_EQ(with_images(own, {0.06, 0}, 0.15).size(), 2u + 5u + 6u) << "in three periods on each side";
}

TEST(PartOf, HasTheChosenGrainsAndTheMomentOfAll) {
  Snapshot bed;
  put_ball(bed, {0.001, 0.01, 0.019}), put_ball(bed, {0.03, 0.02, 0.01}), put_ball(bed, {0.05, 0.03, 0.005});
  bed.time = 2, bed.tray_x = 0.004;
  const Snapshot part = part_of(bed, {0, 2});
  EXPECT_EQ(part.time, 2);
  EXPECT_EQ(part.tray_x, 0.004);
  EXPECT_EQ(part.id, (std::vector<std::int64_t>{0, 2}));
  EXPECT_EQ(part.y, (std::vector<double>{0.01, 0.03}));
  EXPECT_EQ(part.volume.size(), 2u);
  EXPECT_TRUE(part.q_w.empty());
  EXPECT_EQ(part_of(bed, {}).size(), 0u);
}

}  // namespace
}  // namespace vibrosow
