#include "scene/read_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/document.hpp"
#include "scene/presets.hpp"
#include "scene/read_vessel.hpp"

namespace vibrosow {
namespace {

double read_mass(Table& seeds, const SeedLot& lot) {
  if (seeds.has_here("mass") && seeds.has_here("density")) seeds.fail("density", "contradicts mass; give one of them");
  const std::optional<double> mass = seeds.quantity("mass", Dimension::mass, 1e-12, 1e3);
  const std::optional<double> density = seeds.quantity("density", Dimension::density, 1, 3e4);
  const bool by_density = seeds.has_here("density") || (density && !mass);
  if (!by_density) {
    if (!mass) seeds.fail("mass", "is missing; give a seed's mass, or its density");
    if (density && !seeds.has_here("mass")) seeds.fail("density", "contradicts mass; give one of them");
    return *mass;
  }
  if (lot.shape != Shape::ball) seeds.fail("density", "gives the mass of a ball only; give mass for a disc");
  return std::numbers::pi / 6 * std::pow(lot.diameter, 3) * *density;
}

SeedLot read_lot(Table& seeds, const std::string& name) {
  use_preset(seeds, "crop", "crops");
  SeedLot lot;
  lot.name = name;
  lot.diameter = seeds.required_quantity("diameter", Dimension::length, 5e-5, 1);
  lot.shape = seeds.choice("shape", {"disc", "ball"}).value_or(1) == 0 ? Shape::disc : Shape::ball;
  lot.mass = read_mass(seeds, lot);
  return lot;
}

/// Shares of all lots by number, from shares by mass or by number.
void read_shares(Table& seeds, std::vector<SeedLot>& lots) {
  std::string key;
  double sum = 0;
  for (SeedLot& lot : lots) {
    Table table = seeds.required_table(lot.name);
    const auto by_mass = table.quantity("mass_share", Dimension::fraction, 1e-9, 1);
    const auto by_number = table.quantity("number_share", Dimension::fraction, 1e-9, 1);
    if (by_mass && by_number) table.fail("number_share", "contradicts mass_share; give one of them");
    const std::string given = by_mass ? "mass_share" : by_number ? "number_share" : "";
    if (given.empty() && lots.size() == 1) return;
    if (key.empty()) key = given.empty() ? "mass_share" : given;
    if (given.empty()) table.fail(key, "is missing; with several lots each has mass_share, or each has number_share");
    if (given != key) table.fail(given, fmt::format("another lot has {}; give every lot the same", key));
    lot.number_share = by_mass ? *by_mass : *by_number;
    sum += lot.number_share;
  }
  if (std::abs(sum - 1) > 1e-6) {
    seeds.required_table(lots.back().name)
        .fail(key, fmt::format("the shares of all lots sum to {:g} %, not to 100 %", sum * 100));
  }
  if (key == "mass_share") {
    for (SeedLot& lot : lots) lot.number_share /= lot.mass;
  }
  double total = 0;
  for (const SeedLot& lot : lots) total += lot.number_share;
  for (SeedLot& lot : lots) lot.number_share /= total;
}

/// Lot names stand in CSV files and beside the words "all" and "wall".
void check_lot_name(const Table& seeds, const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (!plain || name.empty() || name == "all" || name == "wall") {
    seeds.fail(name, "a lot's name has letters, digits, _ and - only, and is not \"all\" or \"wall\"");
  }
}

std::vector<SeedLot> read_lots(Table seeds) {
  std::vector<SeedLot> lots;
  for (const std::string& name : seeds.keys()) {
    check_lot_name(seeds, name);
    Table table = seeds.required_table(name);
    lots.push_back(read_lot(table, name));
  }
  if (lots.empty()) seeds.fail("", "names no seed lot; expected a table such as [seeds.wheat]");
  read_shares(seeds, lots);
  return lots;
}

Contact read_contact(Table table) {
  use_preset(table, "model", "contacts");
  Contact contact;
  if (table.choice("law", {"elastic-shell", "hertz"}).value_or(0) != 0) {
    table.fail("law", "\"hertz\" is not built yet; expected \"elastic-shell\"");
  }
  const auto shell_compression = table.number("shell_compression", 1e-12, 0.1);
  if (!shell_compression) table.fail("shell_compression", "is missing; expected a number such as 1e-4");
  contact.shell_compression = *shell_compression;
  contact.seed.friction = table.number("friction", 0, 2).value_or(contact.seed.friction);
  contact.seed.restitution = table.number("restitution", 0.05, 1).value_or(contact.seed.restitution);
  contact.wall = contact.seed;
  if (auto wall = table.table("wall")) {
    contact.wall.friction = wall->number("friction", 0, 2).value_or(contact.seed.friction);
    contact.wall.restitution = wall->number("restitution", 0.05, 1).value_or(contact.seed.restitution);
  }
  contact.slip_speed = table.quantity("slip_speed", Dimension::speed, 1e-6, 100).value_or(contact.slip_speed);
  contact.drag = table.quantity("drag", Dimension::mass_rate, 0, 1000).value_or(contact.drag);
  contact.rotation = table.boolean("rotation").value_or(contact.rotation);
  const auto arm = table.choice("friction_arm", {"contact-point", "rim"});
  contact.friction_arm = arm.value_or(0) == 0 ? FrictionArm::contact_point : FrictionArm::rim;
  return contact;
}

Numerics read_numerics(Table table) {
  Numerics numerics;
  const auto integrator = table.choice("integrator", {"velocity-verlet", "rk2-midpoint"});
  numerics.integrator = integrator.value_or(0) == 0 ? Integrator::velocity_verlet : Integrator::rk2_midpoint;
  numerics.dt = table.quantity("dt", Dimension::time, 1e-12, 10);
  if (numerics.dt) numerics.where = table.where("dt");
  const auto steps = table.number("steps_per_contact", 1, 1e6);
  if (numerics.dt && steps) table.fail("steps_per_contact", "contradicts dt; give one of them");
  numerics.steps_per_contact = steps.value_or(numerics.steps_per_contact);
  numerics.allow_long_step = table.boolean("allow_long_step").value_or(numerics.allow_long_step);
  return numerics;
}

GuardLimits read_guard(Table table) {
  GuardLimits guard;
  guard.warn_compression = table.number("warn_compression", 1e-9, 1000).value_or(guard.warn_compression);
  guard.stop_compression = table.number("stop_compression", 1e-9, 1000).value_or(guard.stop_compression);
  guard.energy_tolerance = table.number("energy_tolerance", 1e-9, 1e12).value_or(guard.energy_tolerance);
  if (guard.stop_compression < guard.warn_compression) {
    table.fail(table.has("stop_compression") ? "stop_compression" : "warn_compression",
               fmt::format("the guard would stop at {:g}, before it warns at {:g}", guard.stop_compression,
                           guard.warn_compression));
  }
  return guard;
}

RunPlan read_run(Table table) {
  RunPlan run;
  run.duration = table.required_quantity("duration", Dimension::time, 1e-9, 1e6);
  run.measure_from = table.quantity("measure_from", Dimension::time, 0, 1e6).value_or(0);
  if (run.measure_from >= run.duration) {
    table.fail("measure_from",
               fmt::format("{:g} s is not before the end of the run, {:g} s", run.measure_from, run.duration));
  }
  run.count_below = table.quantity("count_below", Dimension::length, 1e-6, 100).value_or(run.count_below);
  run.start = table.choice("start", {"at-rest", "with-tray"}).value_or(0) == 0 ? Start::at_rest : Start::with_tray;
  return run;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  Table root(Document::read(file, overrides));
  root.reject_keys_other_than({"title", "seeds", "contact", "tray", "hopper", "numerics", "guard", "run"});
  Scene scene;
  scene.title = root.text("title").value_or(file.stem().string());
  scene.lots = read_lots(root.required_table("seeds"));
  scene.contact = read_contact(root.required_table("contact"));
  Table tray = root.required_table("tray");
  scene.tray = read_vessel(tray, "tray", scene.lots);
  if (auto hopper = root.table("hopper")) {
    scene.hopper = read_vessel(*hopper, "hopper", scene.lots);
    scene.hopper->origin.x() = hopper->required_quantity("left", Dimension::length, -100, 100);
    if (scene.tray.sides == Sides::periodic &&
        !(scene.hopper->origin.x() >= 0 &&
          scene.hopper->origin.x() + scene.hopper->length <= scene.tray.length * (1 + 1e-9)))
      hopper->fail("left", "the hopper does not lie within the length of the periodic tray");
    scene.hopper->origin.y() = hopper->required_quantity("above", Dimension::length, 0, 100);
  }
  const auto gives_seeds = [](const Vessel& vessel) { return vessel.fill || vessel.rain; };
  if (!gives_seeds(scene.tray) && !(scene.hopper && gives_seeds(*scene.hopper))) {
    tray.fail("fill", "is missing, no hopper has one, and no rain falls: there is nothing to sow");
  }
  if (auto numerics = root.table("numerics")) scene.numerics = read_numerics(*numerics);
  if (auto guard = root.table("guard")) scene.guard = read_guard(*guard);
  scene.run = read_run(root.required_table("run"));
  root.reject_unknown_keys();
  return scene;
}

}  // namespace vibrosow
