// The seeders to start from are sound: nothing to warn of, a step that is taken, overlaps that are small.

#include <gtest/gtest.h>

#include <filesystem>

#include "input/read_scene.hpp"
#include "plan/model.hpp"
#include "plan/scene_warnings.hpp"

namespace vibrosow {
namespace {

TEST(ShippedSeeders, ThoseToStartFromAreSound) {
  int seeders = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data_directory() / "seeders")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    const Model model = prepare(read_scene(entry.path()));
    for (const std::string& warning : scene_warnings(model.scene)) ADD_FAILURE() << warning;
    EXPECT_FALSE(step_refused(model.scene.numerics, model.step));
    EXPECT_LE(model.overlap.overlap_at_rest, model.scene.guard.warn_relative_overlap);
    EXPECT_LE(model.overlap.overlap_at_impact, 2 * model.scene.guard.warn_relative_overlap) << "predicted at worst";
    ++seeders;
  }
  EXPECT_GE(seeders, 15);
}

}  // namespace
}  // namespace vibrosow
