#include "simulation/live_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/input_error.hpp"
#include "simulation/seed_places.hpp"
#include "vessel/vessel_walls.hpp"

namespace vibrosow {
namespace {

constexpr double most_shakes = 10;  // that a hole waits for seeds to go out of its way

constexpr double most_of_stop = 0.5;   // of the guard's limit, that an overlap may be predicted to reach
constexpr double least_travel = 0.02;  // of the smallest radius, that a hole moves at a stroke's end

const HarmonicMotion* harmonic(const Vessel& vessel) {
  return vessel.motion ? std::get_if<HarmonicMotion>(&*vessel.motion) : nullptr;
}

bool may_follow(const HarmonicMotion* before, const HarmonicMotion* after) {
  return before && after && before->stop == never && after->stop == never && before->ramp == after->ramp &&
         before->across == after->across && before->frequency > 0 && after->frequency > 0;
}

/// The vessel with another's motion, and its holes where the other's are.
Vessel moved_as(Vessel vessel, const Vessel& other) {
  vessel.motion = other.motion;
  for (std::size_t k = 0; k < vessel.holes.size(); ++k)
    vessel.holes[k].centre = other.holes[k].centre, vessel.holes[k].width = other.holes[k].width;
  return vessel;
}

double left_edge(const Hole& hole) {
  return hole.centre - 0.5 * hole.width;
}
double right_edge(const Hole& hole) {
  return hole.centre + 0.5 * hole.width;
}

/// `part` of the way from one hole to another.
Hole on_the_way(Hole hole, const Hole& to, double part) {
  if (part == 1) return to;
  hole.centre += part * (to.centre - hole.centre), hole.width += part * (to.width - hole.width);
  return hole;
}

/// How far an edge goes, m.
double travel(const Hole& hole, const Hole& to) {
  return std::max(std::abs(left_edge(to) - left_edge(hole)), std::abs(right_edge(to) - right_edge(hole)));
}

/// Whether there is floor between hole `k` and those beside it.
bool is_apart(const std::vector<Hole>& holes, std::size_t k) {
  return (k == 0 || right_edge(holes[k - 1]) < left_edge(holes[k])) &&
         (k + 1 == holes.size() || right_edge(holes[k]) < left_edge(holes[k + 1]));
}

bool has_walls_of(const Vessel& vessel, const Vessel& other) {
  return std::ranges::equal(vessel_walls(vessel), vessel_walls(other), {}, &WallSegment::name, &WallSegment::name);
}

/// What differs beside the seeds' stiffness.
std::optional<Obstacle> obstacle_between(const Scene& runs, const Scene& wanted) {
  if (wanted.space != runs.space || runs.space != Space::two_dimensional || runs.run.end_after_pause)
    return Obstacle::plan;
  if (runs.lots != wanted.lots || runs.contact != wanted.contact) return Obstacle::seeds;
  if (runs.numerics != wanted.numerics || runs.numerics.integrator == Integrator::gear5) return Obstacle::accuracy;
  if (runs.tray.holes.size() != wanted.tray.holes.size()) return Obstacle::holes;
  if (moved_as(wanted.tray, runs.tray) != runs.tray || wanted.hopper != runs.hopper) return Obstacle::vessels;
  if (!may_follow(harmonic(runs.tray), harmonic(wanted.tray))) return Obstacle::motion;
  if (!has_walls_of(wanted.tray, runs.tray)) return Obstacle::holes;
  Scene rest = wanted;
  rest.tray = runs.tray;
  return rest == runs ? std::nullopt : std::optional(Obstacle::plan);
}

/// A run has the step that is planned, or one up to a tenth shorter that it had; else one of which a whole number has
/// passed.
double step_from(double time, double had, double planned) {
  if (had <= planned && had >= 0.9 * planned) return had;
  constexpr double rounding = 1e-12;
  return time > 0 ? time / std::ceil(time / planned * (1 + rounding)) : planned;
}

/// The walls of a run as they are driven now, were its tray this one.
class WallsNow {
 public:
  WallsNow(const Simulation& running, const Vessel& tray)
      : walls_(vessels_with(running, tray), running.model().scene.space) {
    const VesselState& state = running.state().vessels;
    for (std::size_t v = 0; v < state.motion.size(); ++v) walls_.set_motion(v, state.motion[v], state.shift[v]);
    for (std::size_t wall = 0; wall < state.removed.size(); ++wall)
      if (state.removed[wall]) walls_.remove(wall);
    walls_.place(running.time());
  }
  const Walls& operator*() const { return walls_; }

 private:
  static std::vector<Vessel> vessels_with(const Simulation& running, const Vessel& tray) {
    std::vector<Vessel> vessels = running.model().vessels;
    vessels.front() = tray;
    return vessels;
  }

  Walls walls_;
};

/// The tray's walls that are not where they are in another, which has walls of the same names.
std::vector<std::size_t> moved_walls(const Vessel& tray, const Vessel& other) {
  const std::vector<WallSegment> now = vessel_walls(tray), then = vessel_walls(other);
  std::vector<std::size_t> moved;
  for (std::size_t wall = 0; wall < now.size(); ++wall)
    if (now[wall].a != then[wall].a || now[wall].b != then[wall].b) moved.push_back(wall);
  return moved;
}

/// The tray with hole `k` as far on its way to another as there is room; none: it stays.
std::optional<Vessel> with_hole_nearer(const Simulation& running, const Vessel& tray, std::size_t k, const Hole& to) {
  const double least = std::max(least_travel, running.model().scene.guard.warn_relative_overlap) *
                       running.model().smallest_radius / travel(tray.holes[k], to);
  for (double part = 1; part == 1 || part >= least; part *= 0.5) {
    Vessel tried = tray;
    tried.holes[k] = on_the_way(tray.holes[k], to, part);
    if (is_apart(tried.holes, k) && has_walls_of(tried, tray) && has_room(running, tried)) return tried;
  }
  return std::nullopt;
}

/// Of the run so far no more than what has been drawn for its fills.
Run counted_anew(const Simulation& running, double dt) {
  const SimulationState& state = running.state();
  Run run;
  run.random_seed = state.run.random_seed;
  run.dt = dt;
  run.drawn = state.run.drawn;
  run.balance.put_in = std::ranges::count(state.counter.passages, false, &CounterState::Passage::counted);
  return run;
}

}  // namespace

std::string_view name_of(Obstacle obstacle) {
  switch (obstacle) {
    case Obstacle::seeds:
      return "seeds";
    case Obstacle::accuracy:
      return "accuracy";
    case Obstacle::holes:
      return "holes";
    case Obstacle::vessels:
      return "vessels";
    case Obstacle::motion:
      return "motion";
    case Obstacle::stiffness:
      return "stiffness";
    case Obstacle::plan:
      return "plan";
  }
  return "";
}

SimulationState carried_over(const Simulation& running, const Model& model) {
  SimulationState state = running.state();
  const double dt = model.step.dt;
  if (dt != running.model().step.dt) {
    state.step = std::llround(state.time / dt);
    state.time = static_cast<double>(state.step) * dt;
  }
  state.run = counted_anew(running, dt);
  state.statistics.contacts = state.statistics.slip_raised = 0;
  state.integrator.wall_work = state.integrator.gross_wall_work = 0;
  state.guard = {};
  state.feeder.warning.clear();
  return state;
}

bool has_room(const Simulation& running, const Vessel& tray) {
  const Model& model = running.model();
  const Grains& grains = running.grains();
  const WallsNow before(running, model.scene.tray), after(running, tray);
  const SeedPlaces places(model);
  const std::vector<std::size_t> moved = moved_walls(tray, model.scene.tray);
  const auto may_touch = [&](std::size_t i) {
    const double radius = grains.kind(i).radius;
    return std::ranges::any_of(
        moved, [&](std::size_t wall) { return (*after).distance2(wall, grains.place(i)) < radius * radius; });
  };
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (!may_touch(i)) continue;
    const double depth = places.relative_depth_in_walls(grains, i, *after);
    if (depth > model.scene.guard.warn_relative_overlap && depth > places.relative_depth_in_walls(grains, i, *before))
      return false;
  }
  return true;
}

LiveRun::LiveRun(Scene scene, std::uint64_t random_seed) : scene_(std::move(scene)), wanted_(scene_) {
  const Model model = prepare_to_run(scene_);
  numerics_ = model.scene.numerics;
  planned_step_ = model.step.dt;
  simulation_.emplace(model, random_seed);
}

std::optional<Obstacle> LiveRun::change(const Scene& wanted) {
  if (const auto obstacle = obstacle_between(scene_, wanted)) return obstacle;
  try {
    if (is_too_soft_for(wanted.tray)) return Obstacle::stiffness;
  } catch (const InputError&) {
    return Obstacle::plan;
  }
  wanted_ = wanted;
  waiting_ = lacking();
  wait_until_given_up();
  return std::nullopt;
}

void LiveRun::wait_until_given_up() {
  latest_ = simulation_->time() + most_shakes / harmonic(scene_.tray)->frequency;
}

bool LiveRun::step() {
  if (is_waiting()) take_up();
  return simulation_->step();
}

/// Whether seeds as soft as they run would come too near to the guard's stop. A level is another one's then; seeds that
/// are as written stay so.
bool LiveRun::is_too_soft_for(const Vessel& tray) const {
  Scene scene = simulation_->model().scene;
  scene.tray = tray;
  scene.numerics = numerics_;
  const PredictedOverlap predicted = prepare_to_run(scene).overlap;
  return scene_.numerics.accuracy != AccuracyLevel::as_written &&
         std::max(predicted.overlap_at_rest, predicted.overlap_at_impact) >
             most_of_stop * scene.guard.stop_relative_overlap;
}

LiveRun::Waiting LiveRun::lacking() const {
  if (wanted_.tray.motion != scene_.tray.motion) return Waiting::for_motion;
  return wanted_.tray.holes != scene_.tray.holes ? Waiting::for_holes : Waiting::for_nothing;
}

void LiveRun::take_up() {
  const bool motion = wanted_.tray.motion != scene_.tray.motion && simulation_->time() >= changing_until_;
  const bool holes = wanted_.tray.holes != scene_.tray.holes && is_at_stroke_end();
  if (motion) take_up_motion();
  if (holes) take_up_holes();
  waiting_ = lacking();
  if (waiting_ == Waiting::for_holes && simulation_->time() > latest_) waiting_ = Waiting::given_up;
}

void LiveRun::take_up_motion() {
  Vessel tray = simulation_->model().scene.tray;
  const MotionChange change = change_motion(*harmonic(tray), *harmonic(wanted_.tray), simulation_->time());
  tray.motion = change.after;
  scene_.tray.motion = wanted_.tray.motion;
  changing_until_ = change.until;
  go_on(tray, change.course);
}

/// Whether the tray has turned round in the last step, or rests.
bool LiveRun::is_at_stroke_end() const {
  const Walls& walls = simulation_->field().walls();
  const double now = simulation_->time(), before = now - simulation_->model().step.dt;
  return walls.rate(0, now).velocity.dot(walls.rate(0, before).velocity) <= 0;
}

/// Each as far as its new floor is free.
void LiveRun::take_up_holes() {
  const Vessel& running = simulation_->model().scene.tray;
  Vessel tray = running;
  for (std::size_t k = 0; k < tray.holes.size(); ++k)
    if (tray.holes[k] != wanted_.tray.holes[k])
      tray = with_hole_nearer(*simulation_, tray, k, wanted_.tray.holes[k]).value_or(tray);
  if (tray == running) return;
  wait_until_given_up();
  scene_.tray.holes = tray.holes;
  go_on(tray, simulation_->state().vessels.motion.front());
}

/// In the vessels that the tray makes from now on; `course`: how it is driven.
void LiveRun::go_on(const Vessel& tray, const std::optional<VesselMotion>& course) {
  const Simulation& now = *simulation_;
  const double time = now.time();
  Scene scene = now.model().scene;
  scene.tray = tray;
  scene.numerics = numerics_;
  scene.run.measure_from = time + scene_.run.measure_from;
  scene.run.duration = time + scene_.run.duration;
  Model model = prepare_to_run(scene);
  const double planned = model.step.dt;
  scene.numerics.dt = step_from(time, now.model().step.dt, std::min(planned, planned_step_));
  if (*scene.numerics.dt != planned) model = prepare_to_run(scene);
  planned_step_ = planned;
  SimulationState state = carried_over(now, model);
  state.vessels.motion.front() = course;
  simulation_.emplace(std::move(model), std::move(state));
  since_ = simulation_->time();
  ++changes_;
}

}  // namespace vibrosow
