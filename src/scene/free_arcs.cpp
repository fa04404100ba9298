#include "scene/free_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "portable_math/functions.hpp"

namespace vibrosow {
namespace {

using std::numbers::pi;

/// The part of disc i's rim inside disc j, as an arc about `middle`; nothing when the rims do not cross. Of equal discs
/// the first counts.
std::optional<Arc> covered_arc(const ClumpDisc& i, const ClumpDisc& j, bool j_is_earlier) {
  const double dx = j.x - i.x, dy = j.y - i.y, distance = portable_math::hypot(dx, dy);
  if (distance == 0 && i.radius == j.radius) return j_is_earlier ? std::optional(Arc{0, 2 * pi}) : std::nullopt;
  if (distance + i.radius <= j.radius) return Arc{0, 2 * pi};
  if (distance >= i.radius + j.radius || distance + j.radius <= i.radius) return std::nullopt;
  const double cosine = (distance + (i.radius - j.radius) * (i.radius + j.radius) / distance) / (2 * i.radius);
  const double half = portable_math::acos(std::clamp(cosine, -1.0, 1.0)), middle = portable_math::atan2(dy, dx);
  return Arc{middle - half, middle + half};
}

}  // namespace

std::vector<Arc> free_arcs(const std::vector<ClumpDisc>& discs, std::size_t i) {
  std::vector<Arc> covered;
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == i) continue;
    const std::optional<Arc> arc = covered_arc(discs[i], discs[j], j < i);
    if (!arc) continue;
    const double turns = std::floor(arc->from / (2 * pi)) * 2 * pi;
    const double from = arc->from - turns, to = arc->to - turns;
    covered.push_back({from, std::min(to, 2 * pi)});
    if (to > 2 * pi) covered.push_back({0, to - 2 * pi});
  }
  std::sort(covered.begin(), covered.end(), [](const Arc& a, const Arc& b) { return a.from < b.from; });
  std::vector<Arc> free;
  double reached = 0;
  for (const Arc& arc : covered) {
    if (arc.from > reached) free.push_back({reached, arc.from});
    reached = std::max(reached, arc.to);
  }
  if (reached < 2 * pi) free.push_back({reached, 2 * pi});
  return free;
}

std::vector<Arc> quarters(const Arc& arc) {
  const int count = static_cast<int>(std::ceil((arc.to - arc.from) / (pi / 2)));
  const double step = (arc.to - arc.from) / count;
  std::vector<Arc> parts;
  for (int part = 0; part < count; ++part) parts.push_back({arc.from + part * step, arc.from + (part + 1) * step});
  return parts;
}

}  // namespace vibrosow
