#include "calibration/refine_crop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "input/read_scene.hpp"
#include "study/study.hpp"

namespace vibrosow {
namespace {

/// The three sizes of the atlas' box and their names there; 4 mm stands for a seed's size, since nothing depends on it.
constexpr std::pair<const char*, double> lots[] = {{"small", 3.4e-3}, {"middle", 4e-3}, {"large", 4.6e-3}};

constexpr double depth_of_balls = 28e-3, count_of_balls = 4200;  // m; as in that study

/// Keys that make the lots of the box seeds of a crop's shape, of the volume of the balls there; in a box so much
/// deeper that the longest of them do not meet themselves.
std::vector<Override> shape_of(const NewCrop& crop) {
  std::vector<Override> changes;
  const double longest = crop.length * lots[2].second / std::cbrt(crop.length * crop.width * crop.thickness);
  const double depth = std::max(depth_of_balls, 6.1 * longest);
  changes.push_back(parse_override(fmt::format("tray.depth={:.4g} mm", depth * 1e3)));
  changes.push_back(parse_override(fmt::format("tray.fill.count={:.0f}", count_of_balls * depth / depth_of_balls)));
  for (const auto& [name, diameter] : lots) {
    const double scale = diameter / std::cbrt(crop.length * crop.width * crop.thickness);
    const auto add = [&, lot = name](const char* key, const std::string& value) {
      changes.push_back(parse_override(fmt::format("seeds.{}.{}={}", lot, key, value)));
    };
    add("diameter", "");
    add("shape", "elongated");
    add("length", fmt::format("{:.6g} mm", crop.length * scale * 1e3));
    add("width", fmt::format("{:.6g} mm", crop.width * scale * 1e3));
    add("thickness", fmt::format("{:.6g} mm", crop.thickness * scale * 1e3));
  }
  return changes;
}

Scene box_3d(const std::vector<Override>& shape, const Rubbing& material) {
  std::vector<Override> changes = shape;
  changes.push_back(parse_override(fmt::format("vary.contact.friction=[{:.4g}]", material.friction)));
  changes.push_back(parse_override(fmt::format("vary.contact.rolling_friction=[{:.4g}]", material.rolling_friction)));
  return read_study(data_directory() / "seeders" / "studies" / "atlas-space.toml", changes).scenes.at(0);
}

}  // namespace

std::vector<RefiningRun> refining_runs(const NewCrop& crop, const CropEstimate& estimate, const ShippedAtlas& atlas,
                                       int count) {
  const std::vector<Override> shape = estimate.is_ball() ? std::vector<Override>() : shape_of(crop);
  std::vector<RefiningRun> runs;
  for (const Rubbing& material : materials_of_band(atlas, estimate.aspect_ratio_in_atlas, estimate.used, count))
    runs.push_back({estimate.aspect_ratio_in_atlas, box_3d(shape, material), runs.size() + 1});
  return runs;
}

PlaneToSpace refined_to_space(const ReposeAtlas& atlas, const std::vector<RefiningRun>& runs, const KeptRuns& kept) {
  std::vector<AtlasPoint> points;
  for (const RefiningRun& wanted : runs) {
    const std::optional<Run> run = kept(name_of_run(wanted.scene, wanted.random_seed));
    if (!run || run->status != RunStatus::finished || run->outside_the_model) continue;
    AtlasPoint point = atlas_point(wanted.scene, {repose_metrics(wanted.scene, *run)});
    if (point.clogged > 0) continue;
    point.aspect_ratio = wanted.aspect_ratio_in_atlas;
    points.push_back(point);
  }
  PlaneToSpace to_space = plane_to_space(atlas, points);
  to_space.of_the_crop = true;
  return to_space;
}

}  // namespace vibrosow
