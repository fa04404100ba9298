#include "outflow/unevenness.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <random>

namespace vibrosow {
namespace {

using Counts = std::vector<std::vector<std::int64_t>>;

/// Three parts of two holes whose difference scatters by `off` about `2 * more`.
Counts two_holes(std::int64_t more, std::int64_t off) {
  return {{1000 + more + off, 1000 - more - off}, {1000 + more, 1000 - more}, {1000 + more - off, 1000 - more + off}};
}

TEST(Unevenness, IsTheHolesVarianceWithoutTheInteractions) {
  // Between: 3 parts * 2 * 100^2; the interaction: 4 * 10^2 on two degrees of freedom.
  const auto found = unevenness(two_holes(100, 10));
  ASSERT_TRUE(found && found->cv);
  EXPECT_NEAR(found->chance_cv, std::sqrt(200.0 / 3) / 1000, 1e-12);
  EXPECT_NEAR(*found->cv, std::sqrt((60000.0 - 200) / 3) / 1000, 1e-12);
}

TEST(Unevenness, SwingsThatHolesShareFallOut) {
  Counts swung = two_holes(100, 10);
  for (std::int64_t& count : swung[0]) count += 300;
  for (std::int64_t& count : swung[2]) count -= 300;
  const auto steady = unevenness(two_holes(100, 10)), found = unevenness(swung);
  EXPECT_NEAR(*found->cv, *steady->cv, 1e-12);
  EXPECT_NEAR(found->low, steady->low, 1e-12);
  EXPECT_NEAR(found->high, steady->high, 1e-12);
}

TEST(Unevenness, IsToldByTheFTest) {
  // F of one and two degrees of freedom is 6 more^2 / (2 off^2); its quantile of 0.95 is 18.51.
  const double quantile = boost::math::quantile(boost::math::fisher_f(1, 2), 0.95);
  const std::int64_t off = 30, least = static_cast<std::int64_t>(std::ceil(off * std::sqrt(quantile / 3)));
  EXPECT_FALSE(unevenness(two_holes(least - 1, off))->cv);
  EXPECT_TRUE(unevenness(two_holes(least, off))->cv);
}

/// The mean over what the chance may be, by steps of its chi squared and not of its probability.
double below(double between, double within, double cv, double mean, double parts, double holes) {
  namespace bm = boost::math;
  const double degrees = (parts - 1) * (holes - 1);
  const bm::chi_squared chance(degrees);
  constexpr int steps = 20000;
  const double end = quantile(complement(chance, 1e-9)), step = end / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double u = (k + 0.5) * step;
    const double lambda = parts * (holes - 1) * cv * cv * mean * mean * u / within;
    sum += pdf(chance, u) * step * cdf(bm::non_central_chi_squared(holes - 1, lambda), between * u / within);
  }
  return sum;
}

/// Five parts of three holes.
const Counts five_parts = {{60, 80, 100}, {64, 79, 97}, {58, 84, 103}, {61, 77, 99}, {63, 83, 95}};

TEST(Unevenness, EndsWhereTheMeanProbabilityIsAFortieth) {
  double between = 0, within = 0, mean = 0;
  for (const auto& part : five_parts)
    for (const std::int64_t count : part) mean += static_cast<double>(count) / 15;
  for (std::size_t hole = 0; hole < 3; ++hole) {
    double of_hole = 0;
    for (const auto& part : five_parts) of_hole += static_cast<double>(part[hole]) / 5;
    between += 5 * (of_hole - mean) * (of_hole - mean);
    for (const auto& part : five_parts) {
      const double of_part = static_cast<double>(part[0] + part[1] + part[2]) / 3;
      const double left = static_cast<double>(part[hole]) - of_hole - of_part + mean;
      within += left * left;
    }
  }
  const auto found = unevenness(five_parts);
  ASSERT_TRUE(found && found->low > 0);
  EXPECT_NEAR(below(between, within, found->low, mean, 5, 3), 0.975, 2e-4);
  EXPECT_NEAR(below(between, within, found->high, mean, 5, 3), 0.025, 2e-4);
}

TEST(Unevenness, OfHolesMoreAlikeThanChanceIsBoundAsThoughTheyWereAsUnlikeAsThat) {
  // F = 1 where more = off / sqrt(3).
  const auto alike = unevenness(two_holes(0, 52)), as_unlike = unevenness(two_holes(30, 52));
  EXPECT_FALSE(alike->cv);
  EXPECT_EQ(alike->low, 0);
  EXPECT_NEAR(alike->high / as_unlike->high, 1, 2e-3);
  EXPECT_GT(alike->high, alike->chance_cv);
}

TEST(Unevenness, OfAClockworkFlowHasTheScatterOfWholeCounts) {
  const auto found = unevenness({{100, 104}, {100, 104}, {100, 104}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->chance_cv, std::sqrt(1.0 / 6 / 3) / 102, 1e-12);
  EXPECT_TRUE(found->cv);
}

TEST(Unevenness, NeedsTwoPartsTwoHolesAndASeed) {
  EXPECT_FALSE(unevenness({{200}, {210}}));
  EXPECT_FALSE(unevenness({{200, 210}}));
  EXPECT_FALSE(unevenness({{0, 0, 0}, {0, 0, 0}}));
  EXPECT_FALSE(unevenness({}));
  EXPECT_TRUE(unevenness({{5, 0}, {0, 0}}));
}

TEST(RawCv, IsOfTheCountsAsTheyAre) {
  EXPECT_NEAR(raw_cv({800, 1000, 1200}).value(), 0.2, 1e-12);
  EXPECT_FALSE(raw_cv({800}));
  EXPECT_FALSE(raw_cv({0, 0}));
  EXPECT_EQ(sum_of_parts({{1, 2}, {3, 4}}), (std::vector<std::int64_t>{4, 6}));
  EXPECT_EQ(transposed({{1, 2}, {3, 4}, {5, 6}}), (Counts{{1, 3, 5}, {2, 4, 6}}));
}

/// Made-up studies of three holes that let out 200 seeds a replicate, whose counts scatter by `dispersion` times as
/// much as independent seeds' would (variance over mean). One replicate is told by five blocks.
struct Studies {
  double cv;
  int replicates;
  double dispersion;

  Counts counts(std::mt19937_64& generator) const {
    const double of_part = replicates == 1 ? 40 : 200;
    std::normal_distribution<double> normal;
    Counts counts(replicates == 1 ? 5 : static_cast<std::size_t>(replicates));
    for (auto& part : counts)
      for (const double off : {-1.0, 0.0, 1.0}) {
        const double mean = of_part * (1 + off * cv);
        const double drawn = mean + std::sqrt(dispersion * of_part) * normal(generator);
        part.push_back(std::max<std::int64_t>(0, std::llround(drawn)));
      }
    return counts;
  }
};

struct Shares {
  double held = 0, told = 0;
};

Shares shares(const Studies& studies, int draws, unsigned random_seed) {
  std::mt19937_64 generator(random_seed);
  Shares shares;
  for (int k = 0; k < draws; ++k) {
    const auto found = unevenness(studies.counts(generator));
    shares.held += found->low <= studies.cv && studies.cv <= found->high ? 1.0 / draws : 0;
    shares.told += found->cv ? 1.0 / draws : 0;
  }
  return shares;
}

/// reports/unevenness has 2000 draws of many more.
TEST(Unevenness, IntervalsHoldTheTruthAsOftenAsTheySayAndNoOftener) {
  constexpr int draws = 300;
  const double error = 3 * std::sqrt(0.95 * 0.05 / draws);
  for (const Studies& studies :
       {Studies{0.05, 1, 0.3}, Studies{0.05, 2, 0.3}, Studies{0.15, 3, 1}, Studies{0.05, 8, 0.1}}) {
    const double held = shares(studies, draws, 1).held;
    EXPECT_GE(held, 0.95 - error) << studies.replicates;
    EXPECT_LE(held, 0.98 + 0.5 * error) << studies.replicates;
  }
}

TEST(Unevenness, OfRegularSeedsIsTold) {
  EXPECT_GE(shares({0.06, 8, 0.1}, 200, 2).told, 0.97) << "as often as independent seeds would be: 24 % of studies";
  const double of_equal_holes = shares({0, 3, 0.3}, 1000, 3).told;
  EXPECT_NEAR(of_equal_holes, 0.05, 3 * std::sqrt(0.05 * 0.95 / 1000));
}

}  // namespace
}  // namespace vibrosow
