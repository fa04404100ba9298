#include "vessel/vessel_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "portable_math/functions.hpp"
#include "vessel/directions.hpp"

namespace vibrosow {
namespace {

/// A chain of wall segments; each point after the first closes a segment.
class Chain {
 public:
  Chain(std::vector<WallSegment>& segments, double shortest) : segments_(segments), shortest_(shortest) {}

  /// Starts anew at `point`, joined to nothing.
  void start(const Eigen::Vector2d& point) { last_ = point; }

  void line_to(const Eigen::Vector2d& point, const std::string& name) {
    if ((point - last_).norm() <= shortest_) return;
    segments_.push_back({last_, point, name});
    last_ = point;
  }

 private:
  std::vector<WallSegment>& segments_;
  double shortest_;
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
};

double left_edge(const Hole& hole) {
  return hole.centre - hole.width / 2;
}
double right_edge(const Hole& hole) {
  return hole.centre + hole.width / 2;
}

double shortest(const Vessel& vessel) {
  return 1e-9 * vessel.length;
}

void add_box(const Vessel& vessel, std::vector<WallSegment>& segments) {
  const double slope = vessel.holes.empty() ? 0.0 : portable_math::tan(vessel.funnel);
  const std::size_t holes = vessel.holes.size();
  const double left_floor = holes == 0 ? 0.0 : slope * std::max(0.0, left_edge(vessel.holes.front()));
  const double right_floor = holes == 0 ? 0.0 : slope * std::max(0.0, vessel.length - right_edge(vessel.holes.back()));

  const bool end_walls = vessel.sides == Sides::walls;
  Chain chain(segments, shortest(vessel));
  chain.start({0, end_walls ? vessel.height : left_floor});
  if (end_walls) chain.line_to({0, left_floor}, vessel.name + " left wall");
  for (std::size_t piece = 0; piece <= holes; ++piece) {
    const std::string name = vessel.name + " floor " + std::to_string(piece + 1);
    if (piece > 0) chain.start({right_edge(vessel.holes[piece - 1]), 0});
    const bool between_holes = piece > 0 && piece < holes;
    if (between_holes && slope > 0) {
      const double from = right_edge(vessel.holes[piece - 1]);
      const double to = left_edge(vessel.holes[piece]);
      chain.line_to({(from + to) / 2, slope * (to - from) / 2}, name + " rising");
      chain.line_to({to, 0}, name + " falling");
    } else if (piece < holes) {
      chain.line_to({left_edge(vessel.holes[piece]), 0}, name);
    } else {
      chain.line_to({vessel.length, right_floor}, name);
    }
  }
  if (end_walls) chain.line_to({vessel.length, vessel.height}, vessel.name + " right wall");
}

/// A floor from -length to 2 length whose holes come again with every length.
class EndlessFloor {
 public:
  EndlessFloor(const Vessel& vessel, std::vector<WallSegment>& segments)
      : vessel_(vessel), chain_(segments, shortest(vessel)), least_(-vessel.length), most_(2 * vessel.length) {}

  void add() {
    if (vessel_.holes.empty()) return add_line({least_, 0}, {most_, 0}, vessel_.name + " floor 1");
    const double slope = portable_math::tan(vessel_.funnel);
    const std::size_t holes = vessel_.holes.size();
    for (int copy = -2; copy < 2; ++copy)
      for (std::size_t k = 0; k < holes; ++k) {
        const bool last = k + 1 == holes;
        const double shift = copy * vessel_.length;
        const double from = right_edge(vessel_.holes[k]) + shift;
        const double to = left_edge(vessel_.holes[last ? 0 : k + 1]) + (last ? shift + vessel_.length : shift);
        const Eigen::Vector2d ridge((from + to) / 2, slope * (to - from) / 2);
        const std::string name = vessel_.name + " floor " + std::to_string(k + 1);
        if (slope > 0) {
          add_line({from, 0}, ridge, name + " rising");
          add_line(ridge, {to, 0}, name + " falling");
        } else {
          add_line({from, 0}, {to, 0}, name);
        }
      }
  }

 private:
  void add_line(Eigen::Vector2d a, Eigen::Vector2d b, const std::string& name) {
    if (b.x() <= least_ || a.x() >= most_) return;
    const Eigen::Vector2d along = (b - a) / (b.x() - a.x());
    if (a.x() < least_) a += (least_ - a.x()) * along;
    if (b.x() > most_) b += (most_ - b.x()) * along;
    if (!begun_ || a != end_) chain_.start(a);
    chain_.line_to(b, name);
    begun_ = true, end_ = b;
  }

  const Vessel& vessel_;
  Chain chain_;
  double least_, most_;
  bool begun_ = false;
  Eigen::Vector2d end_ = Eigen::Vector2d::Zero();
};

Eigen::Vector2d on_arc(const WallPiece& arc, double angle) {
  return arc.centre + arc.radius * unit_vector(angle);
}

WallSegment segment_of(const WallPiece& piece, const Eigen::Vector2d& shift, const std::string& name) {
  if (piece.radius == 0) return {piece.a + shift, piece.b + shift, name, true};
  return {on_arc(piece, piece.from) + shift,
          on_arc(piece, piece.to) + shift,
          name,
          true,
          piece.centre + shift,
          piece.radius,
          piece.from,
          piece.to};
}

WallSegment gate(const Hole& hole, double shift, const std::string& name) {
  WallSegment wall{{left_edge(hole) + shift, 0}, {right_edge(hole) + shift, 0}, name};
  wall.opens_at = hole.open_at;
  return wall;
}

}  // namespace

std::vector<WallSegment> vessel_walls(const Vessel& vessel) {
  std::vector<WallSegment> walls;
  const bool periodic = vessel.sides == Sides::periodic;
  if (vessel.box) periodic ? EndlessFloor(vessel, walls).add() : add_box(vessel, walls);
  for (int copy = periodic ? -1 : 0; copy <= (periodic ? 1 : 0); ++copy) {
    const double shift = copy * vessel.length;
    for (std::size_t k = 0; k < vessel.pieces.size(); ++k)
      if (is_of_plane(vessel.pieces[k]))
        walls.push_back(segment_of(vessel.pieces[k], {shift, 0}, vessel.name + " piece " + std::to_string(k + 1)));
    for (std::size_t k = 0; k < vessel.holes.size(); ++k)
      if (vessel.holes[k].open_at > 0)
        walls.push_back(gate(vessel.holes[k], shift, vessel.name + " gate " + std::to_string(k + 1)));
  }
  return walls;
}

bool is_of_plane(const WallPiece& piece) {
  return !piece.about && piece.drawn_out == DrawnOut::across;
}

double highest_floor(const Vessel& vessel) {
  double highest = 0;
  for (const WallSegment& wall : vessel_walls(vessel)) {
    if (wall.name.find(" floor ") != std::string::npos) highest = std::max({highest, wall.a.y(), wall.b.y()});
  }
  return highest;
}

namespace {

/// The corners of what a piece that is turned about an axis looks like from the front.
std::array<Eigen::Vector2d, 4> corners_of_turned(const WallPiece& piece) {
  std::array<Eigen::Vector2d, 4> corners;
  std::size_t k = 0;
  for (const Eigen::Vector2d& end : {piece.a, piece.b})
    for (const double radius : {-end.x(), end.x()}) {
      const double aside = piece.about->x() + radius;
      corners[k++] =
          piece.axis == PieceAxis::upright ? Eigen::Vector2d(aside, end.y()) : Eigen::Vector2d(end.y(), aside);
    }
  return corners;
}

}  // namespace

Extent extent(const std::vector<WallPiece>& pieces) {
  Extent extent;
  const auto include = [&](const Eigen::Vector2d& at) {
    extent.low = extent.low.cwiseMin(at), extent.high = extent.high.cwiseMax(at);
  };
  for (const WallPiece& piece : pieces) {
    if (piece.about) {
      for (const Eigen::Vector2d& corner : corners_of_turned(piece)) include(corner);
    } else if (piece.radius == 0) {
      include(piece.a), include(piece.b);
    } else {
      include(on_arc(piece, piece.from)), include(on_arc(piece, piece.to));
      const double quarter = 0.5 * std::numbers::pi;
      for (double angle = quarter * std::ceil(piece.from / quarter); angle < piece.to; angle += quarter)
        include(on_arc(piece, angle));
    }
  }
  return extent;
}

double largest_radius(const Vessel& vessel, const Eigen::Vector2d& about) {
  double largest = 0;
  for (const WallSegment& wall : vessel_walls(vessel)) {
    largest = std::max({largest, (wall.a - about).norm(), (wall.b - about).norm()});
    if (wall.radius > 0) largest = std::max(largest, (wall.centre - about).norm() + wall.radius);
  }
  const auto include = [&](const Eigen::Vector2d& corner) { largest = std::max(largest, (corner - about).norm()); };
  for (const WallPiece& piece : vessel.pieces) {
    if (piece.about)
      for (const Eigen::Vector2d& corner : corners_of_turned(piece)) include(corner);
    else if (!is_of_plane(piece))
      for (const double y : {extent({piece}).low.y(), extent({piece}).high.y()})
        include({0, y}), include({vessel.length, y});
  }
  return largest;
}

namespace {

/// Distance (m) of the furthest point of a piece, from above.
double furthest(const WallPiece& piece, const Eigen::Vector2d& from) {
  if (piece.radius > 0) return (piece.centre - from).norm() + piece.radius;
  return std::max((piece.a - from).norm(), (piece.b - from).norm());
}

constexpr double of_drum_slack = 1e-4;  // of its radius, and rad: drawings are no more exact

/// Whether arcs about one centre leave no gap.
bool close_all_round(std::vector<WallPiece> arcs) {
  constexpr double turn = 2 * std::numbers::pi;
  for (WallPiece& arc : arcs) {
    const double turns = std::floor(arc.from / turn);
    arc.from -= turns * turn, arc.to -= turns * turn;
  }
  std::ranges::sort(arcs, {}, &WallPiece::from);
  double reached = arcs.front().from;
  for (const WallPiece& arc : arcs)
    if (arc.from <= reached + of_drum_slack) reached = std::max(reached, arc.to);
  return reached >= arcs.front().from + turn - of_drum_slack;
}

}  // namespace

bool DrumCircle::has(const Eigen::Vector2d& centre_of_arc, double radius_of_arc) const {
  const double slack = of_drum_slack * radius;
  return std::abs(radius_of_arc - radius) <= slack && (centre_of_arc - centre).norm() <= slack;
}

std::optional<DrumCircle> drum_of(const Vessel& vessel) {
  if (vessel.box) return std::nullopt;
  for (const WallPiece& piece : vessel.pieces) {
    if (piece.radius == 0 || !is_of_plane(piece)) continue;
    DrumCircle circle{piece.centre, piece.radius};
    const bool holds_all = std::ranges::all_of(vessel.pieces, [&](const WallPiece& other) {
      return !is_of_plane(other) || furthest(other, circle.centre) <= circle.radius * (1 + 2 * of_drum_slack);
    });
    std::vector<WallPiece> arcs;
    std::ranges::copy_if(vessel.pieces, std::back_inserter(arcs), [&](const WallPiece& other) {
      return is_of_plane(other) && other.radius > 0 && circle.has(other.centre, other.radius);
    });
    if (!holds_all || !close_all_round(arcs)) continue;
    for (const WallPiece& arc : arcs)
      if (arc.radius < circle.radius) circle = {arc.centre, arc.radius};
    return circle;
  }
  return std::nullopt;
}

bool is_only_drawn(const Vessel& vessel) {
  return !vessel.box && !drum_of(vessel);
}

double distance_to_wall(const WallSegment& wall, const Eigen::Vector2d& point) {
  const double to_ends = std::min((point - wall.a).norm(), (point - wall.b).norm());
  if (wall.radius > 0) {
    const Eigen::Vector2d arm = point - wall.centre;
    const double middle = 0.5 * (wall.from + wall.to), half = 0.5 * (wall.to - wall.from);
    const bool beside = arm.dot(unit_vector(middle)) >= arm.norm() * portable_math::cos(half);
    return beside ? std::abs(arm.norm() - wall.radius) : to_ends;
  }
  const Eigen::Vector2d along = wall.b - wall.a;
  const double part = (point - wall.a).dot(along) / along.squaredNorm();
  return part <= 0 || part >= 1 ? to_ends : (point - wall.a - part * along).norm();
}

}  // namespace vibrosow
