#pragma once

#include <cmath>

#include "contact/pair_kernel.hpp"
#include "contact/wall_properties.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Forces of the contacts [from, from + count), at most pair_block_size of them.
template <class Law, class Effects>
[[gnu::flatten]] LawMetrics forces_of_walls(const WallProperties<Law, Effects>& properties, const Motion& at,
                                            const ContactParameters& parameters, const ContactStep& step_,
                                            const ContactHistories& histories, int from, int count,
                                            WallContacts& contacts, BlockHistories& block_histories) {
  const double shortening = parameters.arm_shortening;
  const ContactStep step = step_;
  const double *vx = at.vx, *vy = at.vy, *omega = at.omega;
  const int *grain = contacts.grain.data() + from, *candidate = contacts.candidate.data() + from;
  const double *dx = contacts.dx.data() + from, *dy = contacts.dy.data() + from;
  const double* distance2 = contacts.distance2.data() + from;
  const double *normal_x = contacts.normal_x.data() + from, *normal_y = contacts.normal_y.data() + from;
  const double *wall_vx = contacts.wall_vx.data() + from, *wall_vy = contacts.wall_vy.data() + from;
  const double* wall_spin = contacts.wall_spin.data() + from;
  const double *mean_vx = contacts.mean_wall_vx.data() + from, *mean_vy = contacts.mean_wall_vy.data() + from;
  double *out_x = contacts.fx.data() + from, *out_y = contacts.fy.data() + from;
  double* torque = contacts.torque.data() + from;
  double max_relative_overlap = 0, slip_raised = 0;
#pragma omp simd reduction(max : max_relative_overlap) reduction(+ : slip_raised)
  for (int k = 0; k < count; ++k) {
    const std::size_t i = static_cast<std::size_t>(grain[k]), c = static_cast<std::size_t>(candidate[k]);
    const PairConstants& pair = properties.pair(i);
    const double distance = std::sqrt(distance2[k]);
    const double nx = distance > 0 ? dx[k] / distance : normal_x[k];
    const double ny = distance > 0 ? dy[k] / distance : normal_y[k];
    Touch touch{properties.radius(i) - distance, 0, 0, 0, 0, pair.approach_yield};
    const double relative_overlap = touch.overlap * pair.relative_per_overlap;
    max_relative_overlap = relative_overlap > max_relative_overlap ? relative_overlap : max_relative_overlap;
    [[maybe_unused]] double arm = 0;
    if constexpr (Effects::damping || Effects::friction) {
      const double kept = 1 - step.brake * pair.brake_yield;
      const double ux = kept * vx[i] + step.fall_x - wall_vx[k], uy = kept * vy[i] + step.fall_y - wall_vy[k];
      if constexpr (Effects::damping) touch.approach = ux * nx + uy * ny;
      if constexpr (Effects::friction) touch.sliding = uy * nx - ux * ny;
      const double mean_ux = vx[i] - mean_vx[k], mean_uy = vy[i] - mean_vy[k];
      if constexpr (Effects::spring) touch.slipping = mean_uy * nx - mean_ux * ny;
      if constexpr (Effects::rotation) {
        arm = properties.radius(i) - shortening * touch.overlap * pair.overlap_fraction_i;
        touch.sliding += arm * omega[i];
        if constexpr (Effects::spring) {
          const double nearer = step.lag * (mean_ux * nx + mean_uy * ny);
          touch.slipping += (arm + shortening * nearer * pair.overlap_fraction_i) * omega[i];
        }
        touch.sliding_yield += arm * arm * pair.turning_yield_i;
      }
      if constexpr (Effects::rolls) touch.turning = omega[i] - wall_spin[k];
    }
    double slip = stored_slip<Effects>(histories, c), roll = stored_roll<Effects>(histories, c);
    const ContactForce force = contact_force<Law, Effects>(touch, pair, properties.surface(i), step, slip, roll);
    if constexpr (Effects::spring) block_histories.slip[k] = slip;
    if constexpr (Effects::rolling == Rolling::spring) block_histories.roll[k] = roll;
    if constexpr (regularised<Effects>) slip_raised += force.slip_raised;
    double fx = force.normal * nx, fy = force.normal * ny;
    if constexpr (Effects::friction) fx -= force.tangential * ny, fy += force.tangential * nx;
    out_x[k] = fx, out_y[k] = fy;
    if constexpr (Effects::rotation) torque[k] = force.rolling - arm * force.tangential;
  }
  return {max_relative_overlap, slip_raised};
}

template <class Law, class Effects>
[[gnu::flatten]] LawMetrics wall_forces(const GrainSurfaces& grains, const Motion& at,
                                        const ContactParameters& parameters, const ContactStep& step,
                                        ContactHistories& histories, WallContacts& contacts) {
  const WallProperties<Law, Effects> properties(grains, parameters);
  BlockHistories block_histories;
  LawMetrics metrics;
  for (int from = 0; from < contacts.count; from += pair_block_size) {
    const int count = contacts.count - from < pair_block_size ? contacts.count - from : pair_block_size;
    const LawMetrics here = forces_of_walls<Law, Effects>(properties, at, parameters, step, histories, from, count,
                                                          contacts, block_histories);
    metrics.max_relative_overlap = std::max(metrics.max_relative_overlap, here.max_relative_overlap);
    metrics.slip_raised += here.slip_raised;
    if (keeps_history<Effects> && step.commit != 0)
      store_block<Effects>(block_histories, contacts.candidate.data() + from, 0, count, histories);
  }
  return metrics;
}

}  // namespace vibrosow::inline VIBROSOW_ISA
