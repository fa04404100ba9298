#include "study/scene_runs.hpp"

#include <algorithm>
#include <utility>

#include "plan/model.hpp"
#include "plan/predicted_grains.hpp"
#include "storage/case_file.hpp"
#include "study/run_in_parallel.hpp"

namespace vibrosow {

SceneRuns::SceneRuns(const Study& study, const std::vector<Scene>& scenes, std::uint64_t first_random_seed)
    : scenes_(scenes), first_random_seed_(first_random_seed), layouts_(scenes.size()), runs_(scenes.size()) {
  for (const Scene& scene : scenes_) {
    models_.push_back(prepare(scene));  // at its accuracy: as it is run
    json_.push_back(untitled_json(models_.back().scene));
    costs_.push_back(predicted_grain_steps(models_.back().scene, models_.back().step.dt));
  }
  for (const Layout& layout : study.layouts)
    if (layout.scene && layouts_.at(*layout.scene) == 0) layouts_[*layout.scene] = layout.number;
}

std::string SceneRuns::name_of(std::size_t scene, std::uint64_t random_seed) const {
  return case_name(case_identity(json_[scene], random_seed));
}

std::vector<WantedRun> SceneRuns::missing(const std::vector<int>& counts) const {
  std::vector<WantedRun> missing;
  for (std::size_t scene = 0; scene < counts.size(); ++scene)
    for (auto r = runs_[scene].size(); r < static_cast<std::size_t>(counts[scene]); ++r) {
      const std::uint64_t seed = first_random_seed_ + r;
      missing.push_back({&scenes_[scene], seed, name_of(scene, seed), costs_[scene], layouts_[scene]});
    }
  return missing;
}

bool SceneRuns::take(const std::vector<int>& counts, const KeptRuns& kept, int jobs) {
  std::vector<std::pair<std::size_t, std::uint64_t>> wanted;  // scene, random seed
  for (std::size_t scene = 0; scene < counts.size(); ++scene)
    for (auto r = runs_[scene].size(); r < static_cast<std::size_t>(counts[scene]); ++r)
      wanted.emplace_back(scene, first_random_seed_ + r);
  std::vector<std::optional<Evaluation>> read(wanted.size());
  run_in_parallel(jobs, wanted.size(), [&](std::size_t i) {
    const auto [scene, seed] = wanted[i];
    if (const std::optional<Run> run = kept(name_of(scene, seed))) read[i] = reduced(models_[scene].scene, *run);
  });
  if (std::ranges::any_of(read, [](const auto& one) { return !one; })) return false;
  for (std::size_t i = 0; i < read.size(); ++i) runs_[wanted[i].first].push_back(std::move(*read[i]));
  return true;
}

/// By layout, then random seed.
std::vector<PlannedRun> SceneRuns::plan(const std::vector<int>& counts) const {
  std::vector<PlannedRun> runs;
  for (std::size_t scene = 0; scene < counts.size(); ++scene)
    for (int r = 0; r < counts[scene]; ++r) {
      const std::uint64_t seed = first_random_seed_ + static_cast<std::uint64_t>(r);
      runs.push_back({name_of(scene, seed), layouts_[scene], seed, costs_[scene]});
    }
  return runs;
}

std::int64_t SceneRuns::count() const {
  std::int64_t count = 0;
  for (const auto& of_scene : runs_) count += static_cast<std::int64_t>(of_scene.size());
  return count;
}

double SceneRuns::grain_steps() const {
  double steps = 0;
  for (const auto& of_scene : runs_)
    for (const Evaluation& run : of_scene) steps += static_cast<double>(run.grain_steps);
  return steps;
}

}  // namespace vibrosow
