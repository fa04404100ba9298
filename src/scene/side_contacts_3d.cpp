#include "scene/side_contacts_3d.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "portable_math/functions.hpp"
#include "scene/cross_product.hpp"

namespace vibrosow {
namespace {

using Vector4 = Eigen::Matrix<double, 4, 1>;

/// The larger eigenvalue of A = [c]^T G^-1 [c], of which c itself is the third eigenvector: from the trace of A and of
/// its adjugate, |c|^2 c G c / det G.
double yield_at(const Eigen::Vector3d& c, const Eigen::Vector3d& g) {
  const Eigen::Vector3d c2 = c.cwiseProduct(c);
  const double trace = (c2.y() + c2.z()) / g.x() + (c2.x() + c2.z()) / g.y() + (c2.x() + c2.y()) / g.z();
  const double minors = c2.sum() * c2.dot(g) / (g.x() * g.y() * g.z());
  return 0.5 * (trace + std::sqrt(std::max(0.0, trace * trace - 4 * minors)));
}

double furthest_yield(const ClumpDisc& ball, const Eigen::Vector3d& gyration2) {
  const double a = std::sqrt(yield_at(centre_of(ball), gyration2)) + ball.radius / std::sqrt(gyration2.minCoeff());
  return a * a;
}

/// The largest eigenvalue of a symmetric matrix that has none below zero, from above to 2.2 %: the 64th root of the
/// trace of its 64th power.
double largest_eigenvalue(Eigen::Matrix4d matrix) {
  constexpr int squarings = 6;
  std::array<double, squarings + 1> traces;
  for (int k = 0; k <= squarings; ++k) {
    if (k > 0) matrix = (matrix * matrix).eval();
    traces[static_cast<std::size_t>(k)] = matrix.trace();
    matrix /= matrix.trace();
  }
  double root = 1;
  for (int k = squarings; k >= 0; --k)
    root = (k == squarings ? 1 : std::sqrt(root)) * traces[static_cast<std::size_t>(k)];
  return root;
}

class LeaningSolid {
 public:
  LeaningSolid(const std::vector<ClumpDisc>& balls, const std::vector<double>& weights,
               const Eigen::Vector3d& gyration2, double depth)
      : balls_(balls), weights_(weights), gyration2_(gyration2), depth_(depth) {}

  SideContacts most() {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      look_at(balls_[i], weights_[i]);
      for (std::size_t j = 0; j < balls_.size(); ++j) look_at(balls_[i], balls_[j]);
      for (std::size_t j = i + 1; j < balls_.size(); ++j)
        for (std::size_t k = j + 1; k < balls_.size(); ++k) look_at(balls_[i], balls_[j], balls_[k]);
    }
    return most_;
  }

 private:
  void look_at(const ClumpDisc& tip, double weight) {
    most_.at_a_tip = std::max(most_.at_a_tip, weight * (1 + yield_at(centre_of(tip), gyration2_)));
    most_.on_a_side = std::max(most_.on_a_side, weight);
    most_.turning = std::max(most_.turning, weight * furthest_yield(tip, gyration2_));
  }

  /// The planes that touch two balls from without, turned about them.
  void look_at(const ClumpDisc& a, const ClumpDisc& b) {
    const Eigen::Vector3d apart = centre_of(b) - centre_of(a);
    const double distance = apart.norm();
    if (!(distance > std::abs(a.radius - b.radius))) return;
    const Eigen::Vector3d axis = apart / distance;
    // The coordinate axis that lies most across it, made to lie across.
    Eigen::Index least = 0;
    axis.cwiseAbs().minCoeff(&least);
    const Eigen::Vector3d aside = Eigen::Vector3d::Unit(least) - axis[least] * axis;
    const Eigen::Vector3d e1 = aside / aside.norm(), e2 = cross(axis, e1);
    const double along = (a.radius - b.radius) / distance, across = std::sqrt(1 - along * along);
    constexpr int turns = 16;
    for (int k = 0; k < turns; ++k) {
      const auto [sine, cosine] = portable_math::sine_cosine(k * (2 * std::numbers::pi / turns));
      look_along(along * axis + across * (cosine * e1 + sine * e2));
    }
  }

  /// The two planes that touch three balls from without: n (b - a) = r_a - r_b, n (c - a) = r_a - r_c.
  void look_at(const ClumpDisc& a, const ClumpDisc& b, const ClumpDisc& c) {
    const Eigen::Vector3d u = centre_of(b) - centre_of(a), v = centre_of(c) - centre_of(a), w = cross(u, v);
    const double area2 = w.squaredNorm();
    constexpr double in_line = 1e-12;
    if (area2 <= in_line * u.squaredNorm() * v.squaredNorm()) return;
    const Eigen::Vector3d level = ((a.radius - b.radius) * cross(v, w) + (a.radius - c.radius) * cross(w, u)) / area2;
    const double rest = 1 - level.squaredNorm();
    if (rest < 0) return;  // one ball is hidden from every plane by the others
    const Eigen::Vector3d up = std::sqrt(rest / area2) * w;
    look_along(level + up), look_along(level - up);
  }

  /// On the side whose outward normal is n.
  void look_along(const Eigen::Vector3d& n) {
    const auto reach = [&n](const ClumpDisc& ball) { return n.dot(centre_of(ball)) + ball.radius; };
    const double furthest = reach(*std::ranges::max_element(balls_, {}, reach));
    SideContacts side{0, 0, 0, 0};
    Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
    for (std::size_t k = 0; k < balls_.size(); ++k) {
      const ClumpDisc& ball = balls_[k];
      if (reach(ball) < furthest - depth_ * ball.radius) continue;
      const Eigen::Vector3d turn = cross(centre_of(ball), n).cwiseQuotient(gyration2_.cwiseSqrt());
      const Vector4 v(1, turn.x(), turn.y(), turn.z());
      stiffness += weights_[k] * v * v.transpose();
      ++side.discs;
      side.turning += weights_[k] * ball.radius * ball.radius / gyration2_.minCoeff();
    }
    most_.discs = std::max(most_.discs, side.discs);
    most_.on_a_side = std::max(most_.on_a_side, largest_eigenvalue(stiffness));
    most_.turning = std::max(most_.turning, side.turning);
  }

  const std::vector<ClumpDisc>& balls_;
  const std::vector<double>& weights_;
  const Eigen::Vector3d gyration2_;
  const double depth_;
  SideContacts most_{1, 0, 0, 0};
};

}  // namespace

SideContacts side_contacts_3d(const std::vector<ClumpDisc>& balls, const std::vector<double>& weights,
                              const Eigen::Vector3d& gyration2, double depth) {
  return LeaningSolid(balls, weights, gyration2, depth).most();
}

double furthest_yield(const std::vector<ClumpDisc>& balls, const Eigen::Vector3d& gyration2) {
  double most = 0;
  for (const ClumpDisc& ball : balls) most = std::max(most, furthest_yield(ball, gyration2));
  return most;
}

}  // namespace vibrosow
