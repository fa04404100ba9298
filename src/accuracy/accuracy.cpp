#include "accuracy/accuracy.hpp"

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

double cost_of(const AccuracyRow& row) {
  return work_of(row.setting, row.grain_steps);
}

/// What one setting's runs gave.
void take_runs(AccuracyRow& row, const std::vector<AccuracyRun>& runs, std::size_t setting) {
  std::vector<CountedRate> rates;
  double made = 0;
  for (const AccuracyRun& run : runs) {
    if (run.setting != setting) continue;
    if (!run.mass_rate) {
      row.refused = run.refused;
      continue;
    }
    rates.push_back({*run.mass_rate, run.seeds});
    row.grain_steps += run.grain_steps;
    row.cpu_time += run.cpu_time;
    made += run.made();
  }
  if (rates.empty()) return;
  const double count = static_cast<double>(rates.size());
  row.replicates = static_cast<int>(rates.size());
  row.grain_steps /= count;
  row.cpu_time /= std::max(1.0, made);
  row.mass_rate = mean_of_rates(rates);
}

std::size_t finest(const std::vector<AccuracyRow>& rows) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!rows[i].too_long && (rows[best].too_long || coarseness(rows[i].setting) < coarseness(rows[best].setting)))
      best = i;
  return best;
}

void set_error(AccuracyRow& row, const AccuracyRow& reference) {
  const double rate = reference.mass_rate->mean;
  if (!(rate > 0)) return;
  row.error_percent = 100 * (row.mass_rate->mean - rate) / rate;
  if (&row == &reference) return;
  const auto a = row.mass_rate->half_width_95, b = reference.mass_rate->half_width_95;
  if (a && b) row.error_ci95 = 100 * std::hypot(*a, *b) / rate;
}

/// Whether `row` errs less than `other` by more than both rates' intervals leave open; without intervals, by anything.
bool errs_less(const AccuracyRow& row, const AccuracyRow& other, double rate) {
  const double chance =
      100 * std::hypot(row.mass_rate->half_width_95.value_or(0), other.mass_rate->half_width_95.value_or(0)) / rate;
  return std::abs(*other.error_percent) - std::abs(*row.error_percent) > chance;
}

/// From the cheapest setting on, each that errs less than all cheaper ones on the front.
void mark_front(std::vector<AccuracyRow>& rows, double rate) {
  std::vector<AccuracyRow*> by_cost, front;
  for (AccuracyRow& row : rows)
    if (row.error_percent) by_cost.push_back(&row);
  std::ranges::stable_sort(
      by_cost, {}, [](const AccuracyRow* row) { return std::pair(cost_of(*row), std::abs(*row->error_percent)); });
  for (AccuracyRow* row : by_cost) {
    row->on_front = std::ranges::all_of(front, [&](const AccuracyRow* other) { return errs_less(*row, *other, rate); });
    if (row->on_front) front.push_back(row);
  }
}

}  // namespace

AccuracyResult accuracy_of(const std::vector<AccuracySetting>& settings, const std::vector<std::string>& refused,
                           std::vector<AccuracyRun> runs) {
  AccuracyResult result;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    AccuracyRow& row = result.rows.emplace_back();
    row.setting = settings[i];
    row.too_long = !refused[i].empty();
    row.refused = refused[i];
    take_runs(row, runs, i);
  }
  result.of_one_value = part_of_one_value(settings, runs);
  if (result.of_one_value.empty()) result.fit = ErrorFit::of(settings, runs);
  if (result.fit)
    for (std::size_t i = 0; i < settings.size(); ++i)
      if (result.rows[i].mass_rate && result.fit->tells(i)) result.rows[i].fitted = result.fit->error(i);
  result.runs = std::move(runs);
  compare_with_finest(result);
  return result;
}

AccuracyResult measure_accuracy(const Scene& scene, const AccuracyDesign& design, int rounds,
                                const Simulator& simulator, const SweepOptions& options) {
  std::vector<AccuracySetting> settings;
  std::vector<SettingRuns> wanted;
  for (std::size_t i = 0; i < design.settings.size(); ++i) {
    if (design.runs[i] == 0) continue;
    wanted.push_back({settings.size(), design.runs[i] * rounds});
    settings.push_back(design.settings[i]);
  }
  SettingRunner runner(scene, settings, simulator, options);
  std::vector<std::string> refused;
  for (std::size_t i = 0; i < settings.size(); ++i) refused.push_back(runner.refused(i).value_or(""));
  return accuracy_of(settings, refused, runner.run(wanted));
}

void compare_with_finest(AccuracyResult& result) {
  result.reference = finest(result.rows);
  const AccuracyRow& reference = result.rows[result.reference];
  if (!reference.mass_rate) return;
  for (AccuracyRow& row : result.rows) {
    if (!row.mass_rate) continue;
    set_error(row, reference);
    if (cost_of(reference) > 0) row.cost_ratio = cost_of(row) / cost_of(reference);
  }
  mark_front(result.rows, reference.mass_rate->mean);
}

std::optional<std::size_t> cheapest_within(const AccuracyResult& result, double percent) {
  std::optional<std::size_t> cheapest;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const AccuracyRow& row = result.rows[i];
    if (!row.fitted || row.fitted->bound() > percent) continue;
    if (!cheapest || cost_of(row) < cost_of(result.rows[*cheapest])) cheapest = i;
  }
  return cheapest;
}

}  // namespace vibrosow
