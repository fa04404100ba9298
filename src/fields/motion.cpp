#include "fields/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrosow {
namespace {

Points points_of(const std::vector<double>& x, const std::vector<double>& y) {
  Points points;
  for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i]);
  return points;
}

double lucy_kernel(double q) {
  return (1 + 3 * q) * (1 - q) * (1 - q) * (1 - q);
}

}  // namespace

double fit_reach(const Snapshot& snapshot) {
  if (snapshot.size() == 0) return 0;
  const double sum = std::accumulate(snapshot.radius.begin(), snapshot.radius.end(), 0.0);
  return 3 * 2 * sum / static_cast<double>(snapshot.size());
}

std::vector<std::optional<CellMotion>> cell_motion(const Snapshot& snapshot, const Grid& grid, double reach) {
  const Points places = points_of(snapshot.x, snapshot.y), velocities = points_of(snapshot.vx, snapshot.vy);
  const Neighbourhoods neighbourhoods(places, reach);
  std::vector<std::optional<CellMotion>> cells(grid.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const Eigen::Vector2d centre = grid.centre(k);
    const std::vector<std::size_t> near = neighbourhoods.around(centre);
    Eigen::Vector2d momentum = Eigen::Vector2d::Zero();
    double weights = 0;
    for (const std::size_t i : near) {
      const double weight = snapshot.mass[i] * lucy_kernel(std::min(1.0, (places[i] - centre).norm() / reach));
      momentum += weight * velocities[i];
      weights += weight;
    }
    if (weights > 0) cells[k] = CellMotion{momentum / weights, fit_gradient(places, velocities, near)};
  }
  return cells;
}

std::vector<std::optional<double>> shear_strain(const Snapshot& before, const Snapshot& after, double reach) {
  Points places, displacements;
  std::vector<std::size_t> grain;  // of `after`
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto found = std::ranges::lower_bound(before.id, after.id[i]);
    if (found == before.id.end() || *found != after.id[i]) continue;
    const auto j = static_cast<std::size_t>(found - before.id.begin());
    grain.push_back(i);
    places.emplace_back(before.x[j], before.y[j]);
    displacements.emplace_back(after.x[i] - before.x[j], after.y[i] - before.y[j]);
  }
  const Neighbourhoods neighbourhoods(places, reach);
  std::vector<std::optional<double>> strain(after.size());
  for (std::size_t k = 0; k < grain.size(); ++k)
    if (const auto gradient = fit_gradient(places, displacements, neighbourhoods.around(places[k])))
      strain[grain[k]] = shear(*gradient);
  return strain;
}

}  // namespace vibrosow
