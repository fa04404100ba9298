#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "input/override.hpp"
#include "input/source_files.hpp"
#include "optimise/decide.hpp"
#include "optimise/front_goal.hpp"
#include "optimise/front_search.hpp"
#include "study/scene_runs.hpp"
#include "study/study.hpp"

namespace vibrosow {

struct OptimiseOptions {
  std::vector<const FrontGoal*> goals{};
  std::optional<WantedRate> rate{};
  double clogging_limit = 0.05;           // share of runs that may clog; 1: all may
  std::optional<double> spilled_limit{};  // of all seeds that left the tray
  double confidence = 0.95;
  int runs = 400;  // that it may take, the variants' included
  std::uint64_t first_random_seed = 1;
};

/// What is known of a layout.
struct FrontLayout {
  FrontStanding standing = FrontStanding::failed;
  bool is_first_by_means = false;    // meets the constraints by its means, and no other such has better means
  bool surely_meets = false;         // the constraints, as what is on the front must
  std::vector<std::string> at_edge;  // keys whose values end their ranges: better ones may lie beyond
  std::string reason;                // why it failed
  std::vector<CountedDoubt> doubts;  // of its runs that finished, without those of variants, and of its scene
  std::string stopped;               // `first_stop` of its runs, variants' included
  int runs = 0, clogged = 0;         // without those of variants
  std::vector<std::optional<MeanWithInterval>> goals;  // SI, as their figures are, with shared variances
  std::optional<MeanWithInterval>
      rate;  // SI, of the tray where one is wanted (with shared variances), else rate_g_per_s
  std::optional<ExpectedRate> expected{};  // of rate_g_per_s, of those that flowed, without those of variants
  std::optional<Unevenness> unevenness;    // of its runs that flowed together, without those of variants
};

/// Whether it stands in front.toml: it is on the front, or it is first by its means.
bool leads(const FrontLayout& layout);

struct OptimiseResult {
  OptimiseOptions options;
  Study study;                       // of all layouts that were tried
  std::vector<FrontLayout> layouts;  // of each of Study::layouts
  bool is_interrupted = false;
  DecisionCost cost;
};

/// Where a study's file is, and what is laid over it.
struct StudySource {
  std::filesystem::path file;
  std::vector<Override> overrides{};
  std::shared_ptr<SourceFiles> files = std::make_shared<SourceFiles>();
};

/// Which layouts in the space of a study's [vary] no other dominates, by runs that are asked for round by round. What
/// is asked for depends on the study, the options and the runs alone: led through the runs that are kept, it goes on
/// where it was.
class StudyOptimisation {
 public:
  static constexpr int first_runs = 2;

  /// Throws InputError where there is no space to look in, no layout of the first round can be built, a goal or
  /// constraint asks for what the scenes have not, or the runs are fewer than a first round takes.
  StudyOptimisation(StudySource source, const OptimiseOptions& options);

  /// Asks for the runs of the next round by those that were taken; for none where it has ended.
  void request_next_round();

  /// Of the runs asked for, those that were not taken yet.
  std::vector<WantedRun> missing() const;

  /// Takes what is missing where it is kept; false where a run is not there.
  bool take(const KeptRuns& kept, int jobs);

  OptimiseResult result() const;
  /// The runs asked for so far, by round and variant.
  std::vector<PlannedRun> plan() const;
  /// How many layouts were tried.
  std::size_t tried() const { return trials_.size(); }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  /// The layouts of one round, with their runs as each variant. Its parts name each other and stay where they are.
  struct Generation {
    Study study;
    std::vector<std::vector<Scene>> scenes;  // of each variant, for each of Study::scenes
    std::vector<SceneRuns> runs;             // of each variant
    std::vector<int> counts;                 // runs wanted of each scene
  };
  /// Where a layout's runs are.
  struct Trial {
    std::size_t generation;
    std::optional<std::size_t> scene;  // none: it cannot be built
    std::string failure{};
  };

  std::vector<double> share_of(const FrontSearch::Point& point) const;
  void build_new_layouts();
  void check(const Study& study) const;
  bool tell_search();
  FrontObservation observed(Trial& trial, std::size_t run) const;
  std::optional<double> goal_of(const FrontGoal& goal, const Trial& trial, std::size_t run) const;
  double rate_as(Variant variant, const Trial& trial, std::size_t run) const;
  const Evaluation& evaluation(Variant variant, const Trial& trial, std::size_t run) const;
  std::vector<std::string> keys_at_edge(const FrontSearch::Point& point) const;
  FrontLayout layout_result(std::size_t layout, FrontStanding standing, bool is_first,
                            const std::optional<RateKnowledge>& knowledge) const;

  StudySource source_;
  OptimiseOptions options_;
  StudySpace space_;
  std::vector<Variant> variants_;  // that the goals ask for
  std::unique_ptr<FrontSearch> search_;
  std::vector<std::unique_ptr<Generation>> generations_;
  std::vector<Trial> trials_;  // of each point of the search
  std::vector<std::string> warnings_;
};

}  // namespace vibrosow
