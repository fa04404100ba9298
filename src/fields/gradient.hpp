#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace vibrosow {

using Points = std::vector<Eigen::Vector2d>;

/// Finds the points within `reach` (m) of a place, always in the same order.
class Neighbourhoods {
 public:
  Neighbourhoods(const Points& points, double reach);
  std::vector<std::size_t> around(const Eigen::Vector2d& place) const;

 private:
  std::pair<std::int64_t, std::int64_t> bin_of(const Eigen::Vector2d& point) const;

  const Points& points_;
  double reach_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> bins_;
};

/// G of the least-squares fit u(x) = u0 + G x through the points of `which`, all weighing the same: G_ab = du_a / dx_b.
/// None for fewer than three points or for points on a line.
std::optional<Eigen::Matrix2d> fit_gradient(const Points& points, const Points& values,
                                            const std::vector<std::size_t>& which);

/// Shear of a gradient G: sqrt((G_xx - G_yy)^2 + (G_xy + G_yx)^2). Of a velocity gradient the shear rate, the
/// difference of the principal stretch rates; of a displacement gradient the shear strain, the difference of the
/// principal stretches of 1 + G while that turns nothing inside out. In simple shear du_x = g dy it is |g| at any size
/// of g; in a rotation, however large, and in an even expansion it is 0.
double shear(const Eigen::Matrix2d& gradient);

/// Dilation rate of a velocity gradient: its trace, above 0 where the bed loosens.
double dilation(const Eigen::Matrix2d& gradient);

}  // namespace vibrosow
