#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "scene/input_error.hpp"
#include "scenes/drawn_scene.hpp"
#include "simulation/simulation.hpp"

namespace vibrosow {

inline void showValue(const DrawnScene& drawn, std::ostream& out) {
  out << drawn.told();
}

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

inline rc::Gen<DrawnScene> any_scene() {
  return [](const rc::Random& random, int) {
    rc::Random numbers = random;
    return rc::shrinkable::shrinkRecur(DrawnScene(numbers.next()),
                                       [](const DrawnScene& scene) { return rc::seq::fromContainer(scene.plainer()); });
  };
}

/// `wrong`: what is wrong with a scene; empty: nothing. Of so many seeders drawn over all features at once, times
/// VIBROSOW_SCENES_TIMES; VIBROSOW_SCENES_SEED says which. What fails is made as plain as it goes and printed as TOML.
template <class Wrong>
void expect_of_drawn_scenes(int cases, Wrong wrong) {
  rc::detail::TestParams params;
  params.seed = from_environment("VIBROSOW_SCENES_SEED", 20261127);
  params.maxSuccess = cases * static_cast<int>(from_environment("VIBROSOW_SCENES_TIMES", 1));
  const auto result = rc::detail::checkTestable(
      [&] {
        const DrawnScene drawn = *any_scene();
        const std::string text = wrong(drawn);
        if (!text.empty()) RC_FAIL(text);
      },
      rc::detail::TestMetadata{}, params);
  std::ostringstream told;
  rc::detail::printResultMessage(result, told);
  EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << told.str();
}

/// What is thrown at the user, without the place in the file; empty: nothing.
template <class Do>
std::string refusal(Do act) {
  try {
    act();
    return "";
  } catch (const InputError& error) {
    const std::string text = error.what();
    const auto after = text.find(": ");
    return text.starts_with(DrawnScene::path()) || text.starts_with("--set") ? text.substr(after + 2) : text;
  }
}

/// None where it is refused.
inline std::optional<Scene> scene_of(const DrawnScene& drawn) {
  try {
    return drawn.read();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The scene and the state that a run of it begins with; none where it is refused.
struct RunStart {
  Model model;
  SimulationState state;
};
inline std::optional<RunStart> start_of(const DrawnScene& drawn) {
  const std::optional<Scene> scene = scene_of(drawn);
  if (!scene) return std::nullopt;
  try {
    Model model = prepare_to_run(*scene);
    SimulationState state = starting_state(model, 1);
    return RunStart{std::move(model), std::move(state)};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

inline std::vector<Vessel> vessels_of(const Scene& scene) {
  std::vector<Vessel> vessels{scene.tray};
  if (scene.hopper) vessels.push_back(*scene.hopper);
  return vessels;
}

}  // namespace vibrosow
