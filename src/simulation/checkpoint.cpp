#include "simulation/checkpoint.hpp"

#include <fmt/format.h>

#include <boost/crc.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/variant.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "result/archive.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"
#include "simulation/state_check.hpp"

// cereal finds these by the types' namespaces. Each lists every field of its type: what is missing here is lost.
namespace cereal {

template <class Archive>
void serialize(Archive& archive, Eigen::Vector2d& v) {
  archive(v.x(), v.y());
}
template <class Archive>
void serialize(Archive& archive, Eigen::Vector3d& v) {
  archive(v.x(), v.y(), v.z());
}
}  // namespace cereal

namespace vibrosow {

/// Whether a text is an engine's: its words, and how many of them are used up, which the library believes.
inline bool is_engine(const std::string& text) {
  constexpr std::size_t words = std::mt19937_64::state_size;
  std::istringstream in(text);
  std::uint64_t number = 0;
  std::size_t count = 0;
  while (count <= words && in >> number) ++count;
  return count == words + 1 && number <= words && in.eof();
}
template <class Archive>
void save(Archive& archive, const Random& random) {
  std::ostringstream text;
  text << random.engine();
  archive(text.str());
}
template <class Archive>
void load(Archive& archive, Random& random) {
  std::string text;
  archive(text);
  if (!is_engine(text)) throw cereal::Exception("no state of a random engine");
  std::istringstream(text) >> random.engine();
}
template <class Archive>
void serialize(Archive& archive, HarmonicMotion& m) {
  archive(m.direction, m.amplitude, m.frequency, m.ramp, m.phase, m.stop, m.stop_ramp, m.across);
}
template <class Archive>
void serialize(Archive& archive, SumMotion& m) {
  archive(m.components);
}
template <class Archive>
void serialize(Archive& archive, RockingMotion& m) {
  archive(m.pivot, m.angle, m.frequency, m.ramp, m.stop, m.stop_ramp);
}
template <class Archive>
void serialize(Archive& archive, TableMotion& m) {
  archive(m.times, m.x, m.y, m.angle, m.z);
}
template <class Archive>
void serialize(Archive& archive, TurningMotion& m) {
  archive(m.pivot, m.angular_velocity, m.axis, m.ramp, m.stop, m.stop_ramp, m.phase);
}
template <class Archive>
void serialize(Archive& archive, Grains& g) {  // kinds and flags are the model's
  archive(g.x, g.y, g.vx, g.vy, g.omega, g.angle, g.lot, g.id);
  archive(g.z, g.vz, g.omega_x, g.omega_y, g.q_w, g.q_x, g.q_y, g.q_z);
  archive(g.radius, g.mass, g.inverse_mass, g.inverse_inertia, g.compliance, g.curvature, g.lever_yield, g.next_id);
}
template <class Archive>
void serialize(Archive& archive, IntegratorState& s) {
  archive(s.ax, s.ay, s.alpha, s.of_x, s.of_y, s.of_angle, s.wall_power, s.wall_work, s.gross_wall_work);
  archive(s.az, s.alpha_x, s.alpha_y, s.of_z, s.of_angle_x, s.of_angle_y, s.quaternion_rate, s.of_quaternion);
}
template <class Archive>
void serialize(Archive& archive, PairList& list) {
  archive(list.grain, list.partner);
}
template <class Archive>
void serialize(Archive& archive, WallCandidate& candidate) {
  archive(candidate.grain, candidate.wall, candidate.side);
}
template <class Archive>
void serialize(Archive& archive, ContactHistories& h) {
  archive(h.kinds.slip, h.kinds.roll, h.kinds.is_3d, h.slip, h.roll, h.records, h.touched);
  if constexpr (Archive::is_loading::value) h.place_by_entry();
}
template <class Archive>
void serialize(Archive& archive, BoundaryContacts& b) {
  archive(b.pairs, b.histories);
}
template <class Archive>
void serialize(Archive& archive, ContactState& s) {
  archive(s.pairs, s.boundaries, s.walls, s.pair_histories, s.wall_histories);
}
template <class Archive>
void serialize(Archive& archive, ContactStatistics& s) {
  archive(s.contacts, s.slip_raised, s.max_relative_overlap, s.wall_power, s.crossed);
}
template <class Archive>
void serialize(Archive& archive, VesselState& s) {
  archive(s.motion, s.shift, s.removed, s.closed_by_hand, s.placed_at);
}
template <class Archive>
void serialize(Archive& archive, CounterState::Passage& p) {
  archive(p.counted, p.hole, p.x, p.z);
}
template <class Archive>
void serialize(Archive& archive, CounterState& s) {
  archive(s.passages, s.below);
}
template <class Archive>
void serialize(Archive& archive, Turn& t) {
  archive(t.angle, t.orientation.w, t.orientation.x, t.orientation.y, t.orientation.z);
}
template <class Archive>
void serialize(Archive& archive, DrawnSeed& s) {
  archive(s.lot, s.size, s.turned);
}
template <class Archive>
void serialize(Archive& archive, FeederState::Shower& s) {
  archive(s.random, s.arrived, s.withheld, s.most_waiting, s.most_waiting_at, s.next);
}
template <class Archive>
void serialize(Archive& archive, FeederState& s) {
  archive(s.random, s.missing, s.showers, s.warning);
}
template <class Archive>
void serialize(Archive& archive, GuardState& s) {
  archive(s.max_relative_overlap, s.let_pass.deep_steps, s.let_pass.strides, s.let_pass.energy_accounts);
  archive(s.deep_since, s.strides_since, s.energy_since, s.most_made, s.stop_reason);
  archive(s.has_energy, s.lowest, s.in_play, s.first_potential);
}
template <class Archive>
void serialize(Archive& archive, RecorderState& s) {
  archive(s.taken, s.start);
}
template <class Archive>
void serialize(Archive& archive, DrawnSeeds& d) {
  archive(d.vessel, d.lot, d.size, d.seeds, d.mass);
}
/// What a running simulation has put into its Run; the rest is filled in by `Simulation::result`.
template <class Archive>
void serialize(Archive& archive, Run& r) {
  archive(r.end_reason, r.random_seed, r.dt, r.grain_steps, r.tray_at_begin, r.tray_empty_since, r.energy, r.balance,
          r.events, r.snapshots, r.drawn);
}
template <class Archive>
void serialize(Archive& archive, SimulationState& s) {
  archive(s.time, s.step, s.started, s.grains, s.integrator, s.contacts, s.statistics, s.vessels, s.counter, s.feeder,
          s.guard, s.recorder, s.run);
}

namespace {

constexpr std::string_view signature = "vibrosow checkpoint\n";
/// To be raised whenever a state has other fields, or goes on differently.
constexpr std::uint32_t version = 9;

std::uint32_t checksum(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

[[noreturn]] void refuse(const std::string& reason) {
  throw InputError("the checkpoint does not fit: " + reason);
}

/// The first key in which two canonical scenes differ.
std::string first_difference(const std::string& saved, const std::string& wanted) {
  const nlohmann::json difference =
      nlohmann::json::diff(parse_json<nlohmann::json>(saved), parse_json<nlohmann::json>(wanted));
  return difference.empty() ? "/" : difference.front().at("path").get<std::string>();
}

struct Header {
  std::uint32_t version = 0, checksum = 0;
};

}  // namespace

std::string save(const Model& model, const SimulationState& state) {
  SimulationState saved = state;
  saved.contacts = without_idle_candidates(state.contacts);
  std::ostringstream body;
  {
    cereal::PortableBinaryOutputArchive archive(body);
    archive(scene_to_json(model.scene), model.step.dt, saved);
  }
  std::ostringstream all;
  all << signature;
  {
    cereal::PortableBinaryOutputArchive archive(all);
    archive(version, checksum(body.str()));
  }
  all << body.str();
  return all.str();
}

SimulationState restore(const Model& model, std::string_view bytes) {
  if (!bytes.starts_with(signature)) refuse("it is no checkpoint of Vibrosow");
  try {
    std::istringstream in(std::string(bytes.substr(signature.size())));
    Header header;
    {
      cereal::PortableBinaryInputArchive archive(in);
      archive(header.version, header.checksum);
    }
    if (header.version != version)
      refuse(fmt::format("it is of version {}, and this program reads {}", header.version, version));
    const auto body_at = static_cast<std::size_t>(in.tellg());
    if (checksum(bytes.substr(signature.size() + body_at)) != header.checksum) refuse("it is damaged");
    InputArchive archive(in);
    std::string scene;
    double dt = 0;
    archive(scene, dt);
    if (const std::string wanted = scene_to_json(model.scene); scene != wanted)
      refuse(fmt::format("it is of another scene, which differs in {}", first_difference(scene, wanted)));
    if (dt != model.step.dt) refuse(fmt::format("its step was {:g} s, and is now {:g} s", dt, model.step.dt));
    const SimulationState fresh = starting_state(model, 1, no_grains(model));
    SimulationState state = fresh;
    archive(state);
    if (!is_possible(model, fresh, state)) refuse("no run of its scene can be in such a state");
    return state;
  } catch (const cereal::Exception&) {
    refuse("it ends too early");
  } catch (const nlohmann::json::exception&) {  // of the scene
    refuse("it is damaged");
  }
}

}  // namespace vibrosow
