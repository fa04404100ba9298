#include "outflow/outflow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/spaces.hpp"

namespace vibrosow {
namespace {

/// Where a row takes its grains from; 0 and -1 stand for all holes and all lots.
struct Selection {
  int hole = 0;
  int lot = -1;
  bool takes(const OutflowEvent& event) const {
    return event.hole > 0 && (hole == 0 || event.hole == hole) && (lot < 0 || event.lot == lot);
  }
};

MeasuringWindow window_of(const Scene& scene, const Run& run) {
  const MeasuringWindow window = measuring_window(scene);
  // The last step of a finished run may end a rounding error short of the duration.
  return run.status == RunStatus::finished && !run.goes_on ? window : window.until(run.end_time);
}

std::vector<OutflowEvent> counted_inside(const std::vector<OutflowEvent>& events, const MeasuringWindow& window) {
  std::vector<OutflowEvent> inside;
  std::ranges::copy_if(events, std::back_inserter(inside), [&](const OutflowEvent& event) {
    return event.hole > 0 && event.time >= window.from && event.time <= window.to;
  });
  return inside;
}

HoleOutflow measure_row(const Scene& scene, const std::vector<OutflowEvent>& events, const MeasuringWindow& window,
                        Selection selection) {
  HoleOutflow row;
  row.hole = selection.hole > 0 ? fmt::format("{}", selection.hole) : "all";
  row.lot = selection.lot >= 0 ? scene.lots[static_cast<std::size_t>(selection.lot)].name : "all";
  if (selection.hole > 0) {
    const Hole& hole = scene.tray.holes[static_cast<std::size_t>(selection.hole - 1)];
    row.centre = hole.centre;
    row.width = hole.width;
    if (scene.space == Space::three_dimensional) row.across = hole.across;
  }
  if (window.empty()) {
    row.seeds_per_s = row.mass_rate = row.longest_pause = std::numeric_limits<double>::quiet_NaN();
    return row;
  }
  double last = window.from;
  for (const OutflowEvent& event : events) {
    if (!selection.takes(event)) continue;
    ++row.grains;
    row.mass += event.mass;
    row.longest_pause = std::max(row.longest_pause, event.time - last);
    last = event.time;
  }
  row.longest_pause = std::max(row.longest_pause, window.to - last);
  row.seeds_per_s = static_cast<double>(row.grains) / window.length();
  row.mass_rate = row.mass / window.length();
  return row;
}

std::vector<HoleOutflow> measure_rows(const Scene& scene, const std::vector<OutflowEvent>& events,
                                      const MeasuringWindow& window) {
  const int holes = static_cast<int>(scene.tray.holes.size());
  const int lots = static_cast<int>(scene.lots.size());
  std::vector<HoleOutflow> rows;
  const auto add = [&](int hole, int lot) { rows.push_back(measure_row(scene, events, window, {hole, lot})); };
  for (int hole = 1; hole <= holes; ++hole) {
    for (int lot = 0; lot < lots; ++lot) add(hole, lot);
    if (lots > 1) add(hole, -1);
  }
  if (lots > 1)
    for (int lot = 0; lot < lots; ++lot) add(0, lot);
  add(0, -1);
  return rows;
}

std::vector<std::int64_t> grains_of_holes(const Scene& scene, const std::vector<OutflowEvent>& events) {
  std::vector<std::int64_t> grains(scene.tray.holes.size(), 0);
  for (const OutflowEvent& event : events) ++grains.at(static_cast<std::size_t>(event.hole - 1));
  return grains;
}

std::vector<std::vector<std::int64_t>> grains_in_blocks(const Scene& scene, const std::vector<OutflowEvent>& events,
                                                        const std::vector<double>& ends) {
  std::vector<std::vector<double>> times(scene.tray.holes.size());
  for (const OutflowEvent& event : events) times.at(static_cast<std::size_t>(event.hole - 1)).push_back(event.time);
  std::vector<std::vector<std::int64_t>> of_hole;
  for (const std::vector<double>& one : times) of_hole.push_back(counts_in_blocks(one, ends));
  return transposed(of_hole);
}

std::vector<double> times_of(const std::vector<OutflowEvent>& events) {
  std::vector<double> times;
  for (const OutflowEvent& event : events) times.push_back(event.time);
  return times;
}

std::optional<double> depth_factor(const Scene& scene) {
  return scene.space == Space::three_dimensional ? std::optional(1.0) : slices_of_tray(scene);
}

/// What the tray holds at the window's end, of what it held when it began, below which the rate is not that of a full
/// tray.
constexpr double drained_fraction = 0.5;
/// And by how many square roots of its seeds: a tray that holds a few at a time often holds half as many.
constexpr double drained_deviations = 3;

/// Of the seeds that left, and at all, without a word.
constexpr double most_spilled = 0.05;
constexpr std::int64_t few_spilled = 5;

/// By what the tray itself holds: a hopper that is kept topped up may have arched over it.
std::optional<Doubt> doubt_if_drained(const Run& run) {
  const double begin = static_cast<double>(run.tray_at_begin), end = static_cast<double>(run.tray_at_end);
  if (begin < 0 || end >= drained_fraction * begin || begin - end <= drained_deviations * std::sqrt(begin))
    return std::nullopt;
  return Doubt{DoubtKind::drained, fmt::format("drained in the window: {} of the {} seeds in the tray gone",
                                               run.tray_at_begin - run.tray_at_end, run.tray_at_begin)};
}

/// The window's first or last third, s, in whole periods of the drive. Less than two periods are none: a shaken bed may
/// take turns from one to the next. None where it has not so many.
std::optional<double> third_of(const MeasuringWindow& window) {
  constexpr int fewest = 2;
  if (window.empty()) return std::nullopt;
  if (window.drive != MeasuringWindow::Drive::periodic) return window.length() / 3;
  if (window.periods < 2 * fewest) return std::nullopt;
  return std::max(fewest, window.periods / 3) * window.period;
}

/// How much more the seeds' counts scatter than those of independent seeds: variance over mean of the equal parts of
/// two pieces of the window, each about its own mean; at least 1. Seeds that leave in bursts have more.
double dispersion(const std::vector<double>& first, const std::vector<double>& last) {
  double variances = 0, means = 0;
  for (const std::vector<double>* counts : {&first, &last}) {
    const double mean = std::accumulate(counts->begin(), counts->end(), 0.0) / static_cast<double>(counts->size());
    const double deviation = mean * coefficient_of_variation(*counts).value_or(0);
    variances += deviation * deviation, means += mean;
  }
  return means > 0 ? std::max(1.0, variances / means) : 1;
}

/// The flow of the last third over that of the first, or the other way, above which their mean is of two flows; and by
/// how many standard deviations they differ.
constexpr double changed_flow = 2, changed_deviations = 5;

std::optional<Doubt> doubt_if_flow_changed(const std::vector<OutflowEvent>& events, const MeasuringWindow& window) {
  const std::optional<double> third = third_of(window);
  if (!third) return std::nullopt;
  const std::vector<double> times = times_of(events);
  const auto counts = [&](double from) {
    constexpr int parts = 10;
    std::vector<double> ends;
    for (int k = 0; k <= parts; ++k) ends.push_back(from + *third * k / parts);
    const std::vector<std::int64_t> whole = counts_in_blocks(times, ends);
    return std::vector<double>(whole.begin(), whole.end());
  };
  const std::vector<double> of_first = counts(window.from), of_last = counts(window.to - *third);
  const double first = std::accumulate(of_first.begin(), of_first.end(), 0.0),
               last = std::accumulate(of_last.begin(), of_last.end(), 0.0);
  if (std::max(first, last) <= changed_flow * std::min(first, last)) return std::nullopt;
  if (std::abs(last - first) <= changed_deviations * std::sqrt(dispersion(of_first, of_last) * (first + last)))
    return std::nullopt;
  return Doubt{DoubtKind::flow_changed,
               fmt::format("the flow changed in the window: from {:.3g} to {:.3g} seeds/s, first and last {:.3g} s",
                           first / *third, last / *third, *third)};
}

/// What falls in is all that can leave: a tray that passes it at once is empty now and then.
bool is_rained_on_to_the_end(const Vessel& tray, const MeasuringWindow& window) {
  return tray.rain && tray.rain->start < window.to && tray.rain->stop >= window.to;
}

bool says_why_flow_ended(const std::vector<Doubt>& doubts) {
  using enum DoubtKind;
  return std::ranges::any_of(doubts, [](const Doubt& doubt) {
    return doubt.kind == ran_dry || doubt.kind == drained || doubt.kind == stopped_flowing;
  });
}

std::vector<Doubt> doubts_about(const Scene& scene, const Run& run, const MeasuringWindow& window,
                                const std::vector<OutflowEvent>& events) {
  using enum DoubtKind;
  const std::size_t counted = events.size();
  std::vector<Doubt> doubts;
  const auto add = [&](DoubtKind kind, const std::string& text = "") {
    doubts.push_back({kind, text.empty() ? std::string(words_of(kind).name) : text});
  };
  if (run.outside_the_model) add(outside_the_model);
  if (run.tray_empty_since >= 0 && run.tray_empty_since < window.to && !is_rained_on_to_the_end(scene.tray, window))
    add(ran_dry, run.balance.put_in > 0 ? fmt::format("ran dry at {:.3g} s", run.tray_empty_since)
                                        : std::string("no seed was put in"));
  else if (const auto drained_doubt = doubt_if_drained(run))
    doubts.push_back(*drained_doubt);
  if (!run.end_reason.empty() && run.balance.inside > 0)
    add(stopped_flowing, fmt::format("ended at {:.3g} s: {}", run.end_time, run.end_reason));
  if (!says_why_flow_ended(doubts))
    if (const auto changed = doubt_if_flow_changed(events, window)) doubts.push_back(*changed);
  const std::int64_t left = run.balance.counted + run.balance.spilled;
  if (!run.outside_the_model && run.balance.spilled > few_spilled &&
      static_cast<double>(run.balance.spilled) > most_spilled * static_cast<double>(left))
    add(seeds_spilled, fmt::format("{} of the {} seeds that left fell past the tray's rim", run.balance.spilled, left));
  if (run.balance.lost > 0)
    add(seeds_lost, fmt::format("{} of {} seeds lost through walls", run.balance.lost, run.balance.put_in));
  doubts.insert(doubts.end(), run.warnings.begin(), run.warnings.end());
  if (run.status == RunStatus::stopped_by_guard) add(stopped_by_guard, "stopped: " + run.stop_reason);
  if (run.status == RunStatus::interrupted) add(interrupted);
  if (window.drive == MeasuringWindow::Drive::periodic && window.periods == 0 && !window.empty())
    add(part_of_a_period, fmt::format("measured over {:.3g} s, a part of one period of the drive, {:.3g} s",
                                      window.length(), window.period));
  if (window.empty() && !run.goes_on)
    add(before_the_window);
  else if (!window.empty() && static_cast<std::int64_t>(counted) < few_grains && !scene.tray.holes.empty())
    add(few_seeds, fmt::format("a rate from {} seed{}", counted, counted == 1 ? "" : "s"));
  return doubts;
}

}  // namespace

bool has_rows_of_holes(const Outflow& outflow) {
  return std::ranges::any_of(
      outflow.holes, [&](const HoleOutflow& row) { return row.across && row.across != outflow.holes.front().across; });
}

std::vector<std::int64_t> counts_in_blocks(const std::vector<double>& times, const std::vector<double>& ends) {
  std::vector<std::int64_t> counts(ends.empty() ? 0 : ends.size() - 1, 0);
  for (const double time : times) {
    if (ends.empty() || time < ends.front() || time > ends.back()) continue;
    const auto after = std::upper_bound(ends.begin() + 1, ends.end() - 1, time);
    ++counts[static_cast<std::size_t>(after - ends.begin() - 1)];
  }
  return counts;
}

std::optional<Instability> instability(const std::vector<double>& times, const MeasuringWindow& window) {
  std::vector<double> counts;
  for (const std::int64_t count : counts_in_blocks(times, instability_ends(window)))
    counts.push_back(static_cast<double>(count));
  const double seeds = std::accumulate(counts.begin(), counts.end(), 0.0);
  if (seeds < 2) return std::nullopt;
  const std::optional<double> cv = coefficient_of_variation(counts);
  if (!cv) return std::nullopt;
  return Instability{*cv, std::sqrt(static_cast<double>(counts.size()) / seeds)};
}

std::string Outflow::note() const {
  std::vector<std::string_view> texts;
  for (const Doubt& doubt : doubts) texts.push_back(doubt.text);
  return fmt::format("{}", fmt::join(texts, "; "));
}

Outflow measure_outflow(const Scene& scene, const Run& run) {
  const MeasuringWindow window = window_of(scene, run);
  const std::vector<OutflowEvent> events = counted_inside(run.events, window);

  Outflow outflow;
  outflow.window = window;
  outflow.holes = measure_rows(scene, events, window);
  outflow.grains_of_hole = grains_of_holes(scene, events);
  outflow.grains_of_hole_in_block = grains_in_blocks(scene, events, block_ends(window));
  outflow.raw_cv = raw_cv(outflow.grains_of_hole);
  if (const auto of_all = instability(times_of(events), window)) outflow.instability_cv = of_all->cv;
  const std::int64_t left = run.balance.counted + run.balance.spilled;
  if (left > 0) outflow.spilled_fraction = static_cast<double>(run.balance.spilled) / static_cast<double>(left);
  outflow.depth_factor = depth_factor(scene);
  outflow.doubts = doubts_about(scene, run, window, events);
  return outflow;
}

std::optional<Unevenness> unevenness_of(const std::vector<const Outflow*>& replicates) {
  if (replicates.size() == 1) return unevenness(replicates.front()->grains_of_hole_in_block);
  std::vector<std::vector<std::int64_t>> counts;
  for (const Outflow* one : replicates) counts.push_back(one->grains_of_hole);
  return unevenness(counts);
}

MeanWithInterval rate_of_blocks(const Outflow& outflow, std::optional<std::size_t> hole) {
  const std::vector<double> ends = block_ends(outflow.window);
  std::vector<CountedRate> rates;
  for (std::size_t k = 0; k < outflow.grains_of_hole_in_block.size(); ++k) {  // none of a tray without holes
    const std::vector<std::int64_t>& counts = outflow.grains_of_hole_in_block[k];
    const std::int64_t seeds = hole ? counts[*hole] : std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
    rates.push_back({static_cast<double>(seeds) / (ends[k + 1] - ends[k]), static_cast<double>(seeds)});
  }
  return mean_of_rates(rates);
}

std::optional<double> chance_of_rate(const std::vector<const Outflow*>& replicates) {
  std::vector<CountedRate> rates;
  const Outflow* last = nullptr;
  for (const Outflow* one : replicates) {
    const double rate = find_row(*one, "all", "all")->mass_rate;
    if (!std::isfinite(rate)) continue;
    rates.push_back({rate, one->seeds()}), last = one;
  }
  if (rates.empty()) return std::nullopt;
  const MeanWithInterval mean = rates.size() > 1 ? mean_of_rates(rates) : rate_of_blocks(*last);
  if (!(mean.mean > 0) || !mean.half_width_95) return std::nullopt;
  return *mean.half_width_95 / mean.mean;
}

double Outflow::seeds() const {
  return static_cast<double>(find_row(*this, "all", "all")->grains);
}

const HoleOutflow* find_row(const Outflow& outflow, const std::string& hole, const std::string& lot) {
  const auto find = [&](const std::string& wanted_lot) -> const HoleOutflow* {
    const auto row = std::ranges::find_if(
        outflow.holes, [&](const HoleOutflow& one) { return one.hole == hole && one.lot == wanted_lot; });
    return row == outflow.holes.end() ? nullptr : &*row;
  };
  if (const HoleOutflow* row = find(lot)) return row;
  // A single lot has rows under its name for each hole, and under "all" for all holes.
  if (lot == "all") {
    const auto row = std::ranges::find(outflow.holes, hole, &HoleOutflow::hole);
    return row == outflow.holes.end() ? nullptr : &*row;
  }
  const bool named = std::ranges::any_of(outflow.holes, [&](const HoleOutflow& one) { return one.lot == lot; });
  return named && hole == "all" ? find("all") : nullptr;
}

}  // namespace vibrosow
