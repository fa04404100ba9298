#include "contact/effects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/motion.hpp"

namespace vibrosow {
namespace {

bool grains_differ(const std::vector<SeedLot>& lots) {
  return std::any_of(lots.begin(), lots.end(), [&lots](const SeedLot& lot) {
    return lot.diameter != lots.front().diameter || lot.mass != lots.front().mass || lot.shape != lots.front().shape;
  });
}

bool moves(const Vessel& vessel) {
  return vessel.motion && moves(*vessel.motion);
}

}  // namespace

EffectSet effects_of(const Scene& scene) {
  const Contact& contact = scene.contact;
  EffectSet effects;
  effects.friction = contact.seed.friction != 0 || contact.wall.friction != 0;
  effects.rotation = effects.friction && contact.rotation;
  effects.damping = contact.seed.restitution != 1 || contact.wall.restitution != 1;
  effects.unequal = grains_differ(scene.lots);
  effects.drag = contact.drag != 0;
  effects.motion = moves(scene.tray) || (scene.hopper && moves(*scene.hopper));
  return effects;
}

std::vector<std::string> effect_names(const EffectSet& effects) {
  std::vector<std::string> names;
  if (effects.friction) names.push_back("friction");
  if (effects.rotation) names.push_back("rotation");
  if (effects.damping) names.push_back("damping");
  if (effects.unequal) names.push_back("unequal");
  if (effects.drag) names.push_back("drag");
  if (effects.motion) names.push_back("motion");
  return names;
}

std::vector<EffectReason> explain_effects(const Scene& scene) {
  const EffectSet effects = effects_of(scene);
  const Contact& contact = scene.contact;
  const auto pair = [](const char* key, double seed, double wall) {
    return fmt::format("contact.{} = {:.6g} between seeds, {:.6g} on walls", key, seed, wall);
  };
  const std::string rotation = effects.rotation   ? "friction turns the grains"
                               : effects.friction ? "contact.rotation = false"
                                                  : "nothing turns a grain without friction";
  const auto moving = [&scene] {
    std::string text;
    for (const Vessel* vessel : {&scene.tray, scene.hopper ? &*scene.hopper : nullptr})
      if (vessel && moves(*vessel))
        text += fmt::format("{}{} moves: {}", text.empty() ? "" : ", ", vessel->name, motion_text(*vessel->motion));
    return text.empty() ? std::string("every vessel stands still") : text;
  };
  return {
      {"friction", effects.friction, pair("friction", contact.seed.friction, contact.wall.friction)},
      {"rotation", effects.rotation, rotation},
      {"damping", effects.damping, pair("restitution", contact.seed.restitution, contact.wall.restitution)},
      {"unequal", effects.unequal,
       effects.unequal ? "the lots differ in diameter, mass or shape"
                       : "every grain has the same diameter, mass and shape"},
      {"drag", effects.drag, fmt::format("contact.drag = {:.6g} g/s", contact.drag * 1e3)},
      {"motion", effects.motion, moving()},
  };
}

}  // namespace vibrosow
