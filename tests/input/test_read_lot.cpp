#include "input/read_lot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "input/read_scene.hpp"
#include "scene/clump_body.hpp"
#include "scene/clump_shape.hpp"
#include "scene/input_error.hpp"
#include "scene/seed_lot.hpp"
#include "temporary_file.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Kind = SizeDistribution::Kind;

/// The lot with the given lines in its table; every key must be known.
SeedLot lot_of(const std::string& lines, Space space = Space::two_dimensional) {
  const TemporaryFolder folder;
  Table root(Document::read(folder.write("seeder.toml", lines)));
  SeedLot lot = read_lot(root, "a", space);
  root.reject_unknown_keys();
  return lot;
}

TEST(ReadLot, ElongatedFromLengthAndWidth) {
  const SeedLot lot = lot_of("shape = 'elongated'\nlength = '7 mm'\nwidth = '3 mm'\nmass = '30 mg'");
  EXPECT_EQ(lot.shape, Shape::clump);
  EXPECT_NEAR(lot.diameter, 7e-3, 1e-15);
  EXPECT_EQ(lot.mass, 3e-5);
  EXPECT_EQ(lot.discs.size(), elongated(7e-3, 3e-3).size());
  const Plate plate = plate_of(lot.discs);
  EXPECT_NEAR(plate.centre.norm(), 0, 1e-15);
  EXPECT_DOUBLE_EQ(lot.gyration2, plate.gyration2);
  EXPECT_NEAR(lot.gyration2, (3.5e-3 * 3.5e-3 + 1.5e-3 * 1.5e-3) / 4, 0.05 * lot.gyration2) << "near the ellipse's";
  EXPECT_EQ(lot.sizes.kind, Kind::single);
}

TEST(ReadLot, ThicknessIsToBeRightIn2DToo) {
  const std::string seed = "shape = 'elongated'\nlength = '7 mm'\nwidth = '3 mm'\nmass = '30 mg'\n";
  EXPECT_EQ(lot_of(seed + "thickness = '2.5 mm'").discs, lot_of(seed).discs);
  EXPECT_THROW(lot_of(seed + "thickness = '5 apples'"), InputError);
  EXPECT_THROW(lot_of(seed + "thickness = '5 mm'"), InputError);
}

TEST(ReadLot, AThousandGrainWeightByItsShortNameIsNamed) {
  EXPECT_THAT([] { lot_of("diameter = '4 mm'\ntkw = '190 g'"); },
              ThrowsMessage<InputError>(HasSubstr("tkw: is written thousand_grain_weight")));
}

TEST(ReadLot, KnowsTheDensityOfItsCropWhereItHasAnother) {
  EXPECT_FALSE(lot_of("crop = 'pea'").crop.seed_density);
  const SeedLot crop = lot_of("crop = 'pea'"), heavy = lot_of("crop = 'pea'\nthousand_grain_weight = '400 g'");
  EXPECT_EQ(heavy.crop.seed_density, seed_density(crop));
  EXPECT_EQ(lot_of("crop = 'pea'\ndiameter = '5 mm'").crop.seed_density, seed_density(crop));
}

TEST(ReadLot, ACropThatNamesItselfEnds) {
  const TemporaryFolder folder;
  folder.write("self.toml", "crop = 'self.toml'\ndiameter = '4 mm'\nmass = '40 mg'");
  Table root(Document::read(folder.write("seeder.toml", "crop = 'self.toml'\nmass = '60 mg'")));
  EXPECT_FALSE(read_lot(root, "a", Space::two_dimensional).crop.seed_density);
}

TEST(ReadLot, DropsHoldingCircleIsAboutItsCentreOfMass) {
  const SeedLot lot = lot_of("shape = 'drop'\nlength = '12 mm'\nwidth = '6 mm'\nmass = '80 mg'");
  EXPECT_GT(lot.diameter, 12e-3);
  EXPECT_LT(lot.diameter, 16e-3);
  EXPECT_DOUBLE_EQ(lot.diameter, 2 * (lot.discs.back().x + lot.discs.back().radius));
}

TEST(ReadLot, DipoleIsTwoDiscsOnARod) {
  const SeedLot lot = lot_of("shape = 'dipole'\ndiameter = '8 mm'\ndistance = '20 mm'\nmass = '1 g'");
  ASSERT_EQ(lot.discs.size(), 2u);
  EXPECT_DOUBLE_EQ(lot.discs[1].x - lot.discs[0].x, 0.02);
  EXPECT_NEAR(lot.gyration2, 0.5 * 16e-6 + 1e-4, 1e-16);
  EXPECT_DOUBLE_EQ(lot.diameter, 0.028);
}

TEST(ReadLot, DensityGivesAClumpTheMassOfItsBalls) {
  const double ball = std::numbers::pi / 6 * 1e3 * std::pow(8e-3, 3);
  const SeedLot dipole = lot_of("shape = 'dipole'\ndiameter = '8 mm'\ndistance = '20 mm'\ndensity = '1000 kg/m3'");
  EXPECT_NEAR(dipole.mass, 2 * ball, 1e-9 * ball);
  const SeedLot grain = lot_of("shape = 'elongated'\nlength = '7 mm'\nwidth = '3 mm'\ndensity = '1300 kg/m3'");
  const double spheroid = std::numbers::pi / 6 * 7e-3 * 3e-3 * 3e-3 * 1300;
  EXPECT_NEAR(grain.mass, 0.85 * spheroid, 0.01 * spheroid) << "the valleys between the discs are empty";
}

TEST(ReadLot, AThousandGrainWeightIsAThousandMasses) {
  EXPECT_EQ(lot_of("diameter = '3 mm'\nthousand_grain_weight = '44.48 g'").mass,
            lot_of("diameter = '3 mm'\nmass = '44.48 mg'").mass)
      << "to the last bit, so that runs of a crop keep theirs";
  EXPECT_DOUBLE_EQ(lot_of("diameter = '3 mm'\nthousand_grain_weight = '0.045 kg'").mass, 45e-6);
  EXPECT_THAT([] { lot_of("diameter = '3 mm'\nmass = '30 mg'\nthousand_grain_weight = '30 g'"); },
              ThrowsMessage<InputError>(HasSubstr("thousand_grain_weight: contradicts mass")));
}

/// A thousand seeds of different sizes weigh more than a thousand of the mean one.
TEST(ReadLot, AThousandGrainWeightIsOfSeedsOfAllSizes) {
  const SeedLot lot = lot_of(
      "diameter = '3 mm'\nsizes = { distribution = 'normal', deviation = '0.6 mm' }\nthousand_grain_weight = '45 g'");
  EXPECT_NEAR(mean_mass(lot), 45e-6, 1e-18);
  EXPECT_NEAR(lot.mass, 45e-6 / (1 + 3 * 0.04), 0.01 * 45e-6) << "E[s^3] of a normal one is 1 + 3 sigma^2";
}

TEST(ReadLot, ASeedersMassWinsOverItsCropsThousandGrainWeight) {
  EXPECT_DOUBLE_EQ(lot_of("crop = 'wheat-ball'").mass, 29.6e-6);
  EXPECT_DOUBLE_EQ(lot_of("crop = 'wheat-ball'\nmass = '40 mg'").mass, 40e-6);
  EXPECT_DOUBLE_EQ(lot_of("crop = 'wheat-ball'\nthousand_grain_weight = '50 g'").mass, 50e-6);
  EXPECT_NEAR(lot_of("crop = 'wheat-ball'\ndensity = '1000 kg/m3'").mass, 25.05e-6, 0.1e-6);
}

TEST(ReadLot, BulkPropertiesChangeNoSeed) {
  const SeedLot lot = lot_of("diameter = '3 mm'\nmass = '20 mg'");
  EXPECT_EQ(lot, lot_of("diameter = '3 mm'\nmass = '20 mg'\nbulk_density = '700 kg/m3'\nangle_of_repose = '25 degree'\n"
                        "moisture = '9 %'"));
}

TEST(ReadLot, AnyDiscsAboutTheirCentreOfMass) {
  const SeedLot lot = lot_of(
      "shape = 'discs'\nmass = '30 mg'\n"
      "discs = [{ x = '1 mm', y = '2 mm', diameter = '2 mm' }, { x = '5 mm', y = '2 mm', diameter = '2 mm' }]");
  ASSERT_EQ(lot.discs.size(), 2u);
  EXPECT_NEAR(lot.discs[0].x, -2e-3, 1e-17);
  EXPECT_NEAR(lot.discs[0].y, 0, 1e-17);
  EXPECT_EQ(lot.discs[0].radius, 1e-3);
  EXPECT_NEAR(lot.diameter, 6e-3, 1e-17);
}

SeedLot solid_lot_of(const std::string& lines) {
  return lot_of(lines, Space::three_dimensional);
}

TEST(ReadLot, InSpaceARoundSeedIsARowOfBalls) {
  const std::string grain = "shape = 'elongated'\nlength = '7 mm'\nwidth = '3 mm'\n";
  const SeedLot lot = solid_lot_of(grain + "density = '1300 kg/m3'"), plane = lot_of(grain + "density = '1300 kg/m3'");
  EXPECT_TRUE(is_solid_clump(lot));
  EXPECT_NEAR(lot.mass, plane.mass, 1e-12 * plane.mass) << "the plane's density speaks of the same body";
  EXPECT_NEAR(lot.diameter, 7e-3, 1e-15);
  ASSERT_EQ(lot.discs.size(), plane.discs.size());
  for (std::size_t k = 0; k < lot.discs.size(); ++k) EXPECT_NEAR(lot.discs[k].x, plane.discs[k].x, 1e-17);
  const RowBody row = row_body(plane.discs);
  EXPECT_NEAR(lot.gyration2_x, 2 * row.across, 1e-12 * lot.gyration2_x);
  EXPECT_NEAR(lot.gyration2, row.along + row.across, 1e-12 * lot.gyration2);
  // A spheroid has (b^2 + c^2) / 5, and no valleys far from its axis.
  EXPECT_LT(lot.gyration2_x, 2 * 1.5e-3 * 1.5e-3 / 5);
  EXPECT_NEAR(lot.gyration2, (3.5e-3 * 3.5e-3 + 1.5e-3 * 1.5e-3) / 5, 0.08 * lot.gyration2);
  EXPECT_EQ(lot.gyration2_y, lot.gyration2);
}

TEST(ReadLot, InSpaceAThicknessMakesASeedFlat) {
  const std::string seed = "shape = 'drop'\nlength = '12 mm'\nwidth = '6 mm'\nmass = '80 mg'\nthickness = '4 mm'";
  const SeedLot lot = solid_lot_of(seed);
  double widest = 0, thickest = 0;
  for (const ClumpDisc& ball : lot.discs) {
    widest = std::max(widest, 2 * (std::abs(ball.y) + ball.radius));
    thickest = std::max(thickest, 2 * (std::abs(ball.z) + ball.radius));
  }
  EXPECT_NEAR(widest, 6e-3, 1e-12);
  EXPECT_NEAR(thickest, 4e-3, 1e-12);
  EXPECT_LT(lot.gyration2_x, lot.gyration2_y);
  EXPECT_LT(lot.gyration2_y, lot.gyration2);
  EXPECT_EQ(lot_of(seed), lot_of("shape = 'drop'\nlength = '12 mm'\nwidth = '6 mm'\nmass = '80 mg'"));
}

TEST(ReadLot, InSpaceDiscsAreBallsOfAnyPlace) {
  const std::string balls =
      "shape = 'discs'\nmass = '30 mg'\n"
      "discs = [{ x = '0 mm', y = '0 mm', diameter = '3 mm' }, { x = '2 mm', y = '0 mm', diameter = '2 mm' }, "
      "{ x = '0 mm', y = '2 mm', z = '1 mm', diameter = '2 mm' }]";
  const SeedLot lot = solid_lot_of(balls);
  EXPECT_TRUE(is_solid_clump(lot));
  EXPECT_NEAR(body_of_balls(lot.discs).centre.norm(), 0, 1e-14);
  EXPECT_FALSE(is_solid_clump(lot_of(balls))) << "in the plane z is known and counts for nothing";
  const SeedLot dipole = solid_lot_of("shape = 'dipole'\ndiameter = '8 mm'\ndistance = '20 mm'\nmass = '1 g'");
  EXPECT_NEAR(dipole.gyration2, 0.4 * 16e-6 + 1e-4, 1e-16);
  EXPECT_NEAR(dipole.gyration2_x, 0.4 * 16e-6, 1e-18);
}

TEST(ReadLot, InSpaceWhatCannotBeIsSaid) {
  const std::string grain = "shape = 'elongated'\nlength = '7 mm'\nwidth = '3 mm'\nmass = '30 mg'\n";
  const auto expect = [](const std::string& lines, const std::string& message) {
    EXPECT_THAT([&] { solid_lot_of(lines); }, ThrowsMessage<InputError>(HasSubstr(message)));
  };
  expect("shape = 'disc'\ndiameter = '3 mm'\nmass = '30 mg'", "shape: is for 2D");
  expect(grain + "thickness = '3.1 mm'", "thickness: 3.1 mm is more than the width, 3 mm");
  expect(grain + "thickness = '0.7 mm'", "thickness: 0.7 mm is too thin for 4 balls side by side, 3 mm wide");
  expect("shape = 'elongated'\nlength = '20 mm'\nwidth = '3 mm'\nmass = '30 mg'\nthickness = '1 mm'",
         "thickness: 1 mm is too slender for 11 discs at a length of 20 mm");
  expect("shape = 'elongated'\nlength = '20 mm'\nwidth = '3 mm'\nmass = '30 mg'", "width: 3 mm is too slender");
  expect("diameter = '3 mm'\nthickness = '2 mm'\nmass = '30 mg'", "thickness: does not go with shape = \"ball\"");
  const auto beside = [](const std::string& other) {
    return "shape = 'discs'\nmass = '30 mg'\ndiscs = [{ x = '1 mm', y = '0 mm', diameter = '3 mm' }, " + other + "]";
  };
  for (const char* within :
       {"{ x = '1 mm', y = '0 mm', diameter = '3 mm' }", "{ x = '2 mm', y = '0 mm', diameter = '1 mm' }"})
    expect(beside(within), ":3: discs: ball 2 lies within ball 1");
  expect(beside("{ x = '1 mm', y = '1 mm', z = '1 mm', diameter = '6 mm' }"), ":3: discs: ball 1 lies within ball 2");
  EXPECT_NO_THROW(solid_lot_of(beside("{ x = '1 mm', y = '0 mm', z = '1 mm', diameter = '2 mm' }")));
}

TEST(ReadLot, MeanOfUniformAndTableIsTheDiameter) {
  const SeedLot uniform =
      lot_of("density = '1200 kg/m3'\nsizes = { distribution = 'uniform', least = '3 mm', most = '5 mm' }");
  EXPECT_DOUBLE_EQ(uniform.diameter, 4e-3);
  EXPECT_DOUBLE_EQ(uniform.mass, 1200 * std::numbers::pi / 6 * 64e-9);
  EXPECT_DOUBLE_EQ(uniform.sizes.least, 3e-3);
  const SeedLot table = lot_of(
      "mass = '30 mg'\n"
      "sizes = { distribution = 'table', diameters = ['3 mm', '5 mm', '4 mm'], fractions = ['20 %', '10 %', '70 %'] }");
  EXPECT_DOUBLE_EQ(table.diameter, 3.9e-3);
  EXPECT_EQ(table.sizes.diameter, (std::vector<double>{3e-3, 5e-3, 4e-3}));
  EXPECT_NEAR(table.sizes.fraction[2], 0.7, 1e-15);
}

TEST(ReadLot, ASievesTableIsByMass) {
  // Equal masses of seeds of 2 and 4 mm are eight small ones for a large one.
  const std::string halves = "distribution = 'table', diameters = ['2 mm', '4 mm'], mass_fractions = ['50 %', '50 %']";
  const SeedLot balls = lot_of("mass = '30 mg'\nsizes = { " + halves + " }");
  EXPECT_NEAR(balls.sizes.fraction[0], 8.0 / 9, 1e-15);
  EXPECT_NEAR(balls.sizes.fraction[1], 1.0 / 9, 1e-15);
  EXPECT_NEAR(balls.diameter, (8 * 2e-3 + 4e-3) / 9, 1e-15);
  const SeedLot discs = lot_of("shape = 'disc'\nmass = '30 mg'\nsizes = { " + halves + " }");
  EXPECT_NEAR(discs.sizes.fraction[0], 0.8, 1e-15);
  const std::string rows =
      "shape = 'elongated'\nwidth = '1.5 mm'\nmass = '30 mg'\n"
      "sizes = { distribution = 'table', lengths = ['2 mm', '4 mm'], mass_fractions = ['50 %', '50 %'] }";
  // Back again: what each size weighs is what was asked for. A clump is a whole seed in 2D, as a ball is.
  for (const Space space : {Space::two_dimensional, Space::three_dimensional}) {
    const SeedLot lot = lot_of(rows, space);
    EXPECT_NEAR(lot.sizes.fraction[0], 8.0 / 9, 1e-15);
    const int power = mass_power(lot);
    const double small = lot.sizes.fraction[0] * std::pow(lot.sizes.diameter[0] / lot.diameter, power);
    EXPECT_NEAR(small / size_moment(lot, power), 0.5, 1e-12);
  }
}

TEST(ReadLot, NormalAndLognormalAreCutAtThreeDeviations) {
  for (const auto& [name, kind] : {std::pair("normal", Kind::normal), std::pair("lognormal", Kind::lognormal)}) {
    const std::string start = std::string("diameter = '4 mm'\nmass = '30 mg'\nsizes = { distribution = '") + name;
    const SeedLot lot = lot_of(start + "', deviation = '0.4 mm' }");
    EXPECT_EQ(lot.sizes.kind, kind);
    EXPECT_EQ(lot.diameter, 4e-3);
    EXPECT_DOUBLE_EQ(lot.sizes.deviation, 0.4e-3);
    EXPECT_DOUBLE_EQ(lot.sizes.least, 2.8e-3);
    EXPECT_DOUBLE_EQ(lot.sizes.most, 5.2e-3);
    const SeedLot cut = lot_of(start + "', deviation = '3 mm', least = '1 mm', most = '9 mm' }");
    EXPECT_DOUBLE_EQ(cut.sizes.least, 1e-3);
    EXPECT_DOUBLE_EQ(cut.sizes.most, 9e-3);
  }
}

TEST(ReadLot, ClumpsScatterInTheMeasureThatIsGiven) {
  const SeedLot drop = lot_of(
      "shape = 'drop'\nlength = '12 mm'\nwidth = '6 mm'\nmass = '80 mg'\n"
      "sizes = { distribution = 'normal', deviation = '0.6 mm' }");
  EXPECT_DOUBLE_EQ(drop.sizes.mean, drop.diameter);
  EXPECT_NEAR(drop.sizes.deviation / drop.diameter, 0.05, 1e-15);
  EXPECT_NEAR(least_size(drop), 0.85, 1e-14);
  EXPECT_NEAR(most_size(drop), 1.15, 1e-14);
  const SeedLot rows = lot_of(
      "shape = 'elongated'\nwidth = '3 mm'\nmass = '30 mg'\n"
      "sizes = { distribution = 'table', lengths = ['6 mm', '8 mm'], fractions = ['50 %', '50 %'] }");
  EXPECT_NEAR(rows.diameter, 7e-3, 1e-15);
  EXPECT_NEAR(least_size(rows), 6 / 7.0, 1e-14);
  const SeedLot dipoles = lot_of(
      "shape = 'dipole'\ndistance = '8 mm'\nmass = '1 g'\n"
      "sizes = { distribution = 'uniform', least = '6 mm', most = '10 mm' }");
  EXPECT_DOUBLE_EQ(dipoles.diameter, 16e-3);
  EXPECT_DOUBLE_EQ(dipoles.sizes.most, 20e-3);
}

TEST(ReadLot, ShapeWrittenOverACropsOwn) {
  const SeedLot ball = lot_of("crop = 'sunflower'\nshape = 'ball'\ndiameter = '6 mm'");
  EXPECT_EQ(ball.shape, Shape::ball);
  EXPECT_EQ(ball.diameter, 6e-3);
  const SeedLot grain = lot_of("crop = 'wheat-ball'\nshape = 'elongated'\nlength = '7 mm'\nwidth = '3 mm'");
  EXPECT_NEAR(grain.diameter, 7e-3, 1e-15);
  const SeedLot scattered =
      lot_of("crop = 'wheat-ball'\nsizes = { distribution = 'uniform', least = '3 mm', most = '5 mm' }");
  EXPECT_DOUBLE_EQ(scattered.diameter, 4e-3);
}

struct Wrong {
  const char* lines;
  const char* place;
  const char* message;
};

class LotError : public testing::TestWithParam<Wrong> {};

TEST_P(LotError, NamesLineKeyAndReason) {
  EXPECT_THAT([] { lot_of(GetParam().lines); },
              ThrowsMessage<InputError>(AllOf(HasSubstr(std::string("seeder.toml") + GetParam().place + ": "),
                                              HasSubstr(GetParam().message))));
}

#define SIZES(text) "mass = '30 mg'\ndiameter = '4 mm'\nsizes = { " text " }"
#define MEANLESS(text) "mass = '30 mg'\nsizes = { " text " }"

INSTANTIATE_TEST_SUITE_P(
    Shapes, LotError,
    testing::Values(
        Wrong{"diameter = '4 mm'\nshape = 'elongated'\nlength = '7 mm'", ":1: diameter",
              "go with shape = \"elongated\""},
        Wrong{"diameter = '4 mm'\nlength = '7 mm'", ":2: length", "does not go with shape = \"ball\""},
        Wrong{"shape = 'drop'\nlength = '7 mm'\ndistance = '7 mm'", ":3: distance", "does not go with"},
        Wrong{"mass = '1 g'\nshape = 'drop'\nlength = '7 mm'\nwidth = '7 mm'", ":4: width", "not less than the length"},
        Wrong{"mass = '1 g'\nshape = 'drop'\nlength = '7 mm'\nwidth = '1 mm'", ":4: width", "up to 3.9 widths"},
        Wrong{"mass = '1 g'\nshape = 'elongated'\nlength = '7 mm'\nwidth = '1 mm'", ":4: width", "up to 5 widths"},
        Wrong{"shape = 'discs'\ndiscs = [{ x = '0 mm', y = '0 mm' }]", ":2: discs[1].diameter", "is missing"},
        Wrong{"shape = 'discs'\ndiscs = [{ x = '0 mm', y = '0 mm', r = '1 mm', diameter = '1 mm' }]\nmass = '1 mg'",
              ":2: discs[1].r", "unknown key"},
        Wrong{"shape = 'discs'\ndiscs = '4 mm'", ":2: discs", "must be tables"},
        Wrong{"shape = 'discs'\nsizes = { distribution = 'uniform' }", ":2: sizes", "does not go with"},
        Wrong{"shape = 'disc'\ndiameter = '4 mm'\ndensity = '1200 kg/m3'", ":3: density", "no thickness"}));

INSTANTIATE_TEST_SUITE_P(
    Sizes, LotError,
    testing::Values(
        Wrong{SIZES("deviation = '1 mm'"), ":3: sizes.distribution", "is missing"},
        Wrong{SIZES("distribution = 'gauss'"), ":3: sizes.distribution", "uniform, normal, lognormal, table"},
        Wrong{SIZES("distribution = 'normal'"), ":3: sizes.deviation", "is missing"},
        Wrong{SIZES("distribution = 'normal', deviation = '0 mm'"), ":3: sizes.deviation", "out of range"},
        Wrong{SIZES("distribution = 'normal', deviation = '8 %'"), ":3: sizes.deviation", "wrong unit"},
        Wrong{SIZES("distribution = 'normal', deviation = '1.3 mm'"), ":3: sizes.least", "too small for a seed"},
        Wrong{SIZES("distribution = 'normal', deviation = '1 mm', least = '4 mm'"), ":3: sizes.least", "not below"},
        Wrong{SIZES("distribution = 'normal', deviation = '1 mm', most = '4 mm'"), ":3: sizes.most", "not above"},
        Wrong{SIZES("distribution = 'normal', deviation = '1 mm', fractions = ['1 %']"), ":3: sizes.fractions",
              "\"table\""},
        Wrong{SIZES("distribution = 'uniform', least = '3 mm', most = '5 mm'"), ":2: diameter", "contradicts sizes"},
        Wrong{MEANLESS("distribution = 'uniform', least = '3 mm'"), ":2: sizes.most", "is missing"},
        Wrong{MEANLESS("distribution = 'uniform', least = '3 mm', most = '3 mm'"), ":2: sizes.most", "not above least"},
        Wrong{MEANLESS("distribution = 'uniform', deviation = '3 mm'"), ":2: sizes.deviation", "does not go with"},
        Wrong{MEANLESS("distribution = 'normal', deviation = '1 mm'"), ": diameter", "is missing"},
        Wrong{MEANLESS("distribution = 'table', fractions = ['100 %']"), ":2: sizes.diameters", "is missing"},
        Wrong{MEANLESS("distribution = 'table', diameters = ['3 mm', '4 mm'], fractions = ['100 %']"),
              ":2: sizes.fractions", "lists 1 fractions, by number, for 2 diameters"},
        Wrong{MEANLESS("distribution = 'table', diameters = ['3 mm', '4 mm'], fractions = ['90 %', '5 %']"),
              ":2: sizes.fractions", "sum to 95 %"},
        Wrong{MEANLESS("distribution = 'table', diameters = ['3 mm', '4 mm'], mass_fractions = ['90 %', '5 %']"),
              ":2: sizes.mass_fractions", "sum to 95 %"},
        Wrong{MEANLESS("distribution = 'table', diameters = ['3 mm', '4 mm'], mass_fractions = ['100 %']"),
              ":2: sizes.mass_fractions", "lists 1 fractions, by mass, for 2 diameters"},
        Wrong{
            MEANLESS("distribution = 'table', diameters = ['3 mm'], fractions = ['100 %'], mass_fractions = ['100 %']"),
            ":2: sizes.mass_fractions", "contradicts fractions"},
        Wrong{MEANLESS("distribution = 'uniform', least = '3 mm', most = '4 mm', mass_fractions = ['100 %']"),
              ":2: sizes.mass_fractions", "does not go with"}));

}  // namespace
}  // namespace vibrosow
