#pragma once

namespace vibrosow {

/// What a seed's outflow depends on besides its size and shape.
struct SeedContact {
  double friction = 0;          // between seeds
  double wall_friction = 0;     // on the tray
  double rolling_friction = 0;  // between seeds, and on the tray
  double restitution = 1;       // between seeds, and on the tray
  bool operator==(const SeedContact&) const = default;
};

/// How well it is known: standard deviations.
struct SeedContactError {
  double log_friction = 0;  // of the logarithm of the friction between seeds
  double rolling_friction = 0;
};

/// What an outflow is multiplied by, as its logarithm.
struct ContactFactor {
  double log = 0, deviation = 0;
};

}  // namespace vibrosow
