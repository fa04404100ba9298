#include "accuracy/depth_error.hpp"

#include <cmath>
#include <stdexcept>

namespace vibrosow {
namespace {

/// Of the whole tray; none where a run has no rate.
std::optional<MeanWithInterval> mean_rate(const std::vector<Evaluation>& runs, std::size_t from, std::size_t to) {
  std::vector<double> rates;
  for (std::size_t k = from; k < to; ++k) {
    const Evaluation& run = runs[k];
    if (!run.finished() || run.outside_the_model) return std::nullopt;
    rates.push_back(find_row(run.outflow, "all", "all")->mass_rate * run.outflow.depth_factor.value());
  }
  return mean_with_interval(rates);
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
  const std::size_t half = runs.size() / 2;
  const auto plane = mean_rate(runs, 0, half), space = mean_rate(runs, half, runs.size());
  if (!plane || !space || !(space->mean > 0)) return std::nullopt;
  const double ratio = plane->mean / space->mean;
  const double of_plane = plane->mean > 0 ? *plane->half_width_95 / plane->mean : 0;
  const double band = ratio * std::hypot(of_plane, *space->half_width_95 / space->mean);
  return DepthError{*plane, *space, {100 * (ratio - 1), 100 * band}};
}

}  // namespace vibrosow
