#pragma once

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <type_traits>

#include "result/run.hpp"

// Results as bytes, the same on every machine. cereal finds these functions by the types' namespaces.

namespace vibrosow {

/// What results are read from. cereal::Exception where the bytes end too early.
struct InputArchive : cereal::PortableBinaryInputArchive {
  explicit InputArchive(std::istringstream& in) : PortableBinaryInputArchive(in), stream(in) {}
  std::istringstream& stream;
};

}  // namespace vibrosow

namespace cereal {

/// How many elements follow; never more than there are bytes left, so that a damaged size asks for no memory.
inline std::size_t load_size(PortableBinaryInputArchive& archive, std::size_t bytes_of_one) {
  size_type size = 0;
  archive(make_size_tag(size));
  const std::streamsize left = static_cast<vibrosow::InputArchive&>(archive).stream.rdbuf()->in_avail();
  if (left < 0 || size > static_cast<size_type>(left) / bytes_of_one) throw Exception("a size beyond the end");
  return static_cast<std::size_t>(size);
}

// In the place of cereal's own, which believe any size, and any byte to be a bool.
template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> load(PortableBinaryInputArchive& archive, std::vector<T>& values) {
  values.resize(load_size(archive, sizeof(T)));
  archive(binary_data(values.data(), values.size() * sizeof(T)));
}
template <class T>
std::enable_if_t<!std::is_arithmetic_v<T>> load(PortableBinaryInputArchive& archive, std::vector<T>& values) {
  values.clear();  // grows as they are read: a value takes more memory than the bytes that a damaged size is held to
  for (std::size_t left = load_size(archive, 1); left > 0; --left) archive(values.emplace_back());
}
inline void load(PortableBinaryInputArchive& archive, bool& value) {
  unsigned char byte = 0;
  archive(byte);
  value = byte != 0;
}
inline void load(PortableBinaryInputArchive& archive, std::string& text) {
  text.resize(load_size(archive, 1));
  archive(binary_data(text.data(), text.size()));
}

}  // namespace cereal

namespace vibrosow {

// Each lists every field of its type: what is missing here is lost.

template <class Archive>
void serialize(Archive& archive, Doubt& d) {
  archive(d.kind, d.text);
}

template <class Archive>
void serialize(Archive& archive, OutflowEvent& e) {
  archive(e.time, e.hole, e.lot, e.grain, e.mass, e.x, e.speed, e.z);
}

template <class Archive>
void serialize(Archive& archive, Snapshot& s) {
  archive(s.time, s.tray_x, s.tray_y, s.tray_angle, s.tray_vx, s.tray_vy, s.tray_spin, s.x, s.y, s.vx, s.vy, s.omega,
          s.angle, s.lot, s.id, s.radius, s.mass, s.area, s.start_x, s.start_y);
  archive(s.tray_z, s.tray_vz, s.z, s.vz, s.omega_x, s.omega_y, s.q_w, s.q_x, s.q_y, s.q_z, s.start_z, s.volume,
          s.in_tray);
}

template <class Archive>
void serialize(Archive& archive, EnergyAccount& e) {
  archive(e.kinetic, e.potential, e.elastic, e.wall_work, e.inserted, e.removed, e.made_by_numerics);
}

template <class Archive>
void serialize(Archive& archive, Balance& b) {
  archive(b.put_in, b.inside, b.counted, b.spilled, b.lost);
}

}  // namespace vibrosow
