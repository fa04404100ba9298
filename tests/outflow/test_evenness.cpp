#include "outflow/evenness.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_f.hpp>
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

/// The squared CV of a bound is the noncentrality over the mean count and the degrees of freedom of the holes.
double noncentrality(double cv, double mean, double holes) {
  return cv * cv * mean * (holes - 1);
}

TEST(Evenness, OfOneRunEndsWhereChiSquaredLeavesTwoAndAHalfPercent) {
  namespace bm = boost::math;
  const auto uneven = evenness({{800, 1000, 1200}});  // X = 2 * 200^2 / 1000
  EXPECT_NEAR(cdf(bm::non_central_chi_squared(2, noncentrality(uneven->low, 1000, 3)), 80), 0.975, 1e-6);
  EXPECT_NEAR(cdf(bm::non_central_chi_squared(2, noncentrality(uneven->high, 1000, 3)), 80), 0.025, 1e-6);
}

/// Three runs of four holes, of which one gave nothing: (3 - 1) (3 - 1) degrees of freedom of their scatter about the
/// common split, 90 of 300 seeds a run here, 120 there and 90.
TEST(Evenness, OfReplicatesEndsWhereFLeavesTwoAndAHalfPercent) {
  namespace bm = boost::math;
  const auto found = evenness({{60, 150, 90, 0}, {120, 90, 90, 0}, {90, 120, 90, 0}});
  constexpr double mean = 900.0 / 4;
  constexpr double x = (45.0 * 45 + 135.0 * 135 + 45.0 * 45 + 225.0 * 225) / mean;
  constexpr double scatter = 2 * (30.0 * 30 / 90) + 2 * (30.0 * 30 / 120), phi = scatter / 4;
  const auto below = [&](double cv) {
    return cdf(bm::non_central_f(3, 4, noncentrality(cv, mean, 4) / phi), x / phi / 3);
  };
  ASSERT_GT(found->low, 0);
  EXPECT_NEAR(below(found->low), 0.975, 1e-6);
  EXPECT_NEAR(below(found->high), 0.025, 1e-6);
  EXPECT_NEAR(found->cv.value(), std::sqrt((x - 3 * phi) / (mean * 3)), 1e-12);
}

/// Where even holes would give it as often as not, it is not resolved: below the quantile of F, or of chi squared.
TEST(Evenness, IsResolvedBeyondTheQuantileOfEvenHoles) {
  // Two holes: X = (difference)^2 / sum, beyond 5.024 of chi squared.
  EXPECT_FALSE(evenness({{1000 + 50, 1000 - 50}})->cv);  // X = 5
  EXPECT_TRUE(evenness({{1000 + 51, 1000 - 51}})->cv);   // 5.2
  // Two replicates, each 18 seeds from the common split: F of one and one degrees of freedom, whose quantile is
  // 647.789.
  constexpr std::int64_t off = 18;
  const auto scattered = [](std::int64_t more) {
    return evenness({{1000 + more + off, 1000 - more - off}, {1000 + more - off, 1000 - more + off}});
  };
  const auto f = [](double more) {
    const double x = 2 * (2 * more) * (2 * more) / 2000;
    const double phi = 2.0 * off * off * (1 / (1000 + more) + 1 / (1000 - more));
    return x / phi;
  };
  std::int64_t more = 1;
  while (more < 700 && f(static_cast<double>(more)) <= 647.789) ++more;
  ASSERT_LT(more, 700);
  EXPECT_FALSE(scattered(more - 1)->cv);
  EXPECT_TRUE(scattered(more)->cv);
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
