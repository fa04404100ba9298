#pragma once

#include <optional>
#include <vector>

#include "result/snapshot.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a layer of the bed holds of one lot.
struct LotInLayer {
  double height = 0;  // m, of the layer's middle over the tray's floor
  int lot = 0;
  std::int64_t grains = 0;   // whose centre is in the layer
  double mass = 0;           // kg
  double mass_fraction = 0;  // of the layer's mass; not a number in an empty layer
};

/// Layers of `thickness` (m) from the floor up to the highest grain, in each every one of `lots` lots; of the grains
/// inside the tray. `own`: in the tray's frame.
std::vector<LotInLayer> lot_profile(const Snapshot& own, const Vessel& tray, int lots, double thickness);

/// Where a lot lies: S = (h - h_others) / h_all, with h the mean height over the floor weighted by the grains' area (in
/// space volume), of the lot, of all other grains, and of all. In a flat bed of even packing 2 h_all is the bed's
/// height, and S is 1 for a lot wholly on top of the others, -1 wholly under them, 0 evenly mixed. Of the grains inside
/// the tray; none when the lot or the others have no grain there. `own`: in the tray's frame.
std::optional<double> segregation_index(const Snapshot& own, const Vessel& tray, int lot);

}  // namespace vibrosow
