#include "plan/softness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "laws/law.hpp"
#include "plan/model.hpp"
#include "scene/accuracy_level.hpp"

namespace vibrosow {
namespace {

/// A tray of balls of 4 mm that hardly moves, so that no overlap bounds a level's softness.
Scene tray(Law law) {
  Scene scene;
  scene.lots = {SeedLot{.name = "wheat", .diameter = 4e-3, .mass = 40e-6}};
  scene.contact.law = law;
  scene.contact.shell_compression = 1e-4;
  scene.contact.youngs_modulus = 5e8;
  scene.tray.name = "tray";
  scene.tray.length = 0.5;
  scene.tray.height = 0.1;
  scene.tray.fill = Fill{.count = 100};
  scene.run.duration = 1;
  return scene;
}

Scene at(Scene scene, AccuracyLevel level) {
  scene.numerics.accuracy = level;
  return resolve_accuracy_level(scene);
}

TEST(Softness, WithoutALevelTheSceneStaysAsWritten) {
  EXPECT_EQ(resolve_accuracy_level(tray(Law::elastic_shell)), tray(Law::elastic_shell));
}

TEST(Softness, ALevelSetsShellAndSteps) {
  for (const AccuracyLevelValues& level : accuracy_levels) {
    const Scene scene = at(tray(Law::elastic_shell), level.level);
    EXPECT_EQ(scene.numerics.accuracy, AccuracyLevel::as_written);
    EXPECT_LE(scene.contact.shell_compression, level.shell_compression * (1 + 1e-12));
    EXPECT_EQ(scene.numerics.steps_per_contact, level.steps_per_contact);
    EXPECT_TRUE(is_predicted_sound(scene));
  }
  EXPECT_DOUBLE_EQ(at(tray(Law::elastic_shell), AccuracyLevel::reference).contact.shell_compression, 3e-6);
}

TEST(Softness, ALevelTakesNoFewerStepsThanItsSchemeWants) {
  Scene scene = tray(Law::elastic_shell);
  scene.numerics.integrator = Integrator::rk2_midpoint;
  EXPECT_EQ(at(scene, AccuracyLevel::draft).numerics.steps_per_contact, 20);
  EXPECT_EQ(at(scene, AccuracyLevel::reference).numerics.steps_per_contact, 24);
}

TEST(NumericsError, OfALevelIsWhatWasMeasuredOfIt) {
  for (const AccuracyLevelValues& level : accuracy_levels) {
    Scene scene = tray(Law::elastic_shell);
    scene.numerics.accuracy = level.level;
    EXPECT_DOUBLE_EQ(numerics_error(scene).half_width, level.error_2d_percent / 100) << level.name;
    EXPECT_EQ(numerics_error(scene).times_beyond, 1);
    scene.space = Space::three_dimensional, scene.tray.depth = 0.06;
    EXPECT_DOUBLE_EQ(numerics_error(scene).half_width, level.error_3d_percent / 100) << level.name;
    scene.space = Space::two_dimensional;
    scene.lots[0].shape = Shape::clump;
    scene.lots[0].discs = {{-1e-3, 0, 1e-3}, {1e-3, 0, 1e-3}};
    EXPECT_DOUBLE_EQ(numerics_error(scene).half_width, level.grains_error_percent / 100) << level.name;
  }
}

TEST(NumericsError, WithoutALevelIsThatOfTheMostAccurateThatIsNoStiffer) {
  const auto error = [](double shell, double steps) {
    Scene scene = tray(Law::elastic_shell);
    scene.contact.shell_compression = shell;
    scene.numerics.steps_per_contact = steps;
    return numerics_error(scene);
  };
  EXPECT_DOUBLE_EQ(error(1e-4, 12).half_width, 0.114);
  EXPECT_DOUBLE_EQ(error(2e-5, 12).half_width, 0.058);
  EXPECT_DOUBLE_EQ(error(1e-6, 12).half_width, 0.058) << "the reference takes more steps";
  EXPECT_DOUBLE_EQ(error(1e-6, 30).half_width, 0.026);
  EXPECT_NEAR(error(6e-4, 12).half_width, 2 * 0.114, 1e-12);
  EXPECT_NEAR(error(6e-4, 12).times_beyond, 2, 1e-12);
  EXPECT_NEAR(error(6e-4, 4).times_beyond, 3, 1e-12);
}

TEST(NumericsError, OfHertzIsThatOfAShellWhoseContactsLastAsLong) {
  Scene hertz = at(tray(Law::hertz), AccuracyLevel::design);
  EXPECT_DOUBLE_EQ(numerics_error(hertz).half_width, 0.058);
  hertz.contact.youngs_modulus /=
      100;  // contacts last 100^(2/5) times as long, and as a shell are so much squared softer
  const double times = std::pow(100, 0.8) * 3e-5 / 3e-4;
  EXPECT_NEAR(numerics_error(hertz).times_beyond / times, 1, 1e-9);
  EXPECT_NEAR(numerics_error(hertz).half_width / (0.114 * times), 1, 1e-9);
}

TEST(NumericsError, AStepThatIsWrittenCountsByTheStepsOfAContact) {
  Scene scene = tray(Law::elastic_shell);
  scene.contact.shell_compression = 3e-5;
  scene.numerics.dt = prepare(scene).step.contact_duration / 6;
  EXPECT_NEAR(numerics_error(scene).times_beyond, 2, 1e-9);
}

TEST(Softness, HertzContactsLastAsLongAsTheLevelsShell) {
  const Scene shell = at(tray(Law::elastic_shell), AccuracyLevel::design),
              hertz = at(tray(Law::hertz), AccuracyLevel::design);
  ASSERT_DOUBLE_EQ(shell.contact.shell_compression, 3e-5);
  EXPECT_NEAR(prepare(hertz).step.contact_duration / prepare(shell).step.contact_duration, 1, 1e-9);
  EXPECT_LT(hertz.contact.youngs_modulus, 5e8);
}

TEST(Softness, HertzIsNeverStifferThanItsMaterial) {
  Scene soft = tray(Law::hertz);
  soft.contact.youngs_modulus = 1e5;
  EXPECT_DOUBLE_EQ(at(soft, AccuracyLevel::reference).contact.youngs_modulus, 1e5);
}

TEST(Softness, HardShakingStiffensALevel) {
  Scene scene = tray(Law::elastic_shell);
  scene.tray.motion = HarmonicMotion{.direction = 0, .amplitude = 0.03, .frequency = 20};
  const Scene draft = at(scene, AccuracyLevel::draft);
  EXPECT_LT(draft.contact.shell_compression, 3e-4);
  EXPECT_TRUE(is_predicted_sound(draft));
}

TEST(Softness, LotsAndWallsWithTheirOwnAreSoftenedAlike) {
  Scene scene = tray(Law::hertz);
  scene.lots[0].number_fraction = 0.5;
  scene.lots.push_back(
      SeedLot{.name = "weed", .diameter = 4e-3, .mass = 40e-6, .number_fraction = 0.5, .youngs_modulus = 1e8});
  scene.contact.wall_youngs_modulus = 2e9;
  const LawTraits& law = traits_of(scene.contact.law);
  set_softness(scene, law, softness_of(scene, law) * 10);
  EXPECT_DOUBLE_EQ(scene.contact.youngs_modulus, 5e7);
  EXPECT_DOUBLE_EQ(*scene.lots[1].youngs_modulus, 1e7);
  EXPECT_DOUBLE_EQ(*scene.contact.wall_youngs_modulus, 2e8);
}

/// The softest lot bounds what is known, in whatever order lots stand and whether all or some have their own.
TEST(NumericsError, IsThatOfTheSoftestLot) {
  Scene scene = tray(Law::elastic_shell);
  scene.lots[0].number_fraction = 0.5;
  scene.lots.push_back(scene.lots[0]);
  scene.lots[0].shell_compression = 1e-5, scene.lots[1].shell_compression = 1e-3;
  const double beyond = numerics_error(scene).times_beyond;
  EXPECT_NEAR(beyond, 1e-3 / 3e-4, 1e-9);
  const Scene soft_last = at(scene, AccuracyLevel::draft);
  EXPECT_DOUBLE_EQ(soft_last.lots[1].shell_compression.value(), 3e-4);
  EXPECT_DOUBLE_EQ(soft_last.lots[0].shell_compression.value(), 3e-6);
  std::swap(scene.lots[0], scene.lots[1]);
  EXPECT_EQ(numerics_error(scene).times_beyond, beyond);
  EXPECT_DOUBLE_EQ(at(scene, AccuracyLevel::draft).lots[0].shell_compression.value(), 3e-4);
  scene.lots[1].shell_compression.reset();  // that of all: 1e-4
  EXPECT_EQ(numerics_error(scene).times_beyond, beyond);
  EXPECT_DOUBLE_EQ(at(scene, AccuracyLevel::draft).lots[0].shell_compression.value(), 3e-4);
}

TEST(Softness, AModelIsThatOfItsLevel) {
  Scene scene = tray(Law::elastic_shell);
  scene.numerics.accuracy = AccuracyLevel::reference;
  const Model model = prepare(scene);
  EXPECT_DOUBLE_EQ(model.scene.contact.shell_compression, 3e-6);
  EXPECT_NEAR(model.step.contact_duration / model.step.dt, 24, 1e-9);
}

}  // namespace
}  // namespace vibrosow
