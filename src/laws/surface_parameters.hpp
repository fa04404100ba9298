#pragma once

namespace vibrosow {

/// What two surfaces do to each other, ready for the inner loop.
struct SurfaceParameters {
  double friction = 0;
  double inverse_slip_speed = 0;  // s/m
  double damping_ratio = 0;       // of the normal dashpot, from the restitution
  double damping_rate = 0;        // 1/s, paper B's gamma_n
  double tangential_ratio = 0;    // stiffness of the tangential spring over the secant of the normal law
  double tangential_damping = 0;  // tangential dashpot over the normal one
  double rolling_friction = 0;
  double rolling_damping = 0;    // of critical
  double twisting_friction = 0;  // in 3D; largest twisting torque over normal force and rolling radius
  double cohesion = 0;           // N
};

}  // namespace vibrosow
