#include "input/read_crop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/input_error.hpp"
#include "scene/si_units.hpp"
#include "temporary_file.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

Crop crop_of(const std::string& lines) {
  const TemporaryFolder folder;
  return read_crop(folder.write("my-crop.toml", lines));
}

TEST(ReadCrop, TellsSizeMassAndBulk) {
  const Crop crop = crop_of(
      "title = 'Mine'\nshape = 'elongated'\nlength = '6 mm'\nwidth = '3 mm'\nthickness = '2.5 mm'\n"
      "thousand_grain_weight = '45 g'\nbulk_density = '780 kg/m3'\nangle_of_repose = '28 degree'\nmoisture = '12 %'\n"
      "[reference]\ntrue_density = '1300 kg/m3'\n[sources]\nlength = 'measured'\n'reference.true_density' = 'weighed'");
  EXPECT_EQ(crop.name, "my-crop");
  EXPECT_EQ(crop.title, "Mine");
  EXPECT_EQ(crop.shape, "elongated");
  EXPECT_DOUBLE_EQ(crop.length, 6e-3);
  EXPECT_DOUBLE_EQ(crop.width, 3e-3);
  EXPECT_DOUBLE_EQ(crop.thickness, 2.5e-3);
  EXPECT_DOUBLE_EQ(crop.mass, 45e-6);
  EXPECT_DOUBLE_EQ(crop.bulk.bulk_density.value(), 780);
  EXPECT_DOUBLE_EQ(crop.bulk.angle_of_repose.value(), 28 * degree);
  EXPECT_DOUBLE_EQ(crop.bulk.moisture.value(), 0.12);
  EXPECT_DOUBLE_EQ(crop.reference.true_density.value(), 1300);
  EXPECT_EQ(crop.sources.at("length"), "measured");
  EXPECT_EQ(crop.sources.at("reference.true_density"), "weighed");
}

TEST(ReadCrop, TellsWhatOtherSourcesSay) {
  const std::string ball = "diameter = '2 mm'\nmass = '5 mg'\n[reference]\n";
  const Reference told =
      crop_of(ball +
              "bulk_density_range = ['690 kg/m3', '0.78 g/cm3']\nangle_of_repose_range = ['25 degree', '29 degree']\n"
              "angle_of_repose_method = 'drained'")
          .reference;
  EXPECT_DOUBLE_EQ(told.bulk_density.value()[0], 690);
  EXPECT_DOUBLE_EQ(told.bulk_density.value()[1], 780);
  EXPECT_DOUBLE_EQ(told.angle_of_repose.value()[1], 29 * degree);
  EXPECT_EQ(told.angle_of_repose_method.value(), "drained");
  for (const char* wrong : {"bulk_density_range = ['780 kg/m3', '690 kg/m3']", "bulk_density_range = '780 kg/m3'",
                            "angle_of_repose_range = ['25 degree', '95 degree']", "angle_of_repose_method = 'dropped'"})
    EXPECT_THAT([&] { crop_of(ball + wrong); }, ThrowsMessage<InputError>(HasSubstr("my-crop.toml:4: reference.")))
        << wrong;
}

TEST(ReadCrop, ABallIsAsWideAndThickAsLong) {
  const Crop crop = crop_of("diameter = '2 mm'\nmass = '5 mg'");
  EXPECT_EQ(crop.title, "my-crop") << "of its file";
  EXPECT_EQ(crop.shape, "ball");
  for (const double size : {crop.length, crop.width, crop.thickness}) EXPECT_DOUBLE_EQ(size, 2e-3);
  EXPECT_DOUBLE_EQ(crop.mass, 5e-6);
  EXPECT_FALSE(crop.bulk.bulk_density || crop.bulk.angle_of_repose || crop.bulk.moisture ||
               crop.reference.true_density);
}

TEST(ReadCrop, ThicknessIsTheWidthWhereItIsNotGiven) {
  const Crop crop = crop_of("shape = 'drop'\nlength = '9 mm'\nwidth = '5 mm'\nmass = '60 mg'");
  EXPECT_DOUBLE_EQ(crop.thickness, 5e-3);
}

TEST(ReadCrop, WrongValuesAreNamed) {
  EXPECT_THAT([] { crop_of("diameter = '2 mm'\nmass = '5 mg'\nbulk_densty = '700 kg/m3'"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("my-crop.toml:3"), HasSubstr("bulk_density"))));
  EXPECT_THAT([] { crop_of("diameter = '2 mm'\nmass = '5 mg'\nangle_of_repose = '95 degree'"); },
              ThrowsMessage<InputError>(HasSubstr("my-crop.toml:3: angle_of_repose")));
  EXPECT_THAT([] { crop_of("diameter = '2 mm'\nthousand_grain_weight = '5'"); },
              ThrowsMessage<InputError>(HasSubstr("my-crop.toml:2: thousand_grain_weight")));
}

TEST(FindCrop, ByNameOrPath) {
  EXPECT_EQ(find_crop("rapeseed").name, "rapeseed");
  EXPECT_THAT([] { find_crop("rapseed"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("is not shipped"), HasSubstr("rapeseed"))));
  const TemporaryFolder folder;
  EXPECT_EQ(find_crop(folder.write("b.toml", "diameter = '2 mm'\nmass = '5 mg'").string()).name, "b");
  EXPECT_THROW(find_crop("nowhere/c.toml"), InputError);
}

}  // namespace
}  // namespace vibrosow
