#include "calibration/bench_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/bench_plan.hpp"
#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "study/predicted_cost.hpp"

namespace vibrosow {
namespace {

class Purchase {
 public:
  Purchase(const BenchAsked& asked, const std::shared_ptr<SourceFiles>& files, double budget)
      : asked_(asked), files_(files), budget_(budget), settings_(asked.settings) {
    if (!settings_.empty()) return;
    settings_ = usual_settings(read_scene(asked.seeder, asked.overrides, files));
    if (settings_.empty())
      throw InputError(
          fmt::format("{}: the tray has no harmonic motion; say what can be set at the bench, such as --try "
                      "\"tray.holes.width=8 mm..12 mm\"",
                      asked.seeder.string()));
  }

  BenchRuns best() const {
    if (BenchRuns bench = bought(settings_, false, asked_.most_runs); is_affordable(bench)) return bench;
    BenchRuns bench = of_either_level(settings_);
    if (!is_affordable(bench) && settings_.size() > 1) bench = of_either_level({settings_.front()});
    if (!is_affordable(bench)) refuse(bench);
    for (std::size_t k = bench.task.measured.table.condition_keys.size(); k < settings_.size(); ++k)
      bench.left_out.push_back(settings_[k].key);
    return bench;
  }

 private:
  bool is_affordable(const BenchRuns& bench) const { return bench.seconds <= budget_; }

  /// Of draft and the level as written that which buys more runs; draft where they buy as many, or none that is enough.
  BenchRuns of_either_level(const std::vector<KeyRange>& settings) const {
    BenchRuns written = bought(settings, false, 0);
    if (!can_be_draft()) return written;
    BenchRuns draft = bought(settings, true, 0);
    if (!is_affordable(draft) && !is_affordable(written)) return draft.seconds < written.seconds ? draft : written;
    if (!is_affordable(draft)) return written;
    return is_affordable(written) && written.task.most_runs > draft.task.most_runs ? written : draft;
  }

  std::vector<Override> overrides(bool draft) const {
    std::vector<Override> all = asked_.overrides;
    if (draft) all.push_back(parse_override("accuracy=draft"));
    return all;
  }

  bool can_be_draft() const {
    if (std::ranges::any_of(asked_.keys, &KeyRange::logarithmic)) return false;
    if (read_scene(asked_.seeder, asked_.overrides, files_).numerics.accuracy != AccuracyLevel::as_written)
      return false;
    try {
      read_scene(asked_.seeder, overrides(true), files_);
    } catch (const InputError&) {  // [numerics] has what a level would set
      return false;
    }
    return true;
  }

  CalibrationTask task_of(const std::vector<KeyRange>& settings, bool draft) const {
    CalibrationTask task;
    task.seeder = asked_.seeder;
    task.overrides = overrides(draft);
    task.keys = asked_.keys.empty() ? usual_fitted_keys(task.seeder, task.overrides, files_) : asked_.keys;
    task.measured.file = "--try";
    task.measured.table = bench_candidates(settings);
    task.measured.scale = read_scene(task.seeder, task.overrides, files_).space == Space::two_dimensional
                              ? MeasuredScale::free
                              : MeasuredScale::none;
    task.most_runs = asked_.most_runs;
    task.random_seed = asked_.random_seed;
    return task;
  }

  /// With as many runs as are affordable, `least` at least and as many as the surrogate needs; those where they are
  /// not.
  BenchRuns bought(const std::vector<KeyRange>& settings, bool draft, int least) const {
    BenchRuns bench;
    bench.task = task_of(settings, draft);
    bench.is_draft = draft;
    const int fewest = std::max(least, fewest_bench_runs(bench.task.keys.size() + settings.size()));
    while (true) {
      bench.design = design_bench(bench.task, files_);
      bench.seconds = 0;
      for (const CalibrationRun& run : bench.design.runs) bench.seconds += usual_seconds(run.scene);
      int& runs = bench.task.most_runs;
      if (is_affordable(bench) || runs <= fewest) return bench;
      runs = std::max(fewest, std::min(runs - 1, static_cast<int>(runs * budget_ / bench.seconds)));
    }
  }

  [[noreturn]] void refuse(const BenchRuns& bench) const {
    throw InputError(fmt::format(
        "{}: a sheet needs at least {} runs, and these would take some {:.0f} minutes of two cores{} and with {} "
        "alone; {:.0f} are the most. Give a shorter run.duration or a section of the tray, or fit fewer keys (--fit)",
        asked_.seeder.string(), bench.task.most_runs, std::ceil(bench.seconds / 120),
        bench.is_draft ? " as drafts" : "", bench.task.measured.table.condition_keys.front(), budget_ / 120));
  }

  const BenchAsked& asked_;
  const std::shared_ptr<SourceFiles>& files_;
  double budget_;  // s
  std::vector<KeyRange> settings_;
};

}  // namespace

BenchRuns affordable_bench(const BenchAsked& asked, const std::shared_ptr<SourceFiles>& files, double budget) {
  return Purchase(asked, files, budget).best();
}

}  // namespace vibrosow
