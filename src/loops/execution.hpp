#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "compute/profile.hpp"
#include "compute/stop_request.hpp"
#include "compute/thread_team.hpp"
#include "loops/clump_loops.hpp"
#include "loops/grain_loops.hpp"
#include "loops/loops_3d.hpp"

namespace vibrosow {

/// With what one run is computed: vector instructions, and threads that share its loops. Neither changes a result: what
/// is computed for one grain does not depend on which others are in its range.
class Execution {
 public:
  /// `threads` >= 1. Throws std::logic_error when the instructions are not available, std::invalid_argument when there
  /// are not so many threads to be had.
  explicit Execution(InstructionSet instructions = best_instruction_set(), int threads = 1, StopRequest stop = {})
      : instructions_(instructions),
        loops_(grain_loops(instructions)),
        loops_3d_(vibrosow::loops_3d(instructions)),
        loops_of_clumps_(vibrosow::clump_loops(instructions)),
        team_(threads),
        stop_(stop) {}

  InstructionSet instructions() const { return instructions_; }
  const GrainLoops& loops() const { return loops_; }
  const Loops3d& loops_3d() const { return loops_3d_; }
  const ClumpLoops& clump_loops() const { return loops_of_clumps_; }
  int threads() const { return team_.size(); }
  Profile& profile() { return profile_; }
  const Profile& profile() const { return profile_; }

  /// Throws Interrupted where that is asked for.
  void stop_if_asked() const { stop_.throw_if_set(); }
  /// From now on nothing is broken off: a run that has begun ends between two steps.
  void stop_no_more() { stop_ = {}; }

  /// Calls work(range) for each range 0 .. threads - 1 and returns when all are done.
  template <class Work>
  void for_each_range(Work work) {
    if (threads() == 1) return work(0);
    team_.share(std::ref(work));
  }

  /// Calls work(from, to) for parts of [0, n), one after the other within a thread's fraction, that stay in its cache
  /// from one loop to the next.
  template <class Work>
  void share(std::size_t n, Work work) {
    constexpr std::size_t part = 4096;
    const std::size_t fractions = static_cast<std::size_t>(threads());
    for_each_range([&](int range) {
      const std::size_t k = static_cast<std::size_t>(range), end = n * (k + 1) / fractions;
      for (std::size_t from = n * k / fractions; from < end; from += part) work(from, std::min(from + part, end));
    });
  }

 private:
  InstructionSet instructions_;
  const GrainLoops& loops_;
  const Loops3d& loops_3d_;
  const ClumpLoops& loops_of_clumps_;
  ThreadTeam team_;
  Profile profile_;
  StopRequest stop_;
};

}  // namespace vibrosow
