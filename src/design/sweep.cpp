#include "design/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "design/comparison.hpp"
#include "plan/scene_warnings.hpp"

namespace vibrosow {
namespace {

std::vector<std::vector<Evaluation>> run_scenes(const Study& study, const Simulator& simulator,
                                                const SweepOptions& options) {
  std::vector<Model> models;
  for (const Scene& scene : study.scenes) models.push_back(prepare(scene));
  std::vector<Job> jobs;
  for (std::size_t scene = 0; scene < models.size(); ++scene)
    for (int i = 0; i < study.replicates; ++i)
      jobs.push_back(
          {&models[scene], options.first_random_seed + static_cast<std::uint64_t>(i), measured_curves(study, scene)});
  std::vector<Evaluation> results = run_jobs(jobs, simulator, options.runs);

  std::vector<std::vector<Evaluation>> runs(study.scenes.size());
  for (std::size_t job = 0; job < jobs.size(); ++job)
    runs[job / static_cast<std::size_t>(study.replicates)].push_back(std::move(results[job]));
  return runs;
}

/// Mean of a figure over the finished replicates that have it.
template <typename Figure>
std::optional<MeanWithInterval> mean_over(const std::vector<Evaluation>& replicates, Figure figure) {
  std::vector<double> values;
  for (const Evaluation& replicate : replicates) {
    if (!replicate.finished()) continue;
    const std::optional<double> value = figure(replicate);
    if (value && std::isfinite(*value)) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return mean_with_interval(values);
}

template <typename Member>
std::optional<MeanWithInterval> mean_of_row(const std::vector<Evaluation>& replicates, const std::string& hole,
                                            const std::string& lot, Member member) {
  return mean_over(replicates, [&](const Evaluation& one) -> std::optional<double> {
    const HoleOutflow* row = find_row(one.outflow, hole, lot);
    return row ? std::optional(row->*member) : std::nullopt;
  });
}

FigureMeans figures_of(const std::vector<Evaluation>& replicates) {
  std::vector<const Outflow*> finished;
  for (const Evaluation& one : replicates)
    if (one.finished()) finished.push_back(&one.outflow);
  return FigureMeans(finished);
}

std::vector<HoleFigures> hole_figures(const std::vector<Evaluation>& replicates) {
  const auto finished = std::ranges::find_if(replicates, &Evaluation::finished);
  if (finished == replicates.end()) return {};
  std::vector<HoleFigures> holes;
  for (const HoleOutflow& row : finished->outflow.holes) {
    HoleFigures figures;
    figures.hole = row.hole;
    figures.lot = row.lot;
    figures.centre = row.centre, figures.across = row.across;
    figures.width = row.width;
    figures.seeds_per_s = mean_of_row(replicates, row.hole, row.lot, &HoleOutflow::seeds_per_s);
    figures.mass_rate = mean_of_row(replicates, row.hole, row.lot, &HoleOutflow::mass_rate);
    figures.longest_pause = mean_of_row(replicates, row.hole, row.lot, &HoleOutflow::longest_pause);
    holes.push_back(std::move(figures));
  }
  return holes;
}

BedFigures bed_figures(const Scene& scene, std::size_t record, const std::vector<Evaluation>& replicates) {
  using Value = std::optional<double>;
  const auto reached = [record](const Evaluation& one) { return record < one.records.size(); };
  BedFigures figures{record, scene.record->times[record], {}, {}, {}};
  figures.packing = mean_over(
      replicates, [&](const Evaluation& one) { return reached(one) ? one.records[record].packing : Value(); });
  figures.packing_change = mean_over(replicates, [&](const Evaluation& one) {
    if (!reached(one) || !one.records[record].packing || !one.records[0].packing) return Value();
    return Value(*one.records[record].packing - *one.records[0].packing);
  });
  for (std::size_t lot = 0; lot < scene.lots.size(); ++lot)
    figures.segregation.push_back(mean_over(replicates, [&](const Evaluation& one) {
      return reached(one) ? one.records[record].segregation[lot] : Value();
    }));
  return figures;
}

/// What to know about the finished runs of a layout: each kind of remark, and how many runs have it.
std::string remarks_on(const std::vector<Evaluation>& replicates) {
  std::vector<std::pair<std::string, int>> kinds;  // in the order in which they come up
  int finished = 0;
  for (const Evaluation& replicate : replicates) {
    if (!replicate.finished()) continue;
    ++finished;
    std::set<std::string> of_run;
    for (const Remark& remark : replicate.outflow.remarks) {
      if (!of_run.insert(remark.kind).second) continue;
      const auto known = std::ranges::find(kinds, remark.kind, &std::pair<std::string, int>::first);
      if (known == kinds.end())
        kinds.emplace_back(remark.kind, 1);
      else
        ++known->second;
    }
  }
  std::vector<std::string> remarks;
  for (const auto& [kind, runs] : kinds) remarks.push_back(fmt::format("{} in {} of {} runs", kind, runs, finished));
  return fmt::format("{}", fmt::join(remarks, "; "));
}

void set_status(LayoutResult& result, const std::vector<Evaluation>& replicates) {
  result.replicates = static_cast<int>(std::ranges::count_if(replicates, &Evaluation::finished));
  const auto refused = std::ranges::find(replicates, EvaluationStatus::refused, &Evaluation::status);
  const auto stopped = std::ranges::find(replicates, EvaluationStatus::stopped, &Evaluation::status);
  if (refused != replicates.end()) {
    result.status = LayoutStatus::invalid;
    result.reason = refused->reason;
  } else if (stopped != replicates.end()) {
    result.status = LayoutStatus::stopped;
    result.reason = fmt::format("random seed {}: {}", stopped->random_seed, stopped->reason);
  } else if (result.replicates < static_cast<int>(replicates.size())) {
    result.status = LayoutStatus::interrupted;
    result.reason = fmt::format("{} of {} runs finished", result.replicates, replicates.size());
  } else {
    if (std::ranges::any_of(replicates, &Evaluation::outside_the_model))
      result.status = LayoutStatus::outside_the_model;
    result.reason = remarks_on(replicates);
  }
}

LayoutResult result_of(const Study& study, const Layout& layout, const std::vector<std::vector<Evaluation>>& runs) {
  LayoutResult result;
  if (!layout.scene) {
    result.status = LayoutStatus::invalid;
    result.reason = layout.invalid;
    return result;
  }
  const std::vector<Evaluation>& replicates = runs[*layout.scene];
  set_status(result, replicates);
  result.figures = figures_of(replicates);
  result.holes = hole_figures(replicates);
  const Scene& scene = study.scenes[*layout.scene];
  result.warnings = scene_warnings(scene);
  for (std::size_t record = 0; scene.record && record < scene.record->times.size(); ++record)
    result.bed.push_back(bed_figures(scene, record, replicates));
  return result;
}

}  // namespace

StudyResult sweep(const Study& study, const Simulator& simulator, const SweepOptions& options) {
  StudyResult result;
  result.study = study;
  result.runs = run_scenes(study, simulator, options);
  for (const Layout& layout : study.layouts) result.layouts.push_back(result_of(study, layout, result.runs));
  if (study.measured) compare_with_measured(result);
  return result;
}

}  // namespace vibrosow
