#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace vibrosow {
namespace {

constexpr double redraw_every = 0.2;  // s
constexpr double line_every = 5;      // s

/// "12 runs/min", "84000 steps/s".
std::string rate_text(double per_second, const std::string& unit) {
  return per_second < 10 ? fmt::format("{:.1f} {}/min", 60 * per_second, unit)
                         : fmt::format("{:.0f} {}/s", per_second, unit);
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

Progress::Progress(bool quiet, double unit_count, std::string unit)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), unit_count_(unit_count), unit_(std::move(unit)) {}

Progress::~Progress() {
  if (drawn_ && terminal_) std::fputs("\r\033[K", stderr);  // leaves a clean line for the table
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

std::string Progress::line(double fraction_done) const {
  const double passed = seconds();
  std::string text = fmt::format("{:3.0f} %  {} passed", 100 * fraction_done, duration_text(passed));
  if (fraction_done > 0 && passed > 0)
    text += fmt::format(", {}, {} left", rate_text(unit_count_ * fraction_done / passed, unit_),
                        duration_text(passed * (1 - fraction_done) / fraction_done));
  return text;
}

void Progress::update(double fraction_done) {
  if (quiet_) return;
  const auto now = Clock::now();
  if (std::chrono::duration<double>(now - last_).count() < (terminal_ ? redraw_every : line_every)) return;
  last_ = now;
  drawn_ = true;
  if (!terminal_) {
    std::fputs((line(fraction_done) + "\n").c_str(), stderr);
    return;
  }
  constexpr int width = 24;
  const auto filled = static_cast<std::size_t>(std::clamp(fraction_done, 0.0, 1.0) * width);
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  std::fputs(fmt::format("\r\033[K[{}] {}", bar, line(fraction_done)).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace vibrosow
