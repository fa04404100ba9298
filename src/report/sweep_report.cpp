#include "report/sweep_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

#include "input/key_units.hpp"
#include "report/columns.hpp"
#include "report/drill_report.hpp"
#include "report/expected_report.hpp"
#include "report/json_keys.hpp"
#include "report/layout_columns.hpp"
#include "report/study_page.hpp"

namespace vibrosow {
namespace {

std::string run_status(EvaluationStatus status) {
  switch (status) {
    case EvaluationStatus::refused:
      return "invalid";
    case EvaluationStatus::absent:
      return "missing";
    case EvaluationStatus::interrupted:
      return "interrupted";
    case EvaluationStatus::stopped:
      return "stopped";
    case EvaluationStatus::finished:
      return "ok";
  }
  return "";
}

/// `first`: number of the first layout with the same scene.
std::string run_note(int first, const Layout& layout, const Evaluation& run) {
  std::string note = run.was_run() ? run.outflow.note() : run.reason;
  if (first != layout.number) note += fmt::format("{}same run as of layout {}", note.empty() ? "" : "; ", first);
  return note;
}

Columns<LayoutRow> sweep_columns(const std::vector<std::string>& keys) {
  using R = const LayoutRow&;
  Columns<LayoutRow> columns = layout_columns<LayoutRow>();
  columns.push_back(
      text_column<LayoutRow>("status",
                             "ok, doubtful (its figures may be wrong), outside the model (of a run at least: it must "
                             "not be used), invalid, stopped (by the guard) or incomplete (runs are missing)",
                             [](R r) { return std::string(name_of(r.of().status)); }));
  columns.push_back(text_column<LayoutRow>("reason",
                                           "why it is not ok, or what makes it less sure; and suspicious input",
                                           [](R r) { return layout_note(r.of()); }));
  append(columns, key_columns<LayoutRow>(keys));
  columns.push_back(replicates_column<LayoutRow>());
  add_metric_columns(
      columns, [](R r) -> const auto& { return r.of().metrics; });
  add_mean_columns(columns, "misfit_percent", Unit{"%", 1},
                   "misfit to the measured outflow; empty without a measurement",
                   [](R r) { return r.of().misfit_percent; });
  add_expected_columns(
      columns, [](R r) -> const auto& { return r.of().expected; });
  return columns;
}

struct HoleRow : LayoutRow {
  const HoleMetrics* hole;
};

/// Size of the unit in which a measured table states its quantity.
double measured_unit(const StudyResult& result) {
  const auto& measured = result.study.measured;
  return measured ? 1 / to_column_unit(measured->table.quantity, 1.0) : 1;
}

/// An SI mean and its interval in the unit of the measured table.
template <class Row, class Get>
void add_measured_columns(Columns<Row>& columns, const std::string& name, const std::string& description, Get get) {
  add_mean_columns(columns, name, Unit{"", 1}, description, [get](const Row& r) {
    std::optional<MeanWithInterval> value = get(r);
    if (!value) return value;
    const double unit = measured_unit(*r.result);
    value->mean /= unit;
    if (value->half_width_95) *value->half_width_95 /= unit;
    return value;
  });
}

Columns<HoleRow> sweep_holes_columns(bool with_across) {
  using R = const HoleRow&;
  Columns<HoleRow> columns = layout_columns<HoleRow>();
  append(columns,
         {text_column<HoleRow>("hole", "number of the hole from the left, or all", [](R r) { return r.hole->hole; }),
          text_column<HoleRow>("lot", "name of the seeds, or all", [](R r) { return r.hole->lot; }),
          quantity_column<HoleRow>("position_mm", millimetres, "middle of the hole, from the tray's left end",
                                   [](R r) { return r.hole->centre; }),
          quantity_column<HoleRow>("width_mm", millimetres, "of the hole", [](R r) { return r.hole->width; }),
          replicates_column<HoleRow>()});
  add_mean_columns(columns, "rate_g_per_s", grams_per_second, "mass flow, of the 2D slice or in 3D of the tray",
                   [](R r) { return r.hole->mass_rate; });
  add_mean_columns(columns, "seeds_per_s", per_second, "seeds, of the 2D slice or in 3D of the tray",
                   [](R r) { return r.hole->seeds_per_s; });
  add_mean_columns(columns, "longest_pause_s", seconds, "longest time in the window without a seed",
                   [](R r) { return r.hole->longest_pause; });
  add_measured_columns(columns, "measured", "measured rate in the unit of the measured table",
                       [](R r) { return r.hole->measured; });
  columns.push_back(quantity_column<HoleRow>("difference_percent", Unit{"%", 1},
                                             "simulated, scaled, less measured, of measured",
                                             [](R r) { return r.hole->difference_percent; }));
  if (with_across)
    columns.push_back(quantity_column<HoleRow>("across_mm", millimetres,
                                               "in 3D: middle of the hole, from the tray's front",
                                               [](R r) { return r.hole->across; }));
  return columns;
}

/// The bed of a layout at a record time, of one lot or, where `lot` is null, of all.
struct BedRow : LayoutRow {
  const BedMetrics* bed;
  const SeedLot* lot;
};

std::optional<MeanWithInterval> segregation_of(const BedRow& row) {
  if (!row.lot) return std::nullopt;
  const std::vector<SeedLot>& lots = row.result->study.scenes[*row.layout().scene].lots;
  return row.bed->segregation[static_cast<std::size_t>(row.lot - lots.data())];
}

Columns<BedRow> sweep_records_columns() {
  using R = const BedRow&;
  using Mean = std::optional<MeanWithInterval>;
  Columns<BedRow> columns = layout_columns<BedRow>();
  append(columns,
         {text_column<BedRow>("record", "number of the snapshot", [](R r) { return r.bed->record + 1; }),
          quantity_column<BedRow>("time_s", seconds, "when it was asked for", [](R r) { return r.bed->time; }),
          text_column<BedRow>("lot", "name of the seeds, or all", [](R r) { return r.lot ? r.lot->name : "all"; }),
          replicates_column<BedRow>()});
  add_mean_columns(columns, "packing_fraction", plain, "of the inside of the bed",
                   [](R r) { return r.lot ? Mean() : r.bed->packing; });
  add_mean_columns(columns, "packing_change", plain, "its change since the first record",
                   [](R r) { return r.lot ? Mean() : r.bed->packing_change; });
  add_mean_columns(columns, "segregation", plain, "segregation index of the lot, above 0 where it lies high",
                   segregation_of);
  return columns;
}

/// A run under one of the layouts that share its scene.
struct RunRow {
  int first;  // number of the first of them
  const Layout* of_layout;
  const Evaluation* run;
  const Layout& layout() const { return *of_layout; }
};

CsvField run_field(const std::integral auto& count, const Unit&) {
  return csv_number(std::int64_t{count});
}
template <class Value>
CsvField run_field(const Value& value, const Unit& unit) {
  return in_unit(value, unit);
}

/// A column that is empty where the run was not begun. `get`: an SI value or count of an Evaluation.
template <class Get>
Column<RunRow> run_column(std::string name, Unit unit, std::string description, Get get) {
  return {{std::move(name), std::string(unit.name), std::move(description)}, [get, unit](const RunRow& r) {
            if (!r.run->was_run()) return CsvField();
            return run_field(get(*r.run), unit);
          }};
}

Column<RunRow> metric_column(std::string_view name) {
  const Metric& metric = metric_named(name);
  return run_column(std::string(metric.name), Unit{metric.unit, metric.unit_size}, std::string(metric.description),
                    [&metric](const Evaluation& one) { return metric.of({one.outflow}); });
}

Columns<RunRow> sweep_runs_columns() {
  using R = const RunRow&;
  using One = const Evaluation&;
  Columns<RunRow> columns = layout_columns<RunRow>();
  append(
      columns,
      {text_column<RunRow>("random_seed", "of the run", [](R r) { return r.run->random_seed; }),
       text_column<RunRow>("status", "ok, invalid (it could not begin), stopped (by the guard), interrupted or missing",
                           [](R r) { return run_status(r.run->status); }),
       run_column("put_in", plain, "seeds put in: inside + counted + spilled + lost",
                  [](One one) { return one.balance.put_in; }),
       run_column("inside", plain, "seeds still inside at the end", [](One one) { return one.balance.inside; }),
       run_column("counted", plain, "seeds that left through holes, in the whole run",
                  [](One one) { return one.balance.counted; }),
       run_column("spilled", plain, "seeds that left over the rim", [](One one) { return one.balance.spilled; }),
       run_column("lost", plain, "seeds that went through a wall: an error", [](One one) { return one.balance.lost; }),
       metric_column("seeds_per_s"), metric_column("rate_g_per_s"), metric_column("tray_rate_g_per_s"),
       run_column("max_relative_overlap", plain,
                  "largest share of a contact's overlap that one grain takes, over its radius",
                  [](One one) { return one.max_relative_overlap; }),
       text_column<RunRow>("outside_the_model", "yes where the run is beyond what the model is for",
                           [](R r) -> std::string {
                             if (!r.run->was_run()) return "";
                             return r.run->outside_the_model ? "yes" : "no";
                           }),
       run_column("dt_s", seconds, "time step", [](One one) { return one.dt; }),
       run_column("grain_steps", plain, "grains times steps", [](One one) { return one.grain_steps; }),
       text_column<RunRow>("note", "what to know about the run; empty when all is well",
                           [](R r) { return run_note(r.first, r.layout(), *r.run); })});
  return columns;
}

struct MeasuredRow {
  const StudyResult* result;
  const ComparisonRow* row;
};

Columns<MeasuredRow> comparison_columns() {
  using R = const MeasuredRow&;
  Columns<MeasuredRow> columns = {
      text_column<MeasuredRow>("layout", "number of the layout, in the order of the study",
                               [](R r) { return r.result->study.layouts[r.row->layout].number; }),
      text_column<MeasuredRow>("hole", "number of the hole from the left, or all", [](R r) { return r.row->hole; }),
      text_column<MeasuredRow>("lot", "name of the lot, or all", [](R r) { return r.row->lot; }),
      quantity_column<MeasuredRow>("time_s", seconds, "of a point of a curve; empty for a rate",
                                   [](R r) { return r.row->time; }),
      quantity_column<MeasuredRow>("measured", plain, "in the unit of the measured table",
                                   [](R r) { return r.row->measured / measured_unit(*r.result); })};
  add_measured_columns(columns, "simulated", "simulated and scaled, in the same unit",
                       [](R r) { return std::optional(r.row->simulated); });
  return columns;
}

JsonKeys<SweepTiming> timing_keys() {
  using T = const SweepTiming&;
  return {{"wall_s", "s", "wall time of the sweep", [](T t) { return t.wall_time; }},
          {"jobs", "", "runs in parallel", [](T t) { return t.jobs; }},
          {"runs", "", "runs that were made; not those kept from before", [](T t) { return t.runs; }},
          {"run_wall_s", "s", "wall times of the runs, summed", [](T t) { return t.run_time; }},
          {"grain_steps", "", "grains times steps, summed", [](T t) { return t.grain_steps; }},
          {"grain_steps_per_s", "1/s", "these in a second of the sweep's wall time",
           [](T t) { return t.wall_time > 0 ? t.grain_steps / t.wall_time : 0; }},
          {"grain_steps_per_s_of_a_run", "1/s", "these in a second of a run's wall time",
           [](T t) { return t.run_time > 0 ? t.grain_steps / t.run_time : 0; }}};
}

}  // namespace

std::string layout_note(const LayoutResult& layout) {
  const std::string doubts = doubts_text(layout.doubts);
  return layout.reason + (layout.reason.empty() || doubts.empty() ? "" : "; ") + doubts;
}

std::string sweep_csv(const StudyResult& result, CsvFormat format) {
  return csv_of(sweep_columns(result.study.keys), layout_rows(result), format);
}

std::string sweep_holes_csv(const StudyResult& result, CsvFormat format) {
  std::vector<HoleRow> holes;
  for (const LayoutRow& row : layout_rows(result))
    for (const HoleMetrics& hole : row.of().holes) holes.push_back({row, &hole});
  const bool with_across = std::ranges::any_of(holes, [](const HoleRow& row) { return row.hole->across.has_value(); });
  Csv<HoleRow> csv(sweep_holes_columns(with_across), format);
  for (const HoleRow& hole : holes) csv.add(hole);
  return csv.text();
}

std::string sweep_records_csv(const StudyResult& result, CsvFormat format) {
  Csv<BedRow> csv(sweep_records_columns(), format);
  for (const LayoutRow& row : layout_rows(result))
    for (const BedMetrics& bed : row.of().bed) {
      const std::vector<SeedLot>& lots = result.study.scenes[*row.layout().scene].lots;
      if (lots.size() > 1)
        for (const SeedLot& lot : lots) csv.add({row, &bed, &lot});
      csv.add({row, &bed, nullptr});
    }
  return csv.text();
}

SweepRunsCsv::SweepRunsCsv(const Study& study, CsvFormat format)
    : study_(study),
      format_(format),
      layouts_(study.scenes.size()),
      head_(Csv<RunRow>(sweep_runs_columns(), format).text()),
      rows_(study.layouts.size()) {
  for (std::size_t k = 0; k < study.layouts.size(); ++k)
    if (study.layouts[k].scene) layouts_[*study.layouts[k].scene].push_back(k);
}

void SweepRunsCsv::add(std::size_t scene, const std::vector<Evaluation>& runs) {
  for (const std::size_t layout : layouts_.at(scene)) {
    Csv<RunRow> csv(sweep_runs_columns(), format_);
    for (const Evaluation& run : runs)
      csv.add({study_.layouts[layouts_[scene].front()].number, &study_.layouts[layout], &run});
    rows_[layout] = csv.text().substr(head_.size());
  }
}

std::string SweepRunsCsv::text() const {
  std::string text = head_;
  for (const std::string& rows : rows_) text += rows;
  return text;
}

std::string comparison_csv(const StudyResult& result, CsvFormat format) {
  Csv<MeasuredRow> csv(comparison_columns(), format);
  if (result.comparison)
    for (const ComparisonRow& row : result.comparison->rows) csv.add({&result, &row});
  return csv.text();
}

std::string sweep_timing_json(const SweepTiming& timing) {
  return json_of(timing_keys(), timing);
}

std::vector<FileText> sweep_file_texts() {
  return {file_text("sweep.csv", "one row per layout", sweep_columns({"KEY"})),
          file_text("sweep_holes.csv",
                    "one row per layout, hole and lot, per hole one of all lots where there are several, then the same "
                    "of all holes",
                    sweep_holes_columns(true)),
          file_text("sweep_runs.csv", "one row per layout and random seed", sweep_runs_columns()),
          doubts_file_text(),
          file_text("timing.json", "what the sweep took on this machine", timing_keys()),
          file_text("sweep_records.csv",
                    "of a study whose seeder has a record: one row per layout, snapshot and lot, and one of all lots",
                    sweep_records_columns()),
          file_text("comparison.csv", "of a study with measured outflow: one row per layout and measured value",
                    comparison_columns()),
          sweep_rows_file_text(),
          trade_file_text(),
          sweep_page_text()};
}

std::vector<OutputFile> sweep_files(const Answer& answer, const StudyResult& result, const SweepRunsCsv& runs,
                                    const SweepTiming& timing, CsvFormat format) {
  std::vector<OutputFile> files = {{"sweep.csv", sweep_csv(result, format)},
                                   {"sweep_holes.csv", sweep_holes_csv(result, format)},
                                   {"sweep_runs.csv", runs.text()},
                                   doubts_file(doubts_about(answer)),
                                   {"timing.json", sweep_timing_json(timing)}};
  const auto records = [](const LayoutResult& one) { return !one.bed.empty(); };
  if (std::ranges::any_of(result.layouts, records))
    files.push_back({"sweep_records.csv", sweep_records_csv(result, format)});
  if (result.comparison) files.push_back({"comparison.csv", comparison_csv(result, format)});
  const auto sows = [](const LayoutResult& one) { return !one.rows.empty(); };
  if (std::ranges::any_of(result.layouts, sows)) files.push_back({"sweep_rows.csv", sweep_rows_csv(result, format)});
  const std::vector<TradeLine> lines = trade_lines(result);
  if (!lines.empty()) files.push_back({"trade.csv", trade_csv(result, lines, format)});
  return files;
}

}  // namespace vibrosow
