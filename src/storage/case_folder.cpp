#include "storage/case_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>

#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
constexpr const char* extension = ".case";
constexpr std::size_t name_digits = 32;
constexpr std::size_t most_bytes_of_a_segment = std::size_t{1} << 26;

/// The case in such bytes, unless it is damaged or belongs to another name.
std::optional<Case> case_in(const std::string& bytes, const std::string& name) {
  try {
    Case read = read_case(bytes);
    if (case_name(read.identity) == name) return read;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

}  // namespace

PathInFolder CaseFolder::file_of(const std::string& name) const {
  return path_ / name.substr(0, 2) / (name + extension);
}

std::string CaseFolder::loose_bytes(const std::string& name) const {
  return text_of_file(file_of(name).path(), most_bytes_of_a_case).value_or("");
}

/// The first sound copy: loose, or in a segment known, or in one that has come since.
std::optional<CaseFolder::Copy> CaseFolder::sound_copy(const std::string& name) const {
  Copy copy{loose_bytes(name), {}};
  const auto is_sound = [&](const std::string& bytes) {
    std::optional<Case> read = case_in(bytes, name);
    if (read) copy.read = std::move(*read);
    return read.has_value();
  };
  if (is_sound(copy.bytes)) return copy;
  for (int look = 0; look < 2; ++look) {
    {
      const std::shared_lock lock(mutex_);  // many read side by side
      copy.bytes = segments_.find(name, is_sound);
    }
    if (!copy.bytes.empty()) return copy;
    const std::lock_guard lock(mutex_);
    segments_.refresh();
  }
  return std::nullopt;
}

bool CaseFolder::is_of_other_version(const std::string& name) const {
  if (is_case_of_other_version(loose_bytes(name))) return true;
  const std::lock_guard lock(mutex_);
  return !segments_.find(name, is_case_of_other_version).empty();
}

std::vector<std::string> CaseFolder::unreadable_segments() const {
  const std::lock_guard lock(mutex_);
  segments_.refresh();
  return segments_.unreadable();
}

std::optional<Run> CaseFolder::find(std::string_view identity) const {
  std::optional<Case> found = named(case_name(identity));
  if (!found || found->identity != identity) return std::nullopt;
  return std::move(found->run);
}

std::optional<Case> CaseFolder::named(const std::string& name) const {
  std::optional<Copy> copy = sound_copy(name);
  return copy ? std::optional(std::move(copy->read)) : std::nullopt;
}

bool CaseFolder::has(const std::string& name) const {
  return sound_copy(name).has_value();
}

void CaseFolder::remove(const std::string& name) const {
  remove_file(file_of(name));
}

std::vector<std::string> CaseFolder::loose_names() const {
  std::vector<std::string> names;
  for (const fs::path& folder : entries_of(path_.path())) {
    const std::string first = folder.filename().string();
    if (!is_hash_name(first, 2) || (path_ / first).link_on_the_way(true)) continue;
    for (const fs::path& file : entries_of(folder))
      if (const std::string name = file.stem().string();
          file.extension() == extension && is_hash_name(name, name_digits))
        names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> CaseFolder::names() const {
  std::vector<std::string> names = loose_names();
  {
    const std::lock_guard lock(mutex_);
    segments_.refresh();
    std::ranges::copy(segments_.names(), std::back_inserter(names));
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void CaseFolder::keep(std::string_view identity, const Run& run) const {
  const std::string name = case_name(identity), bytes = case_bytes(identity, run);
  const PathInFolder file = file_of(name);
  if (const std::optional<Copy> there = sound_copy(name)) {
    if (content_of_case(there->bytes) == content_of_case(bytes)) return;
    throw InputError(
        fmt::format("{}: holds another run of the same scene and random seed: the programs that made them do not agree",
                    file.path().string()));
  }
  if (bytes.size() > most_bytes_of_a_case)
    throw InputError(fmt::format("{}: more than 1 GiB is not kept of a run; record less", file.path().string()));
  make_directories(path_ / name.substr(0, 2), file.path());
  write_file_atomically(file, bytes);
}

std::size_t CaseFolder::pack(std::size_t at_least) const {
  const std::vector<std::string> names = loose_names();
  if (names.size() < at_least) return 0;
  std::size_t packed = 0, bytes = 0;
  std::map<std::string, std::string> segment;
  const auto write = [&] {
    if (segment.empty()) return;
    segments_.write(segment);
    for (const auto& [name, content] : segment) remove(name);
    packed += segment.size();
    segment.clear(), bytes = 0;
  };
  for (const std::string& name : names) {
    std::string content = loose_bytes(name);
    const std::optional<Case> read = case_in(content, name);
    if (!read || read->run.status != RunStatus::finished) continue;
    bytes += content.size();
    segment.emplace(name, std::move(content));
    if (segment.size() == full_segment || bytes >= most_bytes_of_a_segment) write();
  }
  write();
  return packed;
}

}  // namespace vibrosow
