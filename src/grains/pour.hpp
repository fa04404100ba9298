#pragma once

#include <vector>

#include "compute/stop_request.hpp"
#include "grains/packing.hpp"
#include "grains/random.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// Drops seeds of the lots `order` one by one, see `pack`.
std::vector<PackedGrain> pour(const Vessel& vessel, const std::vector<SeedLot>& lots, const std::vector<int>& order,
                              Random& random, StopRequest stop);

/// The same in 3D: each ball is dropped again a little aside, at random, nearer and nearer, and stays where it comes
/// lowest, which is where it would roll to; a clump so too, turned a little each time. In the vessel's frame.
std::vector<PackedGrain> pour_3d(const Vessel& vessel, const std::vector<SeedLot>& lots, const std::vector<int>& order,
                                 Random& random, StopRequest stop);

/// How often a seed is dropped that came down where no seed belongs, before the fill is refused.
inline constexpr int most_drops = 100;

/// Throws InputError: the fill rises above the vessel's walls.
[[noreturn]] void refuse_fill(const Vessel& vessel);

}  // namespace vibrosow
