#include "report/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/key_units.hpp"
#include "report/layout_text.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value, double unit) {
  return std::isfinite(value) ? Json(value / unit) : Json(nullptr);
}

}  // namespace

Json page_interval(const std::optional<MeanWithInterval>& value, double unit) {
  if (!value) return nullptr;
  return {{"mean", number(value->mean, unit)},
          {"half_width", value->half_width_95 ? number(*value->half_width_95, unit) : Json(nullptr)}};
}

Json page_of_study(std::string_view kind, const Study& study) {
  const bool plane = std::ranges::all_of(study.scenes, [](const Scene& one) { return one.space == Space::plane; });
  Json keys = Json::array();
  for (const std::string& key : study.keys) keys.push_back(condition_column(key));
  return {{"kind", kind},
          {"program", {{"name", "vibrosow"}, {"version", VIBROSOW_VERSION}}},
          {"title", study.title},
          {"space", plane ? "plane" : "three_dimensional"},
          {"keys", std::move(keys)}};
}

Json page_figure(const Figure& figure) {
  return {{"name", figure.name},
          {"heading", figure.heading},
          {"unit", figure.unit},
          {"description", figure.description},
          {"has_interval", !figure.pooled}};
}

Json page_layout(const Study& study, const Layout& layout, std::uint64_t first_random_seed, const Replays& replays) {
  Json values = Json::array();
  for (const std::string& key : study.keys) {
    const auto value = layout.values.find(key);
    values.push_back(value == layout.values.end() ? "" : value->second);
  }
  Json one = {{"number", layout.number},
              {"name", layout.name},
              {"described", described(study, layout)},
              {"values", std::move(values)},
              {"vessels", layout.scene ? page_vessels(study.scenes[*layout.scene]) : Json::array()}};
  if (layout.scene) one["command"] = run_command_of(study, layout, first_random_seed);
  if (const auto replay = replays.find(layout.number); replay != replays.end()) one["replay"] = replay->second;
  return one;
}

std::string page_timing(const SweepTiming& timing) {
  if (timing.runs == 0) return "";
  return fmt::format("The {} run{} of this command took {} s, up to {} side by side.", timing.runs,
                     timing.runs == 1 ? "" : "s", to_digits(timing.wall_time, 3), timing.jobs);
}

}  // namespace vibrosow
