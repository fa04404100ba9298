#include "plan/effects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/motion.hpp"

namespace vibrosow {
namespace {

bool grains_differ(const Scene& scene) {
  const SeedLot& first = scene.lots.front();
  return !scene.contact.overrides.empty() ||
         std::any_of(scene.lots.begin(), scene.lots.end(), [&first](const SeedLot& lot) {
           return lot.diameter != first.diameter || lot.mass != first.mass || lot.shape != first.shape ||
                  lot.gyration2 != first.gyration2 || lot.gyration2_x != first.gyration2_x ||
                  lot.gyration2_y != first.gyration2_y || lot.sizes.kind != SizeDistribution::Kind::single ||
                  lot.shell_compression != first.shell_compression || lot.youngs_modulus != first.youngs_modulus ||
                  lot.poisson_ratio != first.poisson_ratio;
         });
}

/// Whether any two surfaces that can meet have `property` beside its neutral value.
template <class Property>
bool any_surface(const Surfaces& surfaces, Property present) {
  return std::ranges::any_of(surfaces.pairs, present) || std::ranges::any_of(surfaces.walls, present);
}

bool moves(const Vessel& vessel) {
  return vessel.motion && moves(*vessel.motion);
}

}  // namespace

EffectSet effects_of(const Scene& scene, const Surfaces& surfaces, const LawTraits& law) {
  const Contact& contact = scene.contact;
  EffectSet effects;
  effects.friction = any_surface(surfaces, [](const Surface& s) { return s.friction != 0; });
  effects.clumps =
      std::any_of(scene.lots.begin(), scene.lots.end(), [](const SeedLot& lot) { return !lot.discs.empty(); });
  effects.rotation = (effects.friction || effects.clumps) && contact.rotation;
  effects.damping = law.damping == LawDamping::rate
                        ? contact.damping_rate != 0
                        : any_surface(surfaces, [](const Surface& s) { return s.restitution != 1; });
  effects.polydisperse = effects.clumps || grains_differ(scene);
  effects.drag = contact.drag != 0;
  effects.motion = moves(scene.tray) || (scene.hopper && moves(*scene.hopper));
  effects.tangential_spring = effects.friction && contact.friction_model == FrictionModel::spring;
  const bool is_3d = scene.space == Space::three_dimensional;
  const bool rolls = effects.friction && effects.rotation && any_surface(surfaces, [is_3d](const Surface& s) {
                       return s.rolling_friction != 0 || (is_3d && s.twisting_friction != 0);
                     });
  effects.rolling = rolls ? contact.rolling : Rolling::none;
  effects.periodic = scene.tray.sides == Sides::periodic || (is_3d && scene.tray.front_and_back == Sides::periodic);
  effects.cohesion = any_surface(surfaces, [](const Surface& s) { return s.cohesion != 0; });
  return effects;
}

std::vector<std::string> effect_names(const EffectSet& effects) {
  std::vector<std::string> names;
  const auto name = [&names](bool present, const char* effect) {
    if (present) names.push_back(effect);
  };
  name(effects.friction, "friction");
  name(effects.tangential_spring, "tangential spring");
  name(effects.rotation, "rotation");
  name(effects.rolling != Rolling::none, "rolling");
  name(effects.damping, "damping");
  name(effects.cohesion, "cohesion");
  name(effects.polydisperse, "polydisperse");
  name(effects.clumps, "clumps");
  name(effects.drag, "drag");
  name(effects.motion, "motion");
  name(effects.periodic, "periodic");
  return names;
}

std::vector<EffectReason> explain_effects(const Scene& scene, const EffectSet& effects, const LawTraits& law) {
  const Contact& contact = scene.contact;
  const auto pair = [&](const char* key, double Surface::*value) {
    return fmt::format("contact.{} = {:.6g} between seeds, {:.6g} on walls{}", key, contact.seed.*value,
                       contact.wall.*value, contact.overrides.empty() ? "" : ", some pairs their own");
  };
  const std::string rotation = effects.rotation   ? effects.friction ? "friction turns the grains" : "clumps turn"
                               : effects.friction ? "contact.rotation = false"
                                                  : "nothing turns a grain without friction";
  const std::string damping = law.damping == LawDamping::rate
                                  ? fmt::format("contact.damping_rate = {:.6g} 1/s", contact.damping_rate)
                                  : pair("restitution", &Surface::restitution);
  const auto moving = [&scene] {
    std::string text;
    for (const Vessel* vessel : {&scene.tray, scene.hopper ? &*scene.hopper : nullptr})
      if (vessel && moves(*vessel))
        text += fmt::format("{}{} moves: {}", text.empty() ? "" : ", ", vessel->name, motion_text(*vessel->motion));
    return text.empty() ? std::string("every vessel stands still") : text;
  };
  const bool is_3d = scene.space == Space::three_dimensional;
  const char* seed = is_3d ? "ball" : "disc";
  const auto periodic = [&scene, is_3d] {
    const bool along = scene.tray.sides == Sides::periodic;
    const bool across = is_3d && scene.tray.front_and_back == Sides::periodic;
    if (!along && !across) return std::string("the tray ends at its sides");
    return fmt::format("tray.{} = \"periodic\"{}", along ? "sides" : "front_and_back",
                       along && across ? ", and front_and_back" : "");
  };
  const auto told = [](bool present, const char* yes, const char* no) { return std::string(present ? yes : no); };
  return {
      {"friction", effects.friction, pair("friction", &Surface::friction)},
      {"tangential spring", effects.tangential_spring,
       told(effects.tangential_spring, "contact.friction_model = \"spring\": contacts remember",
            "friction follows the sliding speed")},
      {"rotation", effects.rotation, rotation},
      {"rolling", effects.rolling != Rolling::none, pair("rolling_friction", &Surface::rolling_friction)},
      {"damping", effects.damping, damping},
      {"cohesion", effects.cohesion, pair("cohesion", &Surface::cohesion) + " (N)"},
      {"polydisperse", effects.polydisperse,
       told(effects.polydisperse, "grains differ in diameter, mass, shape or material",
            "every grain has the same diameter, mass, shape and material")},
      {"clumps", effects.clumps,
       effects.clumps ? fmt::format("a seed is several {}s", seed) : fmt::format("every seed is one {}", seed)},
      {"drag", effects.drag, fmt::format("contact.drag = {:.6g} g/s", contact.drag * 1e3)},
      {"motion", effects.motion, moving()},
      {"periodic", effects.periodic, periodic()},
  };
}

}  // namespace vibrosow
