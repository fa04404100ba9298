#include "simulation/checkpoint.hpp"

#include <fmt/format.h>

#include <boost/crc.hpp>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/input_error.hpp"
#include "scene/scene_json.hpp"

namespace vibrosow {
/// What a checkpoint's fields are read from.
struct BodyArchive : cereal::PortableBinaryInputArchive {
  explicit BodyArchive(std::istringstream& in) : PortableBinaryInputArchive(in), stream(in) {}
  std::istringstream& stream;
};
}  // namespace vibrosow

// cereal finds these by the types' namespaces. Each lists every field of its type: what is missing here is lost.
namespace cereal {

/// How many elements follow; never more than there are bytes left, so that a damaged size asks for no memory.
inline std::size_t load_size(PortableBinaryInputArchive& archive, std::size_t bytes_of_one) {
  size_type size = 0;
  archive(make_size_tag(size));
  const std::streamsize left = static_cast<vibrosow::BodyArchive&>(archive).stream.rdbuf()->in_avail();
  if (left < 0 || size > static_cast<size_type>(left) / bytes_of_one) throw Exception("a size beyond the end");
  return static_cast<std::size_t>(size);
}

// In the place of cereal's own, which believe any size.
template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> load(PortableBinaryInputArchive& archive, std::vector<T>& values) {
  values.resize(load_size(archive, sizeof(T)));
  archive(binary_data(values.data(), values.size() * sizeof(T)));
}
template <class T>
std::enable_if_t<!std::is_arithmetic_v<T>> load(PortableBinaryInputArchive& archive, std::vector<T>& values) {
  values.resize(load_size(archive, 1));
  for (T& value : values) archive(value);
}
inline void load(PortableBinaryInputArchive& archive, std::string& text) {
  text.resize(load_size(archive, 1));
  archive(binary_data(text.data(), text.size()));
}

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
  archive(g.radius, g.mass, g.inverse_mass, g.inverse_inertia, g.compliance, g.curvature, g.next_id);
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
  archive(h.kinds.slip, h.kinds.roll, h.kinds.in_space, h.slip, h.slip_speed, h.roll, h.roll_speed, h.records,
          h.touched);
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
void serialize(Archive& archive, FeederState::Shower& s) {
  archive(s.random, s.arrived, s.next_lot, s.next_size, s.next_turn);
}
template <class Archive>
void serialize(Archive& archive, FeederState& s) {
  archive(s.random, s.showers, s.warning);
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
void serialize(Archive& archive, OutflowEvent& e) {
  archive(e.time, e.hole, e.lot, e.grain, e.mass, e.x, e.speed, e.z);
}
template <class Archive>
void serialize(Archive& archive, Snapshot& s) {
  archive(s.time, s.tray_x, s.tray_y, s.tray_angle, s.tray_vx, s.tray_vy, s.tray_spin, s.x, s.y, s.vx, s.vy, s.omega,
          s.angle, s.lot, s.id, s.radius, s.mass, s.area, s.start_x, s.start_y);
  archive(s.tray_z, s.tray_vz, s.z, s.vz, s.omega_x, s.omega_y, s.q_w, s.q_x, s.q_y, s.q_z, s.start_z, s.volume);
}
template <class Archive>
void serialize(Archive& archive, EnergyAccount& e) {
  archive(e.kinetic, e.potential, e.elastic, e.wall_work, e.inserted, e.removed, e.made_by_numerics);
}
template <class Archive>
void serialize(Archive& archive, Balance& b) {
  archive(b.put_in, b.inside, b.counted, b.spilled, b.lost);
}
/// What a running simulation has put into its Run; the rest is filled in by `Simulation::result`.
template <class Archive>
void serialize(Archive& archive, Run& r) {
  archive(r.end_reason, r.random_seed, r.dt, r.grain_steps, r.tray_empty_since, r.energy, r.balance, r.events,
          r.snapshots);
}
template <class Archive>
void serialize(Archive& archive, SimulationState& s) {
  archive(s.time, s.step, s.started, s.grains, s.integrator, s.contacts, s.statistics, s.vessels, s.counter, s.feeder,
          s.guard, s.recorder, s.run);
}

namespace {

constexpr std::string_view signature = "vibrosow checkpoint\n";
/// To be raised whenever a state has other fields, or goes on differently.
constexpr std::uint32_t version = 7;

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
  const nlohmann::json difference = nlohmann::json::diff(nlohmann::json::parse(saved), nlohmann::json::parse(wanted));
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
    BodyArchive archive(in);
    std::string scene;
    double dt = 0;
    archive(scene, dt);
    if (const std::string wanted = scene_to_json(model.scene); scene != wanted)
      refuse(fmt::format("it is of another scene, which differs in {}", first_difference(scene, wanted)));
    if (dt != model.step.dt) refuse(fmt::format("its step was {:g} s, and is now {:g} s", dt, model.step.dt));
    SimulationState state = starting_state(model, 1, no_grains(model));
    archive(state);
    return state;
  } catch (const cereal::Exception&) {
    refuse("it ends too early");
  }
}

}  // namespace vibrosow
