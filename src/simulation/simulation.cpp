#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "scene/measuring_window.hpp"
#include "scene/motion.hpp"
#include "vessel/hopper_images.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

constexpr double look_interval = 1e-3;     // s
constexpr double removal_interval = 5e-3;  // s
constexpr double feeding_interval = 5e-3;  // s
constexpr std::int64_t steps_per_energy_account = 100;

/// Housekeeping goes by simulated time alone, so that nothing about lists or clocks can change a result.
std::int64_t steps_in(double interval, double dt) {
  return std::max<std::int64_t>(1, std::llround(interval / dt));
}

}  // namespace

Simulation::Simulation(const Model& model, std::uint64_t random_seed, const ComputeOptions& options)
    : Simulation(model, starting_state(model, random_seed), options) {}

Simulation::Simulation(Model model, SimulationState state, const ComputeOptions& options)
    : model_(std::move(model)),
      state_(std::move(state)),
      execution_(options.instructions, options.threads, options.stop),
      field_(model_, state_, options.margins, execution_),
      s_{.model = model_,
         .state = state_,
         .field = field_,
         .execution = execution_,
         .grains = state_.grains,
         .kept = state_.integrator,
         .dt = model_.step.dt,
         .drag = model_.scene.contact.drag,
         .fastest = longest_stride_in_radii * model_.smallest_radius / model_.step.dt},
      advance_(step_function(model_.scene.numerics.integrator)),
      counter_(model_.scene, state_.counter),
      feeder_(model_, state_.feeder),
      guard_(model_, state_.guard),
      window_from_(measuring_window(model_.scene).from),
      steps_per_look_(steps_in(look_interval, model_.step.dt)),
      steps_per_removal_(steps_in(removal_interval, model_.step.dt)),
      steps_per_feed_(steps_in(feeding_interval, model_.step.dt)) {
  if (options.profile) execution_.profile().start();
  if (model_.scene.record) recorder_.emplace(model_.scene, state_.recorder);
  if (state_.started)
    find_next_gate();
  else
    begin();
  execution_.stop_no_more();
}

void Simulation::begin() {
  state_.started = true;
  start_integration(s_);
  open_due_gates();
  guard_.watch_step(s_);
  guard_.watch_energy(s_, state_.run.energy);
  if (window_from_ <= 0) state_.run.tray_at_begin = inside_tray();
  execution_.profile().lap(Phase::start);
  if (!recorder_) return;
  recorder_->note_new(state_.grains);
  record();
}

bool Simulation::step() {
  Run& run = state_.run;
  if (state_.guard.stop_reason || !run.end_reason.empty()) return false;
  if (state_.time >= next_gate_) open_due_gates();
  run.grain_steps += static_cast<std::int64_t>(state_.grains.size());
  Profile& profile = execution_.profile();
  s_.too_fast = false;
  advance_(s_);
  profile.lap(Phase::integration);
  ++state_.step;
  state_.time = static_cast<double>(state_.step) * s_.dt;
  guard_.watch_step(s_);
  if (state_.guard.stop_reason) return false;
  if (!state_.statistics.crossed.empty()) take_out();
  count();
  profile.lap(Phase::counters);
  const auto is_due = [this](std::int64_t every) { return state_.step % every == 0; };
  if (is_due(steps_per_removal_)) take_out();
  if (is_due(steps_per_look_)) wrap(), note_what_tray_holds(), end_after_pause();
  const bool top_up = feeder_.feeds() && is_due(steps_per_feed_), rain = feeder_.rains() && is_due(steps_per_look_);
  if (top_up || rain) feed(top_up, rain);
  if (is_due(steps_per_energy_account) || at_end()) guard_.watch_energy(s_, run.energy);
  profile.lap(Phase::housekeeping);
  if (state_.guard.stop_reason) return false;  // before anything of it is recorded
  if (recorder_ && recorder_->is_due(state_.time)) record();
  profile.lap(Phase::recording);
  for (std::size_t k = 0; k < watchers_.size(); ++k)  // a look may add watchers
    if (is_due(watchers_[k].every)) std::function(watchers_[k].look)(*this);
  return !state_.guard.stop_reason && run.end_reason.empty();
}

bool Simulation::run_until(double time) {
  while (state_.time < time && !at_end())
    if (!step()) return false;
  return true;
}

void Simulation::watch(double interval, std::function<void(Simulation&)> look) {
  watchers_.push_back({steps_in(interval, s_.dt), std::move(look)});
}

std::span<const OutflowEvent> Simulation::events_since(std::size_t first) const {
  const std::vector<OutflowEvent>& events = state_.run.events;
  return std::span(events).subspan(std::min(first, events.size()));
}

void Simulation::set_motion(std::size_t vessel, const std::optional<VesselMotion>& motion) {
  if (vessel > (model_.scene.hopper ? 1U : 0U)) throw std::invalid_argument("set_motion: there is no such vessel");
  const std::optional<VesselMotion>& old = state_.vessels.motion[vessel];
  if ((old && turns(*old)) || (motion && turns(*motion)))
    throw std::invalid_argument("set_motion: a motion that turns a vessel can neither begin nor end during a run");
  Scene driven = model_.scene;
  (vessel == 0 ? driven.tray : *driven.hopper).motion = motion;
  if (const auto fault = image_fault(driven)) throw std::invalid_argument("set_motion: " + fault->message);
  for (std::size_t v = vessel; v < (vessel == 0 ? 1 : model_.vessels.size()); ++v) {  // a hopper with its images
    const Eigen::Vector2d at = field_.walls().pose(v, state_.time).displacement;
    field_.set_motion(v, motion, Eigen::Vector2d::Zero());
    field_.set_motion(v, motion, at - field_.walls().pose(v, state_.time).displacement);
  }
}

/// The gate's walls, there or not.
std::vector<std::size_t> Simulation::gate_of(const std::string& vessel, int hole) const {
  std::vector<std::size_t> walls = field_.walls().named(fmt::format("{} gate {}", vessel, hole));
  if (walls.empty()) throw std::invalid_argument(fmt::format("hole {} of the {} has no gate", hole, vessel));
  return walls;
}

void Simulation::open_gate(const std::string& vessel, int hole) {
  const std::vector<std::size_t> walls = gate_of(vessel, hole);
  if (!field_.walls().is_removed(walls.front())) open_walls(walls);
}

/// Whether no grain is in a wall's way.
bool Simulation::is_free(std::size_t wall) const {
  const Grains& g = state_.grains;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double radius = g.kind(i).radius;
    if (field_.walls().distance2(wall, g.place(i)) < radius * radius) return false;
  }
  return true;
}

bool Simulation::close_gate(const std::string& vessel, int hole) {
  const std::vector<std::size_t> walls = gate_of(vessel, hole);
  if (!field_.walls().is_removed(walls.front())) return true;
  for (const std::size_t wall : walls) field_.restore_wall(wall);
  if (!std::ranges::all_of(walls, [this](std::size_t wall) { return is_free(wall); })) {
    for (const std::size_t wall : walls) field_.remove_wall(wall);
    return false;
  }
  for (const std::size_t wall : walls) state_.vessels.closed_by_hand[wall] = 1;
  start_integration(s_);
  return true;
}

void Simulation::steps(std::int64_t count) {
  for (std::int64_t k = 0; k < count && step(); ++k) {
  }
}

void Simulation::count() {
  const std::size_t before = state_.run.events.size();
  counter_.watch(state_.grains, field_.walls(), execution_.loops(), state_.time, state_.run.events);
  if (!counter_.lost_now().empty()) note_lost(counter_.lost_now());
  for (std::size_t k = before; k < state_.run.events.size(); ++k)
    ++(state_.run.events[k].hole > 0 ? state_.run.balance.counted : state_.run.balance.spilled);
}

void Simulation::note_lost(const std::vector<int>& grains) {
  state_.run.balance.lost += std::ssize(grains);
  guard_.watch_lost(s_, grains);
}

/// Takes out grains that went through a wall, and counted ones that touch nothing.
void Simulation::take_out() {
  std::vector<char> removed(state_.grains.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < state_.grains.size(); ++i) any |= (removed[i] = counter_.is_counted(i) ? 1 : 0) != 0;
  if (any) {
    const std::vector<char> touches = field_.touching();
    for (std::size_t i = 0; i < state_.grains.size(); ++i)
      if (touches[i]) removed[i] = 0;
  }
  std::vector<int> lost;
  for (int i : state_.statistics.crossed) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (!removed[k] && !counter_.is_counted(k)) removed[k] = 1, lost.push_back(i);
  }
  state_.statistics.crossed.clear();
  if (!lost.empty()) note_lost(lost);
  if (std::find(removed.begin(), removed.end(), 1) != removed.end()) take_out_flagged(removed);
}

namespace {

/// Carries what is more than `beyond` outside of [from, from + period] over to the other side; whether anything was.
bool carry_over(std::vector<double>& positions, double from, double period, double beyond) {
  bool any = false;
  for (double& x : positions) {
    const double along = x - from;
    if (along >= -beyond && along <= period + beyond) continue;
    x += along < 0 ? period : -period;
    any = true;
  }
  return any;
}

}  // namespace

/// Carries grains that are well beyond a side of a periodic tray over to the other side.
void Simulation::wrap() {
  if (field_.neighbours().images().empty()) return;
  const Vessel& tray = model_.scene.tray;
  const Pose& pose = field_.walls().poses().front();
  const double beyond = model_.carried_beyond;
  bool any = false;
  if (tray.sides == Sides::periodic)
    any |= carry_over(state_.grains.x, tray.origin.x() + pose.displacement.x(), tray.length, beyond);
  if (state_.grains.is_3d && tray.front_and_back == Sides::periodic)
    any |= carry_over(state_.grains.z, tray.front + pose.across, *tray.depth, beyond);
  if (any) field_.grains_wrapped();
}

void Simulation::take_out_flagged(const std::vector<char>& removed) {
  const double elastic = field_.elastic_energy();
  for (std::size_t i = 0; i < state_.grains.size(); ++i)
    if (removed[i]) state_.run.energy.removed += mechanical_energy(state_.grains, i, model_.gravity);
  state_.grains.remove_flagged(removed);
  counter_.remove_flagged(removed);
  field_.remove_flagged(removed);
  remove_from_integration(s_, removed);
  state_.run.energy.removed += elastic - field_.elastic_energy();
}

void Simulation::find_next_gate() {
  const Walls& walls = field_.walls();
  next_gate_ = never;
  for (std::size_t wall = 0; wall < walls.count(); ++wall)
    if (walls.opens_at(wall) > state_.time && !walls.is_removed(wall))
      next_gate_ = std::min(next_gate_, walls.opens_at(wall));
}

/// Opens every gate whose time has come, and looks up when the next does.
void Simulation::open_due_gates() {
  const Walls& walls = field_.walls();
  std::vector<std::size_t> opening;
  for (std::size_t wall = 0; wall < walls.count(); ++wall)
    if (walls.opens_at(wall) != 0 && state_.time >= walls.opens_at(wall) && !walls.is_removed(wall) &&
        !state_.vessels.closed_by_hand[wall])
      opening.push_back(wall);
  find_next_gate();
  if (!opening.empty()) open_walls(opening);
}

/// What was stored in their contacts leaves the account.
void Simulation::open_walls(const std::vector<std::size_t>& walls) {
  const double elastic = field_.elastic_energy();
  for (const std::size_t wall : walls) field_.remove_wall(wall), state_.vessels.closed_by_hand[wall] = 0;
  start_integration(s_);
  state_.run.energy.removed += elastic - field_.elastic_energy();
}

void Simulation::feed(bool top_up, bool rain) {
  int added = 0;
  field_.place_walls(state_.time);  // the last evaluation may have been for the middle of a step
  if (top_up) added += feeder_.top_up(state_.grains, field_.touching(), field_.walls(), state_.time);
  if (rain) added += feeder_.rain(state_.grains, field_.walls(), state_.time);
  if (feeder_.fault()) guard_.stop(*feeder_.fault());
  if (added == 0) return;
  state_.run.balance.put_in += added;
  for (std::size_t i = state_.grains.size() - static_cast<std::size_t>(added); i < state_.grains.size(); ++i) {
    state_.run.energy.inserted += mechanical_energy(state_.grains, i, model_.gravity);
    counter_.add_grain();
  }
  if (recorder_) recorder_->note_new(state_.grains);
  field_.grains_added();
  add_to_integration(s_);
}

bool Simulation::is_in_tray(std::size_t i) const {
  const Walls& walls = field_.walls();
  return !counter_.is_counted(i) && is_inside(model_.scene.tray, walls.poses().front(), state_.grains, i) &&
         feeder_.places().counts_in(state_.grains.place(i), 0, walls);
}

bool Simulation::is_in_hopper(std::size_t i) const {
  return feeder_.places().is_in_hopper(state_.grains.place(i), field_.walls());
}

std::int64_t Simulation::inside_tray(std::int64_t most) const {
  std::int64_t inside = 0;
  for (std::size_t i = 0; i < state_.grains.size() && inside < most; ++i) inside += is_in_tray(i) ? 1 : 0;
  return inside;
}

void Simulation::record() {
  std::vector<Snapshot>& snapshots = state_.run.snapshots;
  const std::size_t before = snapshots.size();
  recorder_->record(state_.grains, field_.walls(), state_.time, snapshots);
  for (std::size_t k = before; k < snapshots.size(); ++k)
    for (std::size_t i = 0; i < state_.grains.size(); ++i) snapshots[k].in_tray.push_back(is_in_tray(i) ? 1 : 0);
}

void Simulation::note_what_tray_holds() {
  double& empty_since = state_.run.tray_empty_since;
  empty_since = inside_tray(1) > 0 ? -1 : empty_since < 0 ? state_.time : empty_since;
  if (state_.run.tray_at_begin < 0 && state_.time >= window_from_) state_.run.tray_at_begin = inside_tray();
}

void Simulation::end_after_pause() {
  if (!model_.scene.run.end_after_pause) return;
  double since = 0;  // s, when all is open and under way
  for (const Vessel& vessel : model_.vessels) {
    for (const Hole& hole : vessel.holes) since = std::max(since, hole.open_at);
    if (vessel.rain) since = std::max(since, vessel.rain->start);
  }
  if (!state_.run.events.empty()) since = std::max(since, state_.run.events.back().time);  // to within a step the last
  if (state_.time - since < *model_.scene.run.end_after_pause) return;
  state_.run.end_reason = fmt::format("no grain left for {:g} s; {} are still inside",
                                      *model_.scene.run.end_after_pause, state_.grains.size());
}

Frame Simulation::frame() {
  return {snapshot_of(state_.grains, field_.walls(), state_.time), field_.contacts()};
}

Run Simulation::result() const {
  Run run = state_.run;
  if (guard_.stop_reason()) {
    run.status = RunStatus::stopped_by_guard;
    run.stop_reason = *guard_.stop_reason();
  }
  run.goes_on = run.status == RunStatus::finished && run.end_reason.empty() && !at_end();
  for (std::string& warning : guard_.warnings()) run.warnings.push_back({DoubtKind::guard_warned, std::move(warning)});
  for (std::string& warning : feeder_.warnings(state_.time))
    run.warnings.push_back({DoubtKind::feeder_behind, std::move(warning)});
  for (std::string& warning : drawn_warnings(model_.scene, run.drawn))
    run.warnings.push_back({DoubtKind::sizes_drawn, std::move(warning)});
  run.outside_the_model = guard_.outside_the_model() || run.balance.lost > 0;
  run.let_pass = state_.guard.let_pass;
  run.steps = state_.step;
  run.end_time = state_.time;
  run.force_evaluations = state_.statistics.contacts;
  run.slip_speed_raised = state_.statistics.slip_raised;
  run.max_relative_overlap = guard_.max_relative_overlap();
  std::ranges::stable_sort(run.events, {}, &OutflowEvent::time);  // of one step they come in the order of the grains
  if (execution_.profile().is_on()) run.phase_times = execution_.profile().times();
  run.balance.inside = 0;
  for (std::size_t i = 0; i < state_.grains.size(); ++i)
    if (!counter_.is_counted(i)) ++run.balance.inside;
  run.tray_at_end = inside_tray();
  return run;
}

}  // namespace vibrosow
