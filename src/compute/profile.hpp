#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

namespace vibrosow {

/// What a run's time goes into.
enum class Phase { start, neighbours, pairs, walls, integration, counters, recording, housekeeping };
inline constexpr std::array<std::string_view, 8> phase_names{
    "start",       // packing, first lists
    "neighbours",  // walls put in place, lists brought up to date
    "pairs",       // forces between grains
    "walls",       // forces of walls
    "integration",
    "counters",      // counting line and guard
    "recording",     // snapshots of the bed
    "housekeeping",  // grains taken out and put in, energy account
};

/// Wall time (s) by phase.
using PhaseTimes = std::array<double, phase_names.size()>;

/// A stopwatch that tells each lap to a phase; while it is off it costs a glance.
class Profile {
 public:
  void start() { is_on_ = true, last_ = Clock::now(); }

  /// The time since the lap before was spent on `phase`.
  void lap(Phase phase) {
    if (!is_on_) return;
    const Clock::time_point now = Clock::now();
    times_[static_cast<std::size_t>(phase)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  bool is_on() const { return is_on_; }
  const PhaseTimes& times() const { return times_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool is_on_ = false;
  Clock::time_point last_;
  PhaseTimes times_{};
};

}  // namespace vibrosow
