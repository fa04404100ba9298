#pragma once

#include <cmath>

#include "contact/kernels.hpp"

namespace vibrosow {

/// Effects that enter the pair force, as a compile-time choice. Rotation needs friction.
template <bool friction_, bool rotation_, bool damping_, bool unequal_>
struct PairEffects {
  static constexpr bool friction = friction_, rotation = rotation_, damping = damping_, unequal = unequal_;
};

/// Properties of two grains as the kernel sees them: constants for equal grains, loads and a division for unequal ones,
/// from the same expressions, so that both give the same bits for equal grains.
template <class Law, class Effects>
class PairProperties {
 public:
  PairProperties(const Grains& grains, const ContactParameters& parameters)
      : grains_(grains), damping_ratio_(parameters.seed.damping_ratio) {
    if constexpr (!Effects::unequal) {
      const GrainKind& kind = grains.kinds.front();
      radius_ = kind.radius;
      equal_ = combine(kind.radius, kind.radius, kind.compliance, kind.compliance, kind.inverse_mass, kind.inverse_mass,
                       1 / kind.radius, 1 / kind.radius);
    }
  }

  struct Pair {
    double reach, stiffness, damping, share_i, share_j, compression_per_overlap;
  };

  double reach(std::size_t i, std::size_t j) const {
    if constexpr (Effects::unequal) return grains_.radius[i] + grains_.radius[j];
    return equal_.reach;
  }
  double radius(std::size_t i) const {
    if constexpr (Effects::unequal) return grains_.radius[i];
    return radius_;
  }
  Pair pair(std::size_t i, std::size_t j) const {
    if constexpr (Effects::unequal)
      return combine(grains_.radius[i], grains_.radius[j], grains_.compliance[i], grains_.compliance[j],
                     grains_.inverse_mass[i], grains_.inverse_mass[j], grains_.curvature[i], grains_.curvature[j]);
    return equal_;
  }

 private:
  Pair combine(double ri, double rj, double si, double sj, double wi, double wj, double ci, double cj) const {
    Pair p{};
    p.reach = ri + rj;
    p.stiffness = Law::stiffness(si, sj);
    if constexpr (Effects::damping) p.damping = Law::damping(damping_ratio_, p.stiffness, wi, wj);
    p.share_i = si * p.stiffness;
    p.share_j = sj * p.stiffness;
    const double at_i = p.share_i * ci, at_j = p.share_j * cj;
    p.compression_per_overlap = at_i > at_j ? at_i : at_j;
    return p;
  }

  const Grains& grains_;
  double damping_ratio_;
  double radius_ = 0;
  Pair equal_{};
};

template <class Law, class Effects>
void pair_forces(const Grains& grains, const Motion& at, const PairList& list, const ContactParameters& parameters,
                 Forces& forces, ContactCensus& census) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  const SurfaceParameters surface = parameters.seed;
  const double shortening = parameters.arm_shortening;
  const double *x = at.x, *y = at.y, *vx = at.vx, *vy = at.vy;
  double *fx = forces.fx.data(), *fy = forces.fy.data(), *torque = forces.torque.data();
  const int *first = list.first.data(), *partner = list.partner.data();
  double max_compression = census.max_compression;
  std::int64_t contacts = 0;

  for (std::size_t i = 0; i < list.grains(); ++i) {
    const double xi = x[i], yi = y[i];
    double fxi = fx[i], fyi = fy[i];
    [[maybe_unused]] double torque_i = 0;
    if constexpr (Effects::rotation) torque_i = torque[i];
    for (int k = first[i]; k < first[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(partner[k]);
      const double dx = x[j] - xi, dy = y[j] - yi;
      const double distance2 = dx * dx + dy * dy;
      const double reach = properties.reach(i, j);
      if (distance2 >= reach * reach) continue;
      const auto pair = properties.pair(i, j);
      const double distance = std::sqrt(distance2);
      // Coincident centres have no normal: any fixed one parts them.
      const double nx = distance > 0 ? dx / distance : 1, ny = distance > 0 ? dy / distance : 0;
      const double overlap = reach - distance;
      const double compression = overlap * pair.compression_per_overlap;
      max_compression = compression > max_compression ? compression : max_compression;
      ++contacts;

      [[maybe_unused]] double approach = 0, sliding = 0, arm_i = 0, arm_j = 0;
      if constexpr (Effects::damping || Effects::friction) {
        const double ux = vx[i] - vx[j], uy = vy[i] - vy[j];
        if constexpr (Effects::damping) approach = ux * nx + uy * ny;
        if constexpr (Effects::friction) sliding = uy * nx - ux * ny;
        if constexpr (Effects::rotation) {
          arm_i = properties.radius(i) - shortening * overlap * pair.share_i;
          arm_j = properties.radius(j) - shortening * overlap * pair.share_j;
          sliding += arm_i * at.omega[i] + arm_j * at.omega[j];
        }
      }
      const auto force = contact_force<Law, Effects::friction, Effects::damping>(overlap, approach, sliding,
                                                                                 pair.stiffness, pair.damping, surface);
      // On i: -F_n n - F_t t with t = (-n_y, n_x).
      double px = force.normal * nx, py = force.normal * ny;
      if constexpr (Effects::friction) px -= force.tangential * ny, py += force.tangential * nx;
      fxi -= px, fyi -= py;
      fx[j] += px, fy[j] += py;
      if constexpr (Effects::rotation) {
        torque_i -= arm_i * force.tangential;
        torque[j] -= arm_j * force.tangential;
      }
    }
    fx[i] = fxi, fy[i] = fyi;
    if constexpr (Effects::rotation) torque[i] = torque_i;
  }
  census.max_compression = max_compression;
  census.contacts += contacts;
}

}  // namespace vibrosow
