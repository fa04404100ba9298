#include "calibration/calibration_runs.hpp"

#include <algorithm>
#include <cmath>

#include "study/comparison.hpp"

namespace vibrosow {
namespace {

/// Whether it speaks against a rate in the window, and not against a curve of all that has left.
bool is_of_a_rate(DoubtKind kind) {
  using enum DoubtKind;
  return kind == ran_dry || kind == drained || kind == stopped_flowing || kind == before_the_window ||
         kind == few_seeds || kind == flow_changed;
}

ReducedRun reduced_run(const CalibrationTask& task, const std::vector<std::size_t>& series, const Scene& scene,
                       const Evaluation& evaluation) {
  ReducedRun reduced;
  if (!evaluation.finished()) {
    reduced.reason = evaluation.reason;
    return reduced;
  }
  if (evaluation.outside_the_model) reduced.reason = "outside the model";
  const bool curves = is_curve(task.measured.table.quantity);
  reduced.doubts = evaluation.outflow.doubts;
  if (curves) std::erase_if(reduced.doubts, [](const Doubt& doubt) { return is_of_a_rate(doubt.kind); });
  const double factor = task.measured.scale == MeasuredScale::depth ? evaluation.outflow.depth_factor.value_or(1) : 1;
  for (const std::size_t s : series) {
    std::vector<double> values = simulated_values(evaluation, task.measured, task.measured.table.series[s], scene);
    for (double& value : values) value *= factor;
    if (!std::ranges::all_of(values, [&](double value) { return std::isfinite(value) && (curves || value > 0); }))
      reduced.reason = "nothing flowed";
    reduced.values.insert(reduced.values.end(), values.begin(), values.end());
  }
  return reduced;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

std::vector<std::size_t> series_of(const CalibrationTask& task, const CalibrationDesign& design,
                                   std::size_t condition) {
  const std::vector<MeasuredSeries>& all = task.measured.table.series;
  std::vector<std::size_t> indices;
  for (std::size_t s = 0; s < all.size(); ++s)
    if (all[s].conditions == design.conditions[condition]) indices.push_back(s);
  return indices;
}

std::optional<std::vector<ReducedRun>> reduced_runs(const CalibrationTask& task, const CalibrationDesign& design,
                                                    const KeptRuns& kept) {
  std::vector<ReducedRun> all;
  for (const CalibrationRun& run : design.runs) {
    const std::vector<std::size_t> series = series_of(task, design, run.condition);
    std::vector<CurveRequest> requests;
    if (is_curve(task.measured.table.quantity))
      for (const std::size_t s : series)
        requests.push_back(curve_request(task.measured, task.measured.table.series[s], run.scene));
    const std::optional<Run> made = kept(name_of_run(run.scene, run.random_seed));
    if (!made) return std::nullopt;
    all.push_back(reduced_run(task, series, run.scene, reduced(run.scene, *made, requests)));
  }
  leave_out_clogged(task, design, all);
  return all;
}

void leave_out_clogged(const CalibrationTask& task, const CalibrationDesign& design, std::vector<ReducedRun>& runs) {
  constexpr double share_to_go = 0.1;
  if (!is_curve(task.measured.table.quantity)) return;
  for (std::size_t condition = 0; condition < design.conditions.size(); ++condition) {
    std::vector<std::size_t> of_condition;
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (design.runs[r].condition == condition && runs[r].reason.empty()) of_condition.push_back(r);
    if (of_condition.empty()) continue;
    std::size_t first = 0;  // of the series' values in those of a run
    for (const std::size_t s : series_of(task, design, condition)) {
      const std::size_t count = task.measured.table.series[s].values.size();
      std::vector<double> medians;
      for (std::size_t v = first; v < first + count; ++v) {
        std::vector<double> values;
        for (const std::size_t r : of_condition) values.push_back(runs[r].values[v]);
        medians.push_back(median(std::move(values)));
      }
      for (const std::size_t r : of_condition) {
        std::size_t last = count - 1;  // after which nothing leaves
        while (last > 0 && runs[r].values[first + last - 1] == runs[r].values[first + count - 1]) --last;
        if (medians.back() - medians[last] > share_to_go * medians.back()) runs[r].reason = "clogged";
      }
      first += count;
    }
  }
}

}  // namespace vibrosow
