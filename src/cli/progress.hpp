#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace vibrosow {

enum class ProgressStyle {
  none,
  text,  // one redrawn line on a terminal, otherwise a plain line every few seconds
  json,  // a line of JSON an event, for programs
};

inline ProgressStyle text_unless(bool quiet) {
  return quiet ? ProgressStyle::none : ProgressStyle::text;
}

/// How far the work is, on stderr. One thread at a time.
class Progress {
 public:
  /// `unit_count` of `unit` make the whole: 40 "runs", 2e6 "steps".
  Progress(ProgressStyle style, double unit_count, std::string unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double fraction_done);
  /// Of what came before: a share of the whole that took no time, so that it is no measure of what is left.
  void begin_at(double fraction_done) { began_at_ = fraction_done; }
  /// What stands behind the line, asked for when it is drawn.
  void show_also(std::function<std::string()> remark) { remark_ = std::move(remark); }
  /// A line of JSON, in that style alone; `fields` as they stand in it: R"("run":"ab")".
  void tell(const std::string& event, const std::string& fields) const;

  double seconds() const;  // since it began

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due() const;
  std::string line(double fraction_done) const;
  double seconds_left(double fraction_done) const;

  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_ = begin_;
  ProgressStyle style_;
  bool terminal_;
  bool drawn_ = false;
  double unit_count_;
  double began_at_ = 0;
  std::string unit_;
  std::function<std::string()> remark_;
};

/// "45 s", "3 min 20 s", "2 h 05 min".
std::string duration_text(double seconds);

}  // namespace vibrosow
