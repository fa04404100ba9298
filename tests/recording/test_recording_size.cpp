#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "input/override.hpp"
#include "input/read_scene.hpp"
#include "plan/model.hpp"
#include "recording/recording.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {
namespace {

nlohmann::json header_of(const std::string& file) {
  std::uint32_t size = 0;
  std::memcpy(&size, file.data() + 8, 4);
  return nlohmann::json::parse(file.substr(12, size));
}

// 2500 discs in 500 frames, with their contacts in some of these: 2.5 MB.
TEST(RecordingSize, IsAtMostTwoBytesADiscAndFrame) {
  const Scene scene = read_scene(std::string(VIBROSOW_SOURCE_DIR) + "/seeders/papers/paper-a-fig4-stiff.toml",
                                 {parse_override("accuracy=draft")});
  const Model model = prepare(scene);
  Simulation run(model, 1);
  Recording recording(model);
  std::size_t discs_in_frames = 0;
  const auto look = [&](Simulation& now) {
    recording.add(now);
    discs_in_frames += now.grains().size();
  };
  look(run);
  run.watch(frame_interval(model), look);
  while (!run.at_end()) run.step();

  const std::string file = recording.file();
  const nlohmann::json header = header_of(file);
  int frames = 0;
  for (const nlohmann::json& block : header["blocks"]) frames += block["frames"].get<int>();
  EXPECT_GE(frames, 500);
  EXPECT_GE(header["contacts"].size(), 40U);
  EXPECT_GE(discs_in_frames, 800'000U);
  EXPECT_LE(file.size(), 2 * discs_in_frames);
  RecordProperty("bytes", static_cast<int>(file.size()));
  RecordProperty("discs_in_frames", static_cast<int>(discs_in_frames));
}

}  // namespace
}  // namespace vibrosow
