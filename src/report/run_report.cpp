#include "report/run_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

#include "report/answer_doubts.hpp"
#include "report/columns.hpp"
#include "report/drill_report.hpp"
#include "report/expected_report.hpp"
#include "report/json_keys.hpp"
#include "report/page.hpp"
#include "report/record_report.hpp"
#include "report/run_page.hpp"
#include "report/vtk_report.hpp"
#include "report/xyz_report.hpp"
#include "scene/mixture.hpp"
#include "scene/scene_json.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// A grain that left.
struct EventRow {
  const Scene* scene;
  const OutflowEvent* event;
};

Columns<EventRow> outflow_columns(Space space) {
  using R = const EventRow&;
  Columns<EventRow> columns = {
      quantity_column<EventRow>("time_s", seconds, "when its centre crossed the counting line",
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
  if (space == Space::three_dimensional)
    columns.push_back(quantity_column<EventRow>("z_mm", millimetres, "in 3D: as x, from the tray's front",
                                                [](R r) { return r.event->z; }));
  return columns;
}

struct SummaryRow {
  const Outflow* outflow;
  const HoleOutflow* hole;
  std::optional<ExpectedRate> expected{};  // of the row of all holes and lots
};

std::optional<double> of_tray(const SummaryRow& row, double of_slice) {
  return row.outflow->depth_factor ? std::optional(of_slice * *row.outflow->depth_factor) : std::nullopt;
}

Columns<SummaryRow> summary_columns(bool with_across, bool with_expected) {
  using R = const SummaryRow&;
  Columns<SummaryRow> columns = {
      text_column<SummaryRow>("hole", "number of the hole from the left, or all", [](R r) { return r.hole->hole; }),
      text_column<SummaryRow>("lot", "name of the seeds, or all", [](R r) { return r.hole->lot; }),
      quantity_column<SummaryRow>("position_mm", millimetres, "middle of the hole, from the tray's left end",
                                  [](R r) { return r.hole->centre; }),
      quantity_column<SummaryRow>("width_mm", millimetres, "of the hole", [](R r) { return r.hole->width; }),
      text_column<SummaryRow>("grains", "that left in the window, of the 2D slice or in 3D of the tray",
                              [](R r) { return r.hole->grains; }),
      quantity_column<SummaryRow>("mass_g", grams, "that left in the window, of the 2D slice or in 3D of the tray",
                                  [](R r) { return r.hole->mass; }),
      quantity_column<SummaryRow>("seeds_per_s", per_second, "of the 2D slice or in 3D of the tray",
                                  [](R r) { return r.hole->seeds_per_s; }),
      quantity_column<SummaryRow>("rate_g_per_s", grams_per_second, "of the 2D slice or in 3D of the tray",
                                  [](R r) { return r.hole->mass_rate; }),
      quantity_column<SummaryRow>("longest_pause_s", seconds, "longest time in the window without a seed",
                                  [](R r) { return r.hole->longest_pause; }),
      quantity_column<SummaryRow>("depth_factor", plain,
                                  "tray.depth over the thickness of the 2D slice; in 3D 1; empty without tray.depth",
                                  [](R r) { return r.outflow->depth_factor; }),
      quantity_column<SummaryRow>("tray_rate_g_per_s", grams_per_second,
                                  "of the whole tray: the slice's rate times the depth factor",
                                  [](R r) { return of_tray(r, r.hole->mass_rate); }),
      quantity_column<SummaryRow>("tray_seeds_per_s", per_second, "of the whole tray",
                                  [](R r) { return of_tray(r, r.hole->seeds_per_s); }),
      text_column<SummaryRow>("note", "what to know about the run; empty when all is well",
                              [](R r) { return r.outflow->note(); })};
  if (with_across)
    columns.push_back(quantity_column<SummaryRow>("across_mm", millimetres,
                                                  "in 3D: middle of the hole, from the tray's front",
                                                  [](R r) { return r.hole->across; }));
  if (with_expected)
    add_expected_columns(
        columns, [](R r) -> const auto& { return r.expected; });
  return columns;
}

std::string_view name_of(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
      return "finished";
    case RunStatus::stopped_by_guard:
      return "stopped by the guard";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::refused:
      return "refused";
  }
  return "";
}

/// The title stands in the report already.
Json untitled(Scene scene) {
  scene.title.clear();
  return Json::parse(scene_to_json(scene));
}

/// What run.json is made from.
struct RunSource {
  const Scene& scene;
  const Run& run;
  const Outflow& outflow;
  const std::vector<std::string>& effects;
  const std::optional<ExpectedRate>& expected;
  const MetricMeans metrics = MetricMeans({&outflow});
};

/// Every figure, under its name, and what the rate is expected to be.
JsonKeys<RunSource> metric_keys() {
  JsonKeys<RunSource> keys;
  for (const Metric& metric : metrics())
    keys.push_back({fmt::format("outflow.{}", metric.name), std::string(metric.unit), std::string(metric.description),
                    [&metric](const RunSource& s) {
                      const std::optional<MeanWithInterval>& value = s.metrics[metric];
                      return value ? Json(value->mean / metric.unit_size) : Json(nullptr);
                    }});
  for (const ExpectedMetric& metric : expected_metrics())
    keys.push_back({fmt::format("outflow.{}", metric.name), std::string(metric.unit.name), metric.description,
                    [metric](const RunSource& s) {
                      const std::optional<double> value = s.expected ? metric.of(*s.expected) : std::nullopt;
                      return value ? Json(*value / metric.unit.size) : Json(nullptr);
                    }});
  return keys;
}

Json shares_json(const Scene& scene, const std::vector<LotShare>& shares) {
  Json all = Json::array();
  for (const LotShare& share : shares) {
    all.push_back({{"vessel", share.vessel->name},
                   {"source", share.source == SeedSource::fill ? "fill" : "rain"},
                   {"lot", scene.lots[share.lot].name},
                   {"seeds", share.seeds},
                   {"percent_by_number", 100 * share.of_number},
                   {"asked_percent_by_number", 100 * share.asked_number},
                   {"percent_by_mass", 100 * share.of_mass},
                   {"asked_percent_by_mass", 100 * share.asked_mass}});
    if (share.size) all.back()["size_mm"] = 1e3 * *share.size;
  }
  return all;
}

JsonKeys<RunSource> run_keys() {
  using S = const RunSource&;
  JsonKeys<RunSource> keys = {
      {"title", "", "of the seeder file", [](S s) { return s.scene.title; }},
      {"status", "", "finished, stopped by the guard or interrupted", [](S s) { return name_of(s.run.status); }},
      {"stop_reason", "", "why the guard stopped it", [](S s) { return s.run.stop_reason; }},
      {"doubts", "",
       "what speaks against the figures, each with its kind, whether it is serious, what happened and what to do",
       [](S s) {
         Json doubts = Json::array();
         for (const Doubt& doubt : s.outflow.doubts) doubts.push_back(doubt_json(doubt));
         return doubts;
       }},
      {"outside_the_model", "",
       "whether a step that is too long was allowed, a limit of the guard raised and the usual one passed, or "
       "seeds were lost through walls: such a run must not be used",
       [](S s) { return s.run.outside_the_model; }},
      {"random_seed", "", "of the run", [](S s) { return s.run.random_seed; }},
      {"dt_s", "s", "time step", [](S s) { return s.run.dt; }},
      {"steps", "", "time steps taken", [](S s) { return s.run.steps; }},
      {"end_time_s", "s", "simulated time at the end", [](S s) { return s.run.end_time; }},
      {"end_reason", "", "why a sound run ended before its duration", [](S s) { return s.run.end_reason; }},
      {"grain_steps", "", "grains times steps", [](S s) { return s.run.grain_steps; }},
      {"force_evaluations", "", "how often the forces between grains were worked out",
       [](S s) { return s.run.force_evaluations; }},
      {"slip_speed_raised", "", "in how many of these a hard impact raised the slip speed, which softens its friction",
       [](S s) { return s.run.slip_speed_raised; }},
      {"effects", "", "effects that the scene calls for", [](S s) { return s.effects; }},
      {"max_relative_overlap", "", "largest share of a contact's overlap that one grain takes, over its radius",
       [](S s) { return s.run.max_relative_overlap; }},
      {"let_pass.deep_steps", "", "steps with a relative overlap beyond guard.warn_relative_overlap",
       [](S s) { return s.run.let_pass.deep_steps; }},
      {"let_pass.strides", "",
       "steps, allowed by numerics.allow_long_step, in which a seed could have passed a wall unseen",
       [](S s) { return s.run.let_pass.strides; }},
      {"let_pass.energy_accounts", "",
       "accounts of energy, one in 100 steps, with more made by the numerics than 5 % of what is in play",
       [](S s) { return s.run.let_pass.energy_accounts; }},
      {"energy_J.kinetic", "J", "at the end", [](S s) { return s.run.energy.kinetic; }},
      {"energy_J.potential", "J", "at the end, from the tray's floor", [](S s) { return s.run.energy.potential; }},
      {"energy_J.elastic", "J", "in the contacts at the end", [](S s) { return s.run.energy.elastic; }},
      {"energy_J.wall_work", "J", "done by walls on grains", [](S s) { return s.run.energy.wall_work; }},
      {"energy_J.inserted", "J", "carried by grains put in", [](S s) { return s.run.energy.inserted; }},
      {"energy_J.removed", "J", "carried by grains taken out", [](S s) { return s.run.energy.removed; }},
      {"energy_J.made_by_numerics", "J", "largest rise of what must only fall",
       [](S s) { return s.run.energy.made_by_numerics; }},
      {"balance.put_in", "", "seeds put in: inside + counted + spilled + lost",
       [](S s) { return s.run.balance.put_in; }},
      {"balance.inside", "", "seeds still inside at the end", [](S s) { return s.run.balance.inside; }},
      {"balance.counted", "", "seeds that left through holes, in the whole run",
       [](S s) { return s.run.balance.counted; }},
      {"balance.spilled", "", "seeds that left over the rim", [](S s) { return s.run.balance.spilled; }},
      {"balance.lost", "", "seeds that went through a wall: an error", [](S s) { return s.run.balance.lost; }},
      {"mixture", "",
       "of several lots: what each fill, and rain on average, has of each by number and by mass, beside what was "
       "asked for; of a fill the seeds that were drawn",
       [](S s) { return shares_json(s.scene, lot_shares(s.scene, s.run.drawn)); }},
      {"sizes", "", "of lots with a table of sizes: the same of each size in each fill, in parts of the lot",
       [](S s) { return shares_json(s.scene, size_shares(s.scene, s.run.drawn)); }},
      {"outflow.window_s", "s",
       "begin and end of the measuring window: from run.measure_from, or as much later as makes it whole periods of "
       "the "
       "drive",
       [](S s) {
         return Json{s.outflow.window.from, s.outflow.window.to};
       }},
      {"outflow.instability_windows", "", "parts of the window for that, of whole periods of the drive; 0: of none",
       [](S s) { return std::max<std::int64_t>(0, std::ssize(instability_ends(s.outflow.window)) - 1); }},
      {"outflow.note", "", "as in summary.csv", [](S s) { return s.outflow.note(); }},
      {"versions.vibrosow", "", "of the program", [](S) { return VIBROSOW_VERSION; }},
      {"versions.box2d", "", "of Box2D", [](S) { return VIBROSOW_BOX2D_VERSION; }},
      {"scene", "SI", "the whole scene as it was run", [](S s) { return untitled(s.scene); }}};
  const JsonKeys<RunSource> of_metrics = metric_keys();
  keys.insert(std::ranges::find(keys, "outflow.note", &JsonKey<RunSource>::path), of_metrics.begin(), of_metrics.end());
  return keys;
}

JsonKeys<Run> timing_keys(bool phases) {
  using R = const Run&;
  JsonKeys<Run> keys = {
      {"wall_s", "s", "wall time of the run", [](R r) { return r.wall_time; }},
      {"measured_cpu_s", "s", "processor time of all threads in the measuring window",
       [](R r) { return r.measured_cpu_time; }},
      {"grain_steps_per_s", "1/s", "grains times steps in a second of wall time",
       [](R r) { return r.wall_time > 0 ? Json(static_cast<double>(r.grain_steps) / r.wall_time) : Json(nullptr); }}};
  for (std::size_t k = 0; phases && k < phase_names.size(); ++k)
    keys.push_back({fmt::format("fractions.{}", phase_names[k]), "", "its part of the wall time; with --profile",
                    [k](R r) { return (*r.phase_times)[k] / r.wall_time; }});
  return keys;
}

}  // namespace

std::string outflow_csv(const Scene& scene, const Run& run, CsvFormat format) {
  Csv<EventRow> csv(outflow_columns(scene.space), format);
  for (const OutflowEvent& event : run.events) csv.add({&scene, &event});
  return csv.text();
}

std::string summary_csv(const Outflow& outflow, CsvFormat format, const std::optional<ExpectedRate>& expected) {
  const bool with_across =
      std::ranges::any_of(outflow.holes, [](const HoleOutflow& row) { return row.across.has_value(); });
  Csv<SummaryRow> csv(summary_columns(with_across, expected.has_value()), format);
  for (const HoleOutflow& hole : outflow.holes)
    csv.add({&outflow, &hole, &hole == &outflow.holes.back() ? expected : std::nullopt});
  return csv.text();
}

std::string run_json(const Scene& scene, const Run& run, const Outflow& outflow,
                     const std::vector<std::string>& effects, const std::optional<ExpectedRate>& expected) {
  return json_of(run_keys(), RunSource{scene, run, outflow, effects, expected});
}

std::string timing_json(const Run& run) {
  return json_of(timing_keys(run.phase_times && run.wall_time > 0), run);
}

std::vector<FileText> run_file_texts() {
  std::vector<FileText> texts = {
      file_text("outflow.csv", "one row per seed that left, by time", outflow_columns(Space::three_dimensional)),
      file_text(
          "summary.csv",
          "one row per hole and lot, per hole one of all lots where there are several, then the same of all holes",
          summary_columns(true, true)),
      file_text("run.json", "what the run was and how it went", run_keys()),
      file_text("timing.json", "what the run took on this machine", timing_keys(true))};
  std::ranges::move(record_file_texts(), std::back_inserter(texts));
  texts.push_back(rows_file_text());
  texts.push_back(page_data_text());
  texts.push_back(run_page_text());
  std::ranges::move(vtk_file_texts(), std::back_inserter(texts));
  texts.push_back(xyz_file_text());
  return texts;
}

std::vector<OutputFile> run_files(const Scene& scene, const Run& run, const Outflow& outflow,
                                  const std::vector<std::string>& effects, CsvFormat format,
                                  const std::optional<DrillMetrics>& drill,
                                  const std::optional<ExpectedRate>& expected) {
  std::vector<OutputFile> files = {{"outflow.csv", outflow_csv(scene, run, format)},
                                   {"summary.csv", summary_csv(outflow, format, expected)},
                                   {"run.json", run_json(scene, run, outflow, effects, expected)},
                                   {"timing.json", timing_json(run)}};
  std::ranges::move(record_files(scene, run, format), std::back_inserter(files));
  if (drill) files.push_back({"rows.csv", rows_csv(*drill, format)});
  return files;
}

}  // namespace vibrosow
