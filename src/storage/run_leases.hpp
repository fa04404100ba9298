#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"

namespace vibrosow {

/// That a run is under way, as a small file that says where.
struct RunNote {
  std::string run;           // name of its case
  std::string host;          // name of the machine
  int process = 0;           // there
  std::string since;         // by that machine's clock, UTC
  double fraction = 0;       // of the run that is done
  double from_fraction = 0;  // of it that was done before, when it was taken up again
};

/// Notes of runs under way in one folder, so that several processes, on any machines, do not make the same run at the
/// same time. Nothing but time depends on them: a run that is made twice is the same file. For several threads.
class RunLeases {
 public:
  /// A note that has not changed for `patience` is of a process that is dead or asleep; so is one of a process of this
  /// machine that is no more. The clock is this process's own, since those of several machines do not agree.
  explicit RunLeases(PathInFolder folder, std::chrono::duration<double> patience = std::chrono::seconds(30))
      : folder_(std::move(folder)), patience_(patience) {}

  /// Notes that this process makes the run from now on; false where another does. Throws InputError where a link is on
  /// the way to the folder, CannotWrite where there is no right to make it.
  bool claim(const std::string& run);

  /// To be called often while it runs: says how far it is every few seconds.
  void heartbeat(const std::string& run, double fraction);

  /// Removes the note.
  void release(const std::string& run);

  /// All that can be read, in the order of their names.
  std::vector<RunNote> all() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Own {
    RunNote note;
    std::string token;  // no other note has it
    long heartbeats = 0;
    Clock::time_point written;
  };
  struct Seen {
    std::string text;
    Clock::time_point since;
  };

  PathInFolder file_of(const std::string& run) const;
  bool is_abandoned(const std::string& run);
  bool is_first(const Own& own) const;
  void write(const Own& own) const;

  PathInFolder folder_;
  std::chrono::duration<double> patience_;
  std::mutex mutex_;
  std::map<std::string, Own> own_;
  std::map<std::string, Seen> seen_;
};

}  // namespace vibrosow
