#include "fields/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compute/nearest_image.hpp"

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

/// How far one grain moved against another: a bed may have moved as a whole by any part of a period.
template <int N>
Eigen::Matrix<double, N, 1> shorter_way(Eigen::Matrix<double, N, 1> moved, const Periods& periods) {
  if (periods.along > 0) moved[0] = nearest_image(moved[0], periods.along);
  if (N == 3 && periods.across > 0) moved[N - 1] = nearest_image(moved[N - 1], periods.across);
  return moved;
}

template <int N>
std::vector<std::optional<double>> strain_in(const Snapshot& before, const Snapshot& after, double reach,
                                             const Periods& periods) {
  const Snapshot bed = with_images(before, periods, reach);
  PointsOf<N> places, displacements;
  std::vector<std::size_t> grain;  // of `after`, of those that are no images
  for (std::size_t j = 0; j < bed.size(); ++j) {
    const auto found = std::ranges::lower_bound(after.id, bed.id[j]);
    if (found == after.id.end() || *found != bed.id[j]) continue;
    const auto i = static_cast<std::size_t>(found - after.id.begin());
    if (j < before.size()) grain.push_back(i);
    places.push_back(place_of<N>(bed, j));
    displacements.push_back(place_of<N>(after, i) - places.back());
  }
  const Neighbourhoods<N> neighbourhoods(places, reach);
  std::vector<std::optional<double>> strain(after.size());
  PointsOf<N> towards = displacements;
  for (std::size_t k = 0; k < grain.size(); ++k) {
    const std::vector<std::size_t> around = neighbourhoods.around(places[k]);
    for (const std::size_t j : around) towards[j] = shorter_way<N>(displacements[j] - displacements[k], periods);
    if (const auto gradient = fit_gradient<N>(places, towards, around)) strain[grain[k]] = shear(*gradient);
  }
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
      momentum +=
          weight * Eigen::Vector3d(velocities[i].x(), velocities[i].y(), snapshot.is_3d() ? snapshot.vz[grain] : 0.0);
      weights += weight;
    }
    if (weights > 0) cells[k] = CellMotion{momentum / weights, fit_gradient<2>(places, velocities, near)};
  }
  return cells;
}

std::vector<std::optional<double>> shear_strain(const Snapshot& before, const Snapshot& after, double reach,
                                                const Periods& periods) {
  return after.is_3d() ? strain_in<3>(before, after, reach, periods) : strain_in<2>(before, after, reach, periods);
}

}  // namespace vibrosow
