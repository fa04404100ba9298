#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "agronomy/row_metrics.hpp"
#include "outflow/metrics.hpp"
#include "outflow/statistics.hpp"
#include "study/expected_rate.hpp"
#include "study/layout_standing.hpp"
#include "study/many_runs.hpp"
#include "study/study.hpp"

namespace vibrosow {

/// Is given the runs that count of each scene, in order, when they are there. They are dropped then, unless measured
/// outflow is to be compared with them, so that memory does not grow with their number.
using OnRuns = std::function<void(std::size_t scene, const std::vector<Evaluation>&)>;

struct SweepOptions {
  std::uint64_t first_random_seed = 1;  // replicates use this one and those that follow
  std::vector<int> replicates{};        // of each of Study::scenes; empty: what the study begins with
  OnRuns on_runs{};
  ManyRunsOptions runs;
};

/// One hole and lot, over the finished replicates.
struct HoleMetrics {
  std::string hole, lot;
  std::optional<double> centre, across, width;  // m; `across` in 3D alone
  std::optional<MeanWithInterval> seeds_per_s;
  std::optional<MeanWithInterval> mass_rate;      // kg/s
  std::optional<MeanWithInterval> longest_pause;  // s
  std::optional<MeanWithInterval> measured;       // SI; of a table of rates
  std::optional<double> difference_percent;       // (simulated scale - measured) / measured
};

/// The bed at a record time, over the finished replicates.
struct BedMetrics {
  std::size_t record;  // index in Record::times
  double time;         // s, as asked for
  std::optional<MeanWithInterval> packing;
  std::optional<MeanWithInterval> packing_change;            // since the first record
  std::vector<std::optional<MeanWithInterval>> segregation;  // by lot
};

struct LayoutResult {
  LayoutStanding status = LayoutStanding::ok;
  std::string reason;                              // why it is invalid, stopped or incomplete
  std::vector<CountedDoubt> doubts;                // of its runs where none of these is so, and of its scene
  int replicates = 0;                              // finished
  int stopped_flowing = 0;                         // of all runs, also those that are left out: ended by a pause
  MetricMeans metrics;                             // over the finished replicates
  std::optional<double> chance_of_rate{};          // half width of the rate's 95 % over it
  std::optional<ExpectedRate> expected{};          // of the rate, by `expect_rates`
  std::optional<MeanWithInterval> misfit_percent;  // of the mean outflow; interval by the jackknife
  std::vector<HoleMetrics> holes;
  std::vector<BedMetrics> bed{};  // empty without a record
  std::vector<RowMeans> rows{};   // by row, then all; empty without a drill
};

/// A measured value beside the simulated one, scaled; SI.
struct ComparisonRow {
  std::size_t layout;  // index in Study::layouts
  std::string hole, lot;
  std::optional<double> time;  // s, of a curve
  double measured;
  MeanWithInterval simulated;
};

struct Comparison {
  std::optional<double> scale;           // none: nothing to fit it to, or each layout has its own (depth)
  std::optional<double> misfit_percent;  // over all rows
  std::vector<ComparisonRow> rows;
};

struct StudyResult {
  Study study;
  std::vector<std::vector<Evaluation>> runs;  // of each of Study::scenes, by random seed; those that count, if kept
  std::vector<LayoutResult> layouts;          // of each of Study::layouts
  std::optional<Comparison> comparison;
};

/// Whether a run is in no figure: it clogged, and replicates are by need.
bool is_left_out(const Study& study, const Evaluation& run);

/// Mass rates (kg/s) of runs, as `enough_runs` takes them: none of a run that stopped flowing or did not finish.
std::vector<std::optional<CountedRate>> rates_of(const std::vector<Evaluation>& replicates);

/// What is asked of each run of a scene.
struct WantedOfRuns {
  std::vector<CurveRequest> curves;
  std::vector<Drill> drills;  // of the scene's layouts, each different one once
};
std::vector<WantedOfRuns> wanted_of_runs(const Study& study);

/// Gives the evaluations of scenes from one to before another, by scene and random seed, with what is wanted of them.
using RunsOfScenes = std::function<std::vector<std::vector<Evaluation>>(std::size_t from, std::size_t to)>;

/// What a study comes to by its runs, whoever made them. Where replicates are by need, runs beyond those needed are
/// left out, and figures are of the runs that flowed. A layout of which runs are absent is incomplete.
StudyResult answer_of(const Study& study, const RunsOfScenes& runs, const OnRuns& on_runs = {});

/// What the layouts' rates are expected to be once they are weighed, and the doubts about that: of each in 3D that
/// is compared.
void expect_rates(StudyResult& result, const RateKnowledge& knowledge);

/// Runs every scene of a study with every random seed. The result depends on the study and the first random seed alone,
/// not on the number of threads. An interrupted sweep keeps what was finished.
StudyResult sweep(const Study& study, const Simulator& simulator, const SweepOptions& options);

}  // namespace vibrosow
