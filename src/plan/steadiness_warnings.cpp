#include "plan/steadiness_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "scene/measuring_window.hpp"
#include "scene/motion.hpp"

namespace vibrosow {
namespace {

/// Says of one vessel what begins or ends after rates are measured from.
class Changes {
 public:
  Changes(const Vessel& vessel, const MeasuringWindow& window) : vessel_(vessel), window_(window) {}

  std::vector<std::string> found() && {
    if (vessel_.motion && moves(*vessel_.motion)) std::visit(*this, *vessel_.motion);
    for (std::size_t k = 0; k < vessel_.holes.size(); ++k)
      if (is_later(vessel_.holes[k].open_at))
        add("holes.open_at", fmt::format("hole {} opens at {:.3g} s", k + 1, vessel_.holes[k].open_at),
            vessel_.holes[k].open_at);
    if (vessel_.rain && is_later(vessel_.rain->start))
      add("rain.start", fmt::format("it rains from {:.3g} s on", vessel_.rain->start), vessel_.rain->start);
    if (vessel_.rain && is_within(vessel_.rain->stop))
      add("rain.stop", fmt::format("it rains until {:.3g} s", vessel_.rain->stop), vessel_.rain->stop);
    return std::move(found_);
  }

  void operator()(const HarmonicMotion& m) {
    if (m.amplitude != 0) see(m);
  }
  void operator()(const SumMotion& m) {
    for (const HarmonicMotion& component : m.components)
      if (found_.empty()) (*this)(component);  // components mostly begin and end together
  }
  void operator()(const RockingMotion& m) { see(m); }
  void operator()(const TurningMotion& m) { see(m); }
  void operator()(const TableMotion& m) {
    if (is_within(m.times.front()) || m.times.front() >= window_.to)
      add("motion.file", fmt::format("the table of the motion begins at {:.3g} s", m.times.front()), m.times.front());
    if (m.times.back() < window_.to)
      add("motion.file", fmt::format("the table of the motion ends at {:.3g} s", m.times.back()), m.times.back());
  }

 private:
  bool is_later(double time) const {
    constexpr double rounding = 1e-9;  // s, of times that are added up
    return time > window_.from + rounding;
  }
  bool is_within(double time) const { return is_later(time) && time < window_.to; }

  template <class Motion>
  void see(const Motion& m) {
    if (is_later(m.ramp)) add("motion.ramp", fmt::format("the motion builds up until {:.3g} s", m.ramp), window_.from);
    if (m.stop < window_.to && is_later(m.stop + m.stop_ramp))
      add("motion.stop", fmt::format("the motion ends from {:.3g} s on", m.stop), window_.from);
  }

  /// At a time (s) before the window, after it, or in it, its ends included.
  void add(std::string_view key, const std::string& what, double at) {
    const std::string_view so = at < window_.from ? "after that"
                                : at > window_.to ? "before that"
                                                  : "they are means of two conditions";
    found_.push_back(fmt::format("{}.{}: {}, and rates are measured from {:.3g} to {:.3g} s: {}", vessel_.name, key,
                                 what, window_.from, window_.to, so));
  }

  const Vessel& vessel_;
  const MeasuringWindow& window_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> steadiness_warnings(const Scene& scene) {
  const MeasuringWindow window = measuring_window(scene);
  if (window.empty() || scene.tray.holes.empty()) return {};
  std::vector<std::string> warnings = Changes(scene.tray, window).found();
  if (scene.hopper)
    for (std::string& one : Changes(*scene.hopper, window).found()) warnings.push_back(std::move(one));
  return warnings;
}

}  // namespace vibrosow
