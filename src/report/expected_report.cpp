#include "report/expected_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/terminal_text.hpp"
#include "scene/si_units.hpp"

namespace vibrosow {
namespace {

constexpr std::string_view tolerance = "tolerance";

constexpr std::array parts = {
    ErrorPart{"chance", "half width of the part that chance has in it: so many seeds were counted",
              [](const PredictionError& error) { return half_width_of_normal(error.chance); }},
    ErrorPart{"numerics", "the same of softness and step, and between the places of a table",
              [](const PredictionError& error) { return half_width_of_normal(error.numerics); }},
    ErrorPart{tolerance, "the same of a hole 0.1 mm wider or narrower and an amplitude off by 2 %",
              [](const PredictionError& error) { return half_width_of_normal(error.tolerance); }},
    ErrorPart{"model", "the same of the model: from rates that others measured of other materials",
              [](const PredictionError& error) { return half_width_of_model(error); }},
};

std::optional<double> known_part(const ErrorPart& part, const ExpectedRate& expected) {
  if (part.name == tolerance && !expected.knows_tolerance) return std::nullopt;
  return part.half_width(expected.error);
}

/// "3 to 8", or "3" where both are written alike.
std::string from_to(const std::string& low, const std::string& high) {
  return low == high ? low : fmt::format("{} to {}", low, high);
}

/// "chance 2 to 4 %", over several rates; those without that part do not count.
std::string part_text(const ErrorPart& part, const std::vector<const ExpectedRate*>& rates) {
  std::optional<double> least, most;
  for (const ExpectedRate* rate : rates)
    if (const auto value = known_part(part, *rate))
      least = std::min(*value, least.value_or(*value)), most = std::max(*value, most.value_or(*value));
  if (!least) return fmt::format("{} not known", part.name);
  return fmt::format("{} {} %", part.name, from_to(two_digit_percent(*least), two_digit_percent(*most)));
}

std::string parts_text(const std::vector<const ExpectedRate*>& rates) {
  std::vector<std::string> texts;
  for (const ErrorPart& part : parts) texts.push_back(part_text(part, rates));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

std::span<const ErrorPart> error_parts() {
  return parts;
}

std::vector<ExpectedMetric> expected_metrics() {
  std::vector<ExpectedMetric> metrics = {
      {"expected_low_g_per_s", grams_per_second,
       "lower end of the range that holds the true rate of all holes in 95 % of cases until the tray is weighed; empty "
       "in 2D, and beside measured outflow",
       [](const ExpectedRate& expected) { return expected.mass_rate * expected.range.low; }},
      {"expected_high_g_per_s", grams_per_second, "upper end",
       [](const ExpectedRate& expected) { return expected.mass_rate * expected.range.high; }}};
  for (const ErrorPart& part : parts)
    metrics.push_back({fmt::format("{}_percent", part.name), percent, std::string(part.description),
                       [&part](const ExpectedRate& expected) { return known_part(part, expected); }});
  return metrics;
}

std::string range_text(double mass_rate, const FactorRange& range) {
  return fmt::format("{} to {} g/s", to_digits(mass_rate * range.low / gram, 2),
                     to_digits(mass_rate * range.high / gram, 2));
}

std::string parts_text(const PredictionError& error) {
  const ExpectedRate of{.error = error};
  return parts_text(std::vector{&of});
}

std::string model_text(const PredictionError& error) {
  const ModelError& model = error.model;
  const double over = 1 / model.mean_factor - 1;
  return fmt::format(
      "The model's part is Student's t, from {} materials whose flow through still holes and slots others measured or "
      "gave a formula for: simulated rates were {} % too {} on average.{} No measurement of a shaken tray was found.",
      model.materials, two_digit_percent(std::abs(over)), over > 0 ? "high" : "low",
      error.setting > 0 ? " What grains give against balls differs from setting to setting, which is in it too." : "");
}

std::string expected_sentence(const ExpectedRate& expected) {
  return fmt::format("{} g/s, expect {} until you weigh (95 %); of it {}", to_digits(expected.mass_rate / gram, 2),
                     range_text(expected.mass_rate, expected.range), parts_text(std::vector{&expected}));
}

std::string sentence_of(const std::optional<ExpectedRate>& expected) {
  return expected ? expected_sentence(*expected) : "";
}

std::string expected_sentence(const Answer& answer) {
  const Study& study = *answer.study;
  const auto is_3d = [](const Scene& scene) { return scene.space == Space::three_dimensional; };
  if (answer.kind == AnswerKind::sweep && study.measured)
    return std::ranges::any_of(study.scenes, is_3d) ? "The misfit to the measured outflow shows the model's error "
                                                      "here, so no range from other materials is given."
                                                    : "";
  std::vector<const ExpectedRate*> rates;
  for (const AnsweredLayout& layout : answer.layouts)
    if (layout.is_named && layout.expected) rates.push_back(&*layout.expected);
  if (rates.empty()) return "";
  if (rates.size() == 1 && answer.layouts.size() == 1) return expected_sentence(*rates.front()) + '.';
  double low = rates.front()->range.low, high = rates.front()->range.high;
  for (const ExpectedRate* rate : rates) low = std::min(low, rate->range.low), high = std::max(high, rate->range.high);
  const bool of_one_seed =
      std::ranges::all_of(study.scenes, [&](const Scene& scene) { return scene.lots == study.scenes.front().lots; });
  return fmt::format("Until you weigh, expect {} to {} times these rates (95 %); of it {}. {}", to_digits(low, 2),
                     to_digits(high, 2), parts_text(rates),
                     of_one_seed
                         ? "What the model errs by is one factor of all layouts with the same seed: it does not "
                           "decide between them, and they are compared by chance alone."
                         : "What the model errs by differs from seed to seed: layouts with different seeds are "
                           "compared by chance alone, and that error may turn their order round.");
}

std::string expected_paragraph(const Answer& answer) {
  const std::string sentence = expected_sentence(answer);
  return sentence.empty() ? "" : wrapped(sentence);
}

}  // namespace vibrosow
