#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compute/profile.hpp"
#include "result/doubt.hpp"
#include "result/snapshot.hpp"
#include "scene/mixture.hpp"

namespace vibrosow {

/// A grain leaving: its centre crossed the counting line.
struct OutflowEvent {
  double time;         // s, interpolated
  int hole;            // 1.. from the left; 0: spilled, it passed no hole of the tray
  int lot;             // index in Scene::lots
  std::int64_t grain;  // id of the grain, in order of insertion
  double mass;         // kg
  double x;            // m from the tray's left end, where it passed the floor (a spilled grain: where it was counted)
  double speed;        // m/s at the counting line
  double z = 0;        // m from the tray's front, as x; in 3D
};

/// put_in = inside + counted + spilled + lost, always.
struct Balance {
  std::int64_t put_in = 0;
  std::int64_t inside = 0;
  std::int64_t counted = 0;
  std::int64_t spilled = 0;
  std::int64_t lost = 0;  // through a wall or not a number: an error
};

struct EnergyAccount {                             // J
  double kinetic = 0, potential = 0, elastic = 0;  // at the end; potential from the tray's floor
  double wall_work = 0;                            // done by walls on grains
  double inserted = 0, removed = 0;                // carried by grains put in and taken out
  double made_by_numerics = 0;                     // largest rise of what must only fall
};

/// What the guard let pass.
struct ToleratedViolations {
  std::int64_t deep_steps = 0;       // steps with a relative overlap beyond the warning limit
  std::int64_t strides = 0;          // steps in which a grain could have passed a wall unseen
  std::int64_t energy_accounts = 0;  // accounts, one in 100 steps, with energy made by the numerics worth a word
};

enum class RunStatus {
  finished,
  stopped_by_guard,
  interrupted,
  refused,  // it could not begin: a fill that does not fit, a step that is too long; nothing else is set
};

/// What one simulation gives. Holds nothing that depends on a clock but the last two.
struct Run {
  RunStatus status = RunStatus::finished;
  std::string stop_reason;      // of the guard; or why it is refused
  std::string end_reason;       // why it ended before its duration, though sound; else empty
  bool goes_on = false;         // it has not ended: what it gives is of the time so far; never of a run that is kept
  std::vector<Doubt> warnings;  // of the guard and the feeder, and of what was drawn
  // A long step insisted on; or limits of the guard raised, and the usual ones passed; or grains lost through walls.
  bool outside_the_model = false;
  std::uint64_t random_seed = 1;
  double dt = 0;  // s
  std::int64_t steps = 0;
  double end_time = 0;  // s, = steps dt
  std::int64_t grain_steps = 0;
  std::int64_t force_evaluations = 0;  // of grain contacts
  std::int64_t slip_speed_raised = 0;  // of these, where sliding friction's slip speed was raised in a hard impact
  ToleratedViolations let_pass;
  double max_relative_overlap = 0;  // a grain's share of the overlap over its radius, the largest of the run
  std::int64_t tray_at_begin = -1;  // seeds inside the tray when the measuring window began; negative: it did not
  std::int64_t tray_at_end = 0;     // seeds inside the tray at the end of the run
  double tray_empty_since = -1;     // s, when the last grain left the tray; negative: it never ran dry
  EnergyAccount energy;
  Balance balance;
  std::vector<DrawnSeeds> drawn;          // for the fills; not kept of a study's runs, whose warnings tell of it
  std::vector<OutflowEvent> events;       // by time
  std::vector<Snapshot> snapshots;        // one a record time that was reached; empty without a record
  double wall_time = 0;                   // s, of this machine
  double measured_cpu_time = 0;           // s of the process, all its threads, in the measuring window
  std::optional<PhaseTimes> phase_times;  // of wall_time, where asked for
};

}  // namespace vibrosow
