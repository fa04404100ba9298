#include "report/output_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "files/atomic_file.hpp"
#include "files/whole_file.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

constexpr const char* list_name = "files.json";

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(fmt::format("{} {}; choose another --out, or remove it", path.string(), reason));
}

/// A directory that is removed again with the files in it that are named; not with what else there is, since it may by
/// then be what was somebody's folder.
class TemporaryDirectory {
 public:
  /// In a directory, named after a file there.
  TemporaryDirectory(const fs::path& directory, const std::string& stem) {
    constexpr int tries = 5;  // a network file system may repeat a mkdir that it has done, and report that it is there
    for (int k = 0; k < tries; ++k) {
      path_ = directory / temporary_name(stem);
      if (mkdir(path_.c_str(), 0777) == 0) return;
      if (errno != EEXIST) break;
    }
    cannot_write(path_, errno);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code error;
    for (const std::string& name : names_) remove_file(path_ / name);
    fs::remove(path_, error);
  }
  const fs::path& path() const { return path_; }
  void name(const std::string& file) { names_.insert(file); }

 private:
  fs::path path_;
  Names names_;
};

/// What files.json says.
struct FileList {
  std::string command;
  Names files;
};

std::string text_of(const FileList& list, bool complete) {
  nlohmann::ordered_json json = {{"command", list.command}, {"complete", complete}, {"files", list.files}};
  return json.dump(2) + '\n';
}

/// The list of a folder; none without one. Throws InputError for a files.json that is not ours: a name in it that leads
/// out of the folder would have a file removed there.
std::optional<FileList> read_list(const fs::path& folder) {
  const fs::path path = folder / list_name;
  constexpr std::size_t most = std::size_t{1} << 24;  // bytes
  const std::optional<std::string> text = text_of_file_or_none(path, most);
  if (!text) return std::nullopt;
  try {
    const auto json = parse_json<nlohmann::json>(*text);
    FileList list{json.at("command"), json.at("files")};
    if (is_plain_name(list.command) && std::ranges::all_of(list.files, is_plain_name)) return list;
  } catch (const nlohmann::json::exception&) {
  } catch (const InputError&) {
  }
  refuse(path, "was not written by vibrosow");
}

/// `pattern`: a name in which * stands for digits.
bool fits(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  const std::string_view head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  if (name.size() <= head.size() + tail.size() || !name.starts_with(head) || !name.ends_with(tail)) return false;
  name.remove_prefix(head.size());
  name.remove_suffix(tail.size());
  return std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

/// The former set of the command; throws InputError where the folder holds what it may not replace. Another process may
/// add to the set meanwhile, each file named before it is there: one that is not named is looked for in the list anew.
FileList former_set(const fs::path& folder, const std::string& command, const std::vector<std::string>& files) {
  const auto list_now = [&] { return read_list(folder).value_or(FileList{command, {}}); };
  FileList former = list_now();
  if (former.command != command)
    refuse(folder, fmt::format("holds the reports of vibrosow {}, not of {}", former.command, command));
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (former.files.contains(name) || !std::ranges::any_of(files, [&](const auto& file) { return fits(name, file); }))
      continue;
    former = list_now();
    if (!former.files.contains(name))
      refuse(entry.path(), "would be overwritten, and no files.json names it as a report");
  }
  return former;
}

/// Whether there is nothing in the folder but this set and its list. What is named and no plain file is somebody's.
bool holds_only(const fs::path& folder, const FileList& list) {
  return std::ranges::all_of(fs::directory_iterator(folder), [&](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return (name == list_name || list.files.contains(name)) && entry.symlink_status().type() == fs::file_type::regular;
  });
}

/// Puts `fresh` where `folder` is by one rename; false where that is not possible. What was there goes.
bool exchange(const fs::path& fresh, const fs::path& folder) {
  std::error_code error;
  if (fs::equivalent(folder, fs::current_path(error), error) || error) return false;
  struct stat former = {};
  if (stat(folder.c_str(), &former) != 0 || chmod(fresh.c_str(), former.st_mode & 07777) != 0) return false;
  const bool done = rename(fresh.c_str(), folder.c_str()) == 0 ||  // an empty folder is replaced
                    renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0;
  if (done) sync_directory(folder.parent_path());
  return done;
}

void move_in_one_by_one(const fs::path& fresh, const fs::path& folder, const FileList& former, const FileList& list) {
  FileList both = list;
  both.files.insert(former.files.begin(), former.files.end());
  write_file_atomically(folder / list_name, text_of(both, false));
  for (const std::string& name : former.files)
    if (!list.files.contains(name)) remove_file(folder / name);
  for (const std::string& name : list.files) move_file(fresh / name, folder / name);
  sync_directory(folder);
  move_file(fresh / list_name, folder / list_name);
  sync_directory(folder);
}

/// Takes away what killed processes left that made a set of this folder, or wrote into it. Of a directory, what a set
/// may have; it stays where there is more in it.
void sweep_what_was_left(const fs::path& folder, const Names& names) {
  for (const fs::path& place : {folder.parent_path(), folder}) {
    sweep_temporary_files(place);
    for (const fs::path& entry : entries_of(place)) {
      std::error_code error;
      const bool is_set = entry.filename().string().starts_with("." + folder.filename().string() + ".");
      if (!is_set || !fs::is_directory(fs::symlink_status(entry, error)) || !is_left_behind(entry)) continue;
      for (const std::string& name : names) remove_file(entry / name);
      fs::remove(entry, error);
    }
  }
}

/// Where the new set is made: beside the folder, or within it where one may not write beside it.
fs::path place_for_fresh(const fs::path& folder) {
  const fs::path beside = folder.parent_path();
  return access(beside.c_str(), W_OK | X_OK) == 0 ? beside : folder;
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, std::string command, const std::vector<std::string>& files, bool holds_more)
    : folder_(std::move(folder)), command_(std::move(command)), holds_more_(holds_more) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw InputError(fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
  if (access(folder_.c_str(), W_OK | X_OK) != 0)
    throw InputError(fmt::format("{}: cannot be written into: {}", folder_.string(), std::strerror(errno)));
  former_set(folder_, command_, files);
}

/// Named before it is there, so that it is never taken for a foreign file.
void OutputFolder::add(const OutputFile& file) const {
  FileList list = former_set(folder_, command_, {file.name});
  list.files.insert(file.name);
  write_file_atomically(folder_ / list_name, text_of(list, false));
  write_file_atomically(folder_ / file.name, file.content);
  write_file_atomically(folder_ / list_name, text_of(list, true));
}

bool OutputFolder::clear() const {
  if (former_set(folder_, command_, {}).files.empty()) return false;
  write({});
  return true;
}

void OutputFolder::write(const std::vector<OutputFile>& files) const {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) cannot_write(folder_, error.value());
  std::vector<std::string> names;
  for (const OutputFile& file : files) names.push_back(file.name);
  const FileList former = former_set(folder_, command_, names);
  const FileList list{command_, {names.begin(), names.end()}};

  const fs::path folder = fs::canonical(folder_);
  TemporaryDirectory fresh(place_for_fresh(folder), folder.filename().string());
  Names all = {list_name};
  for (const FileList& set : {former, list}) all.insert(set.files.begin(), set.files.end());
  for (const std::string& name : all) fresh.name(name);
  for (const OutputFile& file : files) write_new_file(fresh.path() / file.name, file.content, folder_ / file.name);
  write_new_file(fresh.path() / list_name, text_of(list, true), folder_ / list_name);
  sync_directory(fresh.path());
  sweep_what_was_left(folder, all);
  if (holds_more_ || !holds_only(folder, former) || !exchange(fresh.path(), folder))
    move_in_one_by_one(fresh.path(), folder, former, list);
}

}  // namespace vibrosow
