#pragma once

#include <chrono>
#include <string>

namespace vibrosow {

/// How far the work is, on stderr: one redrawn line on a terminal, otherwise a plain line every few seconds; nothing
/// when quiet. One thread at a time.
class Progress {
 public:
  /// `unit_count` of `unit` make the whole: 40 "runs", 2e6 "steps".
  Progress(bool quiet, double unit_count, std::string unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double fraction_done);
  double seconds() const;  // since it began

 private:
  std::string line(double fraction_done) const;

  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
  bool quiet_, terminal_;
  bool drawn_ = false;
  double unit_count_;
  std::string unit_;
};

/// "45 s", "3 min 20 s", "2 h 05 min".
std::string duration_text(double seconds);

}  // namespace vibrosow
