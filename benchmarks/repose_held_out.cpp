// Each run of the atlas' box in 3D as if it were a bench test of an unknown material: its friction and rolling
// friction by the atlas, with what the other materials alone say of the plane and space, beside what it was run with:
// CSV. Usage: repose_held_out STUDY FOLDER

#include <fmt/format.h>

#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "calibration/new_crop.hpp"
#include "repose_runs.hpp"

namespace {

using namespace vibrosow;

std::string held(double truth, const ParameterBand& band) {
  return fmt::format("{:g},{:.3g},{:.3g},{:.3g},{}", truth, band.mean, band.low, band.high,
                     truth >= band.low && truth <= band.high ? 1 : 0);
}

void print_material(const ReposeAtlas& atlas, const std::vector<ReposeMaterial>& materials, std::size_t one) {
  std::vector<AtlasPoint> others;
  for (std::size_t k = 0; k < materials.size(); ++k)
    if (k != one) others.push_back(atlas_point(materials[k].scene, materials[k].runs));
  const ShippedAtlas without{atlas, plane_to_space(atlas, others)};
  const AtlasPoint truth = atlas_point(materials[one].scene, materials[one].runs);
  for (std::size_t k = 0; k < materials[one].runs.size(); ++k) {
    const ReposeMetrics& run = materials[one].runs[k];
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
    const std::vector<ReposeMaterial> materials = kept_materials(argv[1], argv[2]);
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
