#include "report/crop_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "../input/temporary_file.hpp"
#include "input/read_crop.hpp"
#include "input/read_scene.hpp"
#include "support/made_up_atlas.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double degree = std::numbers::pi / 180;

NewCrop oblong() {
  NewCrop crop;
  crop.name = "mine";
  crop.mass = 30e-6;
  crop.length = 5e-3, crop.width = 3.2e-3, crop.thickness = 3e-3;
  crop.bulk_density = 690;
  crop.angle_of_repose = 25 * degree;
  crop.moisture = 0.09;
  return crop;
}

TEST(CropFiles, AreReadBackAsTheCropThatWasMeasured) {
  const NewCrop crop = oblong();
  const TemporaryFolder folder;
  const Crop read = read_crop(folder.write("mine.toml", crop_toml(crop, estimate(crop, plain_atlas()))));
  EXPECT_EQ(read.shape, "elongated");
  EXPECT_DOUBLE_EQ(read.length, 5e-3);
  EXPECT_DOUBLE_EQ(read.thickness, 3e-3);
  EXPECT_NEAR(read.mass, 30e-6, 1e-15);
  EXPECT_DOUBLE_EQ(read.bulk.bulk_density.value(), 690);
  EXPECT_NEAR(read.bulk.angle_of_repose.value(), 25 * degree, 1e-9);
  EXPECT_NEAR(read.bulk.moisture.value(), 0.09, 1e-12);
  for (const char* key :
       {"length", "width", "thickness", "thousand_grain_weight", "bulk_density", "angle_of_repose", "moisture"})
    EXPECT_EQ(read.sources.at(key), "measured by the user") << key;
  EXPECT_THAT(read.sources.at("reference.true_density"), HasSubstr("computed"));
}

TEST(CropFiles, RunInASeederThatNamesThem) {
  const NewCrop crop = oblong();
  const CropEstimate known = estimate(crop, plain_atlas());
  const TemporaryFolder folder;
  folder.write("mine.toml", crop_toml(crop, known));
  folder.write("mine-contact.toml", contact_toml(crop, known));
  const Scene scene = read_scene(folder.write(
      "seeder.toml",
      "space = '3d'\n[seeds.a]\ncrop = 'mine.toml'\n[contact]\nmodel = 'mine-contact.toml'\n[tray]\nlength = '10 "
      "cm'\ndepth = '5 cm'\n"
      "height = '5 cm'\nfill = { count = 50 }\n[tray.holes]\ncount = 1\nwidth = '2 cm'\n[run]\nduration = '1 s'"));
  EXPECT_NEAR(scene.contact.seed.friction, known.band.fitting.friction, 1e-3);
  EXPECT_NEAR(scene.contact.seed.rolling_friction, known.band.fitting.rolling_friction, 1e-3);
  EXPECT_EQ(scene.contact.rolling, Rolling::spring);
  EXPECT_EQ(scene.contact.wall.friction, scene.contact.seed.friction);
  EXPECT_EQ(scene.contact.seed.restitution, 0.5);
  EXPECT_EQ(scene.lots[0].shape, Shape::clump);
}

TEST(CropFiles, SayWhereRunsOfTheCropRefinedThem) {
  ShippedAtlas atlas = plain_atlas();
  atlas.to_space.of_the_crop = true;
  const CropEstimate known = estimate(oblong(), atlas);
  EXPECT_THAT(contact_toml(oblong(), known), HasSubstr("refined by 4 runs of this crop in 3D"));
  EXPECT_THAT(crop_table(oblong(), known, atlas), HasSubstr("by 4 runs"));
  EXPECT_THAT(crop_table(oblong(), known, atlas), Not(HasSubstr("balls alone")));
}

TEST(CropFiles, ContactSaysWhatIsFromTheAtlasAndWhatIsAssumed) {
  NewCrop crop = oblong();
  const std::string measured = contact_toml(crop, estimate(crop, plain_atlas()));
  EXPECT_THAT(measured, HasSubstr("by the atlas of repose from a repose of 25 degree and a bulk density of 690 kg/m3"));
  EXPECT_THAT(measured, HasSubstr("\"wall.friction\" = \"assumed: as seed on seed; measure it on the tray's sheet\""));
  crop.angle_of_repose.reset();
  crop.bulk_density.reset();
  EXPECT_THAT(contact_toml(crop, estimate(crop, plain_atlas())),
              HasSubstr("friction = \"assumed: middle of the atlas"));
}

TEST(CropFiles, TheTableSaysWhatWasNotLearnt) {
  NewCrop crop = oblong();
  crop.bulk_density.reset();
  const CropEstimate known = estimate(crop, plain_atlas());
  const std::string table = crop_table(crop, known, plain_atlas());
  EXPECT_THAT(table, HasSubstr("not determined"));
  EXPECT_THAT(table, HasSubstr("doubtful: "));
  EXPECT_THAT(table, HasSubstr("the atlas, 840 runs"));
  EXPECT_THAT(table, HasSubstr("-2.9 +-"));
  EXPECT_THAT(contact_toml(crop, known), HasSubstr("\n# Doubtful: the atlas is in 2D"));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

}  // namespace
}  // namespace vibrosow
