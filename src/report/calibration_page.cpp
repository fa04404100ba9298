#include "report/calibration_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page.hpp"
#include "report/terminal_text.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t shown_points = 300;  // of the posterior

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

bool is_of_curves(const CalibrationSource& source) {
  return is_curve(source.task.measured.table.quantity);
}

/// "3.2 % of the largest value"
std::string error_text(const CalibrationSource& source, double rms) {
  return fmt::format("{:.2g} %{}", 100 * rms, is_of_curves(source) ? " of the largest value" : "");
}

std::string headline(const CalibrationSource& source) {
  std::string text = fmt::format("Fitted to {}:", source.task.measured.file.filename().string());
  for (const ValueRow& row : value_rows(source))
    text += fmt::format(" {} {} ({} to {}){},", row.name, to_digits(row.value.mean, 3), to_digits(row.value.low, 3),
                        to_digits(row.value.high, 3), row.unit.empty() ? "" : " " + row.unit);
  text.back() = '.';
  const auto& held_out = source.calibration.held_out_rms;
  return held_out ? fmt::format("{} What was held out is predicted to {} (RMS).", text, error_text(source, *held_out))
                  : text;
}

Json parameters(const CalibrationSource& source) {
  Json all = Json::array();
  for (const ValueRow& row : value_rows(source))
    all.push_back({{"name", row.name},
                   {"unit", row.unit},
                   {"prior_low", or_null(row.low)},
                   {"prior_high", or_null(row.high)},
                   {"mean", row.value.mean},
                   {"low", row.value.low},
                   {"high", row.value.high},
                   {"contraction_percent", 100 * row.value.contraction},
                   {"not_told_apart_from", row.confused_with}});
  return all;
}

/// A point's value of a key, in the unit of its column, or of the depth factor.
double value_at(const CalibrationSource& source, Eigen::Index point, std::size_t index) {
  const PosteriorSample& known = source.calibration.posterior;
  if (index == source.task.keys.size()) return std::exp(known.shifts(point));
  return source.task.keys[index].at(known.points(point, static_cast<Eigen::Index>(index)));
}

/// Every pair with its correlation, those that cannot be told apart with points of equal weight.
Json pairs(const CalibrationSource& source) {
  Json all = Json::array();
  for (const FittedPair& pair : source.calibration.correlations) {
    const bool told_apart = std::abs(pair.correlation) <= not_told_apart;
    Json points = Json::array();
    if (!told_apart)
      for (const Eigen::Index i : points_of_equal_weight(source.calibration.posterior.weights, shown_points))
        points.push_back({value_at(source, i, pair.a), value_at(source, i, pair.b)});
    all.push_back({{"a", fitted_name(source, pair.a)},
                   {"b", fitted_name(source, pair.b)},
                   {"correlation", pair.correlation},
                   {"told_apart", told_apart},
                   {"points", std::move(points)}});
  }
  return all;
}

/// By series, as they were measured.
Json series(const CalibrationSource& source) {
  const MeasuredTable& table = source.task.measured.table;
  const auto stated = [&](double si) { return to_column_unit(table.quantity, si); };
  Json all = Json::array();
  for (const MeasuredSeries& one : table.series)
    all.push_back({{"conditions", conditions_text(one.conditions)},
                   {"hole", one.hole},
                   {"lot", one.lot},
                   {"values", Json::array()}});
  for (const PredictedValue& value : source.calibration.predictions)
    all[value.series]["values"].push_back({{"time_s", or_null(value.time)},
                                           {"held_out", value.held_out},
                                           {"measured", stated(value.measured)},
                                           {"predicted", stated(value.predicted)},
                                           {"low", stated(value.low)},
                                           {"high", stated(value.high)}});
  return all;
}

Json sentences(const CalibrationSource& source) {
  const Calibration& of = source.calibration;
  Json all = Json::array();
  const auto left_out = std::ranges::count_if(source.runs, [](const ReducedRun& run) { return !run.reason.empty(); });
  all.push_back(fmt::format("{} runs at {} points of the fitted values were simulated; {} of them count.",
                            source.runs.size(), source.design.points.rows(),
                            static_cast<std::ptrdiff_t>(source.runs.size()) - left_out));
  all.push_back(fmt::format("Noise of one measurement: {:.2g} % ({}).", 100 * of.noise, of.noise_source));
  if (of.fitted_rms)
    all.push_back(fmt::format("Fitted values are met to {} (RMS).", error_text(source, *of.fitted_rms)));
  if (of.held_out_rms)
    all.push_back(fmt::format("Held out values are predicted to {} (RMS).", error_text(source, *of.held_out_rms)));
  return all;
}

}  // namespace

std::string calibration_page_data(const CalibrationSource& source, const Scene& scene) {
  const Json data = {{"kind", "calibration"},
                     {"program", {{"name", "vibrosow"}, {"version", VIBROSOW_VERSION}}},
                     {"title", scene.title},
                     {"space", scene.space == Space::plane ? "plane" : "three_dimensional"},
                     {"headline", headline(source)},
                     {"doubts", calibration_doubts(source)},
                     {"quantity", column_of(source.task.measured.table.quantity)},
                     {"of_curves", is_of_curves(source)},
                     {"parameters", parameters(source)},
                     {"pairs", pairs(source)},
                     {"series", series(source)},
                     {"account", sentences(source)}};
  return page_text(data);
}

FileText calibration_page_text() {
  return {"report.html", "with --html: measured against fitted, and what is known of each value, in any browser", {}};
}

}  // namespace vibrosow
