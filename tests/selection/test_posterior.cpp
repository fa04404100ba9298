#include "selection/posterior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "selection/kim_nelson.hpp"
#include "selection/made_up_systems.hpp"

namespace vibrosow::posterior_test {
namespace {

Question question_of(std::size_t systems) {
  Question question;
  question.systems = systems;
  question.margin = 0.05;
  return question;
}

std::vector<MadeUpSystem> random_means(std::size_t systems, std::uint64_t seed) {
  MadeUpChance chance(seed + 5000);
  std::vector<MadeUpSystem> made;
  for (std::size_t i = 0; i < systems; ++i) made.push_back({1.5 + 0.2 * chance.normal()});
  return made;
}

TEST(KnownMean, ItsVarianceIsTheOwnAndTheOthersByTheirDegreesOfFreedom) {
  Moments three;
  for (const double value : {1.0, 2.0, 6.0}) three.add(value);  // mean 3, variance 7
  const KnownMean known = known_mean(three, {6, 3});
  EXPECT_DOUBLE_EQ(known.mean, 3);
  EXPECT_DOUBLE_EQ(known.degrees_of_freedom, 8);
  EXPECT_DOUBLE_EQ(known.variance, (2 * 7.0 + 6 * 3.0) / 8);
  EXPECT_DOUBLE_EQ(known.error_squared(), 4.0 / 3);
  const KnownMean alone = known_mean(three, {});
  EXPECT_DOUBLE_EQ(alone.degrees_of_freedom, 2);
  EXPECT_DOUBLE_EQ(alone.variance, 7);
}

TEST(VariancePrior, FindsWhatVariancesWereDrawnFrom) {
  MadeUpChance chance(1);
  const auto of_normal = [&](double deviation, int count) {
    Moments moments;
    for (int i = 0; i < count; ++i) moments.add(deviation * chance.normal());
    return moments.variance();
  };
  std::vector<double> equal, unequal;
  for (int i = 0; i < 3000; ++i) {
    equal.push_back(of_normal(3, 5));
    // Scaled inverse chi squared with 8 degrees of freedom about 4: 4 over the mean square of 8 numbers.
    double squares = 0;
    for (int k = 0; k < 8; ++k) squares += std::pow(chance.normal(), 2);
    unequal.push_back(of_normal(std::sqrt(4 * 8 / squares), 5));
  }
  EXPECT_GT(variance_prior(equal, 4).degrees_of_freedom, 100);
  EXPECT_NEAR(variance_prior(equal, 4).variance, 9, 0.5);
  EXPECT_NEAR(variance_prior(unequal, 4).degrees_of_freedom, 8, 1.5);
  EXPECT_NEAR(variance_prior(unequal, 4).variance, 4, 0.3);
  EXPECT_EQ(variance_prior({1, 2, 0, 0}, 4).degrees_of_freedom, 0);
}

TEST(VariancePrior, OfEqualVariancesIsTheirOwnWithoutTheBiasOfLogarithms) {
  // The logarithm of chi squared of two degrees of freedom over two lies Euler's constant below 0 in the mean.
  const VariancePrior equal = variance_prior({3, 3, 3, 3}, 2);
  EXPECT_TRUE(std::isinf(equal.degrees_of_freedom));
  EXPECT_NEAR(equal.variance, 3 * std::exp(0.5772156649), 1e-8);
  EXPECT_DOUBLE_EQ(known_mean({}, equal).count, 0);
}

/// Logarithms that scatter by pi^2 / 6 (trigamma of 1, the chance of two degrees of freedom) and pi^2 / 6 again are
/// those of a prior of two degrees of freedom.
TEST(VariancePrior, ItsDegreesOfFreedomAreWhatChanceLeavesOfTheScatter) {
  const double off = std::sqrt(2 * std::pow(std::numbers::pi, 2) / 6);  // sample variance of -off, 0, off: off^2
  const VariancePrior prior = variance_prior({std::exp(-off), 1, std::exp(off)}, 2);
  EXPECT_NEAR(prior.degrees_of_freedom, 2, 1e-6);
  EXPECT_NEAR(prior.variance, 1, 1e-6);
}

TEST(DegreesOfDifference, AreWelchs) {
  const KnownMean one{0, 4, 5, 2}, other{0, 3, 12, 1};  // errors squared 2 and 3
  EXPECT_DOUBLE_EQ(degrees_of_difference(one, other), 25 / (4.0 / 5 + 9.0 / 12));
}

TEST(ProbabilityBelow, IsStudents) {
  EXPECT_NEAR(probability_below(2.228139, 10), 0.975, 1e-6);
  EXPECT_NEAR(probability_below(12.7062, 1), 0.975, 1e-6);
  EXPECT_NEAR(probability_below(1.959964, std::numeric_limits<double>::infinity()), 0.975, 1e-6);
}

/// Six observations of each system, whose variances alone are known; decided by them.
Decision decision_of_six(const Question& question, const std::vector<double>& goals, const std::vector<double>& rates) {
  Posterior procedure(question);
  for (std::size_t i = 0; i < goals.size(); ++i)
    for (std::size_t r = 0; r < 6; ++r)
      procedure.take(i, {RunEnd::flowed, six_about(goals[i], 1)[r], six_about(rates[i], 2)[r]});
  return procedure.decision();
}

/// Student's t of ten degrees of freedom, by the difference and the margin over its standard error.
TEST(Posterior, IsSureAtItsConfidenceWithinTheMargin) {
  Question question = question_of(2);
  question.margin = 0.01;  // of 100: the standard error of a mean
  const double t = std::sqrt(2.0) * student_above(10, 0.05) - 1;
  EXPECT_FALSE(decision_of_six(question, {100, 100 + t - 1e-3}, {1, 1}).is_sure);
  EXPECT_TRUE(decision_of_six(question, {100, 100 + t + 1e-3}, {1, 1}).is_sure);
}

TEST(Posterior, CallsWorseWithItsShareOfTheError) {
  for (const std::size_t systems : {2U, 3U, 6U}) {
    const double t = std::sqrt(2.0) * student_above(10, 0.05 / static_cast<double>(systems - 1));
    const auto standing = [&](double behind) {
      std::vector<double> goals(systems, 1000);
      goals[0] = 100, goals[1] = 100 + behind;
      return decision_of_six(question_of(systems), goals, std::vector<double>(systems, 1)).standings[1];
    };
    EXPECT_NE(standing(t - 1e-3), Standing::worse) << systems;
    EXPECT_EQ(standing(t + 1e-3), Standing::worse) << systems;
  }
}

/// No candidate where it is in the band by less than a tenth.
TEST(Posterior, MissesTheRateByStudentsT) {
  Question question = question_of(2);
  question.band = Band{900, 1000};
  const double t = student_above(5, 0.1);
  for (const double side : {-1.0, 1.0}) {
    const auto standing = [&](double outside) {
      return decision_of_six(question, {1, 1}, {950, 950 + side * (50 + 2 * outside)}).standings[1];
    };
    EXPECT_NE(standing(t - 1e-3), Standing::misses_the_rate) << side;
    EXPECT_EQ(standing(t + 1e-3), Standing::misses_the_rate) << side;
  }
}

/// That a share is below 1 / 2, after runs in which it never happened.
TEST(Posterior, KnowsOfCloggingByJeffreysBeta) {
  Question question = question_of(2);
  question.clogging_limit = 0.5;
  const auto least = [&](double confidence) {
    question.confidence = confidence;
    return Posterior(question).least_observations();
  };
  // After n clean runs: 1/2 + (1 + 1/3 + 2/15 + 2/35 + ..) / pi, of n terms.
  const double after_3 = 0.5 + (1 + 1 / 3.0 + 2 / 15.0) / std::numbers::pi;
  const double after_4 = after_3 + 2 / 35.0 / std::numbers::pi;
  EXPECT_EQ(least(after_3 - 1e-6), 3);
  EXPECT_EQ(least(after_3 + 1e-6), 4);
  EXPECT_EQ(least(after_4 - 1e-6), 4);
  EXPECT_EQ(least(after_4 + 1e-6), 5);
}

TEST(Posterior, IsRightAmongRandomMeansByFewRuns) {
  int right = 0;
  double runs = 0, of_guaranteed = 0;
  constexpr int tries = 100;
  constexpr std::size_t systems = 20;
  for (std::uint64_t i = 0; i < tries; ++i) {
    const std::vector<MadeUpSystem> made = random_means(systems, i);
    double least = 100;
    for (const MadeUpSystem& one : made) least = std::min(least, one.mean);
    MadeUpSystems observe(made, i);
    Posterior procedure(question_of(systems));
    runs += sum(lead(procedure, systems, std::ref(observe)));
    const Decision decision = procedure.decision();
    right += decision.is_sure && made[decision.best.value()].mean <= 1.05 * least;
    KimNelson other(question_of(systems));
    of_guaranteed += sum(lead(other, systems, std::ref(observe)));
  }
  EXPECT_GE(right, 0.95 * tries - 4);
  EXPECT_LT(runs, of_guaranteed / 2);
}

TEST(Posterior, ConstraintsAreMetByWhatIsTaken) {
  int right = 0;
  constexpr int tries = 50;
  for (std::uint64_t i = 0; i < tries; ++i) {
    Question question = question_of(6);
    question.band = Band{0.95, 1.05};
    question.clogging_limit = 0.05;
    MadeUpSystems systems({{1.0, 0.1, 0.4}, {1.0, 0.1, 0, 1.2}, {1.2}, {1.2, 0.1, 0.4}, {1.5}, {1.0, 0.1, 0, 0.8}}, i);
    Posterior procedure(question);
    lead(procedure, 6, std::ref(systems));
    const Decision decision = procedure.decision();
    right += decision.is_sure && decision.best == 2u;
    EXPECT_EQ(decision.standings[1], Standing::misses_the_rate);
    EXPECT_NE(decision.standings[0], Standing::best);
  }
  EXPECT_GE(right, 0.95 * tries - 3);
}

TEST(Posterior, SaysThatNoneMeetsTheConstraints) {
  Question question = question_of(3);
  question.clogging_limit = 0.05;
  MadeUpSystems systems({{1.0, 0.1, 0.8}, {1.1, 0.1, 0.9}, {1.2, 0.1, 1}}, 1);
  Posterior procedure(question);
  lead(procedure, 3, std::ref(systems));
  EXPECT_TRUE(procedure.decision().is_sure);
  EXPECT_FALSE(procedure.decision().best);
}

TEST(Posterior, SaysWhatItCannotResolve) {
  Question question = question_of(2);
  question.margin = 0.001;
  question.most = 40;
  const Observe equal = [](std::size_t, int number) {
    return Observation{RunEnd::flowed, number % 2 == 0 ? 0.9 : 1.1, 1};
  };
  Posterior procedure(question);
  EXPECT_EQ(lead(procedure, 2, equal), (std::vector<int>{40, 40}));
  EXPECT_FALSE(procedure.decision().is_sure);
}

TEST(Posterior, EqualValuesWithoutScatterAreDecided) {
  MadeUpSystems systems({{1.0, 0}, {1.0, 0}, {2.0, 0}}, 1);
  Posterior procedure(question_of(3));
  lead(procedure, 3, std::ref(systems));
  EXPECT_TRUE(procedure.decision().is_sure);
  EXPECT_EQ(procedure.decision().best, 0u);
}

TEST(Posterior, OrderAndInterruptionsDoNotShow) {
  MadeUpSystems systems(slippage(10), 3);
  Posterior at_once(question_of(10)), backwards(question_of(10)), again(question_of(10));
  const std::vector<int> runs = lead(at_once, 10, std::ref(systems));
  EXPECT_EQ(lead(backwards, 10, std::ref(systems), 100000, true), runs);
  lead(again, 10, std::ref(systems), 3);
  Posterior resumed(question_of(10));
  EXPECT_EQ(lead(resumed, 10, std::ref(systems)), runs);
  EXPECT_EQ(resumed.decision().standings, at_once.decision().standings);
}

TEST(Posterior, RefusesASingleSystem) {
  EXPECT_THROW(Posterior(question_of(1)), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow::posterior_test
