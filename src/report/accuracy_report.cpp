#include "report/accuracy_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report/csv.hpp"
#include "report/output_files.hpp"
#include "scene/integrator_names.hpp"

namespace vibrosow {
namespace {

constexpr double gram = 1e-3;                   // kg
constexpr double millimetre_per_second = 1e-3;  // m/s
constexpr double megapascal = 1e6;              // Pa

using Fields = std::vector<std::string>;

Fields setting_fields(const AccuracySetting& setting) {
  return {integrator_name(setting.integrator),
          csv_number(setting.dt),
          csv_number(setting.steps_per_contact),
          setting.shell_compression > 0 ? csv_number(setting.shell_compression) : "",
          setting.youngs_modulus > 0 ? csv_number(setting.youngs_modulus / megapascal) : "",
          csv_number(setting.slip_speed / millimetre_per_second)};
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
  return fmt::format("{}, {:g} steps a contact, {}, slip speed {:g} mm/s", integrator_name(setting.integrator),
                     setting.steps_per_contact, softness, setting.slip_speed / millimetre_per_second);
}

std::string setting_and_error(const AccuracyRow& row) {
  return fmt::format("{} (error {}, at {:.3g} of its cost)", setting_text(row.setting), error_text(row),
                     row.cost_ratio.value_or(1));
}

std::string unresolved_text(const AccuracyRow& row, const std::optional<int>& replicates) {
  return fmt::format("Whether {} is within 1 % these replicates do not tell; {}.", setting_and_error(row),
                     replicates ? fmt::format("about {} would", *replicates) : "no affordable number would");
}

}  // namespace

std::string accuracy_csv(const AccuracyResult& result) {
  CsvTable table({"integrator", "dt_s", "steps_per_contact", "shell_compression", "youngs_modulus_MPa",
                  "slip_speed_mm_per_s", "replicates", "rate_g_per_s", "rate_ci95", "error_percent", "error_ci95",
                  "grain_steps", "cost_ratio", "on_front"});
  for (const AccuracyRow& row : result.rows) {
    Fields fields = setting_fields(row.setting);
    fields.push_back(fmt::format("{}", row.replicates));
    const auto& rate = row.mass_rate;
    fields.push_back(rate ? csv_number(rate->mean / gram) : "");
    fields.push_back(rate && rate->half_width_95 ? csv_number(*rate->half_width_95 / gram) : "");
    fields.push_back(csv_number(row.error_percent));
    fields.push_back(csv_number(row.error_ci95));
    fields.push_back(rate ? csv_number(row.grain_steps) : "");
    fields.push_back(csv_number(row.cost_ratio));
    fields.push_back(rate ? (row.on_front ? "yes" : "no") : "");
    table.add_row(fields);
  }
  return table.text();
}

std::string accuracy_timing_csv(const AccuracyResult& result) {
  CsvTable table({"integrator", "dt_s", "steps_per_contact", "shell_compression", "youngs_modulus_MPa",
                  "slip_speed_mm_per_s", "wall_s", "grain_steps_per_s", "wall_ratio"});
  const double reference = result.rows[result.reference].wall_time;
  for (const AccuracyRow& row : result.rows) {
    Fields fields = setting_fields(row.setting);
    const bool timed = row.mass_rate && row.wall_time > 0;
    fields.push_back(timed ? csv_number(row.wall_time) : "");
    fields.push_back(timed ? csv_number(row.grain_steps / row.wall_time) : "");
    fields.push_back(timed && reference > 0 ? csv_number(row.wall_time / reference) : "");
    table.add_row(fields);
  }
  return table.text();
}

std::string accuracy_table(const AccuracyResult& result) {
  const bool hertz = result.rows.front().setting.youngs_modulus > 0;
  std::string text = fmt::format("{:<16} {:>5} {:>9} {:>7} {:>9} {:>10} {:>18} {:>9} {}\n", "integrator", "steps",
                                 hertz ? "E MPa" : "eps/r", "slip", "dt s", "rate g/s", "error", "cost", "front");
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const AccuracyRow& row = result.rows[i];
    const AccuracySetting& setting = row.setting;
    text +=
        fmt::format("{:<16} {:>5g} {:>9g} {:>7g} {:>9.3g} ", integrator_name(setting.integrator),
                    setting.steps_per_contact, hertz ? setting.youngs_modulus / megapascal : setting.shell_compression,
                    setting.slip_speed / millimetre_per_second, setting.dt);
    if (!row.mass_rate) {
      text += fmt::format("{}\n", row.refused);
      continue;
    }
    const bool reference = i == result.reference;
    const std::string error = reference ? "reference" : (row.error_percent ? error_text(row) : "");
    text += fmt::format("{:>10.5g} {:>18} {:>9.3g} {}\n", row.mass_rate->mean / gram, error, row.cost_ratio.value_or(0),
                        row.on_front ? "*" : "");
  }
  return text;
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

void write_accuracy_report(const std::filesystem::path& directory, const AccuracyResult& result, double wall_time,
                           int jobs) {
  nlohmann::ordered_json timing;
  timing["wall_s"] = wall_time;
  timing["jobs"] = jobs;
  double grain_steps = 0, run_time = 0;
  for (const AccuracyRow& row : result.rows) {
    grain_steps += row.grain_steps * row.replicates;
    run_time += row.wall_time * row.replicates;
  }
  timing["run_wall_s"] = run_time;
  timing["grain_steps"] = grain_steps;
  timing["grain_steps_per_s"] = wall_time > 0 ? grain_steps / wall_time : 0;
  write_files_atomically(directory, {{"accuracy.csv", accuracy_csv(result)},
                                     {"accuracy_timing.csv", accuracy_timing_csv(result)},
                                     {"timing.json", timing.dump(2) + "\n"}});
}

}  // namespace vibrosow
