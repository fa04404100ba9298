#include "report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "report/csv.hpp"
#include "report/output_files.hpp"
#include "report/record_report.hpp"
#include "scene/scene_json.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

std::string in_unit(std::optional<double> si_value, std::string_view unit, Dimension dimension) {
  if (si_value) *si_value /= unit_size(unit, dimension);
  return csv_number(si_value);
}

std::string millimetres(std::optional<double> length) {
  return in_unit(length, "mm", Dimension::length);
}
std::string grams(double mass) {
  return in_unit(mass, "g", Dimension::mass);
}
std::string grams_per_second(std::optional<double> rate) {
  return in_unit(rate, "g/s", Dimension::mass_rate);
}

Json percent(const std::optional<double>& fraction) {
  return fraction ? Json(*fraction / unit_size("%", Dimension::fraction)) : Json(nullptr);
}

std::string_view name_of(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
      return "finished";
    case RunStatus::stopped_by_guard:
      return "stopped by the guard";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "";
}

Json energy_json(const EnergyAccount& energy) {
  return {{"kinetic", energy.kinetic},
          {"potential", energy.potential},
          {"elastic", energy.elastic},
          {"wall_work", energy.wall_work},
          {"inserted", energy.inserted},
          {"removed", energy.removed},
          {"made_by_numerics", energy.made_by_numerics}};
}

Json balance_json(const Balance& balance) {
  return {{"put_in", balance.put_in},
          {"inside", balance.inside},
          {"counted", balance.counted},
          {"spilled", balance.spilled},
          {"lost", balance.lost}};
}

Json outflow_json(const Outflow& outflow) {
  return {{"window_s", {outflow.window_from, outflow.window_to}},
          {"evenness_cv_percent", percent(outflow.evenness_cv)},
          {"counting_cv_percent", percent(outflow.counting_cv)},
          {"instability_cv_percent", percent(outflow.instability_cv)},
          {"instability_windows", instability_windows},
          {"spilled_percent", percent(outflow.spilled_fraction)},
          {"depth_factor", outflow.depth_factor ? Json(*outflow.depth_factor) : Json(nullptr)},
          {"note", outflow.note}};
}

/// The title stands in the report already.
Json untitled(Scene scene) {
  scene.title.clear();
  return Json::parse(scene_to_json(scene));
}

std::string text_of(const Json& json) {
  return json.dump(2) + '\n';
}

}  // namespace

std::string outflow_csv(const Scene& scene, const Run& run) {
  CsvTable table({"time_s", "hole", "lot", "grain", "mass_g", "x_mm", "speed_m_per_s"});
  for (const OutflowEvent& event : run.events)
    table.add_row({csv_number(event.time), event.hole > 0 ? fmt::format("{}", event.hole) : "spilled",
                   scene.lots.at(static_cast<std::size_t>(event.lot)).name, csv_number(event.grain), grams(event.mass),
                   millimetres(event.x), csv_number(event.speed)});
  return table.text();
}

std::string summary_csv(const Outflow& outflow) {
  CsvTable table({"hole", "lot", "position_mm", "width_mm", "grains", "mass_g", "seeds_per_s", "rate_g_per_s",
                  "longest_pause_s", "depth_factor", "tray_rate_g_per_s", "note"});
  for (const HoleOutflow& row : outflow.holes) {
    std::optional<double> tray_rate;
    if (outflow.depth_factor) tray_rate = row.mass_rate * *outflow.depth_factor;
    table.add_row({row.hole, row.lot, millimetres(row.centre), millimetres(row.width), csv_number(row.grains),
                   grams(row.mass), csv_number(row.seeds_per_s), grams_per_second(row.mass_rate),
                   csv_number(row.longest_pause), csv_number(outflow.depth_factor), grams_per_second(tray_rate),
                   outflow.note});
  }
  return table.text();
}

std::string run_json(const Scene& scene, const Run& run, const Outflow& outflow,
                     const std::vector<std::string>& effects) {
  const Json json = {{"title", scene.title},
                     {"status", name_of(run.status)},
                     {"stop_reason", run.stop_reason},
                     {"warnings", run.warnings},
                     {"outside_the_model", run.outside_the_model},
                     {"random_seed", run.random_seed},
                     {"dt_s", run.dt},
                     {"steps", run.steps},
                     {"end_time_s", run.end_time},
                     {"end_reason", run.end_reason},
                     {"grain_steps", run.grain_steps},
                     {"force_evaluations", run.force_evaluations},
                     {"effects", effects},
                     {"max_compression", run.max_compression},
                     {"energy_J", energy_json(run.energy)},
                     {"balance", balance_json(run.balance)},
                     {"outflow", outflow_json(outflow)},
                     {"versions", {{"vibrosow", VIBROSOW_VERSION}, {"box2d", VIBROSOW_BOX2D_VERSION}}},
                     {"scene", untitled(scene)}};
  return text_of(json);
}

std::string timing_json(const Run& run) {
  Json json = {{"wall_s", run.wall_time}, {"measured_wall_s", run.measured_wall_time}, {"grain_steps_per_s", nullptr}};
  if (run.wall_time <= 0) return text_of(json);
  json["grain_steps_per_s"] = static_cast<double>(run.grain_steps) / run.wall_time;
  if (run.phase_times)
    for (std::size_t k = 0; k < phase_names.size(); ++k)
      json["fractions"][std::string(phase_names[k])] = (*run.phase_times)[k] / run.wall_time;
  return text_of(json);
}

void write_run_report(const std::filesystem::path& directory, const Scene& scene, const Run& run,
                      const Outflow& outflow, const std::vector<std::string>& effects) {
  std::vector<OutputFile> files = {{"outflow.csv", outflow_csv(scene, run)},
                                   {"summary.csv", summary_csv(outflow)},
                                   {"run.json", run_json(scene, run, outflow, effects)},
                                   {"timing.json", timing_json(run)}};
  std::ranges::move(record_files(scene, run), std::back_inserter(files));
  write_files_atomically(directory, files);
}

}  // namespace vibrosow
