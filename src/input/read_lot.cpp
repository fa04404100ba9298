#include "input/read_lot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "input/presets.hpp"
#include "portable_math/functions.hpp"
#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "scene/list_limits.hpp"
#include "scene/make_clump.hpp"
#include "scene/seed_lot.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr double smallest = 5e-5, largest = 1;  // m, of any measure of a seed

/// The keys that a choice does not take. Here they are an error; a preset's are passed over, since a choice written
/// here wins over it.
void refuse_keys(Table& table, const std::string& choice, const std::vector<std::string>& keys,
                 const std::string& message) {
  for (const std::string& key : keys) {
    table.skip(key);
    if (table.has_here(key) || (table.has(key) && !table.has_here(choice))) table.fail(key, message);
  }
}

double read_length(const Table& table, const std::string& key) {
  return Table(table).required_quantity(key, Dimension::length, smallest, largest);
}

// Shapes.

enum class ShapeName { disc, ball, elongated, drop, dipole, discs };
const std::vector<std::string> shape_names = {"disc", "ball", "elongated", "drop", "dipole", "discs"};

/// The measure that tells a seed's size, which the others go with.
std::string size_key(ShapeName shape) {
  return shape == ShapeName::elongated || shape == ShapeName::drop ? "length" : "diameter";
}

std::vector<std::string> keys_of_other_shapes(ShapeName shape) {
  switch (shape) {
    case ShapeName::elongated:
    case ShapeName::drop:
      return {"diameter", "distance", "discs"};
    case ShapeName::dipole:
      return {"length", "width", "thickness", "discs"};
    case ShapeName::discs:
      return {"diameter", "length", "width", "thickness", "distance", "sizes"};
    default:
      return {"length", "width", "thickness", "distance", "discs"};
  }
}

double read_width(const Table& seeds, double length) {
  const double width = read_length(seeds, "width");
  if (width >= length) {
    seeds.fail("width", fmt::format("{:g} mm is not less than the length, {:g} mm; for a round seed shape = \"ball\"",
                                    width * 1e3, length * 1e3));
  }
  return width;
}

[[noreturn]] void fail_slender(const Table& seeds, ShapeName shape, const char* key, double across, double length) {
  seeds.fail(key, fmt::format("{:g} mm is too slender for {} discs at a length of {:g} mm; the length may be up "
                              "to {} {}, or give shape = \"discs\"",
                              across * 1e3, most_row_discs, length * 1e3, shape == ShapeName::elongated ? "5" : "3.9",
                              std::string_view(key) == "width" ? "widths" : "times that"));
}

std::vector<ClumpDisc> read_row(const Table& seeds, ShapeName shape, double length) {
  const double width = read_width(seeds, length);
  std::vector<ClumpDisc> discs = shape == ShapeName::elongated ? elongated(length, width) : drop(length, width);
  if (discs.empty()) fail_slender(seeds, shape, "width", width, length);
  return discs;
}

/// The width where it is not given; in 2D it makes no seed, and is to be right all the same.
double read_thickness(Table& seeds, double width) {
  const double thickness = seeds.quantity("thickness", Dimension::length, smallest, largest).value_or(width);
  if (thickness > width)
    seeds.fail("thickness", fmt::format("{:g} mm is more than the width, {:g} mm", thickness * 1e3, width * 1e3));
  return thickness;
}

/// In 3D.
std::vector<ClumpDisc> read_solid_row(Table& seeds, ShapeName shape, double length) {
  const double width = read_width(seeds, length);
  const double thickness = read_thickness(seeds, width);
  if (thickness < thinnest * width) {
    seeds.fail(
        "thickness",
        fmt::format("{:g} mm is too thin for {} balls side by side, {:g} mm wide; it may be down to {:g} widths, "
                    "or give shape = \"discs\"",
                    thickness * 1e3, most_balls_across, width * 1e3, thinnest));
  }
  std::vector<ClumpDisc> balls =
      shape == ShapeName::elongated ? elongated_solid(length, width, thickness) : drop_solid(length, width, thickness);
  if (balls.empty()) fail_slender(seeds, shape, seeds.has("thickness") ? "thickness" : "width", thickness, length);
  return balls;
}

/// What touched both balls would be held as stiffly as by two, and the step is planned for those that stand out.
void refuse_hidden_balls(const Table& seeds, const std::vector<ClumpDisc>& balls) {
  constexpr double slack = 1e-9;  // of the outer radius
  for (std::size_t inner = 0; inner < balls.size(); ++inner)
    for (std::size_t outer = 0; outer < balls.size(); ++outer) {
      const ClumpDisc &a = balls[inner], &b = balls[outer];
      const double apart = std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
      const bool first_of_equals = a.radius == b.radius && inner < outer;  // the second is named
      if (inner == outer || first_of_equals || apart + a.radius > b.radius * (1 + slack)) continue;
      seeds.fail("discs", fmt::format("ball {} lies within ball {}, where it adds nothing to the shape; leave it out",
                                      inner + 1, outer + 1));
    }
}

std::vector<ClumpDisc> read_discs(Table& seeds, Space space) {
  std::vector<ClumpDisc> discs;
  std::vector<Table> tables = seeds.tables("discs");
  seeds.refuse_more("discs", tables.size(), list_limits::clump_balls);
  for (Table& disc : tables) {
    const double x = disc.required_quantity("x", Dimension::length, -largest, largest);
    const double y = disc.required_quantity("y", Dimension::length, -largest, largest);
    double z = 0;
    if (space == Space::two_dimensional)
      disc.skip("z");
    else
      z = disc.quantity("z", Dimension::length, -largest, largest).value_or(0);
    discs.push_back({x, y, 0.5 * read_length(disc, "diameter"), z});
  }
  if (discs.empty()) {
    seeds.fail("discs", "is missing; expected a list such as [{ x = \"0 mm\", y = \"0 mm\", diameter = \"3 mm\" }]");
  }
  if (space == Space::three_dimensional) refuse_hidden_balls(seeds, discs);
  return discs;
}

/// `size` (m) is the measure under `size_key`.
void read_shape(Table& seeds, ShapeName shape, double size, Space space, SeedLot& lot) {
  lot.diameter = size;
  if (shape == ShapeName::disc && space != Space::two_dimensional)
    seeds.fail("shape", "is for 2D; with space = \"3d\" it is a \"ball\"");
  if (shape == ShapeName::elongated || shape == ShapeName::drop) {
    if (space == Space::two_dimensional) read_thickness(seeds, read_width(seeds, size));
    make_clump(lot, space == Space::two_dimensional ? read_row(seeds, shape, size) : read_solid_row(seeds, shape, size),
               space);
  }
  if (shape == ShapeName::dipole) make_clump(lot, dipole(size, read_length(seeds, "distance")), space);
  if (shape == ShapeName::discs) make_clump(lot, read_discs(seeds, space), space);
}

// Sizes.

using Kind = SizeDistribution::Kind;

/// Fractions by mass as fractions by number: a seed's mass goes with the power of its size (`mass_power`).
void count_what_was_weighed(SizeDistribution& sizes, int power) {
  const double unit = sizes.diameter.front();
  double sum = 0;
  for (std::size_t k = 0; k < sizes.fraction.size(); ++k)
    sum += sizes.fraction[k] /= portable_math::pow(sizes.diameter[k] / unit, power);
  for (double& fraction : sizes.fraction) fraction /= sum;
}

void read_table_of_sizes(Table& table, const std::string& list_key, int power, SizeDistribution& sizes) {
  sizes.diameter = table.quantities(list_key, Dimension::length, smallest, largest);
  table.refuse_more(list_key, sizes.diameter.size(), list_limits::sizes);
  const auto by_number = table.quantities("fractions", Dimension::fraction, 1e-9, 1);
  const auto by_mass = table.quantities("mass_fractions", Dimension::fraction, 1e-9, 1);
  if (!by_number.empty() && !by_mass.empty()) table.fail("mass_fractions", "contradicts fractions; give one of them");
  const std::string key = by_mass.empty() ? "fractions" : "mass_fractions";
  sizes.fraction = by_mass.empty() ? by_number : by_mass;
  if (sizes.diameter.empty()) table.fail(list_key, "is missing; expected a list such as [\"3 mm\", \"4 mm\"]");
  if (sizes.fraction.size() != sizes.diameter.size()) {
    table.fail(key, fmt::format("lists {} fractions, by {}, for {} {}", sizes.fraction.size(),
                                by_mass.empty() ? "number" : "mass", sizes.diameter.size(), list_key));
  }
  double sum = 0, mean = 0;
  for (const double fraction : sizes.fraction) sum += fraction;
  if (std::abs(sum - 1) > 1e-6) table.fail(key, fmt::format("sum to {:g} %, not to 100 %", sum * 100));
  for (double& fraction : sizes.fraction) fraction /= sum;
  if (!by_mass.empty()) count_what_was_weighed(sizes, power);
  for (std::size_t k = 0; k < sizes.fraction.size(); ++k) mean += sizes.fraction[k] * sizes.diameter[k];
  sizes.mean = mean;
}

/// `least` and `most`, by default three deviations from the mean.
void read_cut(Table& table, SizeDistribution& sizes) {
  const auto least = table.quantity("least", Dimension::length, smallest, largest);
  const auto most = table.quantity("most", Dimension::length, smallest, largest);
  if (!least && sizes.mean - 3 * sizes.deviation < 0.1 * sizes.mean) {
    table.fail("least",
               fmt::format("is missing; three deviations below the mean would be {:g} mm, too small for a seed",
                           (sizes.mean - 3 * sizes.deviation) * 1e3));
  }
  sizes.least = least.value_or(sizes.mean - 3 * sizes.deviation);
  sizes.most = most.value_or(sizes.mean + 3 * sizes.deviation);
  if (sizes.least >= sizes.mean) table.fail("least", fmt::format("is not below the mean, {:g} mm", sizes.mean * 1e3));
  if (sizes.most <= sizes.mean) table.fail("most", fmt::format("is not above the mean, {:g} mm", sizes.mean * 1e3));
}

/// The distribution of the measure `key`, whose mean is that key's where the distribution does not tell it. A seed's
/// mass goes with the `power` of its size.
SizeDistribution read_sizes(Table& seeds, const std::string& key, int power) {
  SizeDistribution sizes;
  auto table = seeds.table("sizes");
  if (!table) {
    sizes.mean = read_length(seeds, key);
    return sizes;
  }
  const std::string list_key = key + "s";
  const auto kind = table->choice("distribution", {"uniform", "normal", "lognormal", "table"});
  if (!kind) table->fail("distribution", "is missing; expected \"uniform\", \"normal\", \"lognormal\" or \"table\"");
  constexpr Kind kinds[] = {Kind::uniform, Kind::normal, Kind::lognormal, Kind::table};
  sizes.kind = kinds[*kind];
  if (sizes.kind == Kind::normal || sizes.kind == Kind::lognormal) {
    refuse_keys(*table, "distribution", {list_key, "fractions", "mass_fractions"},
                "goes with distribution = \"table\"");
    sizes.mean = read_length(seeds, key);
    sizes.deviation = table->required_quantity("deviation", Dimension::length, 1e-6 * sizes.mean, sizes.mean);
    read_cut(*table, sizes);
    return sizes;
  }
  refuse_keys(seeds, "sizes", {key}, "contradicts sizes, whose mean it is; give a normal or lognormal distribution");
  if (sizes.kind == Kind::table) {
    refuse_keys(*table, "distribution", {"deviation", "least", "most"}, "does not go with distribution = \"table\"");
    read_table_of_sizes(*table, list_key, power, sizes);
    return sizes;
  }
  refuse_keys(*table, "distribution", {"deviation", list_key, "fractions", "mass_fractions"},
              "does not go with distribution = \"uniform\", which has least and most");
  sizes.least = read_length(*table, "least");
  sizes.most = read_length(*table, "most");
  if (sizes.most <= sizes.least) table->fail("most", "is not above least");
  sizes.mean = 0.5 * (sizes.least + sizes.most);
  return sizes;
}

// Mass.

/// Tell a seed's mass; one of them does.
const std::vector<std::string> mass_keys = {"mass", "thousand_grain_weight", "density"};

/// The key that tells the mass: the one written here, else the preset's.
std::string mass_key(const Table& seeds) {
  for (const bool here : {true, false}) {
    std::vector<std::string> written;
    for (const std::string& key : mass_keys)
      if (here ? seeds.has_here(key) : seeds.has(key)) written.push_back(key);
    if (written.size() > 1) seeds.fail(written[1], fmt::format("contradicts {}; give one of them", written[0]));
    if (!written.empty()) return written[0];
  }
  seeds.fail("mass", "is missing; give a seed's mass, or its density, or its thousand_grain_weight");
}

double read_mass(Table& seeds, const SeedLot& lot) {
  for (const std::string& key : mass_keys) seeds.skip(key);
  for (const char* key : {"tkw", "tgw", "TKW", "TGW"})
    if (seeds.has(key)) seeds.fail(key, "is written thousand_grain_weight");
  const std::string key = mass_key(seeds);
  if (key == "mass") return seeds.required_quantity(key, Dimension::seed_mass, 1e-12, 1e3);
  if (key == "thousand_grain_weight") return read_thousand_grain_weight(seeds) / size_moment(lot, mass_power(lot));
  const double density = seeds.required_quantity(key, Dimension::density, 1, 3e4);
  if (lot.shape == Shape::disc) seeds.fail("density", "gives no mass to a disc, which has no thickness; give mass");
  if (lot.shape == Shape::clump) return clump_volume(lot) * density;
  return std::numbers::pi / 6 * portable_math::pow(lot.diameter, 3) * density;
}

/// Catalogues state the mass of a thousand seeds.
void reject_thousand_grain_mass(const Table& seeds, const SeedLot& lot) {
  if (mass_key(seeds) != "mass") return;
  const std::optional<double> density = seed_density(lot);
  if (!density || *density < 200e3 || *density > 3000e3) return;
  seeds.fail("mass",
             fmt::format("{:.3g} g in a seed this small is a density of {:.3g} kg/m3; it looks like the mass of "
                         "a thousand seeds: give thousand_grain_weight = \"{:.3g} g\"",
                         lot.mass * 1e3, *density, lot.mass * 1e3));
}

/// Whether mass or size are written over a crop's.
bool has_own_density(const Table& seeds) {
  const auto is_here = [&](const std::string& key) { return seeds.has_here(key); };
  const std::vector<std::string> size_keys = {"shape",     "diameter", "length", "width",
                                              "thickness", "distance", "discs",  "sizes"};
  return std::ranges::any_of(mass_keys, is_here) || std::ranges::any_of(size_keys, is_here);
}

/// kg/m3; none where the crop alone tells no seed, nor of one that names a crop, which may be itself.
std::optional<double> density_of_crop(const PresetFile& crop, const Table& seeds, Space space) {
  try {
    Table alone = read_preset(crop, seeds, "crop");
    if (alone.has("crop")) return std::nullopt;
    return seed_density(read_lot(alone, crop.name, space));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

double read_thousand_grain_weight(Table& seeds) {
  const double grams = seeds.required_quantity("thousand_grain_weight", Dimension::seed_mass, 1e-6, 1e3) * 1e3;
  return grams / 1e6;  // the same number as that many milligrams
}

BulkProperties read_bulk_properties(Table& seeds) {
  return {seeds.quantity("bulk_density", Dimension::bulk_density, 1, 3e4),
          seeds.quantity("angle_of_repose", Dimension::angle, 1 * degree, 89 * degree),
          seeds.quantity("moisture", Dimension::fraction, 0, 1)};
}

SeedLot read_lot(Table& seeds, const std::string& name, Space space) {
  SeedLot lot;
  lot.name = name;
  lot.crop = {use_preset(seeds, "crop", "crops")};
  lot.contact = named_preset(seeds, "contact", "contacts");
  const auto chosen = seeds.choice("shape", shape_names);
  const ShapeName shape = chosen ? static_cast<ShapeName>(*chosen) : ShapeName::ball;
  refuse_keys(seeds, "shape", keys_of_other_shapes(shape),
              fmt::format("does not go with shape = \"{}\"", shape_names[static_cast<std::size_t>(shape)]));
  lot.shape = shape == ShapeName::disc ? Shape::disc : Shape::ball;
  if (shape != ShapeName::discs) lot.sizes = read_sizes(seeds, size_key(shape), mass_power(lot));
  read_shape(seeds, shape, lot.sizes.mean, space, lot);
  if (lot.shape == Shape::clump && lot.sizes.kind != Kind::single) scale(lot.sizes, lot.diameter / lot.sizes.mean);
  if (lot.sizes.kind == Kind::single) lot.sizes = {};
  if (lot.sizes.kind == Kind::uniform || lot.sizes.kind == Kind::table) lot.sizes.mean = 0;  // told by the others
  lot.mass = read_mass(seeds, lot);
  reject_thousand_grain_mass(seeds, lot);
  read_bulk_properties(seeds);  // they are known and in range, and change no scene
  if (lot.crop.is_known() && has_own_density(seeds)) lot.crop.seed_density = density_of_crop(lot.crop, seeds, space);
  return lot;
}

}  // namespace vibrosow
