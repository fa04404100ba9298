#include "vibrosow/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "library/convert.hpp"
#include "plan/model.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow::api {

struct Simulation::Inside {
  Inside(const Model& model, std::uint64_t random_seed, int threads)
      : simulation(model, random_seed, with_threads(threads)) {}
  Inside(const Model& model, SimulationState state, int threads)
      : simulation(model, std::move(state), with_threads(threads)) {}

  static ComputeOptions with_threads(int threads) {
    ComputeOptions options;
    options.threads = threads;
    return options;
  }

  vibrosow::Simulation simulation;
};

Simulation::Simulation(const Scene& scene, std::uint64_t random_seed, int threads)
    : inside_(std::make_unique<Inside>(prepare_to_run(scene.value()), random_seed, threads)) {}
Simulation::Simulation(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

double Simulation::time() const {
  return inside_->simulation.time();
}

Status Simulation::advance_to(double time) {
  const bool goes_on = inside_->simulation.run_until(time) && !inside_->simulation.at_end();
  return goes_on ? Status::running : Status::finished;
}

std::vector<Event> Simulation::events_since(std::size_t first) const {
  std::vector<Event> events;
  for (const OutflowEvent& own : inside_->simulation.events_since(first))
    events.push_back({own.time, own.hole, own.lot, own.grain, own.mass, own.x, own.speed, own.z});
  return events;
}

std::vector<Grain> Simulation::grains() const {
  const Grains& own = inside_->simulation.grains();
  std::vector<Grain> grains;
  for (std::size_t i = 0; i < own.size(); ++i) {
    grains.push_back({own.id[i], own.lot[i], own.x[i], own.y[i], own.vx[i], own.vy[i], own.kind(i).radius});
    if (own.is_3d) grains.back().z = own.z[i], grains.back().vz = own.vz[i];
  }
  const auto add = [&](std::int64_t id, const GrainContact& contact, double sign) {
    const auto grain = std::ranges::lower_bound(grains, id, {}, &Grain::id);
    if (grain == grains.end() || grain->id != id) return;  // a wall
    const auto force = [&](std::size_t axis) {
      return sign * (contact.normal_force[axis] + contact.tangential_force[axis]);
    };
    grain->fx += force(0), grain->fy += force(1), grain->fz += force(2);
  };
  for (const GrainContact& contact : inside_->simulation.frame().contacts)
    add(contact.grain, contact, 1), add(contact.partner, contact, -1);
  return grains;
}

Evaluation Simulation::result() const {
  return converted(reduced(inside_->simulation.model().scene, inside_->simulation.result()));
}

void Simulation::set_motion(const Harmonic& motion) {
  for (const double value : {motion.amplitude, motion.frequency, motion.direction, motion.phase, motion.across})
    if (!std::isfinite(value)) throw std::invalid_argument("a motion of numbers that are not finite");
  if (motion.amplitude < 0 || motion.frequency < 0)
    throw std::invalid_argument("a motion of a negative amplitude or frequency");
  inside_->simulation.set_motion(0, HarmonicMotion{.direction = motion.direction,
                                                   .amplitude = motion.amplitude,
                                                   .frequency = motion.frequency,
                                                   .phase = motion.phase,
                                                   .across = motion.across});
}

void Simulation::open_gate(int hole) {
  inside_->simulation.open_gate("tray", hole);
}
bool Simulation::close_gate(int hole) {
  return inside_->simulation.close_gate("tray", hole);
}

std::string Simulation::save() const {
  return vibrosow::save(inside_->simulation.model(), inside_->simulation.state());
}

Simulation Simulation::restore(const Scene& scene, std::string_view bytes, int threads) {
  const Model model = prepare_to_run(scene.value());
  return Simulation(std::make_unique<Inside>(model, vibrosow::restore(model, bytes), threads));
}

}  // namespace vibrosow::api
