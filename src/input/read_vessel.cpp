#include "input/read_vessel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grains/fill_height.hpp"
#include "input/lengths.hpp"
#include "input/read_drawing.hpp"
#include "input/read_holes.hpp"
#include "input/read_motion.hpp"
#include "input/wording.hpp"
#include "scene/clump_shape.hpp"
#include "scene/list_limits.hpp"
#include "scene/motion.hpp"
#include "scene/seed_lot.hpp"
#include "scene/si_units.hpp"
#include "scene/spaces.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

constexpr double thickness_rounding = 1e-9;  // of a seed's thickness, forgiven

constexpr int most_of_a_fill = 100'000'000;  // seeds

/// By which a fill says how much it is.
const char* key_of_fill(const Table& fill_table) {
  return fill_table.has("height") ? "height" : "count";
}

/// The count is read where it is given; one of a height follows from all else (`fill_to_height`).
Fill read_fill(Table table) {
  Fill fill;
  const std::optional<std::int64_t> count = table.whole_number("count", 1, most_of_a_fill);
  if (count && table.has("height")) table.fail("height", "contradicts count; give one of them");
  if (!count && !table.has("height")) table.fail("count", "is missing; how many seeds? Or height: how high?");
  fill.count = static_cast<int>(count.value_or(1));
  fill.where = table.where(key_of_fill(table));
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

/// Area that a seed of the lot's diameter takes at least in 2D: hexagonally packed; of clumps, which may fill
/// the plane, their own if poured, since rows are of the circles that hold them.
double least_area(const SeedLot& lot, bool poured) {
  if (poured && lot.shape == Shape::clump) return plate_of(lot.discs).area;
  return std::numbers::sqrt3 / 2 * lot.diameter * lot.diameter;
}

/// The same in 3D, m3: closest packed; of clumps, if poured, their own.
double least_volume(const SeedLot& lot, bool poured) {
  if (poured && lot.shape == Shape::clump) return clump_volume(lot);
  return lot.diameter * lot.diameter * lot.diameter / std::numbers::sqrt2;
}

/// Seeds that the vessel could hold at most.
double most_seeds(const Vessel& vessel, const std::vector<SeedLot>& lots, Space space) {
  const bool poured = vessel.fill->packing == Packing::poured, flat = space == Space::two_dimensional;
  double per_seed = 0;
  for (const SeedLot& lot : lots)
    per_seed += lot.number_fraction * size_moment(lot, flat ? 2 : 3) *
                (flat ? least_area(lot, poured) : least_volume(lot, poured));
  return (flat ? vessel.length : floor_area(vessel)) * vessel.height / per_seed;
}

/// Where the fill's height is given in place of its count.
void fill_to_height(Table& fill_table, Vessel& vessel, const std::vector<SeedLot>& lots, Space space) {
  const std::optional<double> height = fill_table.quantity("height", Dimension::length, shortest, longest);
  if (!height) return;
  if (*height > vessel.height)
    fill_table.fail("height", fmt::format("{} is more than the {}'s walls are high, {}", millimetres(*height),
                                          vessel.name, millimetres(vessel.height)));
  for (const SeedLot& lot : lots)
    if (*height < mean_thickness(lot))
      fill_table.fail("height", fmt::format("{} is less than one seed of {}, which is {} thick", millimetres(*height),
                                            lot.name, millimetres(mean_thickness(lot))));
  const double count = std::round(seeds_to_height(vessel, lots, space, *height));
  if (count < 1) fill_table.fail("height", fmt::format("up to {} there is no room for a seed", millimetres(*height)));
  if (count > most_of_a_fill)
    fill_table.fail("height", fmt::format("up to {} there is room for {:.3g} seeds, more than {}", millimetres(*height),
                                          count, most_of_a_fill));
  vessel.fill->count = static_cast<int>(count);
}

/// Too crude to promise that a fill fits, but what fails here cannot fit.
void check_fill_fits(const Table& fill_table, const Vessel& vessel, const std::vector<SeedLot>& lots, Space space) {
  const double widest = largest_diameter(lots);
  const char* key = key_of_fill(fill_table);
  const auto check_room = [&](double room, std::string_view extent) {
    if (widest > room)
      fill_table.fail(key, fmt::format("does not fit: a seed of {} is wider than the {}, which is {} {}",
                                       millimetres(widest), vessel.name, millimetres(room), extent));
  };
  check_room(vessel.length, "long");
  if (space == Space::three_dimensional) check_room(*vessel.depth, "deep");
  const double most = most_seeds(vessel, lots, space);
  if (vessel.fill->count > most) {
    const bool holders = vessel.fill->packing != Packing::poured && has_clumps(lots);
    fill_table.fail(key, fmt::format("does not fit: {} seeds, but closely packed{} the {} holds no more than {:.0f}",
                                     vessel.fill->count,
                                     holders ? fmt::format(", as the {} that hold them,",
                                                           space == Space::two_dimensional ? "circles" : "balls")
                                             : "",
                                     vessel.name, std::floor(most)));
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

/// The line turned about an axis.
void read_axis(Table& table, Space space, std::vector<WallPiece>& line) {
  const std::vector<double> about = table.quantities("about", Dimension::length, -longest, longest);
  if (about.empty()) {
    if (table.has("axis")) table.fail("axis", "is of a line that is turned; expected about beside it");
    return table.skip("axis");
  }
  if (space == Space::two_dimensional) table.fail("about", "a line is turned about an axis only with space = \"3d\"");
  const bool upright = table.choice("axis", {"upright", "along"}).value_or(0) == 0;
  if (about.size() != 2)
    table.fail("about", fmt::format("expected where the axis passes, {} and across, such as [\"10 cm\", \"4 cm\"]",
                                    upright ? "along" : "up"));
  for (WallPiece& piece : line) {
    if (piece.a.x() < 0 || piece.b.x() < 0)
      table.fail("line",
                 fmt::format("beside about, points are [distance from the axis, {}]; a distance is not below zero",
                             upright ? "height" : "place along"));
    if (piece.a.x() == 0 && piece.b.x() == 0) table.fail("line", "beside about, a piece of it lies on the axis");
    piece.about = {about[0], about[1]};
    piece.axis = upright ? PieceAxis::upright : PieceAxis::along;
  }
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

/// A list of pieces, or one table for a single drawing.
std::vector<Table> tables_of_pieces(Table& vessel) {
  if (!vessel.is_table("pieces")) return vessel.tables("pieces");
  const Table table = *vessel.table("pieces");
  if (!table.has("file")) table.fail("file", "is missing; expected a drawing, or a list of lines and arcs");
  return {table};
}

/// Lines, or an arc, of the seeder file itself.
void read_drawn_here(Table& table, Space space, std::vector<WallPiece>& pieces) {
  for (const char* key : {"file", "unit", "scale", "at", "tolerance"}) table.skip(key);
  if (table.has("line")) {
    auto line = read_line(table, table.points("line", Dimension::length, -longest, longest));
    read_axis(table, space, line);
    pieces.insert(pieces.end(), line.begin(), line.end());
    return;
  }
  pieces.push_back(read_arc(table));
  for (const char* key : {"about", "axis"})
    if (table.has(key))
      table.fail(key, "is of a line that is turned; an arc is drawn out, from front to back or along");
  for (const char* key : {"line", "about", "axis"}) table.skip(key);
}

/// Which way a piece, or all of a drawing, is drawn out.
DrawnOut read_drawn_out(Table& table, Space space) {
  const bool along = table.choice("drawn_out", {"across", "along"}).value_or(0) == 1;
  if (along && space == Space::two_dimensional)
    table.fail("drawn_out", "a piece is drawn out along the vessel only with space = \"3d\"");
  if (along && table.has("about")) table.fail("drawn_out", "contradicts about, by which the line is turned");
  return along ? DrawnOut::along : DrawnOut::across;
}

void read_pieces(Table& vessel_table, Space space, Vessel& vessel, std::vector<Drawing>& drawings) {
  std::vector<WallPiece>& pieces = vessel.pieces;
  for (Table& table : tables_of_pieces(vessel_table)) {
    const std::size_t first = pieces.size();
    const DrawnOut drawn_out = read_drawn_out(table, space);
    if (table.has("file"))
      drawings.push_back(read_drawing(table, vessel));
    else
      read_drawn_here(table, space, pieces);
    for (std::size_t k = first; k < pieces.size(); ++k) pieces[k].drawn_out = drawn_out;
    vessel_table.refuse_more("pieces", pieces.size(), list_limits::pieces);
  }
}

Rain read_rain(Table table, const Vessel& vessel) {
  Rain rain;
  rain.rate = table.required_quantity("rate", Dimension::seed_rate, 1e-6, 1e7);
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
    if (vessel.depth && *vessel.depth < mean_thickness(lot) * (1 - thickness_rounding))
      table.fail("depth", fmt::format("{} is less than one seed of {}, which is {} thick", millimetres(*vessel.depth),
                                      lot.name, millimetres(mean_thickness(lot))));
}

Sides read_sides(Table& table, const std::string& key, Sides otherwise) {
  constexpr Sides sides[] = {Sides::walls, Sides::open, Sides::periodic};
  const auto chosen = table.choice(key, {"walls", "open", "periodic"});
  return chosen ? sides[*chosen] : otherwise;
}

/// A period needs a floor that continues itself, and room: no two seeds may meet both within it and across its ends.
void check_period(const Table& table, const std::string& key, const std::string& vessel, double length, double diameter,
                  std::string_view extent) {
  constexpr double fewest_diameters = 6;
  if (length < fewest_diameters * diameter)
    table.fail(key, fmt::format("a periodic {} is at least {:g} diameters of the largest seed {}, {}", vessel,
                                fewest_diameters, extent, millimetres(fewest_diameters * diameter)));
}

void check_periodic(const Table& table, const Vessel& vessel, double diameter) {
  if (vessel.sides != Sides::periodic) return;
  if (vessel.name != "tray") table.fail("sides", "only the tray can be periodic");
  if (vessel.tilt != 0) table.fail("sides", "a periodic tray cannot be tilted: its ends would not meet");
  if (vessel.motion && turns(*vessel.motion))
    table.fail("sides", "a periodic tray cannot turn: its ends would not meet");
  check_period(table, "sides", "tray", vessel.length, diameter, "long");
}

/// A slice of a deep seeder is one of its tray and its hopper alike.
void check_periodic_across(const Table& table, const Vessel& vessel, const Vessel* tray, double diameter) {
  const bool periodic = vessel.front_and_back == Sides::periodic;
  if (tray != nullptr) {
    const bool of_tray = tray->front_and_back == Sides::periodic;
    if (periodic && (!of_tray || *vessel.depth != *tray->depth || vessel.front != 0))
      table.fail("front_and_back",
                 "a hopper is periodic across only with its tray, as deep as that and in front of it");
    const double slack = thickness_rounding * *tray->depth;
    if (of_tray && !periodic && (vessel.front < 0 || vessel.front + *vessel.depth > *tray->depth + slack))
      table.fail("depth", "the hopper does not lie within the depth of the periodic tray");
    return;
  }
  if (periodic) check_period(table, "front_and_back", "tray", *vessel.depth, diameter, "deep");
}

/// What a vessel has in 3D alone; in 2D it is to be right, and counts for nothing.
void read_space(Table& table, Space space, const Vessel* tray, Vessel& vessel) {
  const bool round = table.choice("plan", {"rectangle", "round"}).value_or(0) == 1;
  if (round && vessel.depth && *vessel.depth != vessel.length)
    table.fail("depth", "contradicts length: a round vessel is as deep as it is long, its diameter");
  if (space == Space::two_dimensional) {
    read_sides(table, "front_and_back", Sides::walls);
    if (tray != nullptr) table.quantity("front", Dimension::length, -longest, longest);
    if (round) table.files()->note(table.where("plan") + ": in 2D a round vessel is a slice of a rectangular one");
    return;
  }
  vessel.plan = round ? Plan::round : Plan::rectangle;
  if (round) vessel.depth = vessel.length;
  if (!vessel.depth && tray != nullptr) vessel.depth = tray->depth;
  if (!vessel.depth) table.fail("depth", "is missing; with space = \"3d\" a tray has a depth, from front to back");
  vessel.front_and_back =
      read_sides(table, "front_and_back", tray != nullptr && !round ? tray->front_and_back : Sides::walls);
  if (round && (vessel.sides != Sides::walls || vessel.front_and_back != Sides::walls))
    table.fail(vessel.sides != Sides::walls ? "sides" : "front_and_back", "a round vessel has one wall all round");
  if (tray != nullptr) vessel.front = table.quantity("front", Dimension::length, -longest, longest).value_or(0);
}

/// A floor slopes to slots from front to back, and in a round vessel to one round hole in its middle.
void check_funnel(Table& table, const Vessel& vessel, Space space) {
  if (vessel.funnel == 0) return;
  if (!vessel.box) table.fail("funnel", "is a slope of the floor, which box = false leaves out");
  if (vessel.holes.empty()) table.fail("funnel", "needs holes for the floor to slope to");
  if (space == Space::two_dimensional) return;
  const Hole& hole = vessel.holes.front();
  const double middle = vessel.length / 2, slack = thickness_rounding * vessel.length;
  if (vessel.plan == Plan::round) {
    if (hole.chamfer > 0) table.required_table("holes").fail("chamfer", "is of a level floor, and this one slopes");
    if (vessel.holes.size() > 1 || std::abs(hole.centre - middle) > slack || std::abs(hole.across - middle) > slack)
      table.fail("funnel", "a round vessel's funnel has one hole, in the middle");
    return;
  }
  const bool from_front_to_back = std::ranges::all_of(vessel.holes, [&](const Hole& one) {
    return one.shape == HoleShape::slot && one.across_length >= *vessel.depth * (1 - thickness_rounding);
  });
  if (!from_front_to_back)
    table.fail("funnel", "needs slots from front to back, or plan = \"round\" with a round hole in the middle");
}

/// What goes by a vessel's own left, right and up cannot go with one that turns over and over.
void check_turning(Table& table, const Vessel& vessel, Space space) {
  if (!turns_steadily(vessel)) return;
  const bool upright = std::get<TurningMotion>(*vessel.motion).axis == TurningAxis::upright;
  if (upright && space == Space::two_dimensional)
    table.required_table("motion").fail("axis", "a vessel turns about an upright axis only with space = \"3d\"");
  if (is_kept(vessel))
    table.required_table("fill").fail("keep", "a vessel that turns over and over cannot be topped up");
  if (!upright && !vessel.holes.empty())
    table.fail("holes", "a vessel that turns over and over has none; leave gaps between its pieces");
  if (upright && vessel.front_and_back == Sides::periodic)
    table.fail("front_and_back",
               "a vessel that turns about an upright axis cannot be periodic: its ends would not meet");
}

/// How many times as many seeds a vessel takes in `space` as in the other one, in which the file counts them.
double seeds_of_other_space(Table& table, const Vessel& vessel, const Vessel* tray, Space space, double slice) {
  Vessel whole = vessel;
  if (table.choice("plan", {"rectangle", "round"}).value_or(0) == 1)
    whole.plan = Plan::round, whole.depth = vessel.length;
  if (!whole.depth && tray != nullptr) whole.depth = tray->depth;
  if (!whole.depth) table.fail("depth", "is missing; with space = \"3d\" a tray has a depth, from front to back");
  const double slices = slices_of_vessel(whole, slice);
  return space == Space::two_dimensional ? 1 / slices : slices;
}

}  // namespace

Vessel read_vessel(Table table, const std::string& name, const std::vector<SeedLot>& lots, Space space,
                   std::vector<Drawing>& drawings, const Vessel* tray, std::optional<double> slice) {
  Vessel vessel;
  vessel.name = name;
  vessel.length = table.required_quantity("length", Dimension::length, shortest, longest);
  vessel.height = table.required_quantity("height", Dimension::length, shortest, longest);
  vessel.depth = table.quantity("depth", Dimension::length, shortest, longest);
  vessel.sides = read_sides(table, "sides", Sides::walls);
  read_space(table, space, tray, vessel);
  check_depth(table, vessel, lots);
  vessel.tilt = table.quantity("tilt", Dimension::angle, -30 * degree, 30 * degree).value_or(0);
  vessel.funnel = table.quantity("funnel", Dimension::angle, 0.01 * degree, 80 * degree).value_or(0);
  vessel.box = table.boolean("box").value_or(true);
  read_pieces(table, space, vessel, drawings);
  if (!vessel.box && vessel.pieces.empty()) table.fail("box", "without floor and end walls a vessel needs pieces");
  if (const auto holes = table.table("holes"))
    vessel.holes = read_holes(*holes, vessel, space, largest_mean_diameter(lots));
  if (space == Space::two_dimensional && vessel.depth && !vessel.holes.empty())
    vessel.slots_in_3d = read_slots_in_3d(*table.table("holes"), vessel.holes.front().shape, *vessel.depth);
  if (vessel.plan == Plan::round && !vessel.holes.empty() && vessel.holes.front().shape != HoleShape::round)
    table.fail("plan", "a round vessel has round holes: holes.shape = \"round\"");
  check_funnel(table, vessel, space);
  if (highest_floor(vessel) >= vessel.height) {
    table.fail("funnel", fmt::format("the floor would rise to {}, as high as the walls or higher ({})",
                                     millimetres(highest_floor(vessel)), millimetres(vessel.height)));
  }
  auto fill = table.table("fill");
  const auto rain = table.table("rain");
  if (fill) vessel.fill = read_fill(*fill);
  if (rain) vessel.rain = read_rain(*rain, vessel);
  if (slice) multiply_seeds(vessel, seeds_of_other_space(table, vessel, tray, space, *slice));
  if (fill) fill_to_height(*fill, vessel, lots, space);
  if (fill) check_fill_fits(*fill, vessel, lots, space);
  if (const auto motion = table.table("motion")) {
    vessel.motion = read_motion(*motion);
    if (space == Space::two_dimensional && moves_across(*vessel.motion))
      motion->fail(motion->has("file")         ? "file"
                   : motion->has("components") ? "components"
                                               : "direction",
                   "a motion from front to back needs space = \"3d\"");
  }
  check_turning(table, vessel, space);
  check_periodic(table, vessel, largest_diameter(lots));
  if (space == Space::three_dimensional) check_periodic_across(table, vessel, tray, largest_diameter(lots));
  return vessel;
}

}  // namespace vibrosow
