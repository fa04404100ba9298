#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/study_plan.hpp"
#include "study/study.hpp"
#include "study/study_runs.hpp"
#include "study/sweep.hpp"

namespace vibrosow {

/// A study with the plan of its runs.
struct PlannedStudy {
  Study study;
  StudyPlan plan;
};

/// Reads a study and plans all its runs. Throws as `read_study` does.
PlannedStudy plan_study(const std::filesystem::path& file, const std::vector<std::string>& sets,
                        std::uint64_t first_random_seed,
                        const std::shared_ptr<SourceFiles>& files = std::make_shared<SourceFiles>());

/// How many runs of each scene a plan has.
std::vector<int> replicates_in(const PlannedStudy& planned);

/// A sweep by those runs of its plan that are kept; the others are absent. `jobs`: threads that read.
StudyResult answer_of_kept(const PlannedStudy& planned, const KeptRuns& kept, int jobs, const OnRuns& on_runs = {});

/// The next round of a study whose replicates are by need: more runs of the scenes whose intervals are still too wide,
/// by the runs that are kept. None where nothing more is needed.
std::optional<PlannedStudy> next_round(const PlannedStudy& planned, const KeptRuns& kept, int jobs);

/// The study of a plan as it was, whatever has become of its files. Throws InputError where this version of the
/// program, or the models that are shipped with it, make another study of them, or where the plan is of a search, which
/// has no fixed layouts.
PlannedStudy study_of_plan(const StudyPlan& plan);

/// Of a study, those runs of its plan whose indices are given.
std::vector<WantedRun> wanted_runs(const PlannedStudy& planned, const std::vector<std::size_t>& which);
std::vector<WantedRun> wanted_runs(const PlannedStudy& planned);

}  // namespace vibrosow
