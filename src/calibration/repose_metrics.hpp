#pragma once

#include <optional>

#include "result/run.hpp"
#include "scene/scene.hpp"

namespace vibrosow {

/// What a run of seeders/atlas.toml says of its material. A box is filled, its slot opens, it drains.
struct ReposeMetrics {
  std::optional<double> angle;      // rad, of the heaps that are left (`drained_angle`); none: the slot clogged
  std::optional<double> packing;    // packing fraction of the filled bed, of its area or volume (`bed_packing`)
  std::optional<double> discharge;  // C of rate = C rho_b sqrt(g) D^(3/2) while it flows freely; none: it clogged
};

/// Of a run whose first record is of the filled box and whose last of the drained one; d is the mean diameter of the
/// scene's lots, of clumps that of the disc (ball) of the same area (volume). The free discharge is that of the second
/// and third fifth of the grains that leave, in units of the bulk density, the slot's width and gravity (Beverloo,
/// Leniger, van de Velde 1961 in 2D, without the correction for the width of a grain). Throws
/// std::invalid_argument for a scene with less than two records or not one hole.
ReposeMetrics repose_metrics(const Scene& scene, const Run& run);

/// Length over width of a scene's seeds: 1 of balls, else of its first lot's row of discs.
double aspect_ratio(const Scene& scene);

}  // namespace vibrosow
