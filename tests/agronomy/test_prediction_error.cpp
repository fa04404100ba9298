#include "agronomy/prediction_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "distributions/distributions.hpp"

namespace vibrosow {
namespace {

TEST(PredictionError, OfChanceAloneIsNormal) {
  const FactorRange range = expected_range({.chance = 0.02});
  EXPECT_NEAR(range.high, std::exp(1.959964 * 0.02), 1e-6);
  EXPECT_NEAR(range.low * range.high, 1, 1e-9);
  EXPECT_NEAR(half_width_of_normal(0.02), 1.959964 * 0.02, 2e-5);
}

TEST(PredictionError, AHalfWidthIsThatOfItsDeviation) {
  for (const double half_width : {0.0, 0.01, 0.3, 2.0})
    EXPECT_NEAR(half_width_of_normal(deviation_of_half_width(half_width)), half_width, 1e-12);
}

TEST(PredictionError, NormalPartsAddInSquares) {
  EXPECT_NEAR(expected_range({.chance = 0.03, .numerics = 0.04, .tolerance = 0.12}).high, std::exp(1.959964 * 0.13),
              1e-6);
}

TEST(PredictionError, OfTheModelIsStudents) {
  for (const int materials : {3, 5, 20}) {
    const ModelError model{0.22, materials, 1};
    const double t = students_t_quantile(materials, 0.975);
    EXPECT_NEAR(expected_range({.model = model}).high, std::exp(t * 0.22), 0.004) << materials;
    EXPECT_NEAR(half_width_of_model({.model = model}), std::sinh(t * 0.22), 1e-12);
  }
}

/// What the model errs by at one setting alone is a normal part of it, and widens the range before anything is weighed.
TEST(PredictionError, OfTheModelHasASettingsOwnPart) {
  const ModelError model{0.22, 5, 1};
  const PredictionError error{.model = model, .setting = 0.12};
  EXPECT_NEAR(half_width_of_model({.setting = 0.12}), half_width_of_normal(0.12), 1e-12);
  const FactorRange range = expected_range(error);
  EXPECT_NEAR(half_width_of_model(error), (range.high - range.low) / 2, 1e-12);
  EXPECT_GT(half_width_of_model(error), 1.05 * half_width_of_model({.model = model}));
}

TEST(PredictionError, OfTheModelComesFromMeasuredRates) {
  const ModelError model = model_error({std::log(1.1), std::log(0.9), std::log(1.3)});
  EXPECT_EQ(model.materials, 3);
  EXPECT_NEAR(model.mean_factor, std::cbrt(1.1 * 0.9 * 1.3), 1e-12);
  EXPECT_NEAR(model.scale,
              std::sqrt((std::pow(std::log(1.1), 2) + std::pow(std::log(0.9), 2) + std::pow(std::log(1.3), 2)) / 3),
              1e-12);
  EXPECT_THROW(model_error({}), std::invalid_argument);
  EXPECT_THROW(model_error({std::nan("")}), std::invalid_argument);
}

TEST(CommonShare, FallsFromOneToNothing) {
  EXPECT_EQ(common_share({1, 2, 3}, {1, 2, 3}), 1);
  EXPECT_DOUBLE_EQ(common_share({1, 2, 3}, {1.25, 2, 3}), 0.75);
  EXPECT_DOUBLE_EQ(common_share({1, 2, 3}, {1.25, 2.5, 3}), 0.375);
  EXPECT_EQ(common_share({1, 2, 3}, {2.5, 2, 3}), 0);
}

/// Users whose truth is drawn from the very spreads that are stated.
class Users : public testing::Test {
 protected:
  double uniform() { return (static_cast<double>(draw_() >> 11) + 0.5) * 0x1p-53; }
  double normal(double deviation) { return deviation * normal_quantile(uniform()); }
  double student() { return error.model.scale * students_t_quantile(error.model.materials, uniform()); }

  const PredictionError error{.numerics = 0.03, .tolerance = 0.04, .model = {0.22, 5, 1}, .setting = 0.08};
  const double own = 0.05, weighing = 0.02;
  const SettingPlace here{0.2, 1, 4}, near_here{0.6, 1, 4};
  const double near_share = common_share(here, near_here);

 private:
  std::mt19937_64 draw_{7};
};

TEST_F(Users, AreHeldBeforeAndAfterWeighingAtNewSettingsToo) {
  constexpr int users = 2000;
  int before = 0, after = 0, there = 0, near = 0, anew = 0;
  double narrowed = 0;
  const WeighedRates unweighed(error, {});
  const FactorRange wide = unweighed.at(own).range;
  for (int k = 0; k < users; ++k) {
    const double of_the_seed = student() + normal(error.numerics), common = of_the_seed + normal(error.tolerance);
    const double part = std::hypot(error.setting, own);
    const double setting = normal(part), other = normal(part);
    const double beside = near_share * setting + std::sqrt(1 - near_share * near_share) * normal(part);
    const WeighedRates weighed(error, {{here, common + setting + normal(weighing), weighing, own}});
    const auto holds = [](const FactorRange& range, double truth) {
      return std::exp(truth) >= range.low && std::exp(truth) <= range.high;
    };
    before += holds(wide, common + other);
    const FactorRange range = weighed.at(own).range;
    after += holds(range, common + other);
    narrowed += std::log(range.high / range.low) / std::log(wide.high / wide.low) / users;
    there += holds(weighed.at(own, here).range, common + setting);
    near += holds(weighed.at(own, near_here).range, common + beside);
    constexpr double drilled = 0.1;  // tolerance of other holes
    anew += holds(weighed.at(own, here, drilled).range, of_the_seed + setting + normal(drilled));
  }
  for (const int held : {before, after, there, near, anew}) {
    EXPECT_GE(held, 0.935 * users);
    EXPECT_LE(held, 0.965 * users);
  }
  EXPECT_LT(narrowed, 0.6);
}

TEST_F(Users, WhoWeighAgainAtOneSettingLearnNothingMoreOfOthers) {
  const Weighing one{here, 0.3, 0.001, 0};
  const WeighedRates once(error, {one}), often(error, std::vector<Weighing>(50, one));
  const FactorRange a = once.at(0).range, b = often.at(0).range;
  EXPECT_NEAR(std::log(b.high / b.low) / std::log(a.high / a.low), 1, 0.01);
  const FactorRange there = often.at(0, here).range;
  EXPECT_LT(std::log(there.high / there.low), 0.01);
}

/// By a weighing without an error, at the same place, nothing but the two tolerances is left open.
TEST_F(Users, WhoDrillAnewKeepTheToleranceOfBothHoles) {
  const WeighedRates weighed(error, {{here, 0.2, 1e-6, own}});
  const WeighedRates::Answer anew = weighed.at(own, here, error.tolerance);
  EXPECT_NEAR(std::log(anew.range.high / anew.range.low) / 2, normal_95 * std::sqrt(2.0) * error.tolerance,
              0.05 * error.tolerance);
  EXPECT_LT(anew.middle, std::exp(0.2)) << "a part of what was weighed may be the old holes'";
}

TEST_F(Users, AreToldOfARowThatContradictsTheOthers) {
  std::vector<Weighing> rows;
  for (double setting = 1; setting <= 4; ++setting) rows.push_back({{setting, 0, 0}, 0.1, weighing, own});
  for (const double share : WeighedRates(error, rows).surprise()) EXPECT_GT(share, 0.5);
  rows[2].log_ratio = 0.1 + 0.6;
  const std::vector<double> shares = WeighedRates(error, rows).surprise();
  EXPECT_LT(shares[2], 0.001);
  EXPECT_GT(shares[0], 0.01);
  EXPECT_LT(WeighedRates(error, {{here, std::log(20), weighing, own}}).surprise()[0], 0.01);
}

}  // namespace
}  // namespace vibrosow
