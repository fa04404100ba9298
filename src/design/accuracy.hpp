#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "design/sweep.hpp"
#include "outflow/statistics.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// The settings that accuracy is bought with; every combination is run.
struct AccuracyGrid {
  std::vector<Integrator> integrators;
  std::vector<double> steps_per_contact;
  std::vector<double> shell_compressions;  // eps / r under the grain's own weight; none with Hertz' law
  std::vector<double> youngs_moduli;       // Pa, of seeds; none with elastic shells
  std::vector<double> slip_speeds;         // m/s; none where friction is a spring, or absent
};

/// Velocity Verlet and the midpoint rule; 10, 20 and 40 steps a contact; the scene's softness and 10 and 100 times
/// that: shell compressions up to 0.05, or Young's moduli; where friction (or rolling's torque) has a slip speed, the
/// scene's and five times that.
AccuracyGrid default_accuracy_grid(const Scene& scene);

/// The softness named is the contact's, or, where every lot has its own, the first lot's.
struct AccuracySetting {
  Integrator integrator = Integrator::velocity_verlet;
  double steps_per_contact = 20;
  double shell_compression = 0;  // 0: Hertz' law
  double youngs_modulus = 0;     // Pa; 0: elastic shells
  double slip_speed = 0;         // m/s; 0: none
  double dt = 0;                 // s, contact duration / steps per contact
};

/// Every combination, integrator slowest, slip speed fastest.
std::vector<AccuracySetting> settings_of(const AccuracyGrid& grid);

struct AccuracyRow {
  AccuracySetting setting;
  bool too_long = false;                      // its step is refused, so it is not run
  std::string refused;                        // why it has no rate: a step too long, stopped by the guard, interrupted
  int replicates = 0;                         // finished
  std::optional<MeanWithInterval> mass_rate;  // kg/s, all holes and lots, of the plane slice
  std::optional<double> error_percent;        // signed, against the reference
  std::optional<double>
      error_ci95;          // half width, percent: both rates' intervals, as independent; none for the reference
  double grain_steps = 0;  // mean of the finished runs
  std::optional<double> cost_ratio;  // grain-steps times force evaluations a step, over the reference's
  bool on_front = false;             // errs less, beyond chance, than every cheaper setting on the front
  double wall_time = 0;              // s, mean of the finished runs; of this machine
};

struct AccuracyResult {
  std::vector<AccuracyRow> rows;  // in the order of `settings_of`
  std::size_t reference = 0;      // index of the finest setting whose step is not too long; it may have no rate
};

/// The scene with a setting: its step is written down as `numerics.dt`, so that it is run as asked. Lots and walls with
/// a softness of their own are softened alike.
Scene scene_with(const Scene& scene, AccuracySetting& setting);

/// Runs every setting with every random seed. A setting whose step is too long is not run. Throws InputError when no
/// setting can be run.
AccuracyResult measure_accuracy(const Scene& scene, const AccuracyGrid& grid, int replicates,
                                const Simulator& simulator, const SweepOptions& options);

/// Sets the reference and, where that has a rate, errors, cost ratios and the front, from rates and grain-steps. The
/// reference: of the settings whose step is not too long, the stiffest, then the one of smallest slip speed, then
/// velocity Verlet, then the most steps a contact.
void compare_with_finest(AccuracyResult& result);

/// What the replicates tell of settings cheaper than the reference.
struct Recommendation {
  std::optional<std::size_t> setting;     // the cheapest whose |error| and half width make up at most the target
  std::optional<std::size_t> unresolved;  // the cheapest below that of which they do not tell whether it is within
  std::optional<int> replicates;          // about so many of each setting would tell, from the scatter of these
};

/// `percent`: the target. No number of replicates is given where there is no interval, or it would be over 100 000.
Recommendation recommend(const AccuracyResult& result, double percent);

}  // namespace vibrosow
