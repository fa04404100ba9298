#include "study/evaluate.hpp"

#include "scene/input_error.hpp"
#include "study/cpu_time.hpp"

namespace vibrosow {
namespace {

EvaluationStatus status_of(const Run& run) {
  switch (run.status) {
    case RunStatus::finished:
      return run.goes_on ? EvaluationStatus::interrupted : EvaluationStatus::finished;
    case RunStatus::stopped_by_guard:
      return EvaluationStatus::stopped;
    case RunStatus::refused:
      return EvaluationStatus::refused;
    case RunStatus::interrupted:
      break;
  }
  return EvaluationStatus::interrupted;
}

Evaluation refused(std::uint64_t random_seed, const std::string& reason) {
  return {.random_seed = random_seed, .status = EvaluationStatus::refused, .reason = reason};
}

}  // namespace

Evaluation reduced(const Scene& scene, const Run& run, const std::vector<CurveRequest>& wanted,
                   const std::vector<Drill>& drills) {
  if (run.status == RunStatus::refused) return refused(run.random_seed, run.stop_reason);
  if (run.status == RunStatus::interrupted && run.steps == 0) return {.random_seed = run.random_seed};
  Evaluation evaluation{.random_seed = run.random_seed,
                        .status = status_of(run),
                        .reason = run.stop_reason,
                        .end_reason = run.end_reason,
                        .outside_the_model = run.outside_the_model,
                        .dt = run.dt,
                        .end_time = run.end_time,
                        .grain_steps = run.grain_steps,
                        .max_relative_overlap = run.max_relative_overlap,
                        .balance = run.balance,
                        .outflow = measure_outflow(scene, run),
                        .records = record_metrics(scene, run.snapshots),
                        .wall_time = run.wall_time};
  if (run.tray_empty_since >= 0) evaluation.tray_empty_since = run.tray_empty_since;
  for (const CurveRequest& request : wanted)
    evaluation.curves.push_back(
        {request, discharge_curve(scene, run, request.times, request.kind, request.hole, request.lot)});
  for (const Drill& drill : drills) evaluation.drills.push_back(drill_metrics(scene, run, evaluation.outflow, drill));
  return evaluation;
}

Evaluation evaluate(const Model& model, const SimulationOptions& options, const std::vector<CurveRequest>& curves,
                    const Simulator& simulator, const std::vector<Drill>& drills) {
  if (const auto too_long = step_refused(model.scene.numerics, model.step))
    return refused(options.random_seed, *too_long);
  try {
    const double begin = cpu_time();
    const Run run = simulator(model, options);
    const double used = cpu_time() - begin;
    Evaluation evaluation = reduced(model.scene, run, curves, drills);
    evaluation.cpu_time = used;
    return evaluation;
  } catch (const InputError& error) {
    return refused(options.random_seed, error.what());
  }
}

}  // namespace vibrosow
