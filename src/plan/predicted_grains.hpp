#pragma once

#include "scene/scene.hpp"

namespace vibrosow {

/// Grains a second that a vessel's holes let through at `time` (s) while the bed above them lasts: of each open hole
/// 1.25 sqrt(g / d) (D / d - k)^(3/2), the plane form of Beverloo's law; d: diameter of the disc of a grain's mean
/// area, k = 1.9 at rest and 1.4 where the vessel is shaken. Above a slope of 45 degrees a funnel lets through tan(90
/// degrees - slope)^-0.35 times as much (Rose & Tanaka 1959). Constants fitted to this program's own silos and trays
/// (reports/silo, reports/paper-a-fig3), which they meet to some 15 %; no sliding, rolling or cohesion is in it. In
/// space Beverloo's law of round holes, 0.58 n sqrt(g) (D - k d)^(5/2), and of slots, 1.03 n sqrt(g) (L - k d) (D - k
/// d)^(3/2), with n grains a volume at a packing fraction of 0.6 (Beverloo, Leniger & van de Velde 1961).
double predicted_outflow(const Scene& scene, const Vessel& vessel, double time);

/// Grains times steps of a run with steps of `dt` (s), foreseen without moving any: fills drain through their holes
/// down to what rests beside them on a flat floor, a hopper's grains pass on to the tray, what is kept topped up stays,
/// and rain comes in, which takes its time to a hole: it falls, and a shaken floor carries it at 0.55 of its peak
/// speed. A vessel without a box is thought to keep its grains.
double predicted_grain_steps(const Scene& scene, double dt);

}  // namespace vibrosow
