#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "outflow/metrics.hpp"
#include "scene/scene.hpp"
#include "storage/asked_question.hpp"

namespace vibrosow {

/// What layouts are compared by: a figure of each single run, of which the mean over runs is to be the least, or the
/// most.
struct Goal {
  std::string_view name;    // what a user says: "unevenness"
  std::string_view words;   // in a sentence: "CV of a run"
  std::string_view metric;  // its name
  bool is_most;
  std::string_view description;
  std::string_view if_none;  // said of a run without the figure
  /// SI, turned so that less is better; none where the run has no such figure.
  std::optional<double> of(const Outflow& outflow) const;
};

std::span<const Goal> goals();

/// Throws InputError with the list for a name that is none. "evenness" is the old name of "unevenness".
const Goal& goal_named(std::string_view name);

/// The goal as it compares these scenes. "rate" is of a slice in 2D; where slices are of other thickness or a tray
/// holds another number of them, it is of the whole tray. Throws InputError where that takes a tray.depth that is
/// missing, and for a goal that depends on how long is measured where these windows are unlike.
const Goal& goal_between(const Goal& goal, const std::vector<Scene>& scenes);
const Goal& goal_between(Goal&& goal, const std::vector<Scene>& scenes) = delete;  // what is returned would be gone

/// The figure that a rate is shown as: of the whole tray as it is wanted, or else rate_g_per_s.
const Metric& rate_metric(const std::optional<WantedRate>& wanted);

/// Of the whole tray, in the unit of the wanted one; none where the run has no such figure.
std::optional<double> rate_as_wanted(const WantedRate& wanted, const Outflow& outflow);

/// Reads "43 seeds/s +- 5 %", "0.19 g/s +- 0.01 g/s", "12 g/min +- 5 %", also with "±". Throws InputError with what
/// would be right.
WantedRate read_wanted_rate(const std::string& text);

}  // namespace vibrosow
