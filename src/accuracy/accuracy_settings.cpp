#include "accuracy/accuracy_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "laws/law.hpp"
#include "plan/softness.hpp"
#include "plan/steadiness_warnings.hpp"
#include "scene/input_error.hpp"
#include "simulation/integrator.hpp"

namespace vibrosow {
namespace {

constexpr double most_softened = 100, most_stiffened = 10;
const double half_a_decade = std::sqrt(10);

bool has_shell(const Scene& scene) {
  return traits_of(scene.contact.law).material == LawMaterial::shell;
}

/// To three digits, so that what a report says of a setting is all there is to it.
double rounded(double value) {
  return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr);
}

/// The scene's own setting, so many times as soft.
AccuracySetting softened(const Scene& scene, double times) {
  AccuracySetting setting;
  setting.integrator = scene.numerics.integrator;
  const double softness = softness_of(scene, traits_of(scene.contact.law));
  const double own_value = has_shell(scene) ? softness : 1 / softness;
  (has_shell(scene) ? setting.shell_compression : setting.youngs_modulus) =
      times == 1 ? own_value : rounded(has_shell(scene) ? own_value * times : own_value / times);
  return setting;
}

Scene softened_scene(const Scene& scene, double times) {
  AccuracySetting setting = softened(scene, times);
  return scene_with(scene, setting);
}

/// Softness over the scene's, from stiff to soft.
std::vector<double> softness_factors(const Scene& scene) {
  double softest = most_softened;
  while (softest > 1.5 && !is_predicted_sound(softened_scene(scene, softest))) softest /= half_a_decade;
  if (softest < 1.5) return {1 / most_stiffened, 1 / half_a_decade, 1};
  if (softest < most_stiffened) return {1 / most_stiffened, 1, softest};
  return {1 / most_stiffened, 1, std::sqrt(softest), softest};
}

/// Contact duration over the step that the scene runs with.
double own_steps(const Model& model) {
  return model.step.contact_duration / model.step.dt;
}

/// As few whole steps a contact as are safe at every softness and with every scheme.
double fewest_safe_steps(const Scene& scene, const AccuracyGrid& grid, const std::vector<double>& factors) {
  double fewest = 1;
  for (const Integrator integrator : grid.integrators)
    for (const double times : factors) {
      Scene changed = scene;
      changed.numerics.integrator = integrator;
      const StepPlan plan = prepare(softened_scene(changed, times)).step;
      fewest = std::max(fewest, std::ceil(plan.contact_duration / plan.longest_safe - 1e-9));
    }
  return fewest;
}

/// From coarse to fine, at least three.
std::vector<double> step_levels(double own, double fewest_safe) {
  const double coarse = own > 1.5 * fewest_safe ? own : std::max(own, fewest_safe);
  std::vector<double> levels = {coarse, 2 * coarse, 4 * coarse};
  if (own > 1.5 * fewest_safe) levels.insert(levels.begin(), fewest_safe);
  return levels;
}

bool has_slip_speed(const EffectSet& effects) {
  return (effects.friction && !effects.tangential_spring) || effects.rolling == Rolling::constant_torque;
}

/// The softnesses of a grid, from stiff to soft.
std::vector<AccuracySetting> softnesses_of(const AccuracyGrid& grid) {
  std::vector<AccuracySetting> softnesses;
  for (const double compression : grid.shell_compressions) softnesses.push_back({.shell_compression = compression});
  for (const double modulus : grid.youngs_moduli) softnesses.push_back({.youngs_modulus = modulus});
  return softnesses;
}

/// Runs in a round of a softness, from stiff to soft, at a step, from coarse to fine: what is stiff costs too much to
/// be run at the finest step, where what is soft tells the step's error as well.
std::size_t thrifty_runs(std::size_t softness, std::size_t step, std::size_t steps) {
  if (softness < 2) {
    if (step == 0) return softness + 1;
    return step + 2 == steps || (softness == 1 && step + 2 < steps) ? 1 : 0;
  }
  if (step == 0) return 3;
  return step + 1 == steps ? std::min<std::size_t>(softness, 3) : 0;
}

std::vector<double> slip_speeds_of(const AccuracyGrid& grid) {
  return grid.slip_speeds.empty() ? std::vector<double>{0} : grid.slip_speeds;
}

std::optional<std::string> too_long(const Model& model) {
  if (!step_refused(model.scene.numerics, model.step)) return std::nullopt;
  return fmt::format("too long, at most {:.3g} s: {}", model.step.longest_safe, model.step.bound_by);
}

void take_rate(AccuracyRun& run, const HoleOutflow& all) {
  run.mass_rate = all.mass_rate;
  run.seeds = static_cast<double>(all.grains);
}

AccuracyRun taken(const SettingRuns& of, const Evaluation& result) {
  AccuracyRun run{.setting = of.setting, .window = of.window, .random_seed = result.random_seed};
  if (!result.finished()) {
    run.refused = result.reason.empty() ? interrupted_run : result.reason;
    return run;
  }
  run.grain_steps = static_cast<double>(result.grain_steps);
  if (result.wall_time > 0) run.cpu_time = result.cpu_time;
  if (result.outside_the_model)
    run.refused = "outside the model";
  else
    take_rate(run, *find_row(result.outflow, "all", "all"));
  run.doubts = result.outflow.doubts;
  return run;
}

/// A scene whose measuring window is so many times as long.
Scene over_window(Scene scene, double times) {
  scene.run.duration = scene.run.measure_from + times * (scene.run.duration - scene.run.measure_from);
  return scene;
}

}  // namespace

AccuracyGrid default_accuracy_grid(const Scene& scene) {
  AccuracyGrid grid;
  grid.integrators = {Integrator::velocity_verlet, Integrator::rk2_midpoint};
  const std::vector<double> factors = softness_factors(scene);
  for (const double times : factors) {
    const AccuracySetting setting = softened(scene, times);
    if (has_shell(scene))
      grid.shell_compressions.push_back(setting.shell_compression);
    else
      grid.youngs_moduli.push_back(setting.youngs_modulus);
  }
  const Model model = prepare(scene);
  grid.steps_per_contact = step_levels(own_steps(model), fewest_safe_steps(scene, grid, factors));
  if (has_slip_speed(model.effects)) grid.slip_speeds = {0.5 * scene.contact.slip_speed, 4 * scene.contact.slip_speed};
  return grid;
}

AccuracyDesign full_design(const AccuracyGrid& grid) {
  AccuracyDesign design;
  for (const Integrator integrator : grid.integrators)
    for (const double steps : grid.steps_per_contact)
      for (AccuracySetting setting : softnesses_of(grid))
        for (const double slip_speed : slip_speeds_of(grid)) {
          setting.integrator = integrator;
          setting.steps_per_contact = steps;
          setting.slip_speed = slip_speed;
          design.settings.push_back(setting);
          design.runs.push_back(1);
        }
  return design;
}

AccuracyDesign screening_design(const AccuracyGrid& grid) {
  AccuracyDesign design = full_design(grid);
  const std::size_t softnesses = softnesses_of(grid).size(), slip_speeds = slip_speeds_of(grid).size();
  const std::size_t steps = grid.steps_per_contact.size();
  for (std::size_t i = 0; i < design.settings.size(); ++i) {
    const std::size_t slip_speed = i % slip_speeds, softness = i / slip_speeds % softnesses,
                      step = i / slip_speeds / softnesses % steps, integrator = i / slip_speeds / softnesses / steps;
    std::size_t runs = thrifty_runs(softness, step, steps);
    if (integrator > 0) runs = softness + 2 < softnesses || runs < 2 ? 0 : 1;
    // Of n runs each of m slip speeds has n / m; which have one more goes round. The finest setting run has one.
    const std::size_t turn = (slip_speed + softness + (step + steps) % 2 + integrator) % slip_speeds;
    design.runs[i] = static_cast<int>((runs + slip_speeds - 1 - turn) / slip_speeds);
  }
  return design;
}

std::tuple<double, double, double, bool, double> coarseness(const AccuracySetting& setting) {
  return {setting.shell_compression, -setting.youngs_modulus, setting.slip_speed,
          setting.integrator != Integrator::velocity_verlet, -setting.steps_per_contact};
}

double work_of(const AccuracySetting& setting, double grain_steps) {
  return grain_steps * evaluations_per_step(setting.integrator);
}

std::vector<SettingRuns> runs_of(const std::vector<int>& counts) {
  std::vector<SettingRuns> wanted;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) wanted.push_back({i, counts[i]});
  return wanted;
}

AccuracyDesign runnable(const Scene& scene, const AccuracyDesign& design) {
  AccuracyDesign kept;
  for (std::size_t i = 0; i < design.settings.size(); ++i) {
    AccuracySetting setting = design.settings[i];
    if (too_long(prepare(scene_with(scene, setting)))) continue;
    kept.settings.push_back(setting);
    kept.runs.push_back(design.runs[i]);
  }
  return kept;
}

Scene scene_with(const Scene& scene, AccuracySetting& setting) {
  Scene changed = scene;
  set_softness(changed, traits_of(scene.contact.law),
               has_shell(scene) ? setting.shell_compression : 1 / setting.youngs_modulus);
  if (setting.slip_speed > 0) changed.contact.slip_speed = setting.slip_speed;
  changed.numerics.integrator = setting.integrator;
  changed.numerics.steps_per_contact = setting.steps_per_contact;
  const Model model = prepare(changed);
  setting.contact_duration = model.step.contact_duration;
  setting.overlap_at_rest = model.overlap.pair_overlap_at_rest;
  setting.dt = setting.contact_duration / setting.steps_per_contact;
  changed.numerics.dt = setting.dt;
  return changed;
}

std::vector<double> windows_alike(const Scene& scene) {
  const auto fed = [](const Vessel& vessel) { return is_kept(vessel) || (vessel.rain && vessel.rain->stop == never); };
  std::vector<double> windows = {1};
  if (!fed(scene.tray) && !(scene.hopper && fed(*scene.hopper))) return windows;
  const std::vector<std::string> own = steadiness_warnings(scene);
  for (const double times : {2.0, 4.0})
    if (steadiness_warnings(over_window(scene, times)) == own) windows.push_back(times);
  return windows;
}

SettingRunner::SettingRunner(const Scene& scene, std::vector<AccuracySetting>& settings, Simulator simulator,
                             SweepOptions options)
    : simulator_(std::move(simulator)), options_(std::move(options)), next_seed_(options_.first_random_seed) {
  for (AccuracySetting& setting : settings) {
    models_.push_back(prepare(scene_with(scene, setting)));
    refused_.push_back(too_long(models_.back()));
  }
  if (settings.empty()) throw InputError("no setting can be run");
  if (std::ranges::all_of(refused_, [](const auto& reason) { return reason.has_value(); }))
    throw InputError(fmt::format("no setting can be run: {}", *refused_.front()));
}

std::vector<AccuracyRun> SettingRunner::run(const std::vector<SettingRuns>& wanted) {
  std::map<std::pair<std::size_t, double>, Model> longer;  // of settings over another window
  const auto model_of = [&](const SettingRuns& of) -> const Model* {
    const Model& model = models_[of.setting];
    if (of.window == 1) return &model;
    const auto [place, fresh] = longer.try_emplace({of.setting, of.window}, model);
    if (fresh) {
      place->second = prepare(over_window(model.scene, of.window));
    }
    return &place->second;
  };
  int most = 0;
  for (const SettingRuns& of : wanted) most = std::max(most, of.runs);
  std::vector<Job> jobs;
  std::vector<const SettingRuns*> asked;
  for (int round = 0; round < most; ++round)
    for (const SettingRuns& of : wanted) {
      if (round >= of.runs || refused_[of.setting]) continue;
      jobs.push_back({model_of(of), next_seed_++});
      asked.push_back(&of);
    }
  const std::vector<Evaluation> results = run_jobs(jobs, simulator_, options_.runs);
  std::vector<AccuracyRun> runs;
  for (std::size_t job = 0; job < jobs.size(); ++job) runs.push_back(taken(*asked[job], results[job]));
  return runs;
}

}  // namespace vibrosow
