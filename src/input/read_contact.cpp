#include "input/read_contact.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "input/presets.hpp"
#include "input/wording.hpp"

namespace vibrosow {
namespace {

constexpr int walls = -1;  // in place of a lot, as in SurfaceOverride

/// A table that gives a surface: [contact] itself, [contact.wall], or [contact.LOT.OTHER].
struct Part {
  Table table;
  bool in_seeder;  // false: the contact model's alone
};

struct Pair {
  int lot, other;
  Part part;
};

struct Parts {
  Part general;
  std::optional<Part> wall;
  std::vector<Pair> pairs;

  std::vector<Part> all() const {
    std::vector<Part> parts{general};
    if (wall) parts.push_back(*wall);
    for (const Pair& pair : pairs) parts.push_back(pair.part);
    return parts;
  }
};

/// A lot by its name, or the walls.
int material(const Table& table, const std::string& name, const std::vector<SeedLot>& lots) {
  std::vector<std::string> names;
  for (const SeedLot& lot : lots) names.push_back(lot.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  if (name == "wall") return walls;
  names.push_back("wall");
  table.fail(name, fmt::format("a pair of materials is [contact.LOT.LOT] or [contact.LOT.wall], and \"{}\" is not one"
                               " of {}{}",
                               name, fmt::join(names, ", "), did_you_mean(name, names)));
}

void add_pair(std::vector<Pair>& pairs, int first, int second, Table& of_first, const std::string& key) {
  const bool on_wall = second == walls;
  const int lot = on_wall ? first : std::min(first, second), other = on_wall ? walls : std::max(first, second);
  for (const Pair& pair : pairs) {
    if (pair.lot == lot && pair.other == other) {
      of_first.fail(key, fmt::format("is the pair {} again; give one of them", pair.part.table.full_key("")));
    }
  }
  pairs.push_back({lot, other, {of_first.required_table(key), true}});
}

std::vector<Pair> find_pairs(Table& table, const std::vector<SeedLot>& lots) {
  std::vector<Pair> pairs;
  for (const std::string& name : table.keys()) {
    if (!table.is_table(name)) continue;
    const int first = material(table, name, lots);
    if (first == walls) continue;
    Table of_first = *table.table(name);
    for (const std::string& other : of_first.keys()) {
      add_pair(pairs, first, material(of_first, other, lots), of_first, other);
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.lot != b.lot ? a.lot < b.lot : a.other < b.other; });
  return pairs;
}

Parts find_parts(Table& table, const std::vector<SeedLot>& lots) {
  // Before Parts: where an initialiser in braces throws, g++ 12 destroys members it has not made.
  std::vector<Pair> pairs = find_pairs(table, lots);
  Parts parts{{table, true}, std::nullopt, std::move(pairs)};
  if (const auto wall = table.table("wall")) parts.wall = Part{*wall, table.has_here("wall")};
  for (const SeedLot& lot : lots) {
    if (!parts.wall || !parts.wall->table.is_table(lot.name)) continue;
    parts.wall->table.fail(lot.name, fmt::format("is written [contact.{}.wall]", lot.name));
  }
  return parts;
}

/// Whether `part` gives `key` in earnest: not when the seeder itself makes the `choice` and the model alone the key.
bool gives(const Parts& parts, const Part& part, const std::string& key, const std::string& choice) {
  const bool in_seeder = part.in_seeder && part.table.has_here(key);
  return in_seeder || (part.table.has(key) && !parts.general.table.has_here(choice));
}

/// Fails at `key` of [contact], which the value of `choice` rules out.
void refuse(const Parts& parts, const std::string& key, const std::string& choice, const std::string& message) {
  if (gives(parts, parts.general, key, choice)) parts.general.table.fail(key, message);
}

void refuse_on_walls(const Parts& parts, const std::string& key, const std::string& choice,
                     const std::string& message) {
  if (parts.wall && gives(parts, *parts.wall, key, choice)) parts.wall->table.fail(key, message);
}

std::optional<double> read_shell_compression(Table& table) {
  return table.number("shell_compression", 1e-12, 0.1);
}

std::optional<double> read_youngs_modulus(Table& table) {
  return table.quantity("youngs_modulus", Dimension::pressure, 1, 1e13);
}

std::optional<double> read_poisson_ratio(Table& table) {
  return table.number("poisson_ratio", 0, 0.5);
}

constexpr const char* hertz_only = "belongs to law = \"hertz\", and the law here is \"elastic-shell\"";
constexpr const char* shell_only = "belongs to the elastic shell, and the law here is \"hertz\"";

/// What a lot says of its own material. A crop may describe it for every law, so only the seeder's keys can be wrong.
void read_lot_material(Table seeds, bool hertz, SeedLot& lot) {
  const auto shell_compression = read_shell_compression(seeds);
  const auto youngs_modulus = read_youngs_modulus(seeds);
  const auto poisson_ratio = read_poisson_ratio(seeds);
  if (hertz) {
    if (seeds.has_here("shell_compression")) seeds.fail("shell_compression", shell_only);
    lot.youngs_modulus = youngs_modulus;
    lot.poisson_ratio = poisson_ratio;
  } else {
    for (const char* key : {"youngs_modulus", "poisson_ratio"}) {
      if (seeds.has_here(key)) seeds.fail(key, hertz_only);
    }
    lot.shell_compression = shell_compression;
  }
}

/// The law is the elastic shell.
void read_shell(Parts& parts, const std::vector<SeedLot>& lots, Contact& contact) {
  for (const char* key : {"youngs_modulus", "poisson_ratio", "damping_rate"}) refuse(parts, key, "law", hertz_only);
  for (const char* key : {"youngs_modulus", "poisson_ratio"}) refuse_on_walls(parts, key, "law", hertz_only);
  const auto shell_compression = read_shell_compression(parts.general.table);
  const bool needed = std::any_of(lots.begin(), lots.end(), [](const SeedLot& lot) { return !lot.shell_compression; });
  if (needed && !shell_compression) {
    parts.general.table.fail("shell_compression", "is missing; expected a number such as 1e-4");
  }
  contact.law = Law::elastic_shell;
  contact.shell_compression = shell_compression.value_or(contact.shell_compression);
}

/// Damping is given by a rate or by restitutions. Returns whether it is the rate.
bool read_damping_rate(Parts& parts, Contact& contact) {
  Table& table = parts.general.table;
  const auto damping_rate = table.quantity("damping_rate", Dimension::rate, 0, 1e9);
  if (!damping_rate) return false;
  for (const Part& part : parts.all()) {
    if (!gives(parts, part, "restitution", "damping_rate")) continue;
    table.fail("damping_rate", fmt::format("contradicts {}; give one of them", part.table.full_key("restitution")));
  }
  contact.damping_rate = *damping_rate;
  return true;
}

void read_wall_material(Parts& parts, Contact& contact) {
  if (!parts.wall) return;
  Table& wall = parts.wall->table;
  contact.wall_youngs_modulus = read_youngs_modulus(wall);
  const auto poisson_ratio = read_poisson_ratio(wall);
  if (poisson_ratio && !contact.wall_youngs_modulus) {
    wall.fail("poisson_ratio", "needs the walls' youngs_modulus, without which walls are rigid");
  }
  contact.wall_poisson_ratio = poisson_ratio.value_or(contact.wall_poisson_ratio);
}

void read_hertz(Parts& parts, const std::vector<SeedLot>& lots, Contact& contact) {
  Table& table = parts.general.table;
  refuse(parts, "shell_compression", "law", shell_only);
  const auto youngs_modulus = read_youngs_modulus(table);
  const bool needed = std::any_of(lots.begin(), lots.end(), [](const SeedLot& lot) { return !lot.youngs_modulus; });
  if (needed && !youngs_modulus) {
    table.fail("youngs_modulus", fmt::format("is missing; law = \"hertz\" needs it here or in every lot, {}",
                                             expected(Dimension::pressure)));
  }
  contact.law = read_damping_rate(parts, contact) ? Law::hertz_viscous : Law::hertz;
  contact.youngs_modulus = youngs_modulus.value_or(contact.youngs_modulus);
  contact.poisson_ratio = read_poisson_ratio(table).value_or(contact.poisson_ratio);
  read_wall_material(parts, contact);
}

/// Keys of the laws that are not this one are known all the same.
void know_every_law(Parts& parts) {
  for (const char* key : {"shell_compression", "youngs_modulus", "poisson_ratio", "damping_rate"}) {
    parts.general.table.skip(key);
  }
  if (!parts.wall) return;
  for (const char* key : {"youngs_modulus", "poisson_ratio"}) parts.wall->table.skip(key);
}

void read_law(Parts& parts, Table& seeds, std::vector<SeedLot>& lots, Contact& contact) {
  const bool hertz = parts.general.table.choice("law", {"elastic-shell", "hertz"}).value_or(0) == 1;
  know_every_law(parts);
  for (SeedLot& lot : lots) read_lot_material(seeds.required_table(lot.name), hertz, lot);
  if (hertz) {
    read_hertz(parts, lots, contact);
  } else {
    read_shell(parts, lots, contact);
  }
}

Surface read_surface(Table& table, const Surface& otherwise) {
  Surface surface;
  surface.friction = table.number("friction", 0, 2).value_or(otherwise.friction);
  surface.restitution = table.number("restitution", 0.05, 1).value_or(otherwise.restitution);
  surface.rolling_friction = table.number("rolling_friction", 0, 2).value_or(otherwise.rolling_friction);
  surface.twisting_friction = table.number("twisting_friction", 0, 2).value_or(otherwise.twisting_friction);
  surface.cohesion = table.quantity("cohesion", Dimension::force, 0, 1e3).value_or(otherwise.cohesion);
  return surface;
}

/// Without the values that the law's damping and the rolling model rule out: those that a model alone gives.
Surface effective(Surface surface, const Contact& contact) {
  if (contact.law == Law::hertz_viscous) surface.restitution = 1;
  if (contact.rolling == Rolling::none) surface.rolling_friction = surface.twisting_friction = 0;
  return surface;
}

void read_surfaces(Parts& parts, Contact& contact) {
  const Surface seed = read_surface(parts.general.table, {});
  const Surface wall = parts.wall ? read_surface(parts.wall->table, seed) : seed;
  contact.seed = effective(seed, contact);
  contact.wall = effective(wall, contact);
  for (Pair& pair : parts.pairs) {
    const bool on_wall = pair.other == walls;
    const Surface surface = effective(read_surface(pair.part.table, on_wall ? wall : seed), contact);
    if (surface == (on_wall ? contact.wall : contact.seed)) continue;  // no override, so no cost
    contact.overrides.push_back({pair.lot, pair.other, surface});
  }
}

/// After `rolling`, which may slip as sliding friction does.
void read_friction(Parts& parts, Contact& contact) {
  Table& table = parts.general.table;
  const bool spring = table.choice("friction_model", {"sliding", "spring"}).value_or(0) == 1;
  const auto slip_speed = table.quantity("slip_speed", Dimension::speed, 1e-6, 100);
  const auto ratio = table.number("tangential_ratio", 0.01, 10);
  const auto damping = table.number("tangential_damping", 0, 10);
  if (!spring || contact.rolling == Rolling::constant_torque) {
    contact.slip_speed = slip_speed.value_or(contact.slip_speed);
  } else {
    refuse(parts, "slip_speed", "friction_model",
           "is of friction_model = \"sliding\" and of rolling = \"constant-torque\", and neither is chosen");
  }
  if (spring) {
    contact.friction_model = FrictionModel::spring;
    contact.tangential_ratio = ratio;
    contact.tangential_damping = damping.value_or(contact.tangential_damping);
  } else {
    for (const char* key : {"tangential_ratio", "tangential_damping"}) {
      refuse(parts, key, "friction_model", "needs friction_model = \"spring\"");
    }
  }
  const auto arm = table.choice("friction_arm", {"contact-point", "rim"});
  contact.friction_arm = arm.value_or(0) == 0 ? FrictionArm::contact_point : FrictionArm::rim;
}

/// A rolling friction of zero asks for nothing, so a study may vary it from zero.
void refuse_rolling_friction(const Parts& parts) {
  for (Part& part : parts.all())
    for (const char* key : {"rolling_friction", "twisting_friction"})
      if (part.table.number(key, 0, 2).value_or(0) > 0 && gives(parts, part, key, "rolling"))
        part.table.fail(key, "needs rolling = \"constant-torque\" or \"spring\" in [contact]");
}

void check_rolling(const Parts& parts, const Contact& contact) {
  const Table& table = parts.general.table;
  if (!contact.rotation) {
    table.fail("rolling", "needs rotation; with rotation = false expected rolling = \"none\"");
  }
  const std::vector<Part> all = parts.all();
  if (std::none_of(all.begin(), all.end(), [](const Part& part) { return part.table.has("rolling_friction"); })) {
    table.fail("rolling_friction",
               "is missing; a rolling model needs it here, in [contact.wall] or for a pair of materials");
  }
}

/// After `rotation`.
void read_rolling(Parts& parts, Contact& contact) {
  Table& table = parts.general.table;
  constexpr std::array models = {Rolling::none, Rolling::constant_torque, Rolling::spring};
  contact.rolling = models.at(table.choice("rolling", {"none", "constant-torque", "spring"}).value_or(0));
  const auto damping = table.number("rolling_damping", 0, 10);
  if (contact.rolling == Rolling::none) {
    refuse_rolling_friction(parts);
  } else {
    check_rolling(parts, contact);
  }
  if (contact.rolling == Rolling::spring) {
    contact.rolling_damping = damping.value_or(contact.rolling_damping);
  } else {
    refuse(parts, "rolling_damping", "rolling", "needs rolling = \"spring\"");
  }
}

Contact read_own(Table& table, Table& seeds, std::vector<SeedLot>& lots) {
  Contact contact;
  Parts parts = find_parts(table, lots);
  read_law(parts, seeds, lots, contact);
  contact.drag = table.quantity("drag", Dimension::drag, 0, 1000).value_or(contact.drag);
  contact.rotation = table.boolean("rotation").value_or(contact.rotation);
  read_rolling(parts, contact);
  read_friction(parts, contact);
  read_surfaces(parts, contact);
  return contact;
}

// Contact models of crops.

constexpr std::string_view of_crop = "crop";

Surface surface_of(const Contact& contact, int lot, int other) {
  for (const SurfaceOverride& pair : contact.overrides)
    if (pair.lot == lot && pair.other == other) return pair.surface;
  return other == walls ? contact.wall : contact.seed;
}

Surface mean_of(const Surface& a, const Surface& b) {
  return {.friction = 0.5 * (a.friction + b.friction),
          .restitution = 0.5 * (a.restitution + b.restitution),
          .rolling_friction = 0.5 * (a.rolling_friction + b.rolling_friction),
          .cohesion = 0.5 * (a.cohesion + b.cohesion),
          .twisting_friction = 0.5 * (a.twisting_friction + b.twisting_friction)};
}

/// [contact] over the model of one lot's crop.
Contact read_over(Table& table, const PresetFile& model, Table& seeds, std::vector<SeedLot>& lots) {
  table.set_fallback(read_preset(model, table, "model"));
  table.skip("model");
  return read_own(table, seeds, lots);
}

void require_one_law(const Table& table, const Contact& first, const Contact& other, const SeedLot& lot) {
  if (other.law == first.law && other.friction_model == first.friction_model && other.rolling == first.rolling) return;
  table.fail("model", fmt::format("the crops' contact models are of several laws, friction models or rolling models "
                                  "({} is of another than the first); choose one in [contact]",
                                  lot.contact.name));
}

/// What all contacts of a scene share cannot be one lot's alone.
void require_shared_values(const Table& table, const Contact& first, const Contact& other, const SeedLot& lot) {
  struct Shared {
    const char* key;
    bool is_same;
  };
  const bool slips = first.friction_model == FrictionModel::sliding || first.rolling == Rolling::constant_torque;
  const Shared values[] = {{"damping_rate", other.damping_rate == first.damping_rate},
                           {"wall.youngs_modulus", other.wall_youngs_modulus == first.wall_youngs_modulus},
                           {"wall.poisson_ratio", other.wall_poisson_ratio == first.wall_poisson_ratio},
                           {"tangential_ratio", other.tangential_ratio == first.tangential_ratio},
                           {"tangential_damping", other.tangential_damping == first.tangential_damping},
                           {"rolling_damping", other.rolling_damping == first.rolling_damping},
                           {"slip_speed", !slips || other.slip_speed == first.slip_speed},
                           {"drag", other.drag == first.drag},
                           {"rotation", other.rotation == first.rotation},
                           {"friction_arm", other.friction_arm == first.friction_arm}};
  for (const auto& [key, is_same] : values)
    if (!is_same)
      table.fail(key, fmt::format("is shared by all seeds, and the crops' contact models differ in it ({} from the "
                                  "first); give it in [contact]",
                                  lot.contact.name));
}

/// The general surfaces are of the first lot; those of the others, and between any two, are overrides. What is written
/// of two lots lies over the mean of their models.
void join_surfaces(const std::vector<Contact>& own, std::vector<Pair> written, Contact& contact) {
  const auto between = [&](int lot, int other) {
    const Surface mean = mean_of(own[static_cast<std::size_t>(lot)].seed, own[static_cast<std::size_t>(other)].seed);
    const auto pair =
        std::ranges::find_if(written, [&](const Pair& one) { return one.lot == lot && one.other == other; });
    return pair == written.end() ? mean : effective(read_surface(pair->part.table, mean), contact);
  };
  const auto add = [&](int lot, int other, const Surface& surface) {
    if (surface != (other == walls ? contact.wall : contact.seed)) contact.overrides.push_back({lot, other, surface});
  };
  contact.overrides.clear();
  for (int lot = 0; lot < static_cast<int>(own.size()); ++lot) {
    const Contact& of_lot = own[static_cast<std::size_t>(lot)];
    add(lot, walls, surface_of(of_lot, lot, walls));
    add(lot, lot, surface_of(of_lot, lot, lot));
    for (int other = lot + 1; other < static_cast<int>(own.size()); ++other) add(lot, other, between(lot, other));
  }
}

void give_lots_their_materials(const std::vector<Contact>& own, std::vector<SeedLot>& lots) {
  for (std::size_t i = 1; i < lots.size(); ++i) {
    if (own[i].law == Law::elastic_shell) {
      if (!lots[i].shell_compression && own[i].shell_compression != own[0].shell_compression)
        lots[i].shell_compression = own[i].shell_compression;
    } else {
      if (!lots[i].youngs_modulus && own[i].youngs_modulus != own[0].youngs_modulus)
        lots[i].youngs_modulus = own[i].youngs_modulus;
      if (!lots[i].poisson_ratio && own[i].poisson_ratio != own[0].poisson_ratio)
        lots[i].poisson_ratio = own[i].poisson_ratio;
    }
  }
}

Contact read_contacts_of_crops(Table& table, Table& seeds, std::vector<SeedLot>& lots) {
  for (const SeedLot& lot : lots) {
    if (lot.contact.is_known()) continue;
    table.fail("model",
               fmt::format("is \"{}\", and seeds.{} {}; give a contact model, or seeds.{}.contact", of_crop, lot.name,
                           lot.crop.is_known() ? "has a crop that names none" : "has no crop", lot.name));
  }
  std::vector<Contact> own{read_over(table, lots.front().contact, seeds, lots)};
  for (std::size_t i = 1; i < lots.size(); ++i) {
    Table anew = table.anew();
    own.push_back(read_over(anew, lots[i].contact, seeds, lots));
    anew.reject_unknown_keys();
    require_one_law(table, own.front(), own.back(), lots[i]);
    require_shared_values(table, own.front(), own.back(), lots[i]);
  }
  Contact contact = own.front();
  contact.model.of_crops = true;
  join_surfaces(own, find_pairs(table, lots), contact);
  give_lots_their_materials(own, lots);
  return contact;
}

/// Whether [contact] stands alone: it names a law, or has both stiffness and friction. Else its keys, such as one that
/// --set or a study gives, lie over the crops' models.
bool is_whole(const Table& table, Table& seeds, const std::vector<SeedLot>& lots) {
  const auto is_stiff = [](const Table& one) {
    return one.has_here("shell_compression") || one.has_here("youngs_modulus");
  };
  const bool lots_are_stiff =
      std::ranges::all_of(lots, [&](const SeedLot& lot) { return is_stiff(seeds.required_table(lot.name)); });
  return table.has_here("law") || (table.has_here("friction") && (is_stiff(table) || lots_are_stiff));
}

}  // namespace

bool crops_have_contacts(const std::vector<SeedLot>& lots) {
  return std::ranges::all_of(lots, [](const SeedLot& lot) { return lot.contact.is_known(); });
}

Contact read_contact(Table table, Table seeds, std::vector<SeedLot>& lots) {
  const bool crops_tell = !table.has_here("model") && crops_have_contacts(lots) && !is_whole(table, seeds, lots);
  if (crops_tell || table.text("model") == of_crop) return read_contacts_of_crops(table, seeds, lots);
  const PresetFile model = use_preset(table, "model", "contacts");
  Contact contact = read_own(table, seeds, lots);
  contact.model = {model};
  return contact;
}

}  // namespace vibrosow
