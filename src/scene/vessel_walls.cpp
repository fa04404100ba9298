#include "scene/vessel_walls.hpp"

#include <algorithm>
#include <cmath>

namespace vibrosow {
namespace {

/// A chain of wall segments; each vertex after the first closes a segment.
class Chain {
 public:
  Chain(std::vector<WallSegment>& segments, double shortest) : segments_(segments), shortest_(shortest) {}

  /// Starts anew at `point`, joined to nothing.
  void start(const Eigen::Vector2d& point) {
    last_ = point;
    ++vertex_;
  }

  void line_to(const Eigen::Vector2d& point, const std::string& name) {
    if ((point - last_).norm() <= shortest_) return;
    segments_.push_back({last_, point, vertex_, vertex_ + 1, name});
    start(point);
  }

 private:
  std::vector<WallSegment>& segments_;
  double shortest_;
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
  int vertex_ = -1;
};

double left_edge(const Hole& hole) {
  return hole.centre - hole.width / 2;
}
double right_edge(const Hole& hole) {
  return hole.centre + hole.width / 2;
}

}  // namespace

std::vector<WallSegment> vessel_walls(const Vessel& vessel) {
  const double slope = vessel.holes.empty() ? 0.0 : std::tan(vessel.funnel);
  const std::size_t holes = vessel.holes.size();
  const double left_floor = holes == 0 ? 0.0 : slope * std::max(0.0, left_edge(vessel.holes.front()));
  const double right_floor = holes == 0 ? 0.0 : slope * std::max(0.0, vessel.length - right_edge(vessel.holes.back()));

  std::vector<WallSegment> segments;
  Chain chain(segments, 1e-9 * vessel.length);
  chain.start({0, vessel.height});
  chain.line_to({0, left_floor}, vessel.name + " left wall");
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
  chain.line_to({vessel.length, vessel.height}, vessel.name + " right wall");
  return segments;
}

double highest_floor(const Vessel& vessel) {
  double highest = 0;
  for (const WallSegment& wall : vessel_walls(vessel)) {
    if (wall.name.find(" floor ") != std::string::npos) highest = std::max({highest, wall.a.y(), wall.b.y()});
  }
  return highest;
}

double largest_radius(const Vessel& vessel, const Eigen::Vector2d& about) {
  double largest = 0;
  for (const WallSegment& wall : vessel_walls(vessel))
    largest = std::max({largest, (wall.a - about).norm(), (wall.b - about).norm()});
  return largest;
}

}  // namespace vibrosow
