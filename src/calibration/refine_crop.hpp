#pragma once

#include <cstdint>
#include <vector>

#include "calibration/new_crop.hpp"
#include "scene/scene.hpp"
#include "study/study_runs.hpp"

namespace vibrosow {

/// One run of the atlas' box in 3D, filled with seeds of a crop's own shape.
struct RefiningRun {
  double aspect_ratio_in_atlas = 1;
  Scene scene{};
  std::uint64_t random_seed = 1;
};

/// So many runs at materials spread over what is left open of a crop (`materials_of_band`), each with a random seed of
/// its own: what of plane and space is scatter between materials far from it, or was found with balls, is found anew by
/// them. The box is that of seeders/studies/atlas-space.toml. Throws InputError for a shape that cannot be made of
/// balls.
std::vector<RefiningRun> refining_runs(const NewCrop& crop, const CropEstimate& estimate, const ShippedAtlas& atlas,
                                       int count);

/// What to add to the plane by those runs, which `kept` gives. Throws InputError where less than three drained.
PlaneToSpace refined_to_space(const ReposeAtlas& atlas, const std::vector<RefiningRun>& runs, const KeptRuns& kept);

}  // namespace vibrosow
