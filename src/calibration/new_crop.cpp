#include "calibration/new_crop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr double round_enough = 1.1;                        // aspect ratio up to which a seed is taken for a ball
constexpr double densest_balls = 0.74, loosest_bed = 0.35;  // packing fractions between which a dry bed of seeds lies

void require_order(const NewCrop& crop) {
  const auto refuse = [](const char* option, double value, const char* other, double limit) {
    throw InputError(fmt::format("{}: {:g} mm is more than the {}, {:g} mm", option, value * 1e3, other, limit * 1e3));
  };
  if (crop.width > crop.length) refuse("--width", crop.width, "length", crop.length);
  if (crop.thickness > crop.width) refuse("--thickness", crop.thickness, "width", crop.width);
}

/// 1 for what is taken for a ball.
double aspect_ratio_of(const NewCrop& crop) {
  const double ratio = crop.length / std::sqrt(crop.width * crop.thickness);
  if (ratio < round_enough) return 1;
  const auto refuse = [&](const char* option, const char* why) {
    throw InputError(fmt::format("{}: a seed of {:g} x {:g} x {:g} mm {}", option, crop.length * 1e3, crop.width * 1e3,
                                 crop.thickness * 1e3, why));
  };
  if (crop.width == crop.length) refuse("--width", "is flat and round; give a width that is a little less");
  if (elongated_solid(crop.length, crop.width, crop.thickness).empty())
    refuse("--length", "is too slender, or too thin, to be made of balls");
  return ratio;
}

/// Longer seeds than the atlas has are taken for its longest.
double in_atlas(double aspect_ratio, const ReposeAtlas& atlas, std::vector<std::string>& doubts) {
  const double most = atlas.aspect_ratios().back();
  if (aspect_ratio <= most) return aspect_ratio;
  doubts.push_back(
      fmt::format("the seed is {:.3g} times as long as thick and the atlas goes up to {:g} times: how it rubs is that "
                  "of shorter seeds that stand and lie so",
                  aspect_ratio, most));
  return most;
}

double joint(double a, double b) {
  return std::sqrt(a * a + b * b);
}

/// The measured angle must be near what some material does.
void require_reachable(double angle, const Reachable& range, const ShippedAtlas& atlas, double aspect_ratio) {
  const double slack = 2 * joint(assumed_angle_error, angle_error_3d(atlas.to_space));
  if (angle >= range.least_angle - slack && angle <= range.most_angle + slack) return;
  throw InputError(
      fmt::format("--repose: {:.3g} degree: at an aspect ratio of {:.3g} the atlas' materials stand at {:.3g} to "
                  "{:.3g} degree, good to {:.2g}; "
                  "{}",
                  angle / degree, aspect_ratio, range.least_angle / degree, range.most_angle / degree, slack / degree,
                  angle > range.most_angle ? "hairs, hooked hulls or moisture that make seeds stick are not in it"
                                           : "friction below its least is not in it"));
}

/// The bulk density as a packing fraction, where it can be true.
void take_packing(const NewCrop& crop, const ShippedAtlas& atlas, CropEstimate& estimate) {
  if (!crop.bulk_density) return;
  const double packing = *crop.bulk_density / estimate.seed_density;
  estimate.packing = packing;
  const double error = assumed_packing_error * packing;
  const std::string seed =
      fmt::format("{:.3g} kg/m3 poured is {:.2f} of the {:.4g} kg/m3 that the seed's mass and size make",
                  *crop.bulk_density, packing, estimate.seed_density);
  if (packing > densest_balls || packing < loosest_bed) {
    estimate.doubts.push_back(
        fmt::format("{}, where dry seeds lie between {:g} and {:g}: the weight, a size or the bulk density is not "
                    "right{}; the bulk "
                    "density is left out of the band",
                    seed, loosest_bed, densest_balls,
                    packing > densest_balls ? ", or the seed is thicker than that"
                                            : ", or the seed is narrower (--width, --thickness)"));
    return;
  }
  const double slack = 2 * joint(error, packing_error_3d(atlas.to_space) * packing);
  const Reachable& range = estimate.reachable;
  if (packing < range.least_packing - slack || packing > range.most_packing + slack) {
    estimate.doubts.push_back(
        fmt::format("{}, and the atlas' materials lie at {:.2f} to {:.2f}: the bulk density is left out of the band",
                    seed, range.least_packing, range.most_packing));
    return;
  }
  estimate.used.packing = packing;
  estimate.used.packing_error = error;
}

/// eps / r <= 0.0025 g r / V^2 keeps a shell under 5 % of the radius at V, twice the speed of a tray of 9 Hz and 1 cm;
/// to one digit, down.
double stiff_enough(double radius) {
  const double speed = 2 * 0.01 * 2 * std::numbers::pi * 9;
  const double most = 0.0025 * standard_gravity * radius / (speed * speed);
  const double digit = std::pow(10, std::floor(std::log10(most)));
  return std::floor(most / digit) * digit;
}

}  // namespace

CropEstimate estimate(const NewCrop& crop, const ShippedAtlas& atlas) {
  require_order(crop);
  CropEstimate estimate;
  estimate.aspect_ratio = aspect_ratio_of(crop);
  estimate.aspect_ratio_in_atlas = in_atlas(estimate.aspect_ratio, atlas.atlas, estimate.doubts);
  estimate.seed_density = crop.mass / (std::numbers::pi / 6 * crop.length * crop.width * crop.thickness);
  if (estimate.seed_density < 100 || estimate.seed_density > 5000)
    throw InputError(
        fmt::format("--tkw: {:.4g} g a thousand in seeds of that size is a density of {:.3g} kg/m3, which no seed has",
                    crop.mass * 1e6, estimate.seed_density));
  estimate.reachable = reachable(atlas, estimate.aspect_ratio_in_atlas);
  if (crop.angle_of_repose) {
    require_reachable(*crop.angle_of_repose, estimate.reachable, atlas, estimate.aspect_ratio_in_atlas);
    estimate.used.angle = crop.angle_of_repose;
    estimate.used.angle_error = assumed_angle_error;
  }
  take_packing(crop, atlas, estimate);
  estimate.band = repose_band(atlas, estimate.aspect_ratio_in_atlas, estimate.used);
  if (atlas.to_space.of_the_crop) estimate.own_runs = atlas.to_space.materials;
  estimate.fitting_angle =
      atlas.atlas
          .at(estimate.aspect_ratio_in_atlas, estimate.band.fitting.friction, estimate.band.fitting.rolling_friction)
          .angle.mean +
      atlas.to_space.angle_offset.mean;
  estimate.shell_compression = stiff_enough(0.5 * crop.thickness);
  if (!estimate.is_ball() && estimate.own_runs == 0)
    estimate.doubts.push_back(
        "the atlas is in 2D; what 3D adds was found with balls alone, and is taken to hold for this shape");
  return estimate;
}

}  // namespace vibrosow
