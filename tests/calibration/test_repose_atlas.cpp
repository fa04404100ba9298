#include "calibration/repose_atlas.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "../input/temporary_file.hpp"
#include "scene/input_error.hpp"
#include "support/made_up_atlas.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

ReposeAtlas linear_atlas() {
  return made_up_atlas([](double a, double f, double r) { return 0.1 * a + 0.3 * f + 0.5 * r; },
                       [](double a, double f, double r) { return 0.9 - 0.01 * a - 0.1 * f - 0.2 * r; });
}

TEST(ReposeAtlas, IsExactForWhatIsLinear) {
  const ReposeAtlas atlas = linear_atlas();
  for (const auto& [a, f, r] : {std::tuple(1.0, 0.1, 0.0), {1.0, 0.37, 0.12}, {1.7, 0.55, 0.29}, {2.0, 1.0, 0.3}}) {
    const AtlasMetrics metrics = atlas.at(a, f, r);
    EXPECT_NEAR(metrics.angle.mean, 0.1 * a + 0.3 * f + 0.5 * r, 1e-12);
    EXPECT_NEAR(metrics.packing.mean, 0.9 - 0.01 * a - 0.1 * f - 0.2 * r, 1e-12);
    EXPECT_NEAR(metrics.discharge.mean, 0.7, 1e-12);
    EXPECT_NEAR(metrics.angle.error, 0.02 / 2, 1e-12) << "of a mean of 4 runs";
  }
}

TEST(ReposeAtlas, RefusesWhatLiesOutside) {
  const ReposeAtlas atlas = linear_atlas();
  EXPECT_THROW(atlas.at(1, 0.05, 0.1), std::out_of_range);
  EXPECT_THROW(atlas.at(1, 1.01, 0.1), std::out_of_range);
  EXPECT_THROW(atlas.at(1, 0.5, 0.31), std::out_of_range);
  EXPECT_THROW(atlas.at(2.1, 0.5, 0.1), std::out_of_range);
}

TEST(ReposeAtlas, GapsAndLonelyRunsAreNamed) {
  std::vector<AtlasPoint> points = linear_atlas().points();
  points[5].runs = 1;
  EXPECT_THAT([&] { ReposeAtlas atlas(points); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("friction 0.1"), HasSubstr("rolling friction 0.25"),
                                              HasSubstr("less than two runs"))));
  points.erase(points.begin() + 5);
  EXPECT_THAT([&] { ReposeAtlas atlas(points); }, ThrowsMessage<InputError>(HasSubstr("is missing")));
}

TEST(ReposeAtlas, APointIsTheMeanAndScatterOfItsRuns) {
  Scene scene;
  scene.lots.resize(1);
  scene.contact.seed.friction = 0.4;
  scene.contact.seed.rolling_friction = 0.1;
  const AtlasPoint point = atlas_point(scene, {{0.4, 0.80, 0.6}, {0.6, 0.82, 0.8}, {std::nullopt, 0.84, std::nullopt}});
  EXPECT_EQ(point.aspect_ratio, 1);
  EXPECT_EQ(point.friction, 0.4);
  EXPECT_EQ(point.rolling_friction, 0.1);
  EXPECT_EQ(point.runs, 2);
  EXPECT_EQ(point.clogged, 1);
  EXPECT_DOUBLE_EQ(point.angle.mean, 0.5);
  EXPECT_NEAR(point.angle.scatter, std::numbers::sqrt2 / 10, 1e-12);
  EXPECT_NEAR(point.packing.mean, 0.82, 1e-12);
  EXPECT_NEAR(point.packing.scatter, 0.02, 1e-12);
  EXPECT_NEAR(point.discharge.mean, 0.7, 1e-12);
}

TEST(ReposeAtlas, AFileGivesThePointsBack) {
  const std::vector<AtlasPoint> points = linear_atlas().points();
  const TemporaryFolder folder;
  const std::vector<AtlasPoint> read = read_atlas_points(folder.write("atlas.csv", atlas_csv(points)));
  ASSERT_EQ(read.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(read[k].friction, points[k].friction, 1e-4);
    EXPECT_NEAR(read[k].angle.mean, points[k].angle.mean, 1e-3 * points[k].angle.mean);
    EXPECT_NEAR(read[k].packing.scatter, points[k].packing.scatter, 1e-6);
    EXPECT_EQ(read[k].runs, points[k].runs);
  }
}

TEST(ReposeAtlas, WrongFilesAreNamed) {
  const TemporaryFolder folder;
  const std::string text = atlas_csv(linear_atlas().points());
  EXPECT_THAT([&] { read_atlas_points(folder.write("a.csv", "friction,runs\n1,2\n")); },
              ThrowsMessage<InputError>(HasSubstr("a.csv:1: there is no column aspect_ratio")));
  std::string broken = text;
  broken.replace(broken.find("\n1,0.1,0,4") + 7, 1, "x");
  EXPECT_THAT([&] { read_atlas_points(folder.write("b.csv", broken)); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("b.csv:2"), HasSubstr("is not a number"))));
}

TEST(PlaneToSpace, IsTheMeanDifferenceAndItsScatter) {
  const ReposeAtlas plane = linear_atlas();
  std::vector<AtlasPoint> space;
  for (const auto& [friction, offset, factor] :
       {std::tuple(0.2, -0.02, 0.70), {0.5, -0.04, 0.71}, {0.8, -0.06, 0.72}}) {
    const AtlasMetrics flat = plane.at(1, friction, 0.1);
    space.push_back({1,
                     friction,
                     0.1,
                     4,
                     0,
                     {flat.angle.mean + offset, 0.01},
                     {flat.packing.mean * factor, 0.01},
                     {0.7 * 0.8, 0.01}});
  }
  const PlaneToSpace to_space = plane_to_space(plane, space);
  EXPECT_EQ(to_space.materials, 3);
  EXPECT_NEAR(to_space.angle_offset.mean, -0.04, 1e-12);
  EXPECT_NEAR(to_space.angle_offset.scatter, 0.02, 1e-12);
  EXPECT_NEAR(to_space.packing_factor.mean, 0.71, 1e-12);
  EXPECT_NEAR(to_space.discharge_factor.mean, 0.8, 1e-12);
  space.pop_back();
  EXPECT_THROW(plane_to_space(plane, space), InputError);
}

TEST(ShippedAtlas, CoversItsRange) {
  const ShippedAtlas shipped = shipped_atlas();
  const ReposeAtlas& atlas = shipped.atlas;
  EXPECT_EQ(atlas.runs(), 2040);
  EXPECT_EQ(atlas.points().size(), 60 * atlas.aspect_ratios().size());
  for (const AtlasPoint& point : atlas.points()) EXPECT_GE(point.runs + point.clogged, 8);
  EXPECT_EQ(atlas.aspect_ratios(), (std::vector<double>{1, 1.5, 2.2}));
  EXPECT_EQ(atlas.frictions().front(), 0.1);
  EXPECT_EQ(atlas.frictions().back(), 1);
  EXPECT_EQ(atlas.rolling_frictions().front(), 0);
  EXPECT_EQ(atlas.rolling_frictions().back(), 0.3);
  EXPECT_GE(shipped.to_space.materials, 4);
}

TEST(ShippedAtlas, RougherSeedsStandSteeperAndLieLooser) {
  const ReposeAtlas atlas = shipped_atlas().atlas;
  for (const double aspect : atlas.aspect_ratios()) {
    const AtlasMetrics smooth = atlas.at(aspect, 0.1, 0), rough = atlas.at(aspect, 1, 0.3);
    EXPECT_GT(rough.angle.mean - smooth.angle.mean, 4 * (rough.angle.error + smooth.angle.error)) << aspect;
    EXPECT_GT(smooth.packing.mean - rough.packing.mean, 4 * (rough.packing.error + smooth.packing.error)) << aspect;
  }
}

}  // namespace
}  // namespace vibrosow
