// Checkpoints. The bytes are edits of a good one, which is made afresh, so that a corpus outlives the versions of a
// state: four each, the place (two of them), what is done there and with what. Tried as it then is, and with its
// checksum made right, since no fuzzer would guess that. A state so made is not run: no accident makes one.

#include <boost/crc.hpp>
#include <cstdint>

#include "fuzz/edits.hpp"
#include "fuzz/try_bytes.hpp"
#include "scene/input_error.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

/// Of "vibrosow checkpoint\n", a byte that says how numbers are laid out, and the version.
constexpr std::size_t checksum_at = 20 + 1 + 4, body_at = checksum_at + 4;

std::string with_right_checksum(std::string bytes) {
  if (bytes.size() < body_at) return bytes;
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data() + body_at, bytes.size() - body_at);
  const std::uint32_t sum = crc.checksum();
  for (std::size_t i = 0; i < 4; ++i) bytes[checksum_at + i] = static_cast<char>(sum >> (8 * i));
  return bytes;
}

Model small_model() {
  Scene scene;
  scene.lots = {{"a", 6e-3, 2e-4, Shape::ball, 0.6}, {"b", 5e-3, 1.2e-4, Shape::ball, 0.4}};
  scene.contact.shell_compression = 1e-3;
  scene.contact.seed = scene.contact.wall = {0.4, 0.5, 0.1, 0};
  scene.contact.friction_model = FrictionModel::spring;
  scene.contact.rolling = Rolling::spring;
  scene.tray.name = "tray";
  scene.tray.length = 0.04, scene.tray.height = 0.1;
  scene.tray.holes = {{0.02, 0.02, 0}};
  scene.tray.fill = Fill{20, Packing::layers, 1e-3, true};
  scene.tray.motion = HarmonicMotion{0.3, 4e-3, 12, 0.02};
  scene.record = Record{{0, 0.005}, 0.01};
  scene.run.duration = 0.1;
  return prepare(scene);
}

std::string good_checkpoint(const Model& model) {
  Simulation simulation(model, 1);
  while (simulation.time() < 0.05) simulation.steps(100);
  return save(model, simulation.state());
}

void restore_or_refuse(const Model& model, const std::string& bytes) {
  try {
    restore(model, bytes);
  } catch (const InputError&) {
  }
}

}  // namespace

void try_bytes(const std::string& bytes) {
  static const Model model = small_model();
  static const std::string good = good_checkpoint(model);
  const std::string checkpoint = edited(good, bytes);
  restore_or_refuse(model, checkpoint);
  restore_or_refuse(model, with_right_checksum(checkpoint));
}

}  // namespace vibrosow
