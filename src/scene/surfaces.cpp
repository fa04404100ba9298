#include "scene/surfaces.hpp"

namespace vibrosow {
namespace {

/// `other`: a lot, or -1 for the walls.
const Surface& surface_between(const Contact& contact, int lot, int other) {
  for (const SurfaceOverride& o : contact.overrides)
    if ((o.lot == lot && o.other == other) || (o.lot == other && o.other == lot)) return o.surface;
  return other < 0 ? contact.wall : contact.seed;
}

}  // namespace

Surfaces meeting_surfaces(const Contact& contact, std::size_t lots) {
  const int count = static_cast<int>(lots);
  Surfaces surfaces;
  for (int lot = 0; lot < count; ++lot) {
    for (int other = 0; other < count; ++other) surfaces.pairs.push_back(surface_between(contact, lot, other));
    surfaces.walls.push_back(surface_between(contact, lot, -1));
  }
  return surfaces;
}

}  // namespace vibrosow
