#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "agronomy/row_metrics.hpp"
#include "fields/record_metrics.hpp"
#include "outflow/discharge.hpp"
#include "outflow/outflow.hpp"
#include "plan/model.hpp"
#include "result/run.hpp"
#include "simulation/simulate.hpp"

namespace vibrosow {

/// What runs a model: `run_model`, or something quick in a test.
using Simulator = std::function<Run(const Model&, const SimulationOptions&)>;

/// A discharge curve that is wanted of a run, as `discharge_curve` takes it.
struct CurveRequest {
  Discharge kind = Discharge::fraction;
  std::string hole = "all", lot = "all";
  std::vector<double> times;  // s
  bool operator==(const CurveRequest&) const = default;
};

struct Curve {
  CurveRequest request;
  std::vector<double> values;  // SI, one for each time
};

enum class EvaluationStatus {
  absent,   // not kept, or interrupted before its turn
  refused,  // the scene cannot be run: a fill that does not fit, ...
  interrupted,
  stopped,  // by the guard
  finished,
};

/// What is kept of one run of a scene: all that studies ask for, in SI, and nothing large. Depends on the scene and the
/// random seed alone, but for the two times.
struct Evaluation {
  std::uint64_t random_seed = 1;
  EvaluationStatus status = EvaluationStatus::absent;
  std::string reason{};      // of `refused` and `stopped`
  std::string end_reason{};  // why it ended before its duration, though sound; else empty
  bool outside_the_model = false;
  double dt = 0;        // s
  double end_time = 0;  // s
  std::int64_t grain_steps = 0;
  double max_relative_overlap = 0;           // a grain's share of the overlap over its radius, the largest of the run
  std::optional<double> tray_empty_since{};  // s, when the last grain left the tray; none: it never ran dry
  Balance balance{};
  Outflow outflow{};
  std::vector<RecordMetrics> records{};  // of each record that was reached
  std::vector<Curve> curves{};           // those wanted, in their order
  std::vector<DrillMetrics> drills{};    // likewise
  double wall_time = 0;                  // s, of this machine
  double cpu_time = 0;                   // s, of the thread that ran it

  bool finished() const { return status == EvaluationStatus::finished; }
  /// Whether it ended for want of outflow though seeds were left in it. One that ended empty ran dry.
  bool stopped_flowing() const { return finished() && !end_reason.empty() && balance.inside > 0; }
  /// Whether something may be decided by it.
  bool is_sound() const { return finished() && !outside_the_model; }
  /// Whether there was a run, so that the figures mean something.
  bool was_run() const { return status != EvaluationStatus::absent && status != EvaluationStatus::refused; }
};

/// What is kept of a run of `scene` that has ended, or is cut short here; `absent` of one that was interrupted before
/// its first step. Throws std::invalid_argument as `evaluate` does.
Evaluation reduced(const Scene& scene, const Run& run, const std::vector<CurveRequest>& wanted = {},
                   const std::vector<Drill>& drills = {});

/// Runs a scene's model once and reduces what comes of it. A step that is too long and not insisted on, or a
/// simulator's InputError, makes a `refused` evaluation. Throws std::invalid_argument for a curve of a hole or lot that
/// the scene has not, or a drill of another number of holes.
Evaluation evaluate(const Model& model, const SimulationOptions& options, const std::vector<CurveRequest>& curves = {},
                    const Simulator& simulator = run_model, const std::vector<Drill>& drills = {});

}  // namespace vibrosow
