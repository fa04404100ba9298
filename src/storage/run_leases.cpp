#include "storage/run_leases.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "files/atomic_file.hpp"
#include "files/this_machine.hpp"
#include "files/whole_file.hpp"
#include "scene/checked_json.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr std::chrono::seconds beat_every(5);

constexpr std::size_t most_of_a_note = 4096;  // bytes

std::string text_of(const fs::path& file) {
  return text_of_file(file, most_of_a_note).value_or("");
}

/// When a process was started, in ticks of its machine, so that a number given to another process is not taken for it;
/// empty where there is no such process, or it is dead and its parent has not looked. The 22nd word of its stat; the
/// second, in brackets, may hold blanks, the third is its state.
std::string start_of(int process) {
  const std::string stat = text_of(fmt::format("/proc/{}/stat", process));
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return "";
  std::istringstream words(stat.substr(name_end + 1));
  std::string word;
  for (int k = 3; words >> word && k < 22; ++k)
    if (k == 3 && (word == "Z" || word == "X")) return "";
  return word;
}

std::string json_of(const RunNote& note, const std::string& token, long heartbeats) {
  static const std::string here = place_of_processes();
  return Json{{"host", note.host},
              {"place", here},
              {"pid", note.process},
              {"started", start_of(note.process)},
              {"since", note.since},
              {"fraction", note.fraction},
              {"from_fraction", note.from_fraction},
              {"token", token},
              {"beat", heartbeats}}
             .dump() +
         '\n';
}

/// Throws InputError where it is none.
int process_in(const nlohmann::json& note) {
  return static_cast<int>(whole_number(note.at("pid"), 0, INT_MAX));
}

/// Whether such a note is of a process of this machine that is no more.
bool owner_has_exited(const std::string& text) {
  try {
    const auto json = parse_json<nlohmann::json>(text);
    return json.at("place") == place_of_processes() && !(json.at("started") == start_of(process_in(json)));
  } catch (const nlohmann::json::exception&) {
  } catch (const InputError&) {
  }
  return false;
}

}  // namespace

PathInFolder RunLeases::file_of(const std::string& run) const {
  return folder_ / run;
}

bool RunLeases::is_abandoned(const std::string& run) {
  const std::string text = text_of(file_of(run).path());
  if (owner_has_exited(text)) return true;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  Seen& seen = seen_.try_emplace(run, Seen{text, now}).first->second;
  if (seen.text != text) seen = {text, now};
  return now - seen.since >= patience_;
}

bool RunLeases::claim(const std::string& run) {
  try {
    make_directories(folder_, folder_.path());
  } catch (const CannotWrite& error) {
    if (!error.for_want_of_room) throw;  // nor could the run be kept
  }
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  Own own{{run, host_name(), getpid(), fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now)), 0, -1},
          temporary_name(""),
          0,
          Clock::now()};
  if (!is_first(own)) {
    if (!is_abandoned(run)) return false;
    write(own);
  }
  const std::lock_guard lock(mutex_);
  own_[run] = std::move(own);
  return true;
}

/// Writes a note where there is none; false where there is one. What fails for another reason is let be: then nobody
/// knows, and the run is made.
bool RunLeases::is_first(const Own& own) const {
  const fs::path file = file_of(own.note.run).path();
  const PathInFolder temporary = folder_ / temporary_name(own.note.run);
  const std::string text = json_of(own.note, own.token, own.heartbeats);
  std::ofstream(temporary.path()) << text;
  const bool refused = link(temporary.path().c_str(), file.c_str()) != 0 && errno == EEXIST;
  remove_file(temporary);
  return !refused || text_of(file) == text;  // a network file system may repeat a link that it has made
}

/// Over a note that is there. Without fsync, and what fails is let be: a lost note costs time alone.
void RunLeases::write(const Own& own) const {
  if (folder_.link_on_the_way(true)) return;
  const PathInFolder temporary = folder_ / temporary_name(own.note.run);
  std::ofstream(temporary.path()) << json_of(own.note, own.token, own.heartbeats);
  std::error_code none;
  fs::rename(temporary.path(), file_of(own.note.run).path(), none);
}

void RunLeases::heartbeat(const std::string& run, double fraction) {
  Own now;
  {
    const std::lock_guard lock(mutex_);
    Own& own = own_.at(run);
    if (own.note.from_fraction < 0) own.note.from_fraction = fraction;
    own.note.fraction = fraction;
    if (Clock::now() - own.written < beat_every) return;
    own.written = Clock::now();
    ++own.heartbeats;
    now = own;
  }
  write(now);
}

void RunLeases::release(const std::string& run) {
  remove_file(file_of(run));
  const std::lock_guard lock(mutex_);
  own_.erase(run);
  seen_.erase(run);
}

std::vector<RunNote> RunLeases::all() const {
  std::vector<RunNote> notes;
  for (const fs::path& file : entries_of(folder_.path())) {
    const std::string name = file.filename().string(), text = text_of(file);
    if (name.starts_with('.') || owner_has_exited(text)) continue;
    try {
      const auto json = parse_json<nlohmann::json>(text);
      notes.push_back({name, printable(json.at("host").get<std::string>()), process_in(json),
                       printable(json.at("since").get<std::string>()), number_within(json.at("fraction"), 0, 1),
                       number_within(json.at("from_fraction"), -1, 1)});
    } catch (const nlohmann::json::exception&) {
    } catch (const InputError&) {
    }
  }
  std::ranges::sort(notes, {}, &RunNote::run);
  return notes;
}

}  // namespace vibrosow
