#include "report/contact_model.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "laws/law.hpp"

namespace vibrosow {
namespace {

/// As TOML writes it, which JSON does too.
std::string toml_text(const std::string& text) {
  return nlohmann::json(text).dump();
}

std::string quantity(double value, double unit, const char* name) {
  return toml_text(fmt::format("{} {}", value / unit, name));
}

/// Keys that seeds and walls have.
std::string surface_keys(const Surface& surface, const Contact& contact) {
  std::string text = fmt::format("friction = {}\n", surface.friction);
  if (traits_of(contact.law).damping == LawDamping::restitution)
    text += fmt::format("restitution = {}\n", surface.restitution);
  if (contact.rolling != Rolling::none) {
    text += fmt::format("rolling_friction = {}\n", surface.rolling_friction);
    text += fmt::format("twisting_friction = {}\n", surface.twisting_friction);
  }
  return text + fmt::format("cohesion = {}\n", quantity(surface.cohesion, 1e-3, "mN"));
}

std::string law_keys(const Contact& contact) {
  const LawTraits& law = traits_of(contact.law);
  std::string text = fmt::format("law = {}\n", toml_text(std::string(law.name)));
  text += law.material == LawMaterial::shell
              ? fmt::format("shell_compression = {}\n", contact.shell_compression)
              : fmt::format("youngs_modulus = {}\npoisson_ratio = {}\n", quantity(contact.youngs_modulus, 1e6, "MPa"),
                            contact.poisson_ratio);
  if (law.damping == LawDamping::rate)
    text += fmt::format("damping_rate = {}\n", quantity(contact.damping_rate, 1, "1/s"));
  return text;
}

std::string friction_keys(const Contact& contact) {
  const bool spring = contact.friction_model == FrictionModel::spring;
  std::string text = fmt::format("friction_model = \"{}\"\n", spring ? "spring" : "sliding");
  if (!spring || contact.rolling == Rolling::constant_torque)
    text += fmt::format("slip_speed = {}\n", quantity(contact.slip_speed, 1e-3, "mm/s"));
  if (spring) text += fmt::format("tangential_damping = {}\n", contact.tangential_damping);
  if (spring && contact.tangential_ratio) text += fmt::format("tangential_ratio = {}\n", *contact.tangential_ratio);
  if (contact.friction_arm == FrictionArm::rim) text += "friction_arm = \"rim\"\n";
  return text;
}

std::string rolling_keys(const Contact& contact) {
  if (!contact.rotation) return "rotation = false\n";
  switch (contact.rolling) {
    case Rolling::none:
      return "rolling = \"none\"\n";
    case Rolling::constant_torque:
      return "rolling = \"constant-torque\"\n";
    case Rolling::spring:
      break;
  }
  return fmt::format("rolling = \"spring\"\nrolling_damping = {}\n", contact.rolling_damping);
}

}  // namespace

std::string contact_model_toml(const Contact& contact, const std::string& title,
                               const std::vector<std::pair<std::string, std::string>>& sources) {
  std::string text = fmt::format("title = {}\n", toml_text(title)) + law_keys(contact) +
                     surface_keys(contact.seed, contact) + friction_keys(contact) + rolling_keys(contact);
  if (contact.drag > 0) text += fmt::format("drag = {}\n", quantity(contact.drag, 1e-3, "g/s"));
  text += fmt::format("\n[wall]\n{}", surface_keys(contact.wall, contact));
  if (contact.wall_youngs_modulus)
    text += fmt::format("youngs_modulus = {}\npoisson_ratio = {}\n", quantity(*contact.wall_youngs_modulus, 1e6, "MPa"),
                        contact.wall_poisson_ratio);
  text += "\n[sources]\n";
  for (const auto& [key, source] : sources) text += fmt::format("{} = {}\n", toml_text(key), toml_text(source));
  return text;
}

}  // namespace vibrosow
