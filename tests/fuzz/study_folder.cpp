// What a study's folder holds beside its runs. The bytes are edits of good plans, which get their right names: of a
// sweep, a decision and a search; of a good segment, with the right hash of its numbers; and a note as they are.

#include <fmt/format.h>
#include <xxhash.h>

#include "files/whole_file.hpp"
#include "fuzz/edits.hpp"
#include "fuzz/try_bytes.hpp"
#include "input/temporary_file.hpp"
#include "scene/input_error.hpp"
#include "storage/run_leases.hpp"
#include "storage/segments.hpp"
#include "storage/study_plan.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

std::string hash_of(std::string_view bytes) {
  return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

std::string good_plan(const fs::path& folder, const AskedQuestion& question) {
  const std::string name = freeze_plan(
      folder, {"study.toml", {"a=1"}, 1, {{"study.toml", "base = 1"}}, {{std::string(32, 'a'), 1, 1, 1e6}}, question});
  return text_of_file(plan_file(folder, name + ".json").path()).value();
}

std::vector<std::string> good_plans(const fs::path& folder) {
  return {good_plan(folder, {}),
          good_plan(folder, DecideQuestion{"rate", WantedRate{true, 40, 45}, 0.05, 0.02, 0.95, SelectionRule::posterior,
                                           400, true}),
          good_plan(folder, OptimiseQuestion{{"rate", "power"}, WantedRate{false, 0.1, 0.2}, 0.05, 0.01, 0.95, 60})};
}

void read_plan_of(const fs::path& folder, const std::string& text) {
  const std::string name = hash_of(text);
  const fs::path file = plan_file(folder, name + ".json").path();
  write_file_atomically(file, text);
  try {
    read_plan(folder, name);
  } catch (const InputError&) {
  }
  fs::remove(file);
}

/// Of the head's line: "vibrosow segment 1 ", the hash, a line's end; the numbers end where the first case begins.
std::string with_right_hash(std::string segment, std::size_t numbers) {
  constexpr std::size_t hash_at = 19, numbers_at = hash_at + 17;
  if (segment.size() < numbers_at + numbers) return segment;
  return segment.replace(hash_at, 16, hash_of(std::string_view(segment).substr(numbers_at, numbers)));
}

void read_segment(const fs::path& folder, const std::string& bytes) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  write_file_atomically(folder / "a.segment", bytes);
  Segments segments(folder);
  segments.refresh();
  for (const std::string& name : segments.names()) segments.find(name, [](const std::string&) { return false; });
}

}  // namespace

void try_bytes(const std::string& bytes) {
  static const TemporaryFolder folder;
  static const fs::path root = folder.path("study");
  static const std::vector<std::string> plans = good_plans(root);
  static const std::string segment = [] {
    Segments(root / "segments").write({{std::string(32, 'a'), "one"}, {std::string(32, 'b'), "another"}});
    return text_of_file(entries_of(root / "segments").front()).value();
  }();
  for (const std::string& plan : plans) read_plan_of(root, edited(plan, bytes));
  constexpr std::size_t numbers = 8 + 2 * 32;
  read_segment(root / "segments", with_right_hash(edited(segment, bytes), numbers));
  fs::create_directories(root / "running");
  write_file_atomically(root / "running" / "a", bytes);
  RunLeases(root / "running").all();
}

}  // namespace vibrosow
