#include "fields/gradient.hpp"

#include <Eigen/LU>
#include <cmath>

#include "elementary/functions.hpp"

namespace vibrosow {

Neighbourhoods::Neighbourhoods(const Points& points, double reach) : points_(points), reach_(reach) {
  for (std::size_t i = 0; i < points.size(); ++i) bins_[bin_of(points[i])].push_back(i);
}

std::pair<std::int64_t, std::int64_t> Neighbourhoods::bin_of(const Eigen::Vector2d& point) const {
  return {static_cast<std::int64_t>(std::floor(point.x() / reach_)),
          static_cast<std::int64_t>(std::floor(point.y() / reach_))};
}

std::vector<std::size_t> Neighbourhoods::around(const Eigen::Vector2d& place) const {
  std::vector<std::size_t> found;
  const auto [column, row] = bin_of(place);
  for (std::int64_t c = column - 1; c <= column + 1; ++c)
    for (std::int64_t r = row - 1; r <= row + 1; ++r) {
      const auto bin = bins_.find({c, r});
      if (bin == bins_.end()) continue;
      for (const std::size_t i : bin->second)
        if ((points_[i] - place).squaredNorm() <= reach_ * reach_) found.push_back(i);
    }
  return found;
}

std::optional<Eigen::Matrix2d> fit_gradient(const Points& points, const Points& values,
                                            const std::vector<std::size_t>& which) {
  if (which.size() < 3) return std::nullopt;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero(), mean = Eigen::Vector2d::Zero();
  for (const std::size_t i : which) centre += points[i], mean += values[i];
  centre /= static_cast<double>(which.size()), mean /= static_cast<double>(which.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), mixed = Eigen::Matrix2d::Zero();
  for (const std::size_t i : which) {
    const Eigen::Vector2d arm = points[i] - centre;
    spread += arm * arm.transpose();
    mixed += (values[i] - mean) * arm.transpose();
  }
  const double along = spread.trace();
  if (spread.determinant() <= 1e-6 * along * along) return std::nullopt;
  return mixed * spread.inverse();
}

double shear(const Eigen::Matrix2d& gradient) {
  return elementary::hypot(gradient(0, 0) - gradient(1, 1), gradient(0, 1) + gradient(1, 0));
}

double dilation(const Eigen::Matrix2d& gradient) {
  return gradient.trace();
}

}  // namespace vibrosow
