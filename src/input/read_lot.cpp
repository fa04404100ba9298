#include "input/read_lot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary/functions.hpp"
#include "input/presets.hpp"
#include "scene/clump_shape.hpp"
#include "scene/seed_lot.hpp"

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
      return {"length", "width", "discs"};
    case ShapeName::discs:
      return {"diameter", "length", "width", "distance", "sizes"};
    default:
      return {"length", "width", "distance", "discs"};
  }
}

std::vector<ClumpDisc> read_row(const Table& seeds, ShapeName shape, double length) {
  const double width = read_length(seeds, "width");
  if (width >= length) {
    seeds.fail("width", fmt::format("{:g} mm is not less than the length, {:g} mm; for a round seed shape = \"ball\"",
                                    width * 1e3, length * 1e3));
  }
  const std::vector<ClumpDisc> discs = shape == ShapeName::elongated ? elongated(length, width) : drop(length, width);
  if (discs.empty()) {
    seeds.fail("width",
               fmt::format("{:g} mm is too slender for {} discs at a length of {:g} mm; the length may be up "
                           "to {} widths, or give shape = \"discs\"",
                           width * 1e3, most_row_discs, length * 1e3, shape == ShapeName::elongated ? "5" : "3.9"));
  }
  return discs;
}

std::vector<ClumpDisc> read_discs(Table& seeds) {
  std::vector<ClumpDisc> discs;
  for (Table& disc : seeds.tables("discs")) {
    const double x = disc.required_quantity("x", Dimension::length, -largest, largest);
    const double y = disc.required_quantity("y", Dimension::length, -largest, largest);
    discs.push_back({x, y, 0.5 * read_length(disc, "diameter")});
  }
  if (discs.empty()) {
    seeds.fail("discs", "is missing; expected a list such as [{ x = \"0 mm\", y = \"0 mm\", diameter = \"3 mm\" }]");
  }
  return discs;
}

void make_clump(SeedLot& lot, const std::vector<ClumpDisc>& discs) {
  lot.shape = Shape::clump;
  lot.discs = about_centre_of_mass(discs);
  lot.gyration2 = plate_of(lot.discs).gyration2;
  lot.diameter = 2 * holding_radius(lot.discs);
}

/// `size` (m) is the measure under `size_key`.
void read_shape(Table& seeds, ShapeName shape, double size, SeedLot& lot) {
  lot.diameter = size;
  lot.shape = shape == ShapeName::disc ? Shape::disc : Shape::ball;
  if (shape == ShapeName::elongated || shape == ShapeName::drop) make_clump(lot, read_row(seeds, shape, size));
  if (shape == ShapeName::dipole) make_clump(lot, dipole(size, read_length(seeds, "distance")));
  if (shape == ShapeName::discs) make_clump(lot, read_discs(seeds));
}

// Sizes.

using Kind = SizeDistribution::Kind;

void read_table_of_sizes(Table& table, const std::string& list_key, SizeDistribution& sizes) {
  sizes.diameter = table.quantities(list_key, Dimension::length, smallest, largest);
  sizes.fraction = table.quantities("fractions", Dimension::fraction, 1e-9, 1);
  if (sizes.diameter.empty()) table.fail(list_key, "is missing; expected a list such as [\"3 mm\", \"4 mm\"]");
  if (sizes.fraction.size() != sizes.diameter.size()) {
    table.fail("fractions", fmt::format("lists {} fractions, by number, for {} {}", sizes.fraction.size(),
                                        sizes.diameter.size(), list_key));
  }
  double sum = 0, mean = 0;
  for (const double fraction : sizes.fraction) sum += fraction;
  if (std::abs(sum - 1) > 1e-6) table.fail("fractions", fmt::format("sum to {:g} %, not to 100 %", sum * 100));
  for (double& fraction : sizes.fraction) fraction /= sum;
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

/// The distribution of the measure `key`, whose mean is that key's where the distribution does not tell it.
SizeDistribution read_sizes(Table& seeds, const std::string& key) {
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
    refuse_keys(*table, "distribution", {list_key, "fractions"}, "goes with distribution = \"table\"");
    sizes.mean = read_length(seeds, key);
    sizes.deviation = table->required_quantity("deviation", Dimension::length, 1e-6 * sizes.mean, sizes.mean);
    read_cut(*table, sizes);
    return sizes;
  }
  refuse_keys(seeds, "sizes", {key}, "contradicts sizes, whose mean it is; give a normal or lognormal distribution");
  if (sizes.kind == Kind::table) {
    refuse_keys(*table, "distribution", {"deviation", "least", "most"}, "does not go with distribution = \"table\"");
    read_table_of_sizes(*table, list_key, sizes);
    return sizes;
  }
  refuse_keys(*table, "distribution", {"deviation", list_key, "fractions"},
              "does not go with distribution = \"uniform\", which has least and most");
  sizes.least = read_length(*table, "least");
  sizes.most = read_length(*table, "most");
  if (sizes.most <= sizes.least) table->fail("most", "is not above least");
  sizes.mean = 0.5 * (sizes.least + sizes.most);
  return sizes;
}

void scale(SizeDistribution& sizes, double factor) {
  for (double* length : {&sizes.mean, &sizes.deviation, &sizes.least, &sizes.most}) *length *= factor;
  for (double& diameter : sizes.diameter) diameter *= factor;
}

// Mass.

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
  if (lot.shape == Shape::disc) seeds.fail("density", "gives no mass to a disc, which has no thickness; give mass");
  if (lot.shape == Shape::clump) return volume_of_balls(lot.discs) * *density;
  return std::numbers::pi / 6 * elementary::pow(lot.diameter, 3) * *density;
}

/// Catalogues state the mass of a thousand seeds.
void reject_thousand_grain_mass(const Table& seeds, const SeedLot& lot) {
  const std::optional<double> density = seed_density(lot);
  if (!density || *density < 200e3 || *density > 3000e3) return;
  seeds.fail("mass",
             fmt::format("{:.3g} g in a seed this small is a density of {:.3g} kg/m3; it looks like the mass of "
                         "a thousand seeds, and a seed's is {:.3g} mg",
                         lot.mass * 1e3, *density, lot.mass * 1e3));
}

}  // namespace

SeedLot read_lot(Table& seeds, const std::string& name) {
  use_preset(seeds, "crop", "crops");
  SeedLot lot;
  lot.name = name;
  const auto chosen = seeds.choice("shape", shape_names);
  const ShapeName shape = chosen ? static_cast<ShapeName>(*chosen) : ShapeName::ball;
  refuse_keys(seeds, "shape", keys_of_other_shapes(shape),
              fmt::format("does not go with shape = \"{}\"", shape_names[static_cast<std::size_t>(shape)]));
  if (shape != ShapeName::discs) lot.sizes = read_sizes(seeds, size_key(shape));
  read_shape(seeds, shape, lot.sizes.mean, lot);
  if (lot.shape == Shape::clump && lot.sizes.kind != Kind::single) scale(lot.sizes, lot.diameter / lot.sizes.mean);
  if (lot.sizes.kind == Kind::single) lot.sizes = {};
  if (lot.sizes.kind == Kind::uniform || lot.sizes.kind == Kind::table) lot.sizes.mean = 0;  // told by the others
  lot.mass = read_mass(seeds, lot);
  reject_thousand_grain_mass(seeds, lot);
  return lot;
}

}  // namespace vibrosow
