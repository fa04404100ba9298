#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/study_plan.hpp"
#include "study/evaluate.hpp"
#include "study/study.hpp"
#include "study/study_runs.hpp"

namespace vibrosow {

/// The runs of each of some scenes as they come in, more and more of them: the r-th of every scene has the same random
/// seed.
class SceneRuns {
 public:
  /// `scenes` are those of a study's layouts, or made from them one by one, and outlive this.
  SceneRuns(const Study& study, const std::vector<Scene>& scenes, std::uint64_t first_random_seed);

  /// Those that are missing for so many of each scene.
  std::vector<WantedRun> missing(const std::vector<int>& counts) const;

  /// Reads them where they are kept, side by side; false where one is not there, and then none counts.
  bool take(const std::vector<int>& counts, const KeptRuns& kept, int jobs);

  const std::vector<std::vector<Evaluation>>& runs() const { return runs_; }
  const Model& model(std::size_t scene) const { return models_[scene]; }
  std::vector<PlannedRun> plan(const std::vector<int>& counts) const;
  std::int64_t count() const;
  double grain_steps() const;

 private:
  std::string name_of(std::size_t scene, std::uint64_t random_seed) const;

  const std::vector<Scene>& scenes_;
  std::uint64_t first_random_seed_;
  std::vector<Model> models_;
  std::vector<std::string> json_;
  std::vector<double> costs_;  // grain-steps of a run, foreseen
  std::vector<int> layouts_;   // number of the first of each scene
  std::vector<std::vector<Evaluation>> runs_;
};

}  // namespace vibrosow
