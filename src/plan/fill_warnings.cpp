#include "plan/fill_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "grains/fill_height.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

/// m, in the vessel's frame, at the mean by mass of the grains from one to before another.
double mean_height(const Grains& grains, std::size_t from, std::size_t to, const Vessel& vessel) {
  const Pose pose = vessel_pose(vessel, 0);
  double mass = 0, moment = 0;
  for (std::size_t i = from; i < to; ++i) {
    const double own = grains.kind(i).mass;
    mass += own, moment += own * point_in_vessel(vessel, pose, grains.place(i)).y();
  }
  return moment / mass;
}

}  // namespace

bool is_filled_to_height(const Vessel& vessel) {
  return vessel.fill && vessel.fill->where.or_key("").ends_with(vessel.name + ".fill.height");
}

bool has_fill_to_height(const Scene& scene) {
  return is_filled_to_height(scene.tray) || (scene.hopper && is_filled_to_height(*scene.hopper));
}

std::vector<std::string> fill_warnings(const Scene& scene, const Grains& grains) {
  constexpr double much = 1.2;
  double thickness = 0;
  for (const SeedLot& lot : scene.lots) thickness = std::max(thickness, mean_thickness(lot));
  std::vector<std::string> warnings;
  std::size_t from = 0;
  for (const Vessel* vessel : {&scene.tray, scene.hopper ? &*scene.hopper : nullptr}) {
    if (!vessel || !vessel->fill) continue;
    const std::size_t count = static_cast<std::size_t>(vessel->fill->count), to = std::min(grains.size(), from + count);
    if (is_filled_to_height(*vessel) && vessel->fill->packing == Packing::poured && from < to) {
      const double height = height_of_fill(*vessel, scene.lots, scene.space);
      const double times =
          mean_height(grains, from, to, *vessel) / mean_height_of_poured(*vessel, scene.lots, scene.space);
      if (times > much && (times - 1) * height > thickness)
        warnings.push_back(fmt::format(
            "{}.fill.height: the {} seeds, as poured, lie some {:.3g} mm high instead of {:.3g} mm: seeds of such a "
            "shape lie loosely, or seeds heap up on pieces; a smaller height puts in fewer",
            vessel->name, count, 1e3 * height * times, 1e3 * height));
    }
    from = to;
  }
  return warnings;
}

}  // namespace vibrosow
