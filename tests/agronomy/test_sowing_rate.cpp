#include "agronomy/sowing_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace vibrosow {
namespace {

constexpr RowPace rapeseed{.row_spacing = 0.25, .speed = 8 * kilometre_per_hour};
constexpr double gram = 1e-3;

TEST(SowingRate, RapeseedOfAnAdvisersTable) {
  // 3.5 kg/ha in rows of 25 cm at 8 km/h: 3.5e-4 kg/m2 x 0.25 m x 2.2222 m/s.
  const double row = row_rate(3.5 * kilogram_per_hectare, rapeseed);
  EXPECT_NEAR(row / gram, 0.19444, 1e-5);
  EXPECT_NEAR(seeds_of_mass(row, 4.5e-3 * gram), 43.21, 0.005);
  // 3.5 kg over 10 000 m2 of seeds of 4.5 mg: 77.8 to the square metre, one every 5.1 cm of a row.
  EXPECT_NEAR(seeds_of_mass(3.5 * kilogram_per_hectare, 4.5e-3 * gram), 77.78, 0.005);
  EXPECT_NEAR(mean_spacing(43.21, rapeseed.speed), 0.05143, 1e-5);
}

TEST(SowingRate, WheatForPlantsThatStand) {
  const double seeds = seeds_for_plants(280, 0.85);
  EXPECT_NEAR(seeds, 329.41, 0.005);
  EXPECT_NEAR(mass_of_seeds(seeds, 53e-3 * gram) / kilogram_per_hectare, 174.6, 0.05);  // published: 175
}

TEST(SowingRate, EveryFormulaHasItsInverse) {
  const double per_area = 180 * kilogram_per_hectare;
  const double row = row_rate(per_area, rapeseed);
  EXPECT_DOUBLE_EQ(sowing_rate(row, rapeseed), per_area);
  EXPECT_DOUBLE_EQ(speed_for(per_area, row, rapeseed.row_spacing), rapeseed.speed);
  EXPECT_DOUBLE_EQ(mass_of_seeds(seeds_of_mass(row, 5e-5), 5e-5), row);
  EXPECT_DOUBLE_EQ(plants_of_seeds(seeds_for_plants(280, 0.85), 0.85), 280);
}

TEST(SowingRate, ARowThatGivesNothingSowsNothing) {
  EXPECT_EQ(sowing_rate(0, rapeseed), 0);
  EXPECT_EQ(mean_spacing(0, rapeseed.speed), std::numeric_limits<double>::infinity());
}

TEST(SowingRate, RefusesWhatIsNoDrill) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(row_rate(0.01, {.row_spacing = 0, .speed = 2}), std::invalid_argument);
  EXPECT_THROW(row_rate(0.01, {.row_spacing = 0.25, .speed = -2}), std::invalid_argument);
  EXPECT_THROW(row_rate(-0.01, rapeseed), std::invalid_argument);
  EXPECT_THROW(sowing_rate(nan, rapeseed), std::invalid_argument);
  EXPECT_THROW(speed_for(0, 1, 0.25), std::invalid_argument);
  EXPECT_THROW(seeds_of_mass(1, 0), std::invalid_argument);
  EXPECT_THROW(seeds_for_plants(280, 85), std::invalid_argument);  // percent for a fraction
  EXPECT_THROW(seeds_for_plants(280, 0), std::invalid_argument);
  EXPECT_THROW(mean_spacing(1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
