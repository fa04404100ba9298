#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "grains/random.hpp"
#include "selection/front.hpp"
#include "surrogate/smooth_fit.hpp"

namespace vibrosow {

struct FrontSearchOptions {
  std::vector<std::size_t> values{};  // of each axis, how many different ones; one axis at least, each with some
  FrontQuestion question{};
  std::size_t first_points = 16;  // of the Latin hypercube that it begins with
  int budget = 300;               // observations of all points
  int most = 40;                  // of a point
};

/// Looks for the points of a space that no other dominates, by observations that it asks for round by round. A Latin
/// hypercube comes first. Then, in each round, two thirds of the observations are of new points. For each, candidates
/// are made: most take their values at random from two of those that lead by their means, and step away from them along
/// one axis or more, by up to a third of it. A smooth fit of each figure says which candidate is best by the goals, of
/// which each has a weight drawn at random for that point (as in ParEGO: Knowles 2006, IEEE Transactions on
/// Evolutionary Computation 10(1)). The other observations, and the last quarter of all, go to those that are nearly on
/// the front, fewest first.
class FrontSearch {
 public:
  /// Of each axis which value, from 0.
  using Point = std::vector<std::size_t>;

  /// Throws std::invalid_argument for a space without axes or values, or fewer than 2 first observations.
  explicit FrontSearch(FrontSearchOptions options);

  /// Asks for more observations once all that were asked for are there; for none where the search is over.
  void request_next_round();

  /// How many observations each point should have by what was asked for. New points come last.
  const std::vector<int>& counts() const { return counts_; }

  /// Of the points in any order, of each as many as were asked for.
  void take(std::size_t point, const FrontObservation& observation) { front_.take(point, observation); }

  /// A point that there is no system for: it counts as one observation and comes no more.
  void leave_out(std::size_t point);

  const std::vector<Point>& points() const { return points_; }
  const Front& front() const { return front_; }

 private:
  int left() const;
  void begin();
  bool add(Point point);
  Point random_point();
  Point near(const std::vector<std::size_t>& leading);
  std::vector<double> place_of(const Point& point) const;
  void fit(const std::vector<std::size_t>& best);
  double cost_of(const Point& point, const std::vector<double>& weights, const std::vector<Band>& ranges) const;
  std::vector<Band> ranges_of(const std::vector<std::size_t>& leading) const;
  bool propose_one(const std::vector<std::size_t>& leading, const std::vector<Band>& ranges);
  int propose(int observations);
  int resolve(int observations);

  FrontSearchOptions options_;
  Front front_;
  Random random_{1};
  std::vector<SmoothFit> fits_;  // of each figure
  std::vector<Point> points_;
  std::set<Point> known_;
  std::vector<int> counts_;
};

}  // namespace vibrosow
