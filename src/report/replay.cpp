#include "report/replay.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "report/base64.hpp"
#include "report/page.hpp"
#include "report/run_page.hpp"
#include "scene/measuring_window.hpp"
#include "scene/printable.hpp"

namespace vibrosow {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_bytes = 8000000;  // of a page, that replays take

/// What --set is given. A text stands as it is where it is read back as a text, otherwise as TOML.
std::string set_text(const Override& change) {
  if (!change.value) return change.key + '=';
  if (const auto* text = change.value->get<std::string>()) {
    std::string plain = fmt::format("{}={}", change.key, *text);
    const Override read = parse_override(plain);
    if (read.value && read.value->get<std::string>() && *read.value->get<std::string>() == *text) return plain;
  }
  return fmt::format("{}={}", change.key, toml_text(*change.value));
}

}  // namespace

Json replay_data(const Scene& scene, const Run& run) {
  Json holes = Json::array();
  for (int hole = 1; hole <= static_cast<int>(scene.tray.holes.size()); ++hole)
    holes.push_back({{"hole", hole}, {"counted_all", std::ranges::count(run.events, hole, &OutflowEvent::hole)}});
  return {{"random_seed", run.random_seed},
          {"end_time_s", run.end_time},
          {"measure_from_s", std::min(measuring_window(scene).from, run.end_time)},
          {"lots", page_lots(scene)},
          {"faces", page_faces(scene)},
          {"paths", page_paths(scene, run.end_time)},
          {"holes", std::move(holes)},
          {"events", page_events(run)}};
}

std::size_t most_recording_bytes(std::size_t replays, const Json& data) {
  const std::size_t share = most_bytes / std::max<std::size_t>(1, replays);
  constexpr std::size_t of_keys = 40;  // "replay", "recording" and what goes with them
  const std::size_t beside = page_text(data).size() + of_keys;
  return beside < share ? (share - beside) / 4 * 3 : 0;  // as base64 three bytes are four
}

Json page_replay(Json data, const std::string& recording) {
  data["recording"] = base64(recording);
  return data;
}

std::string run_command_of(const Study& study, const Layout& layout, std::uint64_t random_seed) {
  std::string text = "vibrosow run " + shell_quoted(study.base.filename().string());
  for (const Override& change : layout.overrides) text += " --set " + shell_quoted(set_text(change));
  if (random_seed != 1) text += fmt::format(" --random-seed {}", random_seed);
  return text + " --html";
}

}  // namespace vibrosow
