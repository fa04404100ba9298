#include "report/run_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "plan/effects.hpp"
#include "plan/scene_warnings.hpp"
#include "plan/softness.hpp"
#include "report/number_text.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"
#include "scene/integrator_names.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

/// JSON knows no infinity and no "not a number".
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

constexpr int all_digits = 15;  // of a count

std::string metric_text(double value) {
  return number_text(value);
}

Json holes(const RunPage& page) {
  Json all = Json::array();
  for (int hole = 1; hole <= static_cast<int>(page.model.scene.tray.holes.size()); ++hole) {
    const HoleOutflow* row = find_row(page.outflow, fmt::format("{}", hole), "all");
    const MeanWithInterval blocks = rate_of_blocks(page.outflow, static_cast<std::size_t>(hole - 1));
    const auto end = [&](double sign) {
      return blocks.half_width_95 ? number(std::max(0.0, row->seeds_per_s + sign * *blocks.half_width_95)) : Json();
    };
    all.push_back({{"hole", hole},
                   {"counted", row->grains},
                   {"counted_all", std::ranges::count(page.run.events, hole, &OutflowEvent::hole)},
                   {"rate", number(row->seeds_per_s)},
                   {"rate_low", end(-1)},
                   {"rate_high", end(1)},
                   {"longest_pause_s", number(row->longest_pause)}});
  }
  return all;
}

/// In 2D rates are of the slice; with a depth the whole tray's stand beside them.
Json hole_table(const RunPage& page) {
  const bool slice = page.model.scene.space == Space::two_dimensional;
  const bool of_tray = slice && page.outflow.depth_factor;
  const std::string rate = slice ? "rate of the slice" : "rate";
  Json columns = Json::array(), rows = Json::array();
  const auto column = [&](const std::string& name, std::string_view unit) {
    columns.push_back({{"name", name}, {"unit", unit}});
  };
  const auto in_millimetres = [](const std::optional<double>& place) {
    return place ? number_text(in_mm(*place), 4) : std::string();
  };
  const bool in_rows = has_rows_of_holes(page.outflow);
  column("hole", ""), column("seeds of", ""), column("position", "mm");
  if (in_rows) column("from the front", "mm");
  column("seeds", "");
  column(rate, "seeds/s"), column(rate, "g/s");
  if (of_tray) column("of the tray", "g/s");
  column("longest pause", "s");
  for (const HoleOutflow& row : page.outflow.holes) {
    Json cells = {row.hole, row.lot, in_millimetres(row.centre)};
    if (in_rows) cells.push_back(in_millimetres(row.across));
    for (const std::string& text :
         {fmt::format("{}", row.grains), metric_text(row.seeds_per_s), metric_text(row.mass_rate * 1e3)})
      cells.push_back(text);
    if (of_tray) cells.push_back(metric_text(row.mass_rate * 1e3 * *page.outflow.depth_factor));
    cells.push_back(metric_text(row.longest_pause));
    rows.push_back(std::move(cells));
  }
  return {{"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

Json unevenness(const std::optional<Unevenness>& of) {
  if (!of) return nullptr;
  return {{"sentence", unevenness_sentence(*of, "hole")}, {"cv_percent", of->cv ? Json(100 * *of->cv) : Json(nullptr)}};
}

std::string headline(const RunPage& page) {
  const Scene& scene = page.model.scene;
  const Outflow& outflow = page.outflow;
  const HoleOutflow& all = *find_row(outflow, "all", "all");
  if (!std::isfinite(all.mass_rate)) return "The run ended before its measuring window began: there are no rates.";
  const std::size_t holes = scene.tray.holes.size();
  const bool slice = scene.space == Space::two_dimensional;
  const double factor = outflow.depth_factor.value_or(1);
  const std::optional<double> chance = chance_of_rate({&outflow});
  const auto rate = [&](double value) {
    return interval_text(value * factor, chance ? std::optional(value * factor * *chance) : std::nullopt, "±");
  };
  std::string text = fmt::format("{} let{} out {} g/s, {} seeds/s ({}), between {} and {} s",
                                 holes == 1 ? "One hole" : fmt::format("{} holes", holes), holes == 1 ? "s" : "",
                                 rate(all.mass_rate * 1e3), rate(all.seeds_per_s),
                                 chance ? "95 %, by blocks of this run" : "too few for an interval",
                                 metric_text(outflow.window.from), metric_text(outflow.window.to));
  if (slice && outflow.depth_factor)
    text += fmt::format(
        ": of the whole tray, {} times the slice that was simulated, whose holes are slots from front to back",
        metric_text(factor));
  else if (slice)
    text += ": of a slice one seed thick";
  return text + '.';
}

/// What the guard saw; its warnings stand among the doubts.
std::string guard_sentence(const Run& run, const GuardLimits& limits) {
  if (run.status == RunStatus::stopped_by_guard) return fmt::format("The guard stopped the run: {}.", run.stop_reason);
  std::string text =
      fmt::format("The deepest contact pressed a grain by {} % of its radius (warned from {} %)",
                  number_text(100 * run.max_relative_overlap, 2), number_text(100 * limits.warn_relative_overlap));
  if (run.balance.lost > 0) text += fmt::format("; {} seeds went through walls", run.balance.lost);
  if (run.let_pass.energy_accounts > 0)
    text += fmt::format("; the numerics made energy in {} accounts of it", run.let_pass.energy_accounts);
  if (run.let_pass.strides > 0)
    text += fmt::format("; in {} steps a seed could have passed a wall unseen", run.let_pass.strides);
  if (run.outside_the_model) return text + "; the run lies outside the model: it must not be used.";
  return text + '.';
}

Json settings(const RunPage& page) {
  const Model& model = page.model;
  Json all = Json::array();
  const auto add = [&](std::string_view name, const std::string& value) {
    all.push_back({{"name", name}, {"value", value}});
  };
  add("contact law", std::string(model.law->name));
  add(model.law->material == LawMaterial::shell ? "shell compression" : "Young's modulus",
      model.law->material == LawMaterial::shell ? number_text(softness_of(model.scene, *model.law))
                                                : number_text(1e-6 / softness_of(model.scene, *model.law), 4) + " MPa");
  add("scheme", integrator_name(model.scene.numerics.integrator));
  add("time step", time_text(page.run.dt));
  add("steps", number_text(static_cast<double>(page.run.steps), all_digits));
  add("seeds put in", number_text(static_cast<double>(page.run.balance.put_in), all_digits));
  add("random seed", fmt::format("{}", page.run.random_seed));
  add("program", fmt::format("vibrosow {}", VIBROSOW_VERSION));
  return all;
}

Json effects(const Model& model) {
  Json all = Json::array();
  for (const EffectReason& effect : explain_effects(model.scene, model.effects, *model.law))
    all.push_back({{"name", effect.effect}, {"present", effect.present}, {"why", effect.reason}});
  return all;
}

Json drill(const std::optional<DrillMetrics>& metrics, Space space) {
  if (!metrics) return nullptr;
  Json rows = Json::array();
  for (const RowMetrics& row : metrics->rows)
    if (row.row > 0)
      rows.push_back({{"row", row.row},
                      {"kg_per_ha", row.kg_per_m2 ? Json(1e4 * *row.kg_per_m2) : Json(nullptr)},
                      {"low", nullptr},
                      {"high", nullptr}});
  const RowMetrics& all = metrics->all();
  return {{"rows", std::move(rows)},
          {"sentence", all.kg_per_m2 ? fmt::format("All rows together sow {} kg/ha{}.",
                                                   number_text(1e4 * *all.kg_per_m2), of_plane(space))
                                     : std::string("Without tray.depth there is no rate per area.")}};
}

std::string_view status_name(const Run& run) {
  if (run.status == RunStatus::finished && !run.goes_on) return "finished";
  return run.status == RunStatus::stopped_by_guard ? "stopped_by_guard" : "interrupted";
}

}  // namespace

Json page_events(const Run& run) {
  Json times = Json::array(), of_hole = Json::array(), of_lot = Json::array();
  for (const OutflowEvent& event : run.events) {
    times.push_back(std::round(event.time * 1e5) / 1e5);
    of_hole.push_back(event.hole);
    of_lot.push_back(event.lot);
  }
  return {{"time_s", std::move(times)}, {"hole", std::move(of_hole)}, {"lot", std::move(of_lot)}};
}

std::vector<Remark> remarks_about(const Scene& scene) {
  std::vector<Remark> remarks;
  for (const std::string& text : scene_warnings(scene))
    remarks.push_back(remark_of(Doubt{DoubtKind::unlikely_scene, text}));
  return remarks;
}

void put_first(const std::vector<std::string>& warnings, Outflow& outflow) {
  std::vector<Doubt> doubts;
  for (const std::string& text : warnings) doubts.push_back({DoubtKind::unlikely_scene, text});
  outflow.doubts.insert(outflow.doubts.begin(), doubts.begin(), doubts.end());
}

std::string run_page_data(const RunPage& page) {
  const Scene& scene = page.model.scene;
  std::vector<Remark> remarks;
  for (const Doubt& doubt : page.outflow.doubts) remarks.push_back(remark_of(doubt));
  if (scene.space == Space::two_dimensional && page.outflow.depth_factor)
    remarks.push_back(
        {Severity::mild,
         "2D stands for the whole depth: what is said of the whole tray is a slice's rate times its depth; its "
         "holes are slots from front to back",
         "compare layouts by it; a rate needs space = \"3d\" and a weighing"});
  Json data = {{"kind", "run"},
               {"program", {{"name", "vibrosow"}, {"version", VIBROSOW_VERSION}}},
               {"title", scene.title},
               {"space", scene.space == Space::two_dimensional ? "plane" : "three_dimensional"},
               {"headline", headline(page)},
               {"remarks", page_remarks(remarks)},
               {"status", status_name(page.run)},
               {"random_seed", page.run.random_seed},
               {"end_time_s", page.run.end_time},
               {"window_s", {page.outflow.window.from, page.outflow.window.to}},
               {"lots", page_lots(scene)},
               {"vessels", page_vessels(scene)},
               {"faces", page_faces(scene)},
               {"paths", page_paths(scene, page.run.end_time)},
               {"holes", holes(page)},
               {"rate_unit", "seeds/s"},
               {"hole_table", hole_table(page)},
               {"unevenness", unevenness(unevenness_of({&page.outflow}))},
               {"events", page_events(page.run)},
               {"effects", effects(page.model)},
               {"guard", guard_sentence(page.run, scene.guard)},
               {"settings", settings(page)},
               {"drill", drill(page.drill, scene.space)},
               {"scene", Json::parse(scene_to_json(scene))}};
  if (!page.expected.empty()) data["expected"] = page.expected + ".";
  return page_text(data);
}

FileText run_page_text() {
  return {"report.html", "with --html: the run to look at in any browser, with all that it needs", {}};
}

}  // namespace vibrosow
