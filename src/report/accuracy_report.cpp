#include "report/accuracy_report.hpp"

#include <fmt/format.h>

#include "report/columns.hpp"
#include "report/json_keys.hpp"
#include "report/terminal_text.hpp"
#include "scene/integrator_names.hpp"

namespace vibrosow {
namespace {

constexpr double gram = 1e-3;                   // kg
constexpr double millimetre_per_second = 1e-3;  // m/s
constexpr double megapascal = 1e6;              // Pa

using R = const AccuracyRow&;
using Value = std::optional<double>;

/// The first columns of both files.
Columns<AccuracyRow> setting_columns() {
  return {
      text_column<AccuracyRow>("integrator", "scheme", [](R r) { return integrator_name(r.setting.integrator); }),
      quantity_column<AccuracyRow>("dt_s", seconds, "time step", [](R r) { return r.setting.dt; }),
      quantity_column<AccuracyRow>("steps_per_contact", plain, "contact duration over the time step",
                                   [](R r) { return r.setting.steps_per_contact; }),
      quantity_column<AccuracyRow>("shell_compression", plain, "eps / r; empty where the law has no shell",
                                   [](R r) {
                                     const double compression = r.setting.shell_compression;
                                     return compression > 0 ? Value(compression) : Value();
                                   }),
      quantity_column<AccuracyRow>("youngs_modulus_MPa", megapascals, "empty where the law has a shell",
                                   [](R r) {
                                     const double modulus = r.setting.youngs_modulus;
                                     return modulus > 0 ? Value(modulus) : Value();
                                   }),
      quantity_column<AccuracyRow>("slip_speed_mm_per_s", millimetres_per_second,
                                   "slip speed of friction; empty where friction has none, as a spring has", [](R r) {
                                     const double slip_speed = r.setting.slip_speed;
                                     return slip_speed > 0 ? Value(slip_speed) : Value();
                                   })};
}

Columns<AccuracyRow> accuracy_columns() {
  const Figure& rate = figure_named("rate_g_per_s");
  const Unit unit{rate.unit, rate.unit_size};
  Columns<AccuracyRow> columns = setting_columns();
  append(columns,
         {text_column<AccuracyRow>("replicates", "runs that finished, of which the figures are",
                                   [](R r) { return r.replicates; }),
          quantity_column<AccuracyRow>(std::string(rate.name), unit, std::string(rate.description),
                                       [](R r) { return r.mass_rate ? Value(r.mass_rate->mean) : Value(); }),
          quantity_column<AccuracyRow>("rate_ci95", unit, "half width of its 95 % interval",
                                       [](R r) { return r.mass_rate ? r.mass_rate->half_width_95 : Value(); }),
          quantity_column<AccuracyRow>("error_percent", Unit{"%", 1}, "difference of the rate from the reference's",
                                       [](R r) { return r.error_percent; }),
          quantity_column<AccuracyRow>("error_ci95", Unit{"%", 1}, "half width of its 95 % interval, of both rates",
                                       [](R r) { return r.error_ci95; }),
          quantity_column<AccuracyRow>("grain_steps", plain, "grains times steps, mean of a run",
                                       [](R r) { return r.mass_rate ? Value(r.grain_steps) : Value(); }),
          quantity_column<AccuracyRow>("cost_ratio", plain,
                                       "grain-steps times force evaluations a step, over the reference's",
                                       [](R r) { return r.cost_ratio; }),
          text_column<AccuracyRow>("on_front",
                                   "yes where it errs less, beyond chance, than every cheaper setting so marked",
                                   [](R r) -> std::string {
                                     if (!r.mass_rate) return "";
                                     return r.on_front ? "yes" : "no";
                                   })});
  return columns;
}

bool timed(const AccuracyRow& row) {
  return row.mass_rate && row.wall_time > 0;
}

/// `reference`: wall time of the reference, s.
Columns<AccuracyRow> timing_columns(double reference) {
  Columns<AccuracyRow> columns = setting_columns();
  append(columns,
         {quantity_column<AccuracyRow>("wall_s", seconds, "wall time of this machine, mean of a run",
                                       [](R r) { return timed(r) ? Value(r.wall_time) : Value(); }),
          quantity_column<AccuracyRow>("grain_steps_per_s", per_second, "grains times steps in a second of wall time",
                                       [](R r) { return timed(r) ? Value(r.grain_steps / r.wall_time) : Value(); }),
          quantity_column<AccuracyRow>("wall_ratio", plain, "wall time over the reference's", [reference](R r) {
            return timed(r) && reference > 0 ? Value(r.wall_time / reference) : Value();
          })});
  return columns;
}

struct AccuracyTiming {
  double wall_time;  // s, from beginning to end
  int jobs;
  double run_time = 0, grain_steps = 0;
};

JsonKeys<AccuracyTiming> timing_keys() {
  using T = const AccuracyTiming&;
  return {{"wall_s", "s", "wall time of the command", [](T t) { return t.wall_time; }},
          {"jobs", "", "runs side by side", [](T t) { return t.jobs; }},
          {"run_wall_s", "s", "wall times of the runs, summed", [](T t) { return t.run_time; }},
          {"grain_steps", "", "grains times steps, summed", [](T t) { return t.grain_steps; }},
          {"grain_steps_per_s", "1/s", "these in a second of the command's wall time",
           [](T t) { return t.wall_time > 0 ? t.grain_steps / t.wall_time : 0; }}};
}

/// "-0.4 +- 1.6 %".
std::string error_text(const AccuracyRow& row) {
  const std::string error = fmt::format("{:+.2f}", *row.error_percent);
  return row.error_ci95 ? fmt::format("{} +- {:.2f} %", error, *row.error_ci95) : error + " %";
}

std::string setting_text(const AccuracySetting& setting) {
  const std::string softness = setting.shell_compression > 0
                                   ? fmt::format("shell compression {:g}", setting.shell_compression)
                                   : fmt::format("Young's modulus {:g} MPa", setting.youngs_modulus / megapascal);
  const std::string slip_speed =
      setting.slip_speed > 0 ? fmt::format(", slip speed {:g} mm/s", setting.slip_speed / millimetre_per_second) : "";
  return fmt::format("{}, {:g} steps a contact, {}{}", integrator_name(setting.integrator), setting.steps_per_contact,
                     softness, slip_speed);
}

std::string setting_and_error(const AccuracyRow& row) {
  return fmt::format("{} (error {}, at {:.3g} of its cost)", setting_text(row.setting), error_text(row),
                     row.cost_ratio.value_or(1));
}

std::string setting_columns_text(const AccuracySetting& setting) {
  const double softness = setting.youngs_modulus > 0 ? setting.youngs_modulus / megapascal : setting.shell_compression;
  const std::string slip_speed =
      setting.slip_speed > 0 ? fmt::format("{:>9.4g} ", setting.slip_speed / millimetre_per_second) : "";
  return fmt::format("  {:>5.4g} {:>9.4g} {}{:>9.3g} ", setting.steps_per_contact, softness, slip_speed, setting.dt);
}

/// A line of the table for a terminal.
std::string row_text(const AccuracyRow& row, bool reference) {
  const std::string setting = setting_columns_text(row.setting);
  if (!row.mass_rate) return wrapped_beside(setting, row.refused);
  const std::string error = reference ? "reference" : (row.error_percent ? error_text(row) : "");
  const std::string cost = row.cost_ratio ? fmt::format("{:.3g}", *row.cost_ratio) : "";
  return fmt::format("{}{:>10.5g} {:>19} {:>8}{}\n", setting, row.mass_rate->mean / gram, error, cost,
                     row.on_front ? " *" : "");
}

std::string unresolved_text(const AccuracyRow& row, const std::optional<int>& replicates) {
  return fmt::format("Whether {} is within 1 % these replicates do not tell; {}.", setting_and_error(row),
                     replicates ? fmt::format("about {} would", *replicates) : "no affordable number would");
}

}  // namespace

std::string accuracy_csv(const AccuracyResult& result, CsvFormat format) {
  return csv_of(accuracy_columns(), result.rows, format);
}

std::string accuracy_timing_csv(const AccuracyResult& result, CsvFormat format) {
  return csv_of(timing_columns(result.rows[result.reference].wall_time), result.rows, format);
}

std::string accuracy_table(const AccuracyResult& result) {
  const AccuracySetting& first = result.rows.front().setting;
  std::string text =
      fmt::format("  {:>5} {:>9} {}{:>9} {:>10} {:>19} {:>8}\n", "steps", first.youngs_modulus > 0 ? "E MPa" : "eps/r",
                  first.slip_speed > 0 ? "slip mm/s " : "", "dt s", "rate g/s", "error", "cost");
  std::string scheme;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const AccuracyRow& row = result.rows[i];
    if (const std::string& name = integrator_name(row.setting.integrator); name != scheme)
      scheme = name, text += name + '\n';
    text += row_text(row, i == result.reference);
  }
  return text + '\n' +
         wrapped(
             "cost: grain-steps times force evaluations a step, of the finest setting's; *: no other setting costs "
             "no more and errs less");
}

std::string accuracy_sentence(const AccuracyResult& result) {
  const AccuracyRow& reference = result.rows[result.reference];
  const std::string finest = setting_text(reference.setting);
  if (!reference.mass_rate)
    return fmt::format("The finest setting ({}) has no result ({}), so there is nothing to compare with.", finest,
                       reference.refused);
  if (!reference.error_percent)
    return fmt::format("Nothing flows at the finest setting ({}), so there is nothing to compare with.", finest);
  const Recommendation recommended = recommend(result, 1.0);
  std::string text;
  if (recommended.setting)
    text = fmt::format("The cheapest setting shown to be within 1 % of the finest ({}) is {}.", finest,
                       setting_and_error(result.rows[*recommended.setting]));
  else
    text = fmt::format("No cheaper setting is shown to be within 1 % of the finest ({}).", finest);
  if (!recommended.unresolved) return text;
  return fmt::format("{} {}", text, unresolved_text(result.rows[*recommended.unresolved], recommended.replicates));
}

std::vector<FileText> accuracy_file_texts() {
  return {
      file_text("accuracy.csv", "one row per setting; one that gave no rate has its cells empty", accuracy_columns()),
      file_text("accuracy_timing.csv", "one row per setting: what it took on this machine", timing_columns(0)),
      file_text("timing.json", "what the command took on this machine", timing_keys())};
}

std::vector<OutputFile> accuracy_files(const AccuracyResult& result, double wall_time, int jobs, CsvFormat format) {
  AccuracyTiming timing{wall_time, jobs};
  for (const AccuracyRow& row : result.rows) {
    timing.grain_steps += row.grain_steps * row.replicates;
    timing.run_time += row.wall_time * row.replicates;
  }
  return {{"accuracy.csv", accuracy_csv(result, format)},
          {"accuracy_timing.csv", accuracy_timing_csv(result, format)},
          {"timing.json", json_of(timing_keys(), timing)}};
}

}  // namespace vibrosow
