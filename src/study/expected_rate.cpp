#include "study/expected_rate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "agronomy/table_tray.hpp"
#include "input/read_held_out.hpp"
#include "input/read_hole_table.hpp"
#include "outflow/metrics.hpp"
#include "plan/softness.hpp"

namespace vibrosow {
namespace {

std::string tolerance_doubt(const TrayTolerance& tolerance) {
  return fmt::format("{}; {}", tolerance.outside,
                     tolerance.deviation
                         ? "what a hole or an amplitude off by its tolerance does to the rate is taken from the "
                           "table's nearest place"
                         : "what a hole or an amplitude off by its tolerance does to the rate is not known, and not "
                           "in what is expected");
}

}  // namespace

RateKnowledge shipped_rate_knowledge() {
  return {shipped_hole_table(), shipped_model_error()};
}

std::optional<RateKnowledge> knowledge_for(const Study& study) {
  const auto is_3d = [](const Scene& scene) { return scene.space == Space::three_dimensional; };
  if (study.measured || std::ranges::none_of(study.scenes, is_3d)) return std::nullopt;
  return shipped_rate_knowledge();
}

std::optional<SceneError> scene_error(const Scene& scene, const RateKnowledge& knowledge) {
  if (scene.space == Space::two_dimensional) return std::nullopt;
  SceneError found;
  const NumericsError numerics = numerics_error(scene);
  const TrayTolerance tolerance = tray_tolerance(scene, knowledge.table);
  found.error = {.numerics = deviation_of_half_width(numerics.half_width),
                 .tolerance = tolerance.deviation.value_or(0),
                 .model = knowledge.model};
  found.knows_tolerance = tolerance.deviation.has_value();
  if (numerics.times_beyond > 1)
    found.doubts.push_back(
        {DoubtKind::beyond_the_levels,
         fmt::format(
             "seeds are {:.3g} times softer, or steps longer, than at any level that was tried: the part of the "
             "numerics is as many times that of the softest",
             numerics.times_beyond)});
  if (!tolerance.outside.empty()) found.doubts.push_back({DoubtKind::outside_the_table, tolerance_doubt(tolerance)});
  return found;
}

std::optional<ExpectedRate> expected_rate(double mass_rate, std::optional<double> chance, const SceneError& error) {
  if (!(mass_rate > 0) || !chance) return std::nullopt;
  ExpectedRate expected{mass_rate, error.error, error.knows_tolerance};
  expected.error.chance = deviation_of_half_width(*chance);
  expected.range = expected_range(expected.error);
  return expected;
}

ExpectedWithDoubts expected_of(const Scene& scene, const std::vector<const Outflow*>& replicates,
                               const std::optional<RateKnowledge>& knowledge) {
  std::optional<SceneError> error = knowledge ? scene_error(scene, *knowledge) : std::nullopt;
  const auto rate = MetricMeans(replicates)["rate_g_per_s"];
  if (!error || !rate) return {};
  ExpectedWithDoubts expected{expected_rate(rate->mean, chance_of_rate(replicates), *error), {}};
  if (expected.rate) expected.doubts = std::move(error->doubts);
  return expected;
}

ExpectedWithDoubts expected_of_run(const Scene& scene, const Run& run, const Outflow& outflow,
                                   const std::optional<RateKnowledge>& knowledge) {
  if (run.status != RunStatus::finished || run.outside_the_model) return {};
  return expected_of(scene, {&outflow}, knowledge);
}

}  // namespace vibrosow
