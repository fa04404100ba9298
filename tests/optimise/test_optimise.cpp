#include "optimise/optimise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "grains/random.hpp"
#include "outflow/outflow.hpp"
#include "report/front_report.hpp"
#include "scene/input_error.hpp"
#include "selection/known_mean.hpp"
#include "support/rounds_of_runs.hpp"
#include "support/study_files.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Seeds by width, holes and frequency, a few more or less by chance: the drive's power buys rate.
Run run_of(const Model& model, const SimulationOptions& options, double scatter) {
  const Scene& scene = model.scene;
  const auto& motion = std::get<HarmonicMotion>(*scene.tray.motion);
  const auto holes = static_cast<double>(scene.tray.holes.size());
  const double fill = std::sqrt(scene.tray.fill->count / 40.0);
  const double mean = 800 * scene.tray.holes[0].width * holes * motion.frequency * fill;
  Run run;
  run.random_seed = options.random_seed;
  run.dt = 1e-3;
  run.steps = std::llround(scene.run.duration / run.dt);
  run.end_time = scene.run.duration;
  run.grain_steps = 4000;
  Random random(options.random_seed * 1000 + static_cast<std::uint64_t>(std::llround(mean)));
  const int seeds = static_cast<int>(std::lround(mean + scatter * random.uniform(-1, 1)));
  for (int i = 0; i < seeds; ++i)
    run.events.push_back({2.0 + 2.0 * (i + 0.5) / seeds, 1 + i % static_cast<int>(scene.tray.holes.size()), 0,
                          run.balance.counted++, scene.lots[0].mass, 0.1, 0.5});
  run.balance.put_in = run.balance.counted;
  return run;
}

Run scattered_run(const Model& model, const SimulationOptions& options) {
  return run_of(model, options, 10);
}

Run quiet_run(const Model& model, const SimulationOptions& options) {
  return run_of(model, options, 0);
}

class Optimise : public testing::Test {
 protected:
  StudySource three_widths() {
    return {
        files_.study("title = \"space\"\n[set.tray.motion]\nkind = \"harmonic\"\namplitude = \"4 mm\"\n"
                     "frequency = \"10 Hz\"\n[vary]\ntray.holes.width = [\"10 mm\", \"14 mm\", \"60 cm\"]\n")};
  }
  StudySource space() {
    return {
        files_.study("title = \"space\"\n[set.tray.motion]\nkind = \"harmonic\"\namplitude = \"4 mm\"\n[vary]\n"
                     "tray.holes.count = [1, 3]\ntray.holes.width = { from = \"10 mm\", to = \"20 mm\" }\n"
                     "tray.motion.frequency = { from = \"5 Hz\", to = \"15 Hz\" }\n")};
  }
  static OptimiseOptions options(const std::vector<std::string>& goals, int runs = 80) {
    OptimiseOptions options;
    options.goals = read_front_goals(goals);
    options.runs = runs;
    return options;
  }
  static OptimiseResult lead(StudyOptimisation& optimisation, int jobs = 1,
                             const Simulator& simulator = scattered_run) {
    lead_to_the_end(optimisation, simulator, jobs);
    return optimisation.result();
  }
  StudyFiles files_;
};

TEST_F(Optimise, FindsWhatRateAndPowerCost) {
  StudyOptimisation optimisation(space(), options({"rate", "power"}));
  const OptimiseResult result = lead(optimisation);
  EXPECT_LE(result.cost.runs, 80);
  EXPECT_GE(result.cost.runs, 78);
  int first = 0;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    if (!leads(result.layouts[i])) continue;
    ++first;
    const Scene& scene = result.study.scenes[result.study.layouts[i].scene.value()];
    EXPECT_EQ(scene.tray.holes.size(), 3u);  // three holes always sow more
    EXPECT_GT(scene.tray.holes[0].width, 0.017);
    EXPECT_NEAR(result.layouts[i].goals[1]->mean, drive_power(scene), 1e-12);
    EXPECT_FALSE(result.layouts[i].goals[1]->half_width_95);
    EXPECT_GT(result.layouts[i].goals[0]->half_width_95.value(), 0);
  }
  EXPECT_GE(first, 4);
}

TEST_F(Optimise, InSpaceTellsWhatTheRatesAreExpectedToBe) {
  const auto with = [&](const std::string& space) {
    return StudySource{files_.study("[set]\n" + space +
                                    "[set.tray.motion]\nkind = \"harmonic\"\namplitude = \"4 mm\"\n"
                                    "frequency = \"10 Hz\"\n[vary]\ntray.holes.width = [\"10 mm\", \"14 mm\"]\n")};
  };
  StudyOptimisation is_3d(with("space = \"3d\"\n"), options({"rate", "power"}, 40));
  for (const FrontLayout& layout : lead(is_3d).layouts) {
    ASSERT_TRUE(layout.expected);
    EXPECT_LT(layout.expected->range.low, 0.9);
    EXPECT_GT(layout.expected->range.high, 1.1);
  }
  StudyOptimisation in_plane(with(""), options({"rate", "power"}, 40));
  for (const FrontLayout& layout : lead(in_plane).layouts) EXPECT_FALSE(layout.expected);
}

/// Student's t about each mean, of a variance that is the layout's and what the first runs of all say of it.
TEST_F(Optimise, IntervalsAreOfTheSharedVariance) {
  StudyOptimisation optimisation(space(), options({"rate", "power"}, 60));
  const OptimiseResult result = lead(optimisation);
  std::vector<Moments> rates;
  std::vector<double> of_first;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const Model model = prepare(result.study.scenes[result.study.layouts[i].scene.value()]);
    Moments& of = rates.emplace_back();
    for (int r = 0; r < result.layouts[i].runs; ++r) {
      SimulationOptions simulation;
      simulation.random_seed = 1 + static_cast<std::uint64_t>(r);
      of.add(find_row(measure_outflow(model.scene, scattered_run(model, simulation)), "all", "all")->mass_rate);
      if (r + 1 == StudyOptimisation::first_runs) of_first.push_back(of.variance());
    }
  }
  const VariancePrior prior = variance_prior(of_first, StudyOptimisation::first_runs - 1);
  ASSERT_TRUE(prior.degrees_of_freedom > 0);
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const KnownMean known = known_mean(rates[i], prior);
    const double half = student_t_95(std::min(known.degrees_of_freedom, 1e6)) * std::sqrt(known.variance / known.count);
    EXPECT_NEAR(result.layouts[i].goals[0]->mean, known.mean, 1e-9 * known.mean) << i;
    EXPECT_NEAR(result.layouts[i].goals[0]->half_width_95.value(), half, 1e-6 * half) << i;
  }
}

TEST_F(Optimise, ItsFrontIsAStudyOfTheSameScenes) {
  StudyOptimisation optimisation(space(), options({"rate", "power"}));
  const OptimiseResult result = lead(optimisation);
  const std::filesystem::path folder = files_.seeder().parent_path() / "out" / "front";
  std::filesystem::create_directories(folder);
  const Study front = read_study(files_.write("out/front/front.toml", front_study(result, folder)));
  std::size_t k = 0;
  for (std::size_t i = 0; i < result.layouts.size(); ++i)
    if (leads(result.layouts[i])) {
      ASSERT_LT(k, front.scenes.size());
      EXPECT_EQ(front.scenes[k++], result.study.scenes[result.study.layouts[i].scene.value()]);
    }
  EXPECT_EQ(k, front.layouts.size());
}

TEST_F(Optimise, KilledItGoesOnToTheSameForAnyJobs) {
  StudyOptimisation undisturbed(space(), options({"rate", "power"}));
  const std::string csv = pareto_csv(lead(undisturbed, 2));
  StudyOptimisation optimisation(space(), options({"rate", "power"}));
  const std::int64_t made =
      lead_through_a_kill(files_.seeder().parent_path() / "cases",
                          StudyOptimisation(space(), options({"rate", "power"})), optimisation, scattered_run);
  EXPECT_EQ(pareto_csv(optimisation.result()), csv);
  EXPECT_EQ(static_cast<double>(made), optimisation.result().cost.runs - 36);
}

TEST_F(Optimise, TheRateIsAConstraintAndItsErrorAGoal) {
  OptimiseOptions wanted = options({"rate_error", "power"}, 120);
  wanted.rate = read_wanted_rate("2250 seeds/s +- 10 %");  // 300 seeds in 2 s of a slice, 15 slices
  StudyOptimisation optimisation(space(), wanted);
  const OptimiseResult result = lead(optimisation);
  int first = 0, missed = 0;
  for (const FrontLayout& of : result.layouts) {
    missed += of.standing == FrontStanding::misses_a_band;
    if (!of.is_first_by_means) continue;
    ++first;
    EXPECT_NEAR(of.rate->mean, 2250, 225);
    EXPECT_NEAR(of.goals[0]->mean, std::abs(of.rate->mean / 2250 - 1), 1e-9);
  }
  EXPECT_GT(first, 0);
  EXPECT_GT(missed, 0);
  EXPECT_THAT(pareto_csv(result), HasSubstr(",misses the rate,"));
}

/// The rate goes by the frequency and the root of the fill.
TEST_F(Optimise, SensitivitiesTakeRunsOfVariants) {
  StudyOptimisation optimisation(space(), options({"frequency_sensitivity", "fill_sensitivity", "power"}, 160));
  const OptimiseResult result = lead(optimisation, 1, quiet_run);
  double runs = 0;
  for (const FrontLayout& of : result.layouts) runs += 4 * of.runs;
  EXPECT_EQ(result.cost.runs, runs);
  const FrontLayout& one = result.layouts.front();
  EXPECT_NEAR(one.goals[0]->mean, 1, 0.1);
  EXPECT_NEAR(one.goals[1]->mean, (1 - std::sqrt(0.8)) / 0.2, 0.1);
}

TEST_F(Optimise, LayoutsThatCannotBeBuiltAreSaid) {
  StudyOptimisation optimisation(three_widths(), options({"rate", "power"}));
  const OptimiseResult result = lead(optimisation);
  EXPECT_EQ(result.layouts.size(), 3u);
  const std::string csv = pareto_csv(result);
  EXPECT_THAT(csv, HasSubstr(",invalid,"));
  EXPECT_THAT(csv, HasSubstr(",on the front,"));
  EXPECT_THAT(csv, HasSubstr(",dominated,"));
}

/// A layout that failed shows no rate of runs that nothing is to be decided by.
TEST_F(Optimise, ShowsNoRateOfRunsOutsideTheModel) {
  const Simulator outside_where_wide = [](const Model& model, const SimulationOptions& options) {
    vibrosow::Run run = scattered_run(model, options);
    run.outside_the_model = model.scene.tray.holes[0].width > 0.0135;
    return run;
  };
  StudyOptimisation optimisation(three_widths(), options({"rate", "power"}));
  const OptimiseResult result = lead(optimisation, 1, outside_where_wide);
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const auto scene = result.study.layouts[i].scene;
    const bool sound = scene && result.study.scenes[*scene].tray.holes[0].width < 0.0135;
    EXPECT_EQ(result.layouts[i].standing == FrontStanding::failed, !sound) << i;
    EXPECT_EQ(result.layouts[i].rate.has_value(), sound) << i;
  }
}

TEST_F(Optimise, PowerIsOfHarmonicMotion) {
  Scene scene;
  scene.tray.motion = HarmonicMotion{.amplitude = 0.01, .frequency = 9};
  EXPECT_NEAR(drive_power(scene), std::pow(2 * std::numbers::pi * 9, 3) * 1e-4 / 2, 1e-12);
  scene.tray.motion = SumMotion{};
  EXPECT_THAT([&] { drive_power(scene); }, ThrowsMessage<InputError>(HasSubstr("one harmonic motion")));
  EXPECT_THAT([&] { variant_of(scene, Variant::faster); }, ThrowsMessage<InputError>(HasSubstr("harmonic motion")));
  EXPECT_THAT([&] { variant_of(scene, Variant::less_fill); }, ThrowsMessage<InputError>(HasSubstr("tray.fill")));
}

TEST_F(Optimise, RefusesWhatItCannotDo) {
  EXPECT_THAT([&] { read_front_goals({"unevennes"}); },
              ThrowsMessage<InputError>(HasSubstr("did you mean \"unevenness\"")));
  EXPECT_THAT([&] { read_front_goals({"power", "power"}); }, ThrowsMessage<InputError>(HasSubstr("twice")));
  EXPECT_THAT([&] { StudyOptimisation(space(), options({"rate_error"})); },
              ThrowsMessage<InputError>(HasSubstr("--rate")));
  EXPECT_THAT(
      [&] {
        StudyOptimisation(space(), options({"rate", "power"}, 2));
      },
      ThrowsMessage<InputError>(HasSubstr("--runs: 2")));
  const auto refused = [&](const std::string& study, const std::string& because) {
    const StudySource source{files_.study(study)};
    EXPECT_THAT(
        [&] {
          StudyOptimisation(source, options({"rate", "spilled"}));
        },
        ThrowsMessage<InputError>(HasSubstr(because)));
  };
  refused("title = \"grid\"\n", "no [vary]");
  refused("[vary]\ntray.holes.width = [\"60 cm\", \"70 cm\"]\n", "hole 1");
  refused("[[layout]]\nname = \"a\"\n[vary]\ntray.holes.count = [1, 3]\n", "study.toml:2: layout");
  EXPECT_THAT(
      [&] {
        StudyOptimisation({files_.study("[vary]\ntray.holes.count = [1, 3]\n")}, options({"rate", "power"}));
      },
      ThrowsMessage<InputError>(HasSubstr("one harmonic motion")));
}

}  // namespace
}  // namespace vibrosow
