#include "optimise/front_goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/wording.hpp"
#include "outflow/metrics.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

std::vector<FrontGoal> make_goals() {
  using Kind = FrontGoal::Kind;
  std::vector<FrontGoal> all;
  for (const Goal& goal : goals()) {
    const Metric& metric = metric_named(goal.metric);
    all.push_back(
        {Kind::metric, goal.name, goal.words, metric.name, metric.unit, metric.unit_size, goal.description, &goal});
  }
  all.push_back({Kind::rate_error, "rate_error", "rate error", "rate_error_percent", "%", 1e-2,
                 "distance of the mean rate from the wanted one, over the wanted one, least"});
  all.push_back({Kind::power, "power", "power", "power_W_per_kg", "W/kg", 1,
                 "greatest power of the drive over the mass that it shakes, (2 pi f)^3 A^2 / 2, least"});
  all.push_back({Kind::frequency_sensitivity,
                 "frequency_sensitivity",
                 "frequency sensitivity",
                 "frequency_sensitivity",
                 "",
                 1,
                 "relative change of the rate over that of the frequency, which is run 5 % higher and lower, least",
                 nullptr,
                 {Variant::faster, Variant::slower}});
  all.push_back({Kind::fill_sensitivity,
                 "fill_sensitivity",
                 "fill sensitivity",
                 "fill_sensitivity",
                 "",
                 1,
                 "relative change of the rate over that of the tray's fill, which is run 20 % lower, least",
                 nullptr,
                 {Variant::less_fill}});
  return all;
}

const HarmonicMotion* harmonic(const Scene& scene) {
  return scene.tray.motion ? std::get_if<HarmonicMotion>(&*scene.tray.motion) : nullptr;
}

}  // namespace

Scene variant_of(Scene scene, Variant variant) {
  if (variant == Variant::less_fill) {
    if (!scene.tray.fill || scene.tray.fill->count < 5)
      throw InputError("--goals: fill_sensitivity takes a tray with a fill (tray.fill)");
    scene.tray.fill->count = static_cast<int>(std::lround((1 - fill_change) * scene.tray.fill->count));
  } else if (variant != Variant::as_it_is) {
    if (harmonic(scene) == nullptr)
      throw InputError(
          "--goals: frequency_sensitivity takes a tray that is shaken by one harmonic motion (tray.motion)");
    std::get<HarmonicMotion>(*scene.tray.motion).frequency *=
        variant == Variant::faster ? 1 + frequency_change : 1 - frequency_change;
  }
  return scene;
}

const std::vector<FrontGoal>& front_goals() {
  static const std::vector<FrontGoal> all = make_goals();
  return all;
}

std::vector<const FrontGoal*> read_front_goals(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::string list;
  for (const FrontGoal& goal : front_goals()) {
    known.emplace_back(goal.name);
    list += (list.empty() ? "" : ", ") + known.back();
  }
  std::vector<const FrontGoal*> chosen;
  for (const std::string& name : names) {
    const std::string_view now = name == "evenness" ? "unevenness" : std::string_view(name);  // what it was called
    const auto found = std::ranges::find(front_goals(), now, &FrontGoal::name);
    if (found == front_goals().end())
      throw InputError(
          fmt::format("--goals: \"{}\" is none of {}{}", shortened(name), list, did_you_mean(name, known)));
    if (std::ranges::find(chosen, &*found) != chosen.end())
      throw InputError(fmt::format("--goals: {} stands there twice", name));
    chosen.push_back(&*found);
  }
  return chosen;
}

double drive_power(const Scene& scene) {
  const HarmonicMotion* const motion = harmonic(scene);
  if (motion == nullptr)
    throw InputError("--goals: power takes a tray that is shaken by one harmonic motion (tray.motion)");
  return std::pow(2 * std::numbers::pi * motion->frequency, 3) * std::pow(motion->amplitude, 2) / 2;
}

}  // namespace vibrosow
