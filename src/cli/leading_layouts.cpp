#include "cli/leading_layouts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outflow/figures.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {

void LeadingLayouts::add(const WantedRun& wanted, const Run& run) {
  if (run.status == RunStatus::finished) runs_[wanted.layout].push_back(measure_outflow(*wanted.scene, run));
}

std::string LeadingLayouts::text() const {
  struct Even {
    int layout;
    MeanWithInterval raw_cv;  // %
  };
  std::vector<Even> known;
  for (const auto& [layout, outflows] : runs_) {
    std::vector<double> values;
    for (const Outflow& outflow : outflows)
      if (outflow.evenness) values.push_back(100 * outflow.evenness->raw_cv);
    if (values.size() >= 2) known.push_back({layout, mean_with_interval(values)});
  }
  std::ranges::stable_sort(known, {}, [](const Even& even) { return even.raw_cv.mean; });
  std::string text;
  for (const Even& even : known) {
    const bool first = text.empty();
    text += fmt::format("{}{}: {} +- {}", first ? "CV of layout " : ", ", even.layout, to_digits(even.raw_cv.mean, 2),
                        to_digits(even.raw_cv.half_width_95.value(), 2));
    if (!first) break;
  }
  return text.empty() ? text : text + " %";
}

}  // namespace vibrosow
