#include "design/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/iterator/counting_iterator.hpp>
#include <cmath>
#include <tuple>

#include "laws/law.hpp"
#include "plan/model.hpp"
#include "scene/input_error.hpp"
#include "simulation/integrator.hpp"

namespace vibrosow {
namespace {

constexpr double softest_shell = 0.05;
constexpr int most_replicates = 100000;

double cost_of(const AccuracyRow& row) {
  return row.grain_steps * evaluations_per_step(row.setting.integrator);
}

/// A value of `contact` that lots may have of their own: the contact's, or, where all have, the first lot's.
double general_value(const Scene& scene, double Contact::*general, std::optional<double> SeedLot::*own) {
  const bool all_their_own =
      std::ranges::all_of(scene.lots, [own](const SeedLot& lot) { return (lot.*own).has_value(); });
  return all_their_own ? *(scene.lots.front().*own) : scene.contact.*general;
}

double shell_compression_of(const Scene& scene) {
  return general_value(scene, &Contact::shell_compression, &SeedLot::shell_compression);
}

double youngs_modulus_of(const Scene& scene) {
  return general_value(scene, &Contact::youngs_modulus, &SeedLot::youngs_modulus);
}

bool has_shell(const Scene& scene) {
  return traits_of(scene.contact.law).material == LawMaterial::shell;
}

void scale(std::optional<double>& value, double factor) {
  if (value) *value *= factor;
}

void set_softness(Scene& scene, const AccuracySetting& setting) {
  if (has_shell(scene)) {
    const double factor = setting.shell_compression / shell_compression_of(scene);
    for (SeedLot& lot : scene.lots) scale(lot.shell_compression, factor);
    scene.contact.shell_compression = setting.shell_compression;
    return;
  }
  const double factor = setting.youngs_modulus / youngs_modulus_of(scene);
  for (SeedLot& lot : scene.lots) scale(lot.youngs_modulus, factor);
  scale(scene.contact.wall_youngs_modulus, factor);
  scene.contact.youngs_modulus = setting.youngs_modulus;
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

/// The one that is finer compares as less.
auto coarseness(const AccuracyRow& row) {
  const AccuracySetting& setting = row.setting;
  return std::tuple(setting.shell_compression, -setting.youngs_modulus, setting.slip_speed,
                    setting.integrator != Integrator::velocity_verlet, -setting.steps_per_contact);
}

std::size_t finest(const std::vector<AccuracyRow>& rows) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!rows[i].too_long && (rows[best].too_long || coarseness(rows[i]) < coarseness(rows[best]))) best = i;
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

/// How an interval goes with the number of replicates.
double interval_factor(int replicates) {
  return student_t_95(replicates - 1) / std::sqrt(replicates);
}

/// How many replicates a setting would need for its interval to lie on one side of the target.
std::optional<int> replicates_to_tell(const AccuracyRow& row, double percent) {
  if (!row.error_ci95 || row.replicates < 2) return std::nullopt;
  const double wanted = std::abs(percent - std::abs(*row.error_percent)) / *row.error_ci95;
  const double factor = wanted * interval_factor(row.replicates);
  using Number = boost::counting_iterator<int>;
  const Number end(most_replicates + 1);
  const Number enough =
      std::partition_point(Number(row.replicates), end, [&](int n) { return interval_factor(n) > factor; });
  return enough == end ? std::nullopt : std::optional(*enough);
}

enum class Verdict { within, beyond, unresolved };

Verdict verdict(const AccuracyRow& row, double percent) {
  if (!row.error_ci95) return Verdict::unresolved;
  const double error = std::abs(*row.error_percent);
  if (error + *row.error_ci95 <= percent) return Verdict::within;
  return error - *row.error_ci95 > percent ? Verdict::beyond : Verdict::unresolved;
}

}  // namespace

AccuracyGrid default_accuracy_grid(const Scene& scene) {
  AccuracyGrid grid;
  grid.integrators = {Integrator::velocity_verlet, Integrator::rk2_midpoint};
  grid.steps_per_contact = {10, 20, 40};
  for (const double softer : {1.0, 10.0, 100.0}) {
    if (!has_shell(scene))
      grid.youngs_moduli.push_back(youngs_modulus_of(scene) / softer);
    else if (softer == 1 || softer * shell_compression_of(scene) <= softest_shell)
      grid.shell_compressions.push_back(softer * shell_compression_of(scene));
  }
  const EffectSet effects = prepare(scene).effects;
  if ((effects.friction && !effects.tangential_spring) || effects.rolling == Rolling::constant_torque)
    grid.slip_speeds = {scene.contact.slip_speed, 5 * scene.contact.slip_speed};
  return grid;
}

std::vector<AccuracySetting> settings_of(const AccuracyGrid& grid) {
  std::vector<AccuracySetting> softnesses;
  for (const double compression : grid.shell_compressions) softnesses.push_back({.shell_compression = compression});
  for (const double modulus : grid.youngs_moduli) softnesses.push_back({.youngs_modulus = modulus});
  const std::vector<double> slip_speeds = grid.slip_speeds.empty() ? std::vector<double>{0} : grid.slip_speeds;
  std::vector<AccuracySetting> settings;
  for (const Integrator integrator : grid.integrators)
    for (const double steps : grid.steps_per_contact)
      for (AccuracySetting setting : softnesses)
        for (const double slip_speed : slip_speeds) {
          setting.integrator = integrator;
          setting.steps_per_contact = steps;
          setting.slip_speed = slip_speed;
          settings.push_back(setting);
        }
  return settings;
}

Scene scene_with(const Scene& scene, AccuracySetting& setting) {
  Scene changed = scene;
  set_softness(changed, setting);
  if (setting.slip_speed > 0) changed.contact.slip_speed = setting.slip_speed;
  changed.numerics.integrator = setting.integrator;
  changed.numerics.steps_per_contact = setting.steps_per_contact;
  setting.dt = prepare(changed).step.contact_duration / setting.steps_per_contact;
  changed.numerics.dt = setting.dt;
  return changed;
}

AccuracyResult measure_accuracy(const Scene& scene, const AccuracyGrid& grid, int replicates,
                                const Simulator& simulator, const SweepOptions& options) {
  AccuracyResult result;
  std::vector<Model> models;  // of every row, run or not
  for (const AccuracySetting& setting : settings_of(grid)) {
    AccuracyRow& row = result.rows.emplace_back();
    row.setting = setting;
    models.push_back(prepare(scene_with(scene, row.setting)));
    const StepPlan& plan = models.back().step;
    row.too_long = step_refused(models.back().scene.numerics, plan).has_value();
    if (row.too_long) row.refused = fmt::format("too long, at most {:.3g} s: {}", plan.longest_safe, plan.bound_by);
  }
  std::vector<Job> jobs;
  std::vector<std::size_t> row_of;  // of each group of replicates
  for (std::size_t row = 0; row < models.size(); ++row) {
    if (result.rows[row].too_long) continue;
    row_of.push_back(row);
    for (int i = 0; i < replicates; ++i)
      jobs.push_back({&models[row], options.first_random_seed + static_cast<std::uint64_t>(i)});
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
  const AccuracyRow& reference = result.rows[result.reference];
  if (!reference.mass_rate) return;
  for (AccuracyRow& row : result.rows) {
    if (!row.mass_rate) continue;
    set_error(row, reference);
    if (cost_of(reference) > 0) row.cost_ratio = cost_of(row) / cost_of(reference);
  }
  mark_front(result.rows, reference.mass_rate->mean);
}

Recommendation recommend(const AccuracyResult& result, double percent) {
  Recommendation recommended;
  double least = cost_of(result.rows[result.reference]), least_unresolved = least;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const AccuracyRow& row = result.rows[i];
    if (i == result.reference || !row.error_percent) continue;
    const Verdict told = verdict(row, percent);
    if (told == Verdict::within && cost_of(row) < least) recommended.setting = i, least = cost_of(row);
    if (told == Verdict::unresolved && cost_of(row) < least_unresolved)
      recommended.unresolved = i, least_unresolved = cost_of(row);
  }
  if (least_unresolved >= least) recommended.unresolved.reset();
  if (recommended.unresolved)
    recommended.replicates = replicates_to_tell(result.rows[*recommended.unresolved], percent);
  return recommended;
}

}  // namespace vibrosow
