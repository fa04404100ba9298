#include "fields/gradient.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "portable_math/functions.hpp"

namespace vibrosow {

template <int N>
Neighbourhoods<N>::Neighbourhoods(const PointsOf<N>& points, double reach) : points_(points), reach_(reach) {
  for (std::size_t i = 0; i < points.size(); ++i) bins_[bin_of(points[i])].push_back(i);
}

template <int N>
typename Neighbourhoods<N>::Bin Neighbourhoods<N>::bin_of(const Point& point) const {
  Bin bin;
  for (int axis = 0; axis < N; ++axis)
    bin[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(point[axis] / reach_));
  return bin;
}

template <int N>
std::vector<std::size_t> Neighbourhoods<N>::around(const Point& place) const {
  std::vector<std::size_t> found;
  const Bin middle = bin_of(place);
  constexpr int bins = N == 2 ? 9 : 27;
  for (int k = 0; k < bins; ++k) {
    Bin at = middle;
    for (int axis = N - 1, digits = k; axis >= 0; --axis, digits /= 3)
      at[static_cast<std::size_t>(axis)] += digits % 3 - 1;
    const auto bin = bins_.find(at);
    if (bin == bins_.end()) continue;
    for (const std::size_t i : bin->second)
      if ((points_[i] - place).squaredNorm() <= reach_ * reach_) found.push_back(i);
  }
  return found;
}

template <int N>
std::optional<Eigen::Matrix<double, N, N>> fit_gradient(const PointsOf<N>& points, const PointsOf<N>& values,
                                                        const std::vector<std::size_t>& which) {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  if (which.size() < N + 1) return std::nullopt;
  Vector centre = Vector::Zero(), mean = Vector::Zero();
  for (const std::size_t i : which) centre += points[i], mean += values[i];
  centre /= static_cast<double>(which.size()), mean /= static_cast<double>(which.size());
  Matrix spread = Matrix::Zero(), mixed = Matrix::Zero();
  for (const std::size_t i : which) {
    const Vector arm = points[i] - centre;
    spread += arm * arm.transpose();
    mixed += (values[i] - mean) * arm.transpose();
  }
  double flat = 1e-6;
  for (int axis = 0; axis < N; ++axis) flat *= spread.trace();
  if (spread.determinant() <= flat) return std::nullopt;
  return mixed * spread.inverse();
}

template class Neighbourhoods<2>;
template class Neighbourhoods<3>;
template std::optional<Eigen::Matrix2d> fit_gradient<2>(const PointsOf<2>&, const PointsOf<2>&,
                                                        const std::vector<std::size_t>&);
template std::optional<Eigen::Matrix3d> fit_gradient<3>(const PointsOf<3>&, const PointsOf<3>&,
                                                        const std::vector<std::size_t>&);

double shear(const Eigen::Matrix2d& gradient) {
  return portable_math::hypot(gradient(0, 0) - gradient(1, 1), gradient(0, 1) + gradient(1, 0));
}

double shear(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d stretched = Eigen::Matrix3d::Identity() + gradient;
  const Eigen::Vector3d stretches = Eigen::JacobiSVD<Eigen::Matrix3d>(stretched).singularValues();
  return stretches[0] - stretches[2];  // in falling order
}

double dilation(const Eigen::Matrix2d& gradient) {
  return gradient.trace();
}

}  // namespace vibrosow
