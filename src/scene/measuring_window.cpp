#include "scene/measuring_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/motion.hpp"

namespace vibrosow {
namespace {

constexpr double rounding = 1e-9;  // of periods

/// Whole periods in a time, s.
int whole_periods(double time, double period) {
  return static_cast<int>(std::floor(time / period + rounding));
}

/// The slowest period of what still moves at a time, s; 0: nothing does.
class SlowestPeriod {
 public:
  explicit SlowestPeriod(double time) : time_(time) {}

  double operator()(const HarmonicMotion& m) const { return m.amplitude != 0 ? of(m.frequency, m) : 0; }
  double operator()(const SumMotion& m) const {
    double slowest = 0;
    for (const HarmonicMotion& component : m.components) slowest = std::max(slowest, (*this)(component));
    return slowest;
  }
  double operator()(const RockingMotion& m) const { return m.angle != 0 ? of(m.frequency, m) : 0; }
  double operator()(const TurningMotion& m) const {
    return of(std::abs(m.angular_velocity) / (2 * std::numbers::pi), m);
  }
  double operator()(const TableMotion&) const { return 0; }

 private:
  template <class Motion>
  double of(double frequency, const Motion& motion) const {
    return frequency > 0 && time_ < motion.stop + motion.stop_ramp ? 1 / frequency : 0;
  }

  double time_;
};

bool is_table(const Vessel& vessel) {
  return vessel.motion && moves(*vessel.motion) && std::holds_alternative<TableMotion>(*vessel.motion);
}

}  // namespace

MeasuringWindow MeasuringWindow::until(double end) const {
  MeasuringWindow ended = *this;
  ended.to = std::min(to, end);
  if (drive == Drive::periodic) ended.periods = std::max(0, whole_periods(ended.length(), period));
  return ended;
}

MeasuringWindow measuring_window(const Scene& scene) {
  MeasuringWindow window{.from = scene.run.measure_from, .to = scene.run.duration};
  std::vector<const Vessel*> vessels = {&scene.tray};
  if (scene.hopper) vessels.push_back(&*scene.hopper);
  if (scene.tray.holes.empty()) return window;
  if (std::ranges::any_of(vessels, [](const Vessel* vessel) { return is_table(*vessel); })) {
    window.drive = MeasuringWindow::Drive::aperiodic;
    return window;
  }
  for (const Vessel* vessel : vessels)
    if (vessel->motion)
      window.period = std::max(window.period, std::visit(SlowestPeriod(window.from), *vessel->motion));
  if (window.period == 0) return window;
  window.drive = MeasuringWindow::Drive::periodic;
  window.periods = std::max(0, whole_periods(window.length(), window.period));
  const double from = window.to - window.periods * window.period;
  if (window.periods > 0 && from - window.from > rounding * window.period) window.from = from;
  return window;
}

namespace {

/// Of so many parts of such a length (s), up to the window's end.
std::vector<double> ends_of(const MeasuringWindow& window, int parts, double length) {
  std::vector<double> ends;
  for (int k = parts; k >= 0; --k) ends.push_back(window.to - k * length);
  return ends;
}

}  // namespace

std::vector<double> block_ends(const MeasuringWindow& window) {
  constexpr int fewest = 5, most = 6;
  if (window.empty()) return {};
  const int left_of_most = window.periods % most, left_of_fewest = window.periods % fewest;
  const int blocks = window.periods >= fewest && left_of_most <= left_of_fewest ? most : fewest;
  const int periods = window.periods / blocks;
  return ends_of(window, blocks, periods > 0 ? periods * window.period : window.length() / blocks);
}

std::vector<double> instability_ends(const MeasuringWindow& window) {
  constexpr int parts = 10;
  if (window.empty()) return {};
  if (window.drive != MeasuringWindow::Drive::periodic) return ends_of(window, parts, window.length() / parts);
  if (window.periods < 2) return {};
  const int periods = std::max(1, (window.periods + parts / 2) / parts);
  return ends_of(window, window.periods / periods, periods * window.period);
}

}  // namespace vibrosow
