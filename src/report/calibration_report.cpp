#include "report/calibration_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

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

std::string confused_with(const FittedNumber& number) {
  return fmt::format("{}", fmt::join(number.not_told_apart_from, ";"));
}

Columns<FittedNumber> value_columns(bool is_fitted = true) {
  using Row = const FittedNumber&;
  return {
      text_column<FittedNumber>("key", "that was fitted; depth_factor: what rates of the 2D slice are multiplied by",
                                [](Row r) { return r.name; }),
      text_column<FittedNumber>("unit", "of the values of this row", [](Row r) { return r.unit; }),
      quantity_column<FittedNumber>("prior_low", plain, "from where on it was taken to lie; empty: anywhere",
                                    [](Row r) { return r.low; }),
      quantity_column<FittedNumber>("prior_high", plain, "up to where", [](Row r) { return r.high; }),
      quantity_column<FittedNumber>("mean", plain, "of what is known of it now", [](Row r) { return r.value.mean; }),
      quantity_column<FittedNumber>("low", plain, "lower end of its 95 % interval", [](Row r) { return r.value.low; }),
      quantity_column<FittedNumber>("high", plain, "upper end of its 95 % interval",
                                    [](Row r) { return r.value.high; }),
      quantity_column<FittedNumber>(
          "contraction_percent", percent,
          "by how much its standard deviation is below that of the range it was fitted in; 0: nothing learned",
          [](Row r) { return r.value.contraction; }),
      text_column<FittedNumber>("not_told_apart_from", "others with which it is correlated above 0.8 either way",
                                [](Row r) { return confused_with(r); }),
      text_column<FittedNumber>("edge", "lower or upper, where it lies at that end of its range; else empty",
                                [](Row r) { return name_of(r.edge); }),
      text_column<FittedNumber>("fitted", "no: no values within the ranges meet the table, and these mean nothing",
                                [is_fitted](Row) { return std::string(is_fitted ? "yes" : "no"); })};
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
  const CalibrationAnswer* answer;
  Eigen::VectorXd parts;
  std::optional<double> factor{};  // the depth factor
  std::size_t run = 0;             // index of the run
};

Columns<PointRow> fitted_key_columns(const std::vector<KeyRange>& keys) {
  Columns<PointRow> columns;
  for (std::size_t k = 0; k < keys.size(); ++k)
    columns.push_back(quantity_column<PointRow>(
        condition_column(keys[k].key), plain, "value of a fitted key",
        [k](const PointRow& r) { return r.answer->task.keys[k].at(r.parts(static_cast<Eigen::Index>(k))); }));
  return columns;
}

Columns<PointRow> posterior_columns(const std::vector<KeyRange>& keys, bool with_factor) {
  Columns<PointRow> columns = fitted_key_columns(keys);
  if (with_factor)
    columns.push_back(quantity_column<PointRow>(depth_factor_name, plain,
                                                "what rates of the 2D slice are multiplied by, where it is fitted",
                                                [](const PointRow& r) { return r.factor; }));
  return columns;
}

Columns<PointRow> run_columns(const std::vector<KeyRange>& keys) {
  Columns<PointRow> columns = fitted_key_columns(keys);
  append(
      columns,
      {text_column<PointRow>("conditions", "of the run",
                             [](const PointRow& r) {
                               return conditions_text(
                                   r.answer->design.conditions[r.answer->design.runs[r.run].condition]);
                             }),
       text_column<PointRow>("random_seed", "of the run",
                             [](const PointRow& r) { return r.answer->design.runs[r.run].random_seed; }),
       text_column<PointRow>("left_out", "why it counts for nothing",
                             [](const PointRow& r) { return r.answer->runs[r.run].reason; }),
       text_column<PointRow>(
           "simulated",
           "values of its conditions' series, in their order, separated by spaces, unscaled but for --scale "
           "depth; in the unit of the table's quantity",
           [](const PointRow& r) {
             std::vector<std::string> values;
             for (const double value : r.answer->runs[r.run].values)
               values.push_back(fmt::format("{:.6g}", to_column_unit(r.answer->task.measured.table.quantity, value)));
             return fmt::format("{}", fmt::join(values, " "));
           })});
  return columns;
}

std::vector<PointRow> sample(const CalibrationAnswer& answer) {
  const PosteriorSample& known = answer.calibration.posterior;
  std::vector<PointRow> rows;
  for (const Eigen::Index i : points_of_equal_weight(known.weights, sample_rows))
    rows.push_back({&answer, known.points.row(i).transpose(),
                    known.shifts.size() > 0 ? std::optional(std::exp(known.shifts(i))) : std::nullopt});
  return rows;
}

std::vector<PointRow> run_rows(const CalibrationAnswer& answer) {
  std::vector<PointRow> rows;
  for (std::size_t run = 0; run < answer.runs.size(); ++run)
    rows.push_back({&answer, answer.design.points.row(answer.design.runs[run].point).transpose(), std::nullopt, run});
  return rows;
}

std::vector<PredictionRow> prediction_rows(const CalibrationAnswer& answer) {
  std::vector<PredictionRow> rows;
  for (const PredictedValue& value : answer.calibration.predictions)
    rows.push_back({&answer.task.measured.table, &value});
  return rows;
}

std::string provenance(const CalibrationAnswer& answer, const FittedNumber& row) {
  std::string text = fmt::format(
      "fitted to {} with {} ({} of {} runs, vibrosow calibrate): 95 % interval {} to {}{}, uncertainty reduced by "
      "{:.0f} %",
      answer.task.measured.file.filename().string(), answer.task.seeder.filename().string(), answer.runs_used,
      answer.runs.size(), to_digits(row.value.low, 3), to_digits(row.value.high, 3),
      row.unit.empty() ? "" : fmt::format(" {}", row.unit), 100 * row.value.contraction);
  if (!row.not_told_apart_from.empty()) text += fmt::format("; not told apart from {}", confused_with(row));
  return text;
}

std::vector<std::pair<std::string, std::string>> sources(const CalibrationAnswer& answer) {
  std::vector<std::pair<std::string, std::string>> result;
  for (const FittedNumber& row : answer.numbers) {
    const std::string text = provenance(answer, row);
    if (row.name == depth_factor_name)
      result.emplace_back(depth_factor_name,
                          fmt::format("{} ({}): what rates of the 2D slice are multiplied by, no part of the contact; "
                                      "for tray.depth = factor times seed diameter",
                                      to_digits(row.value.mean, 4), text));
    else
      result.emplace_back(row.name.substr(std::string("contact.").size()), text);
  }
  result.emplace_back("others", fmt::format("as {} has them", answer.task.seeder.filename().string()));
  return result;
}

/// The fitted factor beside the one that the tray's depth means; empty without either.
std::string depth_factor_text(const CalibrationAnswer& answer) {
  const auto& fitted = answer.calibration.depth_factor;
  if (!fitted || answer.design.runs.empty()) return "";
  const auto slices = slices_of_tray(answer.design.runs.front().scene);
  if (!slices) return "";
  return fmt::format("depth factor fitted: {} ({} to {}); tray.depth over the slice's thickness is {}",
                     to_digits(fitted->mean, 3), to_digits(fitted->low, 3), to_digits(fitted->high, 3),
                     to_digits(*slices, 3));
}

}  // namespace

std::string conditions_text(const std::vector<Condition>& conditions) {
  std::vector<std::string> parts;
  for (const Condition& condition : conditions) {
    const auto unit = column_unit(condition.key);
    parts.push_back(
        fmt::format("{} = {}{}", condition.key, condition.text, unit ? fmt::format(" {}", unit->unit) : ""));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string calibration_table(const CalibrationAnswer& answer) {
  const Calibration& of = answer.calibration;
  std::string text;
  for (const SharedDoubt& doubt : answer.doubts) text += wrapped(sentence_of(remark_of(doubt)));
  if (!text.empty()) text += '\n';
  text += fmt::format("{:<28} {:>6} {:>9} {:>21} {:>11}\n", "key", "unit", "mean", "95 % interval", "uncertainty");
  for (const FittedNumber& row : answer.numbers)
    text +=
        fmt::format("{:<28} {:>6} {:>9} {:>9} to {:>8} {:>+9.0f} %\n", row.name, row.unit, to_digits(row.value.mean, 4),
                    to_digits(row.value.low, 3), to_digits(row.value.high, 3), -100 * row.value.contraction);
  text += fmt::format("\n{}",
                      wrapped(fmt::format("noise of one measurement: {:.2g} % ({})", 100 * of.noise, of.noise_source)));
  const char* of_what = is_curve(answer.task.measured.table.quantity) ? "percent of the largest value" : "%";
  if (of.fitted_rms)
    text += wrapped(fmt::format("fitted values are met to {:.2g} {} (RMS)", 100 * *of.fitted_rms, of_what));
  if (of.held_out_rms)
    text += wrapped(fmt::format("held out, and predicted to {:.2g} {} (RMS)", 100 * *of.held_out_rms, of_what));
  if (const std::string factor = depth_factor_text(answer); !factor.empty()) text += wrapped(factor);
  if (answer.lots_have_own_contacts)
    text += wrapped(
        "No contact.toml is written: each lot has the contact model of its crop. Write the fitted keys into "
        "the seeder's [contact], beside model = \"crop\".");
  else if (!answer.gives_a_contact)
    text += wrapped("No contact.toml is written: what is doubtful above would be used with it.");
  return text;
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
      doubts_file_text(),
      {"contact.toml",
       "a contact model with the means of the fitted values and where each is from, for "
       "`[contact] model = \"contact.toml\"`; none where the table is not met within its noise, a value lies at the "
       "edge of its range, seeds went through walls, or each of several lots has the model of its crop",
       {}}};
}

std::vector<OutputFile> calibration_files(const CalibrationAnswer& answer, const Contact& fitted, CsvFormat format) {
  const std::vector<KeyRange>& keys = answer.task.keys;
  const bool with_factor = answer.calibration.depth_factor.has_value();
  std::vector<OutputFile> files = {
      {"calibration.csv", csv_of(value_columns(answer.is_fitted), answer.numbers, format)},
      {"prediction.csv", csv_of(prediction_columns(), prediction_rows(answer), format)},
      {"posterior.csv", csv_of(posterior_columns(keys, with_factor), sample(answer), format)},
      {"calibration_runs.csv", csv_of(run_columns(keys), run_rows(answer), format)},
      doubts_file(answer.doubts)};
  if (answer.gives_a_contact)
    files.push_back(
        {"contact.toml",
         contact_model_toml(fitted, fmt::format("Fitted to {}", answer.task.measured.file.filename().string()),
                            sources(answer))});
  return files;
}

}  // namespace vibrosow
