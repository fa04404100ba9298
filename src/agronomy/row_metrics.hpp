#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "agronomy/drill.hpp"
#include "agronomy/spacings.hpp"
#include "outflow/metrics.hpp"
#include "outflow/outflow.hpp"
#include "outflow/statistics.hpp"
#include "outflow/unevenness.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// How far rows differ. Rows that share a hole count once: how a divider deals out their seeds is not simulated.
struct BetweenRows {
  std::vector<std::int64_t> seeds;                        // of each stream in the window
  std::vector<double> mass;                               // kg, likewise
  std::vector<std::vector<std::int64_t>> seeds_in_block;  // by block of the window, then by stream
  std::optional<double> raw_cv;                           // fraction; of the seeds, chance included
  std::optional<double> mass_cv;  // fraction; of the masses as they are, as ISO 7256-2 weighs what rows give
};

/// As `unevenness_of` of runs: by all replicates together; of one, by its blocks.
std::optional<Unevenness> unevenness_of(const std::vector<const BetweenRows*>& replicates);

/// Why there are no spacings.
enum class NoSpacings { none, plane_slice, shared_hole, few_seeds };

/// What a row of a drill gets in the measuring window. Rates are of the whole tray, in 2D the slice's times the
/// depth factor; none without `tray.depth`, or when the run ended before the window.
struct RowMetrics {
  int row = 0;                                                    // 1..; 0: all rows
  std::vector<int> holes;                                         // that feed it, 1..
  std::int64_t seeds = 0;                                         // from these, of the plane slice or in 3D of the tray
  std::optional<double> mass_rate;                                // kg/s; of all rows together
  std::optional<double> seeds_per_s;                              // likewise
  std::optional<double> kg_per_m2;                                // of all rows: of the whole width
  std::optional<double> seeds_per_m2;                             // likewise
  std::optional<double> instability_cv, instability_counting_cv;  // fractions; over time, and by counting alone
  std::optional<double> longest_pause;                            // s, of the holes; of all rows: the longest of any
  std::optional<SpacingMetrics> spacing;                          // of all rows: each spacing beside its own reference
  std::optional<double> poisson_multiples, poisson_skips;         // of a Poisson stream as dense, beside the same
  NoSpacings without_spacing = NoSpacings::none;
  std::optional<BetweenRows> between;  // of all rows
};

/// What a run is to a drill: by row, then all rows.
struct DrillMetrics {
  Drill drill;
  std::vector<RowMetrics> rows;
  const RowMetrics& all() const { return rows.back(); }
};

/// `outflow`: `measure_outflow` of that scene and run. Throws std::invalid_argument for a drill of another number of
/// holes than the tray's.
DrillMetrics drill_metrics(const Scene& scene, const Run& run, const Outflow& outflow, const Drill& drill);

/// What figures of a row are taken from: a run; or of replicates the first, with what the seeds of all say of the rows.
struct RowSource {
  const RowMetrics& row;
  std::optional<double> raw_cv{}, mass_cv{};
  std::optional<Unevenness> unevenness{};
};

/// A number of a row, as `Figure` is one of a run.
struct RowMetric {
  std::string_view name;         // of its column, with its unit: "rate_g_per_min"
  std::string_view unit;         // "g/min"; empty for a plain number
  double unit_size;              // of that unit, in SI
  std::string_view description;  // a clause without a full stop
  std::optional<double> (*of)(const RowSource&);
  Metric::Kind kind = Metric::Kind::mean;
  bool is_pooled() const { return kind == Metric::Kind::pooled; }
};

/// All figures of a row, in the order of rows.csv.
std::span<const RowMetric> row_metrics();

/// The figure of a name; throws std::invalid_argument for a name that is none.
const RowMetric& row_metric_named(std::string_view name);

/// A row over the replicates.
struct RowMeans {
  int row = 0;  // 0: all rows
  std::vector<int> holes;
  NoSpacings without_spacing = NoSpacings::none;  // of the first
  std::vector<std::optional<MeanWithInterval>> means;
  const std::optional<MeanWithInterval>& operator[](std::string_view name) const;
};

/// Of replicates with one drill, in SI, each over those that have a finite value; by row, then all rows. Empty for no
/// replicate.
std::vector<RowMeans> row_means(const std::vector<const DrillMetrics*>& replicates);

}  // namespace vibrosow
