#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "agronomy/hole_table.hpp"
#include "agronomy/prediction_error.hpp"
#include "agronomy/sowing_rate.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What the table of one hole asks of seeds.
struct PlannedSeed {
  double diameter = 0;  // m, of the ball of its volume
  double mass = 0;      // kg
  double aspect = 1;    // how many times it is as long as wide; its thickness counts through the volume alone
  double largest = 0;   // m, the diameter of the largest lot's seeds, by which holes clog; 0: `diameter`
  double largest_diameter() const { return std::max(largest, diameter); }
  bool has_larger() const { return largest > diameter * (1 + 1e-9); }
};

/// Mean volume of a lot's seeds in 3D, m3.
double mean_volume(const SeedLot& lot);

/// Of lots in 3D; of seeds of several sizes, and of a mixture by its number fractions, the mean by volume and mass;
/// the aspect's by volume.
PlannedSeed planned_seed(const std::vector<SeedLot>& lots);

/// A crop and how much of it is sown.
struct SownLot {
  SeedLot lot;                    // in 3D
  double sowing_rate = 0;         // kg/m2
  double seeds_per_area() const;  // 1/m2
};

/// Gives lots the number fractions in which they are sown.
void share_out(std::vector<SownLot>& sown);

/// The lot with its seeds made heavier or lighter (kg) at equal density and shape. Throws InputError where it has
/// sizes.
SeedLot of_mass(SeedLot lot, double mass);

struct SowingTask {
  PlannedSeed seed;
  double sowing_rate = 0;  // kg/m2
  RowPace pace;
  std::optional<int> rows;  // of the drill, where known: holes for several must share them out evenly
  double row_mass_rate() const { return row_rate(sowing_rate, pace); }                // kg/s
  double row_seed_rate() const { return seeds_of_mass(row_mass_rate(), seed.mass); }  // 1/s
  double seeds_per_area() const { return seeds_of_mass(sowing_rate, seed.mass); }     // 1/m2
};

/// What a shaker can be set to, Hz.
struct ShakerLimits {
  double least_frequency = 3, most_frequency = 25;
};

/// How wide a hole is over the seed's d, from the widest. 4 to 5 d is where a still hole's flow of balls begins to go
/// on without end (Pacheco-Martinez, van Gerner, Ruiz-Suarez 2008, Phys. Rev. E 77:021303); shaking keeps narrower ones
/// open.
enum class HoleClass { rarely_clogs, kept_open, clogs };
inline constexpr double rarely_clogs_from = 5, kept_open_from = 3;  // d
HoleClass hole_class(double width_over_d);

/// Speeds (m/s) that a drill should reach by frequency alone.
inline constexpr Span working_speeds{6 * kilometre_per_hour, 10 * kilometre_per_hour};

/// So many holes feed so many rows.
struct HolesForRows {
  int holes = 1, rows = 1;
};

struct PlannedLayout {
  HolesForRows feed;
  double width = 0;  // m, of a hole
  double width_over_d = 0;
  double width_over_largest = 0;  // over the diameter of a mixture's largest lot
  double depth_over_d = 0;        // of the bed
  double frequency = 0;           // Hz
  double amplitude = 0;           // m
  double peak_speed = 0;          // of the tray, over sqrt(g d)
  HoleEstimate estimate;
  double interpolation = 0;    // half width of the 95 % band of its errors, over the outflow
  PredictionError error{};     // of the rate that it is planned for
  Span speeds;                 // m/s, at which the same sowing rate can be kept by frequency alone
  bool more_by_faster = true;  // shaking; else slower shaking sows more
  HoleClass risk() const { return hole_class(width_over_largest); }
  bool reaches_working_speeds() const {
    return speeds.holds(working_speeds.least) && speeds.holds(working_speeds.most);
  }
};

/// Of the same rate by other means than those tried; none where the table does not tell.
struct NearestChange {
  /// The narrowest hole of a class and how many rows it would have to feed at least.
  struct WiderHole {
    double width = 0;  // m
    int rows = 0;
  };
  std::optional<WiderHole> kept_open, rarely_clogs;
  double least_share = 0;  // of what is needed, the least and the most that any layout tried gives
  double most_share = 0;
};

/// Where the band of a layout's rate reaches further, over the rate, the table does not know it.
inline constexpr double most_uncertain = 0.5;

struct SowingPlan {
  SowingTask task;
  std::vector<PlannedLayout> layouts;  // the best first
  std::size_t too_uncertain = 0;       // more that should give the rate, left out: beyond `most_uncertain`
  NearestChange change;
  double amplitude_over_d = 0;  // of the tray, in the table
  double table_times = 1;       // what the table's outflows were multiplied by (HoleTable::times)
  double softness = 0;          // what the softness of the table's seeds may do to the rate, over it
  /// Of a layout's rate, over it: what the table does not know of it, within the model. Chance and interpolation as
  /// independent, and softness.
  double unknown_to_table(const PlannedLayout& layout) const;
};

/// How a tray may differ from what was drawn: half widths of 95 %.
struct BuildTolerance {
  double hole_width = 0.1e-3;  // m
  double amplitude = 0.02;     // share
};

/// By how much the logarithm of a rate grows with the width of a hole (1/m), and with the logarithm of the amplitude.
struct BuildSlopes {
  double width, amplitude;
};

/// Standard deviation of the rate's logarithm, width and amplitude being independent of each other.
double tolerance_deviation(const BuildSlopes& slopes, const BuildTolerance& tolerance);

/// What a rate errs by that is looked up in a table at conditions (which it has) for a seed of that diameter (m). The
/// tolerance by the table's own slopes.
PredictionError table_error(const HoleTable& table, const HoleConditions& conditions, double diameter,
                            const ModelError& model, const BuildTolerance& tolerance = {});

/// What the softness of the table's seeds may do to a rate, over it: half width of 95 %.
double softness_error(double aspect);

/// All layouts that give the rate: one hole for 4, 3, 2 rows or one, 2 or 3 holes a row; widths in steps of 0.5 mm; the
/// shallowest and the deepest bed of the table; the amplitude that the table has in seeds, to 0.1 mm; every frequency
/// within the shaker's limits that gives the rate. Ranked by the hole's class, then, of a mixture's holes that clog, by
/// how wide they are for its largest seeds, of which the table knows nothing; then by the share of holes that stood
/// still, then whether working speeds are reached, then by how far the rate can be turned up and down. Those whose rate
/// is not known to `most_uncertain` are left out. Throws InputError for seeds of an aspect that the table has not.
SowingPlan plan_sowing(const SowingTask& task, const HoleTable& table, const ModelError& model,
                       const ShakerLimits& limits = {});

}  // namespace vibrosow
