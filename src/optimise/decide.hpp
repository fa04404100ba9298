#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "optimise/goal.hpp"
#include "outflow/statistics.hpp"
#include "selection/procedure.hpp"
#include "storage/asked_question.hpp"
#include "study/expected_rate.hpp"
#include "study/scene_runs.hpp"
#include "study/study.hpp"

namespace vibrosow {

struct DecideOptions {
  const Goal* goal = nullptr;
  std::optional<WantedRate> rate{};
  double clogging_limit = 0.05;  // share of runs that may clog; 1: all may
  double margin = 0.02;          // over the best's mean
  double confidence = 0.95;
  SelectionRule rule = SelectionRule::guaranteed;
  int most = 400;  // runs of a layout
  std::uint64_t first_random_seed = 1;
};

/// What is known of a scene when the decision is there.
struct SceneDecision {
  Standing standing = Standing::undecided;
  std::vector<CountedDoubt> doubts;  // of its runs that finished, and of its scene
  std::string reason;                // why it failed
  std::string stopped;               // `first_stop` of its runs
  bool is_screened_out = false;
  int runs = 0, clogged = 0;
  std::optional<MeanWithInterval> goal, rate;  // SI, over the runs that flowed; the goal as its figure is
  std::optional<ExpectedRate> expected{};      // of the rate of these
  std::optional<Unevenness> unevenness;        // of these together
};

/// Runs and grain-steps.
struct DecisionCost {
  double runs = 0, grain_steps = 0;
};

struct DecisionResult {
  DecideOptions options;
  Study study;
  std::vector<SceneDecision> scenes;  // of each of Study::scenes
  std::optional<std::size_t> best;    // of them
  bool is_interrupted = false;
  bool is_sure = false;    // with the confidence asked for; without a best: that no layout meets the constraints
  bool has_margin = true;  // false: the best's mean is 0, and so is any share of it
  bool tests_clogging = false;
  std::optional<double> correlation;  // between layouts, of runs under one random seed, mean
  DecisionCost cost;
  std::optional<DecisionCost> equal_grid;  // what Rinott's procedure takes for the same confidence, by the first runs
};

/// Whether a run clogged: it ended for want of outflow (run.end_after_pause) with seeds in it, or no seed came in its
/// window.
bool has_clogged(const Evaluation& run);

/// Whether clogging counts against a layout: some may end for want of outflow, and not all may.
bool tests_clogging(const Study& study, const DecideOptions& options);

/// Of the first of some runs that the guard stopped, the random seed and why; empty without one.
std::string first_stop(const std::vector<Evaluation>& runs);

/// Which layout of a study is best, by runs that are asked for round by round. What is asked for and decided depends on
/// the study, the options and the runs alone: led through the runs that are kept, it goes on where it was.
class StudyDecision {
 public:
  /// `taking_part`: of each of Study::scenes; empty: all. `study` outlives this. Throws InputError where fewer than two
  /// scenes are left, where the rate of the tray is not known, or where `most` is too few to decide anything.
  StudyDecision(const Study& study, const DecideOptions& options, const std::vector<bool>& taking_part = {});

  /// Asks for the runs of the next round by those that were taken; for none where it is decided, or cannot be.
  void request_next_round();

  /// Of the runs asked for, those that were not taken yet.
  std::vector<WantedRun> missing() const { return runs_.missing(counts_); }

  /// Takes what is missing where it is kept; false where a run is not there.
  bool take(const KeptRuns& kept, int jobs);

  /// How many layouts may still be the best.
  std::size_t left() const;
  std::vector<PlannedRun> plan() const { return runs_.plan(counts_); }
  DecisionResult result() const;

 private:
  /// Of every mean: a run that clogged, where that is tested, or that has no value of the goal. Where it is not, what
  /// lets nothing out counts with its rate of zero.
  bool is_left_out(const Evaluation& run) const;
  Observation observed(std::size_t scene, const Evaluation& run);
  SceneDecision metrics_of(std::size_t scene, const std::optional<RateKnowledge>& knowledge) const;
  std::vector<std::vector<double>> goals_by_run() const;
  std::optional<DecisionCost> equal_grid() const;

  const Study& study_;
  DecideOptions options_;
  SceneRuns runs_;
  std::vector<std::size_t> systems_;   // the scene of each
  std::vector<std::string> failures_;  // by scene
  std::unique_ptr<Procedure> procedure_;
  std::vector<int> counts_;  // runs asked for, by scene
  bool tests_clogging_;
};

/// Mean correlation between systems of what they give in the same observations (not a number: none), over the pairs
/// with at least three in common and scatter; none without such a pair.
std::optional<double> mean_correlation(const std::vector<std::vector<double>>& values);

}  // namespace vibrosow
