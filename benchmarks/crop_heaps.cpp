// Heaps and beds that a crop's seeds made, as CSV: kept runs of a study on seeders/atlas.toml (drained heaps) or on
// seeders/verification/cup.toml (poured beds) whose seeds are of its shape; one row a run.
// Usage: crop_heaps CROP STUDY FOLDER

#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "fields/packing_fraction.hpp"
#include "fields/tray_frame.hpp"
#include "input/read_crop_lot.hpp"
#include "repose_runs.hpp"
#include "scene/seed_lot.hpp"
#include "scene/si_units.hpp"

namespace {

using namespace vibrosow;

/// Of the poured bed, once around.
std::optional<double> poured_packing(const Scene& scene, const Run& run) {
  const double seed = largest_disc_diameter(scene.lots);
  return bed_packing(in_tray_frame(run.snapshots.front(), scene.tray), scene.lots, scene.tray, 2 * seed);
}

std::string text(std::optional<double> value, double unit) {
  return value ? fmt::format("{:.5g}", *value / unit) : "";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: crop_heaps CROP STUDY FOLDER\n";
    return 2;
  }
  try {
    const double density = *seed_density(read_crop_lot(argv[1], "CROP"));
    std::cout << "friction,rolling_friction,random_seed,angle_degree,bulk_density_kg_per_m3\n";
    visit_kept_runs(argv[2], argv[3], [&](const Scene& scene, const std::vector<Run>& runs) {
      const Surface& surface = scene.contact.seed;
      for (const Run& run : runs) {
        const bool drains = !scene.tray.holes.empty();
        const ReposeMetrics metrics = drains ? repose_metrics(scene, run) : ReposeMetrics{};
        const std::optional<double> packing = drains ? metrics.packing : poured_packing(scene, run);
        std::cout << fmt::format("{:g},{:g},{},{},{}\n", surface.friction, surface.rolling_friction, run.random_seed,
                                 text(metrics.angle, degree), text(packing, 1 / density));
      }
    });
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
