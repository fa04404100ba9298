#include "scene/describe_scene.hpp"

#include "scene/integrator_names.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

Json optional_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json describe(const SizeDistribution& sizes) {
  using Kind = SizeDistribution::Kind;
  const char* names[] = {"single", "uniform", "normal", "lognormal", "table"};
  Json json = {{"distribution", names[static_cast<int>(sizes.kind)]}};
  if (sizes.kind == Kind::table) {
    json["diameters_m"] = sizes.diameter;
    json["fractions"] = sizes.fraction;
    return json;
  }
  if (sizes.kind != Kind::uniform) json["mean_m"] = sizes.mean, json["deviation_m"] = sizes.deviation;
  json["least_m"] = sizes.least;
  json["most_m"] = sizes.most;
  return json;
}

Json time_or_never(double time) {
  return time == never ? Json(nullptr) : Json(time);
}

Json describe(const SeedLot& lot) {
  const char* shapes[] = {"disc", "ball", "clump"};
  Json json = {{"name", lot.name},
               {"diameter_m", lot.diameter},
               {"mass_kg", lot.mass},
               {"shape", shapes[static_cast<int>(lot.shape)]},
               {"number_fraction", lot.number_fraction}};
  if (lot.sizes.kind != SizeDistribution::Kind::single) json["sizes"] = describe(lot.sizes);
  if (lot.shape == Shape::clump) {
    Json discs = Json::array();
    for (const ClumpDisc& disc : lot.discs)
      discs.push_back({{"x_m", disc.x}, {"y_m", disc.y}, {"radius_m", disc.radius}});
    json["discs"] = discs;
    json["gyration2_m2"] = lot.gyration2;
  }
  if (lot.shell_compression) json["shell_compression"] = *lot.shell_compression;
  if (lot.youngs_modulus) json["youngs_modulus_pa"] = *lot.youngs_modulus;
  if (lot.poisson_ratio) json["poisson_ratio"] = *lot.poisson_ratio;
  return json;
}

Json describe(const Surface& surface) {
  Json json = {{"friction", surface.friction}, {"restitution", surface.restitution}};
  if (surface.rolling_friction != 0) json["rolling_friction"] = surface.rolling_friction;
  if (surface.cohesion != 0) json["cohesion_n"] = surface.cohesion;
  return json;
}

void describe_law(const Contact& contact, Json& json) {
  if (contact.law == Law::elastic_shell) {
    json["law"] = "elastic-shell";
    json["shell_compression"] = contact.shell_compression;
    return;
  }
  json["law"] = "hertz";
  json["youngs_modulus_pa"] = contact.youngs_modulus;
  json["poisson_ratio"] = contact.poisson_ratio;
  if (contact.wall_youngs_modulus) {
    json["wall_youngs_modulus_pa"] = *contact.wall_youngs_modulus;
    json["wall_poisson_ratio"] = contact.wall_poisson_ratio;
  }
  if (contact.law == Law::hertz_viscous) json["damping_rate_per_s"] = contact.damping_rate;
}

void describe_friction_model(const Contact& contact, Json& json) {
  if (contact.friction_model == FrictionModel::sliding) {
    json["slip_speed_m_per_s"] = contact.slip_speed;
    return;
  }
  json["friction_model"] = "spring";
  if (contact.tangential_ratio) json["tangential_ratio"] = *contact.tangential_ratio;
  json["tangential_damping"] = contact.tangential_damping;
}

void describe_rolling(const Contact& contact, Json& json) {
  if (contact.rolling == Rolling::none) return;
  json["rolling"] = contact.rolling == Rolling::spring ? "spring" : "constant-torque";
  if (contact.rolling == Rolling::spring) json["rolling_damping"] = contact.rolling_damping;
}

Json describe(const Contact& contact) {
  Json json;
  describe_law(contact, json);
  json["seed"] = describe(contact.seed);
  json["wall"] = describe(contact.wall);
  for (const SurfaceOverride& pair : contact.overrides) {
    Json surface = {{"lot", pair.lot}, {"other", pair.other}};
    surface.update(describe(pair.surface));
    json["pairs"].push_back(surface);
  }
  describe_friction_model(contact, json);
  describe_rolling(contact, json);
  json["drag_kg_per_s"] = contact.drag;
  json["rotation"] = contact.rotation;
  json["friction_arm"] = contact.friction_arm == FrictionArm::rim ? "rim" : "contact-point";
  return json;
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
  Json json = {{"integrator", integrator_name(numerics.integrator)}};
  if (numerics.dt) {
    json["dt_s"] = *numerics.dt;
  } else {
    json["steps_per_contact"] = numerics.steps_per_contact;
  }
  if (numerics.impact_speed) json["impact_speed_m_per_s"] = *numerics.impact_speed;
  json["allow_long_step"] = numerics.allow_long_step;
  return json;
}

}  // namespace

Json describe_scene(const Scene& scene) {
  Json lots = Json::array();
  for (const SeedLot& lot : scene.lots) lots.push_back(describe(lot));
  Json json = {{"lots", lots},
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
  if (scene.run.end_after_pause) json["run"]["end_after_pause_s"] = *scene.run.end_after_pause;
  if (scene.record) json["record"] = {{"times_s", scene.record->times}, {"cell_m", scene.record->cell}};
  return json;
}

}  // namespace vibrosow
