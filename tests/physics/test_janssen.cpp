// A column between rough walls: friction carries the grains, and what weighs on the floor saturates with height
// (Janssen 1895; translated by M. Sperl, arXiv:cond-mat/0511618). VIBROSOW_REPORTS=FOLDER: the table is written to
// FOLDER/janssen.csv too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "input/read_scene.hpp"
#include "plan/step_plan.hpp"
#include "simulation/simulation.hpp"
#include "support/report_file.hpp"

namespace vibrosow {
namespace {

constexpr double measured_from = 0.5, measured_to = 1.5;  // s; until then friction has been mobilised
constexpr int looks = 60, seeds = 8;

/// Sums over looks, per band of one half of a width, counted from the floor.
struct Column {
  double width = 0, band = 0;               // m
  double total_weight = 0, floor_load = 0;  // N
  double top = 0;                           // m
  std::vector<double> weight, push, drag;   // N by band: of its grains; of both walls, normal and upward
};

/// Adds one look at the column, a part 1 / looks of the mean.
void add_look(Simulation& run, Column& column) {
  const Grains& grains = run.grains();
  const Forces forces = run.field().wall_forces();
  const double floor = run.field().walls().poses().front().displacement.y(), part = 1.0 / looks;
  double top = 0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const GrainKind kind = grains.kind(i);
    const double weight = kind.mass * standard_gravity, height = grains.y[i] - floor;
    const std::size_t band = static_cast<std::size_t>(height / column.band);
    if (band >= column.weight.size())
      column.weight.resize(band + 1), column.push.resize(band + 1), column.drag.resize(band + 1);
    column.weight[band] += part * weight;
    column.total_weight += part * weight;
    top = std::max(top, height + kind.radius);
    if (height < 1.1 * kind.radius) {  // on the floor; a wall's fraction in a corner's grain goes with it
      column.floor_load += part * forces[i].fy;
    } else {
      column.push[band] += part * std::abs(forces[i].fx);
      column.drag[band] += part * forces[i].fy;
    }
  }
  column.top += part * top;
}

/// Columns of `widths` widths of grains, one a random seed.
std::vector<Column> measured_columns(int widths) {
  const Scene scene = read_scene(std::string(VIBROSOW_SOURCE_DIR) + "/tests/physics/janssen.toml",
                                 {parse_override("hopper.fill.count=" + std::to_string(835 * widths / 8))});
  std::vector<Column> columns;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Column column;
    column.width = scene.hopper->length, column.band = 0.5 * column.width;
    Simulation run(prepare(scene), seed);
    for (int look = 0; look < looks; ++look) {
      const double at = measured_from + (measured_to - measured_from) * (look + 0.5) / looks;
      while (run.time() < at)
        if (!run.step()) ADD_FAILURE() << *run.guard().stop_reason();
      add_look(run, column);
    }
    columns.push_back(column);
  }
  return columns;
}

/// Of a figure over the random seeds: one column in eight or so is held up by an arch that jams on the floor for a
/// while, which a mean would follow.
template <class Figure>
double median(const std::vector<Column>& columns, Figure figure) {
  std::vector<double> values;
  for (const Column& column : columns) values.push_back(figure(column));
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

struct Stress {
  double depth;                 // m, below the top
  double vertical, horizontal;  // N/m, carried a unit of width; a unit of height
};

/// Vertical stress below each band from the balance of what lies above: weight less the walls' friction.
std::vector<Stress> stresses(const Column& column) {
  std::vector<Stress> found;
  double carried = 0;  // N, at the upper edge
  for (std::size_t band = column.weight.size(); band-- > 0;) {
    const double above = carried;
    carried += column.weight[band] - column.drag[band];
    const double middle = (static_cast<double>(band) + 0.5) * column.band;
    found.push_back(
        {column.top - middle, 0.5 * (above + carried) / column.width, 0.5 * column.push[band] / column.band});
  }
  return found;
}

struct Janssen {
  double ratio;     // K, horizontal over vertical stress
  double friction;  // friction over normal force on the walls, mobilised
  double density;   // N/m2, weight per area
};

/// K and friction of the column's middle: the free surface above and the floor below left out, a width and a half each.
Janssen measure(const Column& column) {
  double horizontal = 0, vertical = 0, push = 0, drag = 0;
  const std::vector<Stress> profile = stresses(column);
  for (std::size_t k = 3; k + 3 < profile.size(); ++k) {
    const std::size_t band = profile.size() - 1 - k;
    horizontal += profile[k].horizontal, vertical += profile[k].vertical;
    push += column.push[band], drag += column.drag[band];
  }
  return {horizontal / vertical, drag / push, column.total_weight / (column.width * column.top)};
}

/// Vertical stress at a depth between two walls `width` apart.
double janssen_stress(const Janssen& m, double width, double depth) {
  const double length = width / (2 * m.ratio * m.friction);
  return m.density * length * (1 - std::exp(-depth / length));
}

TEST(Janssen, FloorLoadSaturates) {
  std::string table =
      "# tests/physics/janssen.toml: columns of 2 to 8 widths on a floor that sinks slowly, medians of 8 random seeds\n"
      "# K and mobilised friction from the tallest one's middle; stresses in N per m of width and depth of one grain's "
      "slice\n"
      "widths,depth_mm,floor_stress_N_per_m,janssen_N_per_m,weight_N_per_m,K,mobilised_friction\n";
  std::map<int, std::vector<Column>> columns;
  for (const int widths : {2, 4, 6, 8}) columns[widths] = measured_columns(widths);
  const auto& tallest = columns[8];
  const Janssen m{median(tallest, [](const Column& c) { return measure(c).ratio; }),
                  median(tallest, [](const Column& c) { return measure(c).friction; }),
                  median(tallest, [](const Column& c) { return measure(c).density; })};
  std::map<int, double> load;  // N/m
  for (const auto& [widths, seeds_of_it] : columns) {
    load[widths] = median(seeds_of_it, [](const Column& c) { return c.floor_load / c.width; });
    const double top = median(seeds_of_it, [](const Column& c) { return c.top; });
    table += fmt::format("{},{:.1f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", widths, 1e3 * top, load[widths],
                         janssen_stress(m, seeds_of_it.front().width, top), m.density * top, m.ratio, m.friction);
  }
  write_report("janssen.csv", table);
  // The load still grows from two widths to four, hardly from six to eight, and is far from the weight.
  EXPECT_GT(load[4], 1.2 * load[2]);
  EXPECT_LT(load[8], 1.05 * load[6]);
  EXPECT_LT(load[8], 0.5 * m.density * median(tallest, [](const Column& c) { return c.top; }));
  EXPECT_GT(m.friction, 0.1);
  EXPECT_LE(m.friction, 0.5);
}

}  // namespace
}  // namespace vibrosow
