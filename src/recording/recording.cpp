#include "recording/recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "fields/tray_frame.hpp"
#include "plan/predicted_grains.hpp"
#include "recording/bytes.hpp"
#include "recording/contact_bytes.hpp"

namespace vibrosow {
namespace {

constexpr int frames_per_block = 250;
constexpr std::array map_names = {"map", "hopper_map"};  // by vessel
constexpr double counts_per_diameter = 200, counts_per_turn = 1024, counts_per_one = 500;

std::int32_t in_counts(double value, double unit) {
  constexpr double most = std::numeric_limits<std::int32_t>::max() / 4;  // so that no prediction overflows
  const double counts = std::round(value / unit);
  return std::isfinite(counts) ? static_cast<std::int32_t>(std::clamp(counts, -most, most)) : 0;
}

/// Small numbers of either sign become small ones: 0, -1, 1, -2, ..
std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
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
  if (scene.space == Space::two_dimensional)
    fields.push_back("angle");
  else
    fields.insert(fields.end(), {"qw", "qx", "qy", "qz"});
  return fields;
}

double mean_grains(const Model& model) {
  const auto steps = static_cast<double>(model.step.steps);
  return std::max(1.0, predicted_grain_steps(model.scene, model.step.dt) / steps);
}

double planned_frames(const Model& model) {
  constexpr double most_coordinates = 2.5e6;
  const double fields = static_cast<double>(fields_of(model.scene).size());
  return std::clamp(most_coordinates / (mean_grains(model) * fields), 20.0, 500.0);
}

/// Of how many frames one has its contacts kept: some 4 bytes a grain. There is a frame more than the intervals, and
/// rounding to whole steps may give another.
int frames_per_contacts(const Model& model) {
  const double most_grains = model.scene.space == Space::three_dimensional ? 2.3e5 : 1.5e5;
  const double most_frames = std::clamp(most_grains / mean_grains(model), 5.0, 50.0);
  return static_cast<int>(std::ceil((planned_frames(model) + 2) / most_frames));
}

/// The scene with the cells of its maps: those of its [record], else of one and a half of the largest seeds.
Scene with_map(Scene scene) {
  if (scene.record) return scene;
  double diameter = 0;
  for (const SeedLot& lot : scene.lots) diameter = std::max(diameter, lot.diameter);
  scene.record = Record{{}, 1.5 * diameter, MapView::projection};
  return scene;
}

/// The scene whose tray is another of its vessels: the maps of a scene are of its tray.
Scene with_tray(Scene scene, const Vessel& vessel) {
  scene.tray = vessel;
  return scene;
}

/// Empty without a look in the measuring window, or of a vessel that stayed empty.
std::string map_bytes(const MeanMap& map) {
  if (map.grid.size() == 0) return "";
  std::string bytes;
  for (const std::vector<double>* values : {&map.packing, &map.vx, &map.vy})
    for (const double value : *values) append(bytes, static_cast<float>(value));
  return packed(bytes);
}

nlohmann::ordered_json map_header(const Scene& scene, const MeanMap& map, std::size_t offset, std::size_t bytes) {
  const bool slice = scene.space != Space::two_dimensional && scene.record->view == MapView::slice;
  return {{"cell_m", map.grid.cell}, {"columns", map.grid.columns},
          {"rows", map.grid.rows},   {"view", slice ? "slice" : "projection"},
          {"looks", map.looks},      {"from_s", map.from},
          {"to_s", map.to},          {"offset", offset},
          {"bytes", bytes}};
}

double map_interval(const MeasuringWindow& window) {
  constexpr double looks = 211;  // a prime, so that shaking is met in many of its phases
  return std::max(window.length(), 0.0) / looks;
}

}  // namespace

Recording::Recording(const Model& model)
    : vessels_(model.vessels.begin(), model.vessels.begin() + (model.scene.hopper ? 2 : 1)),
      fields_(fields_of(model.scene)),
      frame_interval_(frame_interval(model)),
      frames_per_contacts_(frames_per_contacts(model)),
      window_(measuring_window(model.scene)),
      extents_(model.scene.lots) {
  const Scene scene = with_map(model.scene);
  for (std::size_t v = 0; v < vessels_.size(); ++v) {
    const Scene own = with_tray(scene, vessels_[v]);
    maps_.push_back({v, own, MeanMapSum(own)});
  }
  for (const std::string& field : fields_)
    units_.push_back(field.size() == 1  ? 2 * model.smallest_radius / counts_per_diameter
                     : field == "angle" ? 2 * std::numbers::pi / counts_per_turn
                                        : 1 / counts_per_one);
}

std::vector<Observer> Recording::observers() {
  return {{frame_interval_, [this](Simulation& now) { add(now); }},
          {map_interval(window_), [this](Simulation& now) { add_to_map(now); }}};
}

void Recording::add(Simulation& simulation) {
  if (simulation.time() == time_) return;
  time_ = simulation.time();
  append(block_, time_);
  add_vessels(simulation);
  add_changes(simulation.grains());
  add_places(simulation.grains());
  if (frames_ % frames_per_contacts_ == 0) add_contacts(simulation);
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
    const float z = grains.is_3d ? static_cast<float>(grains.z[i]) : 0.0F;
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

void Recording::add_contacts(Simulation& simulation) {
  const std::string bytes = packed(contact_bytes(simulation));
  contacts_.push_back({frames_, packed_contacts_.size(), bytes.size()});
  packed_contacts_ += bytes;
}

void Recording::add_to_map(Simulation& simulation) {
  const double time = simulation.time();
  if (time < window_.from || time == map_time_) return;
  map_time_ = time;
  std::array<std::vector<std::size_t>, 2> grains;  // in the tray or beside it, in the hopper
  for (std::size_t i = 0; i < simulation.grains().size(); ++i) grains[simulation.is_in_hopper(i) ? 1 : 0].push_back(i);
  for (VesselMap& map : maps_) {
    Snapshot bed = snapshot_of(simulation.grains(), simulation.field().walls(), time, map.vessel);
    extents_.add_to(bed);
    bed.start_x = bed.x, bed.start_y = bed.y, bed.start_z = bed.z;
    map.sum.add(in_tray_frame(part_of(bed, grains[map.vessel]), map.scene.tray));
  }
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
  nlohmann::ordered_json header = {{"version", 2},
                                   {"frames", frames_},
                                   {"frames_per_block", frames_per_block},
                                   {"unit_m", units_.front()},
                                   {"fields", fields_},
                                   {"field_units", units_},
                                   {"vessels", nlohmann::ordered_json::array()},
                                   {"grains", first_seen_.size()},
                                   {"blocks", nlohmann::ordered_json::array()},
                                   {"contacts", nlohmann::ordered_json::array()}};
  for (const Vessel& vessel : vessels_) header["vessels"].push_back(vessel.name);
  for (const Block& block : blocks_)
    header["blocks"].push_back({{"frames", block.frames}, {"offset", block.offset}, {"bytes", block.bytes}});
  std::size_t end = packed_.size();
  for (const FrameContacts& contacts : contacts_)
    header["contacts"].push_back(
        {{"frame", contacts.frame}, {"offset", end + contacts.offset}, {"bytes", contacts.bytes}});
  end += packed_contacts_.size();
  std::string maps;
  for (const VesselMap& one : maps_) {
    const MeanMap map = one.sum.mean();
    const std::string bytes = map_bytes(map);
    if (!bytes.empty()) header[map_names[one.vessel]] = map_header(one.scene, map, end + maps.size(), bytes.size());
    maps += bytes;
  }
  const std::string text = header.dump();
  std::string file = "VBSWREC1";
  append(file, static_cast<std::uint32_t>(text.size()));
  return file + text + packed_ + packed_contacts_ + maps;
}

double frame_interval(const Model& model) {
  return model.scene.run.duration / planned_frames(model);
}

}  // namespace vibrosow
