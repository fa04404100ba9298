#include "design/error_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
