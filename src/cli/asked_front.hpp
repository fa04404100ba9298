#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/asked_study.hpp"
#include "design/optimise.hpp"

namespace vibrosow {

/// What `optimise` is asked, in the words of its command line.
struct OptimiseQuestion {
  std::vector<std::string> goals;
  std::string rate, spilled;
  std::string clogging = "5 %", confidence = "95 %";
  int runs = 400;
};

/// Adds --goals, --rate, --runs, --clogging, --spilled and --confidence.
void add_question_options(CLI::App& command, OptimiseQuestion& question);

/// A search for a front.
class AskedFront : public AskedStudy {
 public:
  static constexpr std::string_view command = "optimise";

  /// Throws InputError for what cannot be looked for.
  AskedFront(const std::filesystem::path& file, const std::vector<std::string>& sets, std::uint64_t first_random_seed,
             const std::shared_ptr<SourceFiles>& files, const OptimiseQuestion& question);
  explicit AskedFront(const StudyPlan& plan);

  std::vector<std::string> warnings() const override { return search_.warnings(); }
  OutputFolder folder(const CommonOptions& options) const override;
  /// Its runs are those of the first round.
  const StudyPlan& plan() const override { return plan_; }
  bool lead(RoundsOfRuns& rounds) override;
  std::vector<PlannedRun> asked_for() const override { return search_.plan(); }
  std::vector<WantedReplay> best_to_replay(std::size_t most) const override;
  std::string page_data(const SweepTiming& timing, const Replays& replays) const override;
  int report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const override;

 private:
  OptimiseResult result() const;

  std::filesystem::path file_;
  std::shared_ptr<SourceFiles> files_;
  StudyOptimisation search_;
  StudyPlan plan_;
  bool is_interrupted_ = false;
};

}  // namespace vibrosow
