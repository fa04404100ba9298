#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"
#include "storage/asked_question.hpp"

namespace vibrosow {

/// One run of a study: a layout's scene with a random seed.
struct PlannedRun {
  std::string name;  // of its case
  int layout = 0;    // number of the first layout with this scene
  std::uint64_t random_seed = 1;
  double grain_steps = 0;  // foreseen: what it costs
};

/// A study as it was when it was begun, files and all, with the runs that it takes. Never changed once it is written.
struct StudyPlan {
  std::string study;                         // its file's name, as `files` has it
  std::vector<std::string> sets;             // KEY=VALUE of the command line
  std::uint64_t random_seed = 1;             // the first
  std::map<std::string, std::string> files;  // what was read, by path from the study's folder, or of what is shipped
  std::vector<PlannedRun> runs;              // by layout, then random seed
  AskedQuestion question{};                  // of a decision or a search
};

/// Whether two plans are of one study, asked one question, however many runs each has by now.
bool are_of_one_study(const StudyPlan& one, const StudyPlan& other);

/// Where a sweep's folder has its runs and its plans.
PathInFolder cases_of(const std::filesystem::path& folder);

/// Writes a plan into a sweep's folder, named by its hash, and makes it the current one; gives its name. Throws
/// InputError where it cannot be written.
std::string freeze_plan(const std::filesystem::path& folder, const StudyPlan& plan);

/// The plan of a name, the current one where that is empty. Throws InputError where the folder has no such plan, or
/// it is damaged: cut short, of another hash, or with a name, number or cost that no plan has; or where it keeps its
/// question as the words of a command line ("asked"), which other versions of the program read.
StudyPlan read_plan(const std::filesystem::path& folder, std::string name = "");

/// A file of a plan: its name with an extension.
PathInFolder plan_file(const std::filesystem::path& folder, const std::string& name);

/// Name of the current plan. Throws InputError where the folder has none.
std::string current_plan(const std::filesystem::path& folder);

/// Which of the runs make up the `number`th (1..) of `shards` shares, in order: all shares cost the same as nearly as
/// dealing the dearest run first, always to the share that has least, gives it. By the plan alone.
std::vector<std::size_t> shard_of(const StudyPlan& plan, std::size_t number, std::size_t shards);

}  // namespace vibrosow
