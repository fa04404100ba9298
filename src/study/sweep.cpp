#include "study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/comparison.hpp"
#include "study/layout_doubts.hpp"

namespace vibrosow {
namespace {

int replicates_of(const Study& study, const SweepOptions& options, std::size_t scene) {
  return options.replicates.empty() ? study.replicates.first() : options.replicates.at(scene);
}

/// Scenes that are run at a time: all, so that no core waits for another; where runs are dropped, some thousand runs.
std::size_t scenes_at_a_time(const Study& study, bool dropped) {
  constexpr std::size_t runs = 4096;
  if (!dropped) return study.scenes.size();
  return std::max<std::size_t>(1, runs / static_cast<std::size_t>(std::max(1, study.replicates.first())));
}

/// Those of scenes from one to before another.
std::vector<std::vector<Evaluation>> run_scenes(const Study& study, const std::vector<WantedOfRuns>& wanted,
                                                const Simulator& simulator, const SweepOptions& options,
                                                std::size_t from, std::size_t to) {
  std::vector<Model> models;
  for (std::size_t scene = from; scene < to; ++scene) models.push_back(prepare(study.scenes[scene]));
  std::vector<Job> jobs;
  for (std::size_t scene = from; scene < to; ++scene)
    for (int i = 0; i < replicates_of(study, options, scene); ++i)
      jobs.push_back({&models[scene - from], options.first_random_seed + static_cast<std::uint64_t>(i),
                      wanted[scene].curves, wanted[scene].drills});
  std::vector<Evaluation> results = run_jobs(jobs, simulator, options.runs);

  std::vector<std::vector<Evaluation>> runs(to - from);
  std::size_t job = 0;
  for (std::size_t scene = from; scene < to; ++scene)
    for (int i = 0; i < replicates_of(study, options, scene); ++i)
      runs[scene - from].push_back(std::move(results[job++]));
  return runs;
}

/// Where replicates are by need: those that are needed, whoever made more.
void drop_surplus(const Study& study, std::vector<Evaluation>& replicates) {
  if (!study.replicates.interval) return;
  if (const auto enough = enough_runs(rates_of(replicates), study.replicates))
    replicates.resize(static_cast<std::size_t>(*enough));
}

/// The runs of which figures are made.
std::vector<Evaluation> flowed_only(const Study& study, const std::vector<Evaluation>& replicates) {
  std::vector<Evaluation> flowed;
  for (const Evaluation& one : replicates)
    if (!is_left_out(study, one)) flowed.push_back(one);
  return flowed;
}

/// Mean of a figure over the finished replicates that have it.
template <typename Metric>
std::optional<MeanWithInterval> mean_over(const std::vector<Evaluation>& replicates, Metric metric) {
  std::vector<double> values;
  for (const Evaluation& replicate : replicates) {
    if (!replicate.finished()) continue;
    const std::optional<double> value = metric(replicate);
    if (value && std::isfinite(*value)) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return mean_with_interval(values);
}

/// Mean of a hole's figure over the finished replicates that have it.
std::optional<MeanWithInterval> mean_of_row(const std::vector<Evaluation>& replicates, const HoleOutflow& hole,
                                            double HoleOutflow::*member) {
  std::vector<CountedRate> values;
  for (const Evaluation& replicate : replicates) {
    if (!replicate.finished()) continue;
    const HoleOutflow* row = find_row(replicate.outflow, hole.hole, hole.lot);
    if (!row || !std::isfinite(row->*member)) continue;
    const bool is_rate = member != &HoleOutflow::longest_pause;
    values.push_back({row->*member, is_rate ? static_cast<double>(row->grains) : 0});
  }
  if (values.empty()) return std::nullopt;
  return mean_of_rates(values);
}

std::vector<const Outflow*> finished_outflows(const std::vector<Evaluation>& replicates) {
  std::vector<const Outflow*> finished;
  for (const Evaluation& one : replicates)
    if (one.finished()) finished.push_back(&one.outflow);
  return finished;
}

std::vector<HoleMetrics> hole_metrics(const std::vector<Evaluation>& replicates) {
  const auto finished = std::ranges::find_if(replicates, &Evaluation::finished);
  if (finished == replicates.end()) return {};
  std::vector<HoleMetrics> holes;
  for (const HoleOutflow& row : finished->outflow.holes) {
    HoleMetrics metrics;
    metrics.hole = row.hole;
    metrics.lot = row.lot;
    metrics.centre = row.centre, metrics.across = row.across;
    metrics.width = row.width;
    metrics.seeds_per_s = mean_of_row(replicates, row, &HoleOutflow::seeds_per_s);
    metrics.mass_rate = mean_of_row(replicates, row, &HoleOutflow::mass_rate);
    metrics.longest_pause = mean_of_row(replicates, row, &HoleOutflow::longest_pause);
    holes.push_back(std::move(metrics));
  }
  return holes;
}

/// One for each drill of the scene.
std::vector<std::vector<RowMeans>> rows_of_drills(const std::vector<Evaluation>& replicates, std::size_t drills) {
  std::vector<std::vector<RowMeans>> rows;
  for (std::size_t drill = 0; drill < drills; ++drill) {
    std::vector<const DrillMetrics*> finished;
    for (const Evaluation& one : replicates)
      if (one.finished()) finished.push_back(&one.drills.at(drill));
    rows.push_back(row_means(finished));
  }
  return rows;
}

BedMetrics bed_metrics(const Scene& scene, std::size_t record, const std::vector<Evaluation>& replicates) {
  using Value = std::optional<double>;
  const auto reached = [record](const Evaluation& one) { return record < one.records.size(); };
  BedMetrics metrics{record, scene.record->times[record], {}, {}, {}};
  metrics.packing = mean_over(
      replicates, [&](const Evaluation& one) { return reached(one) ? one.records[record].packing : Value(); });
  metrics.packing_change = mean_over(replicates, [&](const Evaluation& one) {
    if (!reached(one) || !one.records[record].packing || !one.records[0].packing) return Value();
    return Value(*one.records[record].packing - *one.records[0].packing);
  });
  for (std::size_t lot = 0; lot < scene.lots.size(); ++lot)
    metrics.segregation.push_back(mean_over(replicates, [&](const Evaluation& one) {
      return reached(one) ? one.records[record].segregation[lot] : Value();
    }));
  return metrics;
}

void set_status(LayoutResult& result, const std::vector<Evaluation>& runs) {
  const auto finished = std::ranges::count_if(runs, &Evaluation::finished);
  const auto refused = std::ranges::find(runs, EvaluationStatus::refused, &Evaluation::status);
  const auto stopped = std::ranges::find(runs, EvaluationStatus::stopped, &Evaluation::status);
  if (refused != runs.end()) {
    result.status = LayoutStanding::invalid;
    result.reason = refused->reason;
  } else if (stopped != runs.end()) {
    result.status = LayoutStanding::stopped;
    result.reason = fmt::format("random seed {}: {}", stopped->random_seed, stopped->reason);
  } else if (finished < std::ssize(runs)) {
    result.status = LayoutStanding::incomplete;
    result.reason = fmt::format("{} of {} runs finished", finished, runs.size());
  } else if (std::ranges::any_of(runs, &Evaluation::outside_the_model)) {
    result.status = LayoutStanding::outside_the_model;
  }
}

/// Where runs that clogged are left out of the figures: a few that flowed among many say little of the layout.
std::optional<CountedDoubt> doubt_of_clogged(int clogged, int runs) {
  if (clogged == 0) return std::nullopt;
  if (clogged == runs) return CountedDoubt{DoubtKind::stopped_flowing, clogged, runs, "every run clogged"};
  const DoubtKind kind = 2 * clogged > runs ? DoubtKind::two_kinds_of_run : DoubtKind::clogged_replicates;
  return CountedDoubt{kind, 0, 0, fmt::format("clogged in {} of {} runs, which are left out", clogged, runs)};
}

/// Of replicates by need: runs that clogged, and what to know about the interval.
void add_doubts_of_need(const Study& study, const std::vector<Evaluation>& replicates, LayoutResult& result) {
  const auto add = [&](DoubtKind kind, std::string text) { result.doubts.push_back({kind, 0, 0, std::move(text)}); };
  const std::vector<std::optional<CountedRate>> rates = rates_of(replicates);
  if (auto clogged = doubt_of_clogged(result.stopped_flowing, static_cast<int>(replicates.size())))
    result.doubts.push_back(*std::move(clogged));
  std::vector<double> flowed;
  for (const auto& rate : rates)
    if (rate) flowed.push_back(rate->rate);
  if (!enough_runs(rates, study.replicates)) {
    const bool more_may_follow = static_cast<int>(rates.size()) < study.replicates.most;
    add(DoubtKind::wide_interval,
        fmt::format("after {}{} runs the rate's interval is still wider than {:.3g} %{}", rates.size(),
                    more_may_follow ? fmt::format(" of at most {}", study.replicates.most) : "",
                    100 * *study.replicates.interval, more_may_follow ? ", and more are needed" : ""));
  }
  if (look_skewed(flowed))
    add(DoubtKind::skewed_replicates,
        "the runs scatter to one side: the interval holds less often than 95 times in 100");
}

LayoutResult invalid_result(const Layout& layout) {
  LayoutResult result;
  result.status = LayoutStanding::invalid;
  result.reason = layout.invalid;
  return result;
}

/// What came of a scene, and of each of its drills the rows.
struct SceneResult {
  LayoutResult of_all_layouts;
  std::vector<std::vector<RowMeans>> rows;
};

SceneResult result_of(const Study& study, const Scene& scene, const std::vector<Evaluation>& runs,
                      const std::vector<Drill>& drills) {
  LayoutResult result;
  const std::vector<Evaluation> replicates = flowed_only(study, runs);
  set_status(result, runs);
  result.replicates = static_cast<int>(std::ranges::count_if(replicates, &Evaluation::finished));
  result.stopped_flowing = static_cast<int>(std::ranges::count_if(runs, &Evaluation::stopped_flowing));
  result.doubts = doubts_of_runs(replicates);
  const bool was_run = is_compared(result.status) || result.status == LayoutStanding::outside_the_model;
  if (study.replicates.interval && was_run) add_doubts_of_need(study, runs, result);
  const std::vector<const Outflow*> outflows = finished_outflows(replicates);
  result.metrics = MetricMeans(outflows);
  result.chance_of_rate = chance_of_rate(outflows);
  result.holes = hole_metrics(replicates);
  for (CountedDoubt& doubt : doubts_of_scene(scene)) result.doubts.push_back(std::move(doubt));
  if (result.status == LayoutStanding::ok && is_serious(result.doubts)) result.status = LayoutStanding::doubtful;
  for (std::size_t record = 0; scene.record && record < scene.record->times.size(); ++record)
    result.bed.push_back(bed_metrics(scene, record, replicates));
  return {std::move(result), rows_of_drills(replicates, drills.size())};
}

LayoutResult result_of(const Layout& layout, const SceneResult& of_scene, const std::vector<Drill>& drills) {
  LayoutResult result = of_scene.of_all_layouts;
  if (layout.drill)
    result.rows = of_scene.rows.at(static_cast<std::size_t>(std::ranges::find(drills, *layout.drill) - drills.begin()));
  return result;
}

}  // namespace

bool is_left_out(const Study& study, const Evaluation& run) {
  return study.replicates.interval && run.stopped_flowing();
}

std::vector<std::optional<CountedRate>> rates_of(const std::vector<Evaluation>& replicates) {
  std::vector<std::optional<CountedRate>> rates;
  for (const Evaluation& one : replicates) {
    const HoleOutflow* const all =
        one.finished() && !one.stopped_flowing() ? find_row(one.outflow, "all", "all") : nullptr;
    rates.emplace_back();
    if (all && std::isfinite(all->mass_rate)) rates.back() = {all->mass_rate, one.outflow.seeds()};
  }
  return rates;
}

std::vector<WantedOfRuns> wanted_of_runs(const Study& study) {
  std::vector<WantedOfRuns> wanted(study.scenes.size());
  for (std::size_t scene = 0; scene < wanted.size(); ++scene) wanted[scene].curves = measured_curves(study, scene);
  for (const Layout& layout : study.layouts) {
    if (!layout.scene || !layout.drill) continue;
    std::vector<Drill>& drills = wanted[*layout.scene].drills;
    if (std::ranges::find(drills, *layout.drill) == drills.end()) drills.push_back(*layout.drill);
  }
  return wanted;
}

StudyResult answer_of(const Study& study, const RunsOfScenes& runs_of, const OnRuns& on_runs) {
  StudyResult result;
  result.study = study;
  result.runs.resize(study.scenes.size());
  const std::vector<WantedOfRuns> wanted = wanted_of_runs(study);
  const bool dropped = on_runs && !study.measured;
  std::vector<SceneResult> of_scenes;
  const std::size_t at_a_time = scenes_at_a_time(study, dropped);
  for (std::size_t from = 0; from < study.scenes.size(); from += at_a_time) {
    const std::size_t to = std::min(from + at_a_time, study.scenes.size());
    std::vector<std::vector<Evaluation>> runs = runs_of(from, to);
    for (std::size_t scene = from; scene < to; ++scene) {
      std::vector<Evaluation>& replicates = runs[scene - from];
      drop_surplus(study, replicates);
      of_scenes.push_back(result_of(study, study.scenes[scene], replicates, wanted[scene].drills));
      if (on_runs) on_runs(scene, replicates);
      if (!dropped) result.runs[scene] = std::move(replicates);
    }
  }
  for (const Layout& layout : study.layouts)
    result.layouts.push_back(layout.scene ? result_of(layout, of_scenes[*layout.scene], wanted[*layout.scene].drills)
                                          : invalid_result(layout));
  if (study.measured) compare_with_measured(result);
  return result;
}

void expect_rates(StudyResult& result, const RateKnowledge& knowledge) {
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    LayoutResult& layout = result.layouts[i];
    const auto& rate = layout.metrics["rate_g_per_s"];
    if (!is_compared(layout.status) || !rate) continue;
    const auto error = scene_error(result.study.scenes[*result.study.layouts[i].scene], knowledge);
    if (error) layout.expected = expected_rate(rate->mean, layout.chance_of_rate, *error);
    if (!layout.expected) continue;
    for (const Doubt& doubt : error->doubts) layout.doubts.push_back({doubt.kind, 0, 0, doubt.text});
  }
}

StudyResult sweep(const Study& study, const Simulator& simulator, const SweepOptions& options) {
  const std::vector<WantedOfRuns> wanted = wanted_of_runs(study);
  const auto run = [&](std::size_t from, std::size_t to) {
    return run_scenes(study, wanted, simulator, options, from, to);
  };
  return answer_of(study, run, options.on_runs);
}

}  // namespace vibrosow
