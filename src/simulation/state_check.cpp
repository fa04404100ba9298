#include "simulation/state_check.hpp"

#include <algorithm>
#include <cmath>

#include "result/run_check.hpp"

namespace vibrosow {
namespace {

bool is_index(std::int64_t number, std::size_t count) {
  return number >= 0 && static_cast<std::size_t>(number) < count;
}

bool are_indices(const std::vector<int>& numbers, std::size_t count) {
  return std::ranges::all_of(numbers, [count](int number) { return is_index(number, count); });
}

bool are_finite(std::initializer_list<double> numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

/// As a grain of the model's own, so many times.
bool are_grains(const Model& model, const Grains& g) {
  Grains one = no_grains(model);
  one.add(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0, one.kinds.front());
  const std::size_t n = g.size();
  const auto like = [&](std::vector<double> Grains::*array) {
    const std::vector<double>& values = g.*array;
    return values.size() == (one.*array).size() * n &&
           std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
  };
  for (const auto array : {&Grains::x,
                           &Grains::y,
                           &Grains::z,
                           &Grains::vx,
                           &Grains::vy,
                           &Grains::vz,
                           &Grains::omega,
                           &Grains::omega_x,
                           &Grains::omega_y,
                           &Grains::angle,
                           &Grains::q_w,
                           &Grains::q_x,
                           &Grains::q_y,
                           &Grains::q_z,
                           &Grains::radius,
                           &Grains::mass,
                           &Grains::inverse_mass,
                           &Grains::inverse_inertia,
                           &Grains::lever_yield,
                           &Grains::compliance,
                           &Grains::curvature})
    if (!like(array)) return false;
  constexpr double farthest = 1e6;  // m, m/s
  for (const auto array : {&Grains::x, &Grains::y, &Grains::z, &Grains::vx, &Grains::vy, &Grains::vz})
    if (!std::ranges::all_of(g.*array, [](double value) { return std::abs(value) <= farthest; })) return false;
  const double least = 0.5 * model.smallest_radius, most = model.largest_diameter;
  return std::ranges::all_of(g.radius, [=](double radius) { return radius >= least && radius <= most; }) &&
         g.lot.size() == n && are_indices(g.lot, model.scene.lots.size()) && g.id.size() == n && is_ascending(g.id) &&
         (n == 0 || g.id.back() < g.next_id);
}

/// How many there are as the kernels see them: a clump's discs each on its own.
std::size_t bodies_of(const Model& model, const Grains& g) {
  if (!model.effects.clumps) return g.size();
  std::size_t bodies = 0;
  for (const int lot : g.lot)
    bodies += std::max<std::size_t>(1, model.scene.lots[static_cast<std::size_t>(lot)].discs.size());
  return bodies;
}

bool are_derivatives(const HigherDerivatives& higher, std::size_t n) {
  return std::ranges::all_of(higher, [n](const std::vector<double>& one) { return one.size() == n; });
}

/// What the scheme keeps, by grain.
bool is_kept(const Model& model, const SimulationState& state) {
  const Grains& g = state.grains;
  const IntegratorState& s = state.integrator;
  const std::size_t n = g.size(), turning = g.omega.size(), across = g.z.size(), about = g.omega_x.size();
  if (!state.started) return true;
  if (s.ax.size() != n || s.ay.size() != n || s.alpha.size() != turning) return false;
  if (s.az.size() != across || s.alpha_x.size() != about || s.alpha_y.size() != about) return false;
  if (model.scene.numerics.integrator != Integrator::gear5) return true;
  const std::size_t as_clumps = g.oriented && g.is_3d ? turning : 0;
  return are_derivatives(s.of_x, n) && are_derivatives(s.of_y, n) && are_derivatives(s.of_angle, turning) &&
         are_derivatives(s.of_z, across) && are_derivatives(s.of_angle_x, about) &&
         are_derivatives(s.of_angle_y, about) &&
         std::ranges::all_of(s.quaternion_rate, [=](const auto& rate) { return rate.size() == as_clumps; }) &&
         std::ranges::all_of(s.of_quaternion, [=](const auto& of) { return are_derivatives(of, as_clumps); });
}

/// Of so many candidates of a list.
bool are_histories(const ContactHistories& h, std::size_t candidates, bool is_3d) {
  if (candidates > 0 && h.kinds.any() && h.kinds.is_3d != is_3d) return false;
  ContactHistories like;
  like.resize(candidates, h.kinds);
  return h.slip.size() == like.slip.size() && h.roll.size() == like.roll.size() &&
         h.records.size() == like.records.size() && h.touched.size() == like.touched.size();
}

bool are_pairs(const PairList& pairs, std::size_t bodies) {
  return pairs.grain.size() == pairs.partner.size() && are_indices(pairs.grain, bodies) &&
         are_indices(pairs.partner, bodies);
}

bool are_contacts(const Model& model, const ContactState& c, std::size_t bodies, std::size_t walls) {
  const bool is_3d = model.scene.space == Space::three_dimensional;
  const auto is_candidate = [&](const WallCandidate& one) {
    return is_index(one.grain, bodies) && is_index(one.wall, walls) && std::isfinite(one.side);
  };
  constexpr std::size_t most_images = 4;  // of a tray that is periodic along and across
  const auto is_boundary = [&](const BoundaryContacts& one) {
    return are_pairs(one.pairs, bodies) && are_histories(one.histories, one.pairs.size(), is_3d);
  };
  return are_pairs(c.pairs, bodies) && are_histories(c.pair_histories, c.pairs.size(), is_3d) &&
         std::ranges::all_of(c.walls, is_candidate) && are_histories(c.wall_histories, c.walls.size(), is_3d) &&
         c.boundaries.size() <= most_images && std::ranges::all_of(c.boundaries, is_boundary);
}

bool is_course(double ramp, double stop, double stop_ramp) {
  return ramp >= 0 && std::isfinite(ramp) && stop >= 0 && stop_ramp >= 0 && std::isfinite(stop_ramp);
}

bool is_motion(const HarmonicMotion& m) {
  return are_finite({m.direction, m.amplitude, m.frequency, m.phase, m.across}) &&
         is_course(m.ramp, m.stop, m.stop_ramp);
}
bool is_motion(const SumMotion& m) {
  return std::ranges::all_of(m.components, [](const HarmonicMotion& one) { return is_motion(one); });
}
bool is_motion(const RockingMotion& m) {
  return m.pivot.allFinite() && are_finite({m.angle, m.frequency}) && is_course(m.ramp, m.stop, m.stop_ramp);
}
bool is_motion(const TurningMotion& m) {
  return m.pivot.allFinite() && are_finite({m.angular_velocity, m.phase}) && is_course(m.ramp, m.stop, m.stop_ramp) &&
         (m.axis == TurningAxis::across || m.axis == TurningAxis::upright);
}
bool is_motion(const TableMotion& m) {
  const std::size_t rows = m.times.size();
  return rows >= 4 && are_numbers(rows, {&m.times, &m.x, &m.y, &m.angle}) &&
         are_numbers(m.z.empty() ? 0 : rows, {&m.z}) &&
         std::ranges::adjacent_find(m.times, std::greater_equal{}) == m.times.end();
}

bool are_vessels(const VesselState& fresh, const VesselState& v) {
  const auto is_driven = [](const std::optional<VesselMotion>& motion) {
    return !motion || std::visit([](const auto& one) { return is_motion(one); }, *motion);
  };
  return v.motion.size() == fresh.motion.size() && v.shift.size() == fresh.shift.size() &&
         v.removed.size() == fresh.removed.size() && v.closed_by_hand.size() == fresh.closed_by_hand.size() &&
         std::ranges::all_of(v.motion, is_driven) &&
         std::ranges::all_of(v.shift, [](const Eigen::Vector2d& shift) { return shift.allFinite(); }) &&
         std::isfinite(v.placed_at);
}

bool is_counter(const CounterState& c, std::size_t grains, std::size_t holes) {
  return c.passages.size() == grains && c.below.size() == grains &&
         std::ranges::all_of(c.passages,
                             [holes](const auto& one) { return is_index(std::int64_t{one.hole} + 1, holes + 2); });
}

bool is_feeder(const FeederState& fresh, const FeederState& f, std::size_t lots) {
  const auto may_wait = [lots](const std::optional<DrawnSeed>& next) {
    return !next || (is_index(next->lot, lots) && next->size > 0 && next->size < 1e3);
  };
  return f.showers.size() == fresh.showers.size() && f.missing.size() == fresh.missing.size() &&
         std::ranges::all_of(f.missing, may_wait) &&
         std::ranges::all_of(f.showers, [&](const auto& one) { return one.arrived >= 0 && may_wait(one.next); });
}

/// Of the grains that are there every start is known.
bool is_recorder(const Model& model, const SimulationState& state) {
  const RecorderState& r = state.recorder;
  const Grains& g = state.grains;
  if (!model.scene.record) return true;
  const bool known = !state.started || g.size() == 0 || static_cast<std::size_t>(g.id.back()) < r.start.size();
  return known && r.taken <= model.scene.record->times.size() &&
         std::ranges::all_of(r.start, [](const Eigen::Vector3d& start) { return start.allFinite(); });
}

}  // namespace

bool is_possible(const Model& model, const SimulationState& fresh, const SimulationState& state) {
  if (!are_grains(model, state.grains)) return false;
  const Scene& scene = model.scene;
  const std::size_t grains = state.grains.size(), bodies = bodies_of(model, state.grains),
                    walls = fresh.vessels.removed.size();
  const bool in_time = state.step >= 0 && state.step <= model.step.steps &&
                       state.time == static_cast<double>(state.step) * model.step.dt;
  return in_time && is_kept(model, state) && are_contacts(model, state.contacts, bodies, walls) &&
         are_indices(state.statistics.crossed, grains) && are_vessels(fresh.vessels, state.vessels) &&
         is_counter(state.counter, grains, scene.tray.holes.size()) &&
         is_feeder(fresh.feeder, state.feeder, scene.lots.size()) && is_recorder(model, state) &&
         is_possible(state.run, {scene.lots.size(), scene.tray.holes.size(), scene.run.duration});
}

}  // namespace vibrosow
