// The keys of materials, contacts, numerics and records that laws beside the elastic shell, springs, rolling, cohesion
// and pairs of materials brought.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>

#include <string>
#include <utility>
#include <vector>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow::read_contact_test {
namespace {

/// A seeder with one lot, or two, around a [contact] and whatever follows it.
std::string seeder(const std::string& contact, const std::string& second_lot = "", const std::string& pea = "") {
  const std::string fraction = second_lot.empty() ? "" : "number_fraction = '50 %'\n";
  return "[seeds.pea]\ndiameter = '8 mm'\nmass = '0.3 g'\n" + fraction + pea + "\n" + second_lot +
         "[tray]\nlength = '50 cm'\nheight = '12 cm'\nfill = { count = 10 }\n[run]\nduration = '6 s'\n[contact]\n" +
         contact;
}

const std::string rape = "[seeds.rape]\ndiameter = '2 mm'\nmass = '5 mg'\nnumber_fraction = '50 %'\n";
const std::string shell = "shell_compression = 1e-4\n";
const std::string hertz = "law = 'hertz'\nyoungs_modulus = '5e4 MPa'\n";

Scene read(const std::string& text, const std::vector<std::string>& settings = {}) {
  const TemporaryFolder folder;
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  return read_scene(folder.write("seeder.toml", text), overrides);
}

Contact contact(const std::string& text) {
  return read(seeder(text)).contact;
}

TEST(ReadContact, DefaultsAreAbsentEffects) {
  const Scene scene = read(seeder(shell));
  EXPECT_EQ(scene.contact.law, Law::elastic_shell);
  EXPECT_EQ(scene.contact.seed, Surface());
  EXPECT_EQ(scene.contact.wall, Surface());
  EXPECT_TRUE(scene.contact.overrides.empty());
  EXPECT_EQ(scene.contact.friction_model, FrictionModel::sliding);
  EXPECT_FALSE(scene.contact.tangential_ratio);
  EXPECT_EQ(scene.contact.tangential_damping, 0.5);
  EXPECT_EQ(scene.contact.rolling, Rolling::none);
  EXPECT_EQ(scene.contact.rolling_damping, 0.3);
  EXPECT_FALSE(scene.lots[0].shell_compression);
  EXPECT_EQ(scene.numerics.integrator, Integrator::velocity_verlet);
  EXPECT_FALSE(scene.numerics.impact_speed);
  EXPECT_FALSE(scene.record);
}

TEST(ReadContact, Hertz) {
  const Contact c = contact("law = 'hertz'\nyoungs_modulus = '5e4 MPa'\npoisson_ratio = 0.2\nrestitution = 0.5\n");
  EXPECT_EQ(c.law, Law::hertz);
  EXPECT_EQ(c.youngs_modulus, 5e10);
  EXPECT_EQ(c.poisson_ratio, 0.2);
  EXPECT_EQ(c.seed.restitution, 0.5);
  EXPECT_FALSE(c.wall_youngs_modulus) << "walls are rigid";
}

TEST(ReadContact, HertzDefaults) {
  const Contact c = contact(hertz + "[contact.wall]\nyoungs_modulus = '210 GPa'\n");
  EXPECT_EQ(c.poisson_ratio, 0.3);
  EXPECT_EQ(c.wall_poisson_ratio, 0.3);
  EXPECT_EQ(c.damping_rate, 0);
}

TEST(ReadContact, WallsOfTheirOwnMaterial) {
  const Contact c = contact(hertz + "[contact.wall]\nyoungs_modulus = '210 GPa'\npoisson_ratio = 0.28\n");
  EXPECT_EQ(c.wall_youngs_modulus, 210e9);
  EXPECT_EQ(c.wall_poisson_ratio, 0.28);
}

TEST(ReadContact, DampingRateMakesPaperBsLaw) {
  const Contact c = contact(hertz + "damping_rate = '2.1e4 1/s'\nfriction = 0.4\n");
  EXPECT_EQ(c.law, Law::hertz_viscous);
  EXPECT_EQ(c.damping_rate, 2.1e4);
  EXPECT_EQ(c.seed.restitution, 1);
  EXPECT_EQ(contact(hertz + "damping_rate = '0 1/s'\n").law, Law::hertz_viscous);
}

TEST(ReadContact, LotsOfTheirOwnMaterial) {
  Scene scene = read(seeder(shell, rape, "shell_compression = 3e-5"));
  EXPECT_EQ(scene.contact.shell_compression, 1e-4);
  EXPECT_EQ(scene.lots[0].shell_compression, 3e-5);
  EXPECT_FALSE(scene.lots[1].shell_compression);

  scene = read(seeder(hertz, rape, "youngs_modulus = '80 MPa'\npoisson_ratio = 0.4"));
  EXPECT_EQ(scene.lots[0].youngs_modulus, 8e7);
  EXPECT_EQ(scene.lots[0].poisson_ratio, 0.4);
  EXPECT_FALSE(scene.lots[1].youngs_modulus);
}

TEST(ReadContact, TheContactsStiffnessIsNotNeededWhereEveryLotHasOne) {
  EXPECT_EQ(read(seeder("friction = 0.1", "", "shell_compression = 3e-5")).lots[0].shell_compression, 3e-5);
  EXPECT_EQ(read(seeder("law = 'hertz'", "", "youngs_modulus = '80 MPa'")).lots[0].youngs_modulus, 8e7);
}

TEST(ReadContact, WallsOverrideEachValueOfTheSurface) {
  const std::string general =
      shell + "friction = 0.4\nrestitution = 0.5\nrolling = 'spring'\nrolling_friction = 0.1\ncohesion = '0.2 mN'\n";
  const Surface seed{0.4, 0.5, 0.1, 0.2e-3};
  EXPECT_EQ(contact(general).seed, seed);
  EXPECT_EQ(contact(general).wall, seed);
  const auto wall = [&general](const std::string& key) { return contact(general + "[contact.wall]\n" + key).wall; };
  EXPECT_EQ(wall("friction = 0.3"), (Surface{0.3, 0.5, 0.1, 0.2e-3}));
  EXPECT_EQ(wall("restitution = 0.9"), (Surface{0.4, 0.9, 0.1, 0.2e-3}));
  EXPECT_EQ(wall("rolling_friction = 0.02"), (Surface{0.4, 0.5, 0.02, 0.2e-3}));
  EXPECT_EQ(wall("cohesion = '1 mN'"), (Surface{0.4, 0.5, 0.1, 1e-3}));
}

TEST(ReadContact, PairsOfMaterials) {
  const std::string general = shell + "friction = 0.4\nrestitution = 0.5\n[contact.wall]\nfriction = 0.3\n";
  const Contact c = read(seeder(general + "[contact.rape.wall]\nrestitution = 0.7\n"
                                          "[contact.rape.pea]\nfriction = 0.1\n"
                                          "[contact.pea.pea]\ncohesion = '1 mN'\n",
                                rape))
                        .contact;
  ASSERT_EQ(c.overrides.size(), 3U);
  EXPECT_EQ(c.overrides[0].lot, 0);
  EXPECT_EQ(c.overrides[0].other, 0);
  EXPECT_EQ(c.overrides[0].surface, (Surface{0.4, 0.5, 0, 1e-3}));
  EXPECT_EQ(c.overrides[1].lot, 0) << "in the order of the lots, however it is written";
  EXPECT_EQ(c.overrides[1].other, 1);
  EXPECT_EQ(c.overrides[1].surface, (Surface{0.1, 0.5}));
  EXPECT_EQ(c.overrides[2].lot, 1);
  EXPECT_EQ(c.overrides[2].other, -1);
  EXPECT_EQ(c.overrides[2].surface, (Surface{0.3, 0.7})) << "what is not given is as on walls in general";
}

TEST(ReadContact, APairLikeTheGeneralSurfaceIsNoOverride) {
  EXPECT_TRUE(contact(shell + "friction = 0.4\n[contact.pea.wall]\nfriction = 0.4\n").overrides.empty());
}

TEST(ReadContact, PairsCanBeSetFromTheCommandLine) {
  const Scene scene = read(seeder(shell), {"contact.pea.wall.friction=0.2"});
  ASSERT_EQ(scene.contact.overrides.size(), 1U);
  EXPECT_EQ(scene.contact.overrides[0].surface.friction, 0.2);
}

TEST(ReadContact, FrictionSpring) {
  const Contact c =
      contact(shell + "friction_model = 'spring'\ntangential_ratio = 0.5\ntangential_damping = 0.1\nfriction = 0.3\n");
  EXPECT_EQ(c.friction_model, FrictionModel::spring);
  EXPECT_EQ(c.tangential_ratio, 0.5);
  EXPECT_EQ(c.tangential_damping, 0.1);
  EXPECT_FALSE(contact(shell + "friction_model = 'spring'\n").tangential_ratio);
  EXPECT_EQ(contact(shell + "friction_model = 'sliding'\n").friction_model, FrictionModel::sliding);
}

TEST(ReadContact, RollingModels) {
  const std::string some = shell + "rolling_friction = 0.05\n";
  EXPECT_EQ(contact(some + "rolling = 'constant-torque'").rolling, Rolling::constant_torque);
  const Contact spring = contact(some + "rolling = 'spring'\nrolling_damping = 0.7");
  EXPECT_EQ(spring.rolling, Rolling::spring);
  EXPECT_EQ(spring.rolling_damping, 0.7);
  EXPECT_EQ(spring.seed.rolling_friction, 0.05);
  EXPECT_EQ(contact(shell + "rolling = 'none'").rolling, Rolling::none);
  EXPECT_EQ(contact(shell + "rolling = 'spring'\n[contact.wall]\nrolling_friction = 0.1").wall.rolling_friction, 0.1);
  EXPECT_EQ(contact(shell + "rolling = 'spring'\n[contact.pea.pea]\nrolling_friction = 0.1").overrides.size(), 1U);
}

TEST(ReadContact, RollingFrictionOfZeroAsksForNothing) {
  EXPECT_EQ(contact(shell + "rolling_friction = 0").rolling, Rolling::none);
  EXPECT_EQ(contact(shell + "rolling = 'spring'\nrolling_friction = 0").seed.rolling_friction, 0);
}

/// A seeder whose [contact] names a model.
Scene read_with_model(const std::string& model, const std::string& contact_keys) {
  const TemporaryFolder folder;
  folder.write("model.toml", model);
  return read_scene(folder.write("seeder.toml", seeder("model = 'model.toml'\n" + contact_keys)));
}

const std::string shell_model =
    "law = 'elastic-shell'\nshell_compression = 1e-3\nrestitution = 0.5\nslip_speed = '9 m/s'\n"
    "[wall]\nrestitution = 0.7\n";

TEST(ReadContact, TheSeedersLawLeavesOutTheModelsStiffness) {
  const Contact c = read_with_model(shell_model, hertz).contact;
  EXPECT_EQ(c.law, Law::hertz);
  EXPECT_EQ(c.shell_compression, Contact().shell_compression);
  EXPECT_EQ(c.wall.restitution, 0.7);

  const std::string model =
      "law = 'hertz'\nyoungs_modulus = '1 GPa'\ndamping_rate = '9 1/s'\npoisson_ratio = 0.2\n"
      "[wall]\nyoungs_modulus = '2 GPa'\npoisson_ratio = 0.1\n";
  EXPECT_EQ(read_with_model(model, "").contact.law, Law::hertz_viscous);
  const Contact shell_again = read_with_model(model, "law = 'elastic-shell'\nshell_compression = 1e-5").contact;
  EXPECT_EQ(shell_again.law, Law::elastic_shell);
  EXPECT_EQ(shell_again.youngs_modulus, 0);
  EXPECT_EQ(shell_again.damping_rate, 0);
  EXPECT_FALSE(shell_again.wall_youngs_modulus);
}

TEST(ReadContact, TheSeedersDampingRateLeavesOutTheModelsRestitutions) {
  const Contact c = read_with_model(shell_model, hertz + "damping_rate = '2e4 1/s'").contact;
  EXPECT_EQ(c.law, Law::hertz_viscous);
  EXPECT_EQ(c.seed.restitution, 1);
  EXPECT_EQ(c.wall.restitution, 1);
}

TEST(ReadContact, TheSeedersFrictionModelLeavesOutTheModelsSlipSpeed) {
  const Contact c = read_with_model(shell_model, "friction_model = 'spring'").contact;
  EXPECT_EQ(c.friction_model, FrictionModel::spring);
  EXPECT_EQ(c.slip_speed, Contact().slip_speed);
  EXPECT_EQ(read_with_model(shell_model, "").contact.slip_speed, 9);
}

TEST(ReadContact, ConstantTorqueHasASlipSpeedBesideSprings) {
  const std::string springs = shell + "friction_model = 'spring'\nslip_speed = '5 mm/s'\n";
  EXPECT_EQ(contact(springs + "rolling = 'constant-torque'\nrolling_friction = 0.1\n").slip_speed, 0.005);
  EXPECT_THROW(contact(springs + "rolling = 'spring'\nrolling_friction = 0.1\n"), InputError);
}

TEST(ReadContact, TheSeedersRollingLeavesOutTheModels) {
  const std::string model = shell + "rolling = 'spring'\nrolling_friction = 0.1\nrolling_damping = 0.9\n";
  EXPECT_EQ(read_with_model(model, "").contact.rolling_damping, 0.9);
  const Contact none = read_with_model(model, "rolling = 'none'").contact;
  EXPECT_EQ(none.rolling, Rolling::none);
  EXPECT_EQ(none.seed.rolling_friction, 0);
  EXPECT_EQ(none.rolling_damping, 0.3);
}

TEST(ReadContact, ACropMayDescribeItsMaterialForEveryLaw) {
  const TemporaryFolder folder;
  folder.write("crop.toml",
               "diameter = '8 mm'\nmass = '0.3 g'\nshell_compression = 1e-5\nyoungs_modulus = '80 MPa'\n"
               "poisson_ratio = 0.4\n");
  const auto lot = [&folder](const std::string& contact_keys) {
    return read_scene(folder.write("seeder.toml", "[seeds.pea]\ncrop = 'crop.toml'\n[contact]\n" + contact_keys +
                                                      "[tray]\nlength = '50 cm'\nheight = '12 cm'\n"
                                                      "fill = { count = 10 }\n[run]\nduration = '6 s'\n"))
        .lots[0];
  };
  EXPECT_EQ(lot("friction = 0.1\n").shell_compression, 1e-5);
  EXPECT_FALSE(lot("friction = 0.1\n").youngs_modulus);
  EXPECT_EQ(lot("law = 'hertz'\n").youngs_modulus, 8e7);
  EXPECT_EQ(lot("law = 'hertz'\n").poisson_ratio, 0.4);
  EXPECT_FALSE(lot("law = 'hertz'\n").shell_compression);
}

TEST(ReadNumerics, GearAndTheImpactSpeed) {
  const Scene scene = read(seeder(hertz), {"numerics.integrator=gear5", "numerics.impact_speed=1 m/s"});
  EXPECT_EQ(scene.numerics.integrator, Integrator::gear5);
  EXPECT_EQ(scene.numerics.impact_speed, 1);
  EXPECT_EQ(read(seeder(hertz), {"numerics.integrator=velocity-verlet"}).numerics.integrator,
            Integrator::velocity_verlet);
}

TEST(ReadRecord, TimesAndCell) {
  const Scene scene = read(seeder(shell), {"record.times=['0 s', '2 s', '6 s']", "record.cell=5 mm"});
  ASSERT_TRUE(scene.record);
  EXPECT_EQ(scene.record->times, (std::vector<double>{0, 2, 6}));
  EXPECT_EQ(scene.record->cell, 0.005);
}

TEST(ReadRecord, CellIsTwoDiametersOfTheLargestLot) {
  EXPECT_EQ(read(seeder(shell, rape), {"record.times=2 s"}).record->cell, 0.016);
  EXPECT_EQ(read(seeder(shell, rape), {"record.times=2 s", "record.cell=3 diameters"}).record->cell, 0.024);
}

TEST(ReadRecord, EveryReachesTheEndAndNotBeyond) {
  const auto times = [](const std::string& every, const std::string& duration) {
    return read(seeder(shell), {"record.every=" + every, "run.duration=" + duration}).record->times;
  };
  EXPECT_EQ(times("2 s", "6 s"), (std::vector<double>{0, 2, 4, 6}));
  EXPECT_EQ(times("2.5 s", "6 s"), (std::vector<double>{0, 2.5, 5}));
  EXPECT_EQ(times("6 s", "6 s"), (std::vector<double>{0, 6}));
  EXPECT_EQ(times("0.1 s", "0.3 s"), (std::vector<double>{0, 0.1, 0.2, 0.3})) << "3 * 0.1 > 0.3";
  EXPECT_EQ(times("0.7 s", "4.9 s").size(), 8U) << "4.9 / 0.7 < 7";
}

TEST(ReadContact, KeysNotUsedDoNotTellScenesApart) {
  EXPECT_TRUE(read(seeder(shell)) ==
              read(seeder(shell + "law = 'elastic-shell'\nfriction_model = 'sliding'\nrolling = 'none'\n"
                                  "cohesion = '0 N'\nrolling_friction = 0\n")));
}

/// Two lots, each with a crop and a contact model of its own, and whatever follows.
class ContactsOfCrops : public testing::Test {
 protected:
  Scene read(const std::string& rest) const {
    folder.write("pea.toml", "diameter = '7 mm'\nmass = '0.2 g'\ncontact = 'pea-contact.toml'\n");
    folder.write("rape.toml", "diameter = '2 mm'\nmass = '5 mg'\ncontact = 'rape-contact.toml'\n");
    folder.write("pea-contact.toml",
                 "shell_compression = 1e-4\nfriction = 0.4\nrestitution = 0.5\nwall = { friction = 0.3 }\n");
    folder.write("rape-contact.toml",
                 "shell_compression = 2e-5\nfriction = 0.5\nrestitution = 0.6\nwall = { friction = 0.2 }\n");
    return read_scene(folder.write("seeder.toml",
                                   "[seeds.pea]\ncrop = 'pea.toml'\nnumber_fraction = '50 %'\n"
                                   "[seeds.rape]\ncrop = 'rape.toml'\nnumber_fraction = '50 %'\n"
                                   "[tray]\nlength = '50 cm'\nheight = '12 cm'\nfill = { count = 10 }\n"
                                   "[run]\nduration = '6 s'\n" +
                                       rest));
  }
  static double friction(const Scene& scene, int lot, int other) {
    for (const SurfaceOverride& pair : scene.contact.overrides)
      if (pair.lot == lot && pair.other == other) return pair.surface.friction;
    return other < 0 ? scene.contact.wall.friction : scene.contact.seed.friction;
  }
  const TemporaryFolder folder{};
};

TEST_F(ContactsOfCrops, AreTakenWithoutContact) {
  for (const char* rest : {"", "[contact]\n", "[contact]\nmodel = 'crop'\n"}) {
    const Scene scene = read(rest);
    EXPECT_EQ(friction(scene, 0, 0), 0.4) << rest;
    EXPECT_EQ(friction(scene, 0, -1), 0.3);
    EXPECT_EQ(friction(scene, 1, 1), 0.5);
    EXPECT_EQ(friction(scene, 1, -1), 0.2);
    EXPECT_DOUBLE_EQ(friction(scene, 0, 1), 0.45) << "the mean of both";
    EXPECT_EQ(scene.contact.shell_compression, 1e-4);
    EXPECT_EQ(scene.lots[1].shell_compression, 2e-5);
    EXPECT_FALSE(scene.contact.model.is_known());
    EXPECT_EQ(scene.lots[1].contact.name, "rape-contact");
    EXPECT_EQ(scene.lots[1].crop.name, "rape");
  }
}

TEST_F(ContactsOfCrops, WhatTheSeederSaysWins) {
  const Scene all = read("[contact]\nmodel = 'crop'\nfriction = 0.1\nshell_compression = 3e-4\n");
  for (const auto& [lot, other] : {std::pair(0, 0), {0, 1}, {1, 1}}) EXPECT_EQ(friction(all, lot, other), 0.1);
  EXPECT_EQ(friction(all, 1, -1), 0.2);
  EXPECT_FALSE(all.lots[1].shell_compression);
  const Scene pair = read("[contact]\nmodel = 'crop'\npea.rape.friction = 0.7\nrape.rape.friction = 0.4\n");
  EXPECT_EQ(friction(pair, 0, 1), 0.7);
  EXPECT_EQ(friction(pair, 1, 1), 0.4);
  EXPECT_EQ(friction(pair, 0, 0), 0.4);
}

/// Of two lots, too: what is not written there is the mean of both.
TEST_F(ContactsOfCrops, WhatTheSeederSaysOfTwoLotsLiesOverTheirMean) {
  const Scene scene = read("[contact]\npea.rape.friction = 0.7\n");
  const auto pair = std::ranges::find_if(scene.contact.overrides,
                                         [](const SurfaceOverride& one) { return one.lot == 0 && one.other == 1; });
  ASSERT_NE(pair, scene.contact.overrides.end());
  EXPECT_EQ(pair->surface.friction, 0.7);
  EXPECT_DOUBLE_EQ(pair->surface.restitution, 0.55);
}

/// One key, as --set and studies give it, does not take the crops' friction away.
TEST_F(ContactsOfCrops, LieBeneathAContactThatDoesNotStandAlone) {
  const Scene stiff = read("[contact]\nshell_compression = 3e-4\n");
  EXPECT_EQ(stiff.contact.shell_compression, 3e-4);
  EXPECT_EQ(friction(stiff, 0, 0), 0.4);
  EXPECT_EQ(friction(stiff, 1, -1), 0.2);
  const Scene rough = read("[contact]\nfriction = 0.1\n");
  EXPECT_EQ(friction(rough, 1, 1), 0.1);
  EXPECT_EQ(rough.lots[1].shell_compression, 2e-5);
  const Scene alone = read("[contact]\nfriction = 0.1\nshell_compression = 3e-4\n");
  EXPECT_EQ(friction(alone, 1, -1), 0.1);
  EXPECT_EQ(alone.contact.seed.restitution, 1);
}

TEST_F(ContactsOfCrops, ThatDifferInWhatAllSeedsShareAreRefused) {
  read("");
  const auto with = [&](const std::string& key, const std::string& rest) {
    folder.write("other.toml", "shell_compression = 2e-5\nfriction = 0.5\n" + key);
    return read_scene(folder.write("two.toml",
                                   "[seeds.pea]\ncrop = 'pea.toml'\nnumber_fraction = '50 %'\n[seeds.rape]\n"
                                   "crop = 'rape.toml'\ncontact = 'other.toml'\nnumber_fraction = '50 %'\n[tray]\n"
                                   "length = '50 cm'\nheight = '12 cm'\nfill = { count = 10 }\n[run]\n"
                                   "duration = '6 s'\n" +
                                       rest));
  };
  EXPECT_NO_THROW(with("", ""));
  for (const char* key : {"drag = '3 g/s'", "slip_speed = '200 mm/s'", "rotation = false"}) {
    const std::string name = std::string(key).substr(0, std::string(key).find(' '));
    EXPECT_THAT([&] { with(key, ""); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("contact." + name + ": is shared by all seeds")));
    EXPECT_NO_THROW(with(key, std::string("[contact]\n") + key + "\n"));
  }
}

TEST_F(ContactsOfCrops, OfSeveralLawsAreRefused) {
  folder.write("hertz.toml", "law = 'hertz'\nyoungs_modulus = '50 MPa'\nfriction = 0.3\n");
  read("");
  EXPECT_THAT(
      [&] {
        read_scene(folder.write("two.toml",
                                "[seeds.pea]\ncrop = 'pea.toml'\nnumber_fraction = '50 %'\n[seeds.rape]\n"
                                "crop = 'rape.toml'\ncontact = 'hertz.toml'\nnumber_fraction = '50 %'\n[tray]\n"
                                "length = '50 cm'\nheight = '12 cm'\nfill = { count = 10 }\n[run]\n"
                                "duration = '6 s'\n"));
      },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("are of several laws")));
}

TEST_F(ContactsOfCrops, ALotWithoutOneIsNamed) {
  EXPECT_THAT(
      [] { read_contact_test::read(seeder("model = 'crop'\n")); },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("contact.model: is \"crop\", and seeds.pea has no crop")));
}

TEST_F(ContactsOfCrops, AModelThatIsNotThereIsNamed) {
  EXPECT_THAT(
      [&] {
        folder.write("lost.toml", "diameter = '7 mm'\nmass = '0.2 g'\ncontact = 'nowhere.toml'\n");
        read_scene(folder.write("s.toml",
                                "[seeds.a]\ncrop = 'lost.toml'\n[tray]\nlength = '50 cm'\nheight = '12 cm'\n"
                                "fill = { count = 10 }\n[run]\nduration = '6 s'\n"));
      },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("nowhere.toml")));
}

}  // namespace
}  // namespace vibrosow::read_contact_test
