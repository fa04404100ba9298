// How often the 95 % intervals of `vibrosow calibrate` hold: 400 calibrations of truths that are known, served from one
// pool of runs. Each truth is a run of the pool that the calibration does not see, read off with noise; 60 others of
// the pool are what it is given. Usage: calibration_coverage SEEDER.toml POOL.csv COVERAGE.csv; makes the pool where
// there is none.

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "grains/random.hpp"
#include "input/csv_lines.hpp"
#include "plan/model.hpp"
#include "study/many_runs.hpp"

namespace {

using namespace vibrosow;

constexpr int pool_runs = 300, truths = 400, runs_given = 60;
constexpr double reading_noise = 0.01;                                     // of what is on the tray
const std::vector<double> times{0.1, 0.25, 0.4, 0.6, 0.8, 1.0, 1.3, 1.6};  // s

CalibrationTask task_of(const std::filesystem::path& seeder) {
  CalibrationTask task;
  task.seeder = seeder;
  for (const char* key :
       {"contact.friction=0.1..0.8", "contact.rolling_friction=0..0.3", "contact.restitution=0.2..0.9"})
    task.keys.push_back(parse_fitted_key(key));
  task.measured.table.quantity = MeasuredQuantity::fraction_curve;
  task.measured.time_zero = 0;
  MeasuredSeries series;
  series.times = times;
  series.values.assign(times.size(), {1, std::nullopt});
  series.repeats.assign(times.size(), 1);
  task.measured.table.series.push_back(series);
  task.most_runs = pool_runs;
  return task;
}

/// Curves of all runs of the design, as a CSV file with the runs' keys.
void make_pool(const CalibrationTask& task, const CalibrationDesign& design, const std::filesystem::path& file) {
  StudyRuns kept(std::filesystem::temp_directory_path() / "vibrosow-calibration-coverage");
  kept.make(wanted_runs(design), run_model, {});
  const std::vector<ReducedRun> runs = *reduced_runs(task, design, kept.kept());
  std::ofstream out(file);
  out << "point,random_seed";
  for (const KeyRange& key : task.keys) out << ',' << key.key;
  for (const double time : times) out << fmt::format(",percent_at_{:g}_s", time);
  out << '\n';
  for (std::size_t r = 0; r < runs.size(); ++r) {
    out << fmt::format("{},{}", design.runs[r].point, design.runs[r].random_seed);
    for (std::size_t k = 0; k < task.keys.size(); ++k)
      out << fmt::format(",{:.6g}", task.keys[k].at(design.points(design.runs[r].point, static_cast<Eigen::Index>(k))));
    for (const double value : runs[r].values) out << fmt::format(",{:.6g}", 100 * value);
    out << '\n';
  }
}

std::vector<ReducedRun> read_pool(const std::filesystem::path& file, std::size_t keys) {
  std::ifstream in(file);
  const CsvLines csv = parse_csv_lines(std::string(std::istreambuf_iterator<char>(in), {}), file.string());
  std::vector<ReducedRun> runs;
  for (const CsvLines::Row& row : csv.rows) {
    ReducedRun run;
    for (std::size_t v = keys + 2; v < row.fields.size(); ++v)
      run.values.push_back(csv_number(row.fields[v], false).value() / 100);
    runs.push_back(run);
  }
  return runs;
}

/// What became of one key over all truths.
struct Score {
  int covered = 0;
  double contraction = 0;
};

/// Of `runs`, those that the calibration of a truth is given: drawn from the others, none at the truth's own point.
std::vector<ReducedRun> given(const CalibrationDesign& design, std::vector<ReducedRun> runs, std::size_t truth,
                              Random& random) {
  const auto point_of = [&](std::size_t run) { return design.points.row(design.runs[run].point); };
  std::vector<std::size_t> others;
  for (std::size_t r = 0; r < runs.size(); ++r)
    if (runs[r].reason.empty() && point_of(r) != point_of(truth)) others.push_back(r);
  for (std::size_t i = others.size(); i > 1; --i) std::swap(others[i - 1], others[random.below(i)]);
  for (ReducedRun& run : runs) run.reason = "not drawn";
  for (int k = 0; k < runs_given; ++k) runs[others[static_cast<std::size_t>(k)]].reason.clear();
  return runs;
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 4) {
    std::cerr << "usage: calibration_coverage SEEDER.toml POOL.csv COVERAGE.csv\n";
    return 2;
  }
  CalibrationTask task = task_of(arguments[1]);
  const CalibrationDesign design = design_calibration(task, std::make_shared<SourceFiles>());
  if (!std::filesystem::exists(arguments[2])) make_pool(task, design, arguments[2]);
  std::vector<ReducedRun> pool = read_pool(arguments[2], task.keys.size());
  leave_out_clogged(task, design, pool);
  CalibrationChoices choices;
  choices.noise = reading_noise;
  choices.points = 4096;
  Random random(20261123);
  const boost::math::normal normal;
  std::vector<Score> scores(task.keys.size());
  int unlikely = 0;
  std::vector<std::size_t> flowing;
  for (std::size_t r = 0; r < pool.size(); ++r)
    if (pool[r].reason.empty()) flowing.push_back(r);
  for (int k = 0; k < truths; ++k) {
    const std::size_t truth = flowing[static_cast<std::size_t>(k) % flowing.size()];
    MeasuredSeries& series = task.measured.table.series.front();
    for (std::size_t v = 0; v < times.size(); ++v)
      series.values[v].mean =
          pool[truth].values[v] + reading_noise * quantile(normal, 1e-9 + (1 - 2e-9) * random.uniform());
    const Calibration calibration = calibrate(task, design, choices, given(design, pool, truth, random));
    if (calibration.misfit_probability < 0.01) ++unlikely;
    for (std::size_t key = 0; key < task.keys.size(); ++key) {
      const double true_value =
          task.keys[key].at(design.points(design.runs[truth].point, static_cast<Eigen::Index>(key)));
      const FittedValue& value = calibration.values[key];
      if (value.low <= true_value && true_value <= value.high) ++scores[key].covered;
      scores[key].contraction += value.contraction / truths;
    }
  }
  std::ofstream out(arguments[3]);
  out << "key,truths,covered_percent,low_percent,high_percent,mean_contraction_percent\n";
  for (std::size_t key = 0; key < task.keys.size(); ++key) {
    using binomial = boost::math::binomial;
    const double covered = scores[key].covered;
    out << fmt::format("{},{},{:.4g},{:.4g},{:.4g},{:.4g}\n", task.keys[key].key, truths, 100 * covered / truths,
                       100 * binomial::find_lower_bound_on_p(truths, covered, 0.025),
                       100 * binomial::find_upper_bound_on_p(truths, covered, 0.025), 100 * scores[key].contraction);
  }
  std::cerr << fmt::format("{} of {} truths were called a misfit; {} of {} runs flowed\n", unlikely, truths,
                           flowing.size(), pool.size());
  return out ? 0 : 1;
}
