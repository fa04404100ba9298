#include "report/drill_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "input/key_units.hpp"
#include "report/layout_columns.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr Unit percent_per_degree{"%/degree", 1e-2 / degree};

std::string row_name(int row) {
  return row > 0 ? fmt::format("{}", row) : "all";
}

std::string numbers_text(const std::vector<int>& numbers) {
  return fmt::format("{}", fmt::join(numbers, " "));
}

constexpr const char* row_column_text = "number of the drill row, or all";
constexpr const char* holes_text = "numbers of the holes that feed it, from the left";
constexpr const char* note_text = "why there are no spacings; empty where there are";

/// Of a run.
struct RowOfRun {
  const RowMetrics* row;
  RowMeans metrics;
};

Columns<RowOfRun> rows_columns() {
  using R = const RowOfRun&;
  Columns<RowOfRun> columns = {
      text_column<RowOfRun>("row", row_column_text, [](R r) { return row_name(r.row->row); }),
      text_column<RowOfRun>("holes", holes_text, [](R r) { return numbers_text(r.row->holes); }),
      text_column<RowOfRun>("seeds", "from these in the window, of the 2D slice or in 3D of the tray",
                            [](R r) { return r.row->seeds; })};
  for (const RowMetric& metric : row_metrics())
    columns.push_back(quantity_column<RowOfRun>(std::string(metric.name), Unit{metric.unit, metric.unit_size},
                                                std::string(metric.description), [&metric](R r) {
                                                  const auto& value = r.metrics[metric.name];
                                                  return value ? std::optional(value->mean) : std::nullopt;
                                                }));
  columns.push_back(
      text_column<RowOfRun>("note", note_text, [](R r) { return spacings_note(r.row->without_spacing); }));
  return columns;
}

struct MeansRow : LayoutRow {
  const RowMeans* row;
};

Columns<MeansRow> sweep_rows_columns() {
  using R = const MeansRow&;
  Columns<MeansRow> columns = layout_columns<MeansRow>();
  append(columns, {text_column<MeansRow>("row", row_column_text, [](R r) { return row_name(r.row->row); }),
                   text_column<MeansRow>("holes", holes_text, [](R r) { return numbers_text(r.row->holes); }),
                   replicates_column<MeansRow>()});
  for (const RowMetric& metric : row_metrics()) {
    const Unit unit{metric.unit, metric.unit_size};
    const std::string name(metric.name), description(metric.description);
    const auto mean = [&metric](R r) -> const std::optional<MeanWithInterval>& { return (*r.row)[metric.name]; };
    if (metric.is_pooled())
      columns.push_back(quantity_column<MeansRow>(
          name, unit, description, [mean](R r) { return mean(r) ? std::optional(mean(r)->mean) : std::nullopt; }));
    else
      add_mean_columns(columns, name, unit, description, mean);
  }
  columns.push_back(
      text_column<MeansRow>("note", note_text, [](R r) { return spacings_note(r.row->without_spacing); }));
  return columns;
}

struct TradeRow : LayoutRow {
  const TradeLine* line;
};

std::string layouts_text(const TradeRow& row) {
  std::vector<int> numbers;
  for (const std::size_t i : row.line->layouts) numbers.push_back(row.result->study.layouts[i].number);
  return numbers_text(numbers);
}

/// A number of a turn-down in SI, or none.
template <class Get>
std::optional<double> of_turn_down(const std::optional<TurnDown>& turn_down, Get get) {
  return turn_down ? std::optional<double>(get(*turn_down)) : std::nullopt;
}

/// The turn-down that `which` gives, under `prefix`.
template <class Which>
void add_turn_down(Columns<TradeRow>& columns, const std::string& prefix, const std::string& meaning, Which which) {
  using R = const TradeRow&;
  using T = const TurnDown&;
  append(
      columns,
      {quantity_column<TradeRow>(prefix, plain, meaning,
                                 [which](R r) { return of_turn_down(which(r), [](T t) { return t.ratio; }); }),
       quantity_column<TradeRow>(
           prefix + "_from", plain, "the least such setting, in the unit of the key",
           [which](R r) { return of_turn_down(which(r), [&](T t) { return to_column_unit(r.line->key, t.from); }); }),
       quantity_column<TradeRow>(
           prefix + "_to", plain, "the largest",
           [which](R r) { return of_turn_down(which(r), [&](T t) { return to_column_unit(r.line->key, t.to); }); }),
       quantity_column<TradeRow>(prefix + "_least_rate_g_per_s", grams_per_second,
                                 "the smallest rate there, of the 2D slice or in 3D of the tray",
                                 [which](R r) { return of_turn_down(which(r), [](T t) { return t.least_rate; }); }),
       quantity_column<TradeRow>(prefix + "_most_rate_g_per_s", grams_per_second, "the largest rate there",
                                 [which](R r) { return of_turn_down(which(r), [](T t) { return t.most_rate; }); })});
}

Columns<TradeRow> trade_columns(const std::vector<std::string>& keys) {
  using R = const TradeRow&;
  Columns<TradeRow> columns = {
      text_column<TradeRow>("along", "the key in which its layouts differ",
                            [](R r) { return condition_column(r.line->key); }),
      text_column<TradeRow>("layouts", "their numbers", layouts_text),
      text_column<TradeRow>("name", "of their [[layout]]; empty without", [](R r) { return r.layout().name; })};
  for (const std::string& key : keys)
    columns.push_back(
        {{condition_column(key), "", "their value of this key; empty for the one in which they differ"}, [key](R r) {
           const auto value = r.layout().values.find(key);
           if (key == r.line->key || value == r.layout().values.end()) return CsvField();
           return csv_text_or_number(value->second);
         }});
  add_turn_down(
      columns, "turn_down",
      "largest over smallest rate between settings that all flow to the end, without a serious doubt, and whose CV "
      "between rows may be within drill.cv_limit; empty where none may",
      [](R r) -> const auto& { return r.line->not_excluded; });
  add_turn_down(
      columns, "turn_down_shown", "the same of settings whose CV is shown to be: its whole 95 % interval is",
      [](R r) -> const auto& { return r.line->shown; });
  append(columns,
         {quantity_column<TradeRow>(
              "slope_percent_per_degree", percent_per_degree,
              "change of the rate with the tray's tilt, of that on level ground: least squares",
              [](R r) { return r.line->slope ? std::optional(r.line->slope->change) : std::nullopt; }),
          quantity_column<TradeRow>("slope_percent_per_degree_ci95", percent_per_degree,
                                    "half width of its 95 % interval, from those of the rates alone",
                                    [](R r) { return r.line->slope ? r.line->slope->half_width : std::nullopt; }),
          quantity_column<TradeRow>(
              "off_line_percent", percent,
              "largest distance of a rate from that line, of the rate on level ground; empty for two",
              [](R r) { return r.line->slope ? r.line->slope->off_line : std::nullopt; }),
          text_column<TradeRow>("unsound",
                                "how many of these layouts are left out, since runs are missing, stopped or seriously "
                                "doubted; along the tilt also those that clogged",
                                [](R r) { return static_cast<std::int64_t>(r.line->unsound); })});
  return columns;
}

}  // namespace

std::string spacings_note(NoSpacings why) {
  switch (why) {
    case NoSpacings::none:
      return "";
    case NoSpacings::plane_slice:
      return "no spacings: seeds of a 2D slice are not those of a row";
    case NoSpacings::shared_hole:
      return "no spacings: how a hole's seeds are dealt out to its rows is not simulated";
    case NoSpacings::few_seeds:
      return "no spacings: fewer than two seeds";
  }
  return "";
}

std::string rows_csv(const DrillMetrics& metrics, CsvFormat format) {
  std::vector<RowMeans> means = row_means({&metrics});
  std::vector<RowOfRun> rows;
  for (std::size_t i = 0; i < means.size(); ++i) rows.push_back({&metrics.rows[i], std::move(means[i])});
  return csv_of(rows_columns(), rows, format);
}

FileText rows_file_text() {
  return file_text("rows.csv", "of a seeder with a drill: one row per drill row, and one of all", rows_columns());
}

std::string sweep_rows_csv(const StudyResult& result, CsvFormat format) {
  Csv<MeansRow> csv(sweep_rows_columns(), format);
  for (const LayoutRow& layout : layout_rows(result))
    for (const RowMeans& row : layout.of().rows) csv.add({layout, &row});
  return csv.text();
}

FileText sweep_rows_file_text() {
  return file_text("sweep_rows.csv",
                   "of a study whose seeder has a drill: one row per layout and drill row, and one of all",
                   sweep_rows_columns());
}

std::string trade_csv(const StudyResult& result, const std::vector<TradeLine>& lines, CsvFormat format) {
  Csv<TradeRow> csv(trade_columns(result.study.keys), format);
  for (const TradeLine& line : lines) csv.add({{&result, line.layouts.front()}, &line});
  return csv.text();
}

FileText trade_file_text() {
  return file_text("trade.csv",
                   "of a study whose seeder has a drill and which varies tray.motion.frequency, tray.motion.amplitude "
                   "or tray.tilt: one row per set of layouts that differ in that alone",
                   trade_columns({"KEY"}));
}

}  // namespace vibrosow
