#include "accuracy/depth_error.hpp"

#include <cmath>
#include <stdexcept>

#include "study/layout_doubts.hpp"

namespace vibrosow {
namespace {

/// Of the whole tray; none where a run has no rate.
std::optional<MeanWithInterval> mean_rate(const std::vector<Evaluation>& runs) {
  std::vector<CountedRate> rates;
  for (const Evaluation& run : runs) {
    if (!run.finished() || run.outside_the_model) return std::nullopt;
    const double mass_rate = find_row(run.outflow, "all", "all")->mass_rate;
    rates.push_back({mass_rate * run.outflow.depth_factor.value(), run.outflow.seeds()});
  }
  return mean_of_rates(rates);
}

}  // namespace

std::optional<DepthError> measure_depth_error(const Scene& plane_scene, const Scene& space_scene, int replicates,
                                              const Simulator& simulator, const SweepOptions& options) {
  if (replicates < 2) throw std::invalid_argument("an interval takes two runs");
  const Model flat = prepare_to_run(plane_scene), deep = prepare_to_run(space_scene);
  std::vector<Job> jobs;
  for (const Model* model : {&flat, &deep})
    for (int k = 0; k < replicates; ++k)
      jobs.push_back({model, options.first_random_seed + static_cast<std::uint64_t>(k)});
  const std::vector<Evaluation> runs = run_jobs(jobs, simulator, options.runs);
  const std::vector<Evaluation> in_2d(runs.begin(), runs.begin() + replicates);
  const std::vector<Evaluation> in_3d(runs.begin() + replicates, runs.end());
  const auto plane = mean_rate(in_2d), space = mean_rate(in_3d);
  if (!plane || !space || !(plane->mean > 0) || !(space->mean > 0)) return std::nullopt;
  const double ratio = plane->mean / space->mean;
  const double band = ratio * std::hypot(*plane->half_width_95 / plane->mean, *space->half_width_95 / space->mean);
  return DepthError{*plane, *space, {100 * (ratio - 1), 100 * band}, doubts_of_runs(in_2d), doubts_of_runs(in_3d)};
}

}  // namespace vibrosow
