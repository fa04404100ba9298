#include <fmt/format.h>

#include "grains/packing.hpp"
#include "grains/turned_discs.hpp"
#include "scene/input_error.hpp"
#include "simulation/force_field.hpp"
#include "simulation/seed_places.hpp"
#include "simulation/state.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

/// Rows hold clumps by the circles about them, turned at random, which is as good in the lab's frame.
Turn turn_in_lab_of(const PackedGrain& packed, const Vessel& vessel, const Pose& pose) {
  return vessel.fill->packing == Packing::poured ? turn_in_lab(vessel, pose, packed.turned) : packed.turned;
}

/// All fills, and how many grains each of the vessels got.
struct PackedGrains {
  Grains grains;
  std::vector<std::size_t> counts;
  std::vector<DrawnSeeds> drawn;
};

PackedGrains packed_grains(const Model& model, std::uint64_t random_seed, StopRequest stop) {
  Random random(random_seed);
  PackedGrains all{no_grains(model), {}, {}};
  for (const Vessel& vessel : model.vessels) {
    const VesselPath path(vessel);
    const PoseRate rate = model.scene.run.start == Start::with_tray ? path.rate(0) : PoseRate{};
    const Pose pose = path.pose(0);
    const std::vector<PackedGrain> fill = pack(vessel, model.scene.lots, model.scene.space, random, stop);
    for (const PackedGrain& packed : fill) {
      const Eigen::Vector3d at = point_in_lab(vessel, pose, {packed.x, packed.y, packed.z});
      const std::size_t lot = static_cast<std::size_t>(packed.lot);
      const GrainKind kind = sized_kind(model.scene.lots[lot], *model.law, model.kinds[lot], packed.size);
      count_drawn(all.drawn, model.scene.lots, all.counts.size(), lot, packed.size, kind.mass);
      all.grains.add(at, point_velocity(vessel, pose, rate, at), packed.lot, kind,
                     turn_in_lab_of(packed, vessel, pose));
    }
    all.counts.push_back(fill.size());
  }
  return all;
}

/// Of a fill that was just put in.
class FillCheck {
 public:
  FillCheck(const Model& model, const std::vector<std::size_t>& counts) : model_(model) {
    for (std::size_t v = 0; v < counts.size(); ++v) vessel_of_.insert(vessel_of_.end(), counts[v], v);
  }

  /// What is wrong with how the program placed a grain. Throws InputError where two vessels' fills, or one's fill and
  /// the other's walls, are in each other's way: so they were asked for.
  std::optional<std::string> fault(const SimulationState& state, StopRequest stop) const {
    const Grains& grains = state.grains;
    Walls walls(model_.vessels, model_.scene.space);
    const SeedPlaces places(model_);
    const std::optional<DeepestContact> deepest = deepest_contact(state, stop);
    if (deepest && deepest->relative_overlap > most_placing_overlap) {
      const std::size_t grain = static_cast<std::size_t>(deepest->grain);
      if (is_between_vessels(*deepest, grains)) refuse(deepest->relative_overlap);
      return placing_fault(
          model_, grains, grain,
          fmt::format(
              "lies {:.3g} of its radius deep in {}", deepest->relative_overlap,
              deepest->partner < 0 ? std::string("a wall") : fmt::format("grain {}", grains.id[partner_of(*deepest)])));
    }
    for (std::size_t i = 0; i < grains.size(); ++i)
      if (const auto fault = places.fault_among_walls(grains, i, vessel_of_[i], walls))
        return placing_fault(model_, grains, i, *fault);
    return std::nullopt;
  }

 private:
  static std::size_t partner_of(const DeepestContact& contact) { return static_cast<std::size_t>(contact.partner); }

  /// Pairs are many: the lists of the forces find them.
  std::optional<DeepestContact> deepest_contact(SimulationState state, StopRequest stop) const {
    Execution execution(best_instruction_set(), 1, stop);
    ForceField field(model_, state, {}, execution);
    field.evaluate(0, {});
    if (state.statistics.max_relative_overlap == 0) return std::nullopt;
    return field.deepest_contact();
  }

  bool is_between_vessels(const DeepestContact& contact, const Grains& grains) const {
    const std::size_t grain = static_cast<std::size_t>(contact.grain);
    if (contact.partner >= 0) return vessel_of_[grain] != vessel_of_[partner_of(contact)];
    if (model_.vessels.size() == 1) return false;
    const Walls own({model_.vessels[vessel_of_[grain]]}, model_.scene.space);
    return SeedPlaces(model_).relative_depth_in_walls(grains, grain, own) <= most_placing_overlap;
  }

  [[noreturn]] void refuse(double overlap) const {
    const Scene& scene = model_.scene;
    const Fill fill = scene.hopper->fill.value_or(scene.tray.fill.value_or(Fill{}));
    throw InputError(
        fmt::format("{}: grains overlap at the start, by {:.3g} of the radius; does the "
                    "hopper stand in the tray's bed? (hopper.above, fill)",
                    fill.where.or_key("fill.count"), overlap));
  }

  const Model& model_;
  std::vector<std::size_t> vessel_of_;  // by grain
};

FeederState first_draws(const Model& model, std::uint64_t random_seed) {
  constexpr std::uint64_t apart = 0x9e3779b97f4a7c15;
  // Streams apart from the packing's.
  FeederState feeder{.random = Random(~random_seed), .missing = {}, .showers = {}, .warning = {}};
  feeder.missing.resize(model.vessels.size());
  for (std::size_t vessel = 0; vessel < model.vessels.size(); ++vessel)
    feeder.showers.push_back({Random(random_seed ^ (apart * (vessel + 1)))});
  return feeder;
}

}  // namespace

Grains no_grains(const Model& model) {
  Grains grains(model.kinds, model.effects.polydisperse, model.effects.rotation, model.effects.clumps);
  grains.is_3d = model.scene.space == Space::three_dimensional;
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
  PackedGrains packed = packed_grains(model, random_seed, stop);
  SimulationState state = starting_state(model, random_seed, std::move(packed.grains));
  state.run.drawn = std::move(packed.drawn);
  state.guard.stop_reason = FillCheck(model, packed.counts).fault(state, stop);
  return state;
}

}  // namespace vibrosow
