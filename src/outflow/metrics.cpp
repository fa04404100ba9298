#include "outflow/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

using Value = std::optional<double>;

constexpr double percent = 1e-2;

const HoleOutflow& whole(const Outflow& outflow) {
  return *find_row(outflow, "all", "all");
}

Value of_tray(const Outflow& outflow, double of_slice) {
  return outflow.depth_factor ? Value(of_slice * *outflow.depth_factor) : Value();
}

template <class Get>
Value of_unevenness(const MetricSource& source, Get get) {
  return source.unevenness ? Value(get(*source.unevenness)) : Value();
}

using Source = const MetricSource&;

constexpr std::array table = {
    Metric{"rate_g_per_s", "g/s", "g/s", gram,
           "mass flow through all holes, of the 2D slice or in 3D of the tray, in the window",
           [](Source s) { return Value(whole(s.outflow).mass_rate); }, Metric::Kind::rate},
    Metric{"seeds_per_s", "seeds/s", "1/s", 1,
           "seeds through all holes, of the 2D slice or in 3D of the tray, in the window",
           [](Source s) { return Value(whole(s.outflow).seeds_per_s); }, Metric::Kind::rate},
    Metric{"depth_factor", "factor", "", 1,
           "tray.depth over the thickness of the 2D slice, by which its rates are multiplied; in 3D 1; empty without "
           "tray.depth",
           [](Source s) { return s.outflow.depth_factor; }, Metric::Kind::pooled},
    Metric{"tray_rate_g_per_s", "tray g/s", "g/s", gram, "mass flow of the whole tray; empty without tray.depth",
           [](Source s) { return of_tray(s.outflow, whole(s.outflow).mass_rate); }, Metric::Kind::rate},
    Metric{"tray_rate_g_per_min", "tray g/min", "g/min", gram / 60, "the same per minute",
           [](Source s) { return of_tray(s.outflow, whole(s.outflow).mass_rate); }, Metric::Kind::rate},
    Metric{"tray_seeds_per_s", "tray seeds/s", "1/s", 1, "seeds of the whole tray; empty without tray.depth",
           [](Source s) { return of_tray(s.outflow, whole(s.outflow).seeds_per_s); }, Metric::Kind::rate},
    Metric{"raw_cv_percent", "raw CV %", "%", percent,
           "coefficient of variation of the seeds of the holes, all replicates together",
           [](Source s) { return s.raw_cv; }, Metric::Kind::pooled},
    Metric{"run_cv_percent", "CV of a run %", "%", percent,
           "the same of the seeds of a single run, in which chance weighs more",
           [](Source s) { return s.outflow.raw_cv; }},
    Metric{"chance_cv_percent", "chance %", "%", percent, "what of the raw one holes of equal rates would show",
           [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.chance_cv; }); },
           Metric::Kind::pooled},
    Metric{"unevenness_cv_percent", "unevenness (CV) %", "%", percent,
           "coefficient of variation of the holes' rates without chance; empty: no difference beyond chance (F test of "
           "holes against replicates, of one run against its blocks)",
           [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.cv; }); }, Metric::Kind::pooled},
    Metric{"unevenness_cv_percent_low", "low", "%", percent, "lower end of its 95 % interval",
           [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.low; }); }, Metric::Kind::pooled},
    Metric{"unevenness_cv_percent_high", "high", "%", percent, "upper end: what it may be up to where it is empty",
           [](Source s) { return of_unevenness(s, [](const Unevenness& u) { return u.high; }); }, Metric::Kind::pooled},
    Metric{
        "instability_cv_percent", "instability CV %", "%", percent,
        "coefficient of variation of the whole outflow over about ten equal parts of the window, whole periods of the "
        "drive",
        [](Source s) { return s.outflow.instability_cv; }},
    Metric{"longest_pause_s", "pause s", "s", 1, "longest time in the window in which no seed came from any hole",
           [](Source s) { return Value(whole(s.outflow).longest_pause); }},
    Metric{"spilled_percent", "spilled %", "%", percent,
           "seeds that left over the rim, of all that left the tray in the whole run",
           [](Source s) { return Value(s.outflow.spilled_fraction); }},
};

MetricSource together(const std::vector<const Outflow*>& replicates) {
  std::vector<std::vector<std::int64_t>> counts;
  for (const Outflow* one : replicates) counts.push_back(one->grains_of_hole);
  return {*replicates.front(), raw_cv(sum_of_parts(counts)), unevenness_of(replicates)};
}

}  // namespace

std::span<const Metric> metrics() {
  return table;
}

const Metric& metric_named(std::string_view name) {
  const auto found = std::ranges::find(table, name, &Metric::name);
  if (found == table.end()) throw std::invalid_argument("there is no figure named " + std::string(name));
  return *found;
}

MetricMeans::MetricMeans(const std::vector<const Outflow*>& replicates) {
  if (replicates.empty()) return;
  const MetricSource all = together(replicates);
  for (std::size_t i = 0; i < table.size(); ++i) {
    std::vector<CountedRate> values;
    const auto add = [&](const MetricSource& source) {
      const Value value = table[i].of(source);
      if (!value || !std::isfinite(*value)) return;
      values.push_back({*value, table[i].kind == Metric::Kind::rate ? source.outflow.seeds() : 0});
    };
    if (table[i].is_pooled())
      add(all);
    else
      for (const Outflow* one : replicates) add({*one});
    if (!values.empty()) means_[i] = mean_of_rates(values);
  }
}

const std::optional<MeanWithInterval>& MetricMeans::operator[](const Metric& metric) const {
  return means_.at(static_cast<std::size_t>(&metric - table.data()));
}

}  // namespace vibrosow
