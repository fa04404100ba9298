#include "study/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "outflow/misfit.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

Discharge discharge_of(MeasuredQuantity quantity) {
  switch (quantity) {
    case MeasuredQuantity::mass_curve:
      return Discharge::mass;
    case MeasuredQuantity::seed_curve:
      return Discharge::seeds;
    default:
      return Discharge::fraction;
  }
}

/// One measured series with what every finished replicate of a layout gave, before scaling.
struct Pairing {
  const MeasuredMatch* match;
  const MeasuredSeries* series;
  std::vector<double> times;                   // s, within the run; empty for a rate
  std::vector<double> measured;                // one for each time; a single one for a rate
  std::vector<std::vector<double>> simulated;  // of each replicate, as `measured`
  double depth_factor = 1;
  /// Over the replicates, one of them left out if that is asked for.
  std::vector<double> means(std::optional<std::size_t> without = {}) const {
    std::vector<double> result(measured.size(), 0.0);
    const auto count = static_cast<double>(simulated.size() - (without ? 1 : 0));
    for (std::size_t replicate = 0; replicate < simulated.size(); ++replicate)
      for (std::size_t i = 0; replicate != without && i < measured.size(); ++i)
        result[i] += simulated[replicate][i] / count;
    return result;
  }
};

/// The time of the run (s) at which a measured curve's time is zero.
double curve_zero(const MeasuredPart& part, const Scene& scene) {
  const auto first = std::ranges::min_element(scene.tray.holes, {}, &Hole::open_at);
  return part.time_zero.value_or(first != scene.tray.holes.end() ? first->open_at : 0);
}

double simulated_rate(const Evaluation& replicate, MeasuredQuantity quantity, const MeasuredSeries& series) {
  const HoleOutflow* row = find_row(replicate.outflow, series.hole, series.lot);
  if (!row) throw std::logic_error("a measured hole that the layout has not");
  return quantity == MeasuredQuantity::mass_rate ? row->mass_rate : row->seeds_per_s;
}

/// What has left since the curve's zero.
std::vector<double> simulated_curve(const Evaluation& replicate, const CurveRequest& request) {
  const auto curve = std::ranges::find(replicate.curves, request, &Curve::request);
  if (curve == replicate.curves.end()) throw std::logic_error("a measured curve that was not evaluated");
  std::vector<double> values(curve->values.begin(), curve->values.end() - 1);
  for (double& value : values) value -= curve->values.back();
  return values;
}

Pairing pair_up(const StudyResult& result, const MeasuredMatch& match) {
  const MeasuredPart& part = *result.study.measured;
  const std::size_t scene = *result.study.layouts[match.layout].scene;
  const bool curve = is_curve(part.table.quantity);
  Pairing pairing;
  pairing.match = &match;
  pairing.series = &part.table.series[match.series];
  if (curve) pairing.times = pairing.series->times;
  for (const MeanWithInterval& value : pairing.series->values) pairing.measured.push_back(value.mean);
  for (const Evaluation& replicate : result.runs[scene]) {
    if (!replicate.finished() || is_left_out(result.study, replicate)) continue;
    pairing.simulated.push_back(simulated_values(replicate, part, *pairing.series, result.study.scenes[scene]));
    if (part.scale == MeasuredScale::depth) pairing.depth_factor = replicate.outflow.depth_factor.value();
  }
  return pairing;
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// One factor over every row of every layout.
std::optional<double> fitted_scale(const std::vector<Pairing>& pairings, bool curve) {
  std::vector<double> simulated, measured;
  for (const Pairing& pairing : pairings) {
    append(simulated, pairing.means());
    append(measured, pairing.measured);
  }
  return curve ? best_curve_scale(simulated, measured) : best_rate_scale(simulated, measured);
}

std::vector<double> scaled(std::vector<double> values, double scale) {
  for (double& value : values) value *= scale;
  return values;
}

/// Of one choice of simulated values for each pairing. Rates: over all rows; curves: each against its own largest
/// value, then root mean square over the curves, each weighed with its number of times.
template <typename Simulated>
std::optional<double> misfit(const std::vector<const Pairing*>& pairings, bool curve, Simulated simulated_of) {
  std::vector<double> simulated, measured;
  double squares = 0, count = 0;
  for (const Pairing* pairing : pairings) {
    append(simulated, simulated_of(*pairing));
    append(measured, pairing->measured);
    if (!curve) continue;
    const auto of_curve = curve_misfit_percent(simulated, measured);
    if (!of_curve) return std::nullopt;
    squares += *of_curve * *of_curve * static_cast<double>(measured.size());
    count += static_cast<double>(measured.size());
    simulated.clear();
    measured.clear();
  }
  if (!curve) return rate_misfit_percent(simulated, measured);
  return count > 0 ? std::optional(std::sqrt(squares / count)) : std::nullopt;
}

/// Misfit of the mean outflow; its interval by the jackknife (Quenouille 1956, Biometrika 43): from the misfits of the
/// means that leave out one replicate each.
std::optional<MeanWithInterval> layout_misfit(const std::vector<const Pairing*>& pairings, bool curve, double scale) {
  const auto of_means = [&](std::optional<std::size_t> without) {
    return misfit(pairings, curve,
                  [&](const Pairing& pairing) { return scaled(pairing.means(without), scale * pairing.depth_factor); });
  };
  const auto of_all = of_means(std::nullopt);
  if (!of_all) return std::nullopt;
  const std::size_t replicates = pairings.front()->simulated.size();
  const auto count = static_cast<double>(replicates);
  std::vector<double> pseudo;  // values, as if of single replicates
  for (std::size_t i = 0; replicates > 1 && i < replicates; ++i)
    if (const auto one = of_means(i)) pseudo.push_back(count * *of_all - (count - 1) * *one);
  return MeanWithInterval{*of_all, mean_with_interval(pseudo).half_width_95};
}

void add_rows(Comparison& comparison, const Pairing& pairing, double scale) {
  for (std::size_t i = 0; i < pairing.measured.size(); ++i) {
    std::vector<double> values;
    for (const auto& one : pairing.simulated) values.push_back(one[i] * scale);
    comparison.rows.push_back({pairing.match->layout, pairing.series->hole, pairing.series->lot,
                               pairing.times.empty() ? std::nullopt : std::optional(pairing.times[i]),
                               pairing.measured[i], mean_with_interval(values)});
  }
}

/// The measured rate beside the hole it was measured at.
void set_measured_rate(LayoutResult& layout, const Pairing& pairing, double scale, const Outflow& rows) {
  const HoleOutflow* row = find_row(rows, pairing.series->hole, pairing.series->lot);
  for (HoleMetrics& metrics : layout.holes) {
    if (!row || metrics.hole != row->hole || metrics.lot != row->lot) continue;
    metrics.measured = pairing.series->values.front();
    metrics.difference_percent = 100 * (pairing.means().front() * scale / pairing.measured.front() - 1);
  }
}

const Outflow& a_finished_outflow(const std::vector<Evaluation>& replicates) {
  return std::ranges::find_if(replicates, &Evaluation::finished)->outflow;
}

bool has_hole_and_lot(const Scene& scene, const MeasuredSeries& series) {
  const bool hole = series.hole == "all" || std::stoul(series.hole) <= scene.tray.holes.size();
  const bool lot = series.lot == "all" || std::ranges::find(scene.lots, series.lot, &SeedLot::name) != scene.lots.end();
  return hole && lot;
}

/// Whether all seeds are there from the start, so that a share of them is one of a fill.
bool empties_a_fill(const Scene& scene) {
  const auto is_fed = [](const Vessel& vessel) { return vessel.rain || is_kept(vessel); };
  if (is_fed(scene.tray) || (scene.hopper && is_fed(*scene.hopper))) return false;
  return scene.tray.fill || (scene.hopper && scene.hopper->fill);
}

}  // namespace

void check_measurable(const MeasuredPart& part, const MeasuredSeries& series, const Scene& scene,
                      const std::string& whose) {
  if (!has_hole_and_lot(scene, series))
    throw InputError(
        fmt::format("{}: hole {}, lot {}: {} has no such hole or lot", series.where, series.hole, series.lot, whose));
  if (part.table.quantity == MeasuredQuantity::fraction_curve && !empties_a_fill(scene))
    throw InputError(
        fmt::format("{}: discharged_percent is of a fill that empties, and {} has none, or is fed; expected mass_g or "
                    "seeds",
                    series.where, whose));
  if (series.times.empty()) return;
  const double zero = curve_zero(part, scene), last = series.times.back();
  if (last + zero <= scene.run.duration * (1 + 1e-9)) return;
  throw InputError(
      fmt::format("{}: time_s: was read up to {:g} s, and the run ends {:g} s after the curve's time zero; run longer "
                  "(run.duration), or leave these rows out",
                  series.where, last, scene.run.duration - zero));
}

CurveRequest curve_request(const MeasuredPart& part, const MeasuredSeries& series, const Scene& scene) {
  CurveRequest request{discharge_of(part.table.quantity), series.hole, series.lot, {}};
  const double zero = curve_zero(part, scene);
  for (const double time : series.times) request.times.push_back(time + zero);
  request.times.push_back(zero);
  return request;
}

std::vector<double> simulated_values(const Evaluation& run, const MeasuredPart& part, const MeasuredSeries& series,
                                     const Scene& scene) {
  if (is_curve(part.table.quantity)) return simulated_curve(run, curve_request(part, series, scene));
  return {simulated_rate(run, part.table.quantity, series)};
}

std::vector<CurveRequest> measured_curves(const Study& study, std::size_t scene) {
  std::vector<CurveRequest> requests;
  if (!study.measured || !is_curve(study.measured->table.quantity)) return requests;
  for (const MeasuredMatch& match : study.measured->matches)
    if (study.layouts[match.layout].scene == scene)
      requests.push_back(
          curve_request(*study.measured, study.measured->table.series[match.series], study.scenes[scene]));
  return requests;
}

void compare_with_measured(StudyResult& result) {
  const MeasuredPart& part = *result.study.measured;
  const bool curve = is_curve(part.table.quantity);
  std::vector<Pairing> pairings;
  for (const MeasuredMatch& match : part.matches) {
    if (result.layouts[match.layout].status == LayoutStanding::outside_the_model) continue;
    Pairing pairing = pair_up(result, match);
    if (!pairing.simulated.empty() && !pairing.measured.empty()) pairings.push_back(std::move(pairing));
  }

  Comparison comparison;
  if (part.scale == MeasuredScale::none) comparison.scale = 1;
  if (part.scale == MeasuredScale::free) comparison.scale = fitted_scale(pairings, curve);
  const double scale = comparison.scale.value_or(1);

  std::vector<const Pairing*> all;
  std::vector<std::vector<const Pairing*>> of_layout(result.layouts.size());
  for (const Pairing& pairing : pairings) {
    const double factor = scale * pairing.depth_factor;
    const std::size_t layout = pairing.match->layout;
    all.push_back(&pairing);
    of_layout[layout].push_back(&pairing);
    add_rows(comparison, pairing, factor);
    if (!curve)
      set_measured_rate(result.layouts[layout], pairing, factor,
                        a_finished_outflow(result.runs[*result.study.layouts[layout].scene]));
  }
  for (std::size_t layout = 0; layout < result.layouts.size(); ++layout)
    if (!of_layout[layout].empty())
      result.layouts[layout].misfit_percent = layout_misfit(of_layout[layout], curve, scale);
  if (!all.empty())
    comparison.misfit_percent = misfit(
        all, curve, [&](const Pairing& pairing) { return scaled(pairing.means(), scale * pairing.depth_factor); });
  result.comparison = std::move(comparison);
}

}  // namespace vibrosow
