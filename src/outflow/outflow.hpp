#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outflow/doubts.hpp"
#include "outflow/evenness.hpp"
#include "outflow/statistics.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Outflow of one hole (or all) and one lot (or all) in the measuring window. Spilled grains are in no row.
/// The rates and the pause are not a number when the run ended before the window began.
struct HoleOutflow {
  std::string hole;              // "1".. from the left, "all"
  std::string lot;               // name, or "all"
  std::optional<double> centre;  // m; none for "all"
  std::optional<double> across;  // m, of its centre from the front; in space alone
  std::optional<double> width;   // m; none for "all"
  std::int64_t grains = 0;       // in the window
  double mass = 0;               // kg, in the window
  double seeds_per_s = 0;
  double mass_rate = 0;      // kg/s, of the plane slice or in space of the tray
  double longest_pause = 0;  // s, inside the window, its ends counting as events
};

/// A rate from fewer seeds than this is doubtful: by counting alone it is uncertain by 36 % (95 %).
inline constexpr std::int64_t few_grains = 30;

struct Outflow {
  double window_from = 0, window_to = 0;     // s; window_to is the run's end when it ended early
  std::vector<HoleOutflow> holes;            // per hole and lot, per hole all lots when there are several, then "all"
  std::vector<std::int64_t> grains_of_hole;  // in the window
  std::optional<Evenness> evenness;          // of these
  std::optional<double> instability_cv;      // fraction; CV of the whole outflow over equal time windows
  double spilled_fraction = 0;               // spilled / (counted + spilled), whole run
  std::optional<double> depth_factor;        // tray.depth / diameter of the plane slice; in space 1
  std::vector<Doubt> doubts;                 // what speaks against the figures; empty when all is well
  std::string note() const;                  // their texts: "ran dry at 3.2 s; outside the model"
};

/// Into how many equal parts the measuring window is cut for the instability.
inline constexpr int instability_windows = 10;

/// Coefficient of variation of seeds that come at these times (s) over equal parts of the window from `from` to `to`
/// (s), in which they all lie; none for an empty window or fewer than two seeds.
std::optional<double> instability_cv(const std::vector<double>& times, double from, double to);

/// What the events of a run say about its holes. Mean diameter of the slice: by number, over all lots.
Outflow measure_outflow(const Scene& scene, const Run& run);

/// The row of a hole ("1".., "all") and lot (name, "all"). With a single lot, its name and "all" mean the
/// same. Null when there is no such hole or lot.
const HoleOutflow* find_row(const Outflow& outflow, const std::string& hole, const std::string& lot);

}  // namespace vibrosow
