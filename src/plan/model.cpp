#include "plan/model.hpp"

#include "plan/contact_parameters.hpp"
#include "plan/effects.hpp"
#include "plan/touching_kinds.hpp"
#include "scene/input_error.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {

Model prepare(const Scene& scene, const std::optional<EffectSet>& effects) {
  Model model{};
  model.scene = scene;
  model.vessels = {scene.tray};
  if (scene.hopper) model.vessels.push_back(*scene.hopper);
  model.law = &traits_of(scene.contact.law);
  model.effects = effects ? *effects : effects_of(scene);
  model.kernels = &kernels_for(scene.contact.law, model.effects);
  model.contacts = contact_parameters(scene.contact, scene.lots);
  model.smallest_radius = smallest_radius(scene.lots);
  model.largest_diameter = largest_diameter(scene.lots);
  model.loads = bed_loads(scene.lots, model.vessels, scene.run);
  model.kinds = grain_kinds(scene);
  const std::vector<GrainKind> touching = touching_kinds(scene.lots, model.kinds, *model.law);
  const StepBasis basis{model.scene, model.effects, model.contacts,       *model.law,
                        touching,    model.loads,   model.smallest_radius};
  model.step = plan_step(basis);
  model.overlap = predict_overlap(basis);
  if (!model.effects.rotation || !scene.contact.rotation)
    for (GrainKind& kind : model.kinds) kind.inverse_inertia = 0;
  return model;
}

Model prepare_to_run(const Scene& scene) {
  Model model = prepare(scene);
  if (const auto refused = step_refused(scene.numerics, model.step)) throw InputError(*refused);
  return model;
}

}  // namespace vibrosow
