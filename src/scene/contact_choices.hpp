#pragma once

namespace vibrosow {

/// elastic_shell: paper A. hertz: damping from the restitution. hertz_viscous: paper B, damping -gamma_n M* v_n.
enum class Law { elastic_shell, hertz, hertz_viscous };

/// sliding: sign law made continuous below the slip speed (paper A); spring: a tangential spring with Coulomb's limit.
enum class FrictionModel { sliding, spring };

/// constant_torque and spring (elastic-plastic spring and dashpot) as named by Ai et al. 2011, models A and C.
enum class Rolling { none, constant_torque, spring };

}  // namespace vibrosow
