#include "plan/derive_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plan/contact_parameters.hpp"
#include "plan/effects.hpp"
#include "plan/touching_kinds.hpp"
#include "scene/input_error.hpp"
#include "scene/mixture.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/hopper_images.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

/// What only space has cannot be left out in 2D without a word.
void check_plane(const Vessel& vessel) {
  const auto* turning = vessel.motion ? std::get_if<TurningMotion>(&*vessel.motion) : nullptr;
  if (turning && turning->axis == TurningAxis::upright)
    throw InputError(vessel.name + ".motion.axis: a vessel turns about an upright axis in 3D only");
  if (std::ranges::any_of(vessel.pieces, [](const WallPiece& piece) { return piece.about.has_value(); }))
    throw InputError(vessel.name + ".pieces: a line is turned about an axis in 3D only");
  if (!std::ranges::all_of(vessel.pieces, is_of_plane))
    throw InputError(vessel.name + ".pieces: a piece is drawn out along the vessel in 3D only");
}

void check_vessels(const Model& model) {
  if (const auto fault = image_fault(model.scene)) throw InputError("hopper." + fault->key + ": " + fault->message);
  if (model.scene.space == Space::two_dimensional) {
    std::ranges::for_each(model.vessels, check_plane);
    return;
  }
  for (const Vessel& vessel : model.vessels)
    if (!vessel.depth) throw InputError(vessel.name + ".depth: is missing; in 3D a vessel has one");
}

/// What a clump has no inertia for cannot turn as it should.
void check_clumps(const Scene& scene) {
  for (const SeedLot& lot : scene.lots)
    if (lot.shape == Shape::clump && is_solid_clump(lot) != (scene.space == Space::three_dimensional))
      throw InputError(fmt::format("seeds.{}: a clump has three moments of inertia in 3D and one in 2D", lot.name));
}

/// A mixture without one of its lots is another mixture.
void check_lots(const Scene& scene) {
  const auto missing = missing_lot(scene);
  if (!missing) return;
  const std::string key = key_of(*missing->vessel, missing->source);
  const bool filled = missing->source == SeedSource::fill;
  throw InputError(fmt::format("{}: {}", filled ? missing->vessel->fill->where.or_key(key) : key, missing->message));
}

/// All of a model but its step and what is foreseen beside it.
struct UnplannedModel {
  Model model;
  std::vector<GrainKind> touching;

  StepBasis basis() const {
    return {.scene = model.scene,
            .effects = model.effects,
            .contacts = model.contacts,
            .law = *model.law,
            .seeds = model.kinds,
            .touching = touching,
            .loads = model.loads,
            .smallest_radius = model.smallest_radius};
  }
};
UnplannedModel model_without_step(const Scene& scene, const std::optional<EffectSet>& effects = std::nullopt) {
  Model model{};
  model.scene = scene;
  model.vessels = {scene.tray};
  if (scene.hopper) model.vessels.push_back(*scene.hopper);
  check_vessels(model);
  check_clumps(scene);
  check_lots(scene);
  const LawTraits& law = traits_of(scene.contact.law);
  const Surfaces surfaces = meeting_surfaces(scene.contact, scene.lots.size());
  model.law = &law;
  model.effects = effects ? *effects : effects_of(scene, surfaces, law);
  model.kernels = &kernels_for(scene.contact.law, model.effects);
  const std::vector<SeedSizes> sizes = sizes_of(scene.lots);
  model.smallest_radius = smallest_radius(scene.lots);
  model.largest_diameter = largest_diameter(scene.lots);
  model.carried_beyond = carried_beyond(scene);
  const std::vector<SeedMaterial> materials = seed_materials(scene.contact, scene.lots);
  model.kinds = grain_kinds(scene.lots, materials, law);
  if (!model.effects.rotation || !scene.contact.rotation)
    for (GrainKind& kind : model.kinds) kind.inverse_inertia = 0;
  model.contacts = contact_parameters(scene.contact, surfaces, materials, law);
  model.loads = bed_loads(scene.lots, sizes, model.vessels, scene.run, scene.space);
  for (Vessel& image : hopper_images(scene)) model.vessels.push_back(std::move(image));
  return {model, touching_kinds(scene.lots, sizes, model.kinds, law)};
}

}  // namespace

Model derive_model(const Scene& scene, const std::optional<EffectSet>& effects) {
  UnplannedModel unplanned = model_without_step(scene, effects);
  Model& model = unplanned.model;
  model.step = plan_step(unplanned.basis());
  model.overlap = predict_overlap(unplanned.basis());
  model.contacts.steepest_sliding = model.step.steepest_sliding;
  model.contacts.steepest_rolling = model.step.steepest_rolling;
  return model;
}

PredictedOverlap overlap_as_written(const Scene& scene) {
  return predict_overlap(model_without_step(scene).basis());
}

double contact_duration_as_written(const Scene& scene) {
  return shortest_contact(model_without_step(scene).basis());
}

}  // namespace vibrosow
