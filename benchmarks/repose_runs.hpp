#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "calibration/repose_atlas.hpp"
#include "scene/input_error.hpp"
#include "storage/case_file.hpp"
#include "storage/case_folder.hpp"
#include "study/planned_study.hpp"

namespace vibrosow {

/// A material of a study on seeders/atlas.toml, and the figures of its runs by random seed.
struct ReposeMaterial {
  Scene scene;
  std::vector<ReposeMetrics> runs;
};

/// Calls `visit(scene, runs)` for each scene of a study with the runs of it that are kept in a sweep's folder, by
/// random seed. Throws InputError where one is missing or has failed.
template <class Visit>
void visit_kept_runs(const std::string& study, const std::string& folder, Visit visit) {
  const PlannedStudy planned = plan_study(study, {}, 1);
  const CaseFolder cases(cases_of(folder));
  const std::vector<int> replicates = replicates_in(planned);
  for (std::size_t s = 0; s < planned.study.scenes.size(); ++s) {
    const Scene& scene = planned.study.scenes[s];
    std::vector<Run> runs;
    for (int seed = 1; seed <= replicates[s]; ++seed) {
      const auto run = cases.find(case_identity(scene, static_cast<std::uint64_t>(seed)));
      if (!run || run->status != RunStatus::finished)
        throw InputError(folder + ": a run of " + study + " is missing or failed; sweep it first");
      runs.push_back(*run);
    }
    visit(scene, runs);
  }
}

/// All materials of such a study.
inline std::vector<ReposeMaterial> kept_materials(const std::string& study, const std::string& folder) {
  std::vector<ReposeMaterial> materials;
  visit_kept_runs(study, folder, [&](const Scene& scene, const std::vector<Run>& runs) {
    materials.push_back({scene, {}});
    for (const Run& run : runs) materials.back().runs.push_back(repose_metrics(scene, run));
  });
  return materials;
}

}  // namespace vibrosow
