#include "outflow/evenness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vibrosow {
namespace {

using Counts = std::vector<std::vector<std::int64_t>>;

TEST(Evenness, TakesWhatCountingAloneGivesFromTheRawCv) {
  // Counts 800, 1000, 1200: raw CV 0.2, counting 1 / sqrt(1000).
  const auto uneven = evenness({{800, 1000, 1200}});
  ASSERT_TRUE(uneven);
  EXPECT_NEAR(uneven->raw_cv, 0.2, 1e-12);
  EXPECT_NEAR(uneven->counting_cv, std::sqrt(1e-3), 1e-12);
  ASSERT_TRUE(uneven->cv);
  EXPECT_NEAR(*uneven->cv, std::sqrt(0.04 - 1e-3), 1e-12);
  EXPECT_LT(uneven->low, *uneven->cv);
  EXPECT_GT(uneven->high, *uneven->cv);
  EXPECT_GT(uneven->low, 0.13);
  EXPECT_LT(uneven->high, 0.25);
}

TEST(Evenness, BelowWhatTheSeedsResolveIsNotNoughtButABound) {
  const auto even = evenness({{200, 200, 201}});
  ASSERT_TRUE(even);
  EXPECT_FALSE(even->cv);
  EXPECT_EQ(even->low, 0);
  EXPECT_GT(evenness({{98, 104, 97}})->high, 0.05);
  // A hundred times the seeds bound it ten times as well.
  EXPECT_NEAR(evenness({{20000, 21000, 19000}})->counting_cv, evenness({{200, 210, 190}})->counting_cv / 10, 1e-12);
  EXPECT_FALSE(evenness({{200, 210, 190}})->cv);
  EXPECT_TRUE(evenness({{20000, 21000, 19000}})->cv);
}

TEST(Evenness, SeedsMoreRegularThanByChanceBoundItByTheirRawCv) {
  const auto even = evenness({{33, 33, 31, 34, 35, 35}});  // far more alike than independent seeds would be
  EXPECT_FALSE(even->cv);
  EXPECT_DOUBLE_EQ(even->high, even->raw_cv);
}

TEST(Evenness, ReplicatesAreSummedHoleByHole) {
  const auto one = evenness({{300, 200, 250}}), three = evenness({{100, 67, 83}, {101, 66, 84}, {99, 67, 83}});
  EXPECT_DOUBLE_EQ(one->raw_cv, three->raw_cv);
  EXPECT_DOUBLE_EQ(one->high, three->high);  // they scatter less than by chance: counting is what remains
}

TEST(Evenness, NeedsTwoHolesAndASeed) {
  EXPECT_FALSE(evenness({{200}}));
  EXPECT_FALSE(evenness({{0, 0, 0}}));
  EXPECT_FALSE(evenness({}));
  EXPECT_TRUE(evenness({{5, 0}, {0, 0}}));
}

/// Fraction of 400 made-up studies of holes of these relative rates whose interval holds the true CV. `burst`: seeds
/// come in clumps of so many, which makes counts scatter more than by chance.
double coverage(const std::vector<double>& rates, int replicates, int burst, unsigned random_seed) {
  double mean = 0, squares = 0;
  for (const double rate : rates) mean += rate / static_cast<double>(rates.size());
  for (const double rate : rates) squares += (rate - mean) * (rate - mean);
  const double truth = std::sqrt(squares / static_cast<double>(rates.size() - 1)) / mean;
  std::mt19937 generator(random_seed);
  int held = 0;
  for (int study = 0; study < 400; ++study) {
    Counts counts(static_cast<std::size_t>(replicates));
    for (auto& run : counts)
      for (const double rate : rates)
        run.push_back(burst * std::poisson_distribution<std::int64_t>(rate / burst)(generator));
    const auto result = evenness(counts);
    held += result && result->low <= truth && truth <= result->high;
  }
  return held / 400.0;
}

TEST(Evenness, IntervalsHoldTheTruthAsOftenAsTheySay) {
  // Nothing here is assumed large: 20 seeds a hole, one run. Three standard errors of 400 studies are 3.3 %.
  const double least = 0.95 - 3 * std::sqrt(0.95 * 0.05 / 400);
  for (const auto& rates : std::vector<std::vector<double>>{{20, 20, 20}, {12, 20, 28, 20, 20}, {150, 200, 250, 180}}) {
    EXPECT_GE(coverage(rates, 1, 1, 1), least) << rates.size();
    EXPECT_GE(coverage(rates, 5, 1, 2), least) << rates.size();
  }
  // In clumps of four, which one run cannot tell and replicates do.
  EXPECT_GE(coverage({150, 200, 250, 180}, 5, 4, 3), least);
  EXPECT_LT(coverage({150, 200, 250, 180}, 1, 4, 4), 0.9);
  // And they are not merely wide: three times the counting CV is told from even holes nearly always.
  std::mt19937 generator(5);
  int resolved = 0;
  for (int study = 0; study < 100; ++study) {
    std::vector<std::int64_t> run;
    for (const double rate : {140.0, 200.0, 260.0, 170.0, 230.0})
      run.push_back(std::poisson_distribution<std::int64_t>(rate)(generator));
    resolved += evenness({run})->cv.has_value();
  }
  EXPECT_GE(resolved, 95);
}

}  // namespace
}  // namespace vibrosow
