#include "agronomy/sowing_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <tuple>

#include "scene/accuracy_level.hpp"
#include "scene/input_error.hpp"
#include "scene/seed_lot.hpp"

namespace vibrosow {
namespace {

constexpr double width_step = 0.5e-3, amplitude_step = 0.1e-3;  // m
constexpr HolesForRows feeds[] = {{1, 4}, {1, 3}, {1, 2}, {1, 1}, {2, 1}, {3, 1}};

/// From end to end along x, y and z, the longest first.
std::array<double, 3> measures(const std::vector<ClumpDisc>& discs) {
  std::array<double, 3> low{}, high{};
  for (const ClumpDisc& disc : discs) {
    const std::array<double, 3> centre{disc.x, disc.y, disc.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], centre[k] - disc.radius);
      high[k] = std::max(high[k], centre[k] + disc.radius);
    }
  }
  std::array<double, 3> result{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::ranges::sort(result, std::greater());
  return result;
}

/// Of the ball of a volume, m.
double diameter_of(double volume) {
  return std::cbrt(6 / std::numbers::pi * volume);
}

double aspect_of(const SeedLot& lot) {
  if (lot.shape != Shape::clump) return 1;
  const std::array<double, 3> long_first = measures(lot.discs);
  return long_first[0] / long_first[1];
}

/// Looks up what one hole gives for a task; speeds and times over sqrt(g d) and sqrt(d / g).
class Search {
 public:
  Search(const SowingTask& task, const HoleTable& table, const ShakerLimits& limits)
      : task_(task),
        table_(table),
        diameter_(task.seed.diameter),
        amplitude_(std::round(table.amplitude() * diameter_ / amplitude_step) * amplitude_step),
        needed_(task.row_seed_rate() * std::sqrt(diameter_ / standard_gravity)) {
    amplitude_ = std::max(amplitude_, amplitude_step);
    const Span within{speed_of(limits.least_frequency), speed_of(limits.most_frequency)};
    speeds_ = table.speed_steps(task.seed.aspect, within);
  }

  std::vector<PlannedLayout> layouts() {
    std::vector<PlannedLayout> found;
    for (const HolesForRows& feed : feeds) {
      if (task_.rows.value_or(0) % feed.rows != 0) continue;
      for (const double depth : depths())
        for (const double width : widths()) add_layouts(feed, width, depth, found);
    }
    return found;
  }

  NearestChange change() const {
    NearestChange change;
    change.kept_open = narrowest(kept_open_from);
    change.rarely_clogs = narrowest(rarely_clogs_from);
    change.least_share = least_share_;
    change.most_share = most_share_;
    return change;
  }

 private:
  double speed_of(double frequency) const {
    return 2 * std::numbers::pi * frequency * amplitude_ / std::sqrt(standard_gravity * diameter_);
  }
  double frequency_of(double peak_speed) const {
    return peak_speed * std::sqrt(standard_gravity * diameter_) / (2 * std::numbers::pi * amplitude_);
  }

  std::array<double, 2> depths() const {
    const Span depths = table_.depths(task_.seed.aspect);
    return {depths.least, depths.most};
  }

  std::vector<double> widths() const {
    const Span over_d = table_.widths(task_.seed.aspect);
    std::vector<double> widths;
    for (auto step = static_cast<std::int64_t>(std::ceil(over_d.least * diameter_ / width_step));; ++step) {
      const double width = static_cast<double>(step) * width_step;
      if (!over_d.holds(width / diameter_)) return widths;
      widths.push_back(width);
    }
  }

  /// The places asked for lie within the table.
  HoleEstimate estimate(double width_over_d, double depth, double peak_speed) const {
    return table_.at({task_.seed.aspect, width_over_d, peak_speed, depth}).value();
  }

  std::vector<double> outflows(double width_over_d, double depth) const {
    std::vector<double> outflows;
    for (const double speed : speeds_) outflows.push_back(estimate(width_over_d, depth, speed).outflow);
    return outflows;
  }

  void add_layouts(const HolesForRows& feed, double width, double depth, std::vector<PlannedLayout>& found) {
    const double wanted = needed_ * feed.rows / feed.holes;
    const std::vector<double> given = outflows(width / diameter_, depth);
    for (const double outflow : given) {
      least_share_ = least_share_ > 0 ? std::min(least_share_, outflow / wanted) : outflow / wanted;
      most_share_ = std::max(most_share_, outflow / wanted);
    }
    for (std::size_t k = 0; k + 1 < given.size(); ++k) {
      const bool rises = given[k] <= wanted && wanted < given[k + 1];
      const bool falls = given[k] >= wanted && wanted > given[k + 1];
      if (!rises && !falls) continue;
      PlannedLayout layout;
      layout.feed = feed;
      layout.width = width;
      layout.width_over_d = width / diameter_;
      layout.width_over_largest = width / task_.seed.largest_diameter();
      layout.depth_over_d = depth;
      layout.peak_speed = table_.peak_speed_giving(wanted, {task_.seed.aspect, layout.width_over_d, 0, depth},
                                                   speeds_[k], speeds_[k + 1]);
      layout.frequency = frequency_of(layout.peak_speed);
      layout.amplitude = amplitude_;
      layout.estimate = estimate(layout.width_over_d, depth, layout.peak_speed);
      layout.interpolation = table_.interpolation_error(task_.seed.aspect, layout.width_over_d, layout.peak_speed);
      layout.more_by_faster = rises;
      layout.speeds = speeds_kept(given, k, wanted);
      found.push_back(layout);
    }
  }

  /// As far as the outflow goes on rising, or falling, on both sides of a step: beyond, one would turn the frequency up
  /// to sow less.
  Span speeds_kept(const std::vector<double>& given, std::size_t step, double wanted) const {
    const bool rises = given[step] < given[step + 1];
    std::size_t first = step, last = step + 1;
    while (first > 0 && (given[first - 1] < given[first]) == rises) --first;
    while (last + 1 < given.size() && (given[last] < given[last + 1]) == rises) ++last;
    const double low = std::min(given[first], given[last]), high = std::max(given[first], given[last]);
    return {task_.pace.speed * low / wanted, task_.pace.speed * high / wanted};
  }

  /// Of holes of so many seeds and more.
  std::optional<NearestChange::WiderHole> narrowest(double width_over_d) const {
    for (const double width : widths()) {
      if (width / task_.seed.largest_diameter() < width_over_d || speeds_.empty()) continue;
      double least = 0;
      for (const double depth : depths())
        for (const double outflow : outflows(width / diameter_, depth))
          least = least > 0 ? std::min(least, outflow) : outflow;
      return NearestChange::WiderHole{width, static_cast<int>(std::min(std::ceil(least / needed_), 1e9))};
    }
    return std::nullopt;
  }

  const SowingTask& task_;
  const HoleTable& table_;
  double diameter_, amplitude_;  // m
  double needed_;                // by a row, seeds in sqrt(d / g)
  std::vector<double> speeds_;   // between which outflows bend nowhere
  double least_share_ = 0, most_share_ = 0;
};

/// By how much the rate can be turned, the lesser of up and down.
double reserve(const PlannedLayout& layout, double speed) {
  return std::min(layout.speeds.most / speed, speed / layout.speeds.least);
}

}  // namespace

SeedLot of_mass(SeedLot lot, double mass) {
  if (lot.sizes.kind != SizeDistribution::Kind::single)
    throw InputError(
        fmt::format("{}: its seeds have sizes; another thousand grain mass is for seeds of one size", lot.name));
  const double factor = std::cbrt(mass / lot.mass);
  lot.diameter *= factor;
  for (ClumpDisc& disc : lot.discs) {
    disc.x *= factor, disc.y *= factor, disc.z *= factor, disc.radius *= factor;
  }
  for (double* gyration2 : {&lot.gyration2, &lot.gyration2_x, &lot.gyration2_y}) *gyration2 *= factor * factor;
  lot.mass = mass;
  return lot;
}

double mean_volume(const SeedLot& lot) {
  return (lot.shape == Shape::clump ? clump_volume(lot) : std::numbers::pi / 6 * std::pow(lot.diameter, 3)) *
         size_moment(lot, 3);
}

PlannedSeed planned_seed(const std::vector<SeedLot>& lots) {
  PlannedSeed seed;
  double volume = 0;  // m3, mean
  for (const SeedLot& lot : lots) {
    const double of_lot = mean_volume(lot);
    volume += lot.number_fraction * of_lot;
    seed.mass += lot.number_fraction * mean_mass(lot);
    seed.largest = std::max(seed.largest, diameter_of(of_lot));
  }
  seed.diameter = diameter_of(volume);
  seed.aspect = 0;
  for (const SeedLot& lot : lots) seed.aspect += lot.number_fraction * mean_volume(lot) / volume * aspect_of(lot);
  return seed;
}

double SownLot::seeds_per_area() const {
  return seeds_of_mass(sowing_rate, mean_mass(lot));
}

void share_out(std::vector<SownLot>& sown) {
  double all = 0;
  for (const SownLot& one : sown) all += one.seeds_per_area();
  for (SownLot& one : sown) one.lot.number_fraction = one.seeds_per_area() / all;
}

HoleClass hole_class(double width_over_d) {
  if (width_over_d >= rarely_clogs_from) return HoleClass::rarely_clogs;
  return width_over_d >= kept_open_from ? HoleClass::kept_open : HoleClass::clogs;
}

double softness_error(double aspect) {
  return accuracy_levels.front().error(Space::three_dimensional, aspect > 1);  // softer than the table's seeds
}

double tolerance_deviation(const BuildSlopes& slopes, const BuildTolerance& tolerance) {
  return std::hypot(slopes.width * tolerance.hole_width, slopes.amplitude * tolerance.amplitude) / normal_95;
}

PredictionError table_error(const HoleTable& table, const HoleConditions& conditions, double diameter,
                            const ModelError& model, const BuildTolerance& tolerance) {
  const HoleTable::Slopes slopes = table.slopes(conditions);
  const double interpolation = table.interpolation_error(conditions.aspect, conditions.width, conditions.peak_speed);
  return {
      .chance = table.at(conditions).value().chance / normal_95,
      .numerics = std::hypot(std::hypot(interpolation, softness_error(conditions.aspect)) / normal_95,
                             table.multiplied_by().deviation),
      .tolerance = tolerance_deviation({slopes.width / (conditions.width * diameter), slopes.peak_speed}, tolerance),
      .model = model,
      .setting = table.factor_spread(kept_open_from)};
}

double SowingPlan::unknown_to_table(const PlannedLayout& layout) const {
  return std::hypot(layout.estimate.chance, layout.interpolation) + softness;
}

SowingPlan plan_sowing(const SowingTask& task, const HoleTable& table, const ModelError& model,
                       const ShakerLimits& limits) {
  const Span aspects = table.aspects();
  if (!aspects.holds(task.seed.aspect)) {
    const std::string known = aspects.most > 1 ? fmt::format("seeds of {:g} to {:g} times", aspects.least, aspects.most)
                                               : std::string("balls alone");
    throw InputError(
        fmt::format("its seeds are {:.3g} times as long as wide; the table of one hole knows {}, and is not "
                    "stretched",
                    task.seed.aspect, known));
  }
  Search search(task, table, limits);
  SowingPlan plan;
  plan.task = task;
  plan.layouts = search.layouts();
  plan.change = search.change();
  plan.amplitude_over_d = table.amplitude();
  plan.table_times = std::exp(table.multiplied_by().log);
  plan.softness = softness_error(task.seed.aspect);
  plan.too_uncertain = std::erase_if(
      plan.layouts, [&](const PlannedLayout& layout) { return plan.unknown_to_table(layout) > most_uncertain; });
  for (PlannedLayout& layout : plan.layouts)
    layout.error = table_error(table, {task.seed.aspect, layout.width_over_d, layout.peak_speed, layout.depth_over_d},
                               task.seed.diameter, model);
  std::ranges::sort(plan.layouts, {}, [&](const PlannedLayout& layout) {
    const bool goes_by_largest = task.seed.has_larger() && layout.risk() == HoleClass::clogs;
    return std::tuple(layout.risk(), goes_by_largest ? -layout.width_over_largest : 0.0, layout.estimate.stood_still,
                      !layout.reaches_working_speeds(), -reserve(layout, task.pace.speed), layout.feed.holes,
                      -layout.feed.rows, layout.width, layout.depth_over_d, layout.frequency);
  });
  return plan;
}

}  // namespace vibrosow
