#include "accuracy/accuracy_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "scene/si_units.hpp"
#include "study/layout_doubts.hpp"

namespace vibrosow {
namespace {

/// By setting, then of the runs as a whole and of their scene, whose setting is 0.
std::vector<LayoutDoubts> doubts_of_runs(const std::vector<AccuracyRun>& runs, const Scene& scene) {
  constexpr double share = 0.5;  // of the median, below which a run is of another kind
  std::map<int, std::vector<const std::vector<Doubt>*>> of_settings;
  std::vector<double> rates;
  const std::string* reason = nullptr;
  for (const AccuracyRun& run : runs) {
    if (run.mass_rate) {
      rates.push_back(*run.mass_rate);
      of_settings[static_cast<int>(run.setting) + 1].push_back(&run.doubts);
    } else if (!reason) {
      reason = &run.refused;
    }
  }
  std::vector<LayoutDoubts> doubts;
  for (const auto& [setting, of_runs] : of_settings) doubts.push_back({setting, counted_doubts(of_runs)});
  std::vector<CountedDoubt> of_all = doubts_of_scene(scene);
  if (reason)
    of_all.push_back({DoubtKind::runs_left_out, 0, 0,
                      fmt::format("{} of the {} runs {} no rate: {}", runs.size() - rates.size(), runs.size(),
                                  runs.size() - rates.size() == 1 ? "has" : "have", *reason)});
  if (!rates.empty()) {
    std::ranges::sort(rates);
    const double median = rates[rates.size() / 2];
    const auto few = std::ranges::lower_bound(rates, share * median) - rates.begin();
    if (few > 0)
      of_all.push_back({DoubtKind::two_kinds_of_run, 0, 0,
                        fmt::format("{} of the {} runs with a rate passed less than half of what the median run did "
                                    "({:.4g} g/s), as where an outlet clogs: their mean is of two kinds of run",
                                    few, rates.size(), median / gram)});
  }
  doubts.push_back({0, std::move(of_all)});
  return doubts;
}

}  // namespace

std::vector<SharedDoubt> doubts_about(const AccuracyResult& result, const Scene& scene) {
  std::vector<LayoutDoubts> doubts = doubts_of_runs(result.runs, scene);
  std::vector<CountedDoubt>& of_all = doubts.back().doubts;
  const auto add = [&](DoubtKind kind, std::string text) { of_all.push_back({kind, 0, 0, std::move(text)}); };
  if (result.fit && !result.fit->fits())
    add(DoubtKind::errors_interact,
        fmt::format("these main effects do not account for the runs (so large a lack of fit has probability {:.2g}): "
                    "parts of a setting act on each other, and the limit is not shown to have been reached. The bands "
                    "allow for it",
                    *result.fit->lack_of_fit()));
  if (!result.fit)
    add(DoubtKind::no_limit,
        "errors are against the finest setting, which errs too: the runs do not determine the limit");
  if (result.depth)
    for (const auto& [space, of_space] : {std::pair("2D", &result.depth->doubts_2d), {"3D", &result.depth->doubts_3d}})
      for (const CountedDoubt& doubt : *of_space)
        add(doubt.kind, fmt::format("of the runs in {} for the error of the depth: {}", space, doubt_text(doubt)));
  if (scene.space == Space::two_dimensional && !result.depth)
    add(DoubtKind::depth_left_out, "running the tray in 2D is an error of its own, which is not in these");
  return shared_doubts(doubts);
}

}  // namespace vibrosow
