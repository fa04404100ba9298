#include "report/calibration_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/answer_doubts.hpp"
#include "report/page.hpp"
#include "report/terminal_text.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t shown_points = 300;  // of the posterior

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

bool is_of_curves(const CalibrationAnswer& answer) {
  return is_curve(answer.task.measured.table.quantity);
}

/// "3.2 % of the largest value"
std::string error_text(const CalibrationAnswer& answer, double rms) {
  return fmt::format("{:.2g} %{}", 100 * rms, is_of_curves(answer) ? " of the largest value" : "");
}

std::string headline(const CalibrationAnswer& answer) {
  const std::string table = answer.task.measured.file.filename().string();
  if (!answer.is_fitted) return fmt::format("Nothing was fitted: no values within the ranges meet {}.", table);
  std::string text = fmt::format("Fitted to {}:", table);
  for (const FittedNumber& row : answer.numbers)
    text += fmt::format(" {} {} ({} to {}){},", row.name, to_digits(row.value.mean, 3), to_digits(row.value.low, 3),
                        to_digits(row.value.high, 3), row.unit.empty() ? "" : " " + row.unit);
  text.back() = '.';
  const auto& held_out = answer.calibration.held_out_rms;
  return held_out ? fmt::format("{} What was held out is predicted to {} (RMS).", text, error_text(answer, *held_out))
                  : text;
}

Json parameters(const CalibrationAnswer& answer) {
  Json all = Json::array();
  for (const FittedNumber& row : answer.numbers)
    all.push_back({{"name", row.name},
                   {"unit", row.unit},
                   {"prior_low", or_null(row.low)},
                   {"prior_high", or_null(row.high)},
                   {"mean", row.value.mean},
                   {"low", row.value.low},
                   {"high", row.value.high},
                   {"edge", name_of(row.edge)},
                   {"contraction_percent", 100 * row.value.contraction},
                   {"not_told_apart_from", fmt::format("{}", fmt::join(row.not_told_apart_from, ";"))}});
  return all;
}

/// A point's value of a key, in the unit of its column, or of the depth factor.
double value_at(const CalibrationAnswer& answer, Eigen::Index point, std::size_t index) {
  const PosteriorSample& known = answer.calibration.posterior;
  if (index == answer.task.keys.size()) return std::exp(known.shifts(point));
  return answer.task.keys[index].at(known.points(point, static_cast<Eigen::Index>(index)));
}

/// Every pair with its correlation, those that cannot be told apart with points of equal weight.
Json pairs(const CalibrationAnswer& answer) {
  Json all = Json::array();
  for (const FittedPair& pair : answer.calibration.correlations) {
    const bool told_apart = std::abs(pair.correlation) <= not_told_apart;
    Json points = Json::array();
    if (!told_apart)
      for (const Eigen::Index i : points_of_equal_weight(answer.calibration.posterior.weights, shown_points))
        points.push_back({value_at(answer, i, pair.a), value_at(answer, i, pair.b)});
    all.push_back({{"a", answer.numbers[pair.a].name},
                   {"b", answer.numbers[pair.b].name},
                   {"correlation", pair.correlation},
                   {"told_apart", told_apart},
                   {"points", std::move(points)}});
  }
  return all;
}

/// By series, as they were measured.
Json series(const CalibrationAnswer& answer) {
  const MeasuredTable& table = answer.task.measured.table;
  const auto stated = [&](double si) { return to_column_unit(table.quantity, si); };
  Json all = Json::array();
  for (const MeasuredSeries& one : table.series)
    all.push_back({{"conditions", conditions_text(one.conditions)},
                   {"hole", one.hole},
                   {"lot", one.lot},
                   {"values", Json::array()}});
  for (const PredictedValue& value : answer.calibration.predictions)
    all[value.series]["values"].push_back({{"time_s", or_null(value.time)},
                                           {"held_out", value.held_out},
                                           {"measured", stated(value.measured)},
                                           {"predicted", stated(value.predicted)},
                                           {"low", stated(value.low)},
                                           {"high", stated(value.high)}});
  return all;
}

Json sentences(const CalibrationAnswer& answer) {
  const Calibration& of = answer.calibration;
  Json all = Json::array();
  all.push_back(fmt::format("{} runs at {} points of the fitted values were simulated; {} of them count.",
                            answer.runs.size(), answer.design.points.rows(), answer.runs_used));
  all.push_back(fmt::format("Noise of one measurement: {:.2g} % ({}).", 100 * of.noise, of.noise_source));
  if (of.fitted_rms)
    all.push_back(fmt::format("Fitted values are met to {} (RMS).", error_text(answer, *of.fitted_rms)));
  if (of.held_out_rms)
    all.push_back(fmt::format("Held out values are predicted to {} (RMS).", error_text(answer, *of.held_out_rms)));
  return all;
}

}  // namespace

std::string calibration_page_data(const CalibrationAnswer& answer, const Scene& scene) {
  const Json data = {{"kind", "calibration"},
                     {"program", {{"name", "vibrosow"}, {"version", VIBROSOW_VERSION}}},
                     {"title", scene.title},
                     {"space", scene.space == Space::two_dimensional ? "plane" : "three_dimensional"},
                     {"vessels", page_vessels(scene)},
                     {"scene", Json::parse(scene_to_json(scene))},
                     {"headline", headline(answer)},
                     {"remarks", page_remarks(doubt_remarks(answer.doubts, "", all_doubts))},
                     {"quantity", column_of(answer.task.measured.table.quantity)},
                     {"of_curves", is_of_curves(answer)},
                     {"parameters", parameters(answer)},
                     {"pairs", pairs(answer)},
                     {"series", series(answer)},
                     {"account", sentences(answer)}};
  return page_text(data);
}

FileText calibration_page_text() {
  return {"report.html", "with --html: measured against fitted, and what is known of each value, in any browser", {}};
}

}  // namespace vibrosow
