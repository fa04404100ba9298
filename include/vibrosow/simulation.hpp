#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "vibrosow/evaluate.hpp"
#include "vibrosow/scene.hpp"

namespace vibrosow::api {

/// A grain that left: its centre crossed the counting line.
struct Event {
  double time;         // s
  int hole;            // its number, or no_hole: spilled
  int lot;             // in the file's order, from 0
  std::int64_t grain;  // its id
  double mass;         // kg
  double x;            // m from the tray's left end, where it passed the floor
  double speed;        // m/s
  double z;            // m from the tray's front, as x; 0 in 2D
};

/// A grain at one moment, in the lab frame.
struct Grain {
  std::int64_t id;
  int lot;
  double x, y;                    // m
  double vx, vy;                  // m/s
  double radius;                  // m
  double z = 0;                   // m, across, from the tray's front at rest; 0 in 2D
  double vz = 0;                  // m/s
  double fx = 0, fy = 0, fz = 0;  // N, of all its contacts together; its weight is not in it
};

/// Whether a simulation goes on.
enum class Status {
  running,
  finished,  // nothing more will come: the end is reached, the guard has stopped it, or a pause has ended it
};

/// Displacement of the tray: amplitude sin(2 pi frequency t + phase) along a direction, t since the start of the
/// simulation.
struct Harmonic {
  double amplitude;      // m
  double frequency;      // Hz
  double direction = 0;  // rad, anticlockwise from the floor's
  double phase = 0;      // rad
  double across = 0;     // rad, in 3D: from the plane of length and height towards the back
};

/// A scene in motion, to be watched and driven between its steps.
class Simulation {
 public:
  /// Puts the grains in. Throws std::runtime_error where the fill does not fit or the step is too long.
  explicit Simulation(const Scene& scene, std::uint64_t random_seed = 1, int threads = 1);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  double time() const;  // s

  /// Takes steps until `time` (s) or the scene's end, and says whether it goes on. Events come with the last steps too:
  /// read them before leaving.
  Status advance_to(double time);

  /// All events from the `first`-th on, counted from 0: what is new since one had read so many.
  std::vector<Event> events_since(std::size_t first) const;

  std::vector<Grain> grains() const;  // inside, by id
  Evaluation result() const;          // of what has happened so far

  /// The tray's motion from now on, by the time of the simulation; it goes on from where it is. Throws
  /// std::invalid_argument for numbers that are not finite or negative, and where the tray rocks.
  void set_motion(const Harmonic& motion);

  /// Opens or closes the gate of a hole of the tray (1.. from the left): one that its file opens later than 0. A gate
  /// does not close on a grain in its way: false, and it stays open. Throw std::invalid_argument for a hole without a
  /// gate.
  void open_gate(int hole);
  bool close_gate(int hole);

  /// The state as bytes, the same on every machine.
  std::string save() const;
  /// Goes on from what `save` gave as that simulation would have, to the last bit. Throws std::runtime_error with the
  /// reason where the bytes are damaged, of another version, or of another scene.
  static Simulation restore(const Scene& scene, std::string_view bytes, int threads = 1);

 private:
  struct Inside;
  explicit Simulation(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace vibrosow::api
