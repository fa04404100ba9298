#include "recording/recording.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "plan/predicted_grains.hpp"

namespace vibrosow {
namespace {

constexpr int frames_per_block = 250;
constexpr double counts_per_diameter = 200, counts_per_turn = 1024, counts_per_one = 500;

template <class Value>
void append(std::string& bytes, Value value) {
  static_assert(std::endian::native == std::endian::little);
  const auto as_bytes = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  bytes.append(as_bytes.data(), as_bytes.size());
}

std::int32_t in_counts(double value, double unit) {
  constexpr double most = std::numeric_limits<std::int32_t>::max() / 4;  // so that no prediction overflows
  const double counts = std::round(value / unit);
  return std::isfinite(counts) ? static_cast<std::int32_t>(std::clamp(counts, -most, most)) : 0;
}

/// Small numbers of either sign become small ones: 0, -1, 1, -2, ..
std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}

/// The lowest bytes of all values, then the next: the higher ones are nearly all 0, which packs to next to nothing.
void append_planes(std::string& bytes, const std::vector<std::uint32_t>& values) {
  for (int shift = 0; shift < 32; shift += 8)
    for (const std::uint32_t value : values) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

std::string packed(const std::string& bytes) {
  z_stream stream{};
  // "Filtered": for small numbers that scatter, of which little repeats.
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL, Z_FILTERED) != Z_OK)
    throw std::bad_alloc();
  std::string result(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<z_const Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);  // whole at once: there is room
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

/// A field of all grains, in SI.
const std::vector<double>& values_of(const Grains& grains, const std::string& field) {
  if (field == "x") return grains.x;
  if (field == "y") return grains.y;
  if (field == "z") return grains.z;
  if (field == "angle") return grains.angle;
  if (field == "qw") return grains.q_w;
  if (field == "qx") return grains.q_x;
  if (field == "qy") return grains.q_y;
  return grains.q_z;
}

bool has_clumps(const Scene& scene) {
  return std::ranges::any_of(scene.lots, [](const SeedLot& lot) { return !lot.discs.empty(); });
}

std::vector<std::string> fields_of(const Scene& scene) {
  std::vector<std::string> fields = {"x", "y"};
  if (scene.space == Space::three_dimensional) fields.push_back("z");
  if (!has_clumps(scene)) return fields;
  if (scene.space == Space::plane)
    fields.push_back("angle");
  else
    fields.insert(fields.end(), {"qw", "qx", "qy", "qz"});
  return fields;
}

}  // namespace

Recording::Recording(const Model& model) : vessels_(model.vessels), fields_(fields_of(model.scene)) {
  for (const std::string& field : fields_)
    units_.push_back(field.size() == 1  ? 2 * model.smallest_radius / counts_per_diameter
                     : field == "angle" ? 2 * std::numbers::pi / counts_per_turn
                                        : 1 / counts_per_one);
}

void Recording::add(const Simulation& simulation) {
  if (simulation.time() == time_) return;
  time_ = simulation.time();
  append(block_, time_);
  add_vessels(simulation);
  add_changes(simulation.grains());
  add_places(simulation.grains());
  ++frames_;
  if (++frames_in_block_ == frames_per_block) close_block();
}

/// A point `own` of a vessel lies at (x, y) + R(angle) own in the lab.
void Recording::add_vessels(const Simulation& simulation) {
  const Walls& walls = simulation.field().walls();
  for (std::size_t v = 0; v < vessels_.size(); ++v) {
    const Vessel& vessel = vessels_[v];
    const Pose pose = walls.pose(v, time_);
    const Eigen::Vector2d at = vessel.origin + pose.displacement;
    for (const double value : {at.x(), at.y(), vessel.front + pose.across, vessel.tilt + pose.angle})
      append(block_, value);
  }
}

/// Which grains of the frame before are gone, and which are new.
void Recording::add_changes(const Grains& grains) {
  std::vector<std::uint32_t> leaving;
  std::string entering;
  std::uint32_t entered = 0;
  std::size_t i = 0;  // both lists are ascending
  for (std::size_t k = 0; k < present_.size(); ++k) {
    while (i < grains.size() && grains.id[i] < present_[k]) ++i;
    if (i < grains.size() && grains.id[i] == present_[k]) continue;
    leaving.push_back(static_cast<std::uint32_t>(k));
    known_.erase(present_[k]);
  }
  for (i = 0; i < grains.size(); ++i) {
    const std::int64_t id = grains.id[i];
    if (!known_.try_emplace(id).second) continue;
    const auto place = static_cast<std::size_t>(id);
    const float z = grains.in_space ? static_cast<float>(grains.z[i]) : 0.0F;
    if (first_seen_.size() <= place) first_seen_.resize(place + 1, {NAN, 0, 0});
    if (std::isnan(first_seen_[place][0]))
      first_seen_[place] = {static_cast<float>(grains.x[i]), static_cast<float>(grains.y[i]), z};
    ++entered;
    append(entering, static_cast<std::uint32_t>(id));
    append(entering, static_cast<std::uint16_t>(grains.lot[i]));
    append(entering, static_cast<float>(grains.kind(i).radius));
    for (const float start : first_seen_[place]) append(entering, start);
  }
  present_ = grains.id;
  append(block_, static_cast<std::uint32_t>(leaving.size()));
  append(block_, entered);
  append(block_, static_cast<std::uint32_t>(present_.size()));
  for (const std::uint32_t k : leaving) append(block_, k);
  block_ += entering;
}

/// What is left of each coordinate where the grain was expected to go on as between the two frames before.
void Recording::add_places(const Grains& grains) {
  std::vector<std::vector<std::uint32_t>> residuals(fields_.size());
  std::vector<const std::vector<double>*> values;
  for (const std::string& field : fields_) values.push_back(&values_of(grains, field));
  for (std::size_t i = 0; i < grains.size(); ++i) {
    Known& known = known_.at(grains.id[i]);
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      const std::int32_t now = in_counts((*values[f])[i], units_[f]);
      const std::int32_t expected = known.frames == 0   ? 0
                                    : known.frames == 1 ? known.last[f]
                                                        : 2 * known.last[f] - known.before[f];
      residuals[f].push_back(zigzag(now - expected));
      known.before[f] = std::exchange(known.last[f], now);
    }
    ++known.frames;
  }
  for (const std::vector<std::uint32_t>& of_field : residuals) append_planes(block_, of_field);
}

void Recording::close_block() {
  const std::string bytes = packed(block_);
  blocks_.push_back({frames_in_block_, packed_.size(), bytes.size()});
  packed_ += bytes;
  block_.clear();
  present_.clear();
  known_.clear();
  frames_in_block_ = 0;
}

std::string Recording::file() const {
  if (frames_in_block_ > 0) {
    Recording whole(*this);
    whole.close_block();
    return whole.file();
  }
  nlohmann::ordered_json header = {{"version", 1},
                                   {"frames", frames_},
                                   {"frames_per_block", frames_per_block},
                                   {"unit_m", units_.front()},
                                   {"fields", fields_},
                                   {"field_units", units_},
                                   {"vessels", nlohmann::ordered_json::array()},
                                   {"grains", first_seen_.size()},
                                   {"blocks", nlohmann::ordered_json::array()}};
  for (const Vessel& vessel : vessels_) header["vessels"].push_back(vessel.name);
  for (const Block& block : blocks_)
    header["blocks"].push_back({{"frames", block.frames}, {"offset", block.offset}, {"bytes", block.bytes}});
  const std::string text = header.dump();
  std::string file = "VBSWREC1";
  append(file, static_cast<std::uint32_t>(text.size()));
  return file + text + packed_;
}

double frame_interval(const Model& model) {
  const bool in_space = model.scene.space == Space::three_dimensional;
  const double most_coordinates = in_space ? 4e6 : 2.5e6;
  const auto steps = static_cast<double>(model.step.steps);
  const double grains = std::max(1.0, predicted_grain_steps(model.scene, model.step.dt) / steps);
  const double fields = static_cast<double>(fields_of(model.scene).size());
  const double frames = std::clamp(most_coordinates / (grains * fields), 20.0, 500.0);
  return model.scene.run.duration / frames;
}

}  // namespace vibrosow
