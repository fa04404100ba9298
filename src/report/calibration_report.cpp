#include "report/calibration_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "input/key_units.hpp"
#include "outflow/doubts.hpp"
#include "report/calibration_page.hpp"
#include "report/contact_model.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"
#include "scene/spaces.hpp"

namespace vibrosow {
namespace {

constexpr std::size_t sample_rows = 500;
constexpr double few_effective_points = 200;
constexpr double little_contraction = 0.2;
constexpr double unlikely_misfit = 0.01;
constexpr const char* depth_factor = "depth_factor";

std::string confused_with(const CalibrationSource& source, std::size_t index) {
  std::vector<std::string> names;
  for (const FittedPair& pair : source.calibration.correlations)
    if ((pair.a == index || pair.b == index) && std::abs(pair.correlation) > not_told_apart)
      names.push_back(fitted_name(source, pair.a == index ? pair.b : pair.a));
  return fmt::format("{}", fmt::join(names, ";"));
}

Columns<ValueRow> value_columns() {
  using Row = const ValueRow&;
  return {
      text_column<ValueRow>("key", "that was fitted; depth_factor: what rates of the plane slice are multiplied by",
                            [](Row r) { return r.name; }),
      text_column<ValueRow>("unit", "of the values of this row", [](Row r) { return r.unit; }),
      quantity_column<ValueRow>("prior_low", plain, "from where on it was taken to lie; empty: anywhere",
                                [](Row r) { return r.low; }),
      quantity_column<ValueRow>("prior_high", plain, "up to where", [](Row r) { return r.high; }),
      quantity_column<ValueRow>("mean", plain, "of what is known of it now", [](Row r) { return r.value.mean; }),
      quantity_column<ValueRow>("low", plain, "lower end of its 95 % interval", [](Row r) { return r.value.low; }),
      quantity_column<ValueRow>("high", plain, "upper end of its 95 % interval", [](Row r) { return r.value.high; }),
      quantity_column<ValueRow>("contraction_percent", percent,
                                "by how much its standard deviation is below that of the prior; 0: nothing learned",
                                [](Row r) { return r.value.contraction; }),
      text_column<ValueRow>("not_told_apart_from", "others with which it is correlated above 0.8 either way",
                            [](Row r) { return r.confused_with; })};
}

/// A measured value with its prediction.
struct PredictionRow {
  const MeasuredTable* table;
  const PredictedValue* value;
  const MeasuredSeries& series() const { return table->series[value->series]; }
  double stated(double si) const { return to_column_unit(table->quantity, si); }
};

Columns<PredictionRow> prediction_columns() {
  using Row = const PredictionRow&;
  return {text_column<PredictionRow>("conditions", "of the measurement",
                                     [](Row r) { return conditions_text(r.series().conditions); }),
          text_column<PredictionRow>("hole", "number from the left, or all", [](Row r) { return r.series().hole; }),
          text_column<PredictionRow>("lot", "name, or all", [](Row r) { return r.series().lot; }),
          quantity_column<PredictionRow>("time_s", seconds, "of a curve", [](Row r) { return r.value->time; }),
          text_column<PredictionRow>("held_out", "yes: it was not fitted",
                                     [](Row r) { return std::string(r.value->held_out ? "yes" : "no"); }),
          quantity_column<PredictionRow>("measured", plain, "mean of its repeats, in the unit of the table's quantity",
                                         [](Row r) { return r.stated(r.value->measured); }),
          quantity_column<PredictionRow>("predicted", plain, "median of what the fitted model says of it",
                                         [](Row r) { return r.stated(r.value->predicted); }),
          quantity_column<PredictionRow>("low", plain, "lower end of the 95 % interval of such a measurement",
                                         [](Row r) { return r.stated(r.value->low); }),
          quantity_column<PredictionRow>("high", plain, "upper end", [](Row r) { return r.stated(r.value->high); })};
}

/// Values of the fitted keys, of a run or a point of the posterior.
struct PointRow {
  const CalibrationSource* source;
  Eigen::VectorXd parts;
  std::optional<double> factor{};  // the depth factor
  std::size_t run = 0;             // index of the run
};

Columns<PointRow> key_columns(const std::vector<KeyRange>& keys) {
  Columns<PointRow> columns;
  for (std::size_t k = 0; k < keys.size(); ++k)
    columns.push_back(quantity_column<PointRow>(
        condition_column(keys[k].key), plain, "value of a fitted key",
        [k](const PointRow& r) { return r.source->task.keys[k].at(r.parts(static_cast<Eigen::Index>(k))); }));
  return columns;
}

Columns<PointRow> posterior_columns(const std::vector<KeyRange>& keys, bool with_factor) {
  Columns<PointRow> columns = key_columns(keys);
  if (with_factor)
    columns.push_back(quantity_column<PointRow>(depth_factor, plain,
                                                "what rates of the plane slice are multiplied by, where it is fitted",
                                                [](const PointRow& r) { return r.factor; }));
  return columns;
}

Columns<PointRow> run_columns(const std::vector<KeyRange>& keys) {
  Columns<PointRow> columns = key_columns(keys);
  append(
      columns,
      {text_column<PointRow>("conditions", "of the run",
                             [](const PointRow& r) {
                               return conditions_text(
                                   r.source->design.conditions[r.source->design.runs[r.run].condition]);
                             }),
       text_column<PointRow>("random_seed", "of the run",
                             [](const PointRow& r) { return r.source->design.runs[r.run].random_seed; }),
       text_column<PointRow>("left_out", "why it counts for nothing",
                             [](const PointRow& r) { return r.source->runs[r.run].reason; }),
       text_column<PointRow>(
           "simulated",
           "values of its conditions' series, in their order, separated by spaces, unscaled but for --scale "
           "depth; in the unit of the table's quantity",
           [](const PointRow& r) {
             std::vector<std::string> values;
             for (const double value : r.source->runs[r.run].values)
               values.push_back(fmt::format("{:.6g}", to_column_unit(r.source->task.measured.table.quantity, value)));
             return fmt::format("{}", fmt::join(values, " "));
           })});
  return columns;
}

std::vector<PointRow> sample(const CalibrationSource& source) {
  const PosteriorSample& known = source.calibration.posterior;
  std::vector<PointRow> rows;
  for (const Eigen::Index i : points_of_equal_weight(known.weights, sample_rows))
    rows.push_back({&source, known.points.row(i).transpose(),
                    known.shifts.size() > 0 ? std::optional(std::exp(known.shifts(i))) : std::nullopt});
  return rows;
}

std::vector<PointRow> run_rows(const CalibrationSource& source) {
  std::vector<PointRow> rows;
  for (std::size_t run = 0; run < source.runs.size(); ++run)
    rows.push_back({&source, source.design.points.row(source.design.runs[run].point).transpose(), std::nullopt, run});
  return rows;
}

std::vector<PredictionRow> prediction_rows(const CalibrationSource& source) {
  std::vector<PredictionRow> rows;
  for (const PredictedValue& value : source.calibration.predictions)
    rows.push_back({&source.task.measured.table, &value});
  return rows;
}

std::string provenance(const CalibrationSource& source, const ValueRow& row) {
  std::string text = fmt::format(
      "fitted to {} with {} ({} of {} runs, vibrosow calibrate): 95 % interval {} to {}{}, contraction {:.0f} %",
      source.task.measured.file.filename().string(), source.task.seeder.filename().string(),
      std::ranges::count(source.runs, std::string(), &ReducedRun::reason), source.runs.size(),
      to_digits(row.value.low, 3), to_digits(row.value.high, 3), row.unit.empty() ? "" : fmt::format(" {}", row.unit),
      100 * row.value.contraction);
  if (!row.confused_with.empty()) text += fmt::format("; not told apart from {}", row.confused_with);
  return text;
}

std::vector<std::pair<std::string, std::string>> sources(const CalibrationSource& source) {
  std::vector<std::pair<std::string, std::string>> result;
  for (const ValueRow& row : value_rows(source)) {
    const std::string text = provenance(source, row);
    if (row.name == depth_factor)
      result.emplace_back(depth_factor,
                          fmt::format("{} ({}): what rates of the plane slice are multiplied by, no part of "
                                      "the contact; for tray.depth = factor times seed diameter",
                                      to_digits(row.value.mean, 4), text));
    else
      result.emplace_back(row.name.substr(std::string("contact.").size()), text);
  }
  result.emplace_back("others", fmt::format("as {} has them", source.task.seeder.filename().string()));
  return result;
}

/// What speaks against the runs that were fitted to.
std::vector<CountedDoubt> doubts_of_runs(const std::vector<ReducedRun>& runs) {
  std::vector<const std::vector<Doubt>*> that_count;
  for (const ReducedRun& run : runs)
    if (run.reason.empty()) that_count.push_back(&run.doubts);
  return counted_doubts(that_count);
}

/// Which edge of its range a value's interval touches, of one that the table says something of; empty: none.
std::string_view edge_of(const KeyRange& range, const FittedValue& value) {
  const double near = 0.02 * (range.high - range.low);
  if (value.contraction < little_contraction) return "";
  if (value.low - range.low < near) return "lower";
  return range.high - value.high < near ? "upper" : "";
}

bool any_at_an_edge(const CalibrationSource& source) {
  for (std::size_t k = 0; k < source.task.keys.size(); ++k)
    if (!edge_of(source.task.keys[k], source.calibration.values[k]).empty()) return true;
  return false;
}

/// The fitted factor beside the one that the tray's depth means; empty without either.
std::string depth_factor_text(const CalibrationSource& source) {
  const auto& fitted = source.calibration.depth_factor;
  if (!fitted || source.design.runs.empty()) return "";
  const auto slices = slices_of_tray(source.design.runs.front().scene);
  if (!slices) return "";
  return fmt::format("depth factor fitted: {} ({} to {}); tray.depth over the slice's thickness is {}",
                     to_digits(fitted->mean, 3), to_digits(fitted->low, 3), to_digits(fitted->high, 3),
                     to_digits(*slices, 3));
}

}  // namespace

std::string fitted_name(const CalibrationSource& source, std::size_t index) {
  return index < source.task.keys.size() ? source.task.keys[index].key : depth_factor;
}

std::vector<ValueRow> value_rows(const CalibrationSource& source) {
  std::vector<ValueRow> rows;
  for (std::size_t k = 0; k < source.task.keys.size(); ++k) {
    const KeyRange& key = source.task.keys[k];
    const auto unit = column_unit(key.key);
    rows.push_back({key.key, unit ? std::string(unit->unit) : "", key.low, key.high, source.calibration.values[k],
                    confused_with(source, k)});
  }
  if (const auto& factor = source.calibration.depth_factor)
    rows.push_back({depth_factor, "", {}, {}, *factor, confused_with(source, source.task.keys.size())});
  return rows;
}

std::string conditions_text(const std::vector<Condition>& conditions) {
  std::vector<std::string> parts;
  for (const Condition& condition : conditions) {
    const auto unit = column_unit(condition.key);
    parts.push_back(
        fmt::format("{} = {}{}", condition.key, condition.text, unit ? fmt::format(" {}", unit->unit) : ""));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string calibration_table(const CalibrationSource& source) {
  const Calibration& of = source.calibration;
  std::string text;
  for (const std::string& doubt : calibration_doubts(source)) text += wrapped(fmt::format("Doubtful: {}.", doubt));
  if (!text.empty()) text += '\n';
  text += fmt::format("{:<28} {:>6} {:>9} {:>21} {:>11}\n", "key", "unit", "mean", "95 % interval", "contraction");
  for (const ValueRow& row : value_rows(source))
    text +=
        fmt::format("{:<28} {:>6} {:>9} {:>9} to {:>8} {:>9.0f} %\n", row.name, row.unit, to_digits(row.value.mean, 4),
                    to_digits(row.value.low, 3), to_digits(row.value.high, 3), 100 * row.value.contraction);
  text += fmt::format("\n{}",
                      wrapped(fmt::format("noise of one measurement: {:.2g} % ({})", 100 * of.noise, of.noise_source)));
  const char* of_what = is_curve(source.task.measured.table.quantity) ? "percent of the largest value" : "%";
  if (of.fitted_rms)
    text += wrapped(fmt::format("fitted values are met to {:.2g} {} (RMS)", 100 * *of.fitted_rms, of_what));
  if (of.held_out_rms)
    text += wrapped(fmt::format("held out, and predicted to {:.2g} {} (RMS)", 100 * *of.held_out_rms, of_what));
  if (const std::string factor = depth_factor_text(source); !factor.empty()) text += wrapped(factor);
  if (!gives_a_contact(source))
    text += wrapped("No contact.toml is written: what is doubtful above would go on in it.");
  return text;
}

bool is_beyond_its_noise(const CalibrationSource& source) {
  constexpr double most = 3;
  return source.calibration.misfit_over_noise > most;
}

bool gives_a_contact(const CalibrationSource& source) {
  const std::vector<CountedDoubt> doubts = doubts_of_runs(source.runs);
  return source.calibration.misfit_probability >= unlikely_misfit && !any_at_an_edge(source) &&
         std::ranges::find(doubts, DoubtKind::seeds_lost, &CountedDoubt::kind) == doubts.end();
}

std::vector<std::string> calibration_doubts(const CalibrationSource& source) {
  const Calibration& of = source.calibration;
  std::vector<std::string> doubts;
  for (const SharedDoubt& doubt : shared_doubts({{0, doubts_of_runs(source.runs)}}))
    doubts.push_back(doubt_clause(doubt, ""));
  for (const FittedPair& pair : of.correlations)
    if (std::abs(pair.correlation) > not_told_apart)
      doubts.push_back(fmt::format("{} and {} cannot be told apart by this table (correlation {:.2f})",
                                   fitted_name(source, pair.a), fitted_name(source, pair.b), pair.correlation));
  std::vector<std::string> unknown;
  for (std::size_t k = 0; k < source.task.keys.size(); ++k)
    if (of.values[k].contraction < little_contraction) unknown.push_back(source.task.keys[k].key);
  if (!unknown.empty()) doubts.push_back(fmt::format("the table says little of {}", fmt::join(unknown, ", ")));
  for (std::size_t k = 0; k < source.task.keys.size(); ++k) {
    const KeyRange& range = source.task.keys[k];
    if (const std::string_view edge = edge_of(range, of.values[k]); !edge.empty())
      doubts.push_back(fmt::format(
          "{} lies at the {} edge of its range, {:g} to {:g}: what is better may lie beyond it (a wider --fit)",
          range.key, edge, range.low, range.high));
    if (of.values[k].contraction < 0)
      doubts.push_back(
          fmt::format("{} scatters more than an even spread over its range would (contraction below 0): the "
                      "table speaks for both ends of the range at once",
                      range.key));
  }
  if (is_beyond_its_noise(source))
    doubts.push_back(
        fmt::format("no values within the ranges meet the table: the best ones miss it by {:.2g} times its noise. "
                    "Nothing was fitted",
                    of.misfit_over_noise));
  else if (of.misfit_probability < unlikely_misfit)
    doubts.push_back(
        "the model nowhere meets the table within its noise, so the intervals are too narrow: something "
        "else is wrong than what was fitted, or the noise is larger (--noise)");
  if (of.posterior.effective_points < few_effective_points)
    doubts.push_back(fmt::format("the intervals rest on {:.0f} effective points only", of.posterior.effective_points));
  const auto left_out = std::ranges::count_if(source.runs, [](const ReducedRun& run) { return !run.reason.empty(); });
  if (left_out > 0)
    doubts.push_back(
        fmt::format("{} of {} runs were left out (calibration_runs.csv says why)", left_out, source.runs.size()));
  if (!of.held_out_rms) doubts.push_back("nothing was held out, so that no prediction was tested");
  return doubts;
}

std::vector<FileText> calibration_file_texts() {
  const std::vector<KeyRange> any{KeyRange{.key = "KEY"}};
  return {
      page_data_text(),
      calibration_page_text(),
      file_text("calibration.csv", "one row per fitted number", value_columns()),
      file_text("prediction.csv", "one row per measured value: what the fitted model says of it", prediction_columns()),
      file_text("posterior.csv", "points of equal weight from what is known of the fitted keys, one a row",
                posterior_columns(any, true)),
      file_text("calibration_runs.csv", "one row per run that was made", run_columns(any)),
      {"contact.toml",
       "a contact model with the means of the fitted values and where each is from, for "
       "`[contact] model = \"contact.toml\"`; none where the table is not met within its noise, a value lies at the "
       "edge of "
       "its range, or seeds went through walls",
       {}}};
}

std::vector<OutputFile> calibration_files(const CalibrationSource& source, const Contact& fitted, CsvFormat format) {
  const std::vector<KeyRange>& keys = source.task.keys;
  const bool with_factor = source.calibration.depth_factor.has_value();
  std::vector<OutputFile> files = {
      {"calibration.csv", csv_of(value_columns(), value_rows(source), format)},
      {"prediction.csv", csv_of(prediction_columns(), prediction_rows(source), format)},
      {"posterior.csv", csv_of(posterior_columns(keys, with_factor), sample(source), format)},
      {"calibration_runs.csv", csv_of(run_columns(keys), run_rows(source), format)}};
  if (gives_a_contact(source))
    files.push_back(
        {"contact.toml",
         contact_model_toml(fitted, fmt::format("Fitted to {}", source.task.measured.file.filename().string()),
                            sources(source))});
  return files;
}

}  // namespace vibrosow
