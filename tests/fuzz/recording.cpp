// Recordings. The bytes are edits: of the file, and of a block's frames, which are then packed anew.

#include <zlib.h>

#include <cstdint>

#include "fuzz/edits.hpp"
#include "fuzz/try_bytes.hpp"
#include "recording/read_recording.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Two grains, which the second frame leaves where they are.
std::string good_frames() {
  std::string bytes;
  for (int frame = 0; frame < 2; ++frame) {
    for (int k = 0; k < 5; ++k) append(bytes, 0.25 * frame);  // the time, and where the tray is
    for (const std::uint32_t count : {0U, frame == 0 ? 2U : 0U, 2U}) append(bytes, count);
    for (std::uint32_t id = 0; frame == 0 && id < 2; ++id) {
      append(bytes, id), append(bytes, std::uint16_t{0}), append(bytes, 1e-3F);
      for (int k = 0; k < 3; ++k) append(bytes, 0.0F);
    }
    bytes.append(sizeof(std::int32_t) * 2 * 2, '\0');
  }
  return bytes;
}

std::string file_of(const std::string& frames) {
  std::string packed(compressBound(static_cast<uLong>(frames.size())), '\0');
  uLongf size = static_cast<uLongf>(packed.size());
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(frames.data()),
           static_cast<uLong>(frames.size()));
  packed.resize(size);
  const std::string header =
      R"({"vessels":["tray"],"fields":["x","y"],"field_units":[1e-5,1e-5],"blocks":[{"frames":2,"offset":0,"bytes":)" +
      std::to_string(packed.size()) + "}]}";
  std::string file = "VBSWREC1";
  append(file, static_cast<std::uint32_t>(header.size()));
  return file + header + packed;
}

void read_or_refuse(const std::string& file) {
  try {
    read_recording(file, [](const Snapshot&) {});
  } catch (const InputError&) {
  }
}

}  // namespace

void try_bytes(const std::string& bytes) {
  static const std::string frames = good_frames(), file = file_of(frames);
  read_or_refuse(edited(file, bytes));
  read_or_refuse(file_of(edited(frames, bytes)));
}

}  // namespace vibrosow
