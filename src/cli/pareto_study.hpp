#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/adaptive_study.hpp"
#include "optimise/optimise.hpp"

namespace vibrosow {

/// What `optimise` is asked, in the words of its command line.
struct OptimiseWords {
  std::vector<std::string> goals;
  std::string rate, spilled;
  std::string clogging = "5 %", confidence = "95 %";
  int runs = 400;
};

/// Adds --goals, --rate, --runs, --clogging, --spilled and --confidence.
void add_question_options(CLI::App& command, OptimiseWords& words);

/// Throws InputError for a goal that is none, and for what is out of its range.
OptimiseQuestion read_question(const OptimiseWords& words);

/// A search for a front.
class ParetoStudy : public AdaptiveStudy {
 public:
  /// Throws InputError for what cannot be looked for.
  ParetoStudy(const std::filesystem::path& file, const std::vector<std::string>& sets, std::uint64_t first_random_seed,
              const std::shared_ptr<SourceFiles>& files, const OptimiseQuestion& question);
  explicit ParetoStudy(const StudyPlan& plan);

  std::vector<std::string> warnings() const override { return search_.warnings(); }
  OutputFolder folder(const CommonOptions& options) const override;
  /// Its runs are those of the first round.
  const StudyPlan& plan() const override { return plan_; }
  bool run_to_decision(RoundExecutor& rounds) override;
  std::vector<PlannedRun> asked_for() const override { return search_.plan(); }
  StudyPage page(const SweepTiming& timing) const override { return study_page(result_, timing); }
  int report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const override;

 private:
  std::filesystem::path file_;
  std::shared_ptr<SourceFiles> files_;
  StudyOptimisation search_;
  StudyPlan plan_;
  OptimiseResult result_;  // of where it was led to
};

}  // namespace vibrosow
