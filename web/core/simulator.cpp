// What a page's worker calls: one simulation in the plane at a time. Texts are JSON; a text or an array that is
// returned stays until the next call of the same function.
#include <emscripten/emscripten.h>

#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outflow/outflow.hpp"
#include "plan/scene_warnings.hpp"
#include "report/page.hpp"
#include "report/run_page.hpp"
#include "scene/measuring_window.hpp"
#include "scene/scene_json.hpp"
#include "simulation/live_run.hpp"

namespace {

using namespace vibrosow;
using Json = nlohmann::ordered_json;

std::optional<LiveRun> live;

const Simulation& simulation() {
  return live->simulation();
}

std::string_view waiting() {
  switch (live->waiting()) {
    case LiveRun::Waiting::for_nothing:
      return "";
    case LiveRun::Waiting::for_motion:
      return "motion";
    case LiveRun::Waiting::for_holes:
      return "holes";
    case LiveRun::Waiting::given_up:
      return "given up";
  }
  return "";
}

/// Number of each tray's hole, since the last change; first the seeds that passed none.
std::vector<std::int64_t> counted() {
  std::vector<std::int64_t> counts(simulation().model().scene.tray.holes.size() + 1);
  for (const OutflowEvent& event : simulation().events_since(0)) ++counts[static_cast<std::size_t>(event.hole)];
  return counts;
}

Json state() {
  const Walls& walls = simulation().field().walls();
  Json vessels = Json::array();
  for (std::size_t v = 0; v < simulation().model().vessels.size(); ++v) {
    const Pose pose = walls.pose(v, simulation().time());
    vessels.push_back({{"x_m", pose.displacement.x()}, {"y_m", pose.displacement.y()}, {"angle_rad", pose.angle}});
  }
  const std::vector<std::int64_t> counts = counted();
  return {{"time_s", simulation().time()}, {"grains", simulation().grains().size()},
          {"vessels", std::move(vessels)}, {"counted", std::vector(counts.begin() + 1, counts.end())},
          {"spilled", counts.front()},     {"changes", live->changes()},
          {"waiting", waiting()}};
}

Json opened() {
  const Model& model = simulation().model();
  return {{"grains", simulation().grains().size()},
          {"holes", model.scene.tray.holes.size()},
          {"duration_s", model.scene.run.duration},
          {"since_s", live->since()},
          {"measure_from_s", measuring_window(model.scene).from},
          {"time_step_s", model.step.dt},
          {"steps", model.step.steps},
          {"remarks", page_remarks(remarks_about(model.scene))},
          {"lots", page_lots(model.scene)},
          {"vessels", page_vessels(model.scene)},
          {"state", state()}};
}

/// The text of what `make` gives; {"error": ..} where it throws.
template <class Make>
const char* text_of(std::string& kept, Make make) {
  try {
    kept = make();
  } catch (const std::exception& error) {
    kept = page_text({{"error", error.what()}});
  }
  return kept.c_str();
}

}  // namespace

extern "C" {

/// Begins anew with a scene (canonical JSON). Its "error" says why not: a scene that cannot be read or run, or is in
/// space.
EMSCRIPTEN_KEEPALIVE const char* open_scene(const char* json, unsigned random_seed) {
  static std::string text;
  return text_of(text, [&] {
    live.reset();
    const Scene scene = scene_from_json(json);
    if (scene.space != Space::two_dimensional) throw std::invalid_argument("a page simulates in the plane alone");
    live.emplace(scene, random_seed);
    return page_text(opened());
  });
}

/// Takes the run that goes on to another scene (canonical JSON). "restarts": what keeps it from that (`Obstacle`), or
/// empty; "state" says whether it still waits, and how many changes it has taken up.
EMSCRIPTEN_KEEPALIVE const char* change_scene(const char* json) {
  static std::string text;
  return text_of(text, [&] {
    const std::optional<Obstacle> obstacle = live->change(scene_from_json(json));
    return page_text({{"restarts", obstacle ? name_of(*obstacle) : ""}, {"state", state()}});
  });
}

/// What `open_scene` says, of the run as it is since its last change.
EMSCRIPTEN_KEEPALIVE const char* opened_now() {
  static std::string text;
  return text_of(text, [] { return page_text(opened()); });
}

/// Steps until `until` (s), the end, or for about so many milliseconds. 1: the run has ended; 0: it has not.
EMSCRIPTEN_KEEPALIVE int advance(double until, double milliseconds) {
  constexpr std::int64_t grain_steps_between_looks = 20000;  // some millisecond
  // emscripten_get_now() counts in 32 bits of microseconds here, which are full after 2.1 s.
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double, std::milli>(milliseconds);
  std::int64_t grain_steps = 0;
  while (simulation().time() < until) {
    if (simulation().at_end() || !live->step()) return 1;
    grain_steps += static_cast<std::int64_t>(simulation().grains().size());
    if (grain_steps < grain_steps_between_looks) continue;
    grain_steps = 0;
    if (std::chrono::steady_clock::now() >= end) break;
  }
  return simulation().at_end() ? 1 : 0;
}

/// Time, number of grains, places of the vessels and counts now.
EMSCRIPTEN_KEEPALIVE const char* state_now() {
  static std::string text;
  return text_of(text, [] { return page_text(state()); });
}

/// Of all grains x (m), then y (m), angle (rad), radius (m), speed (m/s) and lot.
EMSCRIPTEN_KEEPALIVE const float* grains_now() {
  static std::vector<float> values;
  values.clear();
  const Grains& grains = simulation().grains();
  const std::size_t n = grains.size();
  const auto add = [n](auto value) {
    for (std::size_t i = 0; i < n; ++i) values.push_back(static_cast<float>(value(i)));
  };
  add([&](std::size_t i) { return grains.x[i]; });
  add([&](std::size_t i) { return grains.y[i]; });
  add([&](std::size_t i) { return grains.oriented ? grains.angle[i] : 0.0; });
  add([&](std::size_t i) { return grains.kind(i).radius; });
  add([&](std::size_t i) { return std::hypot(grains.vx[i], grains.vy[i]); });
  add([&](std::size_t i) { return grains.lot[i]; });
  return values.data();
}

/// What a run's page says of the run so far (run_page_data).
EMSCRIPTEN_KEEPALIVE const char* outcome() {
  static std::string text;
  return text_of(text, [] {
    const Run run = simulation().result();
    const Scene& scene = simulation().model().scene;
    Outflow outflow = measure_outflow(scene, run);
    put_first(scene_warnings(scene), outflow);
    const std::optional<DrillMetrics> drill;
    const std::string expected;  // of trays in space alone
    return run_page_data({simulation().model(), run, outflow, drill, expected});
  });
}
}
