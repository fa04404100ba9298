#include "accuracy/error_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "made_up_rates.hpp"

namespace vibrosow {
namespace {

ErrorFit fit_of(const MadeUpTray& tray, const AccuracyDesign& design, int rounds) {
  MadeUpRuns runs(tray);
  return *ErrorFit::of(design.settings, runs.run(design.settings, rounds_of(design, rounds)));
}

TEST(ErrorFit, KeepsTheErrorsApart) {
  const AccuracyDesign design = made_up_design({0.01, 0.08});
  const ErrorFit fit = fit_of({.by_slip_speed = 3, .scatter = 1e-6}, design, 2);
  EXPECT_NEAR(fit.limit().mean, 0.020, 1e-9);
  const std::vector<MainEffect> effects = fit.effects();
  ASSERT_EQ(effects.size(), 3u);
  EXPECT_EQ(effects[0].source, ErrorSource::softness);
  EXPECT_NEAR(effects[0].error.percent, 10 * (1 - std::sqrt(1e-3)), 1e-5);
  EXPECT_EQ(effects[1].source, ErrorSource::slip_speed);
  EXPECT_NEAR(effects[1].error.percent, 3 * 0.07 / 0.08, 1e-5);
  EXPECT_EQ(effects[2].source, ErrorSource::step);
  EXPECT_NEAR(effects[2].error.percent, 0.75, 1e-5);  // 20 steps against 80
  for (std::size_t i = 0; i < design.settings.size(); ++i)
    EXPECT_NEAR(fit.error(i).percent, (MadeUpTray{.by_slip_speed = 3}.error(design.settings[i])), 1e-4);
}

TEST(ErrorFit, SchemesShareTheLimitAndHaveStepsOfTheirOwn) {
  AccuracyDesign design = made_up_design();
  const std::size_t verlets = design.settings.size();
  for (std::size_t i = 0; i < verlets; ++i) {
    design.settings.push_back(design.settings[i]);
    design.settings.back().integrator = Integrator::rk2_midpoint;
    design.runs.push_back(1);
  }
  const MadeUpTray tray{.scatter = 0};
  std::vector<AccuracyRun> runs = MadeUpRuns(tray).run(design.settings, rounds_of(design, 1));
  for (AccuracyRun& run : runs)  // the midpoint rule errs twice as much by its step
    if (run.setting >= verlets) *run.mass_rate += 0.020 * 0.01 * 20 / design.settings[run.setting].steps_per_contact;
  const std::vector<MainEffect> effects = ErrorFit::of(design.settings, runs)->effects();
  ASSERT_EQ(effects.size(), 4u);
  EXPECT_NEAR(effects[1].error.percent, 0.75, 1e-9);
  EXPECT_NEAR(effects[2].error.percent, 1.5, 1e-9);
  EXPECT_EQ(effects[3].source, ErrorSource::scheme);
  EXPECT_NEAR(effects[3].error.percent, 1.0, 1e-9);  // at 20 steps
}

TEST(ErrorFit, WhatWasNotVariedHasNoTerm) {
  AccuracyDesign design = made_up_design({0.02});
  const std::vector<MainEffect> effects = fit_of({}, design, 1).effects();
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].source, ErrorSource::softness);
  EXPECT_EQ(effects[1].source, ErrorSource::step);
}

TEST(ErrorFit, TooFewRunsGiveNoFit) {
  const AccuracyDesign design = made_up_design();
  MadeUpRuns runs({});
  EXPECT_FALSE(ErrorFit::of(design.settings, runs.run(design.settings, {{0, 1}, {1, 1}, {2, 1}})));
}

TEST(ErrorFit, RunsWithoutARateAreLeftOut) {
  const AccuracyDesign design = made_up_design();
  std::vector<AccuracyRun> runs = MadeUpRuns({}).run(design.settings, rounds_of(design, 1));
  const double limit = ErrorFit::of(design.settings, runs)->limit().mean;
  runs.push_back({.setting = 0, .refused = "stopped"});
  EXPECT_DOUBLE_EQ(ErrorFit::of(design.settings, runs)->limit().mean, limit);
}

TEST(ErrorFit, BandsHoldAllSettingsAtOnceAndTheLimitsInterval) {
  const AccuracyDesign design = made_up_design({0.01, 0.08});
  constexpr int trays = 400;
  int all_inside = 0, limit_inside = 0;
  for (int i = 1; i <= trays; ++i) {
    const MadeUpTray tray{.by_slip_speed = 3, .random_seed = static_cast<std::uint64_t>(i)};
    const ErrorFit fit = fit_of(tray, design, 1);
    bool inside = true;
    for (std::size_t s = 0; s < design.settings.size(); ++s)
      inside &= std::abs(fit.error(s).percent - tray.error(design.settings[s])) <= fit.error(s).band;
    all_inside += inside;
    limit_inside += std::abs(fit.limit().mean - tray.limit) <= *fit.limit().half_width_95;
  }
  // 95 %, less three deviations of a count out of 400; a lack of fit found by chance widens some.
  EXPECT_GE(all_inside, 0.95 * trays - 13);
  EXPECT_GE(limit_inside, 0.95 * trays - 13);
  EXPECT_LT(limit_inside, trays);
}

AccuracyRun accuracy_run(std::size_t setting, double window, double mass_rate) {
  return {.setting = setting, .window = window, .mass_rate = mass_rate};
}

/// Of one setting nothing but a mean is fitted: the windows are the weights.
TEST(ErrorFit, LongerWindowsWeighAsTheyAreLong) {
  const std::vector<AccuracySetting> settings = {MadeUpTray::setting(1e-4, 40)};
  const std::vector<AccuracyRun> runs = {accuracy_run(0, 1, 1), accuracy_run(0, 1, 2), accuracy_run(0, 4, 3),
                                         accuracy_run(0, 9, 4)};
  const ErrorFit fit = *ErrorFit::of(settings, runs);
  constexpr double mean = (1 + 2 + 4 * 3 + 9 * 4) / 15.0;
  constexpr double squares =
      (1 - mean) * (1 - mean) + (2 - mean) * (2 - mean) + 4 * (3 - mean) * (3 - mean) + 9 * (4 - mean) * (4 - mean);
  EXPECT_NEAR(fit.limit().mean, mean, 1e-12);
  // Equal runs are those of one setting and window: the two of window 1 alone, too few to judge the fit by.
  EXPECT_FALSE(fit.lack_of_fit());
  EXPECT_EQ(fit.degrees_of_freedom(), 3);
  EXPECT_NEAR(*fit.limit().half_width_95, 3.182446 * std::sqrt(squares / 3 / 15), 1e-6);
  EXPECT_NEAR(fit.scatter_percent(), 100 * std::sqrt(squares / 3) / mean, 1e-9) << "of a run over the scene's window";
}

TEST(ErrorFit, WhatHasOneValueIsNamed) {
  const std::vector<AccuracySetting> settings = {MadeUpTray::setting(1e-4, 20), MadeUpTray::setting(1e-4, 40),
                                                 MadeUpTray::setting(4e-4, 20)};
  const AccuracyRun first = accuracy_run(0, 1, 1), finer = accuracy_run(1, 1, 1), softer = accuracy_run(2, 1, 1);
  EXPECT_EQ(part_of_one_value(settings, {first, finer}), "softness");
  EXPECT_EQ(part_of_one_value(settings, {first, softer}), "number of steps a contact");
  EXPECT_EQ(part_of_one_value(settings, {first, finer, softer}), "");
  EXPECT_EQ(part_of_one_value(settings, {finer, softer}), "number of steps a contact for each softness");
  EXPECT_EQ(part_of_one_value(settings, {}), "");
}

/// A softness of which no run has a rate is not one that the rate was seen to change over.
TEST(ErrorFit, EffectsGoFromTheFinestToTheCoarsestOfWhatRan) {
  const std::vector<AccuracySetting> settings = {MadeUpTray::setting(1e-4, 20), MadeUpTray::setting(1e-4, 40),
                                                 MadeUpTray::setting(4e-4, 20), MadeUpTray::setting(1e-3, 20)};
  std::vector<AccuracyRun> runs;
  for (const double chance : {-0.01, 0.01})
    for (std::size_t setting = 0; setting < 3; ++setting) runs.push_back(accuracy_run(setting, 1, 1 + chance));
  runs.push_back({.setting = 3, .window = 1, .refused = "stopped by the guard"});
  const MainEffect softness = ErrorFit::of(settings, runs)->effects().front();
  ASSERT_EQ(softness.source, ErrorSource::softness);
  EXPECT_EQ(softness.from.shell_compression, 1e-4);
  EXPECT_EQ(softness.to.shell_compression, 4e-4);
}

/// Of a scheme with one number of steps nothing is known, beside one with two.
TEST(ErrorFit, ASchemeOfOneNumberOfStepsIsLeftOut) {
  std::vector<AccuracySetting> settings = {MadeUpTray::setting(1e-4, 20), MadeUpTray::setting(1e-4, 40),
                                           MadeUpTray::setting(4e-4, 20), MadeUpTray::setting(1e-4, 40)};
  settings[3].integrator = Integrator::rk2_midpoint;
  std::vector<AccuracyRun> runs;
  for (std::size_t setting = 0; setting < 4; ++setting)
    for (int k = 0; k < 4; ++k) runs.push_back(accuracy_run(setting, 1, setting == 3 ? 5 : 1 + 0.01 * k));
  const ErrorFit fit = *ErrorFit::of(settings, runs);
  EXPECT_TRUE(fit.tells(0));
  EXPECT_FALSE(fit.tells(3));
  EXPECT_NEAR(fit.limit().mean, 1.015, 1e-9) << "without its runs";
}

/// Rates at 20 and 40 steps a contact, ten times each: rate = limit + slope / steps.
class TwoSteps : public testing::Test {
 protected:
  static constexpr double apart = 0.05;  // of either rate from the mean of both
  static constexpr int each = 10;
  const std::vector<AccuracySetting> settings_ = {MadeUpTray::setting(1e-4, 20), MadeUpTray::setting(1e-4, 40)};
  const double deviation_ = std::sqrt(2 * each * apart * apart / (2 * each - 2));
  ErrorFit fit() const {
    std::vector<AccuracyRun> runs;
    for (int k = 0; k < each; ++k) {
      const double off = k % 2 == 0 ? apart : -apart;
      runs.push_back(accuracy_run(0, 1, 1.2 + off));
      runs.push_back(accuracy_run(1, 1, 1.1 + off));
    }
    return *ErrorFit::of(settings_, runs);
  }
  static constexpr double student = 2.100922;  // of 18 degrees of freedom
};

TEST_F(TwoSteps, LimitAndEffectHaveTheIntervalsOfALine) {
  EXPECT_NEAR(fit().limit().mean, 1, 1e-12);  // 2 times the mean at 40 less that at 20
  EXPECT_NEAR(*fit().limit().half_width_95, student * deviation_ * std::sqrt((4 + 1.0) / each), 1e-6);
  // From 40 steps to 20 the rate changes by 0.1: (a - b) / (2 b - a) by the means a and b, its slopes 1.1 and -1.2.
  const std::vector<MainEffect> effects = fit().effects();
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_NEAR(effects[0].error.percent, 10, 1e-9);
  EXPECT_NEAR(effects[0].error.band, 100 * student * deviation_ * std::hypot(1.1, 1.2) / std::sqrt(each), 1e-4);
}

/// Both errors are of one slope, so what holds for both at once is Student's t.
TEST_F(TwoSteps, BandsOfErrorsThatGoTogetherAreStudents) {
  const double of_20 = 100 * student * deviation_ * std::hypot(2.2, 2.4) / std::sqrt(each);
  EXPECT_NEAR(fit().error(0).percent, 20, 1e-9);
  EXPECT_NEAR(fit().error(0).band, of_20, 0.04 * of_20);  // by draws
  EXPECT_NEAR(fit().error(1).band, fit().error(0).band / 2, 1e-9);
  EXPECT_NEAR(fit().band_with(0, fit().covariance()), fit().error(0).band, 1e-9);
  EXPECT_NEAR(fit().band_with(0, fit().covariance() / 4), fit().error(0).band / 2, 1e-9);
}

/// Three softnesses on no line, twice each: Fisher's ratio of what the line misses to what equal runs scatter by.
TEST(ErrorFit, LackOfFitIsFishers) {
  std::vector<AccuracySetting> settings;
  for (const double part : {0.25, 0.5, 1.0}) settings.push_back(MadeUpTray::setting(part * part * 1e-2, 40));
  const auto fit_of_bend = [&](double bend) {
    std::vector<AccuracyRun> runs;
    for (std::size_t s = 0; s < 3; ++s)
      for (const double off : {-0.03, 0.03}) runs.push_back(accuracy_run(s, 1, 1 + (s == 1 ? bend : 0) + off));
    return *ErrorFit::of(settings, runs);
  };
  // Of 1/4, 1/2, 1 about their mean 7/12: squares 7/24; the middle one, -1/12, keeps 1 - 1/3 - (1/144) / (7/24) = 9/14
  // of its bend's square.
  const auto lack = [](double bend) { return 2 * bend * bend * 9 / 14; };
  constexpr double equal = 6 * 0.03 * 0.03 / 3;
  const ErrorFit straight = fit_of_bend(0.05), bent = fit_of_bend(0.15);
  ASSERT_TRUE(straight.lack_of_fit() && bent.lack_of_fit());
  // Of one and three degrees of freedom, F is the square of Student's t, here of three.
  const auto beyond = [&](double bend) {
    const double t = std::sqrt(lack(bend) / equal);
    return 2 * boost::math::cdf(complement(boost::math::students_t(3), t));
  };
  EXPECT_NEAR(*straight.lack_of_fit(), beyond(0.05), 1e-9);
  EXPECT_NEAR(*bent.lack_of_fit(), beyond(0.15), 1e-9);
  EXPECT_TRUE(straight.fits());
  EXPECT_EQ(straight.degrees_of_freedom(), 4);
  EXPECT_NEAR(straight.scatter_percent(), 100 * std::sqrt((lack(0.05) + 3 * equal) / 4) / straight.limit().mean, 1e-9);
  EXPECT_FALSE(bent.fits());
  EXPECT_EQ(bent.degrees_of_freedom(), 3);
  EXPECT_NEAR(bent.scatter_percent(), 100 * std::sqrt(equal) / bent.limit().mean, 1e-9) << "chance of equal runs alone";
  EXPECT_NEAR(*bent.limit().half_width_95, 12.7062 * std::sqrt(lack(0.15) * bent.covariance()(0, 0)), 1e-4)
      << "the settings' scatter about the fit, of one degree of freedom";
}

TEST(ErrorFit, EqualRunsLeaveTheRoundingOfACountOpen) {
  const AccuracyDesign design = made_up_design();
  std::vector<AccuracyRun> runs = MadeUpRuns({.scatter = 0}).run(design.settings, rounds_of(design, 1));
  for (AccuracyRun& run : runs) run.mass_rate = 0.020, run.seeds = 10;
  const ErrorFit fit = *ErrorFit::of(design.settings, runs);
  EXPECT_NEAR(fit.scatter_percent(), 10 / std::sqrt(12), 1e-6);
  EXPECT_GT(fit.error(0).band, 2);
}

TEST(ErrorFit, NoticesWhatMainEffectsDoNotAccountFor) {
  const AccuracyDesign design = made_up_design();
  EXPECT_TRUE(fit_of({.scatter = 0.5}, design, 4).fits());
  const ErrorFit fit = fit_of({.scatter = 0.5, .by_interaction = 12}, design, 4);
  EXPECT_FALSE(fit.fits());
  EXPECT_NEAR(fit.scatter_percent(), 0.5, 0.15);  // chance alone
}

}  // namespace
}  // namespace vibrosow
