#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "plan/model.hpp"
#include "scene/scene.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// What accuracy is bought with. The softness named is the contact's, or, where every lot has its own, the first
/// lot's.
struct AccuracySetting {
  Integrator integrator = Integrator::velocity_verlet;
  double steps_per_contact = usual_steps_per_contact(Integrator::velocity_verlet);
  double shell_compression = 0;  // eps / r under the grain's own weight; 0: Hertz' law
  double youngs_modulus = 0;     // Pa, of seeds; 0: elastic shells
  double slip_speed = 0;         // m/s; 0: friction has none, as a spring has
  // What `scene_with` found for its scene:
  double contact_duration = 0;  // s, of the shortest contact
  double overlap_at_rest = 0;   // of the lowest pair, over the radius
  double dt = 0;                // s, contact duration / steps per contact
};

/// Compares as less for the finer of two settings: the stiffer, then the one of smaller slip speed, then velocity
/// Verlet, then the one with more steps a contact.
std::tuple<double, double, double, bool, double> coarseness(const AccuracySetting& setting);

/// Levels of each part of a setting.
struct AccuracyGrid {
  std::vector<Integrator> integrators;
  std::vector<double> steps_per_contact;
  std::vector<double> shell_compressions;  // none with Hertz' law
  std::vector<double> youngs_moduli;       // Pa; none with elastic shells
  std::vector<double> slip_speeds;         // m/s; none where friction is a spring, or absent
};

/// Settings and how often each is run in a round; 0: it is not run, but may be recommended.
struct AccuracyDesign {
  std::vector<AccuracySetting> settings;
  std::vector<int> runs;
};

/// Levels around the scene's own setting. Softness: ten times as stiff as the scene, the scene's, and up to two softer
/// ones, the softest at most a hundred times as soft and predicted sound (where nothing softer is, one between stiffest
/// and scene). Steps a contact: the scene's own and twice as many; and as few as are safe at all of these, where the
/// scene's are half as many again. Slip speed, where friction or rolling's torque has one: half and four times the
/// scene's. Integrators: velocity Verlet and the midpoint rule.
AccuracyGrid default_accuracy_grid(const Scene& scene);

/// Every combination once, integrator slowest, slip speed fastest.
AccuracyDesign full_design(const AccuracyGrid& grid);

/// Of a default grid, a part of the combinations that tells the main effects apart at little cost: the stiffest two at
/// coarse steps and the last but one, softer ones more often at the coarsest and the finest; the first integrator
/// throughout, others at the softest two levels alone. Slip speeds take turns.
AccuracyDesign screening_design(const AccuracyGrid& grid);

/// The design without the settings whose step is too long for the scene.
AccuracyDesign runnable(const Scene& scene, const AccuracyDesign& design);

/// The scene with a setting: its step is written down as `numerics.dt`, so that it is run as asked. Lots and walls with
/// a softness of their own are softened alike.
Scene scene_with(const Scene& scene, AccuracySetting& setting);

/// Runs that are wanted: so many of a setting, over so many times the scene's measuring window.
struct SettingRuns {
  std::size_t setting;
  int runs;
  double window = 1;
};

/// So many runs of each setting, over the scene's window; none of those with 0.
std::vector<SettingRuns> runs_of(const std::vector<int>& counts);

/// Why a run that was cut short has no rate.
inline constexpr const char* interrupted_run = "interrupted";

/// A run of a setting.
struct AccuracyRun {
  std::size_t setting = 0;
  double window = 1;
  std::uint64_t random_seed = 1;
  std::string refused{};              // why it has no rate: a step too long, stopped by the guard, interrupted
  std::optional<double> mass_rate{};  // kg/s, all holes and lots, of the plane slice or in 3D of the tray
  double seeds = 0;                   // of which the rate is made
  std::vector<Doubt> doubts{};        // where it has a rate
  double grain_steps = 0;
  double cpu_time = 0;  // s, of this machine; 0: it was kept from before
  bool made() const { return cpu_time > 0; }
};

/// What a run costs wherever it is made: grain-steps times force evaluations a step.
double work_of(const AccuracySetting& setting, double grain_steps);

/// How many times as long the measuring window may be taken, 1 first: longer where the flow goes on for as long as one
/// likes, as seeds are put in again, and nothing that the scene's own window does not see begins or ends in it.
std::vector<double> windows_alike(const Scene& scene);

/// Settings of a scene, ready to be run. Every run has a random seed of its own, so that runs are independent.
class SettingRunner {
 public:
  /// Derives every setting's model and completes the settings. Throws InputError when none can be run or there is none.
  SettingRunner(const Scene& scene, std::vector<AccuracySetting>& settings, Simulator simulator, SweepOptions options);

  /// Why a setting is not run: its step is too long.
  const std::optional<std::string>& refused(std::size_t setting) const { return refused_[setting]; }

  /// Settings take turns, so that what slows the machine down for a while slows them alike; one that is refused is left
  /// out. A run outside the model has no rate.
  std::vector<AccuracyRun> run(const std::vector<SettingRuns>& wanted);

  /// From now on; progress of one call of `run`.
  void set_progress(std::function<void(const ManyRunsProgress&)> progress) {
    options_.runs.progress = std::move(progress);
  }

 private:
  Simulator simulator_;
  SweepOptions options_;
  std::vector<Model> models_;
  std::vector<std::optional<std::string>> refused_;
  std::uint64_t next_seed_;
};

}  // namespace vibrosow
