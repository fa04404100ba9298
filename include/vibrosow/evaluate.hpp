#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vibrosow/scene.hpp"

namespace vibrosow::api {

/// Grains; put_in = inside + counted + spilled + lost, always.
struct Balance {
  std::int64_t put_in = 0;
  std::int64_t inside = 0;
  std::int64_t counted = 0;  // left through a hole
  std::int64_t spilled = 0;  // fell beside the tray
  std::int64_t lost = 0;     // through a wall: an error
};

/// In the place of a hole's number, which is 1.. from the left.
inline constexpr int no_hole = 0;     // a seed was spilled: it passed none
inline constexpr int all_holes = -1;  // a row is of all together

/// What leaves one hole (or all) of one lot (or all) in the measuring window.
struct HoleOutflow {
  int hole = all_holes;      // its number, or all_holes
  std::string lot;           // its name, or "all"
  std::int64_t grains = 0;   // in the window
  double seeds_per_s = 0;    // of a plane slice one seed thick; not a number where a run ended before its window
  double mass_rate = 0;      // kg/s, the same
  double longest_pause = 0;  // s
};

/// What speaks against a run's figures.
struct Doubt {
  std::string kind;        // "ran dry", as in run.json
  bool serious = false;    // the figures may be wrong, not only less sure
  std::string text;        // what happened: "ran dry at 3.2 s"
  std::string what_to_do;  // empty where there is nothing
};

/// What one run of a scene comes to.
struct Evaluation {
  bool finished = false;
  std::string reason;              // why it was refused or stopped by the guard, or ended early
  std::vector<Doubt> doubts;       // none where all is well
  bool outside_the_model = false;  // it went on past the guard's usual limits: nothing is to be decided by it
  double end_time = 0;             // s
  Balance balance;
  std::vector<HoleOutflow> holes;  // by hole and lot, the last row of all; empty where refused
  /// Fraction: coefficient of variation of the holes' rates, chance taken out; none for one hole, or where they are not
  /// told from equal ones.
  std::optional<double> unevenness_cv;
  std::optional<double> depth_factor;  // the real tray's rate over the slice's; none without tray.depth
};

/// Runs a scene to its end. The same scene and random seed give the same result to the last bit, for any number of
/// threads. A scene that cannot be run is not `finished`, and `reason` says why.
Evaluation evaluate(const Scene& scene, std::uint64_t random_seed = 1, int threads = 1);

}  // namespace vibrosow::api
