#include "optimise/goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "input/wording.hpp"
#include "scene/input_error.hpp"
#include "scene/measuring_window.hpp"
#include "scene/spaces.hpp"
#include "scene/trimmed.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

constexpr std::array table = {
    Goal{"unevenness", "CV of a run", "run_cv_percent", false,
         "coefficient of variation between the holes of one run, chance included, least", "one hole has no unevenness"},
    Goal{"instability", "instability", "instability_cv_percent", false,
         "of the whole outflow over about ten parts of the window, least",
         "its window has fewer than two periods of the drive, or it has no seeds"},
    Goal{"pause", "longest pause", "longest_pause_s", false, "longest time without a seed, least", "it has no pause"},
    Goal{"rate", "rate", "rate_g_per_s", true, "mass flow, most", "it has no rate"},
    Goal{"spilled", "spilled", "spilled_percent", false, "seeds that left over the rim, least", "nothing left it"},
};

constexpr std::string_view rate = "rate", spilled = "spilled", unsteady = "instability";
constexpr Goal rate_of_tray{rate, "rate of the tray", "tray_rate_g_per_s", true, "mass flow, most", "it has no rate"};

std::optional<double> finite(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

template <class Of>
auto least_and_most(const std::vector<Scene>& scenes, Of of) {
  std::vector<decltype(of(scenes.front()))> values;
  for (const Scene& scene : scenes) values.push_back(of(scene));
  const auto [least, most] = std::ranges::minmax_element(values);
  return std::pair(*least, *most);
}

/// In a longer window a pause may be longer, and chance evens out more.
void check_windows_alike(const Goal& goal, const std::vector<Scene>& scenes) {
  constexpr double alike = 1.05;
  const auto window = [](const Scene& scene) { return scene.run.duration - scene.run.measure_from; };
  const auto [shortest, longest] = least_and_most(scenes, window);
  if (longest <= alike * shortest) return;
  throw InputError(
      fmt::format("the goal {}: it depends on how long is measured, and layouts measure from {:.3g} to {:.3g} s",
                  goal.name, shortest, longest));
}

/// Chance makes the CV of more parts larger, in the measure of the root of their number.
void check_parts_alike(const Goal& goal, const std::vector<Scene>& scenes) {
  constexpr double alike = 1.5;
  const auto parts = [](const Scene& scene) {
    return std::max<std::ptrdiff_t>(0, std::ssize(instability_ends(measuring_window(scene))) - 1);
  };
  const auto [fewest, most] = least_and_most(scenes, parts);
  if (fewest > 0 && static_cast<double>(most) <= alike * static_cast<double>(fewest)) return;
  throw InputError(fmt::format(
      "the goal {}: it is of parts of whole periods of the drive, and layouts' windows have {} to {} of them; measure "
      "over twenty periods or more",
      goal.name, fewest, most));
}

struct Rate {
  bool is_of_seeds;
  double value;  // SI
};

Rate read_rate(std::string_view text) {
  const Quantity quantity = split_quantity(text);
  if (quantity.unit.starts_with("seeds")) return {true, in_si(quantity, Dimension::seed_rate)};
  return {false, in_si(quantity, Dimension::mass_rate)};
}

}  // namespace

std::optional<double> Goal::of(const Outflow& outflow) const {
  const auto value = finite(metric_named(metric).of({outflow}));
  return value && is_most ? -*value : value;
}

std::span<const Goal> goals() {
  return table;
}

const Goal& goal_named(std::string_view name) {
  if (name == "evenness") name = "unevenness";  // what it was called
  const auto found = std::ranges::find(table, name, &Goal::name);
  if (found != table.end()) return *found;
  std::vector<std::string> names;
  std::string list;
  for (const Goal& goal : table) {
    names.emplace_back(goal.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  throw InputError(fmt::format("--goal: \"{}\" is none of {}{}", shortened(name), list, did_you_mean(name, names)));
}

const Goal& goal_between(const Goal& goal, const std::vector<Scene>& scenes) {
  if (scenes.empty()) return goal;
  if (goal.name != rate) {
    if (goal.name != spilled) check_windows_alike(goal, scenes);
    if (goal.name == unsteady) check_parts_alike(goal, scenes);
    return goal;
  }
  const auto slice = [](const Scene& scene) {
    return scene.space == Space::two_dimensional ? std::pair(slice_thickness(scene.lots), slices_of_tray(scene))
                                                 : std::pair(0.0, std::optional(1.0));
  };
  const auto is_like_the_first = [&, first = slice(scenes.front())](const Scene& scene) {
    return slice(scene) == first;
  };
  if (std::ranges::all_of(scenes, is_like_the_first)) return goal;
  if (std::ranges::all_of(scenes, [&](const Scene& scene) { return slice(scene).second.has_value(); }))
    return rate_of_tray;
  throw InputError("the goal rate: 2D slices of these layouts are of other thickness, and a tray.depth is missing");
}

const Metric& rate_metric(const std::optional<WantedRate>& wanted) {
  if (!wanted) return metric_named("rate_g_per_s");
  return metric_named(wanted->is_of_seeds ? "tray_seeds_per_s" : "tray_rate_g_per_s");
}

std::optional<double> rate_as_wanted(const WantedRate& wanted, const Outflow& outflow) {
  return finite(rate_metric(wanted).of({outflow}));
}

WantedRate read_wanted_rate(const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return InputError(
        fmt::format("--rate: \"{}\"{}; expected is a rate of the tray such as \"43 seeds/s +- 5 %\" or "
                    "\"12 g/min +- 5 %\"",
                    shortened(text), why));
  };
  const auto [sign, length] = find_plus_minus(text);
  if (sign == std::string::npos) throw wrong(" has no tolerance, such as +- 5 %");
  const std::string_view whole = text, of = trimmed(whole.substr(0, sign)), by = trimmed(whole.substr(sign + length));
  try {
    const Rate stated = read_rate(of);
    Rate off{stated.is_of_seeds, 0};
    if (by.ends_with('%'))
      off.value = stated.value * parse_quantity(by, Dimension::fraction);
    else
      off = read_rate(by);
    if (off.is_of_seeds != stated.is_of_seeds) throw wrong(" has two kinds of rates");
    if (!(stated.value > 0 && off.value > 0 && off.value < stated.value)) throw wrong(" leaves no band above 0");
    if (stated.value + off.value > most_wanted_rate) throw wrong(" is more than a tray can give");
    return {stated.is_of_seeds, stated.value - off.value, stated.value + off.value};
  } catch (const UnitError& error) {
    throw wrong(fmt::format(": {}", error.what()));
  }
}

}  // namespace vibrosow
