#include "report/accuracy_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "accuracy/accuracy_doubts.hpp"
#include "report/accuracy_report.hpp"
#include "report/answer_doubts.hpp"
#include "report/page.hpp"
#include "scene/integrator_names.hpp"
#include "scene/scene_json.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

constexpr double recommended_within = 1;  // %, as accuracy_sentence has it

/// {percent, band} against the limit, or without a fit against the finest setting; null where there is none.
Json error_of(const AccuracyRow& row) {
  if (row.fitted) return {{"percent", row.fitted->percent}, {"band", row.fitted->band}};
  if (!row.error_percent) return nullptr;
  return {{"percent", *row.error_percent}, {"band", row.error_ci95 ? Json(*row.error_ci95) : Json(nullptr)}};
}

Json level(const AccuracyResult& result, std::size_t index, std::size_t chosen) {
  const AccuracyRow& row = result.rows[index];
  return {{"number", index + 1},
          {"name", setting_text(row.setting)},
          {"scheme", integrator_name(row.setting.integrator)},
          {"dt_s", row.setting.dt},
          {"runs", row.replicates},
          {"rate_g_per_s", page_interval(row.mass_rate, gram)},
          {"error", error_of(row)},
          {"cost_ratio", row.cost_ratio ? Json(*row.cost_ratio) : Json(nullptr)},
          {"on_front", row.mass_rate && row.on_front},
          {"finest", index == result.reference},
          {"chosen", chosen == index},
          {"note", row.refused}};
}

Json errors(const AccuracyResult& result) {
  Json all = Json::array();
  for (const ErrorRow& row : error_rows(result))
    all.push_back({{"source", row.source},
                   {"from", row.from},
                   {"to", row.to},
                   {"percent", row.percent},
                   {"band", row.band ? Json(*row.band) : Json(nullptr)}});
  return all;
}

/// `chosen`: index of the row that is recommended; the number of rows: none is.
Json page_of(const Scene& scene, const AccuracyResult& result, std::size_t chosen, double within) {
  Json levels = Json::array();
  for (std::size_t i = 0; i < result.rows.size(); ++i) levels.push_back(level(result, i, chosen));
  return {{"kind", "accuracy"},
          {"program", {{"name", "vibrosow"}, {"version", VIBROSOW_VERSION}}},
          {"title", scene.title},
          {"space", scene.space == Space::two_dimensional ? "plane" : "three_dimensional"},
          {"vessels", page_vessels(scene)},
          {"scene", Json::parse(scene_to_json(scene))},
          {"remarks", page_remarks(doubt_remarks(doubts_about(result, scene), "setting", all_doubts))},
          {"against", result.fit ? "the limit of step 0 and rigid grains" : "the finest setting"},
          {"within_percent", within},
          {"levels", std::move(levels)},
          {"errors", errors(result)}};
}

}  // namespace

std::string accuracy_page_data(const Scene& scene, const AccuracyResult& result) {
  const std::size_t none = result.rows.size();
  const std::size_t chosen = result.fit ? cheapest_within(result, recommended_within).value_or(none) : none;
  Json data = page_of(scene, result, chosen, recommended_within);
  data["headlines"] = {accuracy_sentence(result)};
  return page_text(data);
}

std::string accuracy_page_data(const Scene& scene, const Promise& promise, const PromiseGoal& goal) {
  const std::size_t chosen = promise.offer ? promise.offer->setting : promise.settings.size();
  double within = recommended_within;
  if (promise.offer) within = promise.offer->error_bound();
  if (goal.within_percent) within = *goal.within_percent;
  Json data = page_of(scene, result_of(promise), chosen, within);
  data["headlines"] = promise_paragraphs(promise, goal);
  return page_text(data);
}

FileText accuracy_page_text() {
  return {"report.html", "with --html: error against cost to look at in any browser", {}};
}

}  // namespace vibrosow
