#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vibrosow {

/// What a sweep was asked for and which runs that takes, as it lies in its folder.
struct SweepPlan {
  std::string study;              // absolute path of the study file
  std::vector<std::string> sets;  // KEY=VALUE of the command line
  std::uint64_t random_seed = 1;  // the first
  std::vector<std::string> runs;  // case names, one a scene and random seed
};

/// Where a sweep's folder has its runs and its plan.
std::filesystem::path cases_of(const std::filesystem::path& folder);

/// Replaces the plan in a sweep's folder. Throws InputError where it cannot be written.
void write_plan(const std::filesystem::path& folder, const SweepPlan& plan);

/// Throws InputError where the folder has no plan, or one that cannot be read.
SweepPlan read_plan(const std::filesystem::path& folder);

}  // namespace vibrosow
