#pragma once

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <vector>

#include "accuracy/accuracy_settings.hpp"
#include "grains/random.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// One that nothing is warned of.
inline Scene sound_scene(Space space = Space::three_dimensional) {
  Scene scene;
  scene.space = space;
  scene.contact.seed.friction = scene.contact.wall.friction = 0.3;
  return scene;
}

/// A made-up tray whose rate errs by main effects that are known: so much percent at the softest of its settings, at 20
/// steps a contact, and at a slip speed of 80 mm/s.
struct MadeUpTray {
  double limit = 0.020;       // kg/s
  double by_softness = 10;    // percent
  double by_step = 1;         // percent
  double by_slip_speed = 0;   // percent
  double scatter = 1;         // percent, of a run
  double by_interaction = 0;  // percent, of soft and coarse together
  std::uint64_t random_seed = 1;

  static constexpr double softest = 1e-2, contact = 1e-4;  // eps / r, s

  static AccuracySetting setting(double softness, double steps, double slip_speed = 0) {
    AccuracySetting made;
    made.steps_per_contact = steps;
    made.shell_compression = softness;
    made.slip_speed = slip_speed;
    made.contact_duration = contact * std::sqrt(softness / softest);
    made.overlap_at_rest = 10 * softness;
    made.dt = made.contact_duration / steps;
    return made;
  }

  /// Systematic error, percent.
  double error(const AccuracySetting& setting) const {
    const double soft = std::sqrt(setting.shell_compression / softest), coarse = 20 / setting.steps_per_contact;
    return by_softness * soft + by_step * coarse + by_slip_speed * setting.slip_speed / 0.08 +
           by_interaction * soft * coarse;
  }

  static double cost(const AccuracySetting& setting) { return 1e4 / (setting.dt * 1e6); }
};

/// Runs of the tray, each with chance of its own.
class MadeUpRuns {
 public:
  explicit MadeUpRuns(const MadeUpTray& tray) : tray_(tray), random_(tray.random_seed) {}

  std::vector<AccuracyRun> run(const std::vector<AccuracySetting>& settings, const std::vector<SettingRuns>& wanted) {
    std::vector<AccuracyRun> runs;
    for (const SettingRuns& of : wanted)
      for (int i = 0; i < of.runs; ++i) {
        const double chance = tray_.scatter / std::sqrt(of.window) *
                              boost::math::quantile(boost::math::normal(), random_.uniform() + 0x1p-54);
        const double cost = of.window * MadeUpTray::cost(settings[of.setting]);
        runs.push_back({.setting = of.setting,
                        .window = of.window,
                        .mass_rate = tray_.limit * (1 + (tray_.error(settings[of.setting]) + chance) / 100),
                        .grain_steps = cost,
                        .cpu_time = 1e-3 * cost});
      }
    return runs;
  }

 private:
  MadeUpTray tray_;
  Random random_;
};

/// Four softnesses, three steps, and slip speeds where there are any.
inline AccuracyDesign made_up_design(const std::vector<double>& slip_speeds = {}) {
  AccuracyGrid grid;
  grid.integrators = {Integrator::velocity_verlet};
  grid.steps_per_contact = {20, 40, 80};
  grid.shell_compressions = {1e-5, 1e-4, 1e-3, 1e-2};
  grid.slip_speeds = slip_speeds;
  AccuracyDesign design = screening_design(grid);
  for (AccuracySetting& setting : design.settings)
    setting = MadeUpTray::setting(setting.shell_compression, setting.steps_per_contact, setting.slip_speed);
  return design;
}

/// Rounds of a design.
inline std::vector<SettingRuns> rounds_of(const AccuracyDesign& design, int rounds) {
  std::vector<SettingRuns> wanted = runs_of(design.runs);
  for (SettingRuns& of : wanted) of.runs *= rounds;
  return wanted;
}

}  // namespace vibrosow
