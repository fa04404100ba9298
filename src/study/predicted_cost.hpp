#pragma once

#include <string>
#include <vector>

#include "grains/grains.hpp"
#include "plan/model.hpp"
#include "scene/scene.hpp"
#include "study/study.hpp"

namespace vibrosow {

/// What an effect adds to the cost of a scene's bed.
struct EffectCost {
  std::string effect;
  double ns_per_grain_step;  // added; may come out below zero
  double half_width_95;      // ns, from the scatter of the rounds
  bool is_resolved() const { return ns_per_grain_step > half_width_95; }
};

/// What a run will take on this machine, one core. The figures depend on the machine and the moment, so they belong on
/// a terminal and in no result.
struct PredictedCost {
  double grain_steps = 0;        // of one run
  double ns_per_grain_step = 0;  // CPU time
  double seconds() const { return 1e-9 * ns_per_grain_step * grain_steps; }
};

/// Runs the scene's own bed, shaken from the start and with its gates open, by the CPU clock of the calling thread: 0.1
/// s, or 0.6 s of CPU time, to settle, longer where most of the bed has to rain in first, and as long again to be
/// timed. The step is at most the longest safe one. Throws InputError where the fill does not fit.
PredictedCost predict_cost(const Scene& scene);

/// The same of a model and the grains that its run begins with, and from where the timed bed got to what each effect
/// adds: beds that go on from there with all effects and with one left out (and with it what needs it) are timed in
/// turn, over 12 rounds of some 5 ms. Of clumps, unequal grains, motion and periodic sides there is no figure: without
/// them it would be another bed.
struct CostBreakdown {
  PredictedCost whole;
  std::vector<EffectCost> effects;
};
CostBreakdown break_down_cost(const Model& model, const Grains& start);

/// CPU time of a run of each of the scenes, summed, s. At most five of them, spread evenly, are timed; the others are
/// thought to take as long a grain-step as the timed one before them.
double predict_seconds(const std::vector<const Scene*>& scenes);

/// The same of all runs of a study.
double predict_seconds(const Study& study);

/// CPU time (s) of a run on a machine as they are: the grain-steps that are foreseen, at 25 ns each of a disc in the
/// plane and 70 ns of a ball in 3D, which are those of two hyperthreads of one core that are both at work
/// (reports/performance). The same on every machine, so that what follows from it is, too. Throws as `prepare` does.
double usual_seconds(const Scene& scene);

}  // namespace vibrosow
