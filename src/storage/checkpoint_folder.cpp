#include "storage/checkpoint_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <system_error>

#include "files/atomic_file.hpp"

namespace vibrosow {

namespace fs = std::filesystem;

CheckpointFolder::Steps CheckpointFolder::steps_of(const std::string& run) const {
  Steps steps;
  for (const fs::path& file : entries_of(path_.path())) {
    const std::string name = file.filename().string();
    if (!name.starts_with(run + ".") || file.extension() != ".checkpoint") continue;
    std::int64_t step = 0;
    const char* digits = name.data() + run.size() + 1;
    std::from_chars(digits, name.data() + name.size(), step);
    steps.emplace_back(step, file);
  }
  std::ranges::sort(steps, std::greater{});
  return steps;
}

void CheckpointFolder::keep(const std::string& run, std::int64_t step, std::string_view bytes) const {
  const PathInFolder file = path_ / fmt::format("{}.{}.checkpoint", run, step);
  make_directories(path_, file.path());
  write_file_atomically(file, bytes);
  for (const auto& [other, path] : steps_of(run))
    if (other < step) remove_file(path_ / path.filename());
}

std::vector<fs::path> CheckpointFolder::of(const std::string& run) const {
  std::vector<fs::path> paths;
  for (const auto& [step, path] : steps_of(run)) paths.push_back(path);
  return paths;
}

std::vector<std::string> CheckpointFolder::runs() const {
  std::set<std::string> runs;
  for (const fs::path& file : entries_of(path_.path()))
    if (file.extension() == ".checkpoint") runs.insert(file.stem().stem().string());
  return {runs.begin(), runs.end()};
}

void CheckpointFolder::remove(const std::string& run) const {
  for (const fs::path& path : of(run)) remove_file(path_ / path.filename());
}

}  // namespace vibrosow
