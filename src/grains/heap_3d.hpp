#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "grains/places.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Balls that lie in a vessel, in columns at least as wide as the largest of them, from one period to the next where
/// its ends are periodic.
class Heap3d {
 public:
  /// `largest`: diameter of the largest ball that comes, m, up to the vessel's length and depth.
  Heap3d(const Vessel& vessel, double largest);

  void add(const Eigen::Vector3d& centre, double radius);

  /// Height of the centre of a ball that falls at `place` when it first touches another; at least `least`. All in m.
  double touching_height(const FloorPlace& place, double radius, double least) const;

 private:
  struct Ball {
    double x, y, z, radius;  // m
  };

  /// The columns along one direction.
  struct Direction {
    std::size_t count;
    double width, length;  // m
    bool periodic;

    Direction(double whole, double largest, Sides sides);
    std::size_t at(double place) const;
    double apart(double a, double b) const;
    /// The column of a place and those beside it, each once.
    template <class Visit>
    void for_each_near(double place, Visit visit) const;
  };

  double touching_height(const Ball& ball, const FloorPlace& place, double radius) const;

  double largest_;  // m, diameter
  Direction x_, z_;
  std::vector<std::vector<std::vector<Ball>>> columns_;  // [column][row] -> balls
};

}  // namespace vibrosow
