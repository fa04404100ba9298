#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outflow/doubts.hpp"
#include "outflow/statistics.hpp"
#include "outflow/unevenness.hpp"
#include "result/run.hpp"
#include "scene/measuring_window.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Outflow of one hole (or all) and one lot (or all) in the measuring window. Spilled grains are in no row.
/// The rates and the pause are not a number when the run ended before the window began.
struct HoleOutflow {
  std::string hole;              // "1".. from the left, "all"
  std::string lot;               // name, or "all"
  std::optional<double> centre;  // m; none for "all"
  std::optional<double> across;  // m, of its centre from the front; in 3D alone
  std::optional<double> width;   // m; none for "all"
  std::int64_t grains = 0;       // in the window
  double mass = 0;               // kg, in the window
  double seeds_per_s = 0;
  double mass_rate = 0;      // kg/s, of the plane slice or in 3D of the tray
  double longest_pause = 0;  // s, inside the window, its ends counting as events
};

/// A rate from fewer seeds than this is doubtful: by counting alone it is uncertain by 36 % (95 %).
inline constexpr std::int64_t few_grains = 30;

struct Outflow {
  MeasuringWindow window;                    // ends with the run when that ended early
  std::vector<HoleOutflow> holes;            // per hole and lot, per hole all lots when there are several, then "all"
  std::vector<std::int64_t> grains_of_hole;  // in the window
  std::vector<std::vector<std::int64_t>> grains_of_hole_in_block;  // by block of the window, then by hole
  std::optional<double> raw_cv;          // fraction; coefficient of variation of the holes' grains, chance included
  std::optional<double> instability_cv;  // fraction; CV of the whole outflow over the parts of `instability_ends`
  double spilled_fraction = 0;           // spilled / (counted + spilled), whole run
  std::optional<double> depth_factor;    // tray.depth / diameter of the plane slice; in 3D 1
  std::vector<Doubt> doubts;             // what speaks against the figures; empty when all is well
  double seeds() const;                  // through all holes in the window
  std::string note() const;              // their texts: "ran dry at 3.2 s; outside the model"
};

/// Whether holes lie one behind another, so that a place along the tray does not tell them apart.
bool has_rows_of_holes(const Outflow& outflow);

/// How many of such times (s, ascending or not) lie in each block, whose ends `block_ends` gives; those before the
/// first and after the last in none.
std::vector<std::int64_t> counts_in_blocks(const std::vector<double>& times, const std::vector<double>& ends);

/// How unsteady a flow is; fractions.
struct Instability {
  double cv = 0;           // of the counts of the parts of the window
  double counting_cv = 0;  // what so many independent seeds would show
};

/// Of seeds that come at these times (s), over the parts of `instability_ends`; none where these are fewer than two, or
/// the seeds in them.
std::optional<Instability> instability(const std::vector<double>& times, const MeasuringWindow& window);

/// What the events of a run say about its holes. Mean diameter of the slice: by number, over all lots.
Outflow measure_outflow(const Scene& scene, const Run& run);

/// How uneven the holes are by all replicates together; of one, by its blocks, which are blind to how starts differ.
/// None where that cannot be told. Takes milliseconds.
std::optional<Unevenness> unevenness_of(const std::vector<const Outflow*>& replicates);

/// Seeds in a second of a hole (0..) or, without one, of all: mean over the blocks of the window with its interval; not
/// a number for an empty window. Blind to how starts differ.
MeanWithInterval rate_of_blocks(const Outflow& outflow, std::optional<std::size_t> hole = std::nullopt);

/// Half width of the rate's 95 % interval, of all holes, over that rate: of replicates, or of one by its blocks. None
/// where nothing flowed, or too little was measured to tell.
std::optional<double> chance_of_rate(const std::vector<const Outflow*>& replicates);

/// The row of a hole ("1".., "all") and lot (name, "all"). With a single lot, its name and "all" mean the
/// same. Null when there is no such hole or lot.
const HoleOutflow* find_row(const Outflow& outflow, const std::string& hole, const std::string& lot);

}  // namespace vibrosow
