#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "agronomy/prediction_error.hpp"
#include "answer/answer.hpp"
#include "report/columns.hpp"
#include "study/expected_rate.hpp"

namespace vibrosow {

/// One of the four parts of what a rate errs by.
struct ErrorPart {
  std::string_view name;         // "chance"; its column is called "chance_percent"
  std::string_view description;  // a clause without a full stop
  double (*half_width)(const PredictionError&);
};
std::span<const ErrorPart> error_parts();

template <class Row, class Get>
void add_part_columns(Columns<Row>& columns, Get error) {
  for (const ErrorPart& part : error_parts())
    columns.push_back(quantity_column<Row>(std::string(part.name) + "_percent", percent, std::string(part.description),
                                           [error, &part](const Row& row) { return part.half_width(error(row)); }));
}

/// A number of what a rate is expected to be, as CSV and JSON files have it: its range, then the parts of its error.
struct ExpectedMetric {
  std::string name;  // with its unit
  Unit unit;
  std::string description;
  std::function<std::optional<double>(const ExpectedRate&)> of;  // SI
};
std::vector<ExpectedMetric> expected_metrics();

/// `expected(row)` gives an optional ExpectedRate.
template <class Row, class Get>
void add_expected_columns(Columns<Row>& columns, Get expected) {
  for (const ExpectedMetric& metric : expected_metrics())
    columns.push_back(quantity_column<Row>(metric.name, metric.unit, metric.description,
                                           [expected, of = metric.of](const Row& row) -> std::optional<double> {
                                             const std::optional<ExpectedRate>& rate = expected(row);
                                             return rate ? of(*rate) : std::nullopt;
                                           }));
}

/// A rate (kg/s) times the ends of a range: "3.1 to 12 g/s".
std::string range_text(double mass_rate, const FactorRange& range);

/// "chance 2 %, numerics 1 %, tolerance 5 %, model 31 %".
std::string parts_text(const PredictionError& error);

/// How the model did where others measured. Its bias is told, not taken out.
std::string model_text(const PredictionError& error);

/// "6.2 g/s, expect 3.1 to 12 g/s until you weigh (95 %); of it chance 2 %, ..". A tolerance that is not known is
/// called so.
std::string expected_sentence(const ExpectedRate& expected);
/// The same; empty where none is known.
std::string sentence_of(const std::optional<ExpectedRate>& expected);

/// What the rates of the layouts that an answer names are expected to be, and that it decides nothing between them; or,
/// of rates in 3D beside measured outflow, why that is not told. Empty where no layout has any.
std::string expected_sentence(const Answer& answer);

/// The same for a terminal, wrapped.
std::string expected_paragraph(const Answer& answer);

}  // namespace vibrosow
