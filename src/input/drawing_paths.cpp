#include "input/drawing_paths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "portable_math/functions.hpp"

namespace vibrosow {
namespace {

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Of a point from the line through a and b, or from a where they lie on each other.
double distance(const Point& point, const Point& a, const Point& b) {
  const Point along = b - a;
  const double length = along.norm();
  return length > 0 ? std::abs(cross(along, point - a)) / length : (point - a).norm();
}

}  // namespace

WallPiece line_piece(const Point& a, const Point& b) {
  WallPiece piece;
  piece.a = a, piece.b = b;
  return piece;
}

WallPiece arc_piece(const Point& centre, const Point& a, const Point& b, bool anticlockwise) {
  const Point begin = (anticlockwise ? a : b) - centre, end = (anticlockwise ? b : a) - centre;
  WallPiece piece;
  piece.centre = centre;
  piece.radius = begin.norm();
  piece.from = portable_math::atan2(begin.y(), begin.x());
  piece.to = portable_math::atan2(end.y(), end.x());
  if (piece.to <= piece.from) piece.to += 2 * std::numbers::pi;
  return piece;
}

WallPiece bulge_piece(const Point& a, const Point& b, double bulge) {
  if (bulge == 0) return line_piece(a, b);
  const Point to_left(a.y() - b.y(), b.x() - a.x());
  const Point centre = 0.5 * (a + b) + (1 - bulge * bulge) / (4 * bulge) * to_left;
  return arc_piece(centre, a, b, bulge > 0);
}

/// The curve lies within the hull of its points; in halves (de Casteljau) until these are near enough to the chord, and
/// at most 2^12 parts.
void add_bezier(const Point& a, const Point& b, const Point& c, const Point& d, double tolerance,
                std::vector<WallPiece>& pieces) {
  const auto add = [&](const auto& self, const Point& p, const Point& q, const Point& r, const Point& s,
                       int halvings) -> void {
    const bool within = (q - p).dot(s - p) >= 0 && (r - s).dot(p - s) >= 0;  // no turning back beyond the ends
    if (halvings == 0 || (within && std::max(distance(q, p, s), distance(r, p, s)) <= tolerance)) {
      pieces.push_back(line_piece(p, s));
      return;
    }
    const Point pq = 0.5 * (p + q), qr = 0.5 * (q + r), rs = 0.5 * (r + s);
    const Point left = 0.5 * (pq + qr), right = 0.5 * (qr + rs), middle = 0.5 * (left + right);
    self(self, p, pq, left, middle, halvings - 1);
    self(self, middle, right, rs, s, halvings - 1);
  };
  add(add, a, b, c, d, 12);
}

std::vector<std::string> Tally::lines() const {
  std::vector<std::string> lines;
  for (const auto& [what, count] : counts_) lines.push_back(std::to_string(count) + " " + what);
  return lines;
}

}  // namespace vibrosow
