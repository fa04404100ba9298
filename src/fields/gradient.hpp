#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace vibrosow {

/// Points of the plane (N = 2) or of space (N = 3).
template <int N>
using PointsOf = std::vector<Eigen::Matrix<double, N, 1>>;
using Points = PointsOf<2>;

/// Finds the points within `reach` (m) of a place, always in the same order.
template <int N>
class Neighbourhoods {
 public:
  using Point = Eigen::Matrix<double, N, 1>;
  Neighbourhoods(const PointsOf<N>& points, double reach);
  std::vector<std::size_t> around(const Point& place) const;

 private:
  using Bin = std::array<std::int64_t, N>;
  Bin bin_of(const Point& point) const;

  const PointsOf<N>& points_;
  double reach_;
  std::map<Bin, std::vector<std::size_t>> bins_;
};

/// G of the least-squares fit u(x) = u0 + G x through the points of `which`, all weighing the same: G_ab = du_a / dx_b.
/// None for fewer than N + 1 points or for points on a line, in 3D on a plane.
template <int N>
std::optional<Eigen::Matrix<double, N, N>> fit_gradient(const PointsOf<N>& points, const PointsOf<N>& values,
                                                        const std::vector<std::size_t>& which);

/// Shear of a gradient G: sqrt((G_xx - G_yy)^2 + (G_xy + G_yx)^2). Of a velocity gradient the shear rate, the
/// difference of the principal stretch rates; of a displacement gradient the shear strain, the difference of the
/// principal stretches of 1 + G while that turns nothing inside out. In simple shear du_x = g dy it is |g| at any size
/// of g; in a rotation, however large, and in an even expansion it is 0.
double shear(const Eigen::Matrix2d& gradient);

/// Shear strain of a displacement gradient in 3D: the largest less the smallest principal stretch of 1 + G. In
/// simple shear it is |g|, in a rotation and in an even expansion 0, as above.
double shear(const Eigen::Matrix3d& gradient);

/// Dilation rate of a velocity gradient: its trace, above 0 where the bed loosens.
double dilation(const Eigen::Matrix2d& gradient);

}  // namespace vibrosow
