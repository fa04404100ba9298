// What windows as they were written say of the kept runs of a sweep, beside windows of whole periods: CSV.
// Usage: window_error FOLDER

#include <fmt/format.h>

#include <iostream>
#include <string>

#include "outflow/statistics.hpp"
#include "scene/input_error.hpp"
#include "scene/measuring_window.hpp"
#include "storage/case_file.hpp"
#include "storage/case_folder.hpp"
#include "storage/study_plan.hpp"
#include "study/planned_study.hpp"

namespace {

using namespace vibrosow;

double rate(const Run& run, double from, double to) {
  const auto counted = std::ranges::count_if(
      run.events, [&](const OutflowEvent& event) { return event.hole > 0 && event.time >= from && event.time <= to; });
  return static_cast<double>(counted) / (to - from);
}

void write(const std::string& folder) {
  const PlannedStudy planned = study_of_plan(read_plan(folder));
  const CaseFolder cases(cases_of(folder));
  std::cout << "layout,period_s,written_from_s,from_s,to_s,periods_as_written,replicates,seeds_per_s_as_written,"
               "seeds_per_s,difference_percent,difference_percent_ci95\n";
  for (const Layout& layout : planned.study.layouts) {
    if (!layout.scene) continue;
    const Scene& scene = planned.study.scenes[*layout.scene];
    const MeasuringWindow window = measuring_window(scene);
    std::vector<double> as_written, whole, difference;
    for (const PlannedRun& planned_run : planned.plan.runs) {
      if (planned_run.layout != layout.number) continue;
      const auto kept = cases.named(planned_run.name);
      if (!kept || kept->run.status != RunStatus::finished)
        throw InputError(folder + ": a run is missing or failed; sweep it first");
      as_written.push_back(rate(kept->run, scene.run.measure_from, window.to));
      whole.push_back(rate(kept->run, window.from, window.to));
      difference.push_back(100 * (as_written.back() / whole.back() - 1));
    }
    if (whole.empty()) continue;  // its scene is told with the first layout that has it
    const MeanWithInterval of = mean_with_interval(difference);
    const std::string half_width = of.half_width_95 ? fmt::format("{:.3g}", *of.half_width_95) : "";
    std::cout << fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g},{},{:.5g},{:.5g},{:.3g},{}\n", layout.number,
                             window.period, scene.run.measure_from, window.from, window.to,
                             window.period > 0 ? (window.to - scene.run.measure_from) / window.period : 0.0,
                             whole.size(), mean_with_interval(as_written).mean, mean_with_interval(whole).mean, of.mean,
                             half_width);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw InputError("usage: window_error FOLDER");
  write(argv[1]);
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
