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
  std::vector<ReposeFigures> runs;
};

/// All materials of a study from the runs that are kept in a sweep's folder. Throws InputError where one is missing or
/// has failed.
inline std::vector<ReposeMaterial> kept_materials(const std::string& study, const std::string& folder) {
  const PlannedStudy planned = plan_study(study, {}, 1);
  const CaseFolder cases(cases_of(folder));
  const std::vector<int> replicates = replicates_in(planned);
  std::vector<ReposeMaterial> materials;
  for (std::size_t s = 0; s < planned.study.scenes.size(); ++s) {
    ReposeMaterial material{planned.study.scenes[s], {}};
    for (int seed = 1; seed <= replicates[s]; ++seed) {
      const auto run = cases.find(case_identity(material.scene, static_cast<std::uint64_t>(seed)));
      if (!run || run->status != RunStatus::finished)
        throw InputError(folder + ": a run of " + study + " is missing or failed; sweep it first");
      material.runs.push_back(repose_figures(material.scene, *run));
    }
    materials.push_back(std::move(material));
  }
  return materials;
}

}  // namespace vibrosow
