#pragma once

#include <cmath>

#include "contact/kernels.hpp"

namespace vibrosow {

/// What the kernel needs to know of one grain for a contact.
struct GrainSurface {
  double radius, compliance, inverse_mass, inverse_inertia, curvature;
};

/// Of two grains, or of a grain and a wall (radius 0 stands for its place, compliance its own, the rest 0).
template <class Law, class Effects>
inline PairConstants pair_constants(const GrainSurface& a, const GrainSurface& b, const SurfaceParameters& surface) {
  PairConstants p{};
  p.reach = a.radius + b.radius;
  p.stiffness = Law::stiffness(a.compliance, b.compliance, a.curvature, b.curvature);
  if constexpr (Effects::damping) p.dashpot = Law::dashpot(surface, p.stiffness, a.inverse_mass, b.inverse_mass);
  const double compliance = a.compliance + b.compliance;
  p.share_i = a.compliance / compliance;
  p.share_j = b.compliance / compliance;
  const double at_i = p.share_i * a.curvature, at_j = p.share_j * b.curvature;
  p.compression_per_overlap = at_i > at_j ? at_i : at_j;
  if constexpr (Effects::rolls) p.rolling_radius = 1 / (a.curvature + b.curvature);
  if constexpr (Effects::rolling == Rolling::spring) {
    // 1 / (I + m r^2) of each, about the contact; a wall has none, a grain kept from turning neither
    const auto yield = [](const GrainSurface& g) {
      return g.inverse_inertia > 0
                 ? g.inverse_inertia * g.inverse_mass / (g.inverse_mass + g.inverse_inertia * g.radius * g.radius)
                 : 0.0;
    };
    const double both = yield(a) + yield(b);
    p.rolling_inertia = both > 0 ? 1 / both : 0;
  }
  return p;
}

/// Properties of two grains as the kernel sees them: constants for equal grains, worked out pair by pair for unequal
/// ones from the same expressions, so that both give the same bits for equal grains.
template <class Law, class Effects>
class PairProperties {
 public:
  PairProperties(const Grains& grains, const ContactParameters& parameters) : grains_(grains), parameters_(parameters) {
    if constexpr (!Effects::unequal)
      equal_ = pair_constants<Law, Effects>(surface(0), surface(0), parameters.pair(0, 0));
  }

  double reach(std::size_t i, std::size_t j) const {
    if constexpr (Effects::unequal) return grains_.radius[i] + grains_.radius[j];
    return equal_.reach;
  }
  double radius(std::size_t i) const {
    if constexpr (Effects::unequal) return grains_.radius[i];
    return 0.5 * equal_.reach;
  }
  const SurfaceParameters& between(std::size_t i, std::size_t j) const {
    if constexpr (Effects::unequal) return parameters_.pair(grains_.lot[i], grains_.lot[j]);
    return parameters_.pairs.front();
  }
  PairConstants pair(std::size_t i, std::size_t j) const {
    if constexpr (Effects::unequal) return pair_constants<Law, Effects>(surface(i), surface(j), between(i, j));
    return equal_;
  }

 private:
  GrainSurface surface(std::size_t i) const {
    if constexpr (Effects::unequal)
      return {grains_.radius[i], grains_.compliance[i], grains_.inverse_mass[i], grains_.inverse_inertia[i],
              grains_.curvature[i]};
    const GrainKind& kind = grains_.kinds.front();
    return {kind.radius, kind.compliance, kind.inverse_mass, kind.inverse_inertia, 1 / kind.radius};
  }

  const Grains& grains_;
  const ContactParameters& parameters_;
  PairConstants equal_{};
};

template <class Law, class Effects>
void pair_forces(const Grains& grains, const Motion& at, const PairList& list, const ContactParameters& parameters,
                 const HistoryAdvance& advance, ContactHistory& history, Forces& forces, ContactCensus& census) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  const double shortening = parameters.arm_shortening;
  const double *x = at.x, *y = at.y, *vx = at.vx, *vy = at.vy;
  double *fx = forces.fx.data(), *fy = forces.fy.data(), *torque = forces.torque.data();
  const int *first = list.first.data(), *partner = list.partner.data();
  double max_compression = census.max_compression;
  std::int64_t contacts = 0;

  for (std::size_t i = 0; i < list.grains(); ++i) {
    const double xi = at.row_x[i], yi = y[i];
    double fxi = fx[i], fyi = fy[i];
    [[maybe_unused]] double torque_i = 0;
    if constexpr (Effects::rotation) torque_i = torque[i];
    for (int k = first[i]; k < first[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(partner[k]), entry = static_cast<std::size_t>(k);
      const double dx = x[j] - xi, dy = y[j] - yi;
      const double distance2 = dx * dx + dy * dy;
      const double reach = properties.reach(i, j);
      if (distance2 >= reach * reach) {
        forget_contact<Effects>(advance, history, entry);
        continue;
      }
      const PairConstants pair = properties.pair(i, j);
      const double distance = std::sqrt(distance2);
      // Coincident centres have no normal: any fixed one parts them.
      const double nx = distance > 0 ? dx / distance : 1, ny = distance > 0 ? dy / distance : 0;
      const double overlap = reach - distance;
      const double compression = overlap * pair.compression_per_overlap;
      max_compression = compression > max_compression ? compression : max_compression;
      ++contacts;

      Touch touch{overlap, 0, 0, 0};
      [[maybe_unused]] double arm_i = 0, arm_j = 0;
      if constexpr (Effects::damping || Effects::friction) {
        const double ux = vx[i] - vx[j], uy = vy[i] - vy[j];
        if constexpr (Effects::damping) touch.approach = ux * nx + uy * ny;
        if constexpr (Effects::friction) touch.sliding = uy * nx - ux * ny;
        if constexpr (Effects::rotation) {
          arm_i = properties.radius(i) - shortening * overlap * pair.share_i;
          arm_j = properties.radius(j) - shortening * overlap * pair.share_j;
          touch.sliding += arm_i * at.omega[i] + arm_j * at.omega[j];
        }
        if constexpr (Effects::rolls) touch.turning = at.omega[i] - at.omega[j];
      }
      const ContactForce force =
          contact_force<Law, Effects>(touch, pair, properties.between(i, j), advance, history, entry);
      // On i: -F_n n - F_t t with t = (-n_y, n_x).
      double px = force.normal * nx, py = force.normal * ny;
      if constexpr (Effects::friction) px -= force.tangential * ny, py += force.tangential * nx;
      fxi -= px, fyi -= py;
      fx[j] += px, fy[j] += py;
      if constexpr (Effects::rotation) {
        torque_i -= arm_i * force.tangential;
        torque[j] -= arm_j * force.tangential;
      }
      if constexpr (Effects::rolls) torque_i += force.rolling, torque[j] -= force.rolling;
    }
    fx[i] = fxi, fy[i] = fyi;
    if constexpr (Effects::rotation) torque[i] = torque_i;
  }
  census.max_compression = max_compression;
  census.contacts += contacts;
}

template <class Law, class Effects>
double pair_energy(const Grains& grains, const Motion& at, const PairList& list, const ContactParameters& parameters,
                   const ContactHistory& history) {
  const PairProperties<Law, Effects> properties(grains, parameters);
  double energy = 0;
  for (std::size_t i = 0; i < list.grains(); ++i) {
    for (int k = list.first[i]; k < list.first[i + 1]; ++k) {
      const std::size_t entry = static_cast<std::size_t>(k), j = static_cast<std::size_t>(list.partner[entry]);
      const double dx = at.x[j] - at.row_x[i], dy = at.y[j] - at.y[i];
      const double overlap = properties.reach(i, j) - std::sqrt(dx * dx + dy * dy);
      if (overlap > 0)
        energy +=
            contact_energy<Law, Effects>(overlap, properties.pair(i, j), properties.between(i, j), history, entry);
    }
  }
  return energy;
}

}  // namespace vibrosow
