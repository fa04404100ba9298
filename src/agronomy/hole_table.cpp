#include "agronomy/hole_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "agronomy/place_giving.hpp"
#include "agronomy/prediction_error.hpp"

namespace vibrosow {
namespace {

constexpr double beverloo = 2.5;  // power of the width, less some, with which the outflow grows

/// Along one axis of a grid: where the interpolation is linear.
double coordinate(std::size_t axis, double value) {
  return axis == 1 ? std::log(value) : value;
}

/// By which records are sorted.
std::tuple<double, double, double, double> place_of(const HoleRecord& record) {
  return {record.at.aspect, record.at.width, record.at.peak_speed, record.at.depth};
}

std::array<double, 3> axes_of(const HoleConditions& conditions) {
  return {conditions.width, conditions.peak_speed, conditions.depth};
}

/// How far `value` is between two neighbours, 0 to 1.
double part_of_way(std::size_t axis, double from, double value, double to) {
  return (coordinate(axis, value) - coordinate(axis, from)) / (coordinate(axis, to) - coordinate(axis, from));
}

std::vector<double> sorted_without_repeats(std::vector<double> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// 0 of none.
double mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// The lower neighbour's index of a value of an axis that holds it.
std::size_t lower_neighbour(const std::vector<double>& axis, double value) {
  const auto above = std::ranges::upper_bound(axis, value);
  const auto last_but_one = static_cast<std::ptrdiff_t>(axis.size()) - 2;
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - axis.begin() - 1, 0, last_but_one));
}

}  // namespace

HoleTable::HoleTable(std::vector<HoleRecord> records) : records_(std::move(records)) {
  std::ranges::sort(records_, {}, place_of);
  check();
  for (const HoleRecord& record : records_) shapes_.push_back(record.at.aspect);
  shapes_ = sorted_without_repeats(shapes_);
  for (const double aspect : shapes_) grids_.push_back(grid_of(aspect));
}

void HoleTable::check() const {
  if (records_.empty() || records_.front().at.aspect != 1)
    throw std::invalid_argument("there are no balls, which are of aspect 1");
  for (const HoleRecord& record : records_) {
    if (!(record.outflow > 0)) throw std::invalid_argument("an outflow is not positive");
    if (record.amplitude != amplitude()) throw std::invalid_argument("the amplitudes, over d, differ");
    if (record.contact != contact()) throw std::invalid_argument("the contacts differ");
  }
  for (std::size_t k = 1; k < records_.size(); ++k)
    if (place_of(records_[k]) == place_of(records_[k - 1]))
      throw std::invalid_argument("two rows are of the same conditions");
}

/// The grid of balls comes first: the others' factors ask for it.
HoleTable::Grid HoleTable::grid_of(double aspect) const {
  Grid grid;
  grid.of_balls = aspect == 1;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const HoleRecord& record = records_[i];
    if (record.at.aspect != aspect) continue;
    grid.records.push_back(i);
    grid.values.push_back(grid.of_balls ? std::pow(record.outflow, 1 / beverloo) : factor(record));
    for (std::size_t axis = 0; axis < 3; ++axis) grid.axes[axis].push_back(axes_of(record.at)[axis]);
  }
  std::size_t places = 1;
  for (std::vector<double>& axis : grid.axes) {
    axis = sorted_without_repeats(axis);
    if (axis.size() < 2) throw std::invalid_argument("there are fewer than two widths, speeds or depths of a shape");
    places *= axis.size();
  }
  if (grid.records.size() != places)
    throw std::invalid_argument(
        fmt::format("of aspect {:g} there are {} of the {} combinations of its widths, speeds and depths", aspect,
                    grid.records.size(), places));
  return grid;
}

/// Logarithm of what a longer seed's outflow is of that of balls.
double HoleTable::factor(const HoleRecord& record) const {
  const Grid& balls = grids_.front();
  const std::vector<Share> places = places_around(balls, record.at);
  if (places.empty()) throw std::invalid_argument("a longer seed's conditions lie outside those of balls");
  return std::log(record.outflow) - beverloo * std::log(value(balls, places));
}

HoleTable HoleTable::times(const ContactFactor& factor) const {
  std::vector<HoleRecord> records = records_;
  for (HoleRecord& record : records)
    for (double* outflow : {&record.outflow, &record.half_width_95}) *outflow *= std::exp(factor.log);
  HoleTable table(std::move(records));
  table.multiplied_by_ = {multiplied_by_.log + factor.log, std::hypot(multiplied_by_.deviation, factor.deviation)};
  return table;
}

Span HoleTable::aspects() const {
  return {shapes_.front(), shapes_.back()};
}

/// The shapes between which an aspect lies, one where it is a shape's own; none where it lies outside.
std::vector<HoleTable::Share> HoleTable::shapes_around(double aspect) const {
  if (!aspects().holds(aspect)) return {};
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(shapes_, aspect) - shapes_.begin());
  if (shapes_[above] == aspect) return {{above, 1}};
  const double way = (aspect - shapes_[above - 1]) / (shapes_[above] - shapes_[above - 1]);
  return {{above - 1, 1 - way}, {above, way}};
}

/// What all shapes that are asked for an aspect, balls among them, have in common.
Span HoleTable::span(double aspect, std::size_t axis) const {
  const std::vector<Share> shapes = shapes_around(aspect);
  if (shapes.empty()) throw std::invalid_argument(fmt::format("the table has no seeds of aspect {:g}", aspect));
  Span common{grids_.front().axes[axis].front(), grids_.front().axes[axis].back()};
  for (const Share& shape : shapes) {
    common.least = std::max(common.least, grids_[shape.index].axes[axis].front());
    common.most = std::min(common.most, grids_[shape.index].axes[axis].back());
  }
  return common;
}

std::vector<double> HoleTable::speed_steps(double aspect, const Span& limits) const {
  const Span common = peak_speeds(aspect);
  std::vector<double> steps = grids_.front().axes[1];
  steps.insert(steps.end(), {limits.least, limits.most});
  for (const Share& shape : shapes_around(aspect)) {
    const std::vector<double>& own = grids_[shape.index].axes[1];
    steps.insert(steps.end(), own.begin(), own.end());
  }
  std::erase_if(steps, [&](double speed) { return !common.holds(speed) || !limits.holds(speed); });
  return sorted_without_repeats(steps);
}

/// None outside the grid.
std::vector<HoleTable::Share> HoleTable::places_around(const Grid& grid, const HoleConditions& conditions) {
  const std::array<double, 3> point = axes_of(conditions);
  std::array<std::size_t, 3> lower{};
  std::array<double, 3> way{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& values = grid.axes[axis];
    if (!Span{values.front(), values.back()}.holds(point[axis])) return {};
    lower[axis] = lower_neighbour(values, point[axis]);
    way[axis] = part_of_way(axis, values[lower[axis]], point[axis], values[lower[axis] + 1]);
  }
  std::vector<Share> places;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<std::size_t, 3> at = lower;
    double weight = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool is_upper = ((corner >> axis) & 1U) != 0;
      if (is_upper) ++at[axis];
      weight *= is_upper ? way[axis] : 1 - way[axis];
    }
    if (weight > 0) places.push_back({grid.place(at), weight});
  }
  return places;
}

double HoleTable::value(const Grid& grid, const std::vector<Share>& places) {
  double sum = 0;
  for (const Share& place : places) sum += place.weight * grid.values[place.index];
  return sum;
}

/// Makes what was seen of the holes that of the worst of the places.
void HoleTable::allow_for(const Grid& grid, const std::vector<Share>& places, HoleEstimate& estimate) const {
  for (const Share& place : places) {
    const HoleRecord& record = records_[grid.records[place.index]];
    estimate.stood_still = std::max(estimate.stood_still, record.stood_still);
    estimate.watched = std::min(estimate.watched, record.watched);
    if (record.dispersion) estimate.dispersion = std::max(estimate.dispersion.value_or(0), *record.dispersion);
  }
}

/// Adds, of each record, by how much the logarithm of what balls let through grows with that of its outflow, times
/// `weight`.
void HoleTable::add_balls(const std::vector<Share>& places, double weight, std::vector<double>& slopes) const {
  const Grid& balls = grids_.front();
  const double sum = value(balls, places);
  for (const Share& place : places)
    slopes[balls.records[place.index]] += weight * place.weight * balls.values[place.index] / sum;
}

/// Half width over the outflow, of records that err independently.
double HoleTable::chance(const std::vector<double>& slopes) const {
  double sum = 0;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const double part = slopes[i] * records_[i].half_width_95 / records_[i].outflow;
    sum += part * part;
  }
  return std::sqrt(sum);
}

std::optional<HoleEstimate> HoleTable::at(const HoleConditions& conditions) const {
  const std::vector<Share> shapes = shapes_around(conditions.aspect);
  const std::vector<Share> of_balls = places_around(grids_.front(), conditions);
  if (shapes.empty() || of_balls.empty()) return std::nullopt;
  HoleEstimate estimate;
  estimate.watched = std::numeric_limits<double>::infinity();
  std::vector<double> slopes(records_.size(), 0.0);
  add_balls(of_balls, 1, slopes);
  double factor = 0;
  for (const Share& shape : shapes) {
    const Grid& grid = grids_[shape.index];
    const std::vector<Share> places = places_around(grid, conditions);
    if (places.empty()) return std::nullopt;
    allow_for(grid, places, estimate);
    if (grid.of_balls) continue;
    factor += shape.weight * value(grid, places);
    for (const Share& place : places) {
      const std::size_t record = grid.records[place.index];
      const double weight = shape.weight * place.weight;
      slopes[record] += weight;
      add_balls(places_around(grids_.front(), records_[record].at), -weight, slopes);
    }
  }
  estimate.outflow = std::pow(value(grids_.front(), of_balls), beverloo) * std::exp(factor);
  estimate.chance = chance(slopes);
  return estimate;
}

double HoleTable::peak_speed_giving(double outflow, HoleConditions conditions, double from, double to) const {
  return place_giving(outflow, from, to, [&](double speed) {
    conditions.peak_speed = speed;
    return at(conditions).value().outflow;
  });
}

HoleTable::Slopes HoleTable::slopes(const HoleConditions& conditions) const {
  constexpr double step = 0.01;
  const auto slope = [&](double HoleConditions::*value, const Span& known) {
    HoleConditions less = conditions, more = conditions;
    less.*value = std::max(known.least, conditions.*value * (1 - step));
    more.*value = std::min(known.most, conditions.*value * (1 + step));
    return std::log(at(more).value().outflow / at(less).value().outflow) / std::log(more.*value / (less.*value));
  };
  return {slope(&HoleConditions::width, widths(conditions.aspect)),
          slope(&HoleConditions::peak_speed, peak_speeds(conditions.aspect))};
}

double HoleTable::factor_spread(double least_width) const {
  double sum = 0, groups = 0;
  for (const Grid& grid : grids_) {
    const std::size_t settings = grid.axes[1].size() * grid.axes[2].size();
    for (std::size_t width = 0; !grid.of_balls && width < grid.axes[0].size(); ++width) {
      if (grid.axes[0][width] < least_width) continue;
      double mean = 0, variance = 0, by_chance = 0;
      for (std::size_t k = 0; k < settings; ++k)
        mean += grid.values[width * settings + k] / static_cast<double>(settings);
      for (std::size_t k = 0; k < settings; ++k) {
        const std::size_t place = width * settings + k;
        const HoleConditions& at_place = records_[grid.records[place]].at;
        std::vector<double> slopes(records_.size(), 0.0);
        slopes[grid.records[place]] = 1;
        add_balls(places_around(grids_.front(), at_place), -1, slopes);
        variance += std::pow(grid.values[place] - mean, 2) / static_cast<double>(settings - 1);
        by_chance += std::pow(chance(slopes) / normal_95, 2) / static_cast<double>(settings);
      }
      sum += std::max(0.0, variance - by_chance);
      ++groups;
    }
  }
  return groups > 0 ? std::sqrt(sum / groups) : 0;
}

/// The first and the last of an axis' places to be looked at: those around a value; where they are to have neighbours
/// on both sides, the nearest that have.
std::pair<std::size_t, std::size_t> HoleTable::range_around(const std::vector<double>& steps, double value,
                                                            bool inner) {
  const std::size_t lower = lower_neighbour(steps, value), last = steps.size() - 1;
  if (!inner || last < 2) return {lower, lower + 1};
  return {std::clamp<std::size_t>(lower, 1, last - 1), std::clamp<std::size_t>(lower + 1, 1, last - 1)};
}

/// Of each place with a neighbour on either side of an axis, by how much these two miss the outflow's logarithm: places
/// of the widths and speeds around these.
std::vector<double> HoleTable::left_out(const Grid& grid, std::size_t axis, double width, double peak_speed) {
  const std::vector<double>& steps = grid.axes[axis];
  const auto [first_width, last_width] = range_around(grid.axes[0], width, axis == 0);
  const auto [first_speed, last_speed] = range_around(grid.axes[1], peak_speed, axis == 1);
  std::vector<double> errors;
  std::array<std::size_t, 3> at{};
  for (at[0] = first_width; at[0] <= last_width; ++at[0])
    for (at[1] = first_speed; at[1] <= last_speed; ++at[1])
      for (at[2] = 0; at[2] < grid.axes[2].size(); ++at[2]) {
        const std::size_t k = at[axis];
        if (k == 0 || k + 1 == steps.size()) continue;
        std::array<std::size_t, 3> before = at, after = at;
        --before[axis], ++after[axis];
        const double way = part_of_way(axis, steps[k - 1], steps[k], steps[k + 1]);
        const double own = grid.values[grid.place(at)];
        const double foretold = (1 - way) * grid.values[grid.place(before)] + way * grid.values[grid.place(after)];
        errors.push_back(grid.of_balls ? beverloo * std::log(foretold / own) : foretold - own);
      }
  return errors;
}

/// The same of the factors of each shape between two others, at its own places as far as these have them.
std::vector<double> HoleTable::shapes_left_out(double width, double peak_speed) const {
  std::vector<double> errors;
  for (std::size_t shape = 1; shape + 1 < shapes_.size(); ++shape) {
    const Grid &below = grids_[shape - 1], &own = grids_[shape], &above = grids_[shape + 1];
    const double way = (shapes_[shape] - shapes_[shape - 1]) / (shapes_[shape + 1] - shapes_[shape - 1]);
    for (const std::size_t place : places_beside(own, width, peak_speed)) {
      const HoleConditions& at = records_[own.records[place]].at;
      const std::vector<Share> before = places_around(below, at), after = places_around(above, at);
      if (before.empty() || after.empty()) continue;
      const double factor = below.of_balls ? 0 : value(below, before);  // balls let through what balls do
      errors.push_back((1 - way) * factor + way * value(above, after) - own.values[place]);
    }
  }
  return errors;
}

/// Of both widths and both speeds between which these lie, or are nearest to, in beds of every depth.
std::vector<std::size_t> HoleTable::places_beside(const Grid& grid, double width, double peak_speed) {
  const auto [first_width, last_width] = range_around(grid.axes[0], width, false);
  const auto [first_speed, last_speed] = range_around(grid.axes[1], peak_speed, false);
  std::vector<std::size_t> places;
  for (std::size_t w = first_width; w <= last_width; ++w)
    for (std::size_t v = first_speed; v <= last_speed; ++v)
      for (std::size_t depth = 0; depth < grid.axes[2].size(); ++depth) places.push_back(grid.place({w, v, depth}));
  return places;
}

double HoleTable::interpolation_error(double aspect, double width, double peak_speed) const {
  const std::vector<Share> shapes = shapes_around(aspect);
  double sum = 0;
  const auto add = [&](const Grid& grid) {
    for (const std::size_t axis : {0U, 1U}) sum += mean_square(left_out(grid, axis, width, peak_speed));
  };
  add(grids_.front());
  for (const Share& shape : shapes)
    if (!grids_[shape.index].of_balls) add(grids_[shape.index]);
  if (shapes.size() > 1) sum += mean_square(shapes_left_out(width, peak_speed));
  constexpr double within_a_gap = 0.25;
  return normal_95 * within_a_gap * std::sqrt(sum);
}

}  // namespace vibrosow
