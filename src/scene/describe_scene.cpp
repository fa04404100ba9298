#include "scene/describe_scene.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

Json optional_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json time_or_never(double time) {
  return time == never ? Json(nullptr) : Json(time);
}

Json describe(const SeedLot& lot) {
  return {{"name", lot.name},
          {"diameter_m", lot.diameter},
          {"mass_kg", lot.mass},
          {"shape", lot.shape == Shape::disc ? "disc" : "ball"},
          {"number_share", lot.number_share}};
}

Json describe(const Surface& surface) {
  return {{"friction", surface.friction}, {"restitution", surface.restitution}};
}

Json describe(const Contact& contact) {
  return {{"law", "elastic-shell"},
          {"shell_compression", contact.shell_compression},
          {"seed", describe(contact.seed)},
          {"wall", describe(contact.wall)},
          {"slip_speed_m_per_s", contact.slip_speed},
          {"drag_kg_per_s", contact.drag},
          {"rotation", contact.rotation},
          {"friction_arm", contact.friction_arm == FrictionArm::rim ? "rim" : "contact-point"}};
}

Json describe(const Fill& fill) {
  const char* packings[] = {"poured", "layers", "hexagonal"};
  Json json = {{"count", fill.count}, {"packing", packings[static_cast<int>(fill.packing)]}};
  if (fill.packing != Packing::poured) json["jitter"] = fill.jitter;
  json["keep"] = fill.keep;
  return json;
}

Json describe(const HarmonicMotion& motion) {
  return {{"kind", "harmonic"},
          {"direction_rad", motion.direction},
          {"amplitude_m", motion.amplitude},
          {"frequency_hz", motion.frequency},
          {"phase_rad", motion.phase},
          {"ramp_s", motion.ramp},
          {"stop_s", time_or_never(motion.stop)},
          {"stop_ramp_s", motion.stop_ramp}};
}

Json describe(const SumMotion& motion) {
  Json components = Json::array();
  for (const HarmonicMotion& component : motion.components) components.push_back(describe(component));
  return {{"kind", "sum"}, {"components", components}};
}

Json describe(const RockingMotion& motion) {
  return {{"kind", "rocking"},
          {"pivot_m", {motion.pivot.x(), motion.pivot.y()}},
          {"angle_rad", motion.angle},
          {"frequency_hz", motion.frequency},
          {"ramp_s", motion.ramp},
          {"stop_s", time_or_never(motion.stop)},
          {"stop_ramp_s", motion.stop_ramp}};
}

Json describe(const TableMotion& motion) {
  return {
      {"kind", "table"}, {"time_s", motion.times}, {"x_m", motion.x}, {"y_m", motion.y}, {"angle_rad", motion.angle}};
}

Json describe(const std::optional<VesselMotion>& motion) {
  if (!motion) return nullptr;
  return std::visit([](const auto& kind) { return describe(kind); }, *motion);
}

Json describe(const Rain& rain) {
  return {{"rate_per_s", rain.rate}, {"from_m", rain.from},   {"to_m", rain.to},
          {"height_m", rain.height}, {"start_s", rain.start}, {"stop_s", time_or_never(rain.stop)}};
}

Json describe(const WallPiece& piece) {
  if (piece.radius == 0) return {{"from_m", {piece.a.x(), piece.a.y()}}, {"to_m", {piece.b.x(), piece.b.y()}}};
  return {{"centre_m", {piece.centre.x(), piece.centre.y()}},
          {"radius_m", piece.radius},
          {"from_rad", piece.from},
          {"to_rad", piece.to}};
}

Json describe(const Vessel& vessel) {
  const char* sides[] = {"walls", "open", "periodic"};
  Json pieces = Json::array();
  for (const WallPiece& piece : vessel.pieces) pieces.push_back(describe(piece));
  Json holes = Json::array();
  for (const Hole& hole : vessel.holes)
    holes.push_back({{"centre_m", hole.centre}, {"width_m", hole.width}, {"open_at_s", hole.open_at}});
  return {{"left_m", vessel.origin.x()},
          {"above_m", vessel.origin.y()},
          {"length_m", vessel.length},
          {"height_m", vessel.height},
          {"tilt_rad", vessel.tilt},
          {"funnel_rad", vessel.funnel},
          {"depth_m", optional_number(vessel.depth)},
          {"holes", holes},
          {"pieces", pieces},
          {"box", vessel.box},
          {"sides", sides[static_cast<int>(vessel.sides)]},
          {"fill", vessel.fill ? describe(*vessel.fill) : Json(nullptr)},
          {"rain", vessel.rain ? describe(*vessel.rain) : Json(nullptr)},
          {"motion", describe(vessel.motion)}};
}

Json describe(const Numerics& numerics) {
  Json json = {{"integrator", numerics.integrator == Integrator::rk2_midpoint ? "rk2-midpoint" : "velocity-verlet"}};
  if (numerics.dt) {
    json["dt_s"] = *numerics.dt;
  } else {
    json["steps_per_contact"] = numerics.steps_per_contact;
  }
  json["allow_long_step"] = numerics.allow_long_step;
  return json;
}

}  // namespace

Json describe_scene(const Scene& scene) {
  Json lots = Json::array();
  for (const SeedLot& lot : scene.lots) lots.push_back(describe(lot));
  return {{"lots", lots},
          {"contact", describe(scene.contact)},
          {"tray", describe(scene.tray)},
          {"hopper", scene.hopper ? describe(*scene.hopper) : Json(nullptr)},
          {"numerics", describe(scene.numerics)},
          {"guard",
           {{"warn_compression", scene.guard.warn_compression},
            {"stop_compression", scene.guard.stop_compression},
            {"energy_tolerance", scene.guard.energy_tolerance}}},
          {"run",
           {{"duration_s", scene.run.duration},
            {"measure_from_s", scene.run.measure_from},
            {"count_below_m", scene.run.count_below},
            {"start", scene.run.start == Start::with_tray ? "with-tray" : "at-rest"}}}};
}

}  // namespace vibrosow
