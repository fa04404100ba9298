#include <fmt/format.h>

#include "grains/packing.hpp"
#include "scene/input_error.hpp"
#include "simulation/force_field.hpp"
#include "simulation/state.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

Grains packed_grains(const Model& model, std::uint64_t random_seed, StopRequest stop) {
  Random random(random_seed);
  Grains grains = no_grains(model);
  for (const Vessel& vessel : model.vessels) {
    const VesselPath path(vessel);
    const PoseRate rate = model.scene.run.start == Start::with_tray ? path.rate(0) : PoseRate{};
    const Pose pose = path.pose(0);
    for (const PackedGrain& packed : pack(vessel, model.scene.lots, model.scene.space, random, stop)) {
      const Eigen::Vector3d at = point_in_lab(vessel, pose, {packed.x, packed.y, packed.z});
      const std::size_t lot = static_cast<std::size_t>(packed.lot);
      const GrainKind kind = sized_kind(model.scene.lots[lot], *model.law, model.kinds[lot], packed.size);
      grains.add(at, point_velocity(vessel, pose, rate, at), packed.lot, kind, packed.turned);
    }
  }
  return grains;
}

/// Grains at rest may carry their bed's weight, no more.
void refuse_overlap(const Model& model, SimulationState state, StopRequest stop) {
  Execution execution(best_instruction_set(), 1, stop);
  ForceField field(model, state, {}, execution);
  field.evaluate(0, {});
  if (state.statistics.max_relative_overlap <= model.scene.guard.warn_relative_overlap) return;
  const Scene& scene = model.scene;
  const Fill fill = scene.hopper && scene.hopper->fill ? *scene.hopper->fill : scene.tray.fill.value_or(Fill{});
  throw InputError(
      fmt::format("{}: grains overlap at the start, by {:.3g} of the radius; does the "
                  "hopper stand in the tray's bed? (hopper.above, fill.count)",
                  fill.where.or_key("fill.count"), state.statistics.max_relative_overlap));
}

FeederState first_draws(const Model& model, std::uint64_t random_seed) {
  constexpr std::uint64_t apart = 0x9e3779b97f4a7c15;
  FeederState feeder{.random = Random(~random_seed), .showers = {}, .warning = {}};  // streams apart from the packing's
  for (std::size_t vessel = 0; vessel < model.vessels.size(); ++vessel)
    feeder.showers.push_back({Random(random_seed ^ (apart * (vessel + 1)))});
  return feeder;
}

}  // namespace

Grains no_grains(const Model& model) {
  Grains grains(model.kinds, model.effects.polydisperse, model.effects.rotation, model.effects.clumps);
  grains.in_space = model.scene.space == Space::three_dimensional;
  return grains;
}

SimulationState starting_state(const Model& model, std::uint64_t random_seed, Grains grains) {
  SimulationState state{.grains = std::move(grains), .feeder = first_draws(model, random_seed)};
  for (const Vessel& vessel : model.vessels) {
    state.vessels.motion.push_back(vessel.motion);
    state.vessels.shift.push_back(Eigen::Vector2d::Zero());
  }
  state.vessels.removed.resize(Walls(model.vessels, model.scene.space).count());
  state.vessels.closed_by_hand.resize(state.vessels.removed.size());
  state.counter.passages.resize(state.grains.size());
  state.counter.below.resize(state.grains.size());
  state.run.random_seed = random_seed;
  state.run.dt = model.step.dt;
  state.run.balance.put_in = static_cast<std::int64_t>(state.grains.size());
  return state;
}

SimulationState starting_state(const Model& model, std::uint64_t random_seed, StopRequest stop) {
  SimulationState state = starting_state(model, random_seed, packed_grains(model, random_seed, stop));
  refuse_overlap(model, state, stop);
  return state;
}

}  // namespace vibrosow
