#include "design/calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "grains/random.hpp"
#include "input/csv_lines.hpp"
#include "scene/input_error.hpp"
#include "study_files.hpp"

namespace vibrosow {
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
    return calibrate(of, design, quick, *reduced_runs(of, design, made_up_run));
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
  const std::vector<ReducedRun> runs = *reduced_runs(of, design, clogging);
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
  EXPECT_FALSE(reduced_runs(of, design, [](const Model&, const SimulationOptions&) {
    vibrosow::Run run;
    run.status = RunStatus::interrupted;
    return run;
  }));
}

TEST_F(CalibrationOf, RunsThatPassNothingAreLeftOutAndTooFewAreRefused) {
  const CalibrationTask of = task(rates(1));
  const CalibrationDesign design = design_calibration(of, std::make_shared<SourceFiles>());
  std::vector<ReducedRun> runs = *reduced_runs(of, design, made_up_run);
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
  EXPECT_THAT(error(of), HasSubstr("before the curve begins"));
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
}  // namespace vibrosow
