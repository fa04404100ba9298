#include "agronomy/row_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>

#include "outflow/flow.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

using Value = std::optional<double>;

constexpr double percent = 1e-2;

/// What the holes of a row, or of several that share them, gave in the window.
struct Stream {
  std::vector<int> holes;
  std::vector<double> times;  // s
  double mass = 0;            // kg
};

std::vector<Stream> streams_of(const Run& run, const Outflow& outflow, const Drill& drill) {
  std::vector<Stream> streams(static_cast<std::size_t>(drill.streams()));
  for (std::size_t hole = 0; hole < drill.hole_to_row.size(); ++hole)
    streams.at(drill.stream_of(hole)).holes.push_back(static_cast<int>(hole) + 1);
  for (const OutflowEvent& event : run.events) {
    if (event.hole < 1 || event.time < outflow.window.from || event.time > outflow.window.to) continue;
    Stream& stream = streams[drill.stream_of(static_cast<std::size_t>(event.hole - 1))];
    stream.times.push_back(event.time);
    stream.mass += event.mass;
  }
  return streams;
}

Stream together(const std::vector<Stream>& streams) {
  Stream all;
  for (const Stream& one : streams) {
    all.holes.insert(all.holes.end(), one.holes.begin(), one.holes.end());
    all.times.insert(all.times.end(), one.times.begin(), one.times.end());
    all.mass += one.mass;
  }
  std::ranges::sort(all.holes);
  std::ranges::sort(all.times);
  return all;
}

double longest_pause(const std::vector<double>& times, double from, double to) {
  double longest = 0;
  for (const Pause& pause : pauses(times, from, to, 0)) longest = std::max(longest, pause.length());
  return longest;
}

/// `rows`: that get this in equal parts; `shown`: of these, whose rates are told together.
RowMetrics metrics_of(const Stream& stream, const Outflow& outflow, const Drill& drill, int rows, int shown) {
  RowMetrics metrics;
  metrics.holes = stream.holes;
  metrics.seeds = static_cast<std::int64_t>(stream.times.size());
  const double length = outflow.window.length();
  if (length <= 0) return metrics;
  if (outflow.depth_factor) {
    const double of_a_row = *outflow.depth_factor / length / rows;
    const double mass_rate = stream.mass * of_a_row, seeds_per_s = static_cast<double>(metrics.seeds) * of_a_row;
    metrics.mass_rate = mass_rate * shown, metrics.seeds_per_s = seeds_per_s * shown;
    metrics.kg_per_m2 = sowing_rate(mass_rate, drill.pace);
    metrics.seeds_per_m2 = sowing_rate(seeds_per_s, drill.pace);
  }
  if (const auto of_row = instability(stream.times, outflow.window))
    metrics.instability_cv = of_row->cv, metrics.instability_counting_cv = of_row->counting_cv;
  metrics.longest_pause = longest_pause(stream.times, outflow.window.from, outflow.window.to);
  return metrics;
}

NoSpacings why_no_spacings(const Scene& scene, const Drill& drill) {
  if (scene.space == Space::two_dimensional) return NoSpacings::plane_slice;
  return drill.rows_per_hole > 1 ? NoSpacings::shared_hole : NoSpacings::none;
}

void add_spacings(RowMetrics& metrics, const std::vector<Spacing>& spacings, const Drill& drill, NoSpacings why) {
  metrics.without_spacing = why;
  if (why != NoSpacings::none) return;
  metrics.spacing = spacing_metrics(spacings, drill.limits);
  if (!metrics.spacing) {
    metrics.without_spacing = NoSpacings::few_seeds;
    return;
  }
  const double reference = metrics.spacing->reference / metrics.spacing->mean;
  metrics.poisson_multiples = poisson_multiples(drill.limits, reference);
  metrics.poisson_skips = poisson_skips(drill.limits, reference);
}

BetweenRows between_rows(const std::vector<Stream>& streams, const MeasuringWindow& window) {
  BetweenRows between;
  std::vector<std::vector<std::int64_t>> blocks;  // by stream
  for (const Stream& one : streams) {
    between.seeds.push_back(static_cast<std::int64_t>(one.times.size()));
    between.mass.push_back(one.mass);
    blocks.push_back(counts_in_blocks(one.times, block_ends(window)));
  }
  between.seeds_in_block = transposed(blocks);
  between.raw_cv = raw_cv(between.seeds);
  between.mass_cv = coefficient_of_variation(between.mass);
  return between;
}

template <class Get>
Value of_spacing(const RowMetrics& row, Get get) {
  return row.spacing ? Value(get(*row.spacing)) : Value();
}

template <class Get>
Value of_unevenness(const RowSource& source, Get get) {
  return source.unevenness ? Value(get(*source.unevenness)) : Value();
}

using Source = const RowSource&;
using Spaced = const SpacingMetrics&;

constexpr std::array table = {
    RowMetric{"rate_g_per_min", "g/min", gram / 60,
              "what the row gets, of the whole tray (in 2D the slice's times the depth factor; empty without "
              "tray.depth); all: the rows together",
              [](Source s) { return s.row.mass_rate; }, Metric::Kind::rate},
    RowMetric{"seeds_per_s", "1/s", 1, "the same in seeds", [](Source s) { return s.row.seeds_per_s; },
              Metric::Kind::rate},
    RowMetric{"kg_per_ha", "kg/ha", kilogram_per_hectare, "that over row spacing and speed; all: of the whole width",
              [](Source s) { return s.row.kg_per_m2; }, Metric::Kind::rate},
    RowMetric{"seeds_per_m2", "1/m2", 1, "the same in seeds", [](Source s) { return s.row.seeds_per_m2; },
              Metric::Kind::rate},
    RowMetric{"instability_cv_percent", "%", percent,
              "coefficient of variation of its seeds over about ten equal parts of the window, whole periods of the "
              "drive; in 2D of the slice's",
              [](Source s) { return s.row.instability_cv; }},
    RowMetric{"instability_counting_percent", "%", percent, "what counting so many independent seeds gives alone",
              [](Source s) { return s.row.instability_counting_cv; }},
    RowMetric{
        "longest_pause_s", "s", 1,
        "longest time in the window without a seed from its holes, in 2D of the slice; all: the longest of any row",
        [](Source s) { return s.row.longest_pause; }},
    RowMetric{"multiples_percent", "%", percent,
              "spacings up to 0.5 of the reference (ISO 7256-1; drill.multiples_below; ISOBUS DDI 419, there in ppm), "
              "at the hole, not in the furrow",
              [](Source s) { return of_spacing(s.row, [](Spaced of) { return of.multiples; }); }},
    RowMetric{"poisson_multiples_percent", "%", percent,
              "what seeds that come independently of each other would have: 39 beside their mean",
              [](Source s) { return s.row.poisson_multiples; }},
    RowMetric{"skips_percent", "%", percent,
              "spacings beyond 1.5 of the reference (ISO 7256-1; drill.skips_above; ISOBUS DDI 417), at the hole, not "
              "in the furrow",
              [](Source s) { return of_spacing(s.row, [](Spaced of) { return of.skips; }); }},
    RowMetric{"poisson_skips_percent", "%", percent,
              "what seeds that come independently of each other would have: 22 beside their mean",
              [](Source s) { return s.row.poisson_skips; }},
    RowMetric{"singulation_percent", "%", percent,
              "the other spacings: quality of feed (ISO 7256-1; ISOBUS DDI 415), at the hole, not in the furrow",
              [](Source s) { return of_spacing(s.row, [](Spaced of) { return of.singles; }); }},
    RowMetric{"precision_percent", "%", percent,
              "standard deviation of these others over the reference (Kachman and Smith 1995)",
              [](Source s) { return s.row.spacing ? s.row.spacing->precision : Value(); }},
    RowMetric{"reference_spacing_mm", "mm", millimetre, "drill.reference_spacing, or else the row's mean spacing",
              [](Source s) { return of_spacing(s.row, [](Spaced of) { return of.reference; }); }},
    RowMetric{"spacing_deviation_mm", "mm", millimetre,
              "mean distance of a spacing from the reference, without sign (ISOBUS DDI 421)",
              [](Source s) { return of_spacing(s.row, [](Spaced of) { return of.deviation; }); }},
    RowMetric{"spacing_cv_percent", "%", percent,
              "coefficient of variation of all spacings (ISOBUS DDI 423); a Poisson stream's is 100",
              [](Source s) { return s.row.spacing ? s.row.spacing->cv : Value(); }},
    RowMetric{
        "mass_cv_percent", "%", percent,
        "all: coefficient of variation between rows of what they weigh, as ISO 7256-2 takes it; rows that share a "
        "hole count once",
        [](Source s) { return s.mass_cv; }, Metric::Kind::pooled},
    RowMetric{"raw_cv_percent", "%", percent, "all: the same of their seeds, all replicates together",
              [](Source s) { return s.raw_cv; }, Metric::Kind::pooled},
    RowMetric{"chance_cv_percent", "%", percent, "all: what of that rows of equal rates would show",
              [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.chance_cv; }); },
              Metric::Kind::pooled},
    RowMetric{"unevenness_cv_percent", "%", percent,
              "all: coefficient of variation of the rows' rates without chance; empty: no difference beyond chance",
              [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.cv; }); },
              Metric::Kind::pooled},
    RowMetric{"unevenness_cv_percent_low", "%", percent, "all: lower end of its 95 % interval",
              [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.low; }); },
              Metric::Kind::pooled},
    RowMetric{"unevenness_cv_percent_high", "%", percent, "all: upper end: what it may be up to where it is empty",
              [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.high; }); },
              Metric::Kind::pooled},
};

RowSource together(const std::vector<const RowMetrics*>& replicates) {
  RowSource all{*replicates.front()};
  if (!all.row.between) return all;
  std::vector<const BetweenRows*> between;
  std::vector<std::vector<std::int64_t>> counts;
  std::vector<double> mass(all.row.between->mass.size(), 0.0);
  for (const RowMetrics* one : replicates) {
    between.push_back(&*one->between);
    counts.push_back(one->between->seeds);
    for (std::size_t k = 0; k < mass.size(); ++k) mass[k] += one->between->mass[k];
  }
  all.raw_cv = raw_cv(sum_of_parts(counts));
  all.mass_cv = coefficient_of_variation(mass);
  all.unevenness = unevenness_of(between);
  return all;
}

RowMeans means_of(const std::vector<const RowMetrics*>& replicates) {
  const RowMetrics& first = *replicates.front();
  const RowSource all = together(replicates);
  RowMeans means{first.row, first.holes, first.without_spacing, {}};
  for (const RowMetric& metric : table) {
    std::vector<CountedRate> values;
    const auto add = [&](const RowSource& source) {
      const Value value = metric.of(source);
      if (!value || !std::isfinite(*value)) return;
      values.push_back({*value, metric.kind == Metric::Kind::rate ? static_cast<double>(source.row.seeds) : 0});
    };
    if (metric.is_pooled())
      add(all);
    else
      for (const RowMetrics* one : replicates) add({*one});
    means.means.push_back(values.empty() ? std::nullopt : std::optional(mean_of_rates(values)));
  }
  return means;
}

}  // namespace

DrillMetrics drill_metrics(const Scene& scene, const Run& run, const Outflow& outflow, const Drill& drill) {
  if (drill.hole_to_row.size() != scene.tray.holes.size())
    throw std::invalid_argument("the drill is of a tray with another number of holes");
  const std::vector<Stream> streams = streams_of(run, outflow, drill);
  const NoSpacings why = why_no_spacings(scene, drill);
  DrillMetrics result{drill, {}};
  std::vector<Spacing> spacings;
  for (const Stream& stream : streams) {
    const std::vector<Spacing> of_row = spacings_of(stream.times, drill.pace.speed, drill.reference_spacing);
    spacings.insert(spacings.end(), of_row.begin(), of_row.end());
    RowMetrics metrics = metrics_of(stream, outflow, drill, drill.rows_per_hole, 1);
    add_spacings(metrics, of_row, drill, why);
    for (int k = 0; k < drill.rows_per_hole; ++k) {
      metrics.row = static_cast<int>(result.rows.size()) + 1;
      result.rows.push_back(metrics);
    }
  }
  RowMetrics all = metrics_of(together(streams), outflow, drill, drill.rows(), drill.rows());
  add_spacings(all, spacings, drill, why);
  for (const RowMetrics& row : result.rows)
    if (all.longest_pause) all.longest_pause = std::max(*all.longest_pause, row.longest_pause.value_or(0));
  all.between = between_rows(streams, outflow.window);
  result.rows.push_back(std::move(all));
  return result;
}

std::optional<Unevenness> unevenness_of(const std::vector<const BetweenRows*>& replicates) {
  if (replicates.size() == 1) return unevenness(replicates.front()->seeds_in_block);
  std::vector<std::vector<std::int64_t>> counts;
  for (const BetweenRows* one : replicates) counts.push_back(one->seeds);
  return unevenness(counts);
}

std::span<const RowMetric> row_metrics() {
  return table;
}

const RowMetric& row_metric_named(std::string_view name) {
  const auto found = std::ranges::find(table, name, &RowMetric::name);
  if (found == table.end()) throw std::invalid_argument("there is no figure of a row named " + std::string(name));
  return *found;
}

const std::optional<MeanWithInterval>& RowMeans::operator[](std::string_view name) const {
  return means.at(static_cast<std::size_t>(&row_metric_named(name) - table.data()));
}

std::vector<RowMeans> row_means(const std::vector<const DrillMetrics*>& replicates) {
  std::vector<RowMeans> rows;
  for (std::size_t row = 0; !replicates.empty() && row < replicates.front()->rows.size(); ++row) {
    std::vector<const RowMetrics*> of_row;
    for (const DrillMetrics* one : replicates) of_row.push_back(&one->rows.at(row));
    rows.push_back(means_of(of_row));
  }
  return rows;
}

}  // namespace vibrosow
