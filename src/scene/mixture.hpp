#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// Number of seeds of each lot among `count`, by largest remainder.
std::vector<int> lot_counts(const std::vector<SeedLot>& lots, int count);

/// How seeds come into a vessel: put in by number, or falling in one by one, their lots drawn at random.
enum class SeedSource { fill, rain };

/// What was drawn for a fill: of a lot with a table of sizes, seeds of one of them; of another all.
struct DrawnSeeds {
  std::uint64_t vessel, lot;  // vessel 0: the tray
  double size;                // of the lot's diameter; 1 where all are counted together
  std::int64_t seeds;
  double mass;  // kg
};

/// Adds a seed of `size` lot diameters and `mass` (kg) to what was drawn for the fill of a vessel.
void count_drawn(std::vector<DrawnSeeds>& drawn, const std::vector<SeedLot>& lots, std::size_t vessel, std::size_t lot,
                 double size, double mass);

/// What one source of seeds has of one lot, or a fill's seeds of one lot have of one size. Parts are of 1; masses are
/// of the seeds that were drawn, where that is not known of the lots' mean seeds.
struct LotShare {
  const Vessel* vessel;
  SeedSource source;
  std::size_t lot;
  double seeds;                     // of rain while the run lasts, on average
  double of_number, of_mass;        // of the source's seeds; of a size: of the lot's
  double asked_number, asked_mass;  // of them, by the lots' fractions; by the table's
  std::optional<double> size{};     // m, of a size: the measure that the table is of
};

/// Of every fill and rain of a scene, tray first, lot by lot; they point into the scene. Empty where there is one lot.
std::vector<LotShare> lot_shares(const Scene& scene, const std::vector<DrawnSeeds>& drawn = {});

/// Of every fill and lot with a table of sizes, size by size.
std::vector<LotShare> size_shares(const Scene& scene, const std::vector<DrawnSeeds>& drawn);

/// On average, while a run of `duration` (s) lasts.
double rained_seeds(const Rain& rain, double duration);

/// How far a share is from what was asked for, by number or by mass, whichever is farther, in parts of that; beyond
/// `far_off` it is worth a word.
double off_by(const LotShare& share);
inline constexpr double far_off = 0.05;

/// Where what was drawn is not what was asked for, each after its key: a size without a seed, or by number or mass more
/// than 0.05 of its lot away; in a mixture a lot whose mass is far off, though that of as many mean seeds is not.
std::vector<std::string> drawn_warnings(const Scene& scene, const std::vector<DrawnSeeds>& drawn);

/// A lot that was asked for and is not there.
struct MissingLot {
  const Vessel* vessel;
  SeedSource source;
  std::string message;  // goes after the key, which is `missing_lot_key`
};

/// The first lot with a fraction above zero that gets no seed in a fill, or, where nothing is filled, of which rain
/// brings less than half a seed on average. None where every lot is there.
std::optional<MissingLot> missing_lot(const Scene& scene);

/// "tray.fill.count" or "tray.rain.rate".
std::string key_of(const Vessel& vessel, SeedSource source);

}  // namespace vibrosow
