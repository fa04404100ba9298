#pragma once

#include <optional>
#include <vector>

#include "agronomy/hole_table.hpp"
#include "agronomy/prediction_error.hpp"
#include "outflow/outflow.hpp"
#include "result/doubt.hpp"
#include "result/run.hpp"
#include "scene/scene.hpp"
#include "study/study.hpp"

namespace vibrosow {

/// What is known of how far simulated rates lie from true ones.
struct RateKnowledge {
  HoleTable table;   // whose slopes give the tolerance
  ModelError model;  // from rates that others measured
};

/// The shipped one. Throws InputError where it is not there.
RateKnowledge shipped_rate_knowledge();
/// The same for a study with scenes in 3D, unless measured outflow stands beside its rates: the misfit then says
/// what the model errs by.
std::optional<RateKnowledge> knowledge_for(const Study& study);

/// What all rates of a scene in 3D err by, but for chance.
struct SceneError {
  PredictionError error{};
  bool knows_tolerance = true;  // else `error.tolerance` is 0
  std::vector<Doubt> doubts{};  // about these parts
};

/// None in 2D, whose rates are not the tray's.
std::optional<SceneError> scene_error(const Scene& scene, const RateKnowledge& knowledge);

/// A simulated rate of all holes with the range that holds the true one in 95 % of cases until the tray is weighed.
struct ExpectedRate {
  double mass_rate = 0;  // kg/s
  PredictionError error{};
  bool knows_tolerance = true;
  FactorRange range{};  // of `mass_rate`
};

/// Of a mean rate (kg/s) with what chance makes of it (`chance_of_rate`); none where nothing flowed or chance is not
/// known.
std::optional<ExpectedRate> expected_rate(double mass_rate, std::optional<double> chance, const SceneError& error);

/// Such a rate with the doubts about its parts.
struct ExpectedWithDoubts {
  std::optional<ExpectedRate> rate{};
  std::vector<Doubt> doubts{};  // none without a rate
};

/// Of replicates of a scene.
ExpectedWithDoubts expected_of(const Scene& scene, const std::vector<const Outflow*>& replicates,
                               const std::optional<RateKnowledge>& knowledge);

/// Of one run; none of a run that did not finish or is outside the model, too.
ExpectedWithDoubts expected_of_run(const Scene& scene, const Run& run, const Outflow& outflow,
                                   const std::optional<RateKnowledge>& knowledge);

}  // namespace vibrosow
