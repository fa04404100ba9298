#include "fields/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrosow {
namespace {

Points points_of(const std::vector<double>& x, const std::vector<double>& y, const std::vector<std::size_t>& which) {
  Points points;
  for (const std::size_t i : which) points.emplace_back(x[i], y[i]);
  return points;
}

template <int N>
Eigen::Matrix<double, N, 1> place_of(const Snapshot& s, std::size_t i) {
  if constexpr (N == 3)
    return {s.x[i], s.y[i], s.z[i]};
  else
    return {s.x[i], s.y[i]};
}

template <int N>
std::vector<std::optional<double>> strain_in(const Snapshot& before, const Snapshot& after, double reach) {
  PointsOf<N> places, displacements;
  std::vector<std::size_t> grain;  // of `after`
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto found = std::ranges::lower_bound(before.id, after.id[i]);
    if (found == before.id.end() || *found != after.id[i]) continue;
    const auto j = static_cast<std::size_t>(found - before.id.begin());
    grain.push_back(i);
    places.push_back(place_of<N>(before, j));
    displacements.push_back(place_of<N>(after, i) - places.back());
  }
  const Neighbourhoods<N> neighbourhoods(places, reach);
  std::vector<std::optional<double>> strain(after.size());
  for (std::size_t k = 0; k < grain.size(); ++k)
    if (const auto gradient = fit_gradient<N>(places, displacements, neighbourhoods.around(places[k])))
      strain[grain[k]] = shear(*gradient);
  return strain;
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

std::vector<std::optional<CellMotion>> cell_motion(const Snapshot& snapshot, const Grid& grid, double reach,
                                                   const MapPart& part) {
  const std::vector<std::size_t> grains = grains_in(snapshot, part);
  const Points places = points_of(snapshot.x, snapshot.y, grains),
               velocities = points_of(snapshot.vx, snapshot.vy, grains);
  const Neighbourhoods<2> neighbourhoods(places, reach);
  std::vector<std::optional<CellMotion>> cells(grid.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const Eigen::Vector2d centre = grid.centre(k);
    const std::vector<std::size_t> near = neighbourhoods.around(centre);
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const std::size_t i : near) {
      const std::size_t grain = grains[i];
      const double weight = snapshot.mass[grain] * lucy_kernel(std::min(1.0, (places[i] - centre).norm() / reach));
      momentum += weight *
                  Eigen::Vector3d(velocities[i].x(), velocities[i].y(), snapshot.in_space() ? snapshot.vz[grain] : 0.0);
      weights += weight;
    }
    if (weights > 0) cells[k] = CellMotion{momentum / weights, fit_gradient<2>(places, velocities, near)};
  }
  return cells;
}

std::vector<std::optional<double>> shear_strain(const Snapshot& before, const Snapshot& after, double reach) {
  return after.in_space() ? strain_in<3>(before, after, reach) : strain_in<2>(before, after, reach);
}

}  // namespace vibrosow
