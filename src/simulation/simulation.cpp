#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "grains/packing.hpp"
#include "scene/input_error.hpp"
#include "scene/seed_lot.hpp"
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

Simulation::Simulation(const Scene& scene, Grains grains, const SimulationSetup& setup)
    : scene_(scene),
      grains_(std::move(grains)),
      execution_(setup.instructions, setup.threads),
      field_(scene_, setup.effects, setup.margins, execution_),
      s_{.grains = grains_,
         .field = field_,
         .execution = execution_,
         .scheme = scene_.numerics.integrator,
         .dt = setup.dt,
         .gravity = setup.gravity,
         .drag = scene_.contact.drag,
         .fastest = longest_stride_in_radii * smallest_radius(scene_.lots) / setup.dt},
      advance_(step_function(scene_.numerics.integrator)),
      counter_(scene_, grains_.size()),
      feeder_(scene_, setup.random_seed),
      guard_(scene_, setup.insisted_on_step),
      steps_per_look_(steps_in(look_interval, setup.dt)),
      steps_per_removal_(steps_in(removal_interval, setup.dt)),
      steps_per_feed_(steps_in(feeding_interval, setup.dt)) {
  if (setup.profile) execution_.profile().start();
  run_.random_seed = setup.random_seed;
  run_.dt = setup.dt;
  run_.balance.put_in = static_cast<std::int64_t>(grains_.size());
  start_integration(s_);
  open_gates();
  guard_.watch_step(s_);
  guard_.watch_energy(s_, run_.energy);
  execution_.profile().lap(Phase::start);
  if (!scene_.record) return;
  recorder_.emplace(scene_);
  recorder_->note_new(grains_);
  recorder_->record(grains_, s_.time, run_.snapshots);
}

bool Simulation::step() {
  if (guard_.stop_reason() || !run_.end_reason.empty()) return false;
  if (s_.time >= next_gate_) open_gates();
  run_.grain_steps += static_cast<std::int64_t>(grains_.size());
  Profile& profile = execution_.profile();
  s_.too_fast = false;
  advance_(s_);
  profile.lap(Phase::integration);
  ++s_.step;
  s_.time = static_cast<double>(s_.step) * s_.dt;
  guard_.watch_step(s_);
  if (guard_.stop_reason()) return false;
  if (!s_.statistics.crossed.empty()) take_out();
  count();
  profile.lap(Phase::counters);
  if (s_.step % steps_per_removal_ == 0) take_out();
  if (s_.step % steps_per_look_ == 0) wrap(), note_whether_dry(), end_after_pause();
  const bool top_up = feeder_.feeds() && s_.step % steps_per_feed_ == 0;
  const bool rain = feeder_.rains() && s_.step % steps_per_look_ == 0;
  if (top_up || rain) feed(top_up, rain);
  if (s_.step % steps_per_energy_account == 0) guard_.watch_energy(s_, run_.energy);
  profile.lap(Phase::housekeeping);
  if (recorder_ && recorder_->is_due(s_.time)) recorder_->record(grains_, s_.time, run_.snapshots);
  profile.lap(Phase::recording);
  return !guard_.stop_reason() && run_.end_reason.empty();
}

void Simulation::steps(std::int64_t count) {
  for (std::int64_t k = 0; k < count && step(); ++k) {
  }
}

void Simulation::count() {
  const std::size_t before = run_.events.size();
  const std::int64_t lost_before = counter_.lost();
  counter_.watch(grains_, field_.walls(), execution_.loops(), s_.time, run_.events);
  if (counter_.lost() > lost_before) note_lost(counter_.lost() - lost_before);
  for (std::size_t k = before; k < run_.events.size(); ++k)
    ++(run_.events[k].hole > 0 ? run_.balance.counted : run_.balance.spilled);
}

void Simulation::note_lost(std::int64_t grains) {
  run_.balance.lost += grains;
  guard_.wall_crossed(static_cast<std::size_t>(grains), s_.time);
}

/// Takes out grains that went through a wall, and counted ones that touch nothing.
void Simulation::take_out() {
  std::vector<char> removed(grains_.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < grains_.size(); ++i) any |= (removed[i] = counter_.is_counted(i) ? 1 : 0) != 0;
  if (any) {
    const std::vector<char> touches = field_.touching(grains_);
    for (std::size_t i = 0; i < grains_.size(); ++i)
      if (touches[i]) removed[i] = 0;
  }
  std::int64_t lost = 0;
  for (int i : s_.statistics.crossed) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (!removed[k] && !counter_.is_counted(k)) removed[k] = 1, ++lost;
  }
  s_.statistics.crossed.clear();
  if (lost > 0) note_lost(lost);
  if (std::find(removed.begin(), removed.end(), 1) != removed.end()) take_out_flagged(removed);
}

/// Carries grains that are well beyond a side of a periodic tray over to the other side: by a diameter, so that none
/// goes to and fro.
void Simulation::wrap() {
  const double period = field_.neighbours().period();
  if (period == 0) return;
  const double left = scene_.tray.origin.x() + field_.walls().poses().front().displacement.x();
  double beyond = 0;
  for (const SeedLot& lot : scene_.lots) beyond = std::max(beyond, lot.diameter);
  bool any = false;
  for (double& x : grains_.x) {
    const double along = x - left;
    if (along >= -beyond && along <= period + beyond) continue;
    x += along < 0 ? period : -period;
    any = true;
  }
  if (!any) return;
  field_.neighbours().forget();
  field_.neighbours().update(grains_, field_.walls());
}

void Simulation::take_out_flagged(const std::vector<char>& removed) {
  const double elastic = field_.elastic_energy(grains_);
  for (std::size_t i = 0; i < grains_.size(); ++i)
    if (removed[i]) run_.energy.removed += mechanical_energy(grains_, i, s_.gravity);
  grains_.remove_flagged(removed);
  counter_.remove_flagged(removed);
  field_.remove_flagged(removed);
  remove_from_integration(s_, removed);
  run_.energy.removed += elastic - field_.elastic_energy(grains_);
}

/// Opens every gate whose time has come, and looks up when the next does. What was stored in the gates' contacts leaves
/// the account.
void Simulation::open_gates() {
  const Walls& walls = field_.walls();
  std::vector<std::size_t> opening;
  next_gate_ = never;
  for (std::size_t wall = 0; wall < walls.placed().size(); ++wall) {
    if (walls.opens_at(wall) == 0 || walls.is_removed(wall)) continue;
    if (s_.time >= walls.opens_at(wall))
      opening.push_back(wall);
    else
      next_gate_ = std::min(next_gate_, walls.opens_at(wall));
  }
  if (opening.empty()) return;
  const double elastic = field_.elastic_energy(grains_);
  for (const std::size_t wall : opening) field_.remove_wall(wall);
  start_integration(s_);
  run_.energy.removed += elastic - field_.elastic_energy(grains_);
}

void Simulation::feed(bool top_up, bool rain) {
  int added = 0;
  if (top_up) added += feeder_.top_up(grains_, field_.touching(grains_), field_.walls(), s_.time);
  if (rain) added += feeder_.rain(grains_, field_.walls(), s_.time);
  if (added == 0) return;
  run_.balance.put_in += added;
  for (std::size_t i = grains_.size() - static_cast<std::size_t>(added); i < grains_.size(); ++i) {
    run_.energy.inserted += mechanical_energy(grains_, i, s_.gravity);
    counter_.add_grain();
  }
  if (recorder_) recorder_->note_new(grains_);
  field_.grains_added();
  add_to_integration(s_);
}

void Simulation::note_whether_dry() {
  const Pose pose = field_.walls().poses().front();
  for (std::size_t i = 0; i < grains_.size(); ++i)
    if (!counter_.is_counted(i) && is_inside(scene_.tray, pose, grains_.x[i], grains_.y[i])) {
      run_.tray_empty_since = -1;
      return;
    }
  if (run_.tray_empty_since < 0) run_.tray_empty_since = s_.time;
}

void Simulation::end_after_pause() {
  if (!scene_.run.end_after_pause) return;
  double since = 0;
  for (const Hole& hole : scene_.tray.holes) since = std::max(since, hole.open_at);
  if (!run_.events.empty()) since = std::max(since, run_.events.back().time);  // to within a step the last
  if (s_.time - since < *scene_.run.end_after_pause) return;
  run_.end_reason =
      fmt::format("no grain left for {:g} s; {} are still inside", *scene_.run.end_after_pause, grains_.size());
}

Run Simulation::result() const {
  Run run = run_;
  if (guard_.stop_reason()) {
    run.status = RunStatus::stopped_by_guard;
    run.stop_reason = *guard_.stop_reason();
  }
  run.warnings = guard_.warnings();
  if (!feeder_.warning().empty()) run.warnings.push_back(feeder_.warning());
  run.outside_the_model = guard_.outside_the_model();
  run.steps = s_.step;
  run.end_time = s_.time;
  run.force_evaluations = s_.statistics.contacts;
  run.max_compression = guard_.max_compression();
  std::ranges::stable_sort(run.events, {}, &OutflowEvent::time);  // of one step they come in the order of the grains
  if (execution_.profile().is_on()) run.phase_times = execution_.profile().times();
  run.balance.inside = 0;
  for (std::size_t i = 0; i < grains_.size(); ++i)
    if (!counter_.is_counted(i)) ++run.balance.inside;
  return run;
}

Grains starting_grains(const Scene& scene, std::uint64_t random_seed, const EffectSet& effects) {
  Random random(random_seed);
  Grains grains(grain_kinds(scene, effects.rotation), effects.polydisperse, effects.rotation, effects.clumps);
  for (const Vessel& vessel : vessels_of(scene)) {
    const bool moves_along = scene.run.start == Start::with_tray;
    const PoseRate rate = moves_along ? vessel_velocity(vessel, 0) : PoseRate{};
    const Pose pose = vessel_pose(vessel, 0);
    for (const PackedGrain& packed : pack(vessel, scene.lots, random)) {
      const Eigen::Vector2d at = in_lab_frame(vessel, pose, {packed.x, packed.y});
      const Eigen::Vector2d velocity = material_velocity(vessel, pose, rate, at);
      const std::size_t lot = static_cast<std::size_t>(packed.lot);
      const GrainKind kind = sized_kind(scene.lots[lot], scene.contact.law, grains.kinds[lot], packed.size);
      grains.add(at.x(), at.y(), velocity.x(), velocity.y(), packed.lot, kind, packed.angle);
    }
  }
  return grains;
}

void refuse_overlapping_start(const Scene& scene, const Grains& grains) {
  EffectSet effects;
  effects.polydisperse = grains.polydisperse;
  effects.clumps = grains.oriented;
  effects.rotation = grains.rotation;
  Execution execution;
  ForceField field(scene, effects, {}, execution);
  ContactStatistics statistics;
  field.evaluate(grains, 0, {}, statistics);
  // Grains at rest may carry their bed's weight, no more.
  if (statistics.max_compression <= scene.guard.warn_compression) return;
  const Fill fill = scene.hopper && scene.hopper->fill ? *scene.hopper->fill : scene.tray.fill.value_or(Fill{});
  throw InputError(
      fmt::format("{}: grains overlap at the start, their shells compressed by {:.3g} of the radius; does the "
                  "hopper stand in the tray's bed? (hopper.above, fill.count)",
                  fill.where.or_key("fill.count"), statistics.max_compression));
}

}  // namespace vibrosow
