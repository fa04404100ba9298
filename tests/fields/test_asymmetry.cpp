#include "fields/asymmetry.hpp"

#include <gtest/gtest.h>

#include "fields/made_up_bed.hpp"

namespace vibrosow {
namespace {

const Vessel tray = made_up_tray(0.4);

TEST(FluxAsymmetry, WeighsWhatMovesDownLeftAgainstRight) {
  Snapshot s;
  put(s, 0.1, 0.01, 0, -0.3, 0, 2e-3, 20e-6);
  put(s, 0.3, 0.01, 0, -0.1, 0, 2e-3, 20e-6);
  EXPECT_NEAR(flux_asymmetry(s, tray).value(), 0.5, 1e-12);
  put(s, 0.3, 0.02, 0, 5.0);    // moves up
  put(s, 0.3, -0.01, 0, -5.0);  // is out
  put(s, 0.3, 0.02, 0, -0.1, 0, 2e-3, 40e-6);
  EXPECT_NEAR(flux_asymmetry(s, tray).value(), 0, 1e-12);
}

TEST(FluxAsymmetry, ReachesItsEndsAndIsNoneAtRest) {
  Snapshot s;
  put(s, 0.3, 0.01);
  EXPECT_FALSE(flux_asymmetry(s, tray));
  put(s, 0.3, 0.01, 0, -1);
  EXPECT_EQ(flux_asymmetry(s, tray), -1);
}

TEST(SurfaceAsymmetry, ComparesMeanHeightsOfColumns) {
  Snapshot s;
  EXPECT_FALSE(surface_asymmetry(s, tray, 0.1));
  // Four columns of 0.1 m: tops at 40, 20, 20 and 0 mm.
  put(s, 0.05, 0.038), put(s, 0.06, 0.01), put(s, 0.15, 0.018), put(s, 0.25, 0.018);
  EXPECT_NEAR(surface_asymmetry(s, tray, 0.1).value(), (60.0 - 20) / 80, 1e-12);
  put(s, 0.4, 0.038);
  EXPECT_NEAR(surface_asymmetry(s, tray, 0.1).value(), 0, 1e-12);
}

TEST(SurfaceAsymmetry, HasColumnsAcross3d) {
  Vessel deep = tray;
  deep.depth = 0.2;
  Snapshot s;
  // Columns of 0.1 x 0.1 m: tops at 40 and 20 mm left, 40 mm right.
  put_ball(s, {0.05, 0.038, 0.05}), put_ball(s, {0.15, 0.018, 0.15}), put_ball(s, {0.25, 0.038, 0.2});
  EXPECT_NEAR(surface_asymmetry(s, deep, 0.2).value(), 0, 1e-12) << "one column across";
  EXPECT_NEAR(surface_asymmetry(s, deep, 0.1).value(), 20.0 / 100, 1e-12);
  put_ball(s, {0.35, 0.058, 0.21});  // fallen over the back
  EXPECT_NEAR(surface_asymmetry(s, deep, 0.1).value(), 20.0 / 100, 1e-12);
}

}  // namespace
}  // namespace vibrosow
