#include "design/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "plan/effects.hpp"
#include "plan/step_plan.hpp"
#include "scene/input_error.hpp"
#include "simulation/integrator.hpp"

namespace vibrosow {
namespace {

constexpr double softest_shell = 0.05;

double cost_of(const AccuracyRow& row) {
  return row.grain_steps * evaluations_per_step(row.setting.integrator);
}

std::vector<AccuracyRow> rows_of(const AccuracyGrid& grid) {
  std::vector<AccuracyRow> rows;
  for (const Integrator integrator : grid.integrators)
    for (const double steps : grid.steps_per_contact)
      for (const double compression : grid.shell_compressions)
        for (const double slip_speed : grid.slip_speeds) {
          AccuracyRow row;
          row.setting = {integrator, steps, compression, slip_speed, 0};
          rows.push_back(row);
        }
  return rows;
}

/// What one setting's runs gave; `results` are its replicates.
void take_results(AccuracyRow& row, const Evaluation* results, int replicates) {
  std::vector<double> rates;
  for (const Evaluation* result = results; result != results + replicates; ++result) {
    if (!result->finished()) {
      row.refused = result->reason.empty() ? "interrupted" : result->reason;
      continue;
    }
    rates.push_back(find_row(result->outflow, "all", "all")->mass_rate);
    row.grain_steps += static_cast<double>(result->grain_steps);
    row.wall_time += result->wall_time;
  }
  if (rates.empty()) return;
  const double runs = static_cast<double>(rates.size());
  row.replicates = static_cast<int>(rates.size());
  row.grain_steps /= runs;
  row.wall_time /= runs;
  row.mass_rate = mean_with_interval(rates);
}

bool finer(const AccuracyRow& a, const AccuracyRow& b) {
  const auto fineness = [](const AccuracyRow& row) {
    const AccuracySetting& setting = row.setting;
    return std::tuple(setting.shell_compression, setting.slip_speed, setting.integrator != Integrator::velocity_verlet,
                      -setting.steps_per_contact);
  };
  return fineness(a) < fineness(b);
}

std::size_t finest(const std::vector<AccuracyRow>& rows) {
  std::size_t best = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].mass_rate && (best == rows.size() || finer(rows[i], rows[best]))) best = i;
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

bool beaten(const AccuracyRow& row, const std::vector<AccuracyRow>& rows) {
  return std::ranges::any_of(rows, [&](const AccuracyRow& other) {
    return other.error_percent && cost_of(other) <= cost_of(row) &&
           std::abs(*other.error_percent) < std::abs(*row.error_percent);
  });
}

}  // namespace

AccuracyGrid default_accuracy_grid(const Scene& scene) {
  AccuracyGrid grid;
  grid.integrators = {Integrator::velocity_verlet, Integrator::rk2_midpoint};
  grid.steps_per_contact = {10, 20, 40};
  const double stiffest = scene.contact.shell_compression;  // 0 with Hertz' law
  grid.shell_compressions = {stiffest};
  if (scene.contact.law == Law::elastic_shell)
    for (const double factor : {10.0, 100.0})
      if (factor * stiffest <= softest_shell) grid.shell_compressions.push_back(factor * stiffest);
  grid.slip_speeds = {scene.contact.slip_speed};
  const EffectSet effects = effects_of(scene);
  if (effects.friction && !effects.tangential_spring) grid.slip_speeds.push_back(5 * scene.contact.slip_speed);
  return grid;
}

Scene scene_with(const Scene& scene, AccuracySetting& setting) {
  Scene changed = scene;
  changed.contact.shell_compression = setting.shell_compression;
  changed.contact.slip_speed = setting.slip_speed;
  changed.numerics.integrator = setting.integrator;
  changed.numerics.steps_per_contact = setting.steps_per_contact;
  setting.dt = plan_step(changed).contact_duration / setting.steps_per_contact;
  changed.numerics.dt = setting.dt;
  return changed;
}

AccuracyResult measure_accuracy(const Scene& scene, const AccuracyGrid& grid, int replicates,
                                const Simulator& simulator, const SweepOptions& options) {
  AccuracyResult result;
  result.rows = rows_of(grid);
  std::vector<Scene> scenes;  // of every row, run or not
  for (AccuracyRow& row : result.rows) {
    scenes.push_back(scene_with(scene, row.setting));
    const StepPlan plan = plan_step(scenes.back());
    if (step_refused(scenes.back(), plan))
      row.refused = fmt::format("too long, at most {:.3g} s: {}", plan.longest_safe, plan.bound_by);
  }
  std::vector<Job> jobs;
  std::vector<std::size_t> row_of;  // of each group of replicates
  for (std::size_t row = 0; row < scenes.size(); ++row) {
    if (!result.rows[row].refused.empty()) continue;
    row_of.push_back(row);
    for (int i = 0; i < replicates; ++i)
      jobs.push_back({&scenes[row], options.first_random_seed + static_cast<std::uint64_t>(i)});
  }
  if (jobs.empty()) throw InputError(fmt::format("no setting can be run: {}", result.rows.front().refused));

  const std::vector<Evaluation> results = run_jobs(jobs, simulator, options.runs);
  for (std::size_t group = 0; group < row_of.size(); ++group)
    take_results(result.rows[row_of[group]], results.data() + group * static_cast<std::size_t>(replicates), replicates);
  compare_with_finest(result);
  return result;
}

void compare_with_finest(AccuracyResult& result) {
  result.reference = finest(result.rows);
  if (result.reference == result.rows.size()) {
    result.reference = 0;  // nothing finished: nothing to compare
    return;
  }
  const AccuracyRow& reference = result.rows[result.reference];
  for (AccuracyRow& row : result.rows) {
    if (!row.mass_rate) continue;
    set_error(row, reference);
    if (cost_of(reference) > 0) row.cost_ratio = cost_of(row) / cost_of(reference);
  }
  for (AccuracyRow& row : result.rows) row.on_front = row.error_percent && !beaten(row, result.rows);
}

std::optional<std::size_t> cheapest_within(const AccuracyResult& result, double percent) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const AccuracyRow& row = result.rows[i];
    if (i == result.reference || !row.error_percent || std::abs(*row.error_percent) > percent) continue;
    if (!best || cost_of(row) < cost_of(result.rows[*best])) best = i;
  }
  return best;
}

}  // namespace vibrosow
