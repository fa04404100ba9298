#include "report/crop_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "report/terminal_text.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr double little_learnt = 0.3;  // contraction
constexpr double hardly_apart = 0.7;   // correlation
constexpr const char* measured = "measured by the user";

/// Keys with their values as TOML, and where each value comes from.
class SourcedKeys {
 public:
  void add(const std::string& key, const std::string& value, std::string_view source, const std::string& table = "") {
    lines_.push_back({table, fmt::format("{} = {}\n", key, value)});
    const std::string name = table.empty() ? key : fmt::format("\"{}.{}\"", table, key);
    sources_ += fmt::format("{} = \"{}\"\n", name, source);
  }

  std::string text(const std::string& comment, const std::string& title) const {
    std::string text = fmt::format("# {}\ntitle = \"{}\"\n", comment, title), table;
    for (const auto& [of, line] : lines_) {
      if (of != table) text += fmt::format("\n[{}]\n", of);
      table = of;
      text += line;
    }
    return text + "\n[sources]\n" + sources_;
  }

 private:
  std::vector<std::pair<std::string, std::string>> lines_;  // table and line
  std::string sources_;
};

std::string quantity(double value, std::string_view unit) {
  return fmt::format("\"{:.6g} {}\"", value, unit);
}

/// "a repose of 25 degree and a bulk density of 680 kg/m3"; empty where neither counted.
std::string evidence(const NewCrop& crop, const CropEstimate& estimate) {
  std::string text;
  if (estimate.used.angle) text = fmt::format("a repose of {:.4g} degree", *estimate.used.angle / degree);
  if (estimate.used.packing)
    text += fmt::format("{}a bulk density of {:.4g} kg/m3", text.empty() ? "" : " and ", *crop.bulk_density);
  return text;
}

std::string band_source(const ParameterBand& band, const std::string& evidence, int own_runs) {
  if (evidence.empty())
    return fmt::format(
        "assumed: middle of the atlas of repose, {:.2g} to {:.2g}, since neither repose nor bulk density says more",
        band.low, band.high);
  const std::string refined = own_runs > 0 ? fmt::format(", refined by {} runs of this crop in 3D", own_runs) : "";
  return fmt::format("out of {:.2g} to {:.2g} (95 %) by the atlas of repose from {}, uncertainty reduced by {:.0f} %{}",
                     band.low, band.high, evidence, 100 * std::max(0.0, band.contraction), refined);
}

std::string band_line(std::string_view name, double taken, const ParameterBand& band) {
  return fmt::format("  {:<18} {:>6.2f}   {:>4.2f} to {:<4.2f}   {:>9.0f} %\n", name, taken, band.low, band.high,
                     -100 * std::max(0.0, band.contraction) + 0.0);
}

std::string undetermined(const CropEstimate& estimate) {
  std::string names;
  if (estimate.band.friction.contraction < little_learnt) names = "friction";
  if (estimate.band.rolling_friction.contraction < little_learnt)
    names += names.empty() ? "rolling friction" : " and rolling friction";
  if (names.empty()) return "not determined: restitution, stiffness and the friction on the tray, which are assumed";
  return fmt::format(
      "not determined: {} (hardly less uncertain than without a measurement); restitution, stiffness and the "
      "friction on the tray, which are assumed",
      names);
}

/// "2.1 x 2 x 1.9 mm"
std::string sizes_text(const NewCrop& crop) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", crop.length * 1e3, crop.width * 1e3, crop.thickness * 1e3);
}

/// Diameter of the ball of the same volume, m.
double ball_diameter(const NewCrop& crop) {
  return std::cbrt(crop.length * crop.width * crop.thickness);
}

/// "+1.2 +- 0.8 degree from the plane to space, by 4 materials of balls"
std::string to_space_text(const PlaneToSpace& to_space) {
  return fmt::format("{:+.1f} +- {:.1f} degree from 2D to 3D, by {} {}", to_space.angle_offset.mean / degree,
                     angle_error_3d(to_space) / degree, to_space.materials,
                     to_space.of_the_crop ? "runs of this crop" : "materials of balls");
}

std::string shape_text(const NewCrop& crop, const CropEstimate& estimate) {
  if (estimate.is_ball()) return fmt::format("a ball of {:.4g} mm", ball_diameter(crop) * 1e3);
  return "an elongated seed of " + sizes_text(crop);
}

}  // namespace

std::string crop_toml(const NewCrop& crop, const CropEstimate& estimate) {
  const double mm = 1e3;
  SourcedKeys keys;
  if (estimate.is_ball()) {
    const bool one_size = crop.length == crop.thickness;
    keys.add("diameter", quantity(ball_diameter(crop) * mm, "mm"),
             one_size ? measured : fmt::format("ball of the volume of {}, {}", sizes_text(crop), measured));
  } else {
    keys.add("length", quantity(crop.length * mm, "mm"), measured);
    keys.add("width", quantity(crop.width * mm, "mm"), measured);
    keys.add("thickness", quantity(crop.thickness * mm, "mm"),
             crop.thickness_assumed ? "assumed: as thick as wide" : measured);
  }
  keys.add("thousand_grain_weight", quantity(crop.mass * 1e6, "g"), measured);
  keys.add("shape", estimate.is_ball() ? "\"ball\"" : "\"elongated\"",
           estimate.is_ball() ? "assumed: a ball, less than 1.1 times as long as thick"
                              : "assumed: an ellipse seen from the side");
  if (crop.bulk_density) keys.add("bulk_density", quantity(*crop.bulk_density, "kg/m3"), measured);
  if (crop.angle_of_repose) keys.add("angle_of_repose", quantity(*crop.angle_of_repose / degree, "degree"), measured);
  if (crop.moisture) keys.add("moisture", quantity(*crop.moisture * 100, "%"), measured);
  keys.add("contact", fmt::format("\"{}-contact.toml\"", crop.name), "made by the same command");
  keys.add("true_density", quantity(estimate.seed_density, "kg/m3"),
           "computed: mass over the volume of an ellipsoid of these sizes", "reference");
  return keys.text("Made by vibrosow new-crop.", crop.name);
}

std::string contact_toml(const NewCrop& crop, const CropEstimate& estimate) {
  const std::string from = evidence(crop, estimate);
  const auto number = [](double value) { return fmt::format("{:.3g}", value); };
  const ReposeBand& band = estimate.band;
  SourcedKeys keys;
  keys.add("law", "\"elastic-shell\"", "assumed: the law of the atlas of repose");
  keys.add("shell_compression", number(estimate.shell_compression),
           "assumed: keeps a shell under 5 % of the radius at twice the speed of a tray of 9 Hz and 1 cm (0.0025 g r / "
           "V^2)");
  keys.add("friction", number(band.fitting.friction), band_source(band.friction, from, estimate.own_runs));
  keys.add("restitution", "0.5", "assumed: the atlas' value; repose does not determine it");
  keys.add("friction_model", "\"spring\"", "assumed: as the atlas");
  keys.add("rolling", "\"spring\"", "assumed: as the atlas");
  keys.add("rolling_friction", number(band.fitting.rolling_friction),
           band_source(band.rolling_friction, from, estimate.own_runs));
  keys.add("friction", number(band.fitting.friction), "assumed: as seed on seed; measure it on the tray's sheet",
           "wall");
  keys.add("restitution", "0.5", "assumed: as seed on seed", "wall");
  keys.add("rolling_friction", number(band.fitting.rolling_friction), "assumed: as seed on seed", "wall");
  const auto range = [&](const ParameterBand& of) { return fmt::format("[{}, {}]", number(of.low), number(of.high)); };
  keys.add("friction_range", range(band.friction), "95 %, as friction", "reference");
  keys.add("rolling_friction_range", range(band.rolling_friction), "95 %, as rolling friction", "reference");
  std::string comment = "Made by vibrosow new-crop.";
  for (const std::string& doubt : estimate.doubts) comment += "\n# Doubtful: " + doubt;
  return keys.text(comment, crop.name + " on itself and on a tray");
}

std::string crop_table(const NewCrop& crop, const CropEstimate& estimate, const ShippedAtlas& atlas) {
  const ReposeBand& band = estimate.band;
  const std::string packed =
      estimate.packing ? fmt::format(", poured at a packing fraction of {:.2f}", *estimate.packing) : "";
  std::string text = wrapped(fmt::format("{}: {}, {:.4g} g a thousand, {:.4g} kg/m3 in the seed{}", crop.name,
                                         shape_text(crop, estimate), crop.mass * 1e6, estimate.seed_density, packed));
  const std::string from = evidence(crop, estimate);
  text += wrapped(from.empty() ? "nothing that counts says how it rubs: the band is all of the atlas"
                               : fmt::format("how it rubs, from {}:", from));
  text += fmt::format("  {:<18} {:>6}   {:<12}   {:>11}\n", "", "taken", "95 % band", "uncertainty");
  text += band_line("friction", band.fitting.friction, band.friction) +
          band_line("rolling friction", band.fitting.rolling_friction, band.rolling_friction);
  text += wrapped(fmt::format("with what is taken it stands at {:.3g} degree", estimate.fitting_angle / degree));
  text += wrapped(undetermined(estimate));
  if (std::abs(band.correlation) > hardly_apart)
    text += wrapped(fmt::format(
        "friction and rolling friction cannot be told apart (correlation {:.2f}): more of one and less of the "
        "other gives the same heap",
        band.correlation));
  const Reachable& range = estimate.reachable;
  text += wrapped(
      fmt::format("the atlas, {} runs: its materials of this shape stand at {:.0f} to {:.0f} degree and lie "
                  "at {:.2f} to {:.2f}; {}; your angle is taken as good to {:.1f} degree",
                  atlas.atlas.runs(), range.least_angle / degree, range.most_angle / degree, range.least_packing,
                  range.most_packing, to_space_text(atlas.to_space), assumed_angle_error / degree));
  for (const std::string& doubt : estimate.doubts) text += wrapped_beside("  doubtful: ", doubt);
  return text;
}

}  // namespace vibrosow
