#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "result/run.hpp"
#include "study/study.hpp"

namespace vibrosow {

/// A run that the page of a study is to replay.
struct WantedReplay {
  int layout;  // its number
  Scene scene;
  std::uint64_t random_seed;
};

/// What the page of a study replays: of layouts by their number (page_replay).
using Replays = std::map<int, nlohmann::ordered_json>;

/// What stands beside the recording of a run: its lots, holes and events.
nlohmann::ordered_json replay_data(const Scene& scene, const Run& run);

/// How many bytes the recording of one of so many replays may take, so that all of them together, with their data, take
/// less than 8 MB of a page.
std::size_t most_recording_bytes(std::size_t replays, const nlohmann::ordered_json& data);

/// The data with the recording (Recording::file) in it.
nlohmann::ordered_json page_replay(nlohmann::ordered_json data, const std::string& recording);

/// The command that runs a layout once and makes a page of that, in the folder of the study's seeder; for a shell.
std::string run_command_of(const Study& study, const Layout& layout, std::uint64_t random_seed);

}  // namespace vibrosow
