#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scene/contact_choices.hpp"

namespace vibrosow {

inline constexpr double standard_gravity = 9.81;  // m/s2, as in both papers

/// "FILE:LINE: KEY" of a value, for messages; empty in a scene not read from a file. Says nothing about the scene, so
/// any two are equal.
class WrittenAt {
 public:
  WrittenAt() = default;
  WrittenAt(std::string text) : text_(std::move(text)) {}
  std::string or_key(const std::string& key) const { return text_.empty() ? key : text_; }
  bool operator==(const WrittenAt&) const { return true; }

 private:
  std::string text_;
};

/// A preset that values were taken from; empty in a scene not read from a file. Says nothing about the scene, so any
/// two are equal.
struct PresetFile {
  std::string name{};  // without .toml
  std::string file{};  // its path
  bool is_known() const { return !file.empty(); }
  bool operator==(const PresetFile&) const { return true; }
};

/// A scene's contact model; none where each lot has that of its crop.
struct ModelFile : PresetFile {
  bool of_crops = false;
};

/// A lot's crop.
struct CropFile : PresetFile {
  std::optional<double> seed_density{};  // kg/m3, by its own mass and size, where the lot has others
};

/// What a vessel in 2D says of its holes in 3D, where they need not reach from front to back: no run depends on it, but
/// what its rates stand for does.
struct SlotsIn3d {
  int rows = 1;
  double open = 1;  // of slots: of the depth, all rows together
  bool operator==(const SlotsIn3d&) const = default;
};

/// Decides the moment of inertia: m r^2 / 2 for a disc, 2 m r^2 / 5 for a ball, for a clump that of a uniform plate, in
/// space of a uniform body.
enum class Shape { disc, ball, clump };

/// One disc of a clump, m, from the clump's centre of mass; in 3D a ball, and x, y and z along the principal axes.
struct ClumpDisc {
  double x, y, radius;
  double z = 0;
  bool operator==(const ClumpDisc&) const = default;
};

/// m, in the frame of its clump.
inline Eigen::Vector3d centre_of(const ClumpDisc& disc) {
  return {disc.x, disc.y, disc.z};
}

/// How the diameters of a lot scatter, by number. Normal and lognormal are cut at `least` and `most` (as if a draw
/// outside were drawn again); uniform lies between them; a table gives diameters and their fractions. Of a clump the
/// diameter stands for its size: the whole seed is scaled.
struct SizeDistribution {
  enum class Kind { single, uniform, normal, lognormal, table };
  Kind kind = Kind::single;
  double mean = 0, deviation = 0;          // m, of normal and lognormal before they are cut
  double least = 0, most = 0;              // m
  std::vector<double> diameter, fraction;  // m and parts of 1, of a table
  bool operator==(const SizeDistribution&) const = default;
};

struct SeedLot {
  std::string name;
  double diameter = 0;  // m, mean (before a cut); of a clump: of the circle about its centre of mass that just holds it
  double mass = 0;      // kg, of a seed of that diameter; others scale with a power of it (`mass_power`)
  Shape shape = Shape::ball;
  double number_fraction = 1;  // of all seeds; the fractions of a scene sum to 1
  SizeDistribution sizes{};
  std::vector<ClumpDisc> discs{};             // of a clump of that diameter
  double gyration2 = 0;                       // m2, moment of inertia over mass of such a clump, about z
  double gyration2_x = 0, gyration2_y = 0;    // m2, about x and y: of a clump in 3D alone
  std::optional<double> shell_compression{};  // these three: instead of the contact's
  std::optional<double> youngs_modulus{};     // Pa
  std::optional<double> poisson_ratio{};
  CropFile crop{};
  PresetFile contact{};  // the contact model that the crop names as its own
  bool operator==(const SeedLot&) const = default;
};

struct Surface {
  double friction = 0;           // Coulomb coefficient
  double restitution = 1;        // of a head-on impact, (0, 1]; 1 is elastic
  double rolling_friction = 0;   // largest rolling torque over normal force and rolling radius
  double cohesion = 0;           // N, pull of two surfaces that touch
  double twisting_friction = 0;  // in 3D, the same of a torque about the normal, beside rolling friction
  bool operator==(const Surface&) const = default;
};

/// The surface between two lots, or a lot and the walls, where it is not the contact's general one.
struct SurfaceOverride {
  int lot;
  int other;  // a lot; -1: the walls
  Surface surface;
  bool operator==(const SurfaceOverride&) const = default;
};

/// Where friction acts: at the contact point, or on the undeformed rims as in paper A (angular momentum is then not
/// kept).
enum class FrictionArm { contact_point, rim };

struct Contact {
  Law law = Law::elastic_shell;
  double shell_compression = 1e-4;  // eps / r under the grain's own weight
  double youngs_modulus = 0;        // Pa, of seeds (hertz)
  double poisson_ratio = 0.3;
  std::optional<double> wall_youngs_modulus{};  // Pa; none: rigid walls
  double wall_poisson_ratio = 0.3;
  double damping_rate = 0;  // 1/s, paper B's gamma_n (hertz_viscous)
  Surface seed;             // seed on seed
  Surface wall;             // seed on wall
  std::vector<SurfaceOverride> overrides{};
  FrictionModel friction_model = FrictionModel::sliding;
  std::optional<double>
      tangential_ratio{};           // elastic_shell: k_t / k_n, 14/17; hertz: fraction of Mindlin's 8 G* sqrt(R* d), 1
  double tangential_damping = 0.5;  // of the normal dashpot
  Rolling rolling = Rolling::none;
  double rolling_damping = 0.3;  // of critical, while the rolling spring is below its limit
  double slip_speed = 0.02;      // m/s, below it friction is linear in the sliding speed
  double drag = 0;               // kg/s, paper A's mu
  bool rotation = true;
  FrictionArm friction_arm = FrictionArm::contact_point;
  ModelFile model{};
  bool operator==(const Contact&) const = default;
};

enum class HoleShape { slot, round };

struct Hole {
  double centre = 0;   // m along the floor from the vessel's left end
  double width = 0;    // m; of a round hole its diameter
  double open_at = 0;  // s; until then a gate closes it
  // In 3D:
  HoleShape shape = HoleShape::slot;
  double across = 0;         // m, of its centre from the vessel's front
  double across_length = 0;  // m, of a slot
  double thickness = 0;      // m, of the floor: how far down a round hole's wall reaches
  double chamfer = 0;        // m, of a round hole's upper edge, at 45 degrees, no more than the thickness
  bool operator==(const Hole&) const = default;

  /// m, in the plane of the floor.
  double rim_width() const { return width + 2 * chamfer; }
};

enum class PieceAxis { upright, along };

/// Which way a piece is drawn out in 3D: from front to back, or from the vessel's left end to its right one.
enum class DrawnOut { across, along };

/// A piece of a vessel's wall beside its box, in the vessel's frame: a straight line from a to b, or, where the radius
/// is not zero, an arc about `centre`, anticlockwise from the angle `from` to the angle `to` (at most a full turn). A
/// grain larger than an arc's circle feels only the nearer end of it from within. In 3D a piece is drawn out from
/// front to back; or along the vessel, and then its points are (z, y), its angles 0 along z and pi/2 up; or a line is
/// turned about an axis that is upright or lies along x, and then its points are (distance from the axis, place along
/// it): a cylinder, a cone or a disc.
struct WallPiece {
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();  // m
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();                          // m
  double radius = 0;                                                         // m
  double from = 0, to = 0;                                                   // rad, 0 along x, pi/2 up
  std::optional<Eigen::Vector2d> about{};  // m, where that axis passes: x and z of an upright one, else y and z
  PieceAxis axis = PieceAxis::upright;
  DrawnOut drawn_out = DrawnOut::across;  // along: in 3D alone, and not turned
  bool operator==(const WallPiece&) const = default;
};

/// What stands at the ends of a vessel's floor: walls; nothing; or the same vessel again, for a slice of a long one.
enum class Sides { walls, open, periodic };

/// The outline of a vessel's floor and walls, seen from above.
enum class Plan { rectangle, round };

enum class Packing { poured, layers, hexagonal };

struct Fill {
  int count = 0;
  Packing packing = Packing::poured;
  double jitter = 1e-3;  // largest shift of a grain in layers and hexagonal, in diameters
  bool keep = false;     // topped up to `count` during the run
  WrittenAt where = {};  // of the count, or of the height that it was worked out from
  bool operator==(const Fill&) const = default;
};

inline constexpr double never = std::numeric_limits<double>::infinity();  // s

/// Displacement A s(t) sin(2 pi f t + phase) along `direction`; s grows smoothly from 0 to 1 over `ramp`, and falls to
/// 0 over `stop_ramp` from `stop` on.
struct HarmonicMotion {
  double direction = 0;  // rad; 0 along x, pi/2 up
  double amplitude = 0;  // m, half the stroke
  double frequency = 0;  // Hz
  double ramp = 0;       // s
  double phase = 0;      // rad
  double stop = never;   // s
  double stop_ramp = 0;  // s
  double across = 0;     // rad, between the direction and the plane; pi/2: straight across, from front to back
  bool operator==(const HarmonicMotion&) const = default;
};

struct SumMotion {
  std::vector<HarmonicMotion> components;
  bool operator==(const SumMotion&) const = default;
};

/// The vessel turns by `angle` s(t) sin(2 pi f t) about a point of its own frame.
struct RockingMotion {
  Eigen::Vector2d pivot = Eigen::Vector2d::Zero();  // m, in the vessel's frame
  double angle = 0;                                 // rad, amplitude
  double frequency = 0;                             // Hz
  double ramp = 0;                                  // s
  double stop = never;                              // s
  double stop_ramp = 0;                             // s
  bool operator==(const RockingMotion&) const = default;
};

/// Displacement of the frame's zero and angle at given times, smooth in between, held before the first and after the
/// last. All lists are equally long, at least 4, but z may be empty.
struct TableMotion {
  std::vector<double> times;  // s, ascending
  std::vector<double> x, y;   // m, lab
  std::vector<double> angle;  // rad, beside the tilt
  std::vector<double> z;      // m, lab, in 3D; empty: no motion across
  bool operator==(const TableMotion&) const = default;
};

enum class TurningAxis { across, upright };

/// The vessel turns with the angular velocity times s(t), over and over, about an axis of its own frame through the
/// pivot: across the plane (a drum), x towards y, or in 3D upright, x towards z.
struct TurningMotion {
  Eigen::Vector2d pivot = Eigen::Vector2d::Zero();  // m, in the vessel's frame: x and y, of an upright axis x and z
  double angular_velocity = 0;                      // rad/s
  TurningAxis axis = TurningAxis::across;
  double ramp = 0;       // s
  double stop = never;   // s
  double stop_ramp = 0;  // s
  double phase = 0;      // rad, by which it is turned at time 0
  bool operator==(const TurningMotion&) const = default;
};

using VesselMotion = std::variant<HarmonicMotion, SumMotion, RockingMotion, TableMotion, TurningMotion>;

/// Seeds that come one by one at even intervals, the first 1 / rate after `start`, each at a random place, at rest in
/// the lab. One whose place is taken waits.
struct Rain {
  double rate = 0;      // 1/s
  double from = 0;      // m, of the seeds' centres along the floor; kept clear of the end walls; anywhere across
  double to = 0;        // m
  double height = 0;    // m, of the seeds' centres above the floor's left end, in the vessel's frame
  double start = 0;     // s
  double stop = never;  // s, none comes later
  bool operator==(const Rain&) const = default;
};

/// A tray or a hopper: floor from (0, 0) to (length, 0) with end walls of `height`, in the vessel's own frame. In 3D
/// x and y are the same and z goes across, from the front at 0 to the back at `depth`. A round vessel is as deep as it
/// is long: its wall is a cylinder of that diameter.
struct Vessel {
  std::string name;                                  // "tray" or "hopper"
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // m, lab position of the floor's left end at rest
  double length = 0;                                 // m, between the inner faces of the end walls
  double height = 0;                                 // m
  double tilt = 0;                                   // rad, positive: right end up
  double funnel = 0;                                 // rad, slope of the floor towards its holes; 0: flat
  std::optional<double> depth;                       // m, across the plane
  std::vector<Hole> holes;                           // from the left, not overlapping
  SlotsIn3d slots_in_3d{};                           // in 2D
  std::vector<WallPiece> pieces{};                   // beside floor and end walls
  bool box = true;                                   // whether there are floor and end walls
  Sides sides = Sides::walls;
  Sides front_and_back = Sides::walls;  // in 3D
  double front = 0;                     // m, lab position of the front at rest, in 3D
  Plan plan = Plan::rectangle;          // in 3D
  std::optional<Fill> fill;
  std::optional<Rain> rain{};
  std::optional<VesselMotion> motion;
  bool operator==(const Vessel&) const = default;
};

/// Whether its fill is topped up during the run.
inline bool is_kept(const Vessel& vessel) {
  return vessel.fill && vessel.fill->keep;
}

enum class Integrator { velocity_verlet, rk2_midpoint, gear5 };

/// Steps a contact where a seeder says nothing: fewer with velocity Verlet, which counts a contact's first step for the
/// time in touch.
constexpr double usual_steps_per_contact(Integrator integrator) {
  return integrator == Integrator::velocity_verlet ? 12 : 20;
}

/// Softness and step that a scene is run with: its own, or those of a level (scene/accuracy_level.hpp).
enum class AccuracyLevel { as_written, draft, design, reference };

struct Numerics {
  AccuracyLevel accuracy = AccuracyLevel::as_written;
  Integrator integrator = Integrator::velocity_verlet;
  double steps_per_contact = usual_steps_per_contact(Integrator::velocity_verlet);
  std::optional<double> dt;              // s; instead of steps_per_contact
  std::optional<double> impact_speed{};  // m/s, at which Hertz' contact time is taken; none: the fastest predicted
  bool allow_long_step = false;          // run a step beyond the longest safe one; every result is then marked
  WrittenAt where{};                     // of dt
  bool operator==(const Numerics&) const = default;
};

struct GuardLimits {
  double warn_relative_overlap = 0.05;  // d c_j / (c_i + c_j) / r_i
  double stop_relative_overlap = 0.5;
  double energy_tolerance = 0.2;  // energy made by the numerics, as a fraction of the energy in play
  bool operator==(const GuardLimits&) const = default;
};

enum class Start { at_rest, with_tray };

struct RunPlan {
  double duration = 0;        // s
  double measure_from = 0;    // s; the measuring window is [measure_from, duration]
  double count_below = 0.02;  // m, counting line below the tray's floor
  Start start = Start::at_rest;
  std::optional<double> end_after_pause{};  // s without a grain leaving, once every gate is open: ends the run
  bool operator==(const RunPlan&) const = default;
};

/// What maps of a bed in 3D show, seen from the front: all of it, or a slice a cell thick in the middle of the
/// depth.
enum class MapView { projection, slice };

/// Snapshots of the bed at given times.
struct Record {
  std::vector<double> times{};         // s, ascending
  double cell = 0;                     // m, edge of the cells of maps
  MapView view = MapView::projection;  // in 3D
  bool operator==(const Record&) const = default;
};

/// Whether seeds are discs of a slice one seed thick, or balls in 3D.
enum class Space { two_dimensional, three_dimensional };

/// Everything a run needs, in SI; one value, read from a seeder file and validated.
/// What the reader of a scene's files found that can hardly be meant, one sentence each, as of its drawings, which the
/// scene does not know. Says nothing about the scene, so any two are equal.
struct DoubtsOfReader {
  std::vector<std::string> sentences{};
  bool operator==(const DoubtsOfReader&) const { return true; }
};

struct Scene {
  std::string title;
  Space space = Space::two_dimensional;
  std::vector<SeedLot> lots;
  Contact contact;
  Vessel tray;
  std::optional<Vessel> hopper;
  Numerics numerics;
  GuardLimits guard;
  RunPlan run;
  std::optional<Record> record{};
  DoubtsOfReader doubts_of_reader{};
  bool operator==(const Scene&) const = default;
};

}  // namespace vibrosow
