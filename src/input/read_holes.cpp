#include "input/read_holes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "input/lengths.hpp"
#include "portable_math/functions.hpp"

namespace vibrosow {
namespace {

constexpr double rounding = 1e-9;  // of the floor's length, forgiven at its ends

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

/// Where holes lie along the floor: in one row, which all rows of holes are like, or row by row from the front.
struct HoleRows {
  std::vector<std::vector<double>> centres;  // m
  std::string placed_by;                     // key that answers for a hole in the wrong place

  bool are_unlike() const { return centres.size() > 1; }
  /// As many as lists of widths and times may have entries.
  std::size_t holes() const {
    std::size_t holes = 0;
    for (const std::vector<double>& row : centres) holes += row.size();
    return holes;
  }
};

void refuse_many(const Table& table, double holes) {
  constexpr double most = 10'000;
  if (holes > most)
    table.fail(table.has("at") ? "at" : "count", fmt::format("makes {:g} holes, more than {:g}", holes, most));
}

/// `count` holes a row, evenly spaced about a centre.
HoleRows read_counted(Table& table, double length, Space space) {
  if (table.has("span") && table.has("pitch")) table.fail("pitch", "contradicts span; give one of them");
  const std::vector<std::int64_t> counts = table.whole_numbers("count", 1, 10000);
  const std::optional<double> span = table.quantity("span", Dimension::length, shortest, longest);
  const std::optional<double> pitch_given = table.quantity("pitch", Dimension::length, shortest, longest);
  const std::optional<double> centre = table.quantity("centre", Dimension::length, 0, longest);
  if (counts.empty()) table.fail("count", "is missing; give count, or at with the holes' centres");
  if (counts.size() > 1 && space == Space::two_dimensional)
    table.fail(
        "count",
        "is one number in 2D, where a row of holes stands for all rows; a list, one a row, needs space = \"3d\"");

  refuse_many(table, static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0})));
  HoleRows rows;
  for (const std::int64_t count : counts) {
    const double n = static_cast<double>(count);
    double pitch = pitch_given.value_or(length / (n + 1));
    if (span) pitch = count > 1 ? *span / (n - 1) : 0;
    std::vector<double>& row = rows.centres.emplace_back();
    for (int i = 0; i < count; ++i) row.push_back(rounded(centre.value_or(length / 2) + (i - (n - 1) / 2) * pitch));
  }
  const bool spaced = std::ranges::max(counts) > 1;
  rows.placed_by = spaced && span ? "span" : spaced && pitch_given ? "pitch" : centre ? "centre" : "width";
  return rows;
}

HoleRows read_positions(Table& table, double length, Space space) {
  if (!table.has("at")) {
    HoleRows rows = read_counted(table, length, space);
    table.skip("at");
    return rows;
  }
  for (const char* key : {"count", "span", "pitch", "centre"}) {
    table.skip(key);
    if (table.has(key)) table.fail(key, "contradicts at, which already gives each hole's centre");
  }
  return {{table.quantities("at", Dimension::length, 0, longest)}, "at"};
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

constexpr std::int64_t most_rows = 1000;

/// Where the rows of holes lie across, and how far a slot reaches.
struct Rows {
  std::vector<double> across;  // m, from the front
  double length = 0;           // m, of a slot
};

std::vector<double> evenly(std::int64_t rows, double depth) {
  std::vector<double> across;
  for (std::int64_t k = 0; k < rows; ++k)
    across.push_back(rounded((static_cast<double>(k) + 0.5) * depth / static_cast<double>(rows)));
  return across;
}

/// `counted`: how many rows `count` gives, where they are unlike.
Rows read_rows(Table& table, HoleShape shape, double depth, std::optional<std::size_t> counted) {
  const std::optional<std::int64_t> given = table.whole_number("rows", 1, most_rows);
  if (given && counted && *given != static_cast<std::int64_t>(*counted))
    table.fail("rows", fmt::format("contradicts count, which gives the holes of {} rows", *counted));
  const std::int64_t rows = counted ? static_cast<std::int64_t>(*counted) : given.value_or(1);
  const std::vector<double> across = table.quantities("across", Dimension::length, 0, longest);
  if (shape == HoleShape::round) {
    if (given && !across.empty()) table.fail("rows", "contradicts across, which already gives each row's place");
    if (counted && !across.empty() && across.size() != *counted)
      table.fail("across", fmt::format("lists {} places for the {} rows that count gives", across.size(), *counted));
    return {across.empty() ? evenly(rows, depth) : across, 0};
  }
  if (across.size() > 1) table.fail("across", "is the length of a slot across, one value; give rows for several rows");
  const double strip = depth / static_cast<double>(rows);
  if (across.empty() && rows > 1) table.fail("across", "is missing; how long are the slots of a row?");
  if (!across.empty() && across.front() == 0) table.fail("across", "is the length of a slot, which is not nothing");
  if (!across.empty() && across.front() > strip * (1 + rounding))
    table.fail("across", fmt::format("{} is longer than {}, the depth that a row has", millimetres(across.front()),
                                     millimetres(strip)));
  return {evenly(rows, depth), across.empty() ? depth : across.front()};
}

/// Of the floor at its holes, which are round holes of space.
struct Edge {
  double thickness = 0, chamfer = 0;  // m
};

Edge read_edge(Table& table, HoleShape shape, Space space) {
  Edge edge;
  edge.chamfer = table.quantity("chamfer", Dimension::length, shortest, longest).value_or(0);
  edge.thickness = table.quantity("thickness", Dimension::length, shortest, longest).value_or(edge.chamfer);
  if (shape != HoleShape::round)
    for (const char* key : {"chamfer", "thickness"})
      if (table.has(key)) table.fail(key, "is of round holes: shape = \"round\"");
  if (edge.chamfer > edge.thickness)
    table.fail("chamfer", fmt::format("{} is more than the floor's thickness, {}", millimetres(edge.chamfer),
                                      millimetres(edge.thickness)));
  return space == Space::two_dimensional ? Edge{} : edge;
}

/// How far (m) two holes are apart; not above zero where they touch.
double apart(const Hole& a, const Hole& b, Space space) {
  const double along = std::abs(a.centre - b.centre), across = std::abs(a.across - b.across);
  if (space == Space::three_dimensional && a.shape == HoleShape::round)
    return portable_math::hypot(along, across) - 0.5 * (a.rim_width() + b.rim_width());
  const double gap = along - 0.5 * (a.width + b.width);
  return space == Space::two_dimensional ? gap : std::max(gap, across - 0.5 * (a.across_length + b.across_length));
}

bool is_within(const Hole& hole, const Vessel& vessel, Space space) {
  const double slack = rounding * vessel.length, radius = hole.rim_width() / 2;
  const bool along = hole.centre - radius >= -slack && hole.centre + radius <= vessel.length + slack;
  if (space == Space::two_dimensional) return along;
  if (vessel.plan == Plan::round) {
    const double middle = vessel.length / 2;
    return portable_math::hypot(hole.centre - middle, hole.across - middle) + radius <= middle + slack;
  }
  const double reach = hole.shape == HoleShape::round ? radius : hole.across_length / 2;
  return along && hole.across - reach >= -slack && hole.across + reach <= *vessel.depth + slack;
}

std::string place_of(const Hole& hole, Space space) {
  const std::string along = millimetres(hole.centre);
  return space == Space::two_dimensional ? along
                                         : fmt::format("{}, {} from the front", along, millimetres(hole.across));
}

double longest_width(const std::vector<Hole>& holes) {
  return std::ranges::max_element(holes, {}, &Hole::rim_width)->rim_width();
}

void check_holes(const Table& table, const std::vector<Hole>& holes, const Vessel& vessel, Space space,
                 const std::string& placed_by) {
  const bool deep = space == Space::three_dimensional;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const Hole& hole = holes[i];
    if (!is_within(hole, vessel, space)) {
      table.fail(placed_by, fmt::format("hole {} at {}, {} wide, is not within the floor, which is {} long{}", i + 1,
                                        place_of(hole, space), millimetres(hole.width), millimetres(vessel.length),
                                        deep ? fmt::format(" and {} deep", millimetres(*vessel.depth)) : ""));
    }
    const double reach = 0.5 * hole.rim_width() + 0.5 * longest_width(holes);
    for (std::size_t k = i; k-- > 0 && holes[i].centre - holes[k].centre <= reach * (1 + rounding);) {
      const Hole& before = holes[k];
      if (apart(before, hole, space) > rounding * vessel.length) continue;
      table.fail(placed_by, fmt::format("hole {} at {}, {} wide, overlaps or touches hole {} at {}, {} wide", k + 1,
                                        place_of(before, space), millimetres(before.width), i + 1,
                                        place_of(hole, space), millimetres(hole.width)));
    }
  }
}

}  // namespace

SlotsIn3d read_slots_in_3d(Table table, HoleShape shape, double depth) {
  SlotsIn3d slots;
  slots.rows = static_cast<int>(table.whole_number("rows", 1, most_rows).value_or(1));
  const std::vector<double> across = table.quantities("across", Dimension::length, 0, longest);
  if (shape == HoleShape::round)
    slots.rows = std::max(slots.rows, static_cast<int>(across.size()));
  else if (!across.empty())
    slots.open = std::min(1.0, slots.rows * across.front() / depth);
  return slots;
}

std::vector<Hole> read_holes(Table table, const Vessel& vessel, Space space, double diameter) {
  constexpr HoleShape shapes[] = {HoleShape::slot, HoleShape::round};
  const HoleRows along = read_positions(table, vessel.length, space);
  const std::vector<double> widths = read_widths(table, along.holes(), diameter);
  const std::vector<double> open_at = read_opening_times(table, along.holes());
  const HoleShape shape = shapes[table.choice("shape", {"slot", "round"}).value_or(0)];
  const Edge edge = read_edge(table, shape, space);
  Rows rows{{0}, 0};
  if (space == Space::two_dimensional)
    table.skip("rows"), table.skip("across");
  else
    rows =
        read_rows(table, shape, *vessel.depth, along.are_unlike() ? std::optional(along.centres.size()) : std::nullopt);
  refuse_many(table, static_cast<double>(along.holes() * (along.are_unlike() ? 1 : rows.across.size())));
  std::vector<Hole> holes;
  std::size_t first = 0;  // of the row in the lists
  for (std::size_t k = 0; k < rows.across.size(); ++k) {
    const std::vector<double>& centres = along.centres[along.are_unlike() ? k : 0];
    for (std::size_t i = 0; i < centres.size(); ++i)
      holes.push_back({centres[i], widths[first + i], open_at[first + i], shape, rows.across[k], rows.length,
                       edge.thickness, edge.chamfer});
    if (along.are_unlike()) first += centres.size();
  }
  std::stable_sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) {
    return std::tie(a.centre, a.across) < std::tie(b.centre, b.across);
  });
  check_holes(table, holes, vessel, space, along.placed_by);
  return holes;
}

}  // namespace vibrosow
