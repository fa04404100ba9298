#include "agronomy/hole_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/made_up_hole_table.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

HoleTable table_of(std::vector<HoleRecord> records) {
  return HoleTable(std::move(records));
}

TEST(HoleTable, IsExactAtItsOwnPlaces) {
  const HoleTable table(made_up_records());
  for (const HoleRecord& record : made_up_records()) {
    const auto found = table.at(record.at);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->outflow, record.outflow, 1e-12 * record.outflow)
        << record.at.aspect << ' ' << record.at.width << ' ' << record.at.peak_speed;
    EXPECT_NEAR(found->chance, 0.05, 1e-12);
    EXPECT_EQ(found->stood_still, record.at.aspect == 1 ? record.stood_still : 0);
  }
}

TEST(HoleTable, OfBeverloosFormMissesNothingBetweenWidths) {
  const HoleTable table(made_up_records());
  const HoleConditions between{1, 4.4, 1.4, 6};
  EXPECT_NEAR(table.at(between)->outflow, made_up_outflow(between), 1e-12);
}

TEST(HoleTable, GrowsWithTheWidth) {
  const HoleTable table(made_up_records());
  double before = 0;
  for (int k = 0; k <= 450; ++k) {
    const double width = 2 + 0.01 * k;
    const double outflow = table.at({1, width, 1.9, 4})->outflow;
    EXPECT_GT(outflow, before) << width;
    before = outflow;
  }
}

TEST(HoleTable, LongerSeedsComeByAFactorBetweenTheShapes) {
  const HoleTable table(made_up_records());
  // Half way, the mean of the logarithms of 1 and 1/2.
  EXPECT_NEAR(table.at({1.5, 3.5, 1.4, 6})->outflow, made_up_outflow({1, 3.5, 1.4, 6}) * std::sqrt(0.5), 1e-9);
}

TEST(HoleTable, SaysNothingOutside) {
  const HoleTable table(made_up_records());
  EXPECT_FALSE(table.at({1, 1.99, 1.4, 6}));
  EXPECT_FALSE(table.at({1, 6.51, 1.4, 6}));
  EXPECT_FALSE(table.at({1, 3, 0.69, 6}));
  EXPECT_FALSE(table.at({1, 3, 3.81, 6}));
  EXPECT_FALSE(table.at({1, 3, 1.4, 2.9}));
  EXPECT_FALSE(table.at({1, 3, 1.4, 6.1}));
  EXPECT_FALSE(table.at({0.9, 3, 1.4, 6}));
  EXPECT_FALSE(table.at({2.1, 3, 1.4, 6}));
  EXPECT_FALSE(table.at({1.2, 2.2, 1.4, 6})) << "balls have it, longer seeds have not";
  EXPECT_TRUE(table.at({1, 2.2, 1.4, 6}));
}

TEST(HoleTable, TellsWhereItReaches) {
  const HoleTable table(made_up_records());
  EXPECT_EQ(table.aspects().most, 2);
  EXPECT_EQ(table.widths(1).least, 2);
  EXPECT_EQ(table.widths(1.5).least, 2.5);
  EXPECT_EQ(table.widths(1.5).most, 5);
  EXPECT_EQ(table.peak_speeds(2).most, 3);
  EXPECT_EQ(table.depths(2).least, 3);
  EXPECT_THAT(table.speed_steps(1, {0, 9}), ElementsAre(0.7, 1.4, 2.4, 3.8));
  EXPECT_THAT(table.speed_steps(1.5, {0, 9}), ElementsAre(0.7, 1.4, 2.4, 3.0));
  EXPECT_EQ(table.amplitude(), 2);
  EXPECT_THROW(table.widths(3), std::invalid_argument);
}

TEST(HoleTable, TakesTheWorstOfThePlacesAround) {
  std::vector<HoleRecord> records = made_up_records();
  for (HoleRecord& record : records)
    if (record.at.aspect == 1 && record.at.width == 3 && record.at.peak_speed == 1.4 && record.at.depth == 6) {
      record.stood_still = 0.5;
      record.watched = 7;
    }
  const HoleTable table(records);
  const auto beside = table.at({1, 3.1, 1.5, 5});
  EXPECT_EQ(beside->stood_still, 0.5);
  EXPECT_EQ(beside->watched, 7);
  EXPECT_EQ(table.at({1, 4.1, 1.5, 5})->stood_still, 0);
}

/// By slopes found by changing the outflow of one record after the other.
double chance_by_trying(const HoleConditions& at) {
  const std::vector<HoleRecord> records = made_up_records();
  constexpr double little = 1e-6;
  const double told = table_of(records).at(at)->outflow;
  double sum = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::vector<HoleRecord> changed = records;
    changed[i].outflow *= 1 + little;
    const double slope = (table_of(changed).at(at)->outflow / told - 1) / little;
    sum += std::pow(slope * records[i].half_width_95 / records[i].outflow, 2);
  }
  return std::sqrt(sum);
}

TEST(HoleTable, ItsChanceIsThatOfThePlacesAround) {
  const HoleTable table(made_up_records());
  for (const HoleConditions& at : {HoleConditions{1, 3.1, 1.5, 5}, HoleConditions{2, 3.5, 1.4, 6},
                                   HoleConditions{2, 4.1, 2.2, 4}, HoleConditions{1.3, 4.1, 2.2, 4}})
    EXPECT_NEAR(table.at(at)->chance, chance_by_trying(at), 1e-6) << at.aspect << ' ' << at.width;
  EXPECT_LT(table.at({1, 3.1, 1.5, 5})->chance, 0.05) << "a mean of several";
}

TEST(HoleTable, LeavingPlacesOutTellsItsError) {
  std::vector<HoleRecord> records;
  for (const double depth : {3.0, 6.0})
    for (const double width : {2.0, 3.0, 4.0, 5.0, 6.0})
      for (const double speed : {1.0, 2.0, 4.0}) {
        HoleRecord record = made_up_record({1, width, speed, depth});
        record.outflow = std::pow(width, 2.5);  // which the interpolation is made for
        records.push_back(record);
      }
  for (const double width : {2.5, 3.5, 4.5, 5.5})
    EXPECT_NEAR(HoleTable(records).interpolation_error(1, width, 1.5), 0, 1e-12);
  for (HoleRecord& record : records)
    if (record.at.width == 3 && record.at.peak_speed == 2) record.outflow *= std::exp(0.1);
  const HoleTable bent(records);
  // At 2.5: along widths, of the places at 3, one speed of the two around misses 0.1; along speeds, of those at 2 and
  // 3, one of two.
  EXPECT_NEAR(bent.interpolation_error(1, 2.5, 1.5), 1.96 / 4 * std::sqrt(0.01 / 2 + 0.01 / 2), 1e-4);
  EXPECT_NEAR(bent.interpolation_error(1, 5.5, 1.5), 0, 1e-12) << "far from it";
}

TEST(HoleTable, LeavingShapesOutTellsItsErrorWhereItIs) {
  std::vector<HoleRecord> records;
  for (const double depth : {3.0, 6.0})
    for (const double width : {2.0, 3.0, 4.0})
      for (const double speed : {1.0, 2.0, 4.0})
        for (const double aspect : {1.0, 2.0, 3.0}) {
          HoleRecord record = made_up_record({aspect, width, speed, depth});
          record.outflow = std::pow(width, 2.5) * std::exp(-aspect);
          records.push_back(record);
        }
  EXPECT_NEAR(HoleTable(records).interpolation_error(2.5, 2.5, 1.5), 0, 1e-12);
  // Where they are slow, longer seeds flow otherwise, along no other axis than the shape.
  for (HoleRecord& record : records)
    if (record.at.aspect == 2 && record.at.peak_speed == 1) record.outflow *= std::exp(0.1);
  const HoleTable bent(records);
  EXPECT_NEAR(bent.interpolation_error(2.5, 2.5, 3), 1.96 / 4 * 0.05, 1e-4) << "far from it: the speeds' bend alone";
  EXPECT_NEAR(bent.interpolation_error(2.5, 2.5, 1.5), 1.96 / 4 * std::sqrt(0.0025 + 0.01 / 2), 1e-4);
}

TEST(HoleTable, MissesABendByLessThanItsError) {
  // Linear between places of a law that bends: within the band nearly everywhere, and not by a band that is far too
  // wide.
  const HoleTable table(made_up_records());
  int within = 0, all = 0;
  double worst = 0;
  for (int of_width = 0; of_width < 12; ++of_width)
    for (int of_speed = 0; of_speed < 19; ++of_speed) {
      const double width = 2.1 + 0.37 * of_width, speed = 0.75 * std::pow(1.09, of_speed);
      const HoleConditions at{1, width, speed, 6};
      const double missed = std::abs(std::log(table.at(at)->outflow / made_up_outflow(at)));
      const double allowed = table.interpolation_error(1, width, speed);
      ++all;
      within += missed <= allowed ? 1 : 0;
      worst = std::max(worst, missed / allowed);
    }
  EXPECT_GE(within, 0.95 * all);
  EXPECT_GT(worst, 0.3);
}

TEST(HoleTable, RefusesWhatIsNoTable) {
  std::vector<HoleRecord> records = made_up_records();
  const auto refused = [](const std::string& message) {
    return ThrowsMessage<std::invalid_argument>(HasSubstr(message));
  };
  EXPECT_THAT([] { table_of({}); }, refused("no balls"));
  std::vector<HoleRecord> holed = records;
  holed.erase(holed.begin() + 3);
  EXPECT_THAT([&] { table_of(holed); }, refused("47 of the 48 combinations"));
  std::vector<HoleRecord> doubled = records;
  doubled.push_back(records.front());
  EXPECT_THAT([&] { table_of(doubled); }, refused("same conditions"));
  std::vector<HoleRecord> empty = records;
  empty.front().outflow = 0;
  EXPECT_THAT([&] { table_of(empty); }, refused("not positive"));
  std::vector<HoleRecord> shaken = records;
  shaken.front().amplitude = 3;
  EXPECT_THAT([&] { table_of(shaken); }, refused("amplitudes"));
  std::vector<HoleRecord> wide = records;
  for (HoleRecord& record : wide)
    if (record.at.aspect == 2 && record.at.width == 5) record.at.width = 7;
  EXPECT_THAT([&] { table_of(wide); }, refused("outside those of balls"));
}

TEST(HoleTable, SlopesAreThoseOfTheLaw) {
  const HoleTable table(made_up_records());
  const HoleTable::Slopes slopes = table.slopes({1, 4, 2, 6});
  EXPECT_NEAR(slopes.width, 2.5 * 4 / 3, 0.05);
  EXPECT_NEAR(slopes.peak_speed, -std::log(2 / 1.4), 0.1);
  EXPECT_NEAR(table.slopes({1, 2, 2, 6}).width, 2.5 * 2 / 1, 0.2) << "on the edge, from one side";
}

TEST(HoleTable, SpeedThatGivesAnOutflow) {
  const HoleTable table(made_up_records());
  const double wanted = table.at({1, 4, 2, 6})->outflow;
  EXPECT_NEAR(table.peak_speed_giving(wanted, {1, 4, 0, 6}, 1.4, 2.4), 2, 1e-8);
  EXPECT_EQ(table.peak_speed_giving(table.at({1, 4, 1.4, 6})->outflow, {1, 4, 0, 6}, 1.4, 2.4), 1.4);
}

TEST(HoleTable, FactorOfLongerSeedsVariesFromSettingToSetting) {
  std::vector<HoleRecord> records = made_up_records();
  for (HoleRecord& record : records) record.half_width_95 = 1e-6 * record.outflow;
  const double interpolation = HoleTable(records).factor_spread(3);
  EXPECT_LT(interpolation, 0.06) << "a constant factor of the law, but for what is interpolated between speeds";
  int k = 0;
  for (HoleRecord& record : records)
    if (record.at.aspect > 1) record.outflow *= ++k % 2 == 0 ? 1.2 : 1 / 1.2;
  EXPECT_NEAR(HoleTable(records).factor_spread(3), std::log(1.2) * std::sqrt(6.0 / 5), 0.03);
  for (HoleRecord& record : records) record.half_width_95 = 0.5 * record.outflow;
  EXPECT_EQ(HoleTable(records).factor_spread(3), 0) << "no more than chance makes";
  std::erase_if(records, [](const HoleRecord& record) { return record.at.aspect > 1; });
  EXPECT_EQ(HoleTable(records).factor_spread(3), 0) << "balls alone";
}

}  // namespace
}  // namespace vibrosow
