#include "cli/leading_layouts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outflow/outflow.hpp"
#include "outflow/statistics.hpp"
#include "report/number_text.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {

void LeadingLayouts::add(const WantedRun& wanted, const Run& run) {
  if (run.status != RunStatus::finished) return;
  if (const auto cv = measure_outflow(*wanted.scene, run).raw_cv) raw_cvs_[wanted.layout].push_back(100 * *cv);
}

std::string LeadingLayouts::text() const {
  struct Even {
    int layout;
    MeanWithInterval raw_cv;  // %
  };
  std::vector<Even> known;
  for (const auto& [layout, values] : raw_cvs_)
    if (values.size() >= 2) known.push_back({layout, mean_with_interval(values)});
  std::ranges::stable_sort(known, {}, [](const Even& even) { return even.raw_cv.mean; });
  std::string text;
  for (const Even& even : known) {
    const bool first = text.empty();
    text += fmt::format("{}{}: {}", first ? "CV of layout " : ", ", even.layout,
                        interval_text(even.raw_cv.mean, even.raw_cv.half_width_95));
    if (!first) break;
  }
  return text.empty() ? text : text + " %";
}

}  // namespace vibrosow
