#include "scene/surfaces.hpp"

namespace vibrosow {

const Surface& surface_between(const Contact& contact, int lot, int other) {
  for (const SurfaceOverride& o : contact.overrides)
    if ((o.lot == lot && o.other == other) || (o.lot == other && o.other == lot)) return o.surface;
  return other < 0 ? contact.wall : contact.seed;
}

}  // namespace vibrosow
