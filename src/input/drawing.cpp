#include "input/drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

const Vessel& vessel_of(const Drawing& drawing, const Scene& scene) {
  return drawing.vessel == scene.tray.name ? scene.tray : *scene.hopper;
}

Extent extent_of(const Drawing& drawing, const Vessel& vessel) {
  const auto first = vessel.pieces.begin() + static_cast<std::ptrdiff_t>(drawing.first);
  return extent(std::vector<WallPiece>(first, first + static_cast<std::ptrdiff_t>(drawing.count)));
}

}  // namespace

std::string drawing_text(const Drawing& drawing, const Scene& scene) {
  const Extent all = extent_of(drawing, vessel_of(drawing, scene));
  const Eigen::Vector2d low = 1e3 * all.low, high = 1e3 * all.high;
  std::string text = fmt::format("drawing {}: {} piece{} from ({:.4g}, {:.4g}) to ({:.4g}, {:.4g}) mm", drawing.file,
                                 drawing.count, drawing.count == 1 ? "" : "s", low.x(), low.y(), high.x(), high.y());
  if (vessel_of(drawing, scene).pieces.at(drawing.first).drawn_out == DrawnOut::along)
    text += " across and up, drawn out along the vessel";
  if (!drawing.layers.empty())
    text += fmt::format(", layer{} {}", drawing.layers.size() == 1 ? "" : "s", fmt::join(drawing.layers, ", "));
  if (!drawing.left_out.empty()) text += fmt::format("; left out: {}", fmt::join(drawing.left_out, "; "));
  return text;
}

std::vector<std::string> drawing_warnings(const Scene& scene, const std::vector<Drawing>& drawings) {
  constexpr double least = 1.0 / 8;  // centimetres for millimetres are less
  std::vector<std::string> warnings;
  for (const Drawing& drawing : drawings) {
    const Vessel& vessel = vessel_of(drawing, scene);
    const Extent all = extent_of(drawing, vessel);
    const bool along = vessel.pieces.at(drawing.first).drawn_out == DrawnOut::along;
    const double wide = along ? *vessel.depth : vessel.length;
    if (all.high.x() < 0 || all.low.x() > wide || all.low.y() > vessel.height)
      warnings.push_back(fmt::format(
          "{}.pieces: {} draws from ({:.4g}, {:.4g}) to ({:.4g}, {:.4g}) mm, wholly beside the {}, which is {:.4g} mm "
          "{} and {:.4g} mm high: is its zero (at) right?",
          vessel.name, drawing.file, 1e3 * all.low.x(), 1e3 * all.low.y(), 1e3 * all.high.x(), 1e3 * all.high.y(),
          vessel.name, 1e3 * wide, along ? "deep" : "long", 1e3 * vessel.height));
    const double size = all.size(), of_vessel = std::max(vessel.length, vessel.height);
    if (size < least * of_vessel)
      warnings.push_back(fmt::format(
          "{}.pieces: {} draws no more than {:.3g} mm, the {} is {:.3g} mm long and {:.3g} mm high: is its unit right?",
          vessel.name, drawing.file, 1e3 * size, vessel.name, 1e3 * vessel.length, 1e3 * vessel.height));
  }
  return warnings;
}

}  // namespace vibrosow
