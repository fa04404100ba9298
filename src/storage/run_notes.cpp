#include "storage/run_notes.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "storage/atomic_file.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr std::chrono::seconds beat_every(5);

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// A machine's name and which numbers of processes it means: containers of one machine have numbers of their own.
std::string place() {
  std::error_code none;
  return host_name() + " " + fs::read_symlink("/proc/self/ns/pid", none).string();
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

std::string json_of(const RunNote& note, const std::string& token, long beats) {
  static const std::string here = place();
  return Json{{"host", note.host},
              {"place", here},
              {"pid", note.process},
              {"started", start_of(note.process)},
              {"since", note.since},
              {"fraction", note.fraction},
              {"from_fraction", note.from_fraction},
              {"token", token},
              {"beat", beats}}
             .dump() +
         '\n';
}

/// Whether such a note is of a process of this machine that is no more.
bool is_of_the_dead(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    return json.at("place") == place() && start_of(json.at("pid")) != json.at("started");
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace

fs::path RunNotes::file_of(const std::string& run) const {
  return folder_ / run;
}

bool RunNotes::is_abandoned(const std::string& run) {
  const std::string text = text_of(file_of(run));
  if (is_of_the_dead(text)) return true;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  Seen& seen = seen_.try_emplace(run, Seen{text, now}).first->second;
  if (seen.text != text) seen = {text, now};
  return now - seen.since >= patience_;
}

bool RunNotes::claim(const std::string& run) {
  std::error_code none;
  fs::create_directories(folder_, none);
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
bool RunNotes::is_first(const Own& own) const {
  const fs::path file = file_of(own.note.run), temporary = folder_ / temporary_name(own.note.run);
  const std::string text = json_of(own.note, own.token, own.beats);
  std::ofstream(temporary) << text;
  const bool refused = link(temporary.c_str(), file.c_str()) != 0 && errno == EEXIST;
  std::error_code none;
  fs::remove(temporary, none);
  return !refused || text_of(file) == text;  // a network file system may repeat a link that it has made
}

/// Over a note that is there. Without fsync, and what fails is let be: a lost note costs time alone.
void RunNotes::write(const Own& own) const {
  const fs::path temporary = folder_ / temporary_name(own.note.run);
  std::ofstream(temporary) << json_of(own.note, own.token, own.beats);
  std::error_code none;
  fs::rename(temporary, file_of(own.note.run), none);
}

void RunNotes::beat(const std::string& run, double fraction) {
  Own now;
  {
    const std::lock_guard lock(mutex_);
    Own& own = own_.at(run);
    if (own.note.from_fraction < 0) own.note.from_fraction = fraction;
    own.note.fraction = fraction;
    if (Clock::now() - own.written < beat_every) return;
    own.written = Clock::now();
    ++own.beats;
    now = own;
  }
  write(now);
}

void RunNotes::release(const std::string& run) {
  std::error_code none;
  fs::remove(file_of(run), none);
  const std::lock_guard lock(mutex_);
  own_.erase(run);
  seen_.erase(run);
}

std::vector<RunNote> RunNotes::all() const {
  std::vector<RunNote> notes;
  for (const fs::path& file : entries_of(folder_)) {
    const std::string name = file.filename().string(), text = text_of(file);
    if (name.starts_with('.') || is_of_the_dead(text)) continue;
    try {
      const auto json = nlohmann::json::parse(text);
      notes.push_back(
          {name, json.at("host"), json.at("pid"), json.at("since"), json.at("fraction"), json.at("from_fraction")});
    } catch (const nlohmann::json::exception&) {
    }
  }
  std::ranges::sort(notes, {}, &RunNote::run);
  return notes;
}

}  // namespace vibrosow
