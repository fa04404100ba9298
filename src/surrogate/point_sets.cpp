#include "surrogate/point_sets.hpp"

#include <boost/random/sobol.hpp>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "grains/random.hpp"

namespace vibrosow {
namespace {

constexpr int sets_drawn = 50;

Eigen::MatrixXd one_hypercube(Eigen::Index count, Eigen::Index dimensions, Random& random) {
  Eigen::MatrixXd points(count, dimensions);
  std::vector<Eigen::Index> cells(static_cast<std::size_t>(count));
  for (Eigen::Index d = 0; d < dimensions; ++d) {
    std::iota(cells.begin(), cells.end(), Eigen::Index{0});
    for (std::size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[random.below(i)]);
    for (Eigen::Index i = 0; i < count; ++i)
      points(i, d) =
          (static_cast<double>(cells[static_cast<std::size_t>(i)]) + random.uniform()) / static_cast<double>(count);
  }
  return points;
}

/// Square of the distance of the nearest two.
double least_distance2(const Eigen::MatrixXd& points) {
  double least = static_cast<double>(points.cols());
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) least = std::min(least, (points.row(i) - points.row(j)).squaredNorm());
  return least;
}

}  // namespace

Eigen::MatrixXd latin_hypercube(Eigen::Index count, Eigen::Index dimensions, std::uint64_t random_seed) {
  Random random(random_seed);
  Eigen::MatrixXd best;
  double farthest = -1;
  for (int k = 0; k < sets_drawn; ++k) {
    Eigen::MatrixXd points = one_hypercube(count, dimensions, random);
    const double distance2 = least_distance2(points);
    if (distance2 <= farthest) continue;
    farthest = distance2;
    best = std::move(points);
  }
  return best;
}

Eigen::MatrixXd sobol_points(Eigen::Index count, Eigen::Index dimensions) {
  if (dimensions < 1) throw std::invalid_argument("Sobol's sequence needs a dimension");
  boost::random::sobol sequence(static_cast<std::size_t>(dimensions));  // begins after its zero
  Eigen::MatrixXd points(count, dimensions);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index d = 0; d < dimensions; ++d)
      points(i, d) = (static_cast<double>(sequence() >> 11) + 0.5) * 0x1p-53;
  return points;
}

}  // namespace vibrosow
