#include "report/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "input/key_units.hpp"
#include "report/csv.hpp"
#include "report/output_files.hpp"

namespace vibrosow {
namespace {

constexpr double gram = 1e-3;        // kg
constexpr double millimetre = 1e-3;  // m
constexpr double percent = 1e-2;

using Fields = std::vector<std::string>;

void append(Fields& fields, const Fields& more) {
  fields.insert(fields.end(), more.begin(), more.end());
}

/// Mean and half width, in `unit`; empty where there is none.
Fields with_interval(const std::optional<MeanWithInterval>& value, double unit) {
  if (!value) return {"", ""};
  return {csv_number(value->mean / unit), value->half_width_95 ? csv_number(*value->half_width_95 / unit) : ""};
}

std::string in_unit(const std::optional<double>& value, double unit) {
  return value ? csv_number(*value / unit) : std::string();
}

std::string status_name(LayoutStatus status) {
  switch (status) {
    case LayoutStatus::ok:
      return "ok";
    case LayoutStatus::invalid:
      return "invalid";
    case LayoutStatus::stopped:
      return "stopped";
    case LayoutStatus::interrupted:
      return "interrupted";
  }
  return "";
}

std::string run_status(EvaluationStatus status) {
  switch (status) {
    case EvaluationStatus::refused:
      return "invalid";
    case EvaluationStatus::not_begun:
    case EvaluationStatus::interrupted:
      return "interrupted";
    case EvaluationStatus::stopped:
      return "stopped";
    case EvaluationStatus::finished:
      return "ok";
  }
  return "";
}

Fields run_figures(const Evaluation& run) {
  if (!run.was_run()) return Fields(11, "");
  const HoleOutflow* all = find_row(run.outflow, "all", "all");
  return {csv_number(run.balance.put_in),       csv_number(run.balance.inside),
          csv_number(run.balance.counted),      csv_number(run.balance.spilled),
          csv_number(run.balance.lost),         csv_number(all->seeds_per_s),
          csv_number(all->mass_rate / gram),    csv_number(run.max_compression),
          run.outside_the_model ? "yes" : "no", csv_number(run.dt),
          csv_number(run.grain_steps)};
}

/// The first layout with the same scene.
int first_with_scene(const Study& study, std::size_t scene) {
  for (const Layout& layout : study.layouts)
    if (layout.scene == scene) return layout.number;
  return 0;
}

std::string run_note(const Study& study, const Layout& layout, const Evaluation& run) {
  std::string note = run.was_run() ? run.outflow.note : run.reason;
  const int first = first_with_scene(study, *layout.scene);
  if (first != layout.number) note += fmt::format("{}same run as of layout {}", note.empty() ? "" : "; ", first);
  return note;
}

}  // namespace

std::string sweep_csv(const StudyResult& result) {
  const Study& study = result.study;
  Fields columns = {"layout", "name", "status", "reason"};
  for (const std::string& key : study.keys) columns.push_back(condition_column(key));
  columns.push_back("replicates");
  for (const std::string figure : {"rate_g_per_s", "seeds_per_s", "evenness_cv_percent", "instability_cv_percent",
                                   "longest_pause_s", "spilled_percent", "misfit_percent"})
    append(columns, {figure, figure + "_ci95"});
  CsvTable table(columns);
  for (std::size_t i = 0; i < study.layouts.size(); ++i) {
    const Layout& layout = study.layouts[i];
    const LayoutResult& of = result.layouts[i];
    Fields row = {fmt::format("{}", layout.number), layout.name, status_name(of.status), of.reason};
    for (const std::string& key : study.keys) {
      const auto value = layout.values.find(key);
      row.push_back(value == layout.values.end() ? "" : value->second);
    }
    row.push_back(fmt::format("{}", of.replicates));
    append(row, with_interval(of.figures.mass_rate, gram));
    append(row, with_interval(of.figures.seeds_per_s, 1));
    append(row, with_interval(of.figures.evenness_cv, percent));
    append(row, with_interval(of.figures.instability_cv, percent));
    append(row, with_interval(of.figures.longest_pause, 1));
    append(row, with_interval(of.figures.spilled_fraction, percent));
    append(row, with_interval(of.figures.misfit_percent, 1));
    table.add_row(row);
  }
  return table.text();
}

std::string sweep_holes_csv(const StudyResult& result) {
  CsvTable table({"layout", "name", "hole", "lot", "position_mm", "width_mm", "replicates", "rate_g_per_s",
                  "rate_g_per_s_ci95", "seeds_per_s", "seeds_per_s_ci95", "longest_pause_s", "longest_pause_s_ci95",
                  "measured", "measured_ci95", "difference_percent"});
  const auto& measured = result.study.measured;
  const double unit = measured ? 1 / to_column_unit(measured->table.quantity, 1.0) : 1;
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const Layout& layout = result.study.layouts[i];
    for (const HoleFigures& hole : result.layouts[i].holes) {
      Fields row = {fmt::format("{}", layout.number),
                    layout.name,
                    hole.hole,
                    hole.lot,
                    in_unit(hole.centre, millimetre),
                    in_unit(hole.width, millimetre),
                    fmt::format("{}", result.layouts[i].replicates)};
      append(row, with_interval(hole.mass_rate, gram));
      append(row, with_interval(hole.seeds_per_s, 1));
      append(row, with_interval(hole.longest_pause, 1));
      append(row, with_interval(hole.measured, unit));
      row.push_back(csv_number(hole.difference_percent));
      table.add_row(row);
    }
  }
  return table.text();
}

std::string sweep_records_csv(const StudyResult& result) {
  CsvTable table({"layout", "name", "record", "time_s", "lot", "replicates", "packing_fraction",
                  "packing_fraction_ci95", "packing_change", "packing_change_ci95", "segregation", "segregation_ci95"});
  for (std::size_t i = 0; i < result.layouts.size(); ++i) {
    const Layout& layout = result.study.layouts[i];
    for (const BedFigures& bed : result.layouts[i].bed) {
      const auto add = [&](const std::string& lot, const auto& packing, const auto& change, const auto& segregation) {
        Fields row = {fmt::format("{}", layout.number),
                      layout.name,
                      fmt::format("{}", bed.record + 1),
                      csv_number(bed.time),
                      lot,
                      fmt::format("{}", result.layouts[i].replicates)};
        append(row, with_interval(packing, 1));
        append(row, with_interval(change, 1));
        append(row, with_interval(segregation, 1));
        table.add_row(row);
      };
      const std::optional<MeanWithInterval> none;
      const std::vector<SeedLot>& lots = result.study.scenes[*layout.scene].lots;
      for (std::size_t lot = 0; lots.size() > 1 && lot < lots.size(); ++lot)
        add(lots[lot].name, none, none, bed.segregation[lot]);
      add("all", bed.packing, bed.packing_change, none);
    }
  }
  return table.text();
}

std::string sweep_runs_csv(const StudyResult& result) {
  CsvTable table({"layout", "name", "random_seed", "status", "put_in", "inside", "counted", "spilled", "lost",
                  "seeds_per_s", "rate_g_per_s", "max_compression", "outside_the_model", "dt_s", "grain_steps",
                  "note"});
  for (const Layout& layout : result.study.layouts) {
    if (!layout.scene) continue;
    for (const Evaluation& run : result.runs[*layout.scene]) {
      Fields row = {fmt::format("{}", layout.number), layout.name, fmt::format("{}", run.random_seed),
                    run_status(run.status)};
      append(row, run_figures(run));
      row.push_back(run_note(result.study, layout, run));
      table.add_row(row);
    }
  }
  return table.text();
}

std::string comparison_csv(const StudyResult& result) {
  CsvTable table({"layout", "hole", "time_s", "measured", "simulated", "simulated_ci95"});
  if (!result.comparison) return table.text();
  const MeasuredQuantity quantity = result.study.measured->table.quantity;
  const double unit = 1 / to_column_unit(quantity, 1.0);
  for (const ComparisonRow& row : result.comparison->rows) {
    Fields fields = {fmt::format("{}", result.study.layouts[row.layout].number), row.hole, csv_number(row.time),
                     csv_number(row.measured / unit)};
    append(fields, with_interval(row.simulated, unit));
    table.add_row(fields);
  }
  return table.text();
}

std::string sweep_timing_json(const StudyResult& result, double wall_time, int jobs) {
  double grain_steps = 0, run_time = 0;
  int runs = 0;
  for (const auto& replicates : result.runs)
    for (const Evaluation& run : replicates) {
      if (!run.was_run()) continue;
      ++runs;
      grain_steps += static_cast<double>(run.grain_steps);
      run_time += run.wall_time;
    }
  nlohmann::ordered_json timing;
  timing["wall_s"] = wall_time;
  timing["jobs"] = jobs;
  timing["runs"] = runs;
  timing["run_wall_s"] = run_time;
  timing["grain_steps"] = grain_steps;
  timing["grain_steps_per_s"] = wall_time > 0 ? grain_steps / wall_time : 0;
  timing["grain_steps_per_s_of_a_run"] = run_time > 0 ? grain_steps / run_time : 0;
  return timing.dump(2) + "\n";
}

void write_sweep_report(const std::filesystem::path& directory, const StudyResult& result, double wall_time, int jobs) {
  std::vector<OutputFile> files = {{"sweep.csv", sweep_csv(result)},
                                   {"sweep_holes.csv", sweep_holes_csv(result)},
                                   {"sweep_runs.csv", sweep_runs_csv(result)},
                                   {"timing.json", sweep_timing_json(result, wall_time, jobs)}};
  const auto records = [](const LayoutResult& one) { return !one.bed.empty(); };
  if (std::ranges::any_of(result.layouts, records)) files.push_back({"sweep_records.csv", sweep_records_csv(result)});
  if (result.comparison) files.push_back({"comparison.csv", comparison_csv(result)});
  write_files_atomically(directory, files);
}

}  // namespace vibrosow
