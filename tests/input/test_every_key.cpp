// Every key of a seeder file: the units that it takes and those that it refuses, and that neither space loses it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow::every_key_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Units = std::vector<std::string>;

/// What each trade writes. A new unit of the program stands here too.
const std::map<std::string, Units> units_of_kind = {
    {"length",
     {"mm", "cm", "m", "dm", "um", "µm", "μm", "micron", "microns", "in", "inch", "inches", "\"", "ft", "foot",
      "feet"}},
    {"time",
     {"s", "ms", "us", "µs", "ns", "sec", "second", "seconds", "min", "minute", "minutes", "h", "hr", "hrs", "hour",
      "hours"}},
    {"frequency", {"Hz", "kHz", "rpm", "1/min", "r/min"}},
    {"seed mass", {"g", "mg", "ug", "µg", "kg"}},
    {"drag", {"g/s", "kg/s", "mg/s", "N*s/m", "N·s/m", "mN*s/m", "uN*s/m"}},
    {"speed", {"mm/s", "cm/s", "m/s", "um/s", "m/min", "in/s", "ft/s", "mm s-1"}},
    {"travel speed", {"km/h", "kmh", "kph", "mph", "mi/h", "m/s", "m/min", "ft/min", "km / h"}},
    {"angle", {"degree", "degrees", "deg", "°", "º", "rad", "mrad", "radian", "radians"}},
    {"density",
     {"kg/m3", "kg/m³", "kg/m^3", "kg m-3", "kg·m⁻³", "g/cm3", "g/cm³", "g/cc", "kg/dm3", "kg/l", "kg/L", "g/ml",
      "mg/mm3", "t/m3", "lb/ft3"}},
    {"bulk density", {"kg/m3", "kg/m³", "kg/m^3", "kg m-3", "kg·m⁻³", "g/cm3", "g/cm³", "g/cc",   "kg/dm3", "kg/l",
                      "kg/L",  "g/l",   "g/L",    "g/ml",   "t/m3",   "kg/hl", "kg/hL", "lb/ft3", "lb/bu",  "lbs/bu"}},
    {"force", {"mN", "N", "uN", "µN", "nN", "kN"}},
    {"pressure", {"MPa", "Pa", "kPa", "GPa", "N/mm2", "N/mm²", "N/m2", "bar", "psi"}},
    {"rate", {"1/s", "1/ms", "1/min"}},
    {"seeds per time", {"1/s", "1/ms", "1/min", "1/h", "seeds/s", "seeds/min", "seeds/h"}},
    {"fraction", {"%", "percent"}},
};

/// What no key of a seeder takes, though udunits2 knows most of it.
const Units traps = {"gr",    "grain", "gm",   "oz",   "lb",    "lbf", "kgf",   "t",    "ton", "a",     "d",    "day",
                     "mn",    "M",     "mPa",  "mpa",  "C",     "K",   "rad/s", "Hz/s", "1/m", "s/m",   "km/s", "mi",
                     "nmi",   "pt",    "qt",   "gal",  "st",    "ac",  "ha",    "bu",   "cc",  "kg/ha", "kg/a", "t/ha",
                     "lb/ac", "1/m2",  "mm2",  "mm 3", "S",     "H",   "A",     "-",    "m-1", "m^",    "(mm)", "2mm",
                     "mm/",   "*",     "kg/m", "g/m2", "seeds", "hz",  "RPM",   "Mm",   "px",  "mol",   "yd"};

struct Key {
  std::string key;
  std::string kind;                       // of its unit; empty: none
  std::string value;                      // as TOML; @ stands for a quantity
  std::string quantity = {};              // one that it takes
  std::vector<std::string> context = {};  // KEY=VALUE beside it, KEY= to take one out
  bool changes_scene = true;
};

const std::string quoted = "'@'";
const std::vector<std::string> hertz = {"contact.law='hertz'", "contact.youngs_modulus='100 MPa'",
                                        "contact.shell_compression="};
const std::vector<std::string> rolls = {"contact.rolling='spring'", "contact.rolling_friction=0.1"};
const std::vector<std::string> two_lots = {"seeds.yarrow.diameter='5 mm'", "seeds.yarrow.mass='60 mg'"};
const std::vector<std::string> long_seed = {
    "seeds.wheat.shape='elongated'", "seeds.wheat.diameter=", "seeds.wheat.length='6 mm'", "seeds.wheat.width='3 mm'"};
const std::vector<std::string> shaken = {"tray.motion.kind='harmonic'", "tray.motion.amplitude='3 mm'",
                                         "tray.motion.frequency='9 Hz'"};
const std::vector<std::string> rocks = {"tray.motion.kind='rocking'", "tray.motion.pivot=['2 cm', '0 cm']",
                                        "tray.motion.angle='2 degree'", "tray.motion.frequency='3 Hz'"};
const std::vector<std::string> drums = {"tray.motion.kind='turning'", "tray.motion.pivot=['2 cm', '2 cm']",
                                        "tray.motion.speed='6 rpm'", "tray.holes="};
const std::vector<std::string> rains = {"tray.rain.rate='50 1/s'"};
const std::vector<std::string> fed = {"hopper.length='10 cm'", "hopper.height='5 cm'", "hopper.left='5 cm'",
                                      "hopper.above='11 cm'", "hopper.fill.count=20"};
const std::vector<std::string> recorded = {"record.times='1 s'"};
const std::vector<std::string> drilled = {"drill.row_spacing='15 cm'", "drill.speed='8 km/h'"};
const std::vector<std::string> normal = {"seeds.wheat.sizes.distribution='normal'",
                                         "seeds.wheat.sizes.deviation='0.2 mm'"};
const std::vector<std::string> table_of_sizes = {"seeds.wheat.diameter=", "seeds.wheat.sizes.distribution='table'",
                                                 "seeds.wheat.sizes.diameters=['3 mm', '4 mm']",
                                                 "seeds.wheat.sizes.fractions=['50 %', '50 %']"};

std::vector<std::string> with(std::vector<std::string> context, const std::vector<std::string>& more) {
  context.insert(context.end(), more.begin(), more.end());
  return context;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> all = {
      {"title", "", "'another'"},
      {"accuracy", "", "'draft'"},
      {"seeds.wheat.crop", "", "'wheat'", "", {"seeds.wheat.diameter=", "seeds.wheat.mass="}},
      {"seeds.wheat.contact",
       "",
       "'pea-steel'",
       "",
       {"contact.model='crop'", "contact.friction=", "contact.shell_compression="}},
      {"seeds.wheat.diameter", "length", quoted, "5 mm"},
      {"seeds.wheat.mass", "seed mass", quoted, "45 mg"},
      {"seeds.wheat.thousand_grain_weight", "seed mass", quoted, "45 g", {"seeds.wheat.mass="}},
      {"seeds.wheat.density", "density", quoted, "1300 kg/m3", {"seeds.wheat.mass="}},
      {"seeds.wheat.bulk_density", "bulk density", quoted, "780 kg/m3", {}, false},
      {"seeds.wheat.angle_of_repose", "angle", quoted, "25 degree", {}, false},
      {"seeds.wheat.moisture", "fraction", quoted, "12 %", {}, false},
      {"seeds.wheat.shell_compression", "", "2e-4"},
      {"seeds.wheat.youngs_modulus", "pressure", quoted, "50 MPa", hertz},
      {"seeds.wheat.poisson_ratio", "", "0.2", "", hertz},
      {"seeds.wheat.shape", "", "'drop'", "", long_seed},
      {"seeds.wheat.length", "length", quoted, "7 mm", long_seed},
      {"seeds.wheat.width", "length", quoted, "2.5 mm", long_seed},
      {"seeds.wheat.thickness", "length", quoted, "2 mm", long_seed},
      {"seeds.wheat.distance", "length", quoted, "2 mm", {"seeds.wheat.shape='dipole'"}},
      {"seeds.wheat.discs",
       "length",
       "[{ x = '0 mm', y = '0 mm', diameter = '3 mm' }, { x = '2 mm', y = '0 mm', z = '1 mm', diameter = '@' }]",
       "3 mm",
       {"seeds.wheat.shape='discs'", "seeds.wheat.diameter="}},
      {"seeds.wheat.discs",
       "length",
       "[{ x = '0 mm', y = '0 mm', diameter = '3 mm' }, { x = '2 mm', y = '0 mm', z = '@', diameter = '3 mm' }]",
       "1 mm",
       {"seeds.wheat.shape='discs'", "seeds.wheat.diameter="}},
      {"seeds.wheat.sizes.distribution", "", "'lognormal'", "", normal},
      {"seeds.wheat.sizes.deviation", "length", quoted, "0.3 mm", normal},
      {"seeds.wheat.sizes.least", "length", quoted, "3.5 mm", normal},
      {"seeds.wheat.sizes.most", "length", quoted, "4.5 mm", normal},
      {"seeds.wheat.sizes.diameters", "length", "['@', '5 mm']", "4 mm", table_of_sizes},
      {"seeds.wheat.sizes.lengths", "length", "['@', '5 mm']", "4 mm",
       with(long_seed, {"seeds.wheat.length=", "seeds.wheat.sizes.distribution='table'",
                        "seeds.wheat.sizes.fractions=['50 %', '50 %']"})},
      {"seeds.wheat.sizes.fractions", "fraction", "['@', '70 %']", "30 %", table_of_sizes},
      {"seeds.wheat.sizes.mass_fractions", "fraction", "['@', '70 %']", "30 %",
       with(table_of_sizes, {"seeds.wheat.sizes.fractions="})},
      {"seeds.wheat.sizes",
       "length",
       "{ distribution = 'uniform', least = '3 mm', most = '@' }",
       "5 mm",
       {"seeds.wheat.diameter="}},
      {"seeds.wheat.mass_fraction", "fraction", quoted, "60 %", with(two_lots, {"seeds.yarrow.mass_fraction='40 %'"})},
      {"seeds.wheat.number_fraction", "fraction", quoted, "60 %",
       with(two_lots, {"seeds.yarrow.number_fraction='40 %'"})},
      {"contact.model", "", "'wheat-steel'", "", {"contact.shell_compression=", "contact.friction="}},
      {"contact.law", "", "'hertz'", "", hertz},
      {"contact.shell_compression", "", "3e-4"},
      {"contact.youngs_modulus", "pressure", quoted, "60 MPa", hertz},
      {"contact.poisson_ratio", "", "0.2", "", hertz},
      {"contact.damping_rate", "rate", quoted, "2e4 1/s", hertz},
      {"contact.friction", "", "0.4"},
      {"contact.restitution", "", "0.4"},
      {"contact.cohesion", "force", quoted, "0.1 mN"},
      {"contact.rolling", "", "'constant-torque'", "", rolls},
      {"contact.rolling_friction", "", "0.2", "", rolls},
      {"contact.rolling_damping", "", "0.2", "", rolls},
      {"contact.twisting_friction", "", "0.2", "", rolls},
      {"contact.friction_model", "", "'spring'"},
      {"contact.slip_speed", "speed", quoted, "30 mm/s"},
      {"contact.tangential_ratio", "", "0.5", "", {"contact.friction_model='spring'"}},
      {"contact.tangential_damping", "", "0.4", "", {"contact.friction_model='spring'"}},
      {"contact.drag", "drag", quoted, "1 g/s"},
      {"contact.rotation", "", "false"},
      {"contact.friction_arm", "", "'rim'"},
      {"contact.wall.friction", "", "0.5"},
      {"contact.wall.restitution", "", "0.5"},
      {"contact.wall.cohesion", "force", quoted, "0.1 mN"},
      {"contact.wall.rolling_friction", "", "0.2", "", rolls},
      {"contact.wall.youngs_modulus", "pressure", quoted, "200 GPa", hertz},
      {"contact.wall.poisson_ratio", "", "0.2", "", with(hertz, {"contact.wall.youngs_modulus='200 GPa'"})},
      {"contact.wheat.wheat.friction", "", "0.6", "", {"contact.wheat.wall.friction=0.5"}},
      {"tray.length", "length", quoted, "50 cm"},
      {"tray.height", "length", quoted, "12 cm"},
      {"tray.depth", "length", quoted, "8 cm"},
      {"tray.tilt", "angle", quoted, "2 degree"},
      {"tray.funnel", "angle", quoted, "10 degree"},
      {"tray.plan", "", "'round'", "", {"tray.length='6 cm'", "tray.holes.shape='round'", "tray.holes.count=1"}},
      {"tray.front_and_back", "", "'periodic'"},
      {"tray.fill.count", "", "50"},
      {"tray.fill.height", "length", quoted, "3 cm", {"tray.fill.count="}},
      {"tray.fill.packing", "", "'hexagonal'"},
      {"tray.fill.jitter", "", "0.01", "", {"tray.fill.packing='layers'"}},
      {"tray.fill.keep", "", "true"},
      {"tray.pieces", "length", "[{ line = [['3 cm', '5 cm'], ['@', '5 cm']] }]", "6 cm"},
      {"tray.pieces", "length", "[{ centre = ['20 cm', '5 cm'], radius = '@' }]", "1 cm"},
      {"tray.pieces", "angle", "[{ centre = ['20 cm', '5 cm'], radius = '1 cm', from = '0 degree', to = '@' }]",
       "90 degree"},
      {"tray.pieces", "length", "{ file = 'outline.svg', at = ['@', '5 cm'] }", "5 cm"},
      {"tray.pieces", "length", "{ file = 'outline.svg', at = ['1 cm', '5 cm'], tolerance = '@' }", "0.1 mm"},
      {"tray.pieces", "", "{ file = 'outline.svg', at = ['1 cm', '5 cm'], unit = 'mm', scale = 2 }"},
      {"tray.box", "", "false", "", {"tray.pieces=[{ line = [['3 cm', '0 cm'], ['9 cm', '0 cm']] }]"}},
      {"tray.sides", "", "'periodic'"},
      {"tray.holes.count", "", "3"},
      {"tray.holes.span", "length", quoted, "20 cm"},
      {"tray.holes.pitch", "length", quoted, "6 cm"},
      {"tray.holes.centre", "length", quoted, "18 cm"},
      {"tray.holes.at", "length", "['@', '25 cm']", "10 cm", {"tray.holes.count="}},
      {"tray.holes.width", "length", quoted, "20 mm"},
      {"tray.holes.open_at", "time", quoted, "1 s"},
      {"tray.holes.shape", "", "'round'"},
      {"tray.holes.across", "length", quoted, "30 mm"},
      {"tray.holes.rows", "", "2", "", {"tray.holes.shape='round'"}},
      {"tray.holes.thickness", "length", quoted, "2 mm", {"tray.holes.shape='round'"}},
      {"tray.holes.chamfer", "length", quoted, "0.5 mm", {"tray.holes.shape='round'"}},
      {"tray.rain.rate", "seeds per time", quoted, "60 1/s", rains},
      {"tray.rain.from", "length", quoted, "5 cm", rains},
      {"tray.rain.to", "length", quoted, "35 cm", rains},
      {"tray.rain.height", "length", quoted, "8 cm", rains},
      {"tray.rain.start", "time", quoted, "0.5 s", rains},
      {"tray.rain.stop", "time", quoted, "1.5 s", rains},
      {"tray.motion.kind", "", "'harmonic'", "", shaken},
      {"tray.motion.direction", "angle", quoted, "80 degree", shaken},
      {"tray.motion.amplitude", "length", quoted, "4 mm", shaken},
      {"tray.motion.frequency", "frequency", quoted, "10 Hz", shaken},
      {"tray.motion.phase", "angle", quoted, "90 degree", shaken},
      {"tray.motion.ramp", "time", quoted, "0.1 s", shaken},
      {"tray.motion.stop", "time", quoted, "1 s", shaken},
      {"tray.motion.stop_ramp", "time", quoted, "0.2 s", with(shaken, {"tray.motion.stop='1 s'"})},
      {"tray.motion.components",
       "length",
       "[{ amplitude = '@', frequency = '9 Hz' }]",
       "2 mm",
       {"tray.motion.kind='sum'"}},
      {"tray.motion.components",
       "frequency",
       "[{ amplitude = '2 mm', frequency = '@' }]",
       "9 Hz",
       {"tray.motion.kind='sum'"}},
      {"tray.motion.pivot", "length", "['@', '0 cm']", "3 cm", rocks},
      {"tray.motion.angle", "angle", quoted, "3 degree", rocks},
      {"tray.motion.speed", "frequency", quoted, "7 rpm", drums},
      {"tray.motion.axis", "", "'across'", "", drums, false},
      {"tray.motion.file", "", "'shake.csv'", "", {"tray.motion.kind='table'"}},
      {"hopper.length", "length", quoted, "12 cm", fed},
      {"hopper.height", "length", quoted, "6 cm", fed},
      {"hopper.left", "length", quoted, "6 cm", fed},
      {"hopper.above", "length", quoted, "12 cm", fed},
      {"hopper.depth", "length", quoted, "5 cm", fed},
      {"hopper.front_and_back", "", "'open'", "", fed},
      {"hopper.front", "length", quoted, "5 mm", fed},
      {"numerics.integrator", "", "'gear5'"},
      {"numerics.steps_per_contact", "", "40"},
      {"numerics.dt", "time", quoted, "10 us"},
      {"numerics.impact_speed", "speed", quoted, "0.5 m/s", hertz},
      {"numerics.allow_long_step", "", "true"},
      {"guard.warn_relative_overlap", "", "0.06"},
      {"guard.stop_relative_overlap", "", "0.6"},
      {"guard.energy_tolerance", "", "0.3"},
      {"run.duration", "time", quoted, "3 s"},
      {"run.measure_from", "time", quoted, "1 s"},
      {"run.count_below", "length", quoted, "25 mm"},
      {"run.end_after_pause", "time", quoted, "1 s"},
      {"run.start", "", "'with-tray'"},
      {"record.times", "time", quoted, "1.5 s"},
      {"record.every", "time", quoted, "0.5 s"},
      {"record.cell", "length", quoted, "9 mm", recorded},
      {"record.view", "", "'slice'", "", recorded},
      {"drill.row_spacing", "length", quoted, "15 cm", drilled, false},
      {"drill.speed", "travel speed", quoted, "8 km/h", drilled, false},
      {"drill.rows_per_hole", "", "2", "", drilled, false},
      {"drill.hole_to_row", "", "[1, 1]", "", drilled, false},
      {"drill.reference_spacing", "length", quoted, "3 cm", drilled, false},
      {"drill.multiples_below", "", "0.4", "", drilled, false},
      {"drill.skips_above", "", "1.6", "", drilled, false},
      {"drill.cv_limit", "fraction", quoted, "6 %", drilled, false},
  };
  return all;
}

/// Keys of a seeder by their full names, as a file may have them one a line.
using Lines = std::map<std::string, std::string>;

const Lines base = {
    {"seeds.wheat.diameter", "'4 mm'"}, {"seeds.wheat.mass", "'40 mg'"}, {"contact.shell_compression", "1e-4"},
    {"contact.friction", "0.3"},        {"tray.length", "'40 cm'"},      {"tray.height", "'10 cm'"},
    {"tray.depth", "'6 cm'"},           {"tray.fill.count", "40"},       {"tray.holes.count", "2"},
    {"tray.holes.width", "'16 mm'"},    {"run.duration", "'2 s'"}};

std::string text_of(const Lines& lines) {
  std::string text;
  for (const auto& [key, value] : lines) text += key + " = " + value + "\n";
  return text;
}

void lay_over(Lines& lines, const std::string& key_is_value) {
  const auto equals = key_is_value.find('=');
  const std::string key = key_is_value.substr(0, equals), value = key_is_value.substr(equals + 1);
  if (!value.empty()) {
    lines[key] = value;
    return;
  }
  std::erase_if(lines, [&](const auto& line) { return line.first == key || line.first.starts_with(key + "."); });
}

std::string value_of(const Key& key, const std::string& quantity) {
  std::string value = key.value;
  if (const auto at = value.find('@'); at != std::string::npos) value.replace(at, 1, quantity);
  return value;
}

/// A folder with what keys name.
class EveryKey : public testing::Test {
 protected:
  EveryKey() {
    folder_.write("outline.svg",
                  "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='20mm' viewBox='0 0 20 20'>"
                  "<path d='M 1 1 L 9 1 C 12 1 12 5 9 5'/></svg>");
    folder_.write("shake.csv", "time_s,x_mm\n0,0\n0.1,1\n0.2,0\n0.3,1\n");
  }

  std::filesystem::path file(const Lines& lines) { return folder_.write("seeder.toml", text_of(lines)); }

  /// As --set lays it over the base.
  std::vector<Override> overrides(const Key& key, const std::string& quantity) {
    std::vector<Override> changes;
    for (const std::string& one : key.context) changes.push_back(parse_override(one));
    changes.push_back(parse_override(key.key + "=" + value_of(key, quantity)));
    return changes;
  }

  Lines lines(const Key& key, const Lines& of = base) {
    Lines all = of;
    for (const std::string& one : key.context) lay_over(all, one);
    all[key.key] = value_of(key, key.quantity);
    return all;
  }

  TemporaryFolder folder_;
};

TEST_F(EveryKey, IsOneOfTheTable) {
  std::ifstream stream(data_directory() / "seeders" / "FORMAT.md");
  ASSERT_TRUE(stream);
  std::set<std::string> known = {"space", "fill"};
  for (const Key& key : keys()) {
    known.insert(key.key.substr(key.key.rfind('.') + 1));
    static const std::regex inner("([a-z_]+) = ");
    for (std::sregex_iterator it(key.value.begin(), key.value.end(), inner), end; it != end; ++it)
      known.insert((*it)[1]);
  }
  bool seeder = false;
  int found = 0;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("## ")) seeder = line == "## Seeder";
    if (!seeder || !line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find(" | "));
    static const std::regex word("`([a-z_]+)`");
    for (std::sregex_iterator it(cell.begin(), cell.end(), word), end; it != end; ++it, ++found)
      EXPECT_TRUE(known.contains((*it)[1])) << (*it)[1] << " has no entry in this test's table";
  }
  EXPECT_GT(found, 100);
}

TEST_F(EveryKey, TakesTheUnitsOfItsTradeAndNoOthers) {
  const auto seeder = file(base);
  const auto files = std::make_shared<SourceFiles>();
  const auto told = [&](const Key& key, const std::string& quantity) -> std::string {
    try {
      std::vector<Override> changes = overrides(key, quantity);
      changes.push_back(parse_override("space='3d'"));  // where every key is read
      read_seeder(seeder, changes, files);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Units all = traps;
  for (const auto& [kind, units] : units_of_kind) all.insert(all.end(), units.begin(), units.end());
  for (const Key& key : keys()) {
    if (key.kind.empty()) continue;
    EXPECT_EQ(told(key, key.quantity), "") << key.key;
    const std::string number = key.quantity.substr(0, key.quantity.find(' '));
    const Units& own = units_of_kind.at(key.kind);
    for (const std::string& unit : all) {
      const std::string message = told(key, number + " " + unit);
      if (std::ranges::count(own, unit) > 0) {
        EXPECT_THAT(message, testing::Not(HasSubstr("wrong unit"))) << key.key << " in " << unit;
        continue;
      }
      EXPECT_THAT(message, AllOf(HasSubstr(key.key), HasSubstr("wrong unit \""), HasSubstr("such as \"")))
          << key.key << " in " << unit;
    }
  }
}

TEST_F(EveryKey, HasAnExampleThatItReads) {
  const auto seeder = file(base);
  const auto files = std::make_shared<SourceFiles>();
  for (const Key& key : keys()) {
    if (key.kind.empty() || key.key == "tray.pieces") continue;  // a drawing's tolerance is not its place
    try {
      read_in_both_spaces(seeder, overrides(key, "1 furlong"), files);
      ADD_FAILURE() << key.key;
    } catch (const InputError& error) {
      const std::string message = error.what();
      const auto from = message.find("such as \"") + 9;
      const std::string example = message.substr(from, message.find('"', from) - from);
      const std::string unit = example.substr(example.find(' ') + 1);
      EXPECT_TRUE(std::ranges::count(units_of_kind.at(key.kind), unit) > 0) << message;
    }
  }
}

/// Seeds are counted in the space that a file says; all else must be the same.
Scene as_many(Scene scene, const Scene& as) {
  const auto same = [](Vessel& one, const Vessel& other) {
    if (one.fill) one.fill->count = other.fill->count;
    if (one.rain) one.rain->rate = other.rain->rate;
  };
  same(scene.tray, as.tray);
  if (scene.hopper) same(*scene.hopper, *as.hopper);
  return scene;
}

TEST_F(EveryKey, IsTheSameInTheFileAndBySet) {
  for (const char* space : {"'2d'", "'3d'"}) {
    Lines of = base;
    of["space"] = space;
    for (const Key& key : keys()) {
      const BothSpaces set = read_in_both_spaces(file(of), overrides(key, key.quantity));
      const BothSpaces written = read_in_both_spaces(file(lines(key, of)));
      EXPECT_TRUE(set.plane == written.plane) << key.key << " from " << space;
      EXPECT_TRUE(set.space == written.space) << key.key << " from " << space;
    }
  }
}

TEST_F(EveryKey, OfOneSpaceIsThereForTheOther) {
  for (const Key& key : keys()) {
    Lines flat = lines(key), deep = flat;
    flat["space"] = "'2d'", deep["space"] = "'3d'";
    const Scene plane = read_scene(file(flat)), space = read_scene(file(deep));
    const BothSpaces of_plane = read_in_both_spaces(file(flat)), of_space = read_in_both_spaces(file(deep));
    EXPECT_TRUE(of_plane.plane == plane || key.key == "tray.plan") << key.key;
    EXPECT_TRUE(of_space.space == space) << key.key;
    EXPECT_TRUE(as_many(of_plane.space, space) == space) << key.key << " is lost on the way to space";
    EXPECT_TRUE(as_many(of_space.plane, of_plane.plane) == of_plane.plane)
        << key.key << " is lost on the way to the plane";
    Lines without = base;
    for (const std::string& one : key.context) lay_over(without, one);
    if (!key.changes_scene || !without.contains("seeds.wheat.mass") || without == lines(key)) continue;
    bool same = false;
    try {
      const BothSpaces bare = read_in_both_spaces(file(without));
      same = bare.plane == of_plane.plane && bare.space == of_plane.space;
    } catch (const InputError&) {  // the context does not stand without it
    }
    EXPECT_FALSE(same) << key.key << " changes nothing";
  }
}

TEST_F(EveryKey, SeedsAreAsManyAsTheSlicesMakeOfThem) {
  Lines flat = base;
  flat["tray.rain.rate"] = "'10 1/s'";
  const BothSpaces both = read_in_both_spaces(file(flat));  // 15 slices of 4 mm
  EXPECT_EQ(both.plane.tray.fill->count, 40);
  EXPECT_EQ(both.space.tray.fill->count, 600);
  EXPECT_NEAR(both.space.tray.rain->rate, 150, 1e-9);
  flat["space"] = "'3d'", flat["tray.fill.count"] = "600";
  const BothSpaces back = read_in_both_spaces(file(flat));
  EXPECT_EQ(back.plane.tray.fill->count, 40);
  EXPECT_EQ(back.space.tray.fill->count, 600);
  EXPECT_NEAR(back.plane.tray.rain->rate, 10.0 / 15, 1e-9);
}

/// It says which row each hole of the file's own space feeds, and changes no run.
TEST_F(EveryKey, ADrillIsOfTheFilesOwnHoles) {
  const std::vector<Override> rows = {parse_override("space=\"3d\""), parse_override("tray.holes.rows=2"),
                                      parse_override("tray.holes.across=\"15 mm\""),
                                      parse_override("drill.row_spacing=\"15 cm\""),
                                      parse_override("drill.speed=\"8 km/h\"")};
  const auto with_rows = [&](const std::string& list) {
    std::vector<Override> all = rows;
    all.push_back(parse_override("drill.hole_to_row=" + list));
    return all;
  };
  const std::size_t holes = read_in_both_spaces(file(base), rows).space.tray.holes.size();
  std::string list = "[1";
  for (std::size_t k = 2; k <= holes; ++k) list += fmt::format(",{}", k);
  const BothSpaces both = read_in_both_spaces(file(base), with_rows(list + "]"));
  EXPECT_EQ(both.plane.tray.holes.size(), holes / 2);
  EXPECT_EQ(both.space.tray.holes.size(), holes);
  EXPECT_THROW(read_in_both_spaces(file(base), with_rows("[1]")), InputError);
}

TEST_F(EveryKey, AHeightIsTheSameInBothSpacesAndForEachCrop) {
  Lines high = base;
  lay_over(high, "tray.fill.count=");
  high["tray.fill.height"] = "'3 cm'";
  constexpr double area = 0.4 * 0.03, pi = 3.14159265358979;
  const BothSpaces both = read_in_both_spaces(file(high));
  EXPECT_NEAR(both.plane.tray.fill->count, 0.82 * area / (pi / 4 * 4e-3 * 4e-3), 0.5);
  EXPECT_NEAR(both.space.tray.fill->count, 0.545 * area * 0.06 / (pi / 6 * 4e-3 * 4e-3 * 4e-3), 0.5);
  const Scene halved = read_scene(file(high), {parse_override("seeds.wheat.diameter=2 mm")});
  EXPECT_NEAR(halved.tray.fill->count, 4 * both.plane.tray.fill->count, 2);
  for (const std::string& one : fed) lay_over(high, one);
  lay_over(high, "hopper.fill.count="), high["hopper.fill.height"] = "'4 cm'", high["hopper.fill.keep"] = "true";
  const Scene with_hopper = read_scene(file(high));
  EXPECT_NEAR(with_hopper.hopper->fill->count, 0.82 * 0.1 * 0.04 / (pi / 4 * 4e-3 * 4e-3), 0.5);
  EXPECT_TRUE(with_hopper.hopper->fill->keep);
}

TEST_F(EveryKey, ARoundHoleBySetIsRound3d) {
  const BothSpaces both = read_in_both_spaces(file(base), {parse_override("tray.holes.shape=round")});
  EXPECT_EQ(both.space.tray.holes[0].shape, HoleShape::round);
  EXPECT_EQ(both.space.space, Space::three_dimensional);
  EXPECT_EQ(both.plane.space, Space::two_dimensional);
}

TEST_F(EveryKey, ARoundTraysMiddleSliceHoldsMoreThanTheMeanOne) {
  Lines round = base;
  round["space"] = "'3d'", round["tray.plan"] = "'round'", round["tray.holes.shape"] = "'round'";
  round["tray.length"] = "'6 cm'", round["tray.holes.count"] = "1", round["tray.fill.count"] = "1000";
  const BothSpaces both = read_in_both_spaces(file(round));
  EXPECT_EQ(both.plane.tray.fill->count, std::lround(1000 / 15.0 * 4 / 3.14159265358979));
  EXPECT_EQ(both.plane.tray.depth, 0.06);
  round.erase("tray.depth");
  EXPECT_EQ(read_in_both_spaces(file(round)).plane.tray.depth, 0.06);
}

}  // namespace
}  // namespace vibrosow::every_key_test
