#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "result/run.hpp"

namespace vibrosow {

/// What a scene says about every run of it.
struct RunBounds {
  std::size_t lots = 0, holes = 0;
  double duration = 0;  // s
};

/// Whether every array has so many entries, and every number of them is one that a machine can be asked for.
inline bool are_numbers(std::size_t count, std::initializer_list<const std::vector<double>*> arrays) {
  constexpr double most = 1e9;
  return std::ranges::all_of(arrays, [&](const std::vector<double>* array) {
    return array->size() == count &&
           std::ranges::all_of(*array, [](double value) { return std::abs(value) <= most; });  // no NaN either
  });
}

inline bool is_ascending(const std::vector<std::int64_t>& ids) {
  return (ids.empty() || ids.front() >= 0) && std::ranges::adjacent_find(ids, std::greater_equal{}) == ids.end();
}

inline bool is_possible(const Snapshot& s, const RunBounds& of) {
  const std::size_t n = s.size(), balls = s.is_3d() ? n : 0, discs = n - balls;
  const bool lots = s.lot.size() == n && std::ranges::all_of(s.lot, [&](int lot) {
                      return lot >= 0 && static_cast<std::size_t>(lot) < of.lots;
                    });
  return lots && s.id.size() == n && is_ascending(s.id) && std::abs(s.time) <= 2 * of.duration &&
         are_numbers(n, {&s.x, &s.y, &s.vx, &s.vy, &s.omega, &s.radius, &s.mass, &s.start_x, &s.start_y}) &&
         are_numbers(balls, {&s.z, &s.vz, &s.omega_x, &s.omega_y, &s.start_z, &s.volume}) &&
         are_numbers(discs, {&s.area}) && are_numbers(s.angle.empty() ? 0 : n, {&s.angle}) &&
         are_numbers(s.q_w.empty() ? 0 : n, {&s.q_w, &s.q_x, &s.q_y, &s.q_z}) &&
         std::ranges::all_of(s.radius, [](double radius) { return radius > 0; });
}

/// Whether a run that was read may be one of such a scene: what stands for an index is one, what is counted is not
/// negative, and times lie within the run. A checksum tells damage, not who wrote the file.
inline bool is_possible(const Run& r, const RunBounds& of) {
  if (r.status < RunStatus::finished || r.status > RunStatus::refused) return false;
  constexpr double most_mass = 1e3;  // kg, of a seed
  const double latest = 2 * of.duration;
  const auto is_event = [&](const OutflowEvent& e) {
    return e.hole >= 0 && static_cast<std::size_t>(e.hole) <= of.holes && e.lot >= 0 &&
           static_cast<std::size_t>(e.lot) < of.lots && e.grain >= 0 && std::abs(e.time) <= latest && e.mass > 0 &&
           e.mass <= most_mass && e.speed >= 0 && std::isfinite(e.speed) && std::isfinite(e.x) && std::isfinite(e.z);
  };
  const Balance& b = r.balance;
  const std::initializer_list<std::int64_t> counts = {r.steps,
                                                      r.grain_steps,
                                                      r.force_evaluations,
                                                      r.slip_speed_raised,
                                                      r.let_pass.deep_steps,
                                                      r.let_pass.strides,
                                                      b.inside,
                                                      b.counted,
                                                      b.spilled,
                                                      b.lost,
                                                      b.put_in,
                                                      r.let_pass.energy_accounts};
  const bool tray = r.tray_at_begin >= -1 && r.tray_at_end >= 0;
  const bool times = r.end_time >= 0 && r.end_time <= latest && r.dt >= 0 && r.dt <= latest &&
                     r.tray_empty_since >= -1 && r.tray_empty_since <= latest;
  const auto is_kind = [](const Doubt& doubt) { return doubt.kind >= DoubtKind{} && doubt.kind <= last_doubt_kind; };
  return times && tray && r.max_relative_overlap >= 0 && std::ranges::all_of(r.warnings, is_kind) &&
         std::ranges::all_of(counts, [](std::int64_t count) { return count >= 0; }) &&
         std::ranges::all_of(r.events, is_event) &&
         std::ranges::all_of(r.drawn,
                             [](const DrawnSeeds& d) { return d.seeds >= 0 && d.mass >= 0 && d.mass <= 1e9; }) &&
         std::ranges::all_of(r.snapshots, [&](const Snapshot& s) { return is_possible(s, of); });
}

/// Whether each seed of a run that has ended is somewhere. Of one that goes on, those inside are not counted yet.
inline bool is_balanced(const Balance& b) {
  constexpr std::int64_t most = std::int64_t{1} << 60;  // their sum is no overflow
  const auto possible = [](std::int64_t count) { return count >= 0 && count <= most; };
  return possible(b.inside) && possible(b.counted) && possible(b.spilled) && possible(b.lost) &&
         b.put_in == b.inside + b.counted + b.spilled + b.lost;
}

}  // namespace vibrosow
