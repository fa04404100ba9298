// Every wrong input is refused with file, line, key and what is wrong. The base below is right; each case changes one
// line of it or adds one, so that the line in the message is known.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <regex>
#include <sstream>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<std::string> base = {
    "[seeds.wheat]",             // 1
    "diameter = '4 mm'",         // 2
    "mass = '30 mg'",            // 3
    "[contact]",                 // 4
    "shell_compression = 1e-4",  // 5
    "[tray]",                    // 6
    "length = '50 cm'",          // 7
    "height = '12 cm'",          // 8
    "fill = { count = 600 }",    // 9
    "[tray.holes]",              // 10
    "count = 5",                 // 11
    "width = '16 mm'",           // 12
    "[tray.motion]",             // 13
    "kind = 'harmonic'",         // 14
    "amplitude = '1 cm'",        // 15
    "frequency = '9 Hz'",        // 16
    "[hopper]",                  // 17
    "left = '19 cm'",            // 18
    "above = '7 cm'",            // 19
    "length = '12 cm'",          // 20
    "height = '20 cm'",          // 21
    "[numerics]",                // 22
    "[guard]",                   // 23
    "[run]",                     // 24
    "duration = '10 s'",         // 25
};

std::string joined(const std::vector<std::string>& lines) {
  std::ostringstream whole;
  for (const std::string& line : lines) whole << line << "\n";
  return whole.str();
}

struct Case {
  std::size_t line;  // replaced by the text; text starting with "+" is added after it
  const char* text;
  std::size_t error_line;  // of the message; 0: the file alone
  const char* key;
  const char* message;
};

void PrintTo(const Case& wrong, std::ostream* out) {
  *out << wrong.key << " by line " << wrong.line << ": " << std::regex_replace(wrong.text, std::regex("\n"), " / ");
}

class SceneError : public testing::TestWithParam<Case> {};

TEST_P(SceneError, NamesFileLineKeyAndReason) {
  const Case& wrong = GetParam();
  std::vector<std::string> lines = base;
  const std::string text = wrong.text;
  if (text.starts_with('+')) {
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(wrong.line), text.substr(1));
  } else {
    lines[wrong.line - 1] = text;
  }
  const TemporaryFolder folder;
  const auto file = folder.write("seeder.toml", joined(lines));
  const std::string place =
      file.string() + (wrong.error_line > 0 ? ":" + std::to_string(wrong.error_line) : "") + ": " + wrong.key + ": ";
  EXPECT_THAT([&] { read_scene(file); },
              ThrowsMessage<InputError>(AllOf(testing::StartsWith(place), HasSubstr(wrong.message))));
}

TEST(SceneErrors, BaseIsRight) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(read_scene(folder.write("seeder.toml", joined(base))));
}

TEST(SceneErrors, FileThatIsNotThereAndNotToml) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { read_scene(folder.path("none.toml")); }, ThrowsMessage<InputError>(HasSubstr("no such file")));
  const auto broken = folder.write("broken.toml", "[tray]\nlength = 5 cm\n");
  EXPECT_THAT([&] { read_scene(broken); }, ThrowsMessage<InputError>(HasSubstr("broken.toml:2: not valid TOML")));
}

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, SceneError,
    testing::Values(
        Case{12, "widht = '16 mm'", 12, "tray.holes.widht", "did you mean \"width\"?"},
        Case{12, "+spann = '16 mm'", 13, "tray.holes.spann", "did you mean \"span\"?"},
        Case{8, "+colour = 'red'", 9, "tray.colour", "unknown key"},
        Case{23, "+warn_compression = 0.1", 24, "guard.warn_compression", "it is called warn_relative_overlap now"},
        Case{25, "durration = '10 s'", 25, "run.durration", "did you mean \"duration\"?"},
        Case{6, "[tary]", 6, "tary", "did you mean \"tray\"?"},
        Case{9, "fill = { count = 600, keap = true }", 9, "tray.fill.keap", "did you mean \"keep\"?"},
        Case{5, "+[contact.wheat.wall]\nfrictoin = 1", 7, "contact.wheat.wall.frictoin", "did you mean \"friction\"?"},
        Case{5, "+rollin_friction = 0.1", 6, "contact.rollin_friction", "did you mean \"rolling_friction\"?"},
        Case{5, "+rolling = 'spring'\nroling_friction = 0.1", 7, "contact.roling_friction",
             "did you mean \"rolling_friction\"?"},
        Case{25, "+[recrod]", 26, "recrod", "did you mean \"record\"?"},
        Case{25, "+[record]\nevry = '1 s'", 27, "record.evry", "did you mean \"every\"?"},
        Case{22, "[numeric]", 22, "numeric", "did you mean \"numerics\"?"}));

INSTANTIATE_TEST_SUITE_P(
    Drill, SceneError,
    testing::Values(
        Case{25, "duration = '10 s'\n[drill]\nspeed = '8 km/h'", 26, "drill.row_spacing", "is missing"},
        Case{25, "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'", 26, "drill.speed", "is missing"},
        Case{25, "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'\nspeed = '0 km/h'", 28, "drill.speed",
             "out of range"},
        Case{25, "duration = '10 s'\n[drill]\nrow_spaceing = '15 cm'\nspeed = '8 km/h'", 27, "drill.row_spaceing",
             "did you mean \"row_spacing\"?"},
        Case{25, "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'\nspeed = '8 km/h'\nrows_per_hole = 0", 29,
             "drill.rows_per_hole", "a whole number from 1 to 1000"},
        Case{25,
             "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'\nspeed = '8 km/h'\nrows_per_hole = 2\nhole_to_row = "
             "[1, 2, 3, 4, 5]",
             29, "drill.rows_per_hole", "contradicts hole_to_row"},
        Case{25, "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'\nspeed = '8 km/h'\nhole_to_row = [1, 2, 3]", 29,
             "drill.hole_to_row", "lists 3 rows for the tray's 5 holes"},
        Case{25, "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'\nspeed = '8 km/h'\nhole_to_row = [1, 2, 4, 4, 5]",
             29, "drill.hole_to_row", "no hole feeds row 3, of 5 rows"},
        Case{25, "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'\nspeed = '8 km/h'\nhole_to_row = [1, 2, 2.5, 4, 5]",
             29, "drill.hole_to_row", "2.5 is no row"},
        Case{
            25,
            "duration = '10 s'\n[drill]\nrow_spacing = '15 cm'\nspeed = '8 km/h'\nmultiples_below = 1\nskips_above = 1",
            30, "drill.skips_above", "is not above multiples_below"}));

INSTANTIATE_TEST_SUITE_P(
    Missing, SceneError,
    testing::Values(
        Case{2, "", 1, "seeds.wheat.diameter", "is missing"}, Case{3, "", 1, "seeds.wheat.mass", "is missing"},
        Case{5, "", 4, "contact.shell_compression", "is missing"}, Case{7, "", 6, "tray.length", "is missing"},
        Case{8, "", 6, "tray.height", "is missing"}, Case{9, "", 6, "tray.fill", "nothing to sow"},
        Case{9, "fill = {}", 9, "tray.fill.count", "is missing"}, Case{11, "", 10, "tray.holes.count", "is missing"},
        Case{12, "", 10, "tray.holes.width", "is missing"}, Case{14, "", 13, "tray.motion.kind", "is missing"},
        Case{15, "", 13, "tray.motion.amplitude", "is missing"},
        Case{16, "", 13, "tray.motion.frequency", "is missing"}, Case{18, "", 17, "hopper.left", "is missing"},
        Case{19, "", 17, "hopper.above", "is missing"}, Case{25, "", 24, "run.duration", "is missing"}));

INSTANTIATE_TEST_SUITE_P(
    UnitsAndTypes, SceneError,
    testing::Values(Case{7, "length = '50'", 7, "tray.length", "\"50\": has no unit; expected a length such as"},
                    Case{7, "length = 50", 7, "tray.length", "must be a quantity with its unit"},
                    Case{7, "length = nan", 7, "tray.length", "must be a quantity with its unit"},
                    Case{7, "length = '50 kg'", 7, "tray.length", "wrong unit \"kg\""},
                    Case{7, "length = ['50 cm']", 7, "tray.length", "must be one value"},
                    Case{12, "width = 16", 12, "tray.holes.width", "must be a length such as"},
                    Case{12, "width = '16'", 12, "tray.holes.width", "is not a width"},
                    Case{12, "width = 'three diameters'", 12, "tray.holes.width", "is not a width"},
                    Case{16, "frequency = '56 rad/s'", 16, "tray.motion.frequency", "wrong unit"},
                    Case{5, "shell_compression = '1e-4'", 5, "contact.shell_compression", "must be a number"},
                    Case{9, "fill = 600", 9, "tray.fill", "must be a table"},
                    Case{9, "fill = { count = 600, keep = 'yes' }", 9, "tray.fill.keep", "true or false"}));

INSTANTIATE_TEST_SUITE_P(
    Ranges, SceneError,
    testing::Values(Case{2, "diameter = '0 mm'", 2, "seeds.wheat.diameter", "out of range"},
                    Case{2, "diameter = '-4 mm'", 2, "seeds.wheat.diameter", "out of range"},
                    Case{2, "diameter = '2 m'", 2, "seeds.wheat.diameter", "out of range"},
                    Case{2, "diameter = 'nan mm'", 2, "seeds.wheat.diameter", "does not start with a number"},
                    Case{3, "mass = '0 g'", 3, "seeds.wheat.mass", "out of range"},
                    Case{5, "shell_compression = 0", 5, "contact.shell_compression", "must be a number"},
                    Case{5, "shell_compression = 0.2", 5, "contact.shell_compression", "must be a number"},
                    Case{5, "shell_compression = nan", 5, "contact.shell_compression", "must be a number"},
                    Case{5, "+friction = -0.1", 6, "contact.friction", "from 0 to 2"},
                    Case{5, "+friction = inf", 6, "contact.friction", "from 0 to 2"},
                    Case{5, "+restitution = 0", 6, "contact.restitution", "from 0.05 to 1"},
                    Case{5, "+restitution = 1.1", 6, "contact.restitution", "from 0.05 to 1"},
                    Case{5, "+slip_speed = '0 m/s'", 6, "contact.slip_speed", "out of range"},
                    Case{5, "+drag = '-1 g/s'", 6, "contact.drag", "out of range"},
                    Case{5, "+wall = { friction = 3 }", 6, "contact.wall.friction", "from 0 to 2"},
                    Case{7, "length = '0 m'", 7, "tray.length", "from 0.001 mm to 100 m"},
                    Case{7, "length = '1e9 m'", 7, "tray.length", "from 0.001 mm to 100 m"},
                    Case{8, "height = '-1 cm'", 8, "tray.height", "out of range"},
                    Case{8, "+depth = '0 cm'", 9, "tray.depth", "out of range"},
                    Case{8, "+tilt = '31 degree'", 9, "tray.tilt", "from -30 degree to 30 degree"},
                    Case{8, "+funnel = '81 degree'", 9, "tray.funnel", "out of range"},
                    Case{8, "+funnel = '79 degree'", 9, "tray.funnel", "the floor would rise to"},
                    Case{9, "fill = { count = 0 }", 9, "tray.fill.count", "from 1 to 100000000"},
                    Case{9, "fill = { count = -5 }", 9, "tray.fill.count", "from 1 to 100000000"},
                    Case{9, "fill = { count = 1.5 }", 9, "tray.fill.count", "whole number"},
                    Case{9, "fill = { count = 100000 }", 9, "tray.fill.count", "does not fit"},
                    Case{2, "diameter = '60 cm'", 9, "tray.fill.count", "does not fit"},
                    Case{9, "fill = { count = 6, height = '3 cm' }", 9, "tray.fill.height", "contradicts count"},
                    Case{9, "fill = { height = '50 cm' }", 9, "tray.fill.height", "walls are high, 120 mm"},
                    Case{9, "fill = { height = '1 mm' }", 9, "tray.fill.height", "less than one seed of wheat"},
                    Case{9, "fill = { height = '4.05 mm', packing = 'layers', jitter = 0.1 }", 9, "tray.fill.height",
                         "no room for a seed"},
                    Case{9, "fill = { height = 3 }", 9, "tray.fill.height", "such as"},
                    Case{9, "fill = { count = 6, packing = 'layers', jitter = 0.2 }", 9, "tray.fill.jitter", "0.1"},
                    Case{11, "count = 0", 11, "tray.holes.count", "from 1 to 10000"},
                    Case{12, "width = '0 mm'", 12, "tray.holes.width", "out of range"},
                    Case{15, "amplitude = '0 mm'", 15, "tray.motion.amplitude", "out of range"},
                    Case{15, "amplitude = '11 m'", 15, "tray.motion.amplitude", "out of range"},
                    Case{16, "frequency = '0 Hz'", 16, "tray.motion.frequency", "out of range"},
                    Case{16, "frequency = '11 kHz'", 16, "tray.motion.frequency", "out of range"},
                    Case{16, "+ramp = '-1 s'", 17, "tray.motion.ramp", "out of range"},
                    Case{19, "above = '-7 cm'", 19, "hopper.above", "out of range"},
                    Case{22, "+dt = '0 s'", 23, "numerics.dt", "out of range"},
                    Case{22, "+steps_per_contact = 0", 23, "numerics.steps_per_contact", "must be a number"},
                    Case{23, "+stop_relative_overlap = 0", 24, "guard.stop_relative_overlap", "must be a number"},
                    Case{23, "+stop_relative_overlap = 0.01", 24, "guard.stop_relative_overlap", "before it warns"},
                    Case{25, "duration = '0 s'", 25, "run.duration", "out of range"},
                    Case{25, "duration = '1e7 s'", 25, "run.duration", "out of range"},
                    Case{25, "+measure_from = '10 s'", 26, "run.measure_from", "not before the end of the run"},
                    Case{25, "+count_below = '0 mm'", 26, "run.count_below", "out of range"}));

INSTANTIATE_TEST_SUITE_P(
    Choices, SceneError,
    testing::Values(
        Case{5, "+law = 'spring'", 6, "contact.law", "is not one of elastic-shell, hertz"},
        Case{5, "+friction_arm = 'rimm'", 6, "contact.friction_arm", "did you mean \"rim\"?"},
        Case{3, "+shape = 'cube'", 4, "seeds.wheat.shape", "is not one of disc, ball"},
        Case{9, "fill = { count = 6, packing = 'pored' }", 9, "tray.fill.packing", "did you mean \"poured\"?"},
        Case{14, "kind = 'rocking'", 13, "tray.motion.pivot", "expected the point it turns about"},
        Case{14, "kind = 'turning'", 13, "tray.motion.speed", "is missing"},
        Case{14, "kind = 'turning'\nspeed = '0 rpm'", 15, "tray.motion.speed", "turns in time"},
        Case{14, "kind = 'turning'\nspeed = '6 rpm'", 13, "tray.motion.pivot", "expected where the axis passes"},
        Case{14, "kind = 'turning'\nspeed = '6 rpm'\naxis = 'up'", 16, "tray.motion.axis", "is not one of across"},
        Case{14, "kind = 'turning'\nspeed = '6 rpm'\npivot = ['1 cm', '1 cm']", 10, "tray.holes",
             "turns over and over"},
        Case{14, "kind = 'turning'\nspeed = '6 rpm'\naxis = 'upright'\npivot = ['1 cm', '1 cm']", 16,
             "tray.motion.axis", "only with space"},
        Case{8, "+pieces = [{ line = [['1 cm', '1 cm'], ['2 cm', '1 cm']], about = ['1 cm', '1 cm'] }]", 9,
             "tray.pieces[1].about", "only with space"},
        Case{8, "+pieces = [{ line = [['1 cm', '2 cm']] }]", 9, "tray.pieces[1].line", "single point"},
        Case{8, "+pieces = [{ line = [['1 cm'], ['2 cm']] }]", 9, "tray.pieces[1].line", "a list of two"},
        Case{8, "+pieces = [{ radius = '2 cm' }]", 9, "tray.pieces[1].centre", "expected line"},
        Case{8, "+pieces = [{ centre = ['1 cm', '1 cm'], radius = '2 cm', from = '90 degree', to = '10 degree' }]", 9,
             "tray.pieces[1].to", "anticlockwise from 90 to 10 degree"},
        Case{8, "+box = false", 9, "tray.box", "needs pieces"},
        Case{8, "+sides = 'none'", 9, "tray.sides", "is not one of walls, open, periodic"},
        Case{8, "+sides = 'periodic'\ntilt = '1 degree'", 9, "tray.sides", "cannot be tilted"},
        Case{21, "+sides = 'periodic'", 22, "hopper.sides", "only the tray"},
        Case{12, "+open_at = ['1 s', '2 s']", 13, "tray.holes.open_at", "lists 2 times for 5 holes"},
        Case{8, "+rain = { rate = '20 Hz' }", 9, "tray.rain.rate", "wrong unit"},
        Case{8, "+rain = { from = '2 cm' }", 9, "tray.rain.rate", "is missing"},
        Case{8, "+rain = { rate = '20 1/s', from = '2 cm', to = '1 cm' }", 9, "tray.rain.to",
             "is left of from = 20 mm"},
        Case{8, "+rain = { rate = '20 1/s', start = '2 s', stop = '2 s' }", 9, "tray.rain.stop", "not after the start"},
        Case{14, "kind = 'sum'", 13, "tray.motion.components", "is missing"},
        Case{14, "kind = 'table'", 13, "tray.motion.file", "is missing"},
        Case{14, "kind = 'table'\nfile = 'nowhere.csv'", 15, "tray.motion.file", "there is no file"},
        Case{16, "+stop_ramp = '1 s'", 17, "tray.motion.stop_ramp", "goes with stop"},
        Case{16, "+pivot = ['1 cm', '0 cm']", 17, "tray.motion.pivot", "unknown key"},
        Case{14, "kind = 'circular'", 14, "tray.motion.kind", "is not one of"},
        Case{22, "+integrator = 'verlet'", 23, "numerics.integrator",
             "is not one of velocity-verlet, rk2-midpoint, gear5"},
        Case{25, "+start = 'now'", 26, "run.start", "is not one of at-rest, with-tray"},
        Case{1, "[seeds.all]", 1, "seeds.all", "is not \"all\" or \"wall\""},
        Case{1, "[seeds.'a,b']", 1, "seeds.a,b", "letters, digits"},
        Case{3, "+crop = 'weat'", 4, "seeds.wheat.crop", "did you mean \"wheat\"?"},
        Case{3, "+crop = 'none.toml'", 4, "seeds.wheat.crop", "there is no file"},
        Case{5, "+model = 'wheat-steal'", 6, "contact.model", "did you mean \"wheat-steel\"?"}));

INSTANTIATE_TEST_SUITE_P(
    Contradictions, SceneError,
    testing::Values(
        Case{3, "+density = '1200 kg/m3'", 4, "seeds.wheat.density", "contradicts mass"},
        Case{3, "density = '1200 kg/m3'\nshape = 'disc'", 3, "seeds.wheat.density", "no thickness"},
        Case{3, "+mass_fraction = '40 %'", 4, "seeds.wheat.mass_fraction", "sum to 40 %"},
        Case{3, "+mass_fraction = '40 %'\nnumber_fraction = '60 %'", 5, "seeds.wheat.number_fraction", "contradicts"},
        Case{3, "+[seeds.pea]\ndiameter = '7 mm'\nmass = '0.2 g'", 1, "seeds.wheat.mass_fraction", "is missing"},
        Case{3, "+mass_fraction = '40 %'\n[seeds.pea]\ndiameter = '7 mm'\nmass = '0.2 g'\nmass_fraction = '50 %'", 8,
             "seeds.pea.mass_fraction", "sum to 90 %"},
        Case{3, "+mass_fraction = '40 %'\n[seeds.pea]\ndiameter = '7 mm'\nmass = '0.2 g'\nnumber_fraction = '60 %'", 8,
             "seeds.pea.number_fraction", "another lot has mass_fraction"},
        Case{12, "+span = '30 cm'\npitch = '7 cm'", 14, "tray.holes.pitch", "contradicts span"},
        Case{12, "+at = ['10 cm']", 11, "tray.holes.count", "contradicts at"},
        Case{11, "at = ['10 cm']\nspan = '3 cm'", 12, "tray.holes.span", "contradicts at"},
        Case{11, "at = ['10 cm']\ncentre = '3 cm'", 12, "tray.holes.centre", "contradicts at"},
        Case{11, "at = ['10 cm']\npitch = '3 cm'", 12, "tray.holes.pitch", "contradicts at"},
        Case{12, "width = ['1 cm', '2 cm']", 12, "tray.holes.width", "lists 2 widths for 5 holes"},
        Case{9, "fill = { count = 6, jitter = 0.01 }", 9, "tray.fill.jitter", "poured seeds are dropped"},
        Case{1, "accuracy = 'finest'\n[seeds.wheat]", 1, "accuracy", "neither \"draft\", \"design\" nor"},
        Case{1, "accuracy = '0.001 %'\n[seeds.wheat]", 1, "accuracy", "the finest level errs by up to"},
        Case{1, "accuracy = '-3 %'\n[seeds.wheat]", 1, "accuracy", "range"},
        Case{22, "+dt = '1e-5 s'\nsteps_per_contact = 20", 24, "numerics.steps_per_contact", "contradicts dt"},
        Case{20, "+funnel = '20 degree'", 21, "hopper.funnel", "needs holes"}));

INSTANTIATE_TEST_SUITE_P(
    Holes, SceneError,
    testing::Values(
        Case{12, "+span = '49 cm'", 13, "tray.holes.span", "hole 1 at 5 mm, 16 mm wide, is not within the floor"},
        Case{12, "+pitch = '12.5 cm'", 13, "tray.holes.pitch", "hole 1 at 0 mm, 16 mm wide, is not within"},
        Case{12, "+centre = '40 cm'", 13, "tray.holes.centre", "hole 5 at 566.667 mm, 16 mm wide, is not within"},
        Case{12, "width = '10 cm'", 12, "tray.holes.width",
             "hole 1 at 83.3333 mm, 100 mm wide, overlaps or touches"
             " hole 2 at 166.667 mm"},
        Case{12, "+span = '64 mm'", 13, "tray.holes.span", "hole 1 at 218 mm, 16 mm wide, overlaps or touches hole 2"},
        Case{11, "at = ['49.5 cm', '10 cm']", 11, "tray.holes.at", "hole 2 at 495 mm, 16 mm wide, is not within"},
        Case{11, "at = ['10 cm', '30 cm', '11 cm']", 11, "tray.holes.at",
             "hole 1 at 100 mm, 16 mm wide, overlaps or"
             " touches hole 2 at 110 mm"},
        Case{11, "at = []", 11, "tray.holes.at", "the list is empty"},
        Case{11, "at = [10, 20]", 11, "tray.holes.at", "must be a quantity with its unit"}));

constexpr const char* two_lots =
    "mass = '30 mg'\nmass_fraction = '50 %'\n[seeds.pea]\ndiameter = '7 mm'\nmass = '0.2 g'\nmass_fraction = '50 %'";

INSTANTIATE_TEST_SUITE_P(
    Laws, SceneError,
    testing::Values(
        Case{5, "+law = 'hertz'", 5, "contact.shell_compression", "belongs to the elastic shell"},
        Case{5, "law = 'hertz'", 4, "contact.youngs_modulus",
             "is missing; law = \"hertz\" needs it here or in every lot"},
        Case{5, "+youngs_modulus = '1 GPa'", 6, "contact.youngs_modulus", "belongs to law = \"hertz\""},
        Case{5, "+poisson_ratio = 0.2", 6, "contact.poisson_ratio", "belongs to law = \"hertz\""},
        Case{5, "+damping_rate = '1 1/s'", 6, "contact.damping_rate", "belongs to law = \"hertz\""},
        Case{5, "+wall = { youngs_modulus = '1 GPa' }", 6, "contact.wall.youngs_modulus", "belongs to law = \"hertz\""},
        Case{5, "+wall = { poisson_ratio = 0.2 }", 6, "contact.wall.poisson_ratio", "belongs to law = \"hertz\""},
        Case{3, "+youngs_modulus = '1 GPa'", 4, "seeds.wheat.youngs_modulus", "belongs to law = \"hertz\""},
        Case{3, "+poisson_ratio = 0.2", 4, "seeds.wheat.poisson_ratio", "belongs to law = \"hertz\""},
        Case{5, "law = 'hertz'\nyoungs_modulus = '1 GPa'\nwall = { poisson_ratio = 0.2 }", 7,
             "contact.wall.poisson_ratio", "without which walls are rigid"},
        Case{22, "+impact_speed = '1 m/s'", 23, "numerics.impact_speed", "belongs to law = \"hertz\""}));

INSTANTIATE_TEST_SUITE_P(
    LawRanges, SceneError,
    testing::Values(
        Case{3, "+shell_compression = 0.2", 4, "seeds.wheat.shell_compression", "must be a number from"},
        Case{3, "+youngs_modulus = '0 Pa'", 4, "seeds.wheat.youngs_modulus", "out of range"},
        Case{3, "+poisson_ratio = 0.6", 4, "seeds.wheat.poisson_ratio", "from 0 to 0.5"},
        Case{5, "law = 'hertz'\nyoungs_modulus = '0 Pa'", 6, "contact.youngs_modulus", "from 1 Pa to 1e+13 Pa"},
        Case{5, "law = 'hertz'\nyoungs_modulus = 5e10", 6, "contact.youngs_modulus", "a pressure such as \"5e4 MPa\""},
        Case{1, "space = '2D'\n[seeds.wheat]", 1, "space", "is not one of 2d, 3d; did you mean \"2d\"?"},
        Case{2, "diameter = '1,200 mm'", 2, "seeds.wheat.diameter", "\"1200 mm\" or \"1.200 mm\""},
        Case{5, "law = 'hertz'\nyoungs_modulus = '5 N'", 6, "contact.youngs_modulus", "wrong unit \"N\""},
        Case{5, "law = 'hertz'\nyoungs_modulus = '1 GPa'\npoisson_ratio = 0.51", 7, "contact.poisson_ratio",
             "0 to 0.5"},
        Case{5, "law = 'hertz'\nyoungs_modulus = '1 GPa'\ndamping_rate = '-1 1/s'", 7, "contact.damping_rate",
             "out of range, which is from 0 1/s to 1e+09 1/s"},
        Case{5, "law = 'hertz'\nyoungs_modulus = '1 GPa'\ndamping_rate = '9 Hz'", 7, "contact.damping_rate",
             "wrong unit \"Hz\": counts cycles; write 1/s; expected a rate such as \"2.1e4 1/s\""},
        Case{22, "+impact_speed = '0 m/s'", 23, "numerics.impact_speed", "out of range"},
        Case{5, "+cohesion = '-1 mN'", 6, "contact.cohesion", "out of range"},
        Case{5, "+cohesion = '1 mg'", 6, "contact.cohesion", "expected a force such as \"0.2 mN\""},
        Case{5, "+rolling_friction = 2.1", 6, "contact.rolling_friction", "from 0 to 2"},
        Case{5, "+rolling_damping = 11", 6, "contact.rolling_damping", "from 0 to 10"},
        Case{5, "+tangential_ratio = 0", 6, "contact.tangential_ratio", "from 0.01 to 10"},
        Case{5, "+tangential_damping = -1", 6, "contact.tangential_damping", "from 0 to 10"}));

INSTANTIATE_TEST_SUITE_P(
    Damping, SceneError,
    testing::Values(
        Case{5, "law = 'hertz'\nyoungs_modulus = '1 GPa'\ndamping_rate = '1 1/s'\nrestitution = 0.5", 7,
             "contact.damping_rate", "contradicts contact.restitution; give one of them"},
        Case{5, "law = 'hertz'\nyoungs_modulus = '1 GPa'\ndamping_rate = '1 1/s'\nwall = { restitution = 0.5 }", 7,
             "contact.damping_rate", "contradicts contact.wall.restitution; give one of them"},
        Case{5, "law = 'hertz'\nyoungs_modulus = '1 GPa'\ndamping_rate = '1 1/s'\nwheat.wall = { restitution = 0.5 }",
             7, "contact.damping_rate", "contradicts contact.wheat.wall.restitution; give one of them"},
        Case{5,
             "law = 'hertz'\nyoungs_modulus = '1 GPa'\ndamping_rate = '1 1/s'\nmodel = 'wheat-steel'\n"
             "restitution = 0.5",
             7, "contact.damping_rate", "contradicts contact.restitution; give one of them"}));

INSTANTIATE_TEST_SUITE_P(FrictionModels, SceneError,
                         testing::Values(Case{5, "+friction_model = 'springs'", 6, "contact.friction_model",
                                              "did you mean \"spring\"?"},
                                         Case{5, "+friction_model = 'spring'\nslip_speed = '20 mm/s'", 7,
                                              "contact.slip_speed", "neither is chosen"},
                                         Case{5, "+tangential_ratio = 1", 6, "contact.tangential_ratio",
                                              "needs friction_model = \"spring\""},
                                         Case{5, "+friction_model = 'sliding'\ntangential_damping = 1", 7,
                                              "contact.tangential_damping", "needs friction_model = \"spring\""}));

INSTANTIATE_TEST_SUITE_P(
    RollingModels, SceneError,
    testing::Values(
        Case{5, "+rolling = 'viscous'", 6, "contact.rolling", "is not one of none, constant-torque, spring"},
        Case{5, "+rolling_friction = 0.1", 6, "contact.rolling_friction",
             "needs rolling = \"constant-torque\" or \"spring\""},
        Case{5, "+rolling = 'none'\nrolling_friction = 0.1", 7, "contact.rolling_friction", "needs rolling = "},
        Case{5, "+wall = { rolling_friction = 0.1 }", 6, "contact.wall.rolling_friction", "needs rolling = "},
        Case{5, "+wheat.wheat = { rolling_friction = 0.1 }", 6, "contact.wheat.wheat.rolling_friction",
             "needs rolling = "},
        Case{5, "+rolling = 'spring'", 4, "contact.rolling_friction", "is missing; a rolling model needs it"},
        Case{5, "+rolling = 'spring'\nrolling_friction = 0.1\nrotation = false", 6, "contact.rolling",
             "needs rotation"},
        Case{5, "+rolling = 'constant-torque'\nrolling_friction = 0.1\nrolling_damping = 0.1", 8,
             "contact.rolling_damping", "needs rolling = \"spring\""},
        Case{5, "+rolling_damping = 0.1", 6, "contact.rolling_damping", "needs rolling = \"spring\""}));

INSTANTIATE_TEST_SUITE_P(
    Pairs, SceneError,
    testing::Values(
        Case{5, "+[contact.weat.wall]\nfriction = 0.1", 6, "contact.weat",
             "\"weat\" is not one of wheat, wall; did you mean \"wheat\"?"},
        Case{5, "+[contact.wal]\nfriction = 0.1", 6, "contact.wal", "did you mean \"wall\"?"},
        Case{5, "+[contact.wheat.wal]\nfriction = 0.1", 6, "contact.wheat.wal", "did you mean \"wall\"?"},
        Case{5, "+[contact.wheat]\nfriction = 0.1", 7, "contact.wheat.friction",
             "a pair of materials is [contact.LOT.LOT] or [contact.LOT.wall]"},
        Case{5, "+wheat = 0.1", 6, "contact.wheat", "unknown key"},
        Case{5, "+wheat.wall = 0.1", 6, "contact.wheat.wall", "must be a table"},
        Case{5, "+wheat.wall = { friction = 3 }", 6, "contact.wheat.wall.friction", "from 0 to 2"},
        Case{5, "+wheat.wall = { slip_speed = '1 m/s' }", 6, "contact.wheat.wall.slip_speed", "unknown key"},
        Case{5, "+wall.wheat = { friction = 0.1 }", 6, "contact.wall.wheat", "is written [contact.wheat.wall]"}));

TEST(SceneErrors, ShellOfALotUnderHertz) {
  std::vector<std::string> lines = base;
  lines[2] += "\nshell_compression = 1e-4";
  lines[4] = "law = 'hertz'\nyoungs_modulus = '1 GPa'";
  const TemporaryFolder folder;
  const auto file = folder.write("seeder.toml", joined(lines));
  EXPECT_THAT([&] { read_scene(file); },
              ThrowsMessage<InputError>(
                  HasSubstr("seeder.toml:4: seeds.wheat.shell_compression: belongs to the elastic shell")));
}

INSTANTIATE_TEST_SUITE_P(
    CannotBeMeant, SceneError,
    testing::Values(Case{3, "mass = '40 g'", 3, "seeds.wheat.mass",
                         "it looks like the mass of a thousand seeds: give thousand_grain_weight = \"40 g\""},
                    Case{8, "+depth = '3.9 mm'", 9, "tray.depth",
                         "3.9 mm is less than one seed of wheat, which is 4 mm thick"}));

TEST(SceneErrors, APairGivenTwice) {
  std::vector<std::string> lines = base;
  lines[2] = two_lots;
  lines[4] += "\n[contact.wheat.pea]\nfriction = 0.1\n[contact.pea.wheat]\nfriction = 0.2";
  const TemporaryFolder folder;
  const auto file = folder.write("seeder.toml", joined(lines));
  EXPECT_THAT([&] { read_scene(file); },
              ThrowsMessage<InputError>(HasSubstr(
                  "seeder.toml:13: contact.pea.wheat: is the pair contact.wheat.pea again; give one of them")));
}

INSTANTIATE_TEST_SUITE_P(
    Records, SceneError,
    testing::Values(
        Case{25, "+[record]", 26, "record.times", "is missing; give times such as [\"2 s\", \"6 s\"], or every"},
        Case{25, "+[record]\ntimes = '2 s'\nevery = '1 s'", 28, "record.every", "contradicts times"},
        Case{25, "+[record]\ntimes = ['2 s', '11 s']", 27, "record.times", "\"11 s\" is out of range"},
        Case{25, "+[record]\ntimes = ['-1 s']", 27, "record.times", "out of range, which is from 0 s to 10 s"},
        Case{25, "+[record]\ntimes = ['3 s', '2 s']", 27, "record.times", "2 s after 3 s; expected ascending times"},
        Case{25, "+[record]\ntimes = ['3 s', '3 s']", 27, "record.times", "3 s after 3 s; expected ascending times"},
        Case{25, "+[record]\ntimes = []", 27, "record.times", "the list is empty"},
        Case{25, "+[record]\ntimes = [1, 2]", 27, "record.times", "must be a quantity with its unit"},
        Case{25, "+[record]\nevery = '0 s'", 27, "record.every", "out of range"},
        Case{25, "+[record]\nevery = '11 s'", 27, "record.every", "out of range"},
        Case{25, "+[record]\nevery = '10 us'", 27, "record.every", "asks for 1000001 snapshots, more than 100000"},
        Case{25, "+[record]\nevery = '1 s'\ncell = '2 x'", 28, "record.cell", "is not a cell; expected a length"},
        Case{25, "+[record]\nevery = '1 s'\ncell = '0 diameters'", 28, "record.cell", "out of range"},
        Case{25, "+[record]\nevery = '1 s'\ncell = '0.001 mm'", 28, "record.cell", "makes maps of 1.35e+11 cells"},
        Case{25, "+[record]\nevery = '1 s'\ncell = 2", 28, "record.cell", "in quotes"}));

/// What is listed or counted without end would take all memory.
TEST(SceneErrors, ListsAndMapsHaveAnEnd) {
  const auto listed = [](std::size_t count, const std::string& element) {
    std::string list = "[";
    for (std::size_t k = 0; k < count; ++k) list += (k > 0 ? ", " : "") + element;
    return list + "]";
  };
  struct Long {
    std::size_t line, from;  // the first that are too many
    std::string start, element, end, key;
  };
  const std::vector<Long> cases = {
      {13, 101, "components = ", "{ amplitude = '1 mm', frequency = '9 Hz' }", "", "tray.motion.components"},
      {3, 1001, "sizes = { distribution = 'table', diameters = ", "'4 mm'", ", fractions = ['100 %'] }",
       "seeds.wheat.sizes.diameters"},
      {2, 101, "shape = 'discs'\ndiscs = ", "{ x = '0 mm', y = '0 mm', diameter = '4 mm' }", "", "seeds.wheat.discs"},
      {8, 20001, "pieces = ", "{ line = [['1 cm', '2 cm'], ['3 cm', '2 cm']] }", "", "tray.pieces"},
      {11, 10001, "at = ", "'1 cm'", "", "tray.holes.at"},
      {25, 100001, "[record]\ntimes = ", "'1 s'", "", "record.times"},
  };
  const TemporaryFolder folder;
  for (const Long& one : cases) {
    std::vector<std::string> lines = base;
    if (one.key == "tray.motion.components") lines[13] = "kind = 'sum'", lines[14] = "", lines[15] = "";
    if (one.key.starts_with("seeds.wheat")) lines[1] = "";
    if (one.key == "tray.holes.at") lines[10] = "";
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(one.line),
                 one.start + listed(one.from, one.element) + one.end);
    const auto file = folder.write("seeder.toml", joined(lines));
    EXPECT_THAT([&] { read_scene(file); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(one.key + ": "), HasSubstr(", more than "))));
  }
}

TEST(SceneErrors, LotsHaveAnEnd) {
  std::vector<std::string> lines(base.begin() + 3, base.end());
  for (int lot = 0; lot <= 100; ++lot)
    lines.push_back("[seeds.s" + std::to_string(lot) + "]\ndiameter = '4 mm'\nmass = '30 mg'\nnumber_fraction = '1 %'");
  const TemporaryFolder folder;
  const auto file = folder.write("seeder.toml", joined(lines));
  EXPECT_THAT([&] { read_scene(file); }, ThrowsMessage<InputError>(HasSubstr("seeds: lists 101, more than 100")));
}

}  // namespace
}  // namespace vibrosow
