#include "report/plan_report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "input/read_crop_lot.hpp"
#include "input/read_scene.hpp"
#include "report/plan_page.hpp"
#include "scene/seed_lot.hpp"
#include "support/made_up_hole_table.hpp"

namespace vibrosow {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Balls of 4 mm and 40 mg.
PlanSource source_of(double seeds_per_s) {
  PlanSource source;
  SeedLot balls{.name = "balls", .diameter = 4e-3, .mass = 40e-6};
  SowingTask task;
  task.seed = planned_seed({balls});
  task.pace = {0.25, 8 * kilometre_per_hour};
  task.sowing_rate = seeds_per_s * task.seed.mass / (task.pace.row_spacing * task.pace.speed);
  source.lots = {{"balls", {balls, task.sowing_rate}, 40e-6}};
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
  EXPECT_THAT(wide, HasSubstr("Such a hole rarely clogs"));
  EXPECT_THAT(wide, AllOf(HasSubstr("Expect "), HasSubstr(" g/s until you weigh (95 %); of it chance "),
                          HasSubstr("simulated rates were 10 % too high on average")));
}

TEST(PlanText, AMassFarFromTheCropsIsDoubted) {
  PlanSource source = source_of(100);
  const auto needs = [&] { return need_sentences(source).front(); };
  EXPECT_THAT(needs(), Not(HasSubstr("doubtful")));
  source.lots.front().crop_mass = 19e-6;
  EXPECT_THAT(needs(),
              HasSubstr("(doubtful: 2.1 times as heavy as the crop's own, of 19 g a thousand; look at the unit)"));
  source.lots.front().crop_mass = 90e-6;
  EXPECT_THAT(needs(), HasSubstr("doubtful: 0.44 times"));
  source.lots.front().crop_mass.reset();
  EXPECT_THAT(needs(), Not(HasSubstr("doubtful")));
}

TEST(PlanText, SaysWhatTheContactDoes) {
  PlanSource source = source_of(100);
  EXPECT_THAT(unwrapped(plan_text(source)), HasSubstr("The crop names no contact model"));
  source.contact = {{0.2, 0.3, 0.01, 0.5}, false};
  source.plan.table_times = 1.14;
  EXPECT_THAT(unwrapped(plan_text(source)),
              HasSubstr("For the crop's own contact (friction 0.2, on the tray 0.3, rolling 0.01, restitution 0.5) the "
                        "rates are taken 1.14 times, by runs with other contacts."));
  source.contact->is_beyond = true;
  EXPECT_THAT(unwrapped(plan_text(source)), HasSubstr("the nearest of them, as it lies beyond them"));
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

TEST(PlannedSeeder, OfACropThatNamesItsContactHasIt) {
  PlanSource source = source_of(100);
  source.lots.front().crop = "pea";
  source.lots.front().sown.lot = read_crop_lot("pea", "--crop");
  source.lots.front().crop_mass.reset();
  source.contact = {{0.2, 0.3, 0.01, 0.5}, false};
  const Scene scene = planned_scene(source), of_table = read_scene(data_directory() / "seeders" / "one-hole.toml");
  Contact own = read_crop_contact("pea", "--crop")->contact;
  own.shell_compression = of_table.contact.shell_compression;
  EXPECT_EQ(scene.contact.seed, own.seed);
  EXPECT_EQ(scene.contact.wall, own.wall);
  EXPECT_EQ(scene.contact.shell_compression, own.shell_compression);
  EXPECT_EQ(scene.contact.rolling, Rolling::spring);
  source.lots.front().crop_mass = 200e-6;  // so that the lot is written out
  EXPECT_EQ(planned_scene(source).contact.seed, own.seed);
}

/// What a plan has written can be weighed: it is read back as the tray that was planned, also at the table's ends.
TEST(PlannedSeeder, IsATrayThatTheTableKnows) {
  const HoleTable table(made_up_records());
  PlanSource source = source_of(100);
  const std::vector<PlannedLayout> layouts = source.plan.layouts;
  for (const PlannedLayout& layout : layouts) {
    source.plan.layouts.front() = layout;
    const TableTray tray = table_tray(planned_scene(source));
    EXPECT_NEAR(tray.at.depth, layout.depth_over_d, 1e-9);
    const double needed = layout.feed.rows * source.plan.task.row_mass_rate();
    EXPECT_NEAR(predicted_rate(tray, table) / needed, 1, 1e-4);
  }
}

TEST(PlannedSeeder, OfSeedsMadeHeavierIsWrittenOut) {
  PlanSource source = source_of(100);
  SeedLot& lot = source.lots.front().sown.lot;
  lot.shape = Shape::clump;
  lot.discs = {{-1e-3, 0, 1.5e-3, 0}, {1e-3, 0, 1.5e-3, 0}};
  const Scene scene = planned_scene(source);
  EXPECT_EQ(scene.lots[0].shape, Shape::clump);
  EXPECT_EQ(scene.lots[0].discs.size(), 2U);
  EXPECT_NEAR(scene.lots[0].mass, 40e-6, 1e-12);
}

TEST(PlannedSeeder, OfAShippedCropNamesIt) {
  PlanSource source = source_of(100);
  source.lots.front().crop = "pea";
  source.lots.front().crop_mass.reset();
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
  return plan_weighed(rate, tray, {{tray, times * rate, 0.01}}, table, {0.2, 5, 1});
}

TEST(WeighedText, SaysWhatToSetAndHowSureItIs) {
  PlanSource source = source_of(100);
  source.plan.task.sowing_rate = 180 * kilogram_per_hectare;
  const std::string text = unwrapped(weighed_text(source, 2, weighed_plan(1.1)));
  EXPECT_THAT(text,
              AllOf(HasSubstr("2 rows of 180 kg/ha"), HasSubstr("1.1 times the"), HasSubstr("So the tray gives 1."),
                    HasSubstr("set "), HasSubstr("Weigh at the frequency that you set")));
  EXPECT_THAT(unwrapped(weighed_text(source, 2, weighed_plan(3))), HasSubstr("Take a narrower hole"));
  EXPECT_THAT(unwrapped(weighed_text(source, 2, weighed_plan(0.3))), HasSubstr("Take a wider hole"));
  EXPECT_THAT(unwrapped(weighed_text(source, 1, weighed_plan(20))),
              HasSubstr("this contradicts what the model errs by (so far off"));
  WeighedPlan of_repeats = weighed_plan(1.1);
  of_repeats.rows[0].weighed.repeats_scatter = 0.09;
  EXPECT_THAT(unwrapped(weighed_text(source, 2, of_repeats)), Not(HasSubstr("contradict")));
  of_repeats.rows[0].weighed.repeats_scatter = 0.47;
  EXPECT_THAT(unwrapped(weighed_text(source, 2, of_repeats)), HasSubstr("its repeats scatter by 47 %"));
}

/// 100 kg/ha of wheat and 50 kg/ha of peas.
PlanSource mixture() {
  PlanSource source;
  std::vector<SownLot> sown;
  for (const auto& [crop, rate] : {std::pair{"wheat", 100.0}, {"pea", 50.0}}) {
    sown.push_back({read_crop_lot(crop, "--crop"), rate * kilogram_per_hectare});
    source.lots.push_back({crop, {}, false});
  }
  share_out(sown);
  for (std::size_t i = 0; i < 2; ++i) source.lots[i].sown = sown[i];
  SowingTask task;
  task.seed = planned_seed({sown[0].lot, sown[1].lot});
  task.seed.aspect = 1;  // the made-up table is of balls
  task.pace = {0.15, 8 * kilometre_per_hour};
  task.sowing_rate = 150 * kilogram_per_hectare;
  source.plan = plan_sowing(task, HoleTable(made_up_records()), {0.2, 5, 1 / 1.1});
  return source;
}

TEST(PlanText, OfAMixtureTellsEachCropAndThatItSegregates) {
  const PlanSource source = mixture();
  const std::string text = unwrapped(plan_text(source));
  EXPECT_THAT(text, AllOf(HasSubstr("100 kg/ha, 338 seeds/m2"), HasSubstr("50 kg/ha, 26.5 seeds/m2"),
                          HasSubstr("together 150 kg/ha, 364 seeds/m2"), HasSubstr("Segregation is not in the table")));
  EXPECT_THAT(unwrapped(weighed_text(source, 2, weighed_plan(1.1))), HasSubstr("Segregation is not in the table"));
  EXPECT_THAT(unwrapped(plan_text(source_of(100))), Not(HasSubstr("Segregation")));
}

/// Read back, its lots are those of the plan and in its parts.
TEST(PlannedSeeder, OfAMixtureHasItsCrops) {
  const PlanSource source = mixture();
  const Scene scene = planned_scene(source);
  ASSERT_EQ(scene.lots.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(scene.lots[i].number_fraction, source.lots[i].sown.lot.number_fraction, 1e-8);
    EXPECT_NEAR(mean_mass(scene.lots[i]), mean_mass(source.lots[i].sown.lot), 1e-12);
  }
}

TEST(WeighedFiles, AreOneRowPerSettingAndPerWeighing) {
  const std::vector<OutputFile> files = weighed_files(source_of(100), weighed_plan(1.05));
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].name, "settings.csv");
  EXPECT_THAT(files[0].content, HasSubstr("frequency_Hz,predicted_g_per_s,low_g_per_s,high_g_per_s,more_by"));
  EXPECT_THAT(files[1].content, HasSubstr("frequency_Hz,weighed_g_per_s,predicted_g_per_s,likely_percent"));
  EXPECT_THAT(files[2].content, HasSubstr("crop,rate_kg_per_ha,seeds_per_m2,number_percent\nballs,"));
}

/// The rows of a page's first table, its head aside.
int rows_of_card(const std::string& page) {
  const std::string table = page.substr(0, page.find("</table>"));
  int rows = -1;
  for (std::size_t at = table.find("<tr>"); at != std::string::npos; at = table.find("<tr>", at + 1)) ++rows;
  return rows;
}

void expect_needs_nothing(const std::string& page) {
  for (const char* word : {"http", "src=", "href", "url(", "<script", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(word)));
  EXPECT_THAT(page, AllOf(HasSubstr("@page"), HasSubstr("width=device-width")));
}

TEST(PlanPageText, HasACardAndWhatToWeigh) {
  PlanSource source = source_of(100);
  source.lots.front().crop = "<balls>";
  const PlannedLayout& best = source.plan.layouts.front();
  const HoleTable table(made_up_records());
  const TrayRates rates(table_tray(source.plan.task, best), table, {0.2, 5, 1});
  const PlanCard card{rates.tray(), best.feed.rows,
                      settings_card(rates, source.plan.task, best.feed.rows, best.more_by_faster)};
  const std::string page = plan_page({.source = source, .card = &card, .command = "vibrosow plan --crop <balls>"});
  expect_needs_nothing(page);
  EXPECT_EQ(rows_of_card(page), 11);
  EXPECT_THAT(page, AllOf(HasSubstr("&lt;balls&gt;"), Not(HasSubstr("<balls>")), HasSubstr("What to weigh"),
                          HasSubstr("Nothing of this was ever measured")));
  EXPECT_LT(page.find("Nothing of this was ever measured"), page.find("<table>")) << "the doubts come first";
  // At the planned speed stands the planned frequency.
  EXPECT_THAT(page, HasSubstr(fmt::format("<td>8</td>")));
  EXPECT_THAT(page, HasSubstr(fmt::format("<td>{:.3g}</td>", best.frequency)));
}

TEST(PlanPageText, OfAWeighedTraySaysWhatWasWeighed) {
  PlanSource source = source_of(100);
  const HoleTable table(made_up_records());
  const WeighedPlan weighed = weighed_plan(1.1);
  source.plan.task.sowing_rate = sowing_rate(weighed.needed, source.plan.task.pace);
  const TrayRates rates = weighed_rates(weighed.rows[0].weighed.tray, {weighed.rows[0].weighed}, table, {0.2, 5, 1});
  const PlanCard card{rates.tray(), 1, settings_card(rates, source.plan.task, 1)};
  const std::string page = plan_page({.source = source, .card = &card, .weighed = &weighed, .command = "again"});
  expect_needs_nothing(page);
  EXPECT_EQ(rows_of_card(page), 11);
  EXPECT_THAT(page, AllOf(HasSubstr("1.1 times the"), HasSubstr("So the tray gives"), HasSubstr("again --weighed")));
}

/// What no layout gives has no card, and says why.
TEST(PlanPageText, WithoutALayout) {
  const PlanSource source = source_of(1e5);
  const std::string page = plan_page({.source = source, .command = ""});
  EXPECT_EQ(rows_of_card(page), -1);
  EXPECT_THAT(page, HasSubstr("None of these does"));
}

}  // namespace
}  // namespace vibrosow
