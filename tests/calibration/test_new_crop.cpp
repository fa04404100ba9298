#include "calibration/new_crop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/input_error.hpp"
#include "support/made_up_atlas.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;

/// Balls of 2 mm and 1200 kg/m3.
NewCrop balls() {
  NewCrop crop;
  crop.name = "balls";
  crop.length = crop.width = crop.thickness = 2e-3;
  crop.mass = 1200 * std::numbers::pi / 6 * 8e-9;
  return crop;
}

TEST(NewCrop, BallsWithReposeAndBulkDensity) {
  NewCrop crop = balls();
  crop.angle_of_repose = 22 * degree;
  crop.bulk_density = 0.57 * 1200;
  const CropEstimate known = estimate(crop, plain_atlas());
  EXPECT_TRUE(known.is_ball());
  EXPECT_NEAR(known.seed_density, 1200, 1e-9);
  EXPECT_NEAR(known.packing.value(), 0.57, 1e-12);
  EXPECT_EQ(known.used.angle, crop.angle_of_repose);
  EXPECT_EQ(known.used.packing, known.packing);
  EXPECT_GT(known.band.friction.contraction, 0.1);
  EXPECT_THAT(known.doubts, IsEmpty());
  EXPECT_NEAR(known.shell_compression, 1e-5, 1e-20) << "0.0025 g r / V^2 is 1.9e-5; to one digit, down";
}

TEST(NewCrop, ElongatedSeedsAreOfTheirAspectRatio) {
  NewCrop crop = balls();
  crop.length = 3e-3;
  crop.angle_of_repose = 25 * degree;
  const CropEstimate known = estimate(crop, plain_atlas());
  EXPECT_NEAR(known.aspect_ratio, 1.5, 1e-12);
  ASSERT_EQ(known.doubts.size(), 1u);
  EXPECT_THAT(known.doubts[0], HasSubstr("balls alone"));
  crop.length = 2.1e-3;
  EXPECT_TRUE(estimate(crop, plain_atlas()).is_ball());
}

TEST(NewCrop, ABulkDensityThatCannotBeIsSaidAndLeftOut) {
  NewCrop crop = balls();
  for (const double packing : {0.8, 0.3}) {
    crop.bulk_density = packing * 1200;
    const CropEstimate known = estimate(crop, plain_atlas());
    EXPECT_FALSE(known.used.packing) << packing;
    ASSERT_EQ(known.doubts.size(), 1u) << packing;
    EXPECT_THAT(known.doubts[0], HasSubstr("is not right"));
  }
  crop.bulk_density = 0.73 * 1200;
  const CropEstimate dense = estimate(crop, plain_atlas());
  EXPECT_FALSE(dense.used.packing);
  ASSERT_EQ(dense.doubts.size(), 1u);
  EXPECT_THAT(dense.doubts[0], HasSubstr("left out of the band"));
}

TEST(NewCrop, WhatTheAtlasDoesNotReachIsRefused) {
  NewCrop crop = balls();
  crop.angle_of_repose = 57 * degree;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("--repose: 57 degree"), HasSubstr("stick"))));
  crop.angle_of_repose = 5 * degree;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); }, ThrowsMessage<InputError>(HasSubstr("--repose: 5 degree")));
  crop = balls();
  crop.length = 11e-3;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); },
              ThrowsMessage<InputError>(HasSubstr("--length: a seed of 11 x 2 x 2 mm is too slender")));
  crop.length = 5e-3, crop.width = 4e-3, crop.thickness = 0.9e-3;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); }, ThrowsMessage<InputError>(HasSubstr("too thin")));
  crop.width = 5e-3, crop.thickness = 3e-3;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); }, ThrowsMessage<InputError>(HasSubstr("--width")));
}

TEST(NewCrop, LongerSeedsThanTheAtlasHasAreTakenForItsLongestAndDoubted) {
  NewCrop crop = balls();
  crop.length = 6e-3;
  crop.angle_of_repose = 25 * degree;
  const CropEstimate known = estimate(crop, plain_atlas());
  EXPECT_NEAR(known.aspect_ratio, 3, 1e-12);
  EXPECT_EQ(known.aspect_ratio_in_atlas, 2);
  ASSERT_EQ(known.doubts.size(), 2u);
  EXPECT_THAT(known.doubts[0], HasSubstr("3 times as long as thick and the atlas goes up to 2"));
  crop.length = 4e-3;
  EXPECT_EQ(known.band.friction.mean, estimate(crop, plain_atlas()).band.friction.mean);
}

TEST(NewCrop, SizesOutOfOrderAndImpossibleWeightsAreRefused) {
  NewCrop crop = balls();
  crop.width = 3e-3;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); },
              ThrowsMessage<InputError>(HasSubstr("--width: 3 mm is more than the length")));
  crop = balls();
  crop.thickness = 2.5e-3;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); }, ThrowsMessage<InputError>(HasSubstr("--thickness")));
  crop = balls();
  crop.mass *= 10;
  EXPECT_THAT([&] { estimate(crop, plain_atlas()); }, ThrowsMessage<InputError>(HasSubstr("--tkw")));
}

}  // namespace
}  // namespace vibrosow
