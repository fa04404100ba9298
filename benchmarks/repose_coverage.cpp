// How far the atlas of repose can be believed of the plane that it is of: an atlas of one half of each material's runs
// (even random seeds, then odd ones) is asked for the other half. A row for each aspect ratio: in what share of the
// materials the other half's mean angle and packing lie in the 95 % interval of what this half says of them; and, with
// that mean taken for a bench test, how often the bands of friction and rolling friction hold what the runs were made
// with, and how much narrower than the prior they are on average. The bands' materials are those inside the grid: its
// edges are the prior's, which no central interval reaches. CSV.
// Usage: repose_coverage STUDY FOLDER [STUDY FOLDER]..

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <vector>

#include "calibration/repose_band.hpp"
#include "repose_runs.hpp"

namespace {

using namespace vibrosow;

constexpr double normal_97_5 = 1.959964;

/// Of all materials, from every other run.
std::vector<AtlasPoint> half(const std::vector<ReposeMaterial>& materials, std::size_t first) {
  std::vector<AtlasPoint> points;
  for (const ReposeMaterial& material : materials) {
    std::vector<ReposeMetrics> runs;
    for (std::size_t k = first; k < material.runs.size(); k += 2) runs.push_back(material.runs[k]);
    points.push_back(atlas_point(material.scene, runs));
  }
  return points;
}

/// Counts of what was held, and sums.
struct Tally {
  int materials = 0, angles = 0, packings = 0;
  int inside = 0, frictions = 0, rollings = 0;
  double friction_contraction = 0, rolling_contraction = 0;
};

double error_of(const MeanAndScatter& metric, int runs) {
  return metric.scatter / std::sqrt(static_cast<double>(runs));
}

bool agree(const AtlasMetric& predicted, double mean, double error) {
  return std::abs(mean - predicted.mean) <= normal_97_5 * std::hypot(predicted.error, error);
}

bool is_inside(const std::vector<double>& axis, double value) {
  return value > axis.front() && value < axis.back();
}

bool holds(const ParameterBand& band, double truth) {
  return truth >= band.low && truth <= band.high;
}

/// The plane as it is: nothing is added for space.
constexpr PlaneToSpace in_the_plane{{0, 0}, {1, 0}, {1, 0}, 1};

void ask(const ShippedAtlas& atlas, const AtlasPoint& other, Tally& tally) {
  const AtlasMetrics predicted = atlas.atlas.at(other.aspect_ratio, other.friction, other.rolling_friction);
  const double angle_error = error_of(other.angle, other.runs);
  const double packing_error = error_of(other.packing, other.runs + other.clogged);
  ++tally.materials;
  tally.angles += agree(predicted.angle, other.angle.mean, angle_error);
  tally.packings += agree(predicted.packing, other.packing.mean, packing_error);
  if (!is_inside(atlas.atlas.frictions(), other.friction) ||
      !is_inside(atlas.atlas.rolling_frictions(), other.rolling_friction))
    return;
  const ReposeBand band =
      repose_band(atlas, other.aspect_ratio, {other.angle.mean, angle_error, other.packing.mean, packing_error});
  ++tally.inside;
  tally.frictions += holds(band.friction, other.friction);
  tally.rollings += holds(band.rolling_friction, other.rolling_friction);
  tally.friction_contraction += band.friction.contraction;
  tally.rolling_contraction += band.rolling_friction.contraction;
}

std::string row(double aspect_ratio, const Tally& tally) {
  const auto percent = [](double sum, int of) { return 100 * sum / of; };
  return fmt::format("{:g},{},{:.1f},{:.1f},{},{:.1f},{:.1f},{:.0f},{:.0f}\n", aspect_ratio, tally.materials,
                     percent(tally.angles, tally.materials), percent(tally.packings, tally.materials), tally.inside,
                     percent(tally.frictions, tally.inside), percent(tally.rollings, tally.inside),
                     percent(tally.friction_contraction, tally.inside),
                     percent(tally.rolling_contraction, tally.inside));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc % 2 == 0) {
    std::cerr << "usage: repose_coverage STUDY FOLDER [STUDY FOLDER]..\n";
    return 2;
  }
  try {
    std::vector<ReposeMaterial> materials;
    for (int k = 1; k + 1 < argc; k += 2)
      for (ReposeMaterial& material : kept_materials(argv[k], argv[k + 1])) materials.push_back(std::move(material));
    std::map<double, Tally> tallies;
    for (const std::size_t first : {0U, 1U}) {
      const ShippedAtlas atlas{ReposeAtlas(half(materials, first)), in_the_plane};
      for (const AtlasPoint& other : half(materials, 1 - first)) ask(atlas, other, tallies[other.aspect_ratio]);
    }
    std::cout << "aspect_ratio,materials,angle_held_percent,packing_held_percent,materials_inside,"
                 "friction_held_percent,rolling_held_percent,friction_narrower_percent,rolling_narrower_percent\n";
    for (const auto& [aspect_ratio, tally] : tallies) std::cout << row(aspect_ratio, tally);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
