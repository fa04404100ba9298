#include "calibration/calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "grains/random.hpp"
#include "input/csv_lines.hpp"
#include "scene/input_error.hpp"
#include "support/runs_on_demand.hpp"
#include "support/study_files.hpp"
#include "surrogate/curve_surrogate.hpp"

namespace vibrosow::calibration_test {
namespace {

using testing::HasSubstr;

constexpr double friction = 0.45, restitution = 0.6;  // the truth

/// Seeds that leave in the 2 s of the measuring window, by a law that calibrations must find: a wider hole minds
/// friction less.
double law(double width, double mu, double e) {
  return 600 * std::exp(3 * width / 0.016 - 1.2 * mu * 0.016 / width + 0.5 * e * e);
}

/// Sows by the law with 2 % of chance: evenly at first, and at restitution 1 towards the end of the window.
Run made_up_run(const Model& model, const SimulationOptions& options) {
  Random random(options.random_seed);
  const double chance = quantile(boost::math::normal(), 1e-9 + (1 - 2e-9) * random.uniform());
  const Surface& surface = model.scene.contact.seed;
  const double width = model.scene.tray.holes.front().width;
  const auto seeds = std::llround(law(width, surface.friction, surface.restitution) * (1 + 0.02 * chance));
  Run run;
  run.random_seed = options.random_seed;
  run.dt = 1e-3, run.steps = 4000, run.end_time = 4;
  for (std::int64_t i = 0; i < seeds; ++i) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(seeds);
    run.events.push_back(
        {2 + 2 * std::pow(part, 1 / (1 + surface.restitution)), 1, 0, i, model.scene.lots[0].mass, 0.1, 0.5});
  }
  run.balance.put_in = run.balance.counted = seeds;
  return run;
}

class CalibrationOf : public testing::Test {
 protected:
  CalibrationTask task(const std::string& csv) const {
    CalibrationTask task;
    task.seeder = files_.seeder();
    task.keys = {parse_fitted_key("contact.friction=0.1..0.8"), parse_fitted_key("contact.restitution=0.2..0.9")};
    task.measured.file = "bench.csv";
    task.measured.table = read_measured(parse_csv_lines(csv, "bench.csv"));
    task.measured.scale = MeasuredScale::none;
    task.overrides = {parse_override("tray.holes.count=1")};
    task.most_runs = 100;
    return task;
  }
  Calibration calibrated(const CalibrationTask& of, const CalibrationChoices& choices) const {
    const CalibrationDesign design = design_calibration(of, std::make_shared<SourceFiles>());
    CalibrationChoices quick = choices;
    quick.points = 2048;
    return calibrate(of, design, quick, *reduced_runs(of, design, runs_on_demand(wanted_runs(design), made_up_run)));
  }
  std::string error(const CalibrationTask& of) const {
    try {
      design_calibration(of, std::make_shared<SourceFiles>());
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  /// Rates of the truth at four widths, times a factor, each repeat off by so much.
  static std::string rates(double factor, const std::vector<double>& repeats_off = {0}, double last = 1) {
    std::string csv = "tray.holes.width_mm,repeat,rate_g_per_s\n";
    for (const double width : {12, 16, 20, 24})
      for (std::size_t r = 0; r < repeats_off.size(); ++r)
        csv += fmt::format("{},{},{}\n", width, r,
                           0.040 / 2 * law(width * 1e-3, friction, restitution) * factor * (1 + repeats_off[r]) *
                               (width == 24 ? last : 1));
    return csv;
  }
  StudyFiles files_;
};

bool holds(const FittedValue& value, double truth) {
  return value.low <= truth && truth <= value.high;
}

TEST_F(CalibrationOf, RatesFindsWhatMadeThem) {
  const Calibration found = calibrated(task(rates(1)), {.noise = 0.02});
  EXPECT_TRUE(holds(found.values[0], friction)) << found.values[0].low << " to " << found.values[0].high;
  EXPECT_TRUE(holds(found.values[1], restitution)) << found.values[1].low << " to " << found.values[1].high;
  EXPECT_GT(found.values[0].contraction, 0.5);
  EXPECT_FALSE(found.depth_factor);
  EXPECT_EQ(found.fitted_values, 4);
  EXPECT_GT(found.misfit_probability, 0.05);
  EXPECT_LT(*found.fitted_rms, 0.02);
}

TEST_F(CalibrationOf, RatesUpToAFactorFindsTheFactor) {
  CalibrationTask of = task(rates(17));
  of.measured.scale = MeasuredScale::free;
  const Calibration found = calibrated(of, {.noise = 0.02});
  ASSERT_TRUE(found.depth_factor);
  EXPECT_TRUE(holds(*found.depth_factor, 17)) << found.depth_factor->low << " to " << found.depth_factor->high;
  EXPECT_TRUE(holds(found.values[0], friction));
}

TEST_F(CalibrationOf, OneRateTellsNoTwoNumbersApart) {
  CalibrationTask of = task("rate_g_per_s\n" + fmt::format("{}\n", 0.02 * law(0.016, friction, restitution)));
  of.overrides.push_back(parse_override("tray.holes.width=16 mm"));
  const Calibration found = calibrated(of, {.noise = 0.02});
  ASSERT_EQ(found.correlations.size(), 1U);
  EXPECT_GT(std::abs(found.correlations.front().correlation), not_told_apart);
}

TEST_F(CalibrationOf, WhatIsHeldOutIsPredictedAndNotFitted) {
  CalibrationChoices choices{.noise = 0.02};
  choices.hold_out.every = 4;
  const Calibration found = calibrated(task(rates(1)), choices), other = calibrated(task(rates(1, {0}, 1.5)), choices);
  EXPECT_EQ(found.values[0].mean, other.values[0].mean);
  EXPECT_EQ(found.fitted_values, 3);
  ASSERT_EQ(found.predictions.size(), 4U);
  EXPECT_TRUE(found.predictions[3].held_out);
  EXPECT_FALSE(found.predictions[2].held_out);
  EXPECT_LT(*found.held_out_rms, 0.05);
  EXPECT_NEAR(*other.held_out_rms, 0.33, 0.05);
  const PredictedValue& value = found.predictions[3];
  EXPECT_LT(value.low, value.measured);
  EXPECT_GT(value.high, value.measured);
  EXPECT_GT(other.predictions[3].measured, other.predictions[3].high);
}

TEST_F(CalibrationOf, NoiseIsThatOfTheRepeats) {
  const Calibration found = calibrated(task(rates(1, {-0.06, 0, 0.06})), {});
  EXPECT_NEAR(found.noise, 0.06, 1e-6);
  EXPECT_EQ(found.noise_source, "the table's repeats");
  EXPECT_NEAR(calibrated(task(rates(1)), {}).noise, 0.02, 0.008);  // of the simulated runs
}

TEST_F(CalibrationOf, EqualRepeatsAreNotWithoutNoise) {
  const Calibration found = calibrated(task(rates(1, {0, 0})), {}), once = calibrated(task(rates(1)), {});
  EXPECT_EQ(found.noise, once.noise);
  EXPECT_EQ(found.noise_source, "the scatter of simulated runs, as the table's repeats are all equal");
}

TEST_F(CalibrationOf, AMisfitIsSeen) {
  EXPECT_LT(calibrated(task(rates(0.3)), {.noise = 0.02}).misfit_probability, 1e-6);
}

/// The curve rises as t^(1 + e), so its shape tells restitution and its size friction.
TEST_F(CalibrationOf, ACurveFindsWhatMadeItAndPredictsItsEnd) {
  std::string csv = "time_s,mass_g\n";
  for (const double time : {0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.0})
    csv +=
        fmt::format("{},{}\n", time, 0.040 * law(0.016, friction, restitution) * std::pow(time / 2, 1 + restitution));
  CalibrationTask of = task(csv);
  of.measured.time_zero = 2;
  CalibrationChoices choices;
  choices.hold_out.after = 1.3;
  const Calibration found = calibrated(of, choices);
  EXPECT_TRUE(holds(found.values[1], restitution)) << found.values[1].low << " to " << found.values[1].high;
  EXPECT_GT(found.values[1].contraction, 0.7);
  EXPECT_TRUE(holds(found.values[0], friction)) << found.values[0].low << " to " << found.values[0].high;
  ASSERT_EQ(found.predictions.size(), 7U);
  EXPECT_LT(*found.held_out_rms, 0.05);
  for (const PredictedValue& value : found.predictions) {
    EXPECT_EQ(value.held_out, *value.time > 1.3);
    EXPECT_LT(value.low, value.measured) << *value.time;
    EXPECT_GT(value.high, value.measured) << *value.time;
  }
}

constexpr double normal_95 = 1.959964;

/// Calibrations of one key, of runs whose values are known to every digit: intervals have closed forms.
class WidthsOf : public CalibrationOf {
 protected:
  /// Values of a run at a part of friction's range, under a condition; the run's place in the design.
  using Values = std::function<std::vector<double>(double part, std::size_t condition, std::size_t run)>;

  CalibrationTask one_key(const std::string& csv, int runs) const {
    CalibrationTask of = task(csv);
    of.keys = {parse_fitted_key("contact.friction=0.1..0.8")};
    of.measured.time_zero = 2;
    of.most_runs = runs;
    return of;
  }
  Calibration calibrated_by(const CalibrationTask& of, const CalibrationChoices& choices, const Values& values) {
    const CalibrationDesign design = design_calibration(of, std::make_shared<SourceFiles>());
    std::vector<ReducedRun> runs;
    points_.resize(static_cast<Eigen::Index>(design.runs.size()), 1);
    for (std::size_t r = 0; r < design.runs.size(); ++r) {
      const double part = points_(static_cast<Eigen::Index>(r), 0) = design.points(design.runs[r].point, 0);
      runs.push_back({"", values(part, design.runs[r].condition, r)});
    }
    CalibrationChoices quick = choices;
    quick.points = 4096;
    return calibrate(of, design, quick, runs);
  }
  /// Half of a fitted key's interval, in parts of its range.
  static double half_width(const FittedValue& friction_value) {
    return (friction_value.high - friction_value.low) / 2 / 0.7;
  }
  /// Of a predicted rate, in its logarithm.
  static double half_width(const PredictedValue& rate) { return std::log(rate.high / rate.low) / 2; }

  /// What the scores of such curves, or logarithms of such rates, would be, from the design of the last calibration.
  CurveSurrogate surrogate_of(const Values& values) const {
    Eigen::MatrixXd all(points_.rows(), 0);
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      const std::vector<double> one = values(points_(i, 0), 0, static_cast<std::size_t>(i));
      all.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(one.size()));
      all.row(i) = Eigen::Map<const Eigen::RowVectorXd>(one.data(), all.cols());
    }
    return curve_surrogate(points_, all);
  }
  Eigen::MatrixXd points_;  // of the last calibration's runs
};

constexpr double steep = 2;  // of a logarithm, or of a curve's factor, over the range

/// Chance of a run, without a pattern that a smooth function would follow.
double made_up_chance(std::size_t run) {
  return static_cast<double>((7 * run) % 5) - 2;
}

/// kg
constexpr std::array rising = {1e-3, 2e-3, 3e-3, 4e-3};
const double rising_norm = std::sqrt(std::inner_product(rising.begin(), rising.end(), rising.begin(), 0.0));

std::vector<double> rising_by(double factor) {
  std::vector<double> curve(rising.begin(), rising.end());
  for (double& value : curve) value *= factor;
  return curve;
}

/// A curve of these values, g, measured so many times alike.
std::string curve_csv(const std::array<double, 4>& values, int repeats) {
  std::string csv = "time_s,mass_g\n";
  for (std::size_t v = 0; v < values.size(); ++v)
    for (int r = 0; r < repeats; ++r) csv += fmt::format("{},{}\n", 0.5 * static_cast<double>(v + 1), values[v]);
  return csv;
}

/// log rate = steep (part - 1/2): repeats of deviation s leave s / sqrt(4) / steep open, and a measurement like them
/// lies as far from the prediction again.
TEST_F(WidthsOf, RatesAreThoseOfTheMeanOfTheirRepeats) {
  const Values exact = [](double part, std::size_t, std::size_t) {
    return std::vector<double>{1e-3 * std::exp(steep * (part - 0.5))};
  };
  const Calibration found =
      calibrated_by(one_key("repeat,rate_g_per_s\n1,0.94\n2,0.98\n3,1.02\n4,1.06\n", 12), {}, exact);
  const double of_one = std::sqrt(0.008 / 3), of_mean = of_one / 2;
  EXPECT_NEAR(found.noise, of_one, 1e-9);
  EXPECT_NEAR(half_width(found.values[0]), normal_95 * of_mean / steep, 0.02 * of_mean);
  EXPECT_NEAR(found.values[0].contraction, 1 - std::sqrt(12.0) * of_mean / steep, 1e-3);
  EXPECT_NEAR(half_width(found.predictions[0]), normal_95 * std::sqrt(2.0) * of_mean, 0.1 * of_mean);
}

TEST_F(WidthsOf, RatesPoolRepeatsByTheirDegreesOfFreedom) {
  const Values exact = [](double part, std::size_t, std::size_t) {
    return std::vector<double>{1e-3 * std::exp(steep * (part - 0.5))};
  };
  const Calibration found = calibrated_by(
      one_key("tray.holes.width_mm,rate_g_per_s\n12,0.9\n12,1.1\n16,0.96\n16,1\n16,1\n16,1.04\n20,1\n", 40), {}, exact);
  EXPECT_NEAR(found.noise, std::sqrt((0.02 + 0.0032) / (1 + 3)), 1e-9);
}

/// By few and scattered runs what they say of a rate is uncertain itself, by the variance that their fit gives.
TEST_F(WidthsOf, RatesHoldTheSurrogatesOwnError) {
  const Values scattered = [](double part, std::size_t, std::size_t run) {
    return std::vector<double>{1e-3 * std::exp(2 * steep * (part - 0.5) + 0.03 * made_up_chance(run))};
  };
  constexpr double noise = 0.005;
  const Calibration found = calibrated_by(one_key("rate_g_per_s\n1\n", 12), {.noise = noise}, scattered);
  const CurveSurrogate surrogate = surrogate_of([&](double part, std::size_t c, std::size_t run) {
    return std::vector<double>{std::log(scattered(part, c, run)[0])};
  });
  const auto& known = found.posterior;
  const GaussianPrediction fit = surrogate.scores[0].at(known.points);
  const double own = weighted_mean(fit.variance, known.weights);
  ASSERT_GT(own, 4 * noise * noise);
  const double slope =
      weighted_deviation(fit.mean, known.weights) / weighted_deviation(known.points.col(0), known.weights);
  EXPECT_NEAR(slope, 2 * steep, 0.4);
  const double deviation = std::sqrt(own + noise * noise);
  EXPECT_NEAR(half_width(found.values[0]), normal_95 * deviation / slope, 0.1 * deviation / slope);
  EXPECT_NEAR(half_width(found.predictions[0]), normal_95 * std::sqrt(2.0) * deviation, 0.15 * deviation);
}

/// The scores of a curve that is measured several times scatter by the chance of a run over their number.
TEST_F(WidthsOf, CurvesAreThoseOfTheMeanOfTheirRepeats) {
  const Values scattered = [](double part, std::size_t, std::size_t run) {
    return rising_by(1 + steep * (part - 0.5) + 0.02 * made_up_chance(run));
  };
  for (const int repeats : {1, 4}) {
    const Calibration found = calibrated_by(one_key(curve_csv({1, 2, 3, 4}, repeats), 60), {}, scattered);
    const CurveSurrogate surrogate = surrogate_of(scattered);
    ASSERT_EQ(surrogate.scores.size(), 1U);
    EXPECT_NEAR(found.noise, std::sqrt(surrogate.chance(0, 0) / 4) / 4e-3, 1e-9) << "of a value, of the largest";
    const double own = weighted_mean(surrogate.scores[0].at(found.posterior.points).variance, found.posterior.weights);
    const double deviation = std::sqrt(surrogate.chance(0, 0) / repeats + own);
    const double part = deviation / (rising_norm * steep);
    EXPECT_NEAR(half_width(found.values[0]), normal_95 * part, 0.05 * part) << repeats;
    for (std::size_t v = 0; v < rising.size(); ++v) {
      const double share = rising[v] / rising_norm, half = (found.predictions[v].high - found.predictions[v].low) / 2;
      EXPECT_NEAR(half, normal_95 * std::sqrt(2.0) * share * deviation, 0.1 * share * deviation) << repeats << ' ' << v;
    }
  }
}

/// A reading's noise is told as a share of the curve's largest value.
TEST_F(WidthsOf, CurvesTakeTheNoiseOfTheirSize) {
  const Values exact = [](double part, std::size_t, std::size_t) { return rising_by(1 + steep * (part - 0.5)); };
  for (const int repeats : {1, 4}) {
    const Calibration found = calibrated_by(one_key(curve_csv({1, 2, 3, 4}, repeats), 12), {.noise = 0.05}, exact);
    const double deviation = 0.05 * 4e-3 / std::sqrt(repeats), part = deviation / (rising_norm * steep);
    EXPECT_NEAR(half_width(found.values[0]), normal_95 * part, 0.03 * part) << repeats;
    EXPECT_NEAR((found.predictions[3].high - found.predictions[3].low) / 2,
                normal_95 * deviation * std::hypot(1, rising[3] / rising_norm), 0.1 * deviation)
        << repeats;
  }
}

/// What of a measured curve none of the runs follows is noise: of the scores, and of each value beside them.
TEST_F(WidthsOf, CurvesThatNoRunFollowsAreAsWideAsTheyAreOdd) {
  const Values exact = [](double part, std::size_t, std::size_t) { return rising_by(1 + steep * (part - 0.5)); };
  const Calibration found = calibrated_by(one_key(curve_csv({1.2, 1.9, 3, 4}, 1), 12), {}, exact);
  const double odd = std::sqrt((0.04 + 0.01) / 4) * 1e-3, part = odd / (rising_norm * steep);
  EXPECT_NEAR(half_width(found.values[0]), normal_95 * part, 0.03 * part);
  for (std::size_t v = 0; v < rising.size(); ++v) {
    const double share = rising[v] / rising_norm;
    EXPECT_NEAR((found.predictions[v].high - found.predictions[v].low) / 2,
                normal_95 * odd * std::sqrt(1 + share * share), 0.05 * odd)
        << v;
  }
}

/// The first two readings lie on a simulated curve; the others, which are held out, on none.
TEST_F(WidthsOf, WhatIsHeldOutDoesNotWidenTheIntervalThatItIsTriedBy) {
  const Values exact = [](double part, std::size_t, std::size_t) { return rising_by(1 + steep * (part - 0.5)); };
  CalibrationChoices choices{.noise = 0.01};
  choices.hold_out.after = 1.2;
  const Calibration found = calibrated_by(one_key(curve_csv({1, 2, 3.5, 3.5}, 1), 12), choices, exact);
  for (const PredictedValue& value : found.predictions) {
    EXPECT_EQ(value.held_out, *value.time > 1.2);
    EXPECT_EQ(value.measured < value.low || value.measured > value.high, value.held_out) << *value.time;
  }
}

/// Three rates of slopes 1 to 3, one of them off by 0.06 of its logarithm, and one key: of chi squared two degrees of
/// freedom are left, of which the probability is exp(-x / 2).
TEST_F(WidthsOf, AMisfitIsJudgedByWhatTheFitLeavesFree) {
  constexpr double noise = 0.02;
  std::string csv = "tray.holes.width_mm,rate_g_per_s\n";
  for (std::size_t k = 0; k < 3; ++k) csv += fmt::format("{},{}\n", 12 + 4 * k, k == 0 ? std::exp(0.06) : 1.0);
  const Calibration found =
      calibrated_by(one_key(csv, 36), {.noise = noise}, [](double part, std::size_t condition, std::size_t) {
        return std::vector<double>{1e-3 * std::exp(static_cast<double>(condition + 1) * (part - 0.5))};
      });
  // Least squares: slope 0.06 / 14; what is left, 0.06^2 (1 - 1 / 14).
  const double misfit = 0.06 * 0.06 * (1 - 1 / 14.0) / (noise * noise);
  const double gone = 1 - 12 * noise * noise / 14;  // of the variance of the range
  EXPECT_NEAR(found.misfit_over_noise, std::sqrt(misfit / (3 - gone)), 0.02);
  EXPECT_NEAR(found.misfit_probability, std::exp(-misfit / 2), 0.05 * std::exp(-misfit / 2));
}

/// Four rates, of slopes 1 to 4, that are known up to a factor: least squares for a slope and a constant.
TEST_F(WidthsOf, RatesUpToAFactorAreThoseOfALine) {
  constexpr double noise = 0.02, factor = 17;
  constexpr std::array off = {1.0, -1.0, -1.0, 1.0};  // of the measured logarithms; across slope and constant
  std::string csv = "tray.holes.width_mm,rate_g_per_s\n";
  for (std::size_t k = 0; k < off.size(); ++k)
    csv += fmt::format("{},{}\n", 12 + 4 * k, factor * std::exp(noise * off[k]));
  CalibrationTask of = one_key(csv, 48);
  of.measured.scale = MeasuredScale::free;
  const Calibration found = calibrated_by(of, {.noise = noise}, [](double part, std::size_t condition, std::size_t) {
    return std::vector<double>{1e-3 * std::exp(static_cast<double>(condition + 1) * (part - 0.5))};
  });
  // Of the squares and sums of 1, 2, 3, 4: [30 10; 10 4], its inverse [4 -10; -10 30] / 20.
  EXPECT_NEAR(half_width(found.values[0]), normal_95 * noise * std::sqrt(4 / 20.0), 0.02 * noise);
  ASSERT_TRUE(found.depth_factor);
  EXPECT_NEAR(std::log(found.depth_factor->low), std::log(factor) - normal_95 * noise * std::sqrt(1.5), 0.05 * noise);
  EXPECT_NEAR(std::log(found.depth_factor->high), std::log(factor) + normal_95 * noise * std::sqrt(1.5), 0.05 * noise);
  EXPECT_NEAR(found.correlations.back().correlation, -10 / std::sqrt(120.0), 0.01);
  for (std::size_t k = 0; k < off.size(); ++k) {
    const double leverage = 0.25 + std::pow(static_cast<double>(k) - 1.5, 2) / 5;
    EXPECT_NEAR(half_width(found.predictions[k]), normal_95 * noise * std::sqrt(1 + leverage), 0.1 * noise) << k;
  }
  // Chi squared is 4, of two degrees of freedom: four rates less a slope and a constant.
  EXPECT_NEAR(found.misfit_probability, std::exp(-2.0), 2e-3);
  EXPECT_NEAR(*found.fitted_rms, noise, 0.02 * noise);
  EXPECT_FALSE(found.held_out_rms);
}

/// One rate and one key, whose range gives e^-1 to e^1 of it: a rate of e^1.5 is missed by 0.5, of e^0.5 by nothing.
TEST_F(WidthsOf, ARateBeyondTheRangeOfItsOnlyKeyIsMissed) {
  constexpr double noise = 0.02;
  const Values exact = [](double part, std::size_t, std::size_t) {
    return std::vector<double>{1e-3 * std::exp(steep * (part - 0.5))};
  };
  const auto missed = [&](double log_rate) {
    const std::string csv = fmt::format("rate_g_per_s\n{}\n", std::exp(log_rate));
    return calibrated_by(one_key(csv, 12), {.noise = noise}, exact).misfit_over_noise;
  };
  EXPECT_NEAR(missed(1.5), 0.5 / noise, 0.5);
  EXPECT_NEAR(missed(0.5), 0, 0.05);
}

TEST_F(CalibrationOf, RunsThatClogAreLeftOutOfCurves) {
  CalibrationTask of = task("time_s,mass_g\n0.5,1\n1,2\n1.5,3\n2,4\n");
  of.measured.time_zero = 2;
  const CalibrationDesign design = design_calibration(of, std::make_shared<SourceFiles>());
  const auto clogging = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = made_up_run(model, options);
    if (model.scene.contact.seed.friction > 0.7)
      std::erase_if(run.events, [](const OutflowEvent& event) { return event.time > 3.2; });
    return run;
  };
  const std::vector<ReducedRun> runs = *reduced_runs(of, design, runs_on_demand(wanted_runs(design), clogging));
  for (std::size_t r = 0; r < runs.size(); ++r)
    EXPECT_EQ(runs[r].reason, design.runs[r].scene.contact.seed.friction > 0.7 ? "clogged" : "");
}

TEST_F(CalibrationOf, EveryPointIsRunUnderEveryCondition) {
  CalibrationTask of = task(rates(1));
  of.most_runs = 70;
  const CalibrationDesign design = design_calibration(of, std::make_shared<SourceFiles>());
  EXPECT_EQ(design.runs.size(), 68U);
  std::set<std::pair<Eigen::Index, std::size_t>> pairs;
  std::set<std::uint64_t> seeds;
  for (const CalibrationRun& run : design.runs) pairs.insert({run.point, run.condition}), seeds.insert(run.random_seed);
  EXPECT_EQ(pairs.size(), 68U);
  EXPECT_EQ(seeds.size(), 68U);
  EXPECT_EQ(design.points.row(0), design.points.row(15));  // again
  EXPECT_DOUBLE_EQ(design.runs[4].scene.contact.seed.friction, of.keys[0].at(design.points(1, 0)));
  EXPECT_EQ(wanted_runs(design).size(), 68U);
}

TEST_F(CalibrationOf, MissingRunsGiveNothing) {
  const CalibrationTask of = task(rates(1));
  const CalibrationDesign design = design_calibration(of, std::make_shared<SourceFiles>());
  std::vector<WantedRun> most = wanted_runs(design);
  most.pop_back();
  EXPECT_FALSE(reduced_runs(of, design, runs_on_demand(most, made_up_run)));
}

TEST_F(CalibrationOf, RunsThatPassNothingAreLeftOutAndTooFewAreRefused) {
  const CalibrationTask of = task(rates(1));
  const CalibrationDesign design = design_calibration(of, std::make_shared<SourceFiles>());
  std::vector<ReducedRun> runs = *reduced_runs(of, design, runs_on_demand(wanted_runs(design), made_up_run));
  const CalibrationChoices quick{.points = 2048};
  const Calibration all = calibrate(of, design, quick, runs);
  runs[5].reason = "nothing flowed";
  EXPECT_NE(calibrate(of, design, quick, runs).values[0].mean, all.values[0].mean);
  for (ReducedRun& run : runs) run.reason = "nothing flowed";
  EXPECT_THROW(calibrate(of, design, quick, runs), InputError);
}

TEST_F(CalibrationOf, WrongTasksAreRefused) {
  CalibrationTask of = task(rates(1));
  of.most_runs = 30;
  EXPECT_THAT(error(of), HasSubstr("need at least"));
  of = task(rates(1));
  of.keys.push_back(of.keys.front());
  EXPECT_THAT(error(of), HasSubstr("fitted twice"));
  of = task(rates(1));
  of.overrides.push_back(parse_override("contact.friction=0.3"));
  EXPECT_THAT(error(of), HasSubstr("set by --set"));
  of = task("contact.friction,rate_g_per_s\n0.3,1\n");
  EXPECT_THAT(error(of), HasSubstr("a condition of bench.csv"));
  of = task("hole,rate_g_per_s\n4,1\n");
  EXPECT_THAT(error(of), HasSubstr("bench.csv:2: hole 4"));
  of = task("time_s,mass_g\n1,1\n");
  of.measured.scale = MeasuredScale::free;
  EXPECT_THAT(error(of), HasSubstr("--scale free goes with rates"));
  of = task("time_s,mass_g\n9,1\n");
  EXPECT_THAT(error(of), HasSubstr("was read up to 9 s, and the run ends 4 s"));
}

TEST(FittedKey, IsReadWithItsUnit) {
  const KeyRange stiffness = parse_fitted_key("contact.youngs_modulus = 5 MPa .. 500 MPa");
  EXPECT_EQ(stiffness.key, "contact.youngs_modulus");
  EXPECT_DOUBLE_EQ(stiffness.at(0.5), 50);
  EXPECT_DOUBLE_EQ(parse_fitted_key("contact.friction=0.2..0.8").at(0.5), 0.5);
  for (const char* wrong :
       {"contact.friction", "contact.friction=0.2", "contact.friction=0.8..0.2", "tray.depth=1 cm..2 cm",
        "contact.friction=a..b", "contact.youngs_modulus=5..50", "contact.shell_compression=0..1e-4"})
    EXPECT_THROW(parse_fitted_key(wrong), InputError) << wrong;
}

TEST_F(CalibrationOf, UsualKeysAreThoseThatTheSceneHas) {
  const auto files = std::make_shared<SourceFiles>();
  std::vector<std::string> names;
  for (const KeyRange& key : usual_fitted_keys(files_.seeder(), {}, files)) names.push_back(key.key);
  EXPECT_EQ(names, (std::vector<std::string>{"contact.friction", "contact.restitution", "contact.shell_compression"}));
  names.clear();
  const std::vector<Override> more{parse_override("contact.wall.friction=0.2"), parse_override("accuracy=draft")};
  const auto rolling = files_.write("rolling.toml", R"([seeds.wheat]
diameter = "4 mm"
mass = "40 mg"
[contact]
law = "hertz"
youngs_modulus = "10 MPa"
friction = 0.3
friction_model = "spring"
rolling = "spring"
rolling_friction = 0.1
wall.friction = 0.2
[tray]
length = "50 cm"
height = "12 cm"
fill = { count = 40, packing = "layers" }
[run]
duration = "4 s"
measure_from = "2 s"
)");
  for (const KeyRange& key : usual_fitted_keys(rolling, {}, files)) names.push_back(key.key);
  EXPECT_EQ(names, (std::vector<std::string>{"contact.friction", "contact.wall.friction", "contact.restitution",
                                             "contact.rolling_friction", "contact.youngs_modulus"}));
  names.clear();
  for (const KeyRange& key : usual_fitted_keys(rolling, more, files)) names.push_back(key.key);
  EXPECT_EQ(names, (std::vector<std::string>{"contact.friction", "contact.restitution", "contact.rolling_friction"}))
      << "walls' friction is set, and softness is the accuracy level's";
}

}  // namespace
}  // namespace vibrosow::calibration_test
