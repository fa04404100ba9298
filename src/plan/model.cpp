#include "plan/model.hpp"

#include "plan/derive_model.hpp"
#include "plan/softness.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {

Model prepare(const Scene& scene, const std::optional<EffectSet>& effects) {
  return derive_model(resolve_accuracy_level(scene), effects);
}

Model prepare_to_run(const Scene& scene) {
  Model model = prepare(scene);
  if (const auto refused = step_refused(scene.numerics, model.step)) throw InputError(*refused);
  return model;
}

}  // namespace vibrosow
