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
  std::vector<double> shell_compressions;  // eps / r under the grain's own weight
  std::vector<double> slip_speeds;         // m/s
};

/// Both integrators; 10, 20 and 40 steps a contact; the scene's shell compression and 10 and 100 times that, up to
/// 0.05; the scene's slip speed and five times that, or one where there is no friction.
AccuracyGrid default_accuracy_grid(const Scene& scene);

struct AccuracySetting {
  Integrator integrator = Integrator::velocity_verlet;
  double steps_per_contact = 20;
  double shell_compression = 1e-4;
  double slip_speed = 0.02;  // m/s
  double dt = 0;             // s, contact duration / steps per contact
};

struct AccuracyRow {
  AccuracySetting setting;
  std::string refused;                        // why it has no rate: a step too long, stopped by the guard, interrupted
  int replicates = 0;                         // finished
  std::optional<MeanWithInterval> mass_rate;  // kg/s, all holes and lots, of the plane slice
  std::optional<double> error_percent;        // signed, against the reference
  std::optional<double>
      error_ci95;          // half width, percent: both rates' intervals, as independent; none for the reference
  double grain_steps = 0;  // mean of the finished runs
  std::optional<double> cost_ratio;  // grain-steps times force evaluations a step, over the reference's
  bool on_front = false;             // no other setting costs no more and errs less
  double wall_time = 0;              // s, mean of the finished runs; of this machine
};

struct AccuracyResult {
  std::vector<AccuracyRow> rows;  // integrator slowest, slip speed fastest
  std::size_t reference = 0;      // index of the finest setting that gave a rate
};

/// The scene with a setting: its step is written down as `numerics.dt`, so that it is run as asked.
Scene scene_with(const Scene& scene, AccuracySetting& setting);

/// Runs every setting with every random seed. A setting whose step is too long is not run. Throws InputError when no
/// setting can be run.
AccuracyResult measure_accuracy(const Scene& scene, const AccuracyGrid& grid, int replicates,
                                const Simulator& simulator, const SweepOptions& options);

/// Errors, cost ratios and the front, from rates and grain-steps. The reference: of the settings with a rate, the
/// smallest shell compression, then the smallest slip speed, then velocity Verlet, then the most steps a contact.
void compare_with_finest(AccuracyResult& result);

/// The cheapest setting other than the reference whose |error| is at most `percent`; none: nothing is so near.
std::optional<std::size_t> cheapest_within(const AccuracyResult& result, double percent);

}  // namespace vibrosow
