#include "selection/sequential_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "selection/made_up_systems.hpp"

namespace vibrosow {
namespace {

using Side = SideTest::Side;

TEST(SideTest, LeavesTheTriangleWhereTheFormulaSays) {
  // n0 = 2, error 1/8: eta = ((1/4)^-2 - 1) / 2 = 7.5, h^2 = 15. Values 1, 3: S^2 = 2; tolerance 1: N = 30.
  SideTest test(2, 0.125);
  test.add(1, 1);
  test.add(3, 1);  // sum 4, away (30 - 2) / 2 = 14
  EXPECT_EQ(test.side(), Side::open);
  test.add(9, 1);  // sum 13, away 13.5
  EXPECT_EQ(test.side(), Side::open);
  test.add(0, 1);  // sum 13, away 13
  EXPECT_EQ(test.side(), Side::above);
  for (int i = 0; i < 100; ++i) test.add(-100, 1);
  EXPECT_EQ(test.side(), Side::above);  // the first verdict stands
}

TEST(SideTest, EndsAtTheTipOfTheTriangle) {
  SideTest test(2, 0.125);
  int count = 0;
  for (; test.side() == Side::open && count < 1000; ++count) test.add(count % 2 == 0 ? 1 : -1.02, 1);
  EXPECT_EQ(count, 31);  // h^2 S^2 = 15 * 2.04
  EXPECT_EQ(test.side(), Side::above);
}

TEST(SideTest, IsWrongAsRarelyAsItSays) {
  int wrong = 0;
  constexpr int tries = 2000;
  for (int i = 0; i < tries; ++i) {
    MadeUpChance chance(static_cast<std::uint64_t>(i));
    SideTest test(10, 0.05);
    while (test.side() == Side::open) test.add(0.5 + chance.normal(), 0.5);
    wrong += test.side() == Side::below;
  }
  EXPECT_LE(wrong, 0.05 * tries + 2 * std::sqrt(0.05 * 0.95 * tries));
  EXPECT_GT(wrong, 0.01 * tries);  // nor is it far too careful
}

TEST(SideTest, RefusesWhatCannotBeMeant) {
  EXPECT_THROW(SideTest(1, 0.05), std::invalid_argument);
  EXPECT_THROW(SideTest(10, 0), std::invalid_argument);
  EXPECT_THROW(SideTest(10, 0.5), std::invalid_argument);
}

/// Values by turns one more and one less than a mean: after n of them, an even number, Student's t is the mean times
/// sqrt(n - 1).
bool is_above_after(double error, double mean, int count) {
  LookTest test(error);
  for (int i = 0; i < count; ++i) test.add(mean + (i % 2 == 0 ? 1 : -1));
  return test.is_above();
}

TEST(LookTest, LooksByStudentsTWithHalfOfTheErrorAndThenAQuarter) {
  const double first = student_above(9, 0.04 / 2) / 3, second = student_above(19, 0.04 / 4) / std::sqrt(19);
  EXPECT_FALSE(is_above_after(0.04, first - 1e-4, 10));
  EXPECT_TRUE(is_above_after(0.04, first + 1e-4, 10));
  ASSERT_LT(second, first);
  EXPECT_FALSE(is_above_after(0.04, second + 1e-4, 19));
  EXPECT_FALSE(is_above_after(0.04, second - 1e-4, 20));
  EXPECT_TRUE(is_above_after(0.04, second + 1e-4, 20));
}

BandTest::Verdict verdict_on(double rate, std::uint64_t seed) {
  MadeUpChance chance(seed);
  BandTest test(0.95, 1.05, 10, 0.025, 0.1);
  while (test.verdict() == BandTest::Verdict::open) test.add(rate + 0.02 * chance.normal());
  return test.verdict();
}

TEST(BandTest, KnowsInsideFromOutside) {
  int wrong = 0;
  constexpr int tries = 500;
  for (std::uint64_t i = 0; i < tries; ++i) {
    wrong += verdict_on(1.03, i) != BandTest::Verdict::inside;
    wrong += verdict_on(0.97, i) != BandTest::Verdict::inside;
    wrong += verdict_on(1.05, i) != BandTest::Verdict::outside;
    wrong += verdict_on(0.95, i) != BandTest::Verdict::outside;
  }
  EXPECT_LE(wrong, 4 * 0.025 * tries + 15);
  EXPECT_THROW(BandTest(1, 1, 10, 0.025, 0.025), std::invalid_argument);
}

TEST(BandTest, WhatIsFarOffIsToldByTheFirstLook) {
  MadeUpChance chance(1);
  BandTest test(0.95, 1.05, 10, 0.001, 0.01);
  int count = 0;
  for (; test.verdict() == BandTest::Verdict::open; ++count) test.add(2000 + 100 * chance.normal());
  EXPECT_EQ(count, 10);
  EXPECT_EQ(test.verdict(), BandTest::Verdict::outside);
}

/// Of a band from 0 to 10 the tests' zeros lie at 1 and 9. By 2, 4, 5, 5, .. the lower one's sum is 4, 8, 12, 16; with
/// an error of 1/8 it leaves its triangle, as in the test of SideTest, at (30 - r) / 2: with the fifth.
TEST(BandTest, HasTheLesserOfTheErrorInsideAndAQuarterOfThatOutside) {
  const auto observations = [](double error_inside, double error_outside, bool mirrored) {
    BandTest test(0, 10, 2, error_inside, error_outside);
    int count = 0;
    for (const double value : {2, 4, 5, 5, 5, 5, 5, 5, 5, 5, 5}) {
      if (test.verdict() != BandTest::Verdict::open) break;
      test.add(mirrored ? 10 - value : value);
      ++count;
    }
    EXPECT_EQ(test.verdict(), BandTest::Verdict::inside);
    return count;
  };
  for (const bool mirrored : {false, true}) {
    EXPECT_EQ(observations(0.125, 0.9, mirrored), 5);
    EXPECT_EQ(observations(0.4, 0.5, mirrored), 5);
  }
}

TEST(BandTest, LooksForWhatIsFarOffWithAQuarterOfItsErrorOnEachSide) {
  const auto verdict = [](double mean) {
    BandTest test(0, 1e-3, 2, 0.01, 0.1);  // so narrow that its triangle is endless
    for (int i = 0; i < 10; ++i) test.add(mean + (i % 2 == 0 ? 1 : -1));
    return test.verdict();
  };
  const double far = student_above(9, 0.1 / 4 / 2) / 3;
  EXPECT_EQ(verdict(-far + 1e-4), BandTest::Verdict::open);
  EXPECT_EQ(verdict(-far - 1e-4), BandTest::Verdict::outside);
  EXPECT_EQ(verdict(1e-3 + far - 1e-4), BandTest::Verdict::open);
  EXPECT_EQ(verdict(1e-3 + far + 1e-4), BandTest::Verdict::outside);
}

TEST(ShareTest, CountsCleanTrials) {
  ShareTest test(0.05, 0.01, 0.01);
  int clean = 0;
  for (; test.verdict() == ShareTest::Verdict::open; ++clean) test.add(false);
  EXPECT_EQ(clean, 100);  // log 100 / log(0.995 / 0.95) = 99.5
  EXPECT_EQ(test.verdict(), ShareTest::Verdict::less);
}

TEST(ShareTest, CountsEvents) {
  const auto events = [](double error_much) {
    ShareTest test(0.05, 0.01, error_much);
    int count = 0;
    for (; test.verdict() == ShareTest::Verdict::open; ++count) test.add(true);
    EXPECT_EQ(test.verdict(), ShareTest::Verdict::much);
    return count;
  };
  EXPECT_EQ(events(0.011), 2);  // each makes it ten times as likely
  EXPECT_EQ(events(0.009), 3);
}

TEST(ShareTest, IsWrongAsRarelyAsItSays) {
  int taken = 0, left_out = 0;
  constexpr int tries = 1000;
  for (std::uint64_t i = 0; i < tries; ++i) {
    for (const double share : {0.1, 0.01}) {
      MadeUpChance chance(i);
      ShareTest test(0.1, 0.02, 0.05);
      while (test.verdict() == ShareTest::Verdict::open) test.add(chance.uniform() < share);
      taken += share == 0.1 && test.verdict() == ShareTest::Verdict::less;
      left_out += share == 0.01 && test.verdict() == ShareTest::Verdict::much;
    }
  }
  EXPECT_LE(taken, 0.02 * tries + 10);
  EXPECT_LE(left_out, 0.05 * tries + 15);
  EXPECT_THROW(ShareTest(1, 0.01, 0.01), std::invalid_argument);
}

TEST(IsSurelyAbove, HoldsHoweverLongItIsLookedAt) {
  int wrong = 0, found = 0;
  constexpr int tries = 1000;
  for (std::uint64_t i = 0; i < tries; ++i) {
    MadeUpChance chance(i);
    std::vector<double> one, equal, less;
    for (int r = 0; r < 200; ++r) {
      one.push_back(chance.normal());
      equal.push_back(r % 7 == 0 ? std::numeric_limits<double>::quiet_NaN() : chance.normal());
      less.push_back(chance.normal() - 1);
    }
    wrong += is_surely_above(one, equal, 0.05);
    found += is_surely_above(one, less, 0.05);
  }
  EXPECT_LE(wrong, 0.05 * tries + 14);
  EXPECT_EQ(found, tries);
}

}  // namespace
}  // namespace vibrosow
