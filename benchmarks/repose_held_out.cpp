// Each run of the atlas' box in space as if it were a bench test of an unknown material: its friction and rolling
// friction by the atlas, with what the other materials alone say of the plane and space, beside what it was run with:
// CSV. Usage: repose_held_out STUDY FOLDER

#include <fmt/format.h>

#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "design/new_crop.hpp"
#include "design/planned_study.hpp"
#include "design/repose_band.hpp"
#include "scene/input_error.hpp"
#include "storage/case_file.hpp"
#include "storage/case_folder.hpp"

namespace {

using namespace vibrosow;

/// A material in space and the figures of its runs.
struct Material {
  AtlasPoint point;
  std::vector<ReposeFigures> runs;
};

std::vector<Material> materials_of(const std::string& study, const std::string& folder) {
  const PlannedStudy planned = plan_study(study, {}, 1);
  const CaseFolder cases(cases_of(folder));
  const std::vector<int> replicates = replicates_in(planned);
  std::vector<Material> materials;
  for (std::size_t s = 0; s < planned.study.scenes.size(); ++s) {
    const Scene& scene = planned.study.scenes[s];
    Material& material = materials.emplace_back();
    for (int seed = 1; seed <= replicates[s]; ++seed) {
      const auto run = cases.find(case_identity(scene, static_cast<std::uint64_t>(seed)));
      if (!run || run->status != RunStatus::finished) throw InputError(folder + ": a run is missing or failed");
      material.runs.push_back(repose_figures(scene, *run));
    }
    material.point = atlas_point(scene, material.runs);
  }
  return materials;
}

std::string held(double truth, const ParameterBand& band) {
  return fmt::format("{:g},{:.3g},{:.3g},{:.3g},{}", truth, band.mean, band.low, band.high,
                     truth >= band.low && truth <= band.high ? 1 : 0);
}

void print_material(const ReposeAtlas& atlas, const std::vector<Material>& materials, std::size_t one) {
  std::vector<AtlasPoint> others;
  for (std::size_t k = 0; k < materials.size(); ++k)
    if (k != one) others.push_back(materials[k].point);
  const ShippedAtlas without{atlas, plane_to_space(atlas, others)};
  const AtlasPoint& truth = materials[one].point;
  for (std::size_t k = 0; k < materials[one].runs.size(); ++k) {
    const ReposeFigures& run = materials[one].runs[k];
    if (!run.angle) continue;
    MeasuredBulk measured{run.angle, assumed_angle_error, run.packing, 0};
    measured.packing_error = assumed_packing_error * run.packing.value_or(0);
    const ReposeBand band = repose_band(without, truth.aspect_ratio, measured);
    std::cout << fmt::format("{},{:.4g},{:.4g},{},{}\n", k + 1, *run.angle * 180 / std::numbers::pi, *run.packing,
                             held(truth.friction, band.friction), held(truth.rolling_friction, band.rolling_friction));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: repose_held_out STUDY FOLDER\n";
    return 2;
  }
  try {
    const std::vector<Material> materials = materials_of(argv[1], argv[2]);
    const ReposeAtlas atlas = shipped_atlas().atlas;
    std::cout << "random_seed,angle_degree,packing,friction,friction_mean,friction_low,friction_high,friction_held,"
                 "rolling_friction,rolling_mean,rolling_low,rolling_high,rolling_held\n";
    for (std::size_t one = 0; one < materials.size(); ++one) print_material(atlas, materials, one);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
