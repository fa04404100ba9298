#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/common_options.hpp"
#include "cli/make_runs.hpp"
#include "report/study_page.hpp"
#include "storage/study_plan.hpp"

namespace vibrosow {

/// A study that is asked something, whose runs follow from the runs before them: a decision or a search. Its plan keeps
/// what is asked; all else follows from the runs that are kept.
class AdaptiveStudy {
 public:
  virtual ~AdaptiveStudy() = default;
  AdaptiveStudy() = default;
  AdaptiveStudy(const AdaptiveStudy&) = delete;
  AdaptiveStudy& operator=(const AdaptiveStudy&) = delete;

  /// What can hardly be meant in its scenes.
  virtual std::vector<std::string> warnings() const = 0;
  /// Where its reports go. Throws InputError where those of another command are there.
  virtual OutputFolder folder(const CommonOptions& options) const = 0;
  /// What is asked, the files as they were read, and runs that it takes in any case.
  virtual const StudyPlan& plan() const = 0;
  /// Through its rounds to its end; false where runs are missing.
  virtual bool run_to_decision(RoundExecutor& rounds) = 0;
  /// The runs that it has asked for so far.
  virtual std::vector<PlannedRun> asked_for() const = 0;
  /// What the page of where it was led to shows. `timing`: of the runs that were made for it just now.
  virtual StudyPage page(const SweepTiming& timing) const = 0;
  /// Writes the reports of where it is, with a `page` unless that is empty, and prints its answer; an exit code.
  virtual int report(const OutputFolder& folder, const CommonOptions& options, const std::string& page) const = 0;
};

/// The decision or search of a plan; null for a sweep's. Throws InputError where this version of the program, or the
/// models that are shipped with it, make other runs of it.
std::unique_ptr<AdaptiveStudy> adaptive_study(const StudyPlan& plan);

/// Makes its runs and its reports; an exit code.
int answer(AdaptiveStudy& asked, const CommonOptions& options, const BatchFlags& batch,
           const std::vector<std::string>& reuse);

/// Adds its page with the replays that the options ask for (add_page_with_replays). `timing`: as of `page`.
int add_page_with_replays(const AdaptiveStudy& asked, const OutputFolder& folder, const StudyRuns& runs,
                          const CommonOptions& options, const std::string& page_template, const SweepTiming& timing);

}  // namespace vibrosow
