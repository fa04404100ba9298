#include "plan/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "grains/fill_height.hpp"
#include "plan/fill_warnings.hpp"
#include "plan/geometry_warnings.hpp"
#include "plan/steadiness_warnings.hpp"
#include "portable_math/functions.hpp"
#include "scene/mixture.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "scene/spaces.hpp"
#include "scene/surfaces.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

using Warnings = std::vector<std::string>;

/// By number over all lots, of a figure of each.
template <class Metric>
double mean_over_seeds(const Scene& scene, Metric metric) {
  double mean = 0;
  for (const SeedLot& lot : scene.lots) mean += lot.number_fraction * metric(lot);
  return mean;
}

double mean_diameter(const Scene& scene) {
  return mean_over_seeds(scene, [](const SeedLot& lot) { return lot.diameter * size_moment(lot, 1); });
}

std::string millimetres(double length) {
  return fmt::format("{:.3g} mm", length * 1e3);
}

void warn_of_density(const SeedLot& lot, Warnings& warnings) {
  constexpr double least = 100, most = 5000;  // kg/m3, of anything that is sown
  constexpr double far = 1.2;                 // times a crop's own
  const std::optional<double> density = seed_density(lot), of_crop = lot.crop.seed_density;
  if (!density) return;
  const std::string begin = fmt::format("seeds.{}: its mass and size make seeds of {:.3g} kg/m3", lot.name, *density);
  if (*density < least || *density > most)
    warnings.push_back(fmt::format("{}; seeds have {:g} to {:g} kg/m3", begin, least, most));
  else if (of_crop && (*density > far * *of_crop || *density < *of_crop / far))
    warnings.push_back(fmt::format("{}, those of crop \"{}\" have {:.3g}: give a mass and a size that go together",
                                   begin, lot.crop.name, *of_crop));
}

/// Thickness of a lot's largest seed, the least width that it passes.
double largest_thickness(const SeedLot& lot) {
  return mean_thickness(lot) / size_moment(lot, 1) * most_size(lot);
}

void warn_of_narrow_holes(const Vessel& vessel, const std::vector<SeedLot>& lots, Warnings& warnings) {
  const auto narrowest = std::ranges::min_element(vessel.holes, {}, &Hole::width);
  if (narrowest == vessel.holes.end()) return;
  for (const SeedLot& lot : lots) {
    if (narrowest->width >= largest_thickness(lot)) continue;
    warnings.push_back(fmt::format("{}.holes.width: {} is narrower than seeds of {}, up to {} thick, which cannot pass",
                                   vessel.name, millimetres(narrowest->width), lot.name,
                                   millimetres(largest_thickness(lot))));
  }
}

bool has_friction(const Contact& contact) {
  return contact.seed.friction > 0 || contact.wall.friction > 0 ||
         std::ranges::any_of(contact.overrides, [](const SurfaceOverride& pair) { return pair.surface.friction > 0; });
}

void warn_of_standing_liquid(const Scene& scene, Warnings& warnings) {
  if ((scene.tray.motion && moves(*scene.tray.motion)) || has_friction(scene.contact)) return;
  warnings.push_back(
      "tray.motion: the tray stands still and contact.friction is 0: without either the bed flows as a liquid does");
}

/// Seeds that have no way out of a vessel.
bool is_closed(const Vessel& vessel) {
  return vessel.holes.empty() && vessel.box && vessel.sides != Sides::open;
}

/// Of a closely packed vessel, more than can ever be.
double most_seeds(const Scene& scene, const Vessel& vessel, double height) {
  if (scene.space == Space::three_dimensional) {
    const double volume = mean_over_seeds(scene, [](const SeedLot& lot) {
      const double thickness = mean_thickness(lot);
      return thickness * thickness * thickness / std::numbers::sqrt2;
    });
    return floor_area(vessel) * height / volume;
  }
  const double area = mean_over_seeds(scene, [](const SeedLot& lot) {
    const double thickness = mean_thickness(lot);
    return std::numbers::sqrt3 / 2 * thickness * thickness;
  });
  return vessel.length * height / area;
}

void warn_of_rain(const Scene& scene, const Vessel& vessel, Warnings& warnings) {
  if (!vessel.rain) return;
  const Rain& rain = *vessel.rain;
  if (const double seeds = rained_seeds(rain, scene.run.duration); seeds < 3)
    warnings.push_back(fmt::format("{}.rain: brings {:.2g} seeds on average in the whole run", vessel.name, seeds));
  const double diameter = mean_diameter(scene);
  const double rows = scene.space == Space::two_dimensional ? 1 : std::floor(*vessel.depth / diameter);
  const double run_in_parallel = rows * (std::floor((rain.to - rain.from) / diameter) + 1);
  const double most_rate = run_in_parallel / std::sqrt(2 * diameter / standard_gravity);
  if (rain.rate > most_rate)
    warnings.push_back(fmt::format(
        "{}.rain.rate: {:.4g} seeds/s cannot all come: {:.0f} seeds lie side by side where it rains, and the room is "
        "free again when they have fallen by a diameter, which is {:.3g} seeds/s at most",
        vessel.name, rain.rate, run_in_parallel, most_rate));
  const double lasts = std::min(rain.stop, scene.run.duration) - rain.start;
  const double asked = std::max(0.0, lasts) * rain.rate + (vessel.fill ? vessel.fill->count : 0);
  const double most = most_seeds(scene, vessel, std::min(rain.height + diameter, vessel.height + diameter));
  if (is_closed(vessel) && asked > most)
    warnings.push_back(fmt::format(
        "{}.rain.rate: {:.4g} seeds are to come, but the {} has no holes and holds no more than {:.0f} below its rain",
        vessel.name, asked, vessel.name, most));
}

/// What holes pass, but for a common factor.
double passed(const Vessel& vessel, Space space, double diameter) {
  constexpr double empty_rim = 1.4;  // diameters
  double sum = 0;
  for (const Hole& hole : vessel.holes) {
    const double width = std::max(0.0, hole.width - empty_rim * diameter);
    const bool round = space == Space::three_dimensional && hole.shape == HoleShape::round;
    const double across = space == Space::two_dimensional ? 1 : round ? 0.58 / 1.03 * width : hole.across_length;
    sum += across * portable_math::pow(width, 1.5);
  }
  return sum;
}

/// The plane takes every hole for a slot from front to back.
void warn_of_round_holes(const Vessel& vessel, Warnings& warnings) {
  if (vessel.holes.empty() || vessel.holes.front().shape != HoleShape::round) return;
  std::string taken;
  if (vessel.depth) {
    const double width = vessel.holes.front().width;
    const int rows = vessel.slots_in_3d.rows;
    taken = fmt::format(", {:.2g} times the area of {}", *vessel.depth / (rows * std::numbers::pi / 4 * width),
                        rows > 1 ? "its round holes" : "a round hole");
  }
  warnings.push_back(
      fmt::format("{}.holes.shape: in 2D a round hole is taken for a slot from front to back{}: rates are those of "
                  "such slots; space = \"3d\" simulates round holes",
                  vessel.name, taken));
}

/// Slots of 3D that do not reach from front to back, or lie in several rows, are one slot of 2D.
void warn_of_slots_in_3d(const Vessel& vessel, Warnings& warnings) {
  constexpr double whole = 0.99;
  const SlotsIn3d& slots = vessel.slots_in_3d;
  if (slots.open < whole)
    warnings.push_back(
        fmt::format("{}.holes.across: in 2D slots reach from front to back; these open {:.2g} % of the depth, so rates "
                    "of the tray come out up to {:.2g} times too high; space = \"3d\" simulates them",
                    vessel.name, 100 * slots.open, 1 / slots.open));
  if (slots.rows > 1)
    warnings.push_back(fmt::format(
        "{}.holes.rows: in 2D one hole stands for {}, one behind the other: figures of a hole, and of a row "
        "of a drill, are of all of them; space = \"3d\" tells them apart",
        vessel.name, slots.rows));
}

/// In 2D both are as deep as the tray.
void warn_of_depths(const Scene& scene, Warnings& warnings) {
  constexpr double rounding = 1e-6;
  const std::optional<double>&tray = scene.tray.depth, &hopper = scene.hopper->depth;
  if (!tray || !hopper || std::abs(*hopper - *tray) <= rounding * *tray) return;
  warnings.push_back(
      fmt::format("hopper.depth: {} is taken for the tray's {} in 2D, so the hopper feeds {:.2g} times what it does; "
                  "space = \"3d\" simulates it",
                  millimetres(*hopper), millimetres(*tray), *tray / *hopper));
}

void warn_of_hopper(const Scene& scene, const Vessel& hopper, Warnings& warnings) {
  if (!hopper.fill && !hopper.rain) return;
  if (is_closed(hopper)) {
    warnings.push_back("hopper.holes: is missing, so no seed leaves the hopper");
    return;
  }
  if (hopper.holes.empty()) return;
  constexpr double arching = 3, half = 0.5;
  const double thickness = slice_thickness(scene.lots);  // by volume: it is the large ones that arch
  const double widest = std::ranges::max_element(hopper.holes, {}, &Hole::width)->width;
  const double fraction = passed(hopper, scene.space, thickness) / passed(scene.tray, scene.space, thickness);
  if (widest < arching * thickness) {
    warnings.push_back(fmt::format("hopper.holes.width: {} is {:.2g} seeds of {}; below {:g} arches stop the flow",
                                   millimetres(widest), widest / thickness, millimetres(thickness), arching));
  } else if (fraction < half) {
    warnings.push_back(
        fmt::format("hopper.holes.width: the hopper cannot follow: its outlet passes some {:.2g} of what the tray's "
                    "holes can, so it "
                    "alone decides the rate",
                    fraction));
  }
}

bool rolls_freely_on(const Vessel& vessel, const Scene& scene) {
  if (!scene.contact.rotation || !vessel.motion || !moves(*vessel.motion)) return false;
  if (const auto* shake = std::get_if<HarmonicMotion>(&*vessel.motion);
      shake != nullptr && std::abs(portable_math::cos(shake->direction)) < 1e-6)
    return false;  // upright: it carries nothing
  return !has_clumps(scene.lots) && std::ranges::all_of(meeting_surfaces(scene.contact, scene.lots.size()).walls,
                                                        [](const Surface& wall) { return wall.rolling_friction == 0; });
}

/// Curves go on over the peaks of a sampled motion, and by much where there are too few rows.
void warn_of_overshoot(const Vessel& vessel, Warnings& warnings) {
  constexpr double much = 0.05;  // of the stroke; a sine of 6 rows a period has 0.075
  const auto* table = vessel.motion ? std::get_if<TableMotion>(&*vessel.motion) : nullptr;
  if (table == nullptr) return;
  const Overshoot most = largest_overshoot(*table);
  if (most.share > much)
    warnings.push_back(fmt::format(
        "{}.motion.file: between {:.4g} and {:.4g} s the curve through the rows leaves both of them by {:.2g} "
        "% of all that {} goes through; give more rows there",
        vessel.name, most.from, most.to, 100 * most.share, most.column));
}

/// A ball that nothing keeps from rolling turns on a floor that moves under it, and stays where it is.
void warn_of_free_rolling(const Scene& scene, const Vessel& vessel, Warnings& warnings) {
  constexpr double thin = 2.5;  // seeds, by which a bed is deep
  if (!vessel.fill || !vessel.box || vessel.funnel > 0 || !rolls_freely_on(vessel, scene)) return;
  const double layers = vessel.fill->count / most_seeds(scene, vessel, mean_diameter(scene));
  if (layers > thin) return;
  warnings.push_back(
      fmt::format("contact.wall.rolling_friction: is 0, and round seeds lie in a thin bed ({:.2g} layers) on the floor "
                  "of the {}: they "
                  "roll on it and are hardly carried; "
                  "give it (0.02 for smooth seeds), with rolling = \"spring\"",
                  layers, vessel.name));
}

/// In rows each seed takes the room of the largest, turned anyhow, and what is left free is lost when they move.
void warn_of_rows(const Scene& scene, const Vessel& vessel, Warnings& warnings) {
  constexpr double much_of_it = 0.8;
  if (!vessel.fill || vessel.fill->packing == Packing::poured) return;
  const std::string key = vessel.name + ".fill.height";
  if (!is_filled_to_height(vessel)) return;
  Vessel poured = vessel;
  poured.fill->packing = Packing::poured;
  const double laid = height_of_fill(vessel, scene.lots, scene.space),
               settled = height_of_fill(poured, scene.lots, scene.space);
  if (settled >= much_of_it * laid) return;
  warnings.push_back(fmt::format(
      "{}: {} seeds in rows lie {} high only as they are laid, each in the room of the largest, turned anyhow; they "
      "sink to some {}; packing = \"poured\" puts in as many as lie that high",
      key, vessel.fill->count, millimetres(laid), millimetres(settled)));
}

/// What whole seeds make of the fractions that were asked for.
void warn_of_mixture(const Scene& scene, Warnings& warnings) {
  constexpr double few = 3;  // seeds, of which one run in 20 has none
  for (const LotShare& share : lot_shares(scene)) {
    const std::string& lot = scene.lots[share.lot].name;
    const std::string key = key_of(*share.vessel, share.source);
    if (share.source == SeedSource::rain && share.asked_number > 0 && share.seeds < few)
      warnings.push_back(
          fmt::format("{}: the rain brings {:.2g} seeds of {} on average, in some runs none", key, share.seeds, lot));
    if (share.source == SeedSource::rain || share.seeds < 1) continue;
    if (off_by(share) > far_off)
      warnings.push_back(
          fmt::format("{}: of {} seeds {:.0f} are of {}: {:.3g} % by number instead of {:.3g} %, {:.3g} % by mass "
                      "instead of {:.3g} "
                      "%; more seeds come nearer",
                      key, share.vessel->fill->count, share.seeds, lot, 100 * share.of_number, 100 * share.asked_number,
                      100 * share.of_mass, 100 * share.asked_mass));
  }
}

/// A bed that could not be is a sign that masses and sizes do not go together.
void warn_of_bulk_density(const Scene& scene, Warnings& warnings) {
  constexpr double loosest = 0.3, closest = 0.7405;  // of the seeds' own density
  const std::optional<double> solid = solid_density(scene.lots);
  if (scene.space != Space::two_dimensional || !scene.tray.depth || !solid) return;
  const double implied = implied_bulk_density(scene.lots, poured_share);
  if (implied >= loosest * *solid && implied <= closest * *solid) return;
  warnings.push_back(fmt::format(
      "tray.depth: slices {} thick make a bed of {:.3g} kg/m3, {:.0f} % of the seeds' own density, where poured seeds "
      "have {:.0f} to {:.0f} %: rates of the whole tray are wrong by as much",
      millimetres(slice_thickness(scene.lots)), implied, 100 * implied / *solid, 100 * loosest, 100 * closest));
}

/// Two keys may be enough for a [contact] that stands alone, and what its writer left to a crop's model is lost.
void warn_of_models_not_used(const Scene& scene, Warnings& warnings) {
  const Contact& contact = scene.contact;
  if (contact.model.is_known() || contact.model.of_crops || contact.damping_rate > 0) return;
  if (contact.seed.restitution < 1) return;
  for (const SeedLot& lot : scene.lots)
    if (lot.contact.is_known())
      warnings.push_back(fmt::format(
          "contact: gives a stiffness and a friction or a law of its own, so {}, the contact model of seeds.{}, is not "
          "used: seeds rebound with restitution 1{}; model = \"crop\" keeps the rest of it",
          lot.contact.name, lot.name, contact.rolling == Rolling::none ? " and roll without resistance" : ""));
}

bool has_override(const Scene& scene, int lot, int other) {
  return std::ranges::any_of(scene.contact.overrides,
                             [&](const SurfaceOverride& pair) { return pair.lot == lot && pair.other == other; });
}

/// Of a file's path, what lies before its name.
std::string_view folder_of(std::string_view file) {
  return file.substr(0, file.find_last_of('/') + 1);
}

/// Friction and restitution decide the rate, and are of one seed on one material. A model from elsewhere than the
/// crop's was fitted to it or chosen by hand.
void warn_of_foreign_contacts(const Scene& scene, Warnings& warnings) {
  constexpr int walls = -1;
  const PresetFile& model = scene.contact.model;
  if (!model.is_known()) return;
  for (std::size_t i = 0; i < scene.lots.size(); ++i) {
    const SeedLot& lot = scene.lots[i];
    const int number = static_cast<int>(i);
    if (!lot.contact.is_known() || lot.contact.file == model.file) continue;
    if (folder_of(lot.contact.file) != folder_of(model.file)) continue;
    if (has_override(scene, number, number) && has_override(scene, number, walls)) continue;
    warnings.push_back(
        fmt::format("contact.model: \"{}\" is made for other seeds than seeds.{}, whose crop, {}, has \"{}\"; "
                    "model = \"crop\" takes that",
                    model.name, lot.name, lot.crop.name, lot.contact.name));
  }
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene) {
  Warnings warnings;
  for (const SeedLot& lot : scene.lots) warn_of_density(lot, warnings);
  warn_of_mixture(scene, warnings);
  warn_of_bulk_density(scene, warnings);
  warn_of_narrow_holes(scene.tray, scene.lots, warnings);
  warn_of_models_not_used(scene, warnings);
  warn_of_foreign_contacts(scene, warnings);
  warn_of_standing_liquid(scene, warnings);
  warn_of_rows(scene, scene.tray, warnings);
  warn_of_rain(scene, scene.tray, warnings);
  warn_of_overshoot(scene.tray, warnings);
  warn_of_free_rolling(scene, scene.tray, warnings);
  if (scene.space == Space::two_dimensional) warn_of_round_holes(scene.tray, warnings);
  warn_of_slots_in_3d(scene.tray, warnings);
  for (const std::string& warning : geometry_warnings(scene)) warnings.push_back(warning);
  for (const std::string& warning : steadiness_warnings(scene)) warnings.push_back(warning);
  std::ranges::copy(scene.doubts_of_reader.sentences, std::back_inserter(warnings));
  if (!scene.hopper) return warnings;
  if (scene.space == Space::two_dimensional) warn_of_round_holes(*scene.hopper, warnings);
  warn_of_slots_in_3d(*scene.hopper, warnings);
  if (scene.space == Space::two_dimensional) warn_of_depths(scene, warnings);
  warn_of_narrow_holes(*scene.hopper, scene.lots, warnings);
  warn_of_rows(scene, *scene.hopper, warnings);
  warn_of_rain(scene, *scene.hopper, warnings);
  warn_of_overshoot(*scene.hopper, warnings);
  warn_of_hopper(scene, *scene.hopper, warnings);
  return warnings;
}

}  // namespace vibrosow
