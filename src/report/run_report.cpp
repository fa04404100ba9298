#include "report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "report/columns.hpp"
#include "report/output_files.hpp"
#include "report/record_report.hpp"
#include "scene/describe_scene.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// A grain that left.
struct EventRow {
  const Scene* scene;
  const OutflowEvent* event;
};

Columns<EventRow> outflow_columns() {
  using R = const EventRow&;
  return {quantity_column<EventRow>("time_s", seconds, "when its centre crossed the counting line",
                                    [](R r) { return r.event->time; }),
          text_column<EventRow>("hole", "number of the hole from the left; spilled: it passed none",
                                [](R r) { return r.event->hole > 0 ? fmt::format("{}", r.event->hole) : "spilled"; }),
          text_column<EventRow>("lot", "name of its seeds",
                                [](R r) { return r.scene->lots.at(static_cast<std::size_t>(r.event->lot)).name; }),
          text_column<EventRow>("grain", "its number, in order of insertion", [](R r) { return r.event->grain; }),
          quantity_column<EventRow>("mass_g", grams, "its mass", [](R r) { return r.event->mass; }),
          quantity_column<EventRow>("x_mm", millimetres,
                                    "where it passed the floor, from the tray's left end; of a spilled grain where it "
                                    "was counted",
                                    [](R r) { return r.event->x; }),
          quantity_column<EventRow>("speed_m_per_s", metres_per_second, "its speed at the counting line",
                                    [](R r) { return r.event->speed; })};
}

struct SummaryRow {
  const Outflow* outflow;
  const HoleOutflow* hole;
};

std::optional<double> tray_rate(const SummaryRow& row) {
  if (!row.outflow->depth_factor) return std::nullopt;
  return row.hole->mass_rate * *row.outflow->depth_factor;
}

Columns<SummaryRow> summary_columns() {
  using R = const SummaryRow&;
  return {text_column<SummaryRow>("hole", "number of the hole from the left, or all", [](R r) { return r.hole->hole; }),
          text_column<SummaryRow>("lot", "name of the seeds, or all", [](R r) { return r.hole->lot; }),
          quantity_column<SummaryRow>("position_mm", millimetres, "middle of the hole, from the tray's left end",
                                      [](R r) { return r.hole->centre; }),
          quantity_column<SummaryRow>("width_mm", millimetres, "of the hole", [](R r) { return r.hole->width; }),
          text_column<SummaryRow>("grains", "that left in the window, of the plane slice",
                                  [](R r) { return r.hole->grains; }),
          quantity_column<SummaryRow>("mass_g", grams, "that left in the window, of the plane slice",
                                      [](R r) { return r.hole->mass; }),
          quantity_column<SummaryRow>("seeds_per_s", per_second, "of the plane slice",
                                      [](R r) { return r.hole->seeds_per_s; }),
          quantity_column<SummaryRow>("rate_g_per_s", grams_per_second, "of the plane slice",
                                      [](R r) { return r.hole->mass_rate; }),
          quantity_column<SummaryRow>("longest_pause_s", seconds, "longest time in the window without a seed",
                                      [](R r) { return r.hole->longest_pause; }),
          quantity_column<SummaryRow>("depth_factor", plain,
                                      "tray.depth over the thickness of the plane slice; empty without tray.depth",
                                      [](R r) { return r.outflow->depth_factor; }),
          quantity_column<SummaryRow>("tray_rate_g_per_s", grams_per_second,
                                      "of the whole tray: the slice's rate times the depth factor", tray_rate),
          text_column<SummaryRow>("note", "what to know about the run; empty when all is well",
                                  [](R r) { return r.outflow->note; })};
}

Json in_percent(const std::optional<double>& fraction) {
  return fraction ? Json(*fraction / percent.size) : Json(nullptr);
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
          {"evenness_cv_percent", in_percent(outflow.evenness_cv)},
          {"counting_cv_percent", in_percent(outflow.counting_cv)},
          {"instability_cv_percent", in_percent(outflow.instability_cv)},
          {"instability_windows", instability_windows},
          {"spilled_percent", in_percent(outflow.spilled_fraction)},
          {"depth_factor", outflow.depth_factor ? Json(*outflow.depth_factor) : Json(nullptr)},
          {"note", outflow.note}};
}

std::string text_of(const Json& json) {
  return json.dump(2) + '\n';
}

}  // namespace

std::string outflow_csv(const Scene& scene, const Run& run) {
  Csv<EventRow> csv(outflow_columns());
  for (const OutflowEvent& event : run.events) csv.add({&scene, &event});
  return csv.text();
}

std::string summary_csv(const Outflow& outflow) {
  Csv<SummaryRow> csv(summary_columns());
  for (const HoleOutflow& hole : outflow.holes) csv.add({&outflow, &hole});
  return csv.text();
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
                     {"scene", describe_scene(scene)}};
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
