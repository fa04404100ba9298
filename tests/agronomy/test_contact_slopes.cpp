#include "agronomy/contact_slopes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "agronomy/sowing_plan.hpp"
#include "support/made_up_hole_table.hpp"

namespace vibrosow {
namespace {

/// Two settings of a shape, each with every combination of two values of each part of a contact.
std::vector<HoleRecord> records_of(double aspect, double by_friction, double by_rolling, double scatter = 0) {
  std::vector<HoleRecord> records;
  int number = 0;
  for (const double width : {3.0, 5.0})
    for (const double friction : {0.2, 0.6})
      for (const double on_the_tray : {0.3, 0.6})
        for (const double rolling : {0.0, 0.2})
          for (const double restitution : {0.3, 0.7}) {
            HoleRecord record = made_up_record({aspect, width, 1.4, 6});
            record.contact = {friction, on_the_tray, rolling, restitution};
            const double sign = ++number % 3 == 0 ? 1 : -0.5;
            record.outflow *= std::exp(by_friction * std::log(friction) + by_rolling * rolling + scatter * sign);
            records.push_back(record);
          }
  return records;
}

const SeedContact usual{0.4, 0.4, 0.05, 0.5};

TEST(ContactSlopes, AreThoseOfTheRuns) {
  const ContactSlopes slopes(records_of(1, -0.2, -0.7));
  EXPECT_NEAR(slopes.between(1, usual, {0.2, 0.4, 0.05, 0.5}).log, 0.2 * std::log(2), 1e-12);
  EXPECT_NEAR(slopes.between(1, usual, {0.4, 0.4, 0.15, 0.5}).log, -0.07, 1e-12);
  EXPECT_NEAR(slopes.between(1, usual, {0.4, 0.6, 0.05, 0.3}).log, 0, 1e-12) << "these do nothing";
  EXPECT_NEAR(slopes.between(1, usual, {0.2, 0.5, 0.15, 0.6}).deviation, 0, 1e-9) << "nothing scatters";
  EXPECT_EQ(slopes.between(1, usual, usual).deviation, 0);
}

TEST(ContactSlopes, AreBetweenThoseOfTwoShapes) {
  std::vector<HoleRecord> records = records_of(1, -0.2, -0.7);
  for (const HoleRecord& record : records_of(3, -0.4, -0.1)) records.push_back(record);
  const ContactSlopes slopes(records);
  const SeedContact other{0.2, 0.4, 0.15, 0.5};
  const double balls = 0.2 * std::log(2) - 0.07, grains = 0.4 * std::log(2) - 0.01;
  EXPECT_NEAR(slopes.between(1, usual, other).log, balls, 1e-12);
  EXPECT_NEAR(slopes.between(1.5, usual, other).log, 0.75 * balls + 0.25 * grains, 1e-12);
  EXPECT_NEAR(slopes.between(3, usual, other).log, grains, 1e-12);
  EXPECT_NEAR(slopes.between(4, usual, other).log, grains, 1e-12) << "beyond the last shape";
}

TEST(ContactSlopes, BeyondTheRunsAreThoseOfTheNearest) {
  const ContactSlopes slopes(records_of(1, -0.2, -0.7));
  const SeedContact beyond{0.1, 0.4, 0.3, 0.5};
  EXPECT_TRUE(slopes.holds(usual));
  EXPECT_FALSE(slopes.holds(beyond));
  EXPECT_NEAR(slopes.between(1, usual, beyond).log, slopes.between(1, usual, {0.2, 0.4, 0.2, 0.5}).log, 1e-12);
}

/// In a design of two levels a slope's variance is the residuals' over the count and a level's half distance squared.
TEST(ContactSlopes, ErrByTheScatterOfTheRuns) {
  const std::vector<HoleRecord> records = records_of(1, 0, 0, 0.1);
  const ContactSlopes slopes(records);
  const auto count = static_cast<double>(records.size());
  const SeedContact from{0.2, 0.4, 0, 0.5}, to{0.6, 0.4, 0, 0.5};
  double sum = 0, by_friction = 0;
  for (const HoleRecord& record : records)
    by_friction += (record.contact.friction > 0.4 ? 1 : -1) * std::log(record.outflow) / count;
  const ContactFactor factor = slopes.between(1, from, to);
  EXPECT_NEAR(factor.log, 2 * by_friction, 1e-12);
  // What is left by the two levels and the four slopes, which in such a design are independent of each other.
  for (const double width : {3.0, 5.0}) {
    double mean = 0;
    for (const HoleRecord& record : records)
      if (record.at.width == width) mean += std::log(record.outflow) / (count / 2);
    for (const HoleRecord& record : records)
      if (record.at.width == width) sum += std::pow(std::log(record.outflow) - mean, 2);
  }
  const auto part = [&](auto is_more) {
    double effect = 0;
    for (const HoleRecord& record : records)
      effect += (is_more(record.contact) ? 1 : -1) * std::log(record.outflow) / count;
    return count * effect * effect;
  };
  sum -= part([](const SeedContact& one) { return one.friction > 0.4; });
  sum -= part([](const SeedContact& one) { return one.wall_friction > 0.4; });
  sum -= part([](const SeedContact& one) { return one.rolling_friction > 0.1; });
  sum -= part([](const SeedContact& one) { return one.restitution > 0.5; });
  EXPECT_NEAR(factor.deviation, 2 * std::sqrt(sum / (count - 6) / count), 1e-12);
}

TEST(ContactSlopes, ErrByWhatIsNotKnownOfTheContact) {
  const ContactSlopes slopes(records_of(1, -0.2, -0.7));
  EXPECT_NEAR(slopes.between(1, usual, usual, {0.5, 0.1}).deviation, std::hypot(0.2 * 0.5, 0.7 * 0.1), 1e-9);
}

/// A friction that is not known is the same for both shapes, so its parts add up.
TEST(ContactSlopes, BetweenShapesErrByOneContact) {
  std::vector<HoleRecord> records = records_of(1, -0.2, 0);
  for (const HoleRecord& record : records_of(3, -0.4, 0)) records.push_back(record);
  EXPECT_NEAR(ContactSlopes(records).between(2, usual, usual, {0.5, 0}).deviation, 0.3 * 0.5, 1e-9);
}

TEST(ContactSlopes, AreNotTakenFromTooFewRuns) {
  EXPECT_THROW(ContactSlopes({}), std::invalid_argument);
  std::vector<HoleRecord> records = records_of(1, -0.2, -0.7);
  for (HoleRecord& record : records) record.contact.friction = 0.4;
  EXPECT_THROW(ContactSlopes{records}, std::invalid_argument);
}

TEST(HoleTableTimes, HasSoManyTimesTheOutflowAndItsError) {
  const HoleTable table(made_up_records());
  const HoleTable more = table.times({std::log(1.2), 0.1});
  const HoleConditions at{1.5, 3.2, 1.7, 4};
  EXPECT_NEAR(more.at(at)->outflow, 1.2 * table.at(at)->outflow, 1e-12);
  EXPECT_NEAR(more.at(at)->chance, table.at(at)->chance, 1e-12);
  const PredictionError error = table_error(table, at, 4e-3, {}), of_more = table_error(more, at, 4e-3, {});
  EXPECT_NEAR(of_more.numerics, std::hypot(error.numerics, 0.1), 1e-12);
  EXPECT_NEAR(of_more.tolerance, error.tolerance, 1e-9);
}

}  // namespace
}  // namespace vibrosow
