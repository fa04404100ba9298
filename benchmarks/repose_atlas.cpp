// Reduces kept runs of seeders/atlas.toml to points of the atlas of repose: CSV.
// Usage: repose_atlas STUDY FOLDER [STUDY FOLDER]..

#include <iostream>
#include <string>
#include <vector>

#include "design/planned_study.hpp"
#include "design/repose_atlas.hpp"
#include "scene/input_error.hpp"
#include "storage/case_file.hpp"
#include "storage/case_folder.hpp"

namespace {

using namespace vibrosow;

/// One point for each scene of a study, from all of its runs.
void add_points(const std::string& study, const std::string& folder, std::vector<AtlasPoint>& points) {
  const PlannedStudy planned = plan_study(study, {}, 1);
  const CaseFolder cases(cases_of(folder));
  const std::vector<int> replicates = replicates_in(planned);
  for (std::size_t s = 0; s < planned.study.scenes.size(); ++s) {
    const Scene& scene = planned.study.scenes[s];
    std::vector<ReposeFigures> figures;
    for (int seed = 1; seed <= replicates[s]; ++seed) {
      const auto run = cases.find(case_identity(scene, static_cast<std::uint64_t>(seed)));
      if (!run || run->status != RunStatus::finished)
        throw InputError(folder + ": a run of " + study + " is missing or failed; sweep it first");
      figures.push_back(repose_figures(scene, *run));
    }
    points.push_back(atlas_point(scene, figures));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc % 2 == 0) {
    std::cerr << "usage: repose_atlas STUDY FOLDER [STUDY FOLDER]..\n";
    return 2;
  }
  try {
    std::vector<AtlasPoint> points;
    for (int k = 1; k + 1 < argc; k += 2) add_points(argv[k], argv[k + 1], points);
    std::cout << atlas_csv(points);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
