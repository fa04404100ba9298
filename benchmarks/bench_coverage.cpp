// What `vibrosow bench-sheet` promises, held against what `vibrosow calibrate` then finds: 40 made-up benches. A closed
// form takes the simulator's place, of a rate that friction, rolling friction and restitution slow down, the less the
// faster the tray shakes; runs and readings scatter about it. Of each bench the sheet is made, its readings are taken
// at a truth drawn from the keys' ranges, and fitted. Usage: bench_coverage SEEDER.toml BENCHES.csv SUMMARY.csv

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "calibration/bench_plan.hpp"
#include "calibration/bench_runs.hpp"
#include "calibration/calibration.hpp"
#include "grains/random.hpp"
#include "outflow/statistics.hpp"

namespace {

using namespace vibrosow;

constexpr int benches = 40, calibration_runs = 150;
constexpr double dispersion = 0.5;                         // variance of a count over its mean
constexpr double depth_factor = 14, window = 4, from = 1;  // of the made-up tray over its slice; s

double normal_number(Random& random) {
  return quantile(boost::math::normal(), 1e-9 + (1 - 2e-9) * random.uniform());
}

/// Seeds a second of the slice.
double true_rate(const Scene& scene) {
  const auto& motion = std::get<HarmonicMotion>(*scene.tray.motion);
  const double speed = 2 * std::numbers::pi * motion.frequency * motion.amplitude /
                       std::sqrt(standard_gravity * scene.lots.front().diameter);
  const Surface& seeds = scene.contact.seed;
  return 120 *
         std::exp(-(1.2 * seeds.friction + 2 * seeds.rolling_friction) / (0.5 + speed) + 0.05 * seeds.restitution) *
         std::sqrt(speed) / (1 + 0.1 * speed * speed);
}

/// Seeds in a time (s), with chance.
double counted(const Scene& scene, double time, double factor, Random& random) {
  const double mean = factor * true_rate(scene) * time;
  return std::max(0.0, std::round(mean + std::sqrt(dispersion * mean) * normal_number(random)));
}

Run made_up_run(const CalibrationRun& wanted) {
  Random random(wanted.random_seed);
  const auto seeds = static_cast<std::int64_t>(counted(wanted.scene, window, 1, random));
  Run run;
  run.random_seed = wanted.random_seed;
  run.dt = 1e-3, run.steps = 5000, run.end_time = from + window;
  for (std::int64_t i = 0; i < seeds; ++i)
    run.events.push_back({from + window * (static_cast<double>(i) + 0.5) / static_cast<double>(seeds), 1, 0, i,
                          wanted.scene.lots[0].mass, 0.1, 0.5});
  run.balance.put_in = run.balance.counted = seeds;
  return run;
}

/// As if the runs of a design were kept.
KeptRuns kept(const CalibrationDesign& design) {
  std::map<std::string, const CalibrationRun*> by_name;
  for (const CalibrationRun& run : design.runs) by_name.emplace(name_of_run(run.scene, run.random_seed), &run);
  return [by_name](const std::string& name) { return std::optional(made_up_run(*by_name.at(name))); };
}

/// What the sheet asks for, read off at the truth: the table that calibrate is given.
MeasuredTable readings(const CalibrationTask& task, const BenchPlan& plan, const Eigen::VectorXd& truth,
                       const BenchLimits& limits, const std::shared_ptr<SourceFiles>& files, Random& random) {
  MeasuredTable table;
  table.quantity = MeasuredQuantity::mass_rate;
  table.condition_keys = task.measured.table.condition_keys;
  for (const BenchCandidate* candidate : plan.chosen()) {
    const Scene scene = calibration_scene(task, candidate->conditions, truth, files);
    std::vector<double> rates;
    for (int repeat = 0; repeat < plan.repeats; ++repeat)
      rates.push_back(counted(scene, plan.catch_time, depth_factor, random) * scene.lots[0].mass / plan.catch_time *
                      (1 + limits.noise * normal_number(random)));
    MeasuredSeries series;
    series.conditions = candidate->conditions;
    series.values = {mean_with_interval(rates)};
    series.repeats = {plan.repeats};
    series.where = "a reading";
    table.series.push_back(std::move(series));
  }
  return table;
}

/// What became of one key over all benches.
struct Score {
  int held = 0;
  std::vector<double> promised, found;
};

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 4) {
    std::cerr << "usage: bench_coverage SEEDER.toml BENCHES.csv SUMMARY.csv\n";
    return 2;
  }
  const auto files = std::make_shared<SourceFiles>();
  BenchAsked asked{
      .seeder = arguments[1], .overrides = {parse_override("tray.fill.keep=true")}, .keys = {}, .settings = {}};
  for (const char* key :
       {"contact.friction=0.1..0.8", "contact.rolling_friction=0..0.3", "contact.restitution=0.2..0.9"})
    asked.keys.push_back(parse_fitted_key(key));
  std::vector<Score> scores(asked.keys.size());
  Random random(20261129);
  std::ofstream out(arguments[2]);
  out << "bench,key,true,mean,low,high,promised_percent,narrowed_percent\n";
  for (int bench = 1; bench <= benches; ++bench) {
    asked.random_seed = static_cast<std::uint64_t>(1000 * bench);
    const BenchRuns sheet = affordable_bench(asked, files);
    const BenchLimits limits;
    const BenchPlan plan = plan_bench(sheet.task, sheet.design, limits, kept(sheet.design)).value();
    Eigen::VectorXd truth(static_cast<Eigen::Index>(asked.keys.size()));
    for (double& part : truth) part = random.uniform();
    CalibrationTask task = sheet.task;
    task.measured.table = readings(task, plan, truth, limits, files, random);
    task.most_runs = calibration_runs;
    const CalibrationDesign design = design_calibration(task, files);
    CalibrationChoices choices;
    choices.hold_out = usual_hold_out(task.measured.table);
    const Calibration found = calibrate(task, design, choices, *reduced_runs(task, design, kept(design)));
    for (std::size_t k = 0; k < asked.keys.size(); ++k) {
      const FittedValue& value = found.values[k];
      const double true_value = asked.keys[k].at(truth(static_cast<Eigen::Index>(k)));
      Score& score = scores[k];
      if (value.low <= true_value && true_value <= value.high) ++score.held;
      score.promised.push_back(100 * plan.contraction[k]);
      score.found.push_back(100 * value.contraction);
      out << fmt::format("{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.3g},{:.3g}\n", bench, asked.keys[k].key, true_value,
                         value.mean, value.low, value.high, score.promised.back(), score.found.back());
    }
  }
  std::ofstream summary(arguments[3]);
  summary << "key,benches,promised_percent,narrowed_percent,narrowed_half_width_95,held_percent,held_low_percent,"
             "held_high_percent\n";
  for (std::size_t k = 0; k < scores.size(); ++k) {
    using binomial = boost::math::binomial;
    const Score& score = scores[k];
    const MeanWithInterval narrowed = mean_with_interval(score.found);
    summary << fmt::format("{},{},{:.3g},{:.3g},{:.2g},{:.4g},{:.4g},{:.4g}\n", asked.keys[k].key, benches,
                           mean_with_interval(score.promised).mean, narrowed.mean, *narrowed.half_width_95,
                           100.0 * score.held / benches,
                           100 * binomial::find_lower_bound_on_p(benches, score.held, 0.025),
                           100 * binomial::find_upper_bound_on_p(benches, score.held, 0.025));
  }
  return out && summary ? 0 : 1;
}
