#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimise/decide.hpp"
#include "study/scene_runs.hpp"

namespace vibrosow {

/// What drafts say of a study's layouts.
struct DraftFindings {
  std::optional<double> correlation;  // between the pilot layouts' means, as drafts and as the study has them
  int pilots = 0;                     // layouts of which both are known
  bool screens = false;               // correlated enough for drafts to decide anything
  std::vector<bool> taking_part;      // of each scene: false where its draft rules it out
  DecisionCost cost;                  // of the drafts alone: the pilots' other runs are the decision's first
};

/// Drafts before a decision: 12 layouts, spread evenly through the study, are run 5 times at accuracy = "draft" and as
/// the study has them. Where the means correlate by 0.7 or more, all are run 5 times as drafts, and the line fitted
/// through the pilots predicts the others. A layout is ruled out where its prediction is worse than that of the best
/// draft by more than the prediction interval of the difference, with the confidence of the decision shared out among
/// layouts; the best draft is one that met the constraints in its runs. What is ruled out so is not covered by the
/// decision's own confidence.
class DraftScreen {
 public:
  static constexpr int pilots = 12, runs = 5;
  static constexpr double least_correlation = 0.7;

  /// Throws InputError where the study's layouts are drafts already, or as soft as such.
  DraftScreen(const Study& study, const DecideOptions& options);
  DraftScreen(const DraftScreen&) = delete;
  DraftScreen& operator=(const DraftScreen&) = delete;

  /// Asks for all drafts once the pilots are there, if these are like enough; else for nothing more.
  void request_next_round();
  /// Of the runs asked for, those that were not taken yet; empty after a request: the findings are there.
  std::vector<WantedRun> missing() const;
  /// Takes what is missing where it is kept; false where a run is not there.
  bool take(const KeptRuns& kept, int jobs);
  DraftFindings findings() const;
  /// The runs asked for so far: the drafts', then the pilots' other ones.
  std::vector<PlannedRun> plan() const;

 private:
  struct Line {
    double slope = 0, deviation = 0, middle = 0, squares = 0;  // of the drafts' means about `middle`
    int points = 0;
  };

  /// Mean goal of a scene, less is better; none where no run flowed or one failed.
  std::optional<double> mean_of(const SceneRuns& runs, std::size_t scene) const;
  bool met_the_constraints(std::size_t scene) const;
  std::optional<double> correlation() const;
  std::optional<Line> line() const;

  const Study& study_;
  DecideOptions options_;
  bool tests_clogging_;
  std::vector<Scene> drafts_;
  SceneRuns own_, as_drafts_;
  std::vector<std::size_t> pilots_;  // scenes
  std::vector<int> own_counts_, draft_counts_;
};

}  // namespace vibrosow
