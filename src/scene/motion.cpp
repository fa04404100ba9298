#include "scene/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace vibrosow {
namespace {

bool differs_from_zero(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return value != 0; });
}

struct Moves {
  bool operator()(const HarmonicMotion& m) const { return m.amplitude != 0 && (m.frequency != 0 || m.phase != 0); }
  bool operator()(const SumMotion& m) const { return std::any_of(m.components.begin(), m.components.end(), *this); }
  bool operator()(const RockingMotion& m) const { return m.angle != 0 && m.frequency != 0; }
  bool operator()(const TableMotion& m) const {
    return differs_from_zero(m.x) || differs_from_zero(m.y) || differs_from_zero(m.angle) || differs_from_zero(m.z);
  }
  bool operator()(const TurningMotion& m) const { return m.angular_velocity != 0; }
};

struct Text {
  std::string operator()(const HarmonicMotion& m) const {
    return fmt::format("{:.6g} mm at {:.6g} Hz", m.amplitude * 1e3, m.frequency);
  }
  std::string operator()(const SumMotion& m) const {
    std::string text;
    for (const HarmonicMotion& component : m.components) text += (text.empty() ? "" : " + ") + (*this)(component);
    return text;
  }
  std::string operator()(const RockingMotion& m) const {
    return fmt::format("{:.6g} degree at {:.6g} Hz about ({:.6g}, {:.6g}) mm", m.angle * 180 / std::numbers::pi,
                       m.frequency, m.pivot.x() * 1e3, m.pivot.y() * 1e3);
  }
  std::string operator()(const TurningMotion& m) const {
    const bool upright = m.axis == TurningAxis::upright;
    return fmt::format("{:.6g} rpm about {} at ({:.6g}, {:.6g}) mm", m.angular_velocity * 30 / std::numbers::pi,
                       upright ? "the upright axis" : "the axis across", m.pivot.x() * 1e3, m.pivot.y() * 1e3);
  }
  std::string operator()(const TableMotion& m) const {
    return fmt::format("a table of {} times from {:.6g} to {:.6g} s", m.times.size(), m.times.front(), m.times.back());
  }
};

}  // namespace

bool moves(const VesselMotion& motion) {
  return std::visit(Moves{}, motion);
}

bool moves_across(const VesselMotion& motion) {
  if (const auto* harmonic = std::get_if<HarmonicMotion>(&motion)) return harmonic->across != 0;
  if (const auto* table = std::get_if<TableMotion>(&motion)) return differs_from_zero(table->z);
  const auto* sum = std::get_if<SumMotion>(&motion);
  return sum != nullptr &&
         std::ranges::any_of(sum->components, [](const HarmonicMotion& component) { return component.across != 0; });
}

bool turns(const VesselMotion& motion) {
  if (const auto* table = std::get_if<TableMotion>(&motion)) return differs_from_zero(table->angle);
  return std::holds_alternative<RockingMotion>(motion) || std::holds_alternative<TurningMotion>(motion);
}

bool turns_over(const Vessel& vessel) {
  const auto* turning = vessel.motion ? std::get_if<TurningMotion>(&*vessel.motion) : nullptr;
  return turning != nullptr && turning->axis == TurningAxis::across;
}

bool turns_steadily(const Vessel& vessel) {
  return vessel.motion && std::holds_alternative<TurningMotion>(*vessel.motion);
}

std::string motion_text(const VesselMotion& motion) {
  return std::visit(Text{}, motion);
}

}  // namespace vibrosow
