#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

// Curves of drawings as pieces of a wall.

WallPiece line_piece(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// From a to b about a centre, anticlockwise or clockwise; where they lie on each other a full circle.
WallPiece arc_piece(const Eigen::Vector2d& centre, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                    bool anticlockwise);

/// A polyline's arc from a to b: `bulge` is the tangent of a quarter of its angle, above 0 anticlockwise; 0: a line.
WallPiece bulge_piece(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double bulge);

/// Lines no further than `tolerance` from the Bezier curve of these four points.
void add_bezier(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, const Eigen::Vector2d& d,
                double tolerance, std::vector<WallPiece>& pieces);

/// Counts what is alike.
class Tally {
 public:
  void add(std::string what) { ++counts_[std::move(what)]; }
  /// "2 TEXT", in the order of the alphabet.
  std::vector<std::string> lines() const;

 private:
  std::map<std::string, int> counts_;
};

}  // namespace vibrosow
