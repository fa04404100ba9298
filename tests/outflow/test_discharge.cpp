#include "outflow/discharge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "made_up_run.hpp"

namespace vibrosow {
namespace {

class DischargeCurve : public testing::Test {
 protected:
  void SetUp() override {
    scene.lots[0].number_fraction = 0.5;
    scene.lots.push_back({.name = "pea", .diameter = 8e-3, .mass = 160e-6, .number_fraction = 0.5});
    scene.tray.fill = Fill{.count = 6};
    scene.hopper = Vessel{};
    scene.hopper->fill = Fill{.count = 4};  // 10 grains of 100 mg: 1 g
    run = made_up_run(scene);
    add_grain(run, 1, 1, 0);
    add_grain(run, 2, 0, 1, 160e-6);
    add_grain(run, 3, 2, 1, 160e-6);
  }
  Scene scene = made_up_scene(2);
  vibrosow::Run run;
};

TEST_F(DischargeCurve, AddsUpWhatHasLeftAHole) {
  const std::vector<double> times = {0, 1, 2.5, 10};
  EXPECT_EQ(discharge_curve(scene, run, times, Discharge::seeds), (std::vector<double>{0, 1, 1, 2}));
  EXPECT_EQ(discharge_curve(scene, run, times, Discharge::mass), (std::vector<double>{0, 40e-6, 40e-6, 200e-6}));
  EXPECT_NEAR(discharge_curve(scene, run, {10}, Discharge::fraction)[0], 0.2, 1e-12);
}

TEST_F(DischargeCurve, OfOneHoleOrLot) {
  EXPECT_EQ(discharge_curve(scene, run, {10}, Discharge::seeds, "2")[0], 1);
  EXPECT_EQ(discharge_curve(scene, run, {2}, Discharge::seeds, "2")[0], 0);
  EXPECT_NEAR(discharge_curve(scene, run, {10}, Discharge::fraction, "all", "pea")[0], 0.16 / 0.8, 1e-12);
}

TEST_F(DischargeCurve, KnowsNothingBeyondTheRunsEnd) {
  EXPECT_TRUE(std::isnan(discharge_curve(scene, run, {10.5}, Discharge::seeds)[0]));
  run.end_time = 10 - 1e-12;  // a rounding error short
  EXPECT_EQ(discharge_curve(scene, run, {10}, Discharge::seeds)[0], 2);
  run.status = RunStatus::interrupted;
  run.end_time = 5;
  EXPECT_TRUE(std::isnan(discharge_curve(scene, run, {6}, Discharge::seeds)[0]));
}

TEST_F(DischargeCurve, RefusesAHoleOrLotThatIsNotThere) {
  EXPECT_THROW(discharge_curve(scene, run, {1}, Discharge::seeds, "3"), std::invalid_argument);
  EXPECT_THROW(discharge_curve(scene, run, {1}, Discharge::seeds, "0"), std::invalid_argument);
  EXPECT_THROW(discharge_curve(scene, run, {1}, Discharge::seeds, "all", "barley"), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
