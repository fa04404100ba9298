#include "report/plan_report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "input/read_scene.hpp"
#include "support/made_up_hole_table.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Balls of 4 mm and 40 mg.
PlanSource source_of(double seeds_per_s) {
  PlanSource source;
  source.crop = "balls";
  source.lot.name = "balls";
  source.lot.diameter = 4e-3;
  source.lot.mass = 40e-6;
  source.own_mass = true;
  SowingTask task;
  task.seed = planned_seed(source.lot);
  task.pace = {0.25, 8 * kilometre_per_hour};
  task.sowing_rate = seeds_per_s * task.seed.mass / (task.pace.row_spacing * task.pace.speed);
  source.plan = plan_sowing(task, HoleTable(made_up_records()), {0.2, 5, 1 / 1.1});
  return source;
}

std::string unwrapped(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

class AnyPlan : public testing::TestWithParam<double> {};

TEST_P(AnyPlan, SaysThatNothingWasMeasuredAndFitsATerminal) {
  const std::string text = plan_text(source_of(GetParam()));
  EXPECT_THAT(unwrapped(text), HasSubstr("Nothing of this was ever measured"));
  EXPECT_THAT(unwrapped(text), HasSubstr("drill charts miss the real rate by 25 to 50 %"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

INSTANTIATE_TEST_SUITE_P(Rates, AnyPlan, testing::Values(0.5, 10, 43, 100, 300, 1000, 3000, 1e5));

TEST(PlanText, LeadsWithTheRisk) {
  const std::string narrow = unwrapped(plan_text(source_of(5)));
  EXPECT_THAT(narrow, HasSubstr("None of these stays clear of clogging"));
  EXPECT_THAT(narrow, HasSubstr("precision tray"));
  EXPECT_LT(narrow.find("None of these"), narrow.find("1:4"));
  const std::string wide = unwrapped(plan_text(source_of(1000)));
  EXPECT_THAT(wide, HasSubstr("such a hole rarely clogs"));
  EXPECT_THAT(wide, AllOf(HasSubstr("Expect "), HasSubstr(" g/s until you weigh (95 %); of it chance "),
                          HasSubstr("it gave 10 % too much")));
}

TEST(PlanText, NoneOfTheseDoes) {
  EXPECT_THAT(unwrapped(plan_text(source_of(0.5))), HasSubstr("None of these does: the least"));
  const std::string most = unwrapped(plan_text(source_of(1e5)));
  EXPECT_THAT(most, HasSubstr("None of these does: the most"));
  EXPECT_THAT(most, HasSubstr("such holes a row"));
  EXPECT_THAT(most, Not(HasSubstr("until you weigh")));
}

TEST(PlanCsv, OneRowPerLayoutEachWithItsErrorAndThatItWasNotMeasured) {
  const PlanSource source = source_of(100);
  std::istringstream csv(plan_csv(source.plan));
  std::string line;
  std::getline(csv, line);
  EXPECT_THAT(
      line,
      HasSubstr("low_seeds_per_s,high_seeds_per_s,chance_percent,numerics_percent,tolerance_percent,model_percent"));
  std::size_t rows = 0;
  while (std::getline(csv, line)) {
    EXPECT_TRUE(line.ends_with(",no")) << line;
    EXPECT_TRUE(line.starts_with(std::to_string(++rows) + ",")) << line;
  }
  EXPECT_EQ(rows, source.plan.layouts.size());
}

/// The seeder of a plan, read back.
Scene planned_scene(const PlanSource& source) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / fmt::format("planned-seeder-{}.toml", getpid());
  std::ofstream(file) << planned_seeder(source);
  Scene scene = read_scene(file);
  std::filesystem::remove(file);
  return scene;
}

TEST(PlannedSeeder, IsThatOfTheTableWithTheLayoutsHole) {
  const PlanSource source = source_of(100);
  const PlannedLayout& best = source.plan.layouts.front();
  const Scene scene = planned_scene(source), of_table = read_scene(data_directory() / "seeders" / "one-hole.toml");
  EXPECT_EQ(scene.contact, of_table.contact);
  EXPECT_EQ(scene.space, of_table.space);
  EXPECT_EQ(scene.tray.sides, of_table.tray.sides);
  EXPECT_EQ(scene.tray.front_and_back, of_table.tray.front_and_back);
  EXPECT_NEAR(scene.tray.length, of_table.tray.length, 1e-9) << "its seed is of 4 mm, too";
  EXPECT_NEAR(*scene.tray.depth, *of_table.tray.depth, 1e-9);
  EXPECT_NEAR(scene.tray.fill->count, of_table.tray.fill->count * best.depth_over_d / 6, 1);
  ASSERT_EQ(scene.tray.holes.size(), 1U);
  EXPECT_NEAR(scene.tray.holes[0].width, best.width, 1e-9);
  EXPECT_EQ(scene.tray.holes[0].shape, HoleShape::round);
  const auto& motion = std::get<HarmonicMotion>(*scene.tray.motion);
  EXPECT_NEAR(motion.frequency, best.frequency, 1e-4);
  EXPECT_NEAR(motion.amplitude, best.amplitude, 1e-9);
  EXPECT_NEAR(scene.lots[0].mass, 40e-6, 1e-12);
}

TEST(PlannedSeeder, OfSeedsMadeHeavierIsWrittenOut) {
  PlanSource source = source_of(100);
  source.lot.shape = Shape::clump;
  source.lot.discs = {{-1e-3, 0, 1.5e-3, 0}, {1e-3, 0, 1.5e-3, 0}};
  const Scene scene = planned_scene(source);
  EXPECT_EQ(scene.lots[0].shape, Shape::clump);
  EXPECT_EQ(scene.lots[0].discs.size(), 2U);
  EXPECT_NEAR(scene.lots[0].mass, 40e-6, 1e-12);
}

TEST(PlannedSeeder, OfAShippedCropNamesIt) {
  PlanSource source = source_of(100);
  source.crop = "pea";
  source.own_mass = false;
  EXPECT_THAT(planned_seeder(source), HasSubstr("crop = \"pea\""));
  EXPECT_NEAR(planned_scene(source).lots[0].diameter, 7.00e-3, 1e-9);
}

TEST(PlannedSeeder, HasTheHolesAndTheRowsOfItsLayout) {
  PlanSource source = source_of(100);
  PlannedLayout& best = source.plan.layouts.front();
  best.feed = {1, 3};
  EXPECT_THAT(planned_seeder(source), HasSubstr("rows_per_hole = 3"));
  best.feed = {2, 1};
  const std::string two = planned_seeder(source);
  EXPECT_THAT(two, HasSubstr("hole_to_row = [1, 1]"));
  const Scene scene = planned_scene(source);
  EXPECT_EQ(scene.tray.holes.size(), 2U);
  EXPECT_NEAR(scene.tray.length, 2 * *scene.tray.depth, 1e-9);
}

/// A tray of balls of 4 mm that gave `times` what the table says.
WeighedPlan weighed_plan(double times) {
  const HoleTable table(made_up_records());
  TableTray tray{{4e-3, 40e-6, 1}, {1, 4, 1.2, 6}, 1, 8e-3, 4.7};
  const double rate = 40e-6 * table.at(tray.at)->outflow / std::sqrt(4e-3 / standard_gravity);
  return plan_weighed(rate, {{tray, times * rate, 0.01}}, table, {0.2, 5, 1});
}

TEST(WeighedText, SaysWhatToSetAndHowSureItIs) {
  const SowingTask task{{4e-3, 40e-6, 1}, 0.018, {0.25, 8 * kilometre_per_hour}};
  const std::string text = unwrapped(weighed_text(task, 2, weighed_plan(1.1)));
  EXPECT_THAT(text,
              AllOf(HasSubstr("2 rows of 180 kg/ha"), HasSubstr("1.1 times the"), HasSubstr("So the tray gives 1."),
                    HasSubstr("set "), HasSubstr("Weigh at the frequency that you set")));
  EXPECT_THAT(unwrapped(weighed_text(task, 2, weighed_plan(3))), HasSubstr("Take a narrower hole"));
  EXPECT_THAT(unwrapped(weighed_text(task, 2, weighed_plan(0.3))), HasSubstr("Take a wider hole"));
  EXPECT_THAT(unwrapped(weighed_text(task, 1, weighed_plan(20))), HasSubstr("this contradicts"));
}

TEST(WeighedFiles, AreOneRowPerSettingAndPerWeighing) {
  const std::vector<OutputFile> files = weighed_files(weighed_plan(1.05));
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].name, "settings.csv");
  EXPECT_THAT(files[0].content, HasSubstr("frequency_Hz,predicted_g_per_s,low_g_per_s,high_g_per_s,more_by"));
  EXPECT_THAT(files[1].content, HasSubstr("frequency_Hz,weighed_g_per_s,predicted_g_per_s,likely_percent"));
}

}  // namespace
}  // namespace vibrosow
