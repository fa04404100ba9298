#include "input/read_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow::read_scene_test {
namespace {

constexpr const char* full_example = R"(
title  = "Wheat tray, five holes, fed from a hopper"
[seeds.wheat]
diameter = "4 mm"
mass = "30 mg"
[contact]
law = "elastic-shell"
shell_compression = 1e-4
friction = 0.3
restitution = 0.5
slip_speed = "30 mm/s"
drag = "3 g/s"
rotation = false
friction_arm = "rim"
wall = { friction = 0.2 }
[tray]
length = "50 cm"
height = "12 cm"
depth  = "6 cm"
tilt   = "-3 degree"
fill   = { count = 600, packing = "layers", jitter = 0.01 }
[tray.holes]
count  = 5
width  = "16 mm"
span   = "36 cm"
centre = "25 cm"
[tray.motion]
kind      = "harmonic"
direction = "30 degree"
amplitude = "1 cm"
frequency = "540 rpm"
ramp      = "0.2 s"
[hopper]
left   = "19 cm"
above  = "7 cm"
length = "12 cm"
height = "20 cm"
funnel = "45 degree"
holes  = { at = ["6 cm"], width = "3 diameters" }
fill   = { count = 900, packing = "poured", keep = true }
[numerics]
integrator = "rk2-midpoint"
dt = "2e-5 s"
allow_long_step = true
[guard]
warn_relative_overlap = 0.1
stop_relative_overlap = 0.7
energy_tolerance = 0.3
[run]
duration     = "10 s"
measure_from = "2 s"
count_below  = "30 mm"
start        = "with-tray"
)";

constexpr const char* small_example = R"(
[seeds.pea]
diameter = "8 mm"
density = "1200 kg/m3"
[contact]
shell_compression = 1e-4
[tray]
length = "50 cm"
height = "12 cm"
fill = { count = 10 }
[run]
duration = "1 s"
)";

Scene read(const std::string& text, const std::vector<std::string>& settings = {}) {
  const TemporaryFolder folder;
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  return read_scene(folder.write("seeder.toml", text), overrides);
}

TEST(ReadScene, EveryKey) {
  const Scene scene = read(full_example);
  EXPECT_EQ(scene.title, "Wheat tray, five holes, fed from a hopper");
  ASSERT_EQ(scene.lots.size(), 1U);
  EXPECT_EQ(scene.lots[0].name, "wheat");
  EXPECT_EQ(scene.lots[0].diameter, 0.004);
  EXPECT_EQ(scene.lots[0].mass, 30e-6);
  EXPECT_EQ(scene.lots[0].shape, Shape::ball);
  EXPECT_EQ(scene.lots[0].number_fraction, 1);

  EXPECT_EQ(scene.contact.shell_compression, 1e-4);
  EXPECT_EQ(scene.contact.seed.friction, 0.3);
  EXPECT_EQ(scene.contact.wall.friction, 0.2);
  EXPECT_EQ(scene.contact.seed.restitution, 0.5);
  EXPECT_EQ(scene.contact.wall.restitution, 0.5);
  EXPECT_EQ(scene.contact.slip_speed, 0.03);
  EXPECT_EQ(scene.contact.drag, 0.003);
  EXPECT_FALSE(scene.contact.rotation);
  EXPECT_EQ(scene.contact.friction_arm, FrictionArm::rim);

  EXPECT_EQ(scene.tray.name, "tray");
  EXPECT_EQ(scene.tray.origin, Eigen::Vector2d(0, 0));
  EXPECT_EQ(scene.tray.length, 0.5);
  EXPECT_EQ(scene.tray.height, 0.12);
  EXPECT_EQ(scene.tray.depth, 0.06);
  EXPECT_NEAR(scene.tray.tilt, -3 * std::numbers::pi / 180, 1e-15);
  ASSERT_EQ(scene.tray.holes.size(), 5U);
  const double centres[] = {0.07, 0.16, 0.25, 0.34, 0.43};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(scene.tray.holes[i].centre, centres[i]);
    EXPECT_EQ(scene.tray.holes[i].width, 0.016);
  }
  EXPECT_EQ(scene.tray.fill->count, 600);
  EXPECT_EQ(scene.tray.fill->packing, Packing::layers);
  EXPECT_EQ(scene.tray.fill->jitter, 0.01);
  EXPECT_FALSE(scene.tray.fill->keep);
  EXPECT_NEAR(std::get<HarmonicMotion>(*scene.tray.motion).direction, std::numbers::pi / 6, 1e-15);
  EXPECT_EQ(std::get<HarmonicMotion>(*scene.tray.motion).amplitude, 0.01);
  EXPECT_EQ(std::get<HarmonicMotion>(*scene.tray.motion).frequency, 9);
  EXPECT_EQ(std::get<HarmonicMotion>(*scene.tray.motion).ramp, 0.2);

  ASSERT_TRUE(scene.hopper);
  EXPECT_EQ(scene.hopper->name, "hopper");
  EXPECT_EQ(scene.hopper->origin, Eigen::Vector2d(0.19, 0.07));
  EXPECT_NEAR(scene.hopper->funnel, std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(scene.hopper->holes[0].width, 0.012);
  EXPECT_EQ(scene.hopper->fill->packing, Packing::poured);
  EXPECT_TRUE(scene.hopper->fill->keep);
  EXPECT_FALSE(scene.hopper->motion);

  EXPECT_EQ(scene.numerics.integrator, Integrator::rk2_midpoint);
  EXPECT_EQ(scene.numerics.dt, 2e-5);
  EXPECT_TRUE(scene.numerics.allow_long_step);
  EXPECT_EQ(scene.guard.warn_relative_overlap, 0.1);
  EXPECT_EQ(scene.guard.stop_relative_overlap, 0.7);
  EXPECT_EQ(scene.guard.energy_tolerance, 0.3);
  EXPECT_EQ(scene.run.duration, 10);
  EXPECT_EQ(scene.run.measure_from, 2);
  EXPECT_EQ(scene.run.count_below, 0.03);
  EXPECT_EQ(scene.run.start, Start::with_tray);
}

TEST(ReadScene, DefaultsAreNeutral) {
  const Scene scene = read(small_example);
  EXPECT_EQ(scene.title, "seeder");
  EXPECT_NEAR(scene.lots[0].mass, 1200 * std::numbers::pi / 6 * 0.008 * 0.008 * 0.008, 1e-18);
  EXPECT_EQ(scene.contact.seed.friction, 0);
  EXPECT_EQ(scene.contact.wall.restitution, 1);
  EXPECT_EQ(scene.contact.drag, 0);
  EXPECT_EQ(scene.contact.slip_speed, 0.02);
  EXPECT_TRUE(scene.tray.holes.empty());
  EXPECT_FALSE(scene.tray.motion);
  EXPECT_FALSE(scene.hopper);
  EXPECT_EQ(scene.numerics.steps_per_contact, 12);
  EXPECT_FALSE(scene.numerics.dt);
  EXPECT_EQ(scene.run.count_below, 0.02);
}

TEST(ReadScene, ThePapersSchemesTakeMoreStepsWhereNothingIsSaid) {
  for (const char* scheme : {"rk2-midpoint", "gear5"}) {
    const std::string key = std::string("numerics.integrator=") + scheme;
    EXPECT_EQ(read(small_example, {key}).numerics.steps_per_contact, 20);
    EXPECT_EQ(read(small_example, {key, "numerics.steps_per_contact=12"}).numerics.steps_per_contact, 12);
  }
}

TEST(ReadScene, AccuracyIsALevelAndContradictsAStep) {
  EXPECT_EQ(read(small_example).numerics.accuracy, AccuracyLevel::as_written);
  EXPECT_EQ(read(small_example, {"accuracy=draft"}).numerics.accuracy, AccuracyLevel::draft);
  EXPECT_EQ(read(small_example, {"accuracy=100 %"}).numerics.accuracy, AccuracyLevel::draft);
  EXPECT_EQ(read(small_example, {"accuracy=6 %"}).numerics.accuracy, AccuracyLevel::design);
  EXPECT_EQ(read(small_example, {"accuracy=3 %"}).numerics.accuracy, AccuracyLevel::reference);
  for (const char* step : {"numerics.dt=1e-5 s", "numerics.steps_per_contact=30"})
    EXPECT_THROW(read(small_example, {"accuracy=design", step}), InputError);
  for (const char* softness : {"contact.shell_compression=1e-5", "seeds.pea.shell_compression=1e-5"})
    EXPECT_THAT(
        [&] {
          read(small_example, {"accuracy=design", softness});
        },
        testing::ThrowsMessage<InputError>(testing::HasSubstr("contradicts accuracy")));
}

TEST(ReadScene, AnErrorOfGrainsIsThatOfGrains) {
  std::string grains = small_example;
  const std::string ball = "diameter = \"8 mm\"";
  grains.replace(grains.find(ball), ball.size(), "shape = \"elongated\"\nlength = \"8 mm\"\nwidth = \"4 mm\"");
  EXPECT_EQ(read(grains, {"accuracy=7 %"}).numerics.accuracy, AccuracyLevel::design);
  EXPECT_EQ(read(grains, {"accuracy=7.3 %"}).numerics.accuracy, AccuracyLevel::draft);
  EXPECT_THAT([&] { read(grains, {"accuracy=5 %"}); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("errs by up to 6.6 % with such seeds")));
}

TEST(ReadScene, OverridesAct) {
  const Scene scene = read(small_example, {"tray.motion.kind=harmonic", "tray.motion.amplitude=5 mm",
                                           "tray.motion.frequency=12 Hz", "contact.friction=0.25"});
  EXPECT_EQ(std::get<HarmonicMotion>(*scene.tray.motion).frequency, 12);
  EXPECT_EQ(scene.contact.seed.friction, 0.25);
  EXPECT_EQ(scene.contact.wall.friction, 0.25);
}

TEST(ReadScene, PiecesAreLinesAndArcs) {
  const Scene scene =
      read(small_example, {"tray.pieces=[{ line = [['0 cm', '5 cm'], ['3 cm', '8 cm'], ['6 cm', '5 cm']] "
                           "}, { centre = ['5 cm', '6 cm'], radius = '2 cm', from = '180 degree', to = "
                           "'270 degree' }, { centre = ['5 cm', '6 cm'], radius = '1 cm' }]",
                           "tray.box=false"});
  ASSERT_EQ(scene.tray.pieces.size(), 4U);
  EXPECT_EQ(scene.tray.pieces[1].a, Eigen::Vector2d(0.03, 0.08));
  EXPECT_EQ(scene.tray.pieces[1].b, Eigen::Vector2d(0.06, 0.05));
  EXPECT_EQ(scene.tray.pieces[2].centre, Eigen::Vector2d(0.05, 0.06));
  EXPECT_NEAR(scene.tray.pieces[2].to, 1.5 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(scene.tray.pieces[3].to, 2 * std::numbers::pi, 1e-15);
  EXPECT_FALSE(scene.tray.box);
}

TEST(ReadScene, PeriodicSidesNeedALevelTrayThatDoesNotTurn) {
  EXPECT_EQ(read(small_example, {"tray.sides=periodic"}).tray.sides, Sides::periodic);
  EXPECT_EQ(read(small_example, {"tray.sides=open"}).tray.sides, Sides::open);
  const auto refused = [](std::vector<std::string> settings, const char* message) {
    settings.push_back("tray.sides=periodic");
    EXPECT_THAT([&] { read(small_example, settings); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr(message)));
  };
  refused({"tray.motion={ kind = 'rocking', pivot = ['1 cm', '0 cm'], angle = '1 degree', frequency = '9 Hz' }"},
          "cannot turn");
  refused({"tray.tilt=1 degree"}, "cannot be tilted");
  refused({"tray.length=4 cm"}, "at least 6 diameters of the largest seed long, 48 mm");
  refused({"hopper={ left = '45 cm', above = '5 cm', length = '10 cm', height = '5 cm' }"},
          "does not lie within the length");
}

TEST(ReadScene, GatesOpenAtOneTimeOrAtOneEach) {
  Scene scene = read(small_example, {"tray.holes={ count = 2, width = '2 cm', open_at = '1.5 s' }"});
  EXPECT_EQ(scene.tray.holes[0].open_at, 1.5);
  EXPECT_EQ(scene.tray.holes[1].open_at, 1.5);
  scene = read(small_example, {"tray.holes={ at = ['30 cm', '10 cm'], width = '2 cm', open_at = ['2 s', '0 s'] }"});
  EXPECT_EQ(scene.tray.holes[0].centre, 0.1);
  EXPECT_EQ(scene.tray.holes[0].open_at, 0);
  EXPECT_EQ(scene.tray.holes[1].open_at, 2);
}

TEST(ReadScene, PouredClumpsNeedTheirOwnAreaAndRowsThatOfTheirCircles) {
  const std::vector<std::string> long_seeds = {
      "seeds.pea={ shape = 'elongated', length = '20 mm', width = '5 mm', mass = "
      "'0.4 g' }"};  // 76 mm2 each; the tray is 60 000 mm2
  const auto read_with = [&](const std::string& fill) {
    std::vector<std::string> settings = long_seeds;
    settings.push_back("tray.fill=" + fill);
    return read(small_example, settings);
  };
  EXPECT_EQ(read_with("{ count = 700 }").tray.fill->count, 700);
  EXPECT_THROW(read_with("{ count = 850 }"), InputError);
  EXPECT_THROW(read_with("{ count = 700, packing = 'layers' }"), InputError);
}

TEST(ReadScene, RainNeedsNoFill) {
  const std::string dry = std::string(small_example).replace(std::string(small_example).find("fill ="), 22, "");
  EXPECT_THROW(read(dry), InputError);
  Scene scene = read(dry, {"tray.rain.rate=200 1/s"});
  ASSERT_TRUE(scene.tray.rain);
  EXPECT_FALSE(scene.tray.fill);
  EXPECT_EQ(scene.tray.rain->rate, 200);
  EXPECT_EQ(scene.tray.rain->to, 0.5);
  EXPECT_EQ(scene.tray.rain->height, 0.12);
  EXPECT_EQ(scene.tray.rain->stop, never);
  scene = read(dry, {"tray.rain={ rate = '2 1/ms', from = '1 cm', to = '2 cm', height = '20 cm', start = '1 s', stop = "
                     "'2 s' }"});
  EXPECT_EQ(scene.tray.rain->rate, 2000);
  EXPECT_EQ(scene.tray.rain->from, 0.01);
  EXPECT_EQ(scene.tray.rain->height, 0.2);
  EXPECT_EQ(scene.tray.rain->start, 1);
}

TEST(ReadScene, HolesWithDefaultPitchAndHolesOutOfOrder) {
  Scene scene = read(small_example, {"tray.holes={ count = 4, width = '2 diameters' }"});
  ASSERT_EQ(scene.tray.holes.size(), 4U);
  EXPECT_EQ(scene.tray.holes[0].centre, 0.1);
  EXPECT_EQ(scene.tray.holes[3].centre, 0.4);
  EXPECT_EQ(scene.tray.holes[3].width, 0.016);
  scene = read(small_example, {"tray.holes={ at = ['30 cm', '10 cm'], width = ['3 cm', '1 cm'] }"});
  EXPECT_EQ(scene.tray.holes[0].centre, 0.1);
  EXPECT_EQ(scene.tray.holes[0].width, 0.01);
  EXPECT_EQ(scene.tray.holes[1].width, 0.03);
}

TEST(ReadScene, OneHoleIgnoresSpanAndPitch) {
  for (const char* key : {"span", "pitch"}) {
    const Scene scene =
        read(small_example, {std::string("tray.holes={ count = 1, width = '2 cm', ") + key + " = '90 cm' }"});
    ASSERT_EQ(scene.tray.holes.size(), 1U);
    EXPECT_EQ(scene.tray.holes[0].centre, 0.25);
  }
}

TEST(ReadScene, MixtureByMassIsConvertedToNumbers) {
  const Scene scene =
      read(small_example, {"seeds.pea={ diameter = '8 mm', mass = '0.3 g', mass_fraction = '75 %' }",
                           "seeds.rape.diameter=2 mm", "seeds.rape.mass=0.1 g", "seeds.rape.mass_fraction=25 %",
                           "tray.holes={ count = 1, width = '2 diameters' }"});
  ASSERT_EQ(scene.lots.size(), 2U);
  EXPECT_NEAR(scene.lots[0].number_fraction, 0.5, 1e-15);
  EXPECT_NEAR(scene.lots[1].number_fraction, 0.5, 1e-15);
  EXPECT_EQ(scene.tray.holes[0].width, 0.016) << "of the largest lot";
}

TEST(ReadScene, MixtureByMassCountsTheMeanMassOfAllSizes) {
  // Balls of 6 to 10 mm: E[d^3] = 8^3 (1 + (1/4)^2) mm^3, so a seed weighs 0.31875 g on average.
  const Scene scene =
      read(small_example, {("seeds.pea={ mass = '0.3 g', mass_fraction = '75 %', sizes = { distribution = "
                            "'uniform', least = '6 mm', most = '10 mm' } }"),
                           "seeds.rape.diameter=2 mm", "seeds.rape.mass=0.1 g", "seeds.rape.mass_fraction=25 %",
                           "tray.holes={ count = 1, width = '2 diameters' }"});
  const double peas = 0.75 / 0.31875, rapes = 0.25 / 0.1;
  EXPECT_NEAR(scene.lots[0].number_fraction, peas / (peas + rapes), 1e-15);
  EXPECT_EQ(scene.tray.holes[0].width, 0.016) << "of the mean of the largest lot";
}

TEST(ReadScene, LargestSeedOfALotMustFitIn) {
  const auto with_a_wide_one = [](const char* most) {
    return read(small_example,
                {std::string("seeds.pea={ mass = '0.3 g', sizes = { distribution = 'table', diameters = ['6 mm', '") +
                 most + "'], fractions = ['99 %', '1 %'] } }"});
  };
  EXPECT_NO_THROW(with_a_wide_one("49 cm"));
  EXPECT_THROW(with_a_wide_one("51 cm"), InputError);
}

TEST(ReadScene, MixtureByNumber) {
  const Scene scene = read(small_example, {"seeds.pea.number_fraction=75 %", "seeds.rape.diameter=2 mm",
                                           "seeds.rape.mass=0.1 g", "seeds.rape.number_fraction=25 %"});
  EXPECT_NEAR(scene.lots[0].number_fraction, 0.75, 1e-15);
}

TEST(ReadScene, PresetsByPathWithKeysOverThem) {
  const TemporaryFolder folder;
  folder.write("my-pea.toml",
               "title = 'Pea'\ndiameter = '7 mm'\nmass = '0.2 g'\nshape = 'disc'\n[sources]\nmass = 'x'\n");
  folder.write("my-contact.toml",
               "shell_compression = 1e-3\nfriction = 0.4\n[wall]\nfriction = 0.2\n[sources]\nx = 'y'\n");
  const auto file = folder.write("seeder.toml", R"([seeds.pea]
crop = "my-pea.toml"
diameter = "6 mm"
[contact]
model = "my-contact.toml"
friction = 0.5
[tray]
length = "50 cm"
height = "12 cm"
fill = { count = 10 }
[run]
duration = "1 s"
)");
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.lots[0].diameter, 0.006);
  EXPECT_EQ(scene.lots[0].mass, 0.0002);
  EXPECT_EQ(scene.lots[0].shape, Shape::disc);
  EXPECT_EQ(scene.contact.shell_compression, 1e-3);
  EXPECT_EQ(scene.contact.seed.friction, 0.5);
  EXPECT_EQ(scene.contact.wall.friction, 0.2);
  const Scene by_density =
      read_scene(file, {parse_override("seeds.pea.density=1000 kg/m3"), parse_override("seeds.pea.shape=ball")});
  EXPECT_NEAR(by_density.lots[0].mass, 1000 * std::numbers::pi / 6 * std::pow(0.006, 3), 1e-18);
}

TEST(ReadScene, ShippedCropByName) {
  const Scene scene = read(
      small_example, {"seeds.wheat.crop=wheat", "seeds.wheat.number_fraction=50 %", "seeds.pea.number_fraction=50 %"});
  EXPECT_EQ(scene.lots[1].name, "wheat");
  EXPECT_GT(scene.lots[1].mass, 1e-5);
}

TEST(ReadScene, RowOfHolesEqualsTheSameHolesByPosition) {
  EXPECT_TRUE(rc::check("count, span and centre are the same as at", [] {
    const int count = *rc::gen::inRange(2, 8);
    const int span_mm = *rc::gen::inRange(20 * (count - 1), 400);
    const int centre_mm = *rc::gen::inRange(220, 281);
    std::ostringstream row, positions;
    row << "tray.holes={ count = " << count << ", width = '9 mm', span = '" << span_mm << " mm', centre = '"
        << centre_mm << " mm' }";
    positions << "tray.holes={ width = '9 mm', at = [" << std::setprecision(15);
    for (int i = 0; i < count; ++i) {
      const double at_mm = centre_mm - span_mm / 2.0 + span_mm * i / (count - 1.0);
      positions << (i > 0 ? ", " : "") << "'" << at_mm << " mm'";
    }
    positions << "] }";
    const Scene by_row = read(small_example, {row.str()});
    const Scene by_position = read(small_example, {positions.str()});
    RC_ASSERT(by_row.tray.holes.size() == static_cast<std::size_t>(count));
    RC_ASSERT(by_position.tray.holes.size() == static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < by_row.tray.holes.size(); ++i) {
      RC_ASSERT(std::abs(by_row.tray.holes[i].centre - by_position.tray.holes[i].centre) < 2e-12);
      RC_ASSERT(by_row.tray.holes[i].width == by_position.tray.holes[i].width);
    }
  }));
}

}  // namespace
}  // namespace vibrosow::read_scene_test
