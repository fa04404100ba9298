#include "calibration/repose_atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "input/read_scene.hpp"
#include "input/source_files.hpp"
#include "scene/input_error.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

MeanAndScatter mean_and_scatter(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  if (values.empty()) return {};
  double mean = 0, square = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) square += (value - mean) * (value - mean);
  return {mean, values.size() > 1 ? std::sqrt(square / (count - 1)) : 0};
}

using GridPlace = std::tuple<double, double, double>;

GridPlace place_of(const AtlasPoint& point) {
  return {point.aspect_ratio, point.friction, point.rolling_friction};
}

std::vector<double> axis(const std::vector<AtlasPoint>& points, double AtlasPoint::*coordinate) {
  std::vector<double> values;
  for (const AtlasPoint& point : points) values.push_back(point.*coordinate);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// A value between two neighbours of an axis: the lower one's index and the share of the upper one.
struct Between {
  std::size_t lower, upper;
  double share;
};

Between between(const std::vector<double>& axis, double value, const char* what) {
  if (!(value >= axis.front() && value <= axis.back()))
    throw std::out_of_range(
        fmt::format("{} {:g} is outside the atlas, {:g} to {:g}", what, value, axis.front(), axis.back()));
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(axis, value) - axis.begin());
  const std::size_t upper = std::min(above, axis.size() - 1), lower = upper == 0 ? 0 : upper - 1;
  const double share = upper == lower ? 0 : (value - axis[lower]) / (axis[upper] - axis[lower]);
  return {lower, upper, share};
}

AtlasMetric mean_with_error(const MeanAndScatter& metric, int runs) {
  return {metric.mean, metric.scatter / std::sqrt(static_cast<double>(runs))};
}

/// Adds a corner of the grid by its weight; its error counts as if it were that of all.
void add(AtlasMetric& sum, const AtlasMetric& corner, double weight) {
  sum.mean += weight * corner.mean;
  sum.error += weight * corner.error;
}

// As a file.

/// Values reach from `least` to `most`.
struct Column {
  const char* name;
  double least, most;
  double (*get)(const AtlasPoint&);
  void (*set)(AtlasPoint&, double);
};

constexpr std::array columns = {
    Column{"aspect_ratio", 1, 20, [](const AtlasPoint& p) { return p.aspect_ratio; },
           [](AtlasPoint& p, double v) { p.aspect_ratio = v; }},
    Column{"friction", 0, 2, [](const AtlasPoint& p) { return p.friction; },
           [](AtlasPoint& p, double v) { p.friction = v; }},
    Column{"rolling_friction", 0, 2, [](const AtlasPoint& p) { return p.rolling_friction; },
           [](AtlasPoint& p, double v) { p.rolling_friction = v; }},
    Column{"runs", 0, 1e+06, [](const AtlasPoint& p) { return static_cast<double>(p.runs); },
           [](AtlasPoint& p, double v) { p.runs = static_cast<int>(v); }},
    Column{"clogged", 0, 1e+06, [](const AtlasPoint& p) { return static_cast<double>(p.clogged); },
           [](AtlasPoint& p, double v) { p.clogged = static_cast<int>(v); }},
    Column{"angle_degree", 0, 90, [](const AtlasPoint& p) { return p.angle.mean / degree; },
           [](AtlasPoint& p, double v) { p.angle.mean = v * degree; }},
    Column{"angle_sd_degree", 0, 90, [](const AtlasPoint& p) { return p.angle.scatter / degree; },
           [](AtlasPoint& p, double v) { p.angle.scatter = v * degree; }},
    Column{"packing", 0.01, 1, [](const AtlasPoint& p) { return p.packing.mean; },
           [](AtlasPoint& p, double v) { p.packing.mean = v; }},
    Column{"packing_sd", 0, 1, [](const AtlasPoint& p) { return p.packing.scatter; },
           [](AtlasPoint& p, double v) { p.packing.scatter = v; }},
    Column{"discharge", 1e-06, 1e+06, [](const AtlasPoint& p) { return p.discharge.mean; },
           [](AtlasPoint& p, double v) { p.discharge.mean = v; }},
    Column{"discharge_sd", 0, 1e+06, [](const AtlasPoint& p) { return p.discharge.scatter; },
           [](AtlasPoint& p, double v) { p.discharge.scatter = v; }},
};

std::size_t index_of(const CsvLines& lines, const char* name) {
  const auto found = std::ranges::find(lines.header.fields, name);
  if (found == lines.header.fields.end())
    throw InputError(fmt::format("{}:{}: there is no column {}", lines.file, lines.header.line, name));
  return static_cast<std::size_t>(found - lines.header.fields.begin());
}

}  // namespace

ReposeAtlas::ReposeAtlas(const std::vector<AtlasPoint>& points)
    : aspect_ratios_(axis(points, &AtlasPoint::aspect_ratio)),
      frictions_(axis(points, &AtlasPoint::friction)),
      rolling_frictions_(axis(points, &AtlasPoint::rolling_friction)) {
  std::map<GridPlace, AtlasPoint> by_place;
  for (const AtlasPoint& point : points) by_place[place_of(point)] = point;
  for (const double aspect_ratio : aspect_ratios_)
    for (const double friction : frictions_)
      for (const double rolling : rolling_frictions_) {
        const auto point = by_place.find({aspect_ratio, friction, rolling});
        const auto fault = [&](const char* what) {
          return InputError(fmt::format("atlas: aspect ratio {:g}, friction {:g}, rolling friction {:g}: {}",
                                        aspect_ratio, friction, rolling, what));
        };
        if (point == by_place.end()) throw fault("is missing");
        if (point->second.runs < 2) throw fault("has less than two runs that drained");
        points_.push_back(point->second);
      }
}

int ReposeAtlas::runs() const {
  int runs = 0;
  for (const AtlasPoint& point : points_) runs += point.runs + point.clogged;
  return runs;
}

AtlasMetrics ReposeAtlas::at(double aspect_ratio, double friction, double rolling_friction) const {
  const Between a = between(aspect_ratios_, aspect_ratio, "aspect ratio");
  const Between f = between(frictions_, friction, "friction");
  const Between r = between(rolling_frictions_, rolling_friction, "rolling friction");
  AtlasMetrics metrics{};
  for (const auto& [i, weight_a] : {std::pair(a.lower, 1 - a.share), {a.upper, a.share}})
    for (const auto& [j, weight_f] : {std::pair(f.lower, 1 - f.share), {f.upper, f.share}})
      for (const auto& [k, weight_r] : {std::pair(r.lower, 1 - r.share), {r.upper, r.share}}) {
        const AtlasPoint& point = points_[(i * frictions_.size() + j) * rolling_frictions_.size() + k];
        const double weight = weight_a * weight_f * weight_r;
        if (weight == 0) continue;
        add(metrics.angle, mean_with_error(point.angle, point.runs), weight);
        add(metrics.packing, mean_with_error(point.packing, point.runs + point.clogged), weight);
        add(metrics.discharge, mean_with_error(point.discharge, point.runs), weight);
      }
  return metrics;
}

AtlasPoint atlas_point(const Scene& scene, const std::vector<ReposeMetrics>& runs) {
  std::vector<double> angles, packings, discharges;
  for (const ReposeMetrics& run : runs) {
    if (run.angle) angles.push_back(*run.angle);
    if (run.packing) packings.push_back(*run.packing);
    if (run.discharge) discharges.push_back(*run.discharge);
  }
  AtlasPoint point;
  point.aspect_ratio = std::round(100 * aspect_ratio(scene)) / 100;  // drawings are in micrometres
  point.friction = scene.contact.seed.friction;
  point.rolling_friction = scene.contact.seed.rolling_friction;
  point.runs = static_cast<int>(angles.size());
  point.clogged = static_cast<int>(runs.size() - angles.size());
  point.angle = mean_and_scatter(angles);
  point.packing = mean_and_scatter(packings);
  point.discharge = mean_and_scatter(discharges);
  return point;
}

std::string atlas_csv(const std::vector<AtlasPoint>& points) {
  std::string text;
  for (const Column& column : columns) text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
  text += '\n';
  for (const AtlasPoint& point : points) {
    std::string row;
    for (const Column& column : columns) row += fmt::format("{}{:.4g}", row.empty() ? "" : ",", column.get(point));
    text += row + '\n';
  }
  return text;
}

std::vector<AtlasPoint> read_atlas_points(const std::filesystem::path& file) {
  SourceFiles files;
  const CsvLines& lines = files.csv(file);
  std::array<std::size_t, columns.size()> places{};
  for (std::size_t c = 0; c < columns.size(); ++c) places[c] = index_of(lines, columns[c].name);
  std::vector<AtlasPoint> points;
  for (const CsvLines::Row& row : lines.rows) {
    AtlasPoint& point = points.emplace_back();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string& field = row.fields[places[c]];
      const auto number = csv_number(field, lines.decimal_comma);
      if (!number || *number < columns[c].least || *number > columns[c].most)
        throw InputError(fmt::format("{}:{}: {}: \"{}\" is not a number from {:g} to {:g}", lines.file, row.line,
                                     columns[c].name, field, columns[c].least, columns[c].most));
      columns[c].set(point, *number);
    }
  }
  return points;
}

namespace {

/// The plane's figures of a material in 3D. Throws InputError where the atlas does not reach it.
AtlasMetrics beneath(const ReposeAtlas& plane, const AtlasPoint& ball) {
  try {
    return plane.at(ball.aspect_ratio, ball.friction, ball.rolling_friction);
  } catch (const std::out_of_range& fault) {
    throw InputError(fmt::format("atlas: a material in 3D: {}", fault.what()));
  }
}

}  // namespace

PlaneToSpace plane_to_space(const ReposeAtlas& plane, const std::vector<AtlasPoint>& space) {
  if (space.size() < 3) throw InputError(fmt::format("atlas: {} materials in 3D; at least 3 are needed", space.size()));
  std::vector<double> offsets, packings, discharges;
  for (const AtlasPoint& ball : space) {
    const AtlasMetrics flat = beneath(plane, ball);
    offsets.push_back(ball.angle.mean - flat.angle.mean);
    packings.push_back(ball.packing.mean / flat.packing.mean);
    discharges.push_back(ball.discharge.mean / flat.discharge.mean);
  }
  return {mean_and_scatter(offsets), mean_and_scatter(packings), mean_and_scatter(discharges),
          static_cast<int>(space.size()), false};
}

ShippedAtlas shipped_atlas() {
  const std::filesystem::path folder = data_directory() / "models" / "atlas";
  ReposeAtlas atlas(read_atlas_points(folder / "atlas.csv"));
  const PlaneToSpace to_space = plane_to_space(atlas, read_atlas_points(folder / "space.csv"));
  return {std::move(atlas), to_space};
}

}  // namespace vibrosow
