#include "scene/scene_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "scene/accuracy_level.hpp"
#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"
#include "scene/integrator_names.hpp"
#include "scene/list_limits.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

// What stands under which key is said once, by the functions `fields`, for writing and for reading. They are called
// with a Writer or a Reader of one JSON object, which have
//  - value: always there; time: the same, and null for `never`
//  - used: there while `is_used`, else only where it is not the default
//  - optional: there when it has a value; nullable: always there, and null when it has none
//  - choice: one of some names, in the order of the enumeration
//  - key: the one that the object itself stands under
// Keys are written in the order of the calls; what decides whether a value is used comes before it.

std::string key_path(const std::string& path, std::string_view key) {
  return fmt::format("{}.{}", path, key);
}

std::string last_key(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

std::string entry_path(const std::string& path, std::size_t index) {
  return fmt::format("{}[{}]", path, index);
}

class Writer {
 public:
  explicit Writer(std::string path) : path_(std::move(path)) {}

  template <class T>
  void value(const char* key, T& value) {
    json_[key] = to_json(key_path(path_, key), value);
  }
  void time(const char* key, double& time) {
    json_[key] = nullptr;
    if (time != never) value(key, time);
  }
  template <class T>
  void used(const char* key, T& value, const T& otherwise, bool is_used) {
    if (is_used || !(value == otherwise)) this->value(key, value);
  }
  template <class T>
  void optional(const char* key, std::optional<T>& value) {
    if (value) this->value(key, *value);
  }
  template <class T>
  void nullable(const char* key, std::optional<T>& value) {
    json_[key] = nullptr;
    optional(key, value);
  }
  template <class E>
  void choice(const char* key, E& value, const std::vector<std::string>& names) {
    json_[key] = names.at(static_cast<std::size_t>(value));
  }
  template <class E>
  void used_choice(const char* key, E& value, const std::vector<std::string>& names, E otherwise) {
    if (value != otherwise) choice(key, value, names);
  }
  std::string key() const { return last_key(path_); }
  Json json() && { return std::move(json_); }

 private:
  static Json number(const std::string& path, double value) {
    if (std::isfinite(value)) return value;
    throw std::invalid_argument(fmt::format("{}: {} cannot be written as JSON", path, value));
  }
  static Json to_json(const std::string& path, double& value) { return number(path, value); }
  static Json to_json(const std::string&, int& value) { return value; }
  static Json to_json(const std::string&, bool& value) { return value; }
  static Json to_json(const std::string&, std::string& value) { return value; }
  static Json to_json(const std::string& path, Eigen::Vector2d& point) {
    return Json::array({number(path, point.x()), number(path, point.y())});
  }
  template <class T>
  static Json to_json(const std::string& path, std::vector<T>& list) {
    Json json = Json::array();
    for (std::size_t k = 0; k < list.size(); ++k) json.push_back(to_json(entry_path(path, k), list[k]));
    return json;
  }
  template <class T>
  static Json to_json(const std::string& path, T& object) {
    Writer writer(path);
    fields(writer, object);
    return std::move(writer).json();
  }

  std::string path_;
  Json json_ = Json::object();
};

[[noreturn]] void fail(const std::string& path, const std::string& message) {
  throw InputError(path + ": " + message);
}

class Reader {
 public:
  /// `within`: whether values are held to their ranges. Throws InputError when it is not an object.
  Reader(std::string path, const Json& json, bool within) : path_(std::move(path)), json_(json), within_(within) {
    if (!json.is_object()) wrong_type(path_, "an object", json);
  }

  template <class T>
  void value(const char* key, T& value) {
    if (!has(key)) fail(key_path(path_, key), "is missing");
    from_json(key_path(path_, key), json_.at(key), value);
  }
  void time(const char* key, double& time) {
    if (has(key) && json_.at(key).is_null()) {
      time = never;
    } else {
      value(key, time);
    }
  }
  template <class T>
  void used(const char* key, T& value, const T& otherwise, bool is_used) {
    value = otherwise;
    if (has(key) || is_used) this->value(key, value);
  }
  template <class T>
  void optional(const char* key, std::optional<T>& value) {
    value.reset();
    if (has(key) && !json_.at(key).is_null()) this->value(key, value.emplace());
  }
  template <class T>
  void nullable(const char* key, std::optional<T>& value) {
    optional(key, value);
  }
  template <class E>
  void choice(const char* key, E& value, const std::vector<std::string>& names) {
    std::string name;
    this->value(key, name);
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      fail(key_path(path_, key), fmt::format("\"{}\" is not one of {}", name, fmt::join(names, ", ")));
    value = static_cast<E>(found - names.begin());
  }
  template <class E>
  void used_choice(const char* key, E& value, const std::vector<std::string>& names, E otherwise) {
    value = otherwise;
    if (has(key)) choice(key, value, names);
  }
  std::string key() const { return last_key(path_); }
  void check(bool right, const char* key, const char* message) const {
    if (!right) fail(key_path(path_, key), message);
  }
  void range(bool right, const char* key, const char* message) const { check(right || !within_, key, message); }
  /// After all that may be there was read.
  void reject_unknown_keys() const {
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(known_, key) == known_.end())
        fail(key_path(path_, key), fmt::format("unknown key; known here are {}", fmt::join(known_, ", ")));
  }

 private:
  bool has(const char* key) {
    if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
    return json_.contains(key);
  }
  [[noreturn]] static void wrong_type(const std::string& path, const char* expected, const Json& json) {
    const char* found = json.is_object()    ? "an object"
                        : json.is_array()   ? "a list"
                        : json.is_string()  ? "a text"
                        : json.is_boolean() ? "true or false"
                        : json.is_null()    ? "null"
                                            : "this number";
    fail(path, fmt::format("expected {}, not {}", expected, found));
  }
  void from_json(const std::string& path, const Json& json, double& value) {
    if (!json.is_number()) wrong_type(path, "a number", json);
    value = json.get<double>();
    constexpr double most = 1e15;  // beyond any quantity of a scene, in SI
    if (within_ && !(std::abs(value) <= most)) fail(path, fmt::format("{:g} is out of range", value));
  }
  void from_json(const std::string& path, const Json& json, int& value) {
    constexpr auto least = std::numeric_limits<int>::min(), most = std::numeric_limits<int>::max();
    const bool fits = json.is_number_unsigned() ? json.get<std::uint64_t>() <= most
                                                : json.is_number_integer() && json.get<std::int64_t>() >= least;
    if (!fits) wrong_type(path, "a whole number of 32 bits", json);
    value = json.get<int>();
  }
  void from_json(const std::string& path, const Json& json, bool& value) {
    if (!json.is_boolean()) wrong_type(path, "true or false", json);
    value = json.get<bool>();
  }
  void from_json(const std::string& path, const Json& json, std::string& value) {
    if (!json.is_string()) wrong_type(path, "a text", json);
    value = json.get<std::string>();
  }
  void from_json(const std::string& path, const Json& json, Eigen::Vector2d& point) {
    std::vector<double> values;
    from_json(path, json, values);
    if (values.size() != 2) fail(path, fmt::format("expected two numbers, not {}", values.size()));
    point = {values[0], values[1]};
  }
  template <class T>
  void from_json(const std::string& path, const Json& json, std::vector<T>& list) {
    if (!json.is_array()) wrong_type(path, "a list", json);
    list.assign(json.size(), T{});
    for (std::size_t k = 0; k < list.size(); ++k) from_json(entry_path(path, k), json[k], list[k]);
  }
  template <class T>
  void from_json(const std::string& path, const Json& json, T& object) {
    Reader reader(path, json, within_);
    fields(reader, object);
    reader.reject_unknown_keys();
  }

  std::string path_;
  const Json& json_;
  bool within_;
  std::vector<std::string> known_;
};

/// What a scene must have to be one; of one that is written it is taken for granted.
void check(const Writer&, bool, const char*, const char*) {}
void check(const Reader& reader, bool right, const char* key, const char* message) {
  reader.check(right, key, message);
}

/// A value's range, with its ends: that of a seeder file's key, or wider where other programs may ask for more.
void range(const Writer&, double, double, double, const char*) {}
void range(const Reader& reader, double value, double least, double most, const char* key) {
  reader.range(value >= least && value <= most, key, "is out of range");
}
void range(const Writer&, bool, const char*, const char*) {}
void range(const Reader& reader, bool right, const char* key, const char* message) {
  reader.range(right, key, message);
}
constexpr double smallest_length = 1e-9, farthest = 1e4, latest = 1e6;  // m, m, s
constexpr double most_turns = 1e6;                                      // rad, rad/s, Hz
constexpr double least_compression = 1e-15;

template <class Io, class List>
void no_more_than(Io& io, const List& list, std::size_t most, const char* key) {
  range(io, list.size() <= most, key, "lists too many");
}

template <class Io>
void fields(Io& io, SizeDistribution& sizes) {
  using Kind = SizeDistribution::Kind;
  const SizeDistribution usual;
  io.choice("distribution", sizes.kind, {"single", "uniform", "normal", "lognormal", "table"});
  const bool table = sizes.kind == Kind::table, normal = sizes.kind == Kind::normal || sizes.kind == Kind::lognormal;
  io.used("diameters_m", sizes.diameter, usual.diameter, table);
  io.used("fractions", sizes.fraction, usual.fraction, table);
  check(io, sizes.fraction.size() == sizes.diameter.size(), "fractions", "has not as many numbers as diameters_m");
  check(io, !table || !sizes.diameter.empty(), "diameters_m", "is empty");
  no_more_than(io, sizes.diameter, list_limits::sizes, "diameters_m");
  io.used("mean_m", sizes.mean, usual.mean, normal);
  io.used("deviation_m", sizes.deviation, usual.deviation, normal);
  io.used("least_m", sizes.least, usual.least, normal || sizes.kind == Kind::uniform);
  io.used("most_m", sizes.most, usual.most, normal || sizes.kind == Kind::uniform);
  const bool has_ends = normal || sizes.kind == Kind::uniform;
  for (const double diameter : sizes.diameter) range(io, diameter, smallest_length, farthest, "diameters_m");
  for (const double fraction : sizes.fraction) range(io, fraction, 0, 1, "fractions");
  range(io, sizes.mean, normal ? smallest_length : 0, farthest, "mean_m");
  range(io, sizes.deviation, normal ? smallest_length * 1e-6 : 0, farthest, "deviation_m");
  range(io, sizes.least, has_ends ? smallest_length : 0, farthest, "least_m");
  range(io, sizes.most, sizes.least, farthest, "most_m");
}

template <class Io>
void fields(Io& io, ClumpDisc& disc) {
  io.value("x_m", disc.x);
  io.value("y_m", disc.y);
  io.used("z_m", disc.z, 0.0, false);
  io.value("radius_m", disc.radius);
  range(io, disc.radius, smallest_length, farthest, "radius_m");
}

template <class Io>
void fields(Io& io, SeedLot& lot) {
  const SeedLot usual;
  io.value("name", lot.name);
  range(io, is_lot_name(lot.name), "name",
        "has other characters than letters, digits, _ and -, or is \"all\" or \"wall\"");
  io.value("diameter_m", lot.diameter);
  io.value("mass_kg", lot.mass);
  io.choice("shape", lot.shape, {"disc", "ball", "clump"});
  io.value("number_fraction", lot.number_fraction);
  io.used("sizes", lot.sizes, usual.sizes, false);
  const bool clump = lot.shape == Shape::clump;
  io.used("discs", lot.discs, usual.discs, clump);
  check(io, !clump || !lot.discs.empty(), "discs", "is empty");
  no_more_than(io, lot.discs, list_limits::clump_balls, "discs");
  io.used("gyration2_m2", lot.gyration2, usual.gyration2, clump);
  io.used("gyration2_x_m2", lot.gyration2_x, usual.gyration2_x, false);
  io.used("gyration2_y_m2", lot.gyration2_y, usual.gyration2_y, false);
  io.optional("shell_compression", lot.shell_compression);
  io.optional("youngs_modulus_pa", lot.youngs_modulus);
  io.optional("poisson_ratio", lot.poisson_ratio);
  range(io, lot.diameter, smallest_length, farthest, "diameter_m");
  range(io, lot.mass, 1e-18, 1e6, "mass_kg");
  range(io, lot.number_fraction, 0, 1, "number_fraction");
  for (const double gyration2 : {lot.gyration2, lot.gyration2_x, lot.gyration2_y})
    range(io, gyration2, 0, farthest, "gyration2_m2");
  range(io, lot.shell_compression.value_or(1), least_compression, 1, "shell_compression");
  range(io, lot.youngs_modulus.value_or(1), 1e-3, 1e15, "youngs_modulus_pa");
  range(io, lot.poisson_ratio.value_or(0), 0, 0.5, "poisson_ratio");
}

template <class Io>
void fields(Io& io, Surface& surface) {
  const Surface usual;
  io.value("friction", surface.friction);
  io.value("restitution", surface.restitution);
  io.used("rolling_friction", surface.rolling_friction, usual.rolling_friction, false);
  io.used("cohesion_n", surface.cohesion, usual.cohesion, false);
  io.used("twisting_friction", surface.twisting_friction, usual.twisting_friction, false);
  range(io, surface.friction, 0, 1e3, "friction");
  range(io, surface.restitution, 1e-3, 1, "restitution");
  range(io, surface.rolling_friction, 0, 1e3, "rolling_friction");
  range(io, surface.cohesion, 0, 1e6, "cohesion_n");
  range(io, surface.twisting_friction, 0, 1e3, "twisting_friction");
}

template <class Io>
void fields(Io& io, SurfaceOverride& pair) {
  io.value("lot", pair.lot);
  io.value("other", pair.other);
  fields(io, pair.surface);
}

template <class Io>
void fields(Io& io, Contact& contact) {
  const Contact usual;
  io.choice("law", contact.law, {"elastic-shell", "hertz", "hertz-viscous"});
  const bool hertz = contact.law != Law::elastic_shell;
  io.used("shell_compression", contact.shell_compression, usual.shell_compression, !hertz);
  io.used("youngs_modulus_pa", contact.youngs_modulus, usual.youngs_modulus, hertz);
  io.used("poisson_ratio", contact.poisson_ratio, usual.poisson_ratio, hertz);
  io.optional("wall_youngs_modulus_pa", contact.wall_youngs_modulus);
  io.used("wall_poisson_ratio", contact.wall_poisson_ratio, usual.wall_poisson_ratio,
          contact.wall_youngs_modulus.has_value());
  io.used("damping_rate_per_s", contact.damping_rate, usual.damping_rate, contact.law == Law::hertz_viscous);
  io.value("seed", contact.seed);
  io.value("wall", contact.wall);
  io.used("pairs", contact.overrides, usual.overrides, false);
  io.used_choice("friction_model", contact.friction_model, {"sliding", "spring"}, usual.friction_model);
  const bool spring = contact.friction_model == FrictionModel::spring;
  io.optional("tangential_ratio", contact.tangential_ratio);
  io.used("tangential_damping", contact.tangential_damping, usual.tangential_damping, spring);
  io.used_choice("rolling", contact.rolling, {"none", "constant-torque", "spring"}, usual.rolling);
  const bool slips = !spring || contact.rolling == Rolling::constant_torque;
  io.used("slip_speed_m_per_s", contact.slip_speed, usual.slip_speed, slips);
  io.used("rolling_damping", contact.rolling_damping, usual.rolling_damping, contact.rolling == Rolling::spring);
  io.value("drag_kg_per_s", contact.drag);
  io.value("rotation", contact.rotation);
  io.choice("friction_arm", contact.friction_arm, {"contact-point", "rim"});
  range(io, contact.shell_compression, hertz ? 0 : least_compression, 1, "shell_compression");
  range(io, contact.youngs_modulus, 0, 1e15, "youngs_modulus_pa");
  range(io, contact.poisson_ratio, 0, 0.5, "poisson_ratio");
  range(io, contact.wall_youngs_modulus.value_or(1), 1e-3, 1e15, "wall_youngs_modulus_pa");
  range(io, contact.wall_poisson_ratio, 0, 0.5, "wall_poisson_ratio");
  range(io, contact.damping_rate, 0, 1e12, "damping_rate_per_s");
  range(io, contact.tangential_ratio.value_or(1), 0, 1e3, "tangential_ratio");
  range(io, contact.tangential_damping, 0, 1e3, "tangential_damping");
  range(io, contact.slip_speed, slips ? 1e-12 : 0, 1e6, "slip_speed_m_per_s");
  range(io, contact.rolling_damping, 0, 1e3, "rolling_damping");
  range(io, contact.drag, 0, 1e6, "drag_kg_per_s");
}

template <class Io>
void fields(Io& io, Hole& hole) {
  io.value("centre_m", hole.centre);
  io.value("width_m", hole.width);
  io.time("open_at_s", hole.open_at);
  const Hole usual;
  io.used_choice("shape", hole.shape, {"slot", "round"}, usual.shape);
  io.used("across_m", hole.across, usual.across, false);
  io.used("across_length_m", hole.across_length, usual.across_length, false);
  io.used("thickness_m", hole.thickness, usual.thickness, false);
  io.used("chamfer_m", hole.chamfer, usual.chamfer, false);
  range(io, hole.centre, -farthest, farthest, "centre_m");
  range(io, hole.width, 0, farthest, "width_m");
  range(io, hole.open_at, 0, never, "open_at_s");
  range(io, hole.across, -farthest, farthest, "across_m");
  range(io, hole.across_length, 0, farthest, "across_length_m");
  range(io, hole.thickness, 0, farthest, "thickness_m");
  range(io, hole.chamfer, 0, hole.thickness, "chamfer_m");
}

template <class Io>
void fields(Io& io, WallPiece& piece) {
  const WallPiece usual;
  io.used("radius_m", piece.radius, usual.radius, false);
  const bool arc = piece.radius != 0;
  io.used("from_m", piece.a, usual.a, !arc);
  io.used("to_m", piece.b, usual.b, !arc);
  io.used("centre_m", piece.centre, usual.centre, arc);
  io.used("from_rad", piece.from, usual.from, arc);
  io.used("to_rad", piece.to, usual.to, arc);
  io.optional("about_m", piece.about);
  io.used_choice("axis", piece.axis, {"upright", "along"}, usual.axis);
  io.used_choice("drawn_out", piece.drawn_out, {"across", "along"}, usual.drawn_out);
  check(io, !piece.about || piece.drawn_out == DrawnOut::across, "drawn_out", "contradicts about_m");
  range(io, piece.radius, 0, farthest, "radius_m");
  range(io, piece.from, -most_turns, most_turns, "from_rad");
  range(io, piece.to, -most_turns, most_turns, "to_rad");
  for (const Eigen::Vector2d& point : {piece.a, piece.b, piece.centre, piece.about.value_or(Eigen::Vector2d(0, 0))})
    range(io, point.cwiseAbs().maxCoeff(), 0, farthest, "from_m");
}

template <class Io>
void fields(Io& io, Fill& fill) {
  io.value("count", fill.count);
  io.choice("packing", fill.packing, {"poured", "layers", "hexagonal"});
  io.used("jitter", fill.jitter, Fill{}.jitter, fill.packing != Packing::poured);
  io.value("keep", fill.keep);
  range(io, fill.count, 0, 1e7, "count");
  range(io, fill.jitter, 0, 1, "jitter");
}

template <class Io>
void fields(Io& io, Rain& rain) {
  io.value("rate_per_s", rain.rate);
  io.value("from_m", rain.from);
  io.value("to_m", rain.to);
  io.value("height_m", rain.height);
  io.value("start_s", rain.start);
  io.time("stop_s", rain.stop);
  range(io, rain.rate, 1e-12, 1e9, "rate_per_s");
  range(io, rain.from, -farthest, farthest, "from_m");
  range(io, rain.to, rain.from, farthest, "to_m");
  range(io, rain.height, -farthest, farthest, "height_m");
  range(io, rain.start, 0, latest, "start_s");
  range(io, rain.stop, 0, never, "stop_s");
}

/// Of a harmonic, a rocking and a turning motion.
template <class Io, class Motion>
void course(Io& io, Motion& motion) {
  io.value("ramp_s", motion.ramp);
  io.time("stop_s", motion.stop);
  io.value("stop_ramp_s", motion.stop_ramp);
  range(io, motion.ramp, 0, latest, "ramp_s");
  range(io, motion.stop, 0, never, "stop_s");
  range(io, motion.stop_ramp, 0, latest, "stop_ramp_s");
}

template <class Io>
void fields(Io& io, HarmonicMotion& motion) {
  io.value("direction_rad", motion.direction);
  io.value("amplitude_m", motion.amplitude);
  io.value("frequency_hz", motion.frequency);
  io.value("phase_rad", motion.phase);
  course(io, motion);
  io.used("across_rad", motion.across, 0.0, false);
  range(io, motion.direction, -most_turns, most_turns, "direction_rad");
  range(io, motion.amplitude, 0, farthest, "amplitude_m");
  range(io, motion.frequency, 0, most_turns, "frequency_hz");
  range(io, motion.phase, -most_turns, most_turns, "phase_rad");
  range(io, motion.across, -most_turns, most_turns, "across_rad");
}

template <class Io>
void fields(Io& io, SumMotion& motion) {
  io.value("components", motion.components);
  no_more_than(io, motion.components, list_limits::components, "components");
}

template <class Io>
void fields(Io& io, RockingMotion& motion) {
  io.value("pivot_m", motion.pivot);
  io.value("angle_rad", motion.angle);
  io.value("frequency_hz", motion.frequency);
  course(io, motion);
  range(io, motion.pivot.cwiseAbs().maxCoeff(), 0, farthest, "pivot_m");
  range(io, motion.angle, -most_turns, most_turns, "angle_rad");
  range(io, motion.frequency, 0, most_turns, "frequency_hz");
}

template <class Io>
void fields(Io& io, TableMotion& motion) {
  io.value("time_s", motion.times);
  io.value("x_m", motion.x);
  io.value("y_m", motion.y);
  io.value("angle_rad", motion.angle);
  const std::size_t rows = motion.times.size();
  check(io, rows >= 4, "time_s", "has fewer than 4 numbers");
  check(io, std::ranges::adjacent_find(motion.times, std::greater_equal{}) == motion.times.end(), "time_s",
        "does not ascend");
  check(io, motion.x.size() == rows, "x_m", "has not as many numbers as time_s");
  check(io, motion.y.size() == rows, "y_m", "has not as many numbers as time_s");
  check(io, motion.angle.size() == rows, "angle_rad", "has not as many numbers as time_s");
  io.used("z_m", motion.z, {}, false);
  check(io, motion.z.empty() || motion.z.size() == rows, "z_m", "has not as many numbers as time_s");
  for (const std::vector<double>* places : {&motion.x, &motion.y, &motion.z})
    for (const double place : *places) range(io, place, -farthest, farthest, "x_m");
  for (const double angle : motion.angle) range(io, angle, -most_turns, most_turns, "angle_rad");
  for (const double time : motion.times) range(io, time, -latest, latest, "time_s");
}

template <class Io>
void fields(Io& io, TurningMotion& motion) {
  io.value("pivot_m", motion.pivot);
  io.value("angular_velocity_rad_per_s", motion.angular_velocity);
  io.choice("axis", motion.axis, {"across", "upright"});
  course(io, motion);
  io.used("phase_rad", motion.phase, 0.0, false);
  range(io, motion.pivot.cwiseAbs().maxCoeff(), 0, farthest, "pivot_m");
  range(io, motion.angular_velocity, -most_turns, most_turns, "angular_velocity_rad_per_s");
  range(io, motion.phase, -most_turns, most_turns, "phase_rad");
}

template <class Io>
void fields(Io& io, VesselMotion& motion) {
  std::size_t kind = motion.index();
  io.choice("kind", kind, {"harmonic", "sum", "rocking", "table", "turning"});
  if (kind != motion.index()) {
    const std::array<VesselMotion, 5> kinds = {HarmonicMotion{}, SumMotion{}, RockingMotion{}, TableMotion{},
                                               TurningMotion{}};
    motion = kinds.at(kind);
  }
  std::visit([&io](auto& one) { fields(io, one); }, motion);
}

template <class Io>
void fields(Io& io, SlotsIn3d& slots) {
  io.value("rows", slots.rows);
  io.value("open", slots.open);
  range(io, slots.rows >= 1, "rows", "is out of range");
  range(io, slots.open, 0, 1, "open");
}

template <class Io>
void fields(Io& io, Vessel& vessel) {
  io.used("name", vessel.name, io.key(), false);
  range(io, printable(vessel.name) == vessel.name, "name", "has control characters");
  io.value("left_m", vessel.origin.x());
  io.value("above_m", vessel.origin.y());
  io.value("length_m", vessel.length);
  io.value("height_m", vessel.height);
  io.value("tilt_rad", vessel.tilt);
  io.value("funnel_rad", vessel.funnel);
  io.nullable("depth_m", vessel.depth);
  io.value("holes", vessel.holes);
  io.used("slots_in_3d", vessel.slots_in_3d, SlotsIn3d{}, false);
  io.value("pieces", vessel.pieces);
  no_more_than(io, vessel.pieces, list_limits::pieces, "pieces");
  io.value("box", vessel.box);
  io.choice("sides", vessel.sides, {"walls", "open", "periodic"});
  io.used_choice("front_and_back", vessel.front_and_back, {"walls", "open", "periodic"}, Sides::walls);
  io.used("front_m", vessel.front, 0.0, false);
  io.used_choice("plan", vessel.plan, {"rectangle", "round"}, Plan::rectangle);
  io.nullable("fill", vessel.fill);
  io.nullable("rain", vessel.rain);
  io.nullable("motion", vessel.motion);
  range(io, vessel.origin.cwiseAbs().maxCoeff(), 0, farthest, "left_m");
  range(io, vessel.length, 0, farthest, "length_m");
  range(io, vessel.height, 0, farthest, "height_m");
  range(io, vessel.tilt, -most_turns, most_turns, "tilt_rad");
  range(io, vessel.funnel, 0, 1.57, "funnel_rad");
  range(io, vessel.depth.value_or(1), smallest_length, farthest, "depth_m");
  range(io, vessel.front, -farthest, farthest, "front_m");
}

template <class Io>
void fields(Io& io, Numerics& numerics) {
  io.used_choice("accuracy", numerics.accuracy, accuracy_level_names(), AccuracyLevel::as_written);
  io.choice("integrator", numerics.integrator, integrator_names());
  io.optional("dt_s", numerics.dt);
  io.used("steps_per_contact", numerics.steps_per_contact, usual_steps_per_contact(numerics.integrator), !numerics.dt);
  io.optional("impact_speed_m_per_s", numerics.impact_speed);
  io.value("allow_long_step", numerics.allow_long_step);
  range(io, numerics.dt.value_or(1), 1e-12, latest, "dt_s");
  range(io, numerics.steps_per_contact, numerics.dt ? 0 : 1, 1e6, "steps_per_contact");
  range(io, numerics.impact_speed.value_or(1), 1e-9, 1e6, "impact_speed_m_per_s");
}

template <class Io>
void fields(Io& io, GuardLimits& guard) {
  io.value("warn_relative_overlap", guard.warn_relative_overlap);
  io.value("stop_relative_overlap", guard.stop_relative_overlap);
  io.value("energy_tolerance", guard.energy_tolerance);
  range(io, guard.warn_relative_overlap, 0, 1e6, "warn_relative_overlap");
  range(io, guard.stop_relative_overlap, 0, 1e6, "stop_relative_overlap");
  range(io, guard.energy_tolerance, 0, 1e12, "energy_tolerance");
}

template <class Io>
void fields(Io& io, RunPlan& run) {
  io.value("duration_s", run.duration);
  io.value("measure_from_s", run.measure_from);
  io.value("count_below_m", run.count_below);
  io.choice("start", run.start, {"at-rest", "with-tray"});
  io.optional("end_after_pause_s", run.end_after_pause);
  range(io, run.duration, 0, latest, "duration_s");
  range(io, run.measure_from, 0, latest, "measure_from_s");
  range(io, run.count_below, 0, farthest, "count_below_m");
  range(io, run.end_after_pause.value_or(1), 0, latest, "end_after_pause_s");
}

template <class Io>
void fields(Io& io, Record& record) {
  io.value("times_s", record.times);
  no_more_than(io, record.times, list_limits::snapshots, "times_s");
  io.value("cell_m", record.cell);
  io.used_choice("view", record.view, {"projection", "slice"}, MapView::projection);
  for (const double time : record.times) range(io, time, 0, latest, "times_s");
  range(io, std::ranges::is_sorted(record.times), "times_s", "does not ascend");
  range(io, record.cell, 0, farthest, "cell_m");
}

bool lots_exist(const Scene& scene) {
  const int lots = static_cast<int>(scene.lots.size());
  return std::ranges::all_of(scene.contact.overrides, [lots](const SurfaceOverride& pair) {
    return pair.lot >= 0 && pair.lot < lots && pair.other >= -1 && pair.other < lots;
  });
}

template <class Io>
void fields(Io& io, Scene& scene) {
  io.used("title", scene.title, {}, false);
  range(io, printable(scene.title) == scene.title, "title", "has control characters");
  io.used_choice("space", scene.space, {"2d", "3d"}, Space::two_dimensional);
  io.value("lots", scene.lots);
  check(io, !scene.lots.empty(), "lots", "is empty");
  no_more_than(io, scene.lots, list_limits::lots, "lots");
  io.value("contact", scene.contact);
  check(io, lots_exist(scene), "contact.pairs", "names a lot that does not exist");
  io.value("tray", scene.tray);
  io.nullable("hopper", scene.hopper);
  io.value("numerics", scene.numerics);
  io.value("guard", scene.guard);
  io.value("run", scene.run);
  io.optional("record", scene.record);
}

/// As the library's parser takes a key twice without a word, it is watched.
Json parse(std::string_view text) {
  std::vector<std::set<std::string>> open_objects;
  const auto refuse_twice = [&](int, Json::parse_event_t event, const Json& key) {
    if (event == Json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) open_objects.pop_back();
    if (event == Json::parse_event_t::key) {
      if (!open_objects.back().insert(key.get_ref<const std::string&>()).second)
        fail("scene", fmt::format("the key {} stands twice in one object", key.dump()));
    }
    return true;
  };
  refuse_deep_json(text);
  try {
    return Json::parse(text, refuse_twice);
  } catch (const Json::exception& error) {
    fail("scene", fmt::format("not JSON: {}", error.what()));
  }
}

}  // namespace

std::string scene_to_json(const Scene& scene) {
  Scene copy = scene;  // since `fields` may write as well
  Writer writer("scene");
  fields(writer, copy);
  try {
    return std::move(writer).json().dump();
  } catch (const Json::exception& error) {
    throw std::invalid_argument(fmt::format("scene: cannot be written as JSON: {}", error.what()));
  }
}

namespace {

Scene read_scene_json(std::string_view json, bool within) {
  const Json parsed = parse(json);
  Scene scene;
  Reader reader("scene", parsed, within);
  fields(reader, scene);
  reader.reject_unknown_keys();
  return scene;
}

}  // namespace

Scene scene_from_json(std::string_view json) {
  return read_scene_json(json, true);
}

Scene scene_of_any_numbers(std::string_view json) {
  return read_scene_json(json, false);
}

}  // namespace vibrosow
