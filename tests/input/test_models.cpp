// Every shipped preset says where each of its values comes from, and every shipped seeder file is one that the reader
// takes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "input/presets.hpp"
#include "input/read_crop.hpp"
#include "input/read_scene.hpp"
#include "scene/clump_shape.hpp"
#include "units/quantity.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> toml_files(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Full names of all values of a preset that need a source: all but its title, its contact model and the sources
/// themselves.
std::vector<std::string> keys_to_source(const toml::table& preset, const std::string& prefix = "") {
  std::vector<std::string> keys;
  for (const auto& [key, value] : preset) {
    const std::string name = prefix + std::string(key.str());
    if (name == "title" || name == "sources" || name == "contact") continue;
    if (const toml::table* inner = value.as_table()) {
      for (const std::string& deeper : keys_to_source(*inner, name + ".")) keys.push_back(deeper);
    } else {
      keys.push_back(name);
    }
  }
  return keys;
}

/// What is wrong with a preset's sources: a key without one, one without a key, an empty one.
std::vector<std::string> source_faults(const toml::table& preset) {
  const toml::table* sources = preset["sources"].as_table();
  if (sources == nullptr) return {"no [sources]"};
  std::vector<std::string> faults;
  const std::vector<std::string> keys = keys_to_source(preset);
  for (const std::string& key : keys)
    if (!sources->contains(key)) faults.push_back(key + " has no source");
  for (const auto& [key, text] : *sources) {
    const std::string name(key.str());
    if (std::find(keys.begin(), keys.end(), name) == keys.end()) faults.push_back(name + " is not a key");
    const std::string source = text.value_or(std::string());
    if (source.find_first_not_of(' ') == std::string::npos) faults.push_back(name + " has an empty source");
    if (source == "assumed" || source == "assumed:") faults.push_back(name + " does not say why it is assumed");
  }
  return faults;
}

/// A crop's mass over its volume times true density: 1 when they agree. The volume of a ball, of a row of balls, or of
/// a clump with the outline of its discs, 2/3 of its area times its thickness as an ellipsoid has.
double mass_ratio(const toml::table& crop) {
  const auto quantity = [&](const toml::node_view<const toml::node>& node, Dimension dimension) {
    return parse_quantity(node.value_or(std::string()), dimension);
  };
  const double mass_per_volume = quantity(crop["thousand_grain_weight"], Dimension::mass) / 1e3 /
                                 quantity(crop["reference"]["true_density"], Dimension::density);
  const std::string shape = crop["shape"].value_or(std::string("ball"));
  if (shape == "ball") {
    const double diameter = quantity(crop["diameter"], Dimension::length);
    const auto deviation = crop["sizes"]["deviation"];  // of a normal distribution, of which E[d^3] = d^3 + 3 d sigma^2
    const double sigma = deviation ? quantity(deviation, Dimension::length) : 0;
    return mass_per_volume / (std::numbers::pi / 6 * diameter * (diameter * diameter + 3 * sigma * sigma));
  }
  if (shape == "discs") {
    std::vector<ClumpDisc> balls;
    for (const auto& node : *crop["discs"].as_array()) {
      const auto of = [&](const char* key) {
        return quantity(toml::node_view<const toml::node>((*node.as_table())[key]), Dimension::length);
      };
      balls.push_back({of("x"), of("y"), 0.5 * of("diameter")});
    }
    return mass_per_volume / volume_of_balls(balls);
  }
  const double length = quantity(crop["length"], Dimension::length);
  const double width = quantity(crop["width"], Dimension::length);
  const double area = plate_of(shape == "drop" ? drop(length, width) : elongated(length, width)).area;
  return mass_per_volume / (2.0 / 3 * area * quantity(crop["thickness"], Dimension::length));
}

TEST(Presets, EveryValueHasASource) {
  const std::vector<fs::path> files = toml_files(data_directory() / "models");
  ASSERT_GE(files.size(), 25u);
  for (const fs::path& file : files)
    for (const std::string& fault : source_faults(toml::parse_file(file.string())))
      ADD_FAILURE() << file << ": " << fault;
}

TEST(Presets, FaultsInSourcesAreFound) {
  const auto faults = [](std::string_view text) { return source_faults(toml::parse(text)); };
  using Faults = std::vector<std::string>;
  EXPECT_EQ(faults("title = 'a'\nmass = '1 g'\n[sources]\nmass = 'weighed'"), Faults{});
  EXPECT_EQ(faults("mass = '1 g'"), Faults{"no [sources]"});
  EXPECT_EQ(faults("mass = '1 g'\n[sources]"), Faults{"mass has no source"});
  EXPECT_EQ(faults("[sources]\nmass = 'weighed'"), Faults{"mass is not a key"});
  EXPECT_EQ(faults("mass = '1 g'\n[sources]\nmass = ' '"), Faults{"mass has an empty source"});
  EXPECT_EQ(faults("mass = '1 g'\n[sources]\nmass = 'assumed:'"), Faults{"mass does not say why it is assumed"});
  EXPECT_EQ(faults("[wall]\nfriction = 1\n[sources]"), Faults{"wall.friction has no source"});
  EXPECT_EQ(faults("[wall]\nfriction = 1\n[sources]\n'wall.friction' = 'tilting table'"), Faults{});
}

/// Smooth model seeds lie closer than true ones. So a model seed may be as much larger as makes its poured bed weigh
/// right, some air with it.
TEST(Presets, MassAgreesWithVolumeAndTrueDensityButForAFewPercentOfAir) {
  const std::vector<fs::path> crops = toml_files(data_directory() / "models" / "crops");
  ASSERT_GE(crops.size(), 15u);
  for (const fs::path& file : crops) {
    const double ratio = mass_ratio(toml::parse_file(file.string()));
    EXPECT_TRUE(ratio > 0.85 && ratio < 1.02) << file << ": " << ratio;
  }
}

TEST(Presets, CropsReadAsCropsAndPackAsBedsDo) {
  for (const fs::path& file : toml_files(data_directory() / "models" / "crops")) {
    const Crop crop = read_crop(file);
    EXPECT_FALSE(crop.title.empty()) << file;
    EXPECT_GE(crop.length, crop.width) << file;
    EXPECT_GE(crop.width, crop.thickness) << file;
    EXPECT_EQ(crop.sources.count("shape"), 1u) << file;
    ASSERT_TRUE(crop.reference.true_density) << file;
    if (!crop.bulk.bulk_density) continue;
    const double packing = *crop.bulk.bulk_density / *crop.reference.true_density;
    EXPECT_TRUE(packing > 0.35 && packing < 0.74) << file << ": " << packing;
  }
}

TEST(Presets, EveryContactModelSaysHowItPushesAndRubs) {
  for (const fs::path& file : toml_files(data_directory() / "models" / "contacts")) {
    const std::string model = "contact.model=" + file.stem().string();
    EXPECT_NO_THROW(read_scene(data_directory() / "seeders" / "wheat-tray.toml", {parse_override(model)})) << file;
  }
}

TEST(Presets, EveryCropNamesItsContactModel) {
  for (const fs::path& file : toml_files(data_directory() / "models" / "crops"))
    EXPECT_TRUE(fs::exists(read_crop(file).contact.file)) << file;
}

TEST(Presets, NamesOfBeforeStandForTheSameSeeds) {
  EXPECT_EQ(find_crop("wheat-grain").name, "wheat");
  EXPECT_EQ(find_crop("barley-grain").name, "barley");
  const auto files = std::make_shared<SourceFiles>();
  read_scene(data_directory() / "seeders" / "wheat-grains.toml", {parse_override("seeds.wheat.crop=wheat-grain")},
             files);
  ASSERT_EQ(files->notes().size(), 1u);
  EXPECT_NE(files->notes()[0].find("seeds.wheat.crop: \"wheat-grain\" is called \"wheat\" now"), std::string::npos)
      << files->notes()[0];
  EXPECT_TRUE(changed_meaning("wheat", "crops"));
  EXPECT_FALSE(changed_meaning("wheat-ball", "crops"));
}

TEST(Presets, WheatAtItsGeometricMeanDiameterWouldNotAgree) {
  EXPECT_NEAR(mass_ratio(toml::parse(
                  "diameter = '4.26 mm'\nthousand_grain_weight = '29.6 g'\nreference.true_density = '1240 kg/m3'")),
              731.0 / 1240, 0.01);
}

TEST(Presets, WheatAtItsMeasuredLengthWidthAndThicknessWouldNotAgree) {
  EXPECT_NEAR(mass_ratio(toml::parse(
                  "shape = 'elongated'\nlength = '7.08 mm'\nwidth = '3.27 mm'\nthousand_grain_weight = '29.6 g'\n"
                  "thickness = '2.98 mm'\nreference.true_density = '1240 kg/m3'")),
              29.6 / 41.7, 0.01);
}

TEST(Presets, ElongatedAndDropCropsReadAsClumps) {
  for (const auto& [crop, length] :
       {std::pair("wheat", 6.53e-3), {"barley", 9.13e-3}, {"oats", 10e-3}, {"rice", 10.1e-3}}) {
    const Scene scene = read_scene(data_directory() / "seeders" / "wheat-tray.toml",
                                   {parse_override(std::string("seeds.wheat.crop=") + crop),
                                    parse_override("hopper.fill.count=50"), parse_override("tray.fill.count=50")});
    EXPECT_EQ(scene.lots[0].shape, Shape::clump) << crop;
    EXPECT_NEAR(scene.lots[0].diameter, length, 1e-12) << crop;
  }
}

std::vector<fs::path> shipped_seeders() {
  std::vector<fs::path> seeders;
  for (const fs::path& file : toml_files(data_directory() / "seeders"))
    if (file.parent_path().filename() != "studies") seeders.push_back(file);
  return seeders;
}

TEST(Seeders, EveryShippedOneReads) {
  ASSERT_GE(shipped_seeders().size(), 17u);
  for (const fs::path& file : shipped_seeders()) {
    Scene scene;
    ASSERT_NO_THROW(scene = read_scene(file)) << file;
    EXPECT_FALSE(scene.title.empty()) << file;
    EXPECT_TRUE(scene.tray.fill || scene.tray.rain || (scene.hopper && scene.hopper->fill)) << file;
    EXPECT_TRUE(!scene.tray.holes.empty() || scene.record) << file << ": nothing to count and nothing to see";
  }
}

TEST(Seeders, WheatTrayTakesSeedAndContactFromThePresets) {
  const Scene scene = read_scene(data_directory() / "seeders" / "wheat-tray.toml");
  ASSERT_EQ(scene.lots.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.lots[0].diameter, 3.63e-3);
  EXPECT_DOUBLE_EQ(scene.lots[0].mass, 29.6e-6);
  EXPECT_EQ(scene.lots[0].shape, Shape::ball);
  EXPECT_DOUBLE_EQ(scene.contact.seed.friction, 0.45);
  EXPECT_DOUBLE_EQ(scene.contact.wall.friction, 0.36);
  EXPECT_DOUBLE_EQ(scene.contact.slip_speed, 0.02);
  ASSERT_TRUE(scene.hopper && scene.hopper->fill);
  EXPECT_TRUE(scene.hopper->fill->keep);
}

TEST(Seeders, PublishedTraysAreAsPublished) {
  for (const char* name : {"paper-a-fig3.toml", "paper-a-fig4.toml"}) {
    SCOPED_TRACE(name);
    const Scene scene = read_scene(data_directory() / "seeders" / "papers" / name);
    EXPECT_DOUBLE_EQ(scene.lots.at(0).diameter, 8e-3);
    EXPECT_DOUBLE_EQ(scene.lots.at(0).mass, 0.6e-3);
    EXPECT_EQ(scene.lots.at(0).shape, Shape::disc);
    EXPECT_DOUBLE_EQ(scene.contact.shell_compression, 0.01);
    EXPECT_DOUBLE_EQ(scene.contact.seed.restitution, 1);
    EXPECT_DOUBLE_EQ(scene.contact.wall.restitution, 1);
    EXPECT_EQ(scene.contact.drag, 0);
    EXPECT_EQ(scene.contact.friction_arm, FrictionArm::rim);
    EXPECT_EQ(scene.numerics.integrator, Integrator::rk2_midpoint);
    ASSERT_TRUE(scene.numerics.dt);
    EXPECT_DOUBLE_EQ(*scene.numerics.dt, 0.002);
    EXPECT_FALSE(scene.numerics.allow_long_step);
    EXPECT_DOUBLE_EQ(scene.tray.length, 0.5);
    ASSERT_TRUE(scene.tray.motion);
    EXPECT_DOUBLE_EQ(std::get<HarmonicMotion>(*scene.tray.motion).frequency, 9);
    EXPECT_DOUBLE_EQ(std::get<HarmonicMotion>(*scene.tray.motion).amplitude, 0.01);
    EXPECT_EQ(std::get<HarmonicMotion>(*scene.tray.motion).ramp, 0);
    ASSERT_TRUE(scene.tray.fill);
    EXPECT_EQ(scene.tray.fill->count, 2400);
    EXPECT_EQ(scene.tray.fill->packing, Packing::layers);
    for (const Hole& hole : scene.tray.holes) EXPECT_DOUBLE_EQ(hole.width, 0.024);
  }
}

}  // namespace
}  // namespace vibrosow
