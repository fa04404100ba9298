#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vibrosow {

/// Number of seeds of each lot among `count`, by largest remainder.
std::vector<int> lot_counts(const std::vector<SeedLot>& lots, int count);

/// How seeds come into a vessel: put in by number, or falling in one by one, their lots drawn at random.
enum class SeedSource { fill, rain };

/// What one source of a mixture has of one lot. Parts are of 1; masses are of the lots' mean seeds.
struct LotShare {
  const Vessel* vessel;
  SeedSource source;
  std::size_t lot;
  double seeds;                     // of the lot; of rain while the run lasts, on average
  double of_number, of_mass;        // of the source's seeds
  double asked_number, asked_mass;  // of them, by the lots' fractions
};

/// Of every fill and rain of a scene, tray first, lot by lot; they point into the scene. Empty where there is one lot.
std::vector<LotShare> lot_shares(const Scene& scene);

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
