#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace vibrosow {

inline constexpr double standard_gravity = 9.81;  // m/s2, as in both papers

/// Decides the moment of inertia: m r^2 / 2 for a disc, 2 m r^2 / 5 for a ball.
enum class Shape { disc, ball };

struct SeedLot {
  std::string name;
  double diameter = 0;  // m
  double mass = 0;      // kg, of one seed
  Shape shape = Shape::ball;
  double number_share = 1;  // of all seeds; the shares of a scene sum to 1
};

enum class Law { elastic_shell };

struct Surface {
  double friction = 0;     // Coulomb coefficient
  double restitution = 1;  // of a head-on impact, (0, 1]; 1 is elastic
};

/// Where friction acts: at the contact point, or on the undeformed rims as in paper A (angular momentum is then not
/// kept).
enum class FrictionArm { contact_point, rim };

struct Contact {
  Law law = Law::elastic_shell;
  double shell_compression = 1e-4;  // eps / r under the grain's own weight
  Surface seed;                     // seed on seed
  Surface wall;                     // seed on wall
  double slip_speed = 0.02;         // m/s, below it friction is linear in the sliding speed
  double drag = 0;                  // kg/s, paper A's mu
  bool rotation = true;
  FrictionArm friction_arm = FrictionArm::contact_point;
};

struct Hole {
  double centre = 0;  // m along the floor from the vessel's left end
  double width = 0;   // m
};

enum class Packing { poured, layers, hexagonal };

struct Fill {
  int count = 0;
  Packing packing = Packing::poured;
  double jitter = 1e-3;    // largest shift of a grain in layers and hexagonal, in diameters
  bool keep = false;       // topped up to `count` during the run
  std::string where = {};  // "FILE:LINE: KEY" of the count, for messages; empty in a scene not read from a file
};

/// Displacement A s(t) sin(2 pi f t) along `direction`; s grows smoothly from 0 to 1 over `ramp`.
struct HarmonicMotion {
  double direction = 0;  // rad; 0 along x, pi/2 up
  double amplitude = 0;  // m, half the stroke
  double frequency = 0;  // Hz
  double ramp = 0;       // s
};

/// A tray or a hopper: floor from (0, 0) to (length, 0) with end walls of `height`, in the vessel's own frame.
struct Vessel {
  std::string name;                                  // "tray" or "hopper"
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // m, lab position of the floor's left end at rest
  double length = 0;                                 // m, between the inner faces of the end walls
  double height = 0;                                 // m
  double tilt = 0;                                   // rad, positive: right end up
  double funnel = 0;                                 // rad, slope of the floor towards its holes; 0: flat
  std::optional<double> depth;                       // m, across the plane
  std::vector<Hole> holes;                           // from the left, not overlapping
  std::optional<Fill> fill;
  std::optional<HarmonicMotion> motion;
};

enum class Integrator { velocity_verlet, rk2_midpoint };

struct Numerics {
  Integrator integrator = Integrator::velocity_verlet;
  double steps_per_contact = 20;
  std::optional<double> dt;      // s; instead of steps_per_contact
  bool allow_long_step = false;  // run a step beyond the longest safe one; every result is then marked
  std::string where;             // "FILE:LINE: KEY" of dt, for messages; empty in a scene not read from a file
};

struct GuardLimits {
  double warn_compression = 0.05;  // d c_j / (c_i + c_j) / r_i
  double stop_compression = 0.5;
  double energy_tolerance = 0.2;  // energy made by the numerics, as a share of the energy in play
};

enum class Start { at_rest, with_tray };

struct RunPlan {
  double duration = 0;        // s
  double measure_from = 0;    // s; the measuring window is [measure_from, duration]
  double count_below = 0.02;  // m, counting line below the tray's floor
  Start start = Start::at_rest;
};

/// Everything a run needs, in SI; one value, read from a seeder file and validated.
struct Scene {
  std::string title;
  std::vector<SeedLot> lots;
  Contact contact;
  Vessel tray;
  std::optional<Vessel> hopper;
  Numerics numerics;
  GuardLimits guard;
  RunPlan run;
};

}  // namespace vibrosow
