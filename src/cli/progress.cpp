#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "report/terminal_text.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

constexpr double redraw_every = 0.2;  // s
constexpr double line_every = 5;      // s
constexpr double event_every = 1;     // s

/// "40 runs", "2.1 million steps".
std::string amount_text(double count, const std::string& unit) {
  return count < 1e6 ? fmt::format("{:.0f} {}", count, unit) : fmt::format("{:.1f} million {}", count / 1e6, unit);
}

/// The time of day in so many seconds, where people read it: "14:05", or "14:05 tomorrow", "14:05 in 3 days".
std::string time_of_day(double seconds) {
  const std::time_t now = std::time(nullptr), then = now + static_cast<std::time_t>(seconds);
  std::tm today{}, day{};
  localtime_r(&now, &today), localtime_r(&then, &day);
  const std::string time = fmt::format("{:02}:{:02}", day.tm_hour, day.tm_min);
  today.tm_hour = today.tm_min = today.tm_sec = day.tm_hour = day.tm_min = day.tm_sec = 0;
  const long long days = std::llround(std::difftime(std::mktime(&day), std::mktime(&today)) / 86400);
  return days < 1 ? time : days < 2 ? time + " tomorrow" : fmt::format("{} in {} days", time, days);
}

}  // namespace

std::string duration_text(double seconds) {
  const long long whole = std::llround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

Progress::Progress(ProgressStyle style, double unit_count, std::string unit)
    : style_(style), terminal_(isatty(STDERR_FILENO) == 1), unit_count_(unit_count), unit_(std::move(unit)) {}

Progress::~Progress() {
  if (drawn_ && terminal_) std::fputs("\r\033[K", stderr);  // leaves a clean line for the table
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

/// Not above 0: not known yet.
double Progress::seconds_left(double fraction_done) const {
  const double done_now = fraction_done - began_at_;
  return done_now > 0 ? seconds() * (1 - fraction_done) / done_now : -1;
}

std::string Progress::line(double fraction_done) const {
  const double passed = seconds(), left = seconds_left(fraction_done);
  std::string text = fmt::format("{:3.0f} % of {}", 100 * fraction_done, amount_text(unit_count_, unit_));
  if (!terminal_ || left < 0) text += fmt::format(", {} passed", duration_text(passed));
  if (left >= 0 && passed > 0) text += fmt::format(", {} left, done at {}", duration_text(left), time_of_day(left));
  return text;
}

bool Progress::is_due() const {
  const bool redrawn = terminal_ && style_ == ProgressStyle::text;
  const double every = redrawn ? redraw_every : style_ == ProgressStyle::json ? event_every : line_every;
  return std::chrono::duration<double>(Clock::now() - last_).count() >= every;
}

void Progress::update(double fraction_done) {
  if (style_ == ProgressStyle::none || !is_due()) return;
  last_ = Clock::now();
  if (style_ == ProgressStyle::json) {
    const double left = seconds_left(fraction_done);
    tell("progress", fmt::format(R"("fraction":{:.4f},"passed_s":{:.1f},"left_s":{})", fraction_done, seconds(),
                                 left >= 0 ? fmt::format("{:.1f}", left) : "null"));
    return;
  }
  const std::string remark = remark_ ? remark_() : "";
  const std::string text = line(fraction_done) + (remark.empty() ? "" : "; ") + printable(remark);
  if (!terminal_) {
    std::fputs((text + "\n").c_str(), stderr);
    return;
  }
  drawn_ = true;
  constexpr int width = 10;
  const auto filled = static_cast<std::size_t>(std::clamp(fraction_done, 0.0, 1.0) * width);
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  const std::string drawn = fmt::format("[{}] {}", bar, text).substr(0, terminal_columns - 1);  // one line, whatever
  std::fputs(fmt::format("\r\033[K{}", drawn).c_str(), stderr);
  std::fflush(stderr);
}

void Progress::tell(const std::string& event, const std::string& fields) const {
  if (style_ != ProgressStyle::json) return;
  std::fputs(fmt::format("{{\"event\":\"{}\"{}{}}}\n", event, fields.empty() ? "" : ",", fields).c_str(), stderr);
}

}  // namespace vibrosow
