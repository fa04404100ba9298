#include "recording/read_recording.hpp"

#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "scene/checked_json.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::json;

constexpr std::size_t head_size = 12, piece = std::size_t{1} << 20;
constexpr std::size_t most_unpacked = std::size_t{1}
                                      << 28;   // bytes of all blocks: a recording is of 2.5 million coordinates
constexpr std::int64_t most_frames = 100'000;  // of all blocks

[[noreturn]] void damaged() {
  throw InputError("the recording is damaged");
}

/// Throws InputError where they are no zlib stream, or become more bytes than `most`.
std::string unpacked(const std::string& packed, std::size_t most) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<z_const Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string bytes;
  int status = Z_OK;
  while (status == Z_OK && stream.total_out <= most) {
    bytes.resize(stream.total_out + piece);
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + stream.total_out);
    stream.avail_out = static_cast<uInt>(piece);
    status = inflate(&stream, Z_NO_FLUSH);
  }
  bytes.resize(stream.total_out);
  inflateEnd(&stream);
  if (status != Z_STREAM_END || bytes.size() > most) damaged();
  return bytes;
}

/// Takes numbers off the front of a text.
class Bytes {
 public:
  explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}

  bool at_end() const { return at_ == bytes_.size(); }
  template <class Value>
  Value take() {
    static_assert(std::endian::native == std::endian::little);
    Value value;
    std::memcpy(&value, some(sizeof value), sizeof value);
    return value;
  }
  /// The next `count` bytes.
  const char* some(std::size_t count) {
    if (count > bytes_.size() - at_) damaged();
    return bytes_.data() + std::exchange(at_, at_ + count);
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// A grain of the list, with its places in counts of this frame and of the one before.
struct Known {
  std::int64_t id;
  int lot;
  double radius;
  std::array<std::int32_t, 7> last{}, before{};
  int frames = 0;  // of this block
};

std::vector<double>& field_of(Snapshot& bed, const std::string& name) {
  const std::array<std::pair<const char*, std::vector<double>*>, 8> fields{{{"x", &bed.x},
                                                                            {"y", &bed.y},
                                                                            {"z", &bed.z},
                                                                            {"angle", &bed.angle},
                                                                            {"qw", &bed.q_w},
                                                                            {"qx", &bed.q_x},
                                                                            {"qy", &bed.q_y},
                                                                            {"qz", &bed.q_z}}};
  for (const auto& [known, values] : fields)
    if (name == known) return *values;
  damaged();
}

class Block {
 public:
  Block(std::string bytes, const Json& header)
      : bytes_(std::move(bytes)),
        vessels_(header.at("vessels").size()),
        fields_(header.at("fields").get<std::vector<std::string>>()),
        units_(header.at("field_units").get<std::vector<double>>()) {
    if (units_.size() != fields_.size() || fields_.size() > Known{}.last.size() || !has_places()) damaged();
    if (std::set<std::string>(fields_.begin(), fields_.end()).size() != fields_.size()) damaged();
    constexpr double most_unit = 1e3;
    for (const double unit : units_)
      if (!(unit > 0 && unit <= most_unit)) damaged();
  }

  Snapshot next() {
    Snapshot bed;
    bed.time = bytes_.take<double>();
    if (!std::isfinite(bed.time)) damaged();
    bytes_.some(vessels_ * 4 * sizeof(double));
    take_changes();
    for (const Known& grain : grains_)
      bed.id.push_back(grain.id), bed.lot.push_back(grain.lot), bed.radius.push_back(grain.radius);
    for (std::size_t f = 0; f < fields_.size(); ++f) take_places(f, field_of(bed, fields_[f]));
    for (Known& grain : grains_) ++grain.frames;
    return bed;
  }

  bool at_end() const { return bytes_.at_end(); }

 private:
  bool has_places() const { return fields_.size() >= 2 && fields_[0] == "x" && fields_[1] == "y"; }

  void take_changes() {
    const auto leaving = bytes_.take<std::uint32_t>(), entering = bytes_.take<std::uint32_t>(),
               present = bytes_.take<std::uint32_t>();
    std::vector<Known> staying;
    std::size_t from = 0;
    const auto keep_up_to = [&](std::size_t end) {
      if (end < from || end > grains_.size()) damaged();
      staying.insert(staying.end(), grains_.begin() + static_cast<std::ptrdiff_t>(from),
                     grains_.begin() + static_cast<std::ptrdiff_t>(end));
    };
    for (std::uint32_t k = 0; k < leaving; ++k) {
      const auto place = bytes_.take<std::uint32_t>();
      keep_up_to(place);
      from = place + std::size_t{1};
    }
    if (from <= grains_.size()) keep_up_to(grains_.size());
    grains_ = std::move(staying);
    for (std::uint32_t k = 0; k < entering; ++k) {
      Known grain{bytes_.take<std::uint32_t>(), bytes_.take<std::uint16_t>(), bytes_.take<float>()};
      bytes_.some(3 * sizeof(float));  // where it was first
      if (!(grain.radius > 0 && std::isfinite(grain.radius))) damaged();
      grains_.push_back(grain);
    }
    if (grains_.size() != present) damaged();
  }

  void take_places(std::size_t field, std::vector<double>& places) {
    const std::size_t count = grains_.size();
    const auto* planes = reinterpret_cast<const unsigned char*>(bytes_.some(4 * count));
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t coded = 0;
      for (std::size_t k = 0; k < 4; ++k) coded |= static_cast<std::uint32_t>(planes[k * count + i]) << (8 * k);
      Known& grain = grains_[i];
      const std::uint32_t last = static_cast<std::uint32_t>(grain.last[field]);
      const std::uint32_t expected =
          grain.frames > 1 ? 2 * last - static_cast<std::uint32_t>(grain.before[field]) : last;
      // Unsigned, since a damaged file's numbers may overflow.
      const auto now = static_cast<std::int32_t>(expected + ((coded >> 1) ^ (0U - (coded & 1U))));
      grain.before[field] = std::exchange(grain.last[field], now);
      places.push_back(now * units_[field]);
    }
  }

  Bytes bytes_;
  std::size_t vessels_;
  std::vector<std::string> fields_;
  std::vector<double> units_;
  std::vector<Known> grains_;
};

/// What the header says of a part of the file.
std::size_t place_in(const Json& part, const char* key) {
  return static_cast<std::size_t>(whole_number(part.at(key), 0, INT64_MAX));
}

}  // namespace

void read_recording(const std::string& file, const std::function<void(const Snapshot&)>& look) {
  if (file.size() < head_size || !file.starts_with("VBSWREC1")) throw InputError("this is no recording");
  try {
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + head_size - sizeof length, sizeof length);
    if (length > file.size() - head_size) damaged();
    const Json header = parse_json<Json>(file.substr(head_size, length));
    const std::size_t blocks = head_size + length;
    const auto check_whole = [&](const Json& part) {
      const auto offset = place_in(part, "offset"), size = place_in(part, "bytes");
      if (offset > file.size() - blocks || size > file.size() - blocks - offset) damaged();
    };
    for (const Json& contacts : header.value("contacts", Json::array())) check_whole(contacts);
    for (const char* map : {"map", "hopper_map"})
      if (header.contains(map)) check_whole(header[map]);
    std::size_t left = most_unpacked;
    std::int64_t frames_left = most_frames;
    for (const Json& block : header.at("blocks")) {
      check_whole(block);
      std::string bytes = unpacked(file.substr(blocks + place_in(block, "offset"), place_in(block, "bytes")), left);
      left -= bytes.size();
      Block frames(std::move(bytes), header);
      const std::int64_t count = whole_number(block.at("frames"), 0, frames_left);
      frames_left -= count;
      for (std::int64_t k = 0; k < count; ++k) look(frames.next());
      if (!frames.at_end()) damaged();
    }
  } catch (const Json::exception&) {
    damaged();
  }
}

}  // namespace vibrosow
