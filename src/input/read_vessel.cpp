#include "input/read_vessel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/read_motion.hpp"
#include "input/wording.hpp"
#include "scene/clump_shape.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double shortest = 1e-6, longest = 100;  // m, of any length in a vessel
constexpr double rounding = 1e-9;                 // of the floor's length, forgiven at its ends

std::string millimetres(double length) {
  return fmt::format("{:g} mm", std::round(length * 1e9) / 1e6);
}

/// To the picometre, so that the same holes from other keys are the same numbers: 25 cm + 9 cm is 34 cm.
double rounded(double length) {
  return std::round(length * 1e12) / 1e12;
}

}  // namespace

/// What "3 diameters" are of.
double largest_mean_diameter(const std::vector<SeedLot>& lots) {
  return std::max_element(lots.begin(), lots.end(),
                          [](const SeedLot& a, const SeedLot& b) { return a.diameter < b.diameter; })
      ->diameter;
}

double read_width(const Table& table, const std::string& key, const TomlValue& value, double diameter) {
  static constexpr std::string_view expected_width = "a length such as \"16 mm\" or \"3 diameters\"";
  const std::string shown_value = shortened(toml_text(value));
  const auto* text = value.get<std::string>();
  const auto* typed = value.get<Quantity>();
  if (text == nullptr && typed == nullptr)
    table.fail(key, fmt::format("must be {}, in quotes, not {}", expected_width, shown_value));
  double width = 0;
  try {
    const Quantity quantity = typed != nullptr ? *typed : split_quantity(*text);
    const bool counted = quantity.unit == "diameters" || quantity.unit == "diameter";
    width = rounded(counted ? quantity.number * diameter : in_si(quantity, Dimension::length));
  } catch (const UnitError& error) {
    table.fail(key, fmt::format("{} is not a {}; expected {}: {}", shown_value, key, expected_width, error.what()));
  }
  if (!(width >= shortest && width <= longest)) {
    table.fail(key, fmt::format("{} is out of range, which is from 0.001 mm to 100 m", shown_value));
  }
  return width;
}

namespace {

std::vector<double> read_widths(Table& table, std::size_t holes, double diameter) {
  const std::vector<TomlValue> given = table.values_of("width");
  if (given.empty()) table.fail("width", "is missing; expected a length such as \"16 mm\" or \"3 diameters\"");
  if (given.size() != 1 && given.size() != holes) {
    table.fail("width",
               fmt::format("lists {} widths for {} holes; expected one for all or one each", given.size(), holes));
  }
  std::vector<double> widths;
  for (const TomlValue& value : given) widths.push_back(read_width(table, "width", value, diameter));
  widths.resize(holes, widths.front());
  return widths;
}

struct HoleRow {
  std::vector<double> centres;  // m
  std::string placed_by;        // key that answers for a hole in the wrong place
};

/// `count` holes, evenly spaced about a centre.
HoleRow read_row(Table& table, double length) {
  if (table.has("span") && table.has("pitch")) table.fail("pitch", "contradicts span; give one of them");
  const std::optional<std::int64_t> count = table.whole_number("count", 1, 10000);
  const std::optional<double> span = table.quantity("span", Dimension::length, shortest, longest);
  const std::optional<double> pitch_given = table.quantity("pitch", Dimension::length, shortest, longest);
  const std::optional<double> centre = table.quantity("centre", Dimension::length, 0, longest);
  if (!count) table.fail("count", "is missing; give count, or at with the holes' centres");

  const double n = static_cast<double>(*count);
  double pitch = pitch_given.value_or(length / (n + 1));
  if (span) pitch = *count > 1 ? *span / (n - 1) : 0;
  HoleRow row;
  for (int i = 0; i < *count; ++i) {
    row.centres.push_back(rounded(centre.value_or(length / 2) + (i - (n - 1) / 2) * pitch));
  }
  const bool spaced = *count > 1;
  row.placed_by = spaced && span ? "span" : spaced && pitch_given ? "pitch" : centre ? "centre" : "width";
  return row;
}

HoleRow read_positions(Table& table, double length) {
  if (!table.has("at")) {
    HoleRow row = read_row(table, length);
    table.skip("at");
    return row;
  }
  for (const char* key : {"count", "span", "pitch", "centre"}) {
    table.skip(key);
    if (table.has(key)) table.fail(key, "contradicts at, which already gives each hole's centre");
  }
  return {table.quantities("at", Dimension::length, 0, longest), "at"};
}

void check_holes(const Table& table, const std::vector<Hole>& holes, double length, const std::string& placed_by) {
  const double slack = rounding * length;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const Hole& hole = holes[i];
    if (hole.centre - hole.width / 2 < -slack || hole.centre + hole.width / 2 > length + slack) {
      table.fail(placed_by, fmt::format("hole {} at {}, {} wide, is not within the floor, which is {} long", i + 1,
                                        millimetres(hole.centre), millimetres(hole.width), millimetres(length)));
    }
    if (i == 0) continue;
    const Hole& before = holes[i - 1];
    if (hole.centre - hole.width / 2 - (before.centre + before.width / 2) <= slack) {
      table.fail(placed_by, fmt::format("hole {} at {}, {} wide, overlaps or touches hole {} at {}, {} wide", i,
                                        millimetres(before.centre), millimetres(before.width), i + 1,
                                        millimetres(hole.centre), millimetres(hole.width)));
    }
  }
}

std::vector<double> read_opening_times(Table& table, std::size_t holes) {
  std::vector<double> times = table.quantities("open_at", Dimension::time, 0, 1e6);
  if (times.size() > 1 && times.size() != holes) {
    table.fail("open_at",
               fmt::format("lists {} times for {} holes; expected one for all or one each", times.size(), holes));
  }
  times.resize(holes, times.empty() ? 0.0 : times.front());
  return times;
}

std::vector<Hole> read_holes(Table table, double length, double diameter) {
  const HoleRow row = read_positions(table, length);
  const std::vector<double> widths = read_widths(table, row.centres.size(), diameter);
  const std::vector<double> open_at = read_opening_times(table, row.centres.size());
  std::vector<Hole> holes;
  for (std::size_t i = 0; i < widths.size(); ++i) holes.push_back({row.centres[i], widths[i], open_at[i]});
  std::stable_sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.centre < b.centre; });
  check_holes(table, holes, length, row.placed_by);
  return holes;
}

Fill read_fill(Table table) {
  Fill fill;
  const std::optional<std::int64_t> count = table.whole_number("count", 1, 100'000'000);
  if (!count) table.fail("count", "is missing; how many seeds?");
  fill.count = static_cast<int>(*count);
  fill.where = table.where("count");
  constexpr Packing packings[] = {Packing::poured, Packing::layers, Packing::hexagonal};
  fill.packing = packings[table.choice("packing", {"poured", "layers", "hexagonal"}).value_or(0)];
  const std::optional<double> jitter = table.number("jitter", 0, 0.1);
  if (jitter && fill.packing == Packing::poured) {
    table.fail("jitter", "goes with packing = \"layers\" or \"hexagonal\"; poured seeds are dropped at random");
  }
  fill.jitter = jitter.value_or(fill.jitter);
  fill.keep = table.boolean("keep").value_or(fill.keep);
  return fill;
}

/// Area that a seed of the lot's diameter takes at least: hexagonally packed; of clumps, which may fill the plane,
/// their own if poured, since rows are of the circles that hold them.
double least_area(const SeedLot& lot, bool poured) {
  if (poured && lot.shape == Shape::clump) return plate_of(lot.discs).area;
  return std::numbers::sqrt3 / 2 * lot.diameter * lot.diameter;
}

/// Too crude to promise that a fill fits, but what fails here cannot fit.
void check_fill_fits(Table fill_table, const Vessel& vessel, const std::vector<SeedLot>& lots) {
  if (largest_diameter(lots) > vessel.length) {
    fill_table.fail("count", fmt::format("does not fit: a seed of {} is wider than the {}, which is {} long",
                                         millimetres(largest_diameter(lots)), vessel.name, millimetres(vessel.length)));
  }
  const bool poured = vessel.fill->packing == Packing::poured;
  double area_per_seed = 0;
  for (const SeedLot& lot : lots) area_per_seed += lot.number_fraction * size_moment(lot, 2) * least_area(lot, poured);
  const double most = vessel.length * vessel.height / area_per_seed;
  if (vessel.fill->count > most) {
    const bool circles =
        !poured && std::ranges::any_of(lots, [](const SeedLot& lot) { return lot.shape == Shape::clump; });
    fill_table.fail(
        "count",
        fmt::format("does not fit: {} seeds, but closely packed{} the {} holds no more than {:.0f}", vessel.fill->count,
                    circles ? ", as the circles that hold them," : "", vessel.name, std::floor(most)));
  }
}

std::vector<WallPiece> read_line(const Table& table, const std::vector<std::array<double, 2>>& points) {
  if (points.size() < 2) table.fail("line", "has a single point; expected two or more");
  std::vector<WallPiece> pieces;
  for (std::size_t k = 1; k < points.size(); ++k) {
    WallPiece piece;
    piece.a = {points[k - 1][0], points[k - 1][1]};
    piece.b = {points[k][0], points[k][1]};
    if ((piece.b - piece.a).norm() < shortest)
      table.fail("line", fmt::format("points {} and {} lie on each other", k, k + 1));
    pieces.push_back(piece);
  }
  return pieces;
}

WallPiece read_arc(Table& table) {
  WallPiece arc;
  const std::vector<double> centre = table.quantities("centre", Dimension::length, -longest, longest);
  if (centre.size() != 2) {
    table.fail("centre",
               "expected line = [[\"0 cm\", \"5 cm\"], ...], or an arc's centre such as [\"5 cm\", \"5 cm\"]");
  }
  arc.centre = {centre[0], centre[1]};
  arc.radius = table.required_quantity("radius", Dimension::length, shortest, longest);
  arc.from = table.quantity("from", Dimension::angle, -360 * degree, 360 * degree).value_or(0);
  arc.to = table.quantity("to", Dimension::angle, -360 * degree, 720 * degree).value_or(arc.from + 360 * degree);
  if (!(arc.to > arc.from && arc.to - arc.from <= 360 * degree * (1 + 1e-12))) {
    table.fail("to",
               fmt::format("an arc runs anticlockwise from {:g} to {:g} degree; expected a larger end, by no more "
                           "than a full turn",
                           arc.from / degree, arc.to / degree));
  }
  return arc;
}

std::vector<WallPiece> read_pieces(Table& vessel) {
  std::vector<WallPiece> pieces;
  for (Table& table : vessel.tables("pieces")) {
    if (table.has("line")) {
      const auto line = read_line(table, table.points("line", Dimension::length, -longest, longest));
      pieces.insert(pieces.end(), line.begin(), line.end());
    } else {
      pieces.push_back(read_arc(table));
      table.skip("line");
    }
  }
  return pieces;
}

Rain read_rain(Table table, const Vessel& vessel) {
  Rain rain;
  rain.rate = table.required_quantity("rate", Dimension::rate, 1e-6, 1e7);
  rain.from = table.quantity("from", Dimension::length, 0, vessel.length).value_or(0);
  rain.to = table.quantity("to", Dimension::length, 0, vessel.length).value_or(vessel.length);
  if (rain.to < rain.from)
    table.fail(table.has("to") ? "to" : "from",
               fmt::format("{} is left of from = {}", millimetres(rain.to), millimetres(rain.from)));
  rain.height = table.quantity("height", Dimension::length, shortest, longest).value_or(vessel.height);
  rain.start = table.quantity("start", Dimension::time, 0, 1e6).value_or(0);
  rain.stop = table.quantity("stop", Dimension::time, 0, 1e6).value_or(never);
  if (rain.stop <= rain.start)
    table.fail("stop", fmt::format("{:g} s is not after the start, {:g} s", rain.stop, rain.start));
  return rain;
}

void check_depth(const Table& table, const Vessel& vessel, const std::vector<SeedLot>& lots) {
  for (const SeedLot& lot : lots)
    if (vessel.depth && *vessel.depth < mean_thickness(lot) * (1 - rounding))
      table.fail("depth", fmt::format("{} is less than one seed of {}, which is {} thick", millimetres(*vessel.depth),
                                      lot.name, millimetres(mean_thickness(lot))));
}

Sides read_sides(Table& table) {
  constexpr Sides sides[] = {Sides::walls, Sides::open, Sides::periodic};
  return sides[table.choice("sides", {"walls", "open", "periodic"}).value_or(0)];
}

/// A period needs a floor that continues itself, and room: no two seeds may meet both within it and across its ends.
void check_periodic(const Table& table, const Vessel& vessel, double diameter) {
  if (vessel.sides != Sides::periodic) return;
  constexpr double fewest_diameters = 6;
  if (vessel.name != "tray") table.fail("sides", "only the tray can be periodic");
  if (vessel.tilt != 0) table.fail("sides", "a periodic tray cannot be tilted: its ends would not meet");
  if (vessel.motion && turns(*vessel.motion))
    table.fail("sides", "a periodic tray cannot turn: its ends would not meet");
  if (vessel.length < fewest_diameters * diameter)
    table.fail("sides", fmt::format("a periodic tray is at least {:g} diameters of the largest seed long, {}",
                                    fewest_diameters, millimetres(fewest_diameters * diameter)));
}

}  // namespace

Vessel read_vessel(Table table, const std::string& name, const std::vector<SeedLot>& lots) {
  Vessel vessel;
  vessel.name = name;
  vessel.length = table.required_quantity("length", Dimension::length, shortest, longest);
  vessel.height = table.required_quantity("height", Dimension::length, shortest, longest);
  vessel.depth = table.quantity("depth", Dimension::length, shortest, longest);
  check_depth(table, vessel, lots);
  vessel.tilt = table.quantity("tilt", Dimension::angle, -30 * degree, 30 * degree).value_or(0);
  vessel.funnel = table.quantity("funnel", Dimension::angle, 0.01 * degree, 80 * degree).value_or(0);
  vessel.box = table.boolean("box").value_or(true);
  vessel.pieces = read_pieces(table);
  vessel.sides = read_sides(table);
  if (!vessel.box && vessel.pieces.empty()) table.fail("box", "without floor and end walls a vessel needs pieces");
  if (!vessel.box && vessel.funnel > 0) table.fail("funnel", "is a slope of the floor, which box = false leaves out");
  if (const auto holes = table.table("holes"))
    vessel.holes = read_holes(*holes, vessel.length, largest_mean_diameter(lots));
  if (vessel.funnel > 0 && vessel.holes.empty()) table.fail("funnel", "needs holes for the floor to slope to");
  if (highest_floor(vessel) >= vessel.height) {
    table.fail("funnel", fmt::format("the floor would rise to {}, as high as the walls or higher ({})",
                                     millimetres(highest_floor(vessel)), millimetres(vessel.height)));
  }
  if (const auto fill = table.table("fill")) {
    vessel.fill = read_fill(*fill);
    check_fill_fits(*fill, vessel, lots);
  }
  if (const auto rain = table.table("rain")) vessel.rain = read_rain(*rain, vessel);
  if (const auto motion = table.table("motion")) vessel.motion = read_motion(*motion);
  check_periodic(table, vessel, largest_diameter(lots));
  return vessel;
}

}  // namespace vibrosow
