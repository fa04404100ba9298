#include "plan/fill_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "grains/fill_height.hpp"
#include "grains/packing.hpp"
#include "plan/model.hpp"
#include "scene/make_clump.hpp"
#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

class FillWarnings : public testing::TestWithParam<Space> {
 protected:
  static Scene box() {
    Scene scene;
    scene.space = GetParam();
    scene.lots = {{"a", 4e-3, 4e-5, Shape::ball, 1.0}};
    scene.tray.name = "tray";
    scene.tray.origin = {0.3, 0.2};
    scene.tray.length = 0.1, scene.tray.height = 0.09;
    if (scene.space == Space::three_dimensional) scene.tray.depth = 0.02;
    return scene;
  }
  /// The scene with its tray filled to a height (m), which is where its count comes from.
  static std::vector<std::string> filled(Scene scene, double height, const std::string& key = "tray.fill.height") {
    scene.tray.fill = Fill{1};
    scene.tray.fill->where = "a.toml:3: " + key;
    scene.tray.fill->count = static_cast<int>(std::round(seeds_to_height(scene.tray, scene.lots, scene.space, height)));
    const LawTraits& law = traits_of(scene.contact.law);
    const bool clumps = scene.lots[0].shape == Shape::clump;
    Grains grains(grain_kinds(scene.lots, seed_materials(scene.contact, scene.lots), law), false, true, clumps);
    grains.is_3d = scene.space == Space::three_dimensional;
    Random random(1);
    const Pose pose = vessel_pose(scene.tray, 0);
    for (const PackedGrain& packed : pack(scene.tray, scene.lots, scene.space, random))
      grains.add(point_in_lab(scene.tray, pose, {packed.x, packed.y, packed.z}), Eigen::Vector3d::Zero(), packed.lot,
                 grains.kinds.front(), packed.turned);
    return fill_warnings(scene, grains);
  }
};
INSTANTIATE_TEST_SUITE_P(Spaces, FillWarnings, testing::Values(Space::two_dimensional, Space::three_dimensional),
                         [](const auto& info) { return info.param == Space::two_dimensional ? "plane" : "space"; });

TEST_P(FillWarnings, ALevelBedOfBallsHasNone) {
  for (const double height : {0.004, 0.006, 0.02, 0.04}) EXPECT_THAT(filled(box(), height), IsEmpty()) << height;
  Scene tilted = box();
  tilted.tray.tilt = 0.2;
  EXPECT_THAT(filled(tilted, 0.02), IsEmpty());
  Scene slope = box();
  slope.tray.pieces = {{.a = {0, 0.03}, .b = {0.06, 0}}};
  EXPECT_THAT(filled(slope, 0.04), IsEmpty()) << "less room below than above";
}

TEST_P(FillWarnings, SeedsThatHeapUpOnABlockLieHigher) {
  Scene block = box();
  for (const auto& [a, b] : {std::pair(Eigen::Vector2d(0.03, 0), Eigen::Vector2d(0.03, 0.03)),
                             std::pair(Eigen::Vector2d(0.03, 0.03), Eigen::Vector2d(0.07, 0.03)),
                             std::pair(Eigen::Vector2d(0.07, 0.03), Eigen::Vector2d(0.07, 0))})
    block.tray.pieces.push_back({.a = a, .b = b});
  EXPECT_THAT(filled(block, 0.02),
              ElementsAre(MatchesRegex("tray.fill.height: the [0-9]+ seeds, as poured, lie some [3-4][0-9.]* mm high "
                                       "instead of (19.9|20|20.1) mm: .*")));
  EXPECT_THAT(filled(block, 0.02, "tray.fill.count"), IsEmpty()) << "no height was asked for";
}

}  // namespace
}  // namespace vibrosow
