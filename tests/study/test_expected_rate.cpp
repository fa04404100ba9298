#include "study/expected_rate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "agronomy/table_tray.hpp"
#include "input/read_held_out.hpp"
#include "report/sweep_report.hpp"
#include "study/sweep.hpp"
#include "support/made_up_hole_table.hpp"
#include "support/study_files.hpp"
#include "support/table_tray_scene.hpp"

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

RateKnowledge knowledge(const ModelError& model = {0.2, 5, 1}) {
  return {HoleTable(made_up_records()), model};
}

TEST(SceneError, HasThreePartsOfATrayThatTheTableKnows) {
  const Scene scene = table_tray_scene();  // as soft as 1e-4, between draft and design
  const SceneError found = *scene_error(scene, knowledge());
  EXPECT_NEAR(half_width_of_normal(found.error.numerics), 0.055, 1e-12);
  EXPECT_DOUBLE_EQ(found.error.tolerance, *tray_tolerance(scene, knowledge().table).deviation);
  EXPECT_EQ(found.error.model.materials, 5);
  EXPECT_EQ(found.error.chance, 0);
  EXPECT_TRUE(found.knows_tolerance);
  EXPECT_THAT(found.doubts, IsEmpty());
}

TEST(SceneError, IsNoneInThePlane) {
  Scene scene = table_tray_scene();
  scene.space = Space::two_dimensional;
  EXPECT_FALSE(scene_error(scene, knowledge()));
}

TEST(SceneError, DoubtsWhatLiesOutside) {
  Scene scene = table_tray_scene();
  scene.tray.holes[0].shape = HoleShape::slot;
  const SceneError slot = *scene_error(scene, knowledge());
  EXPECT_FALSE(slot.knows_tolerance);
  EXPECT_EQ(slot.error.tolerance, 0);
  EXPECT_THAT(slot.doubts, ElementsAre(Field(&Doubt::text, HasSubstr("is not known, and not in what is expected"))));
  scene = table_tray_scene();
  scene.tray.holes[0].width = 40e-3;
  EXPECT_THAT(scene_error(scene, knowledge())->doubts,
              ElementsAre(Field(&Doubt::text, testing::AllOf(HasSubstr("tray.holes.width: 10 seeds"),
                                                             HasSubstr("from the table's nearest place")))));
  scene = table_tray_scene();
  scene.contact.shell_compression = 6e-4;
  const SceneError soft = *scene_error(scene, knowledge());
  EXPECT_THAT(soft.doubts, ElementsAre(Field(&Doubt::kind, DoubtKind::beyond_the_levels)));
  EXPECT_NEAR(half_width_of_normal(soft.error.numerics), 2 * 0.055, 1e-12);
}

TEST(ExpectedRate, OfNormalPartsIsALognormal) {
  const SceneError error = *scene_error(table_tray_scene(), knowledge({}));
  const ExpectedRate expected = *expected_rate(6e-3, 0.05, error);
  const double chance = std::asinh(0.05), numerics = std::asinh(0.055), tolerance = 1.959964 * error.error.tolerance;
  EXPECT_NEAR(std::log(expected.range.high), std::sqrt(chance * chance + numerics * numerics + tolerance * tolerance),
              1e-6);
  EXPECT_NEAR(expected.range.low * expected.range.high, 1, 1e-9);
  EXPECT_NEAR(half_width_of_normal(expected.error.chance), 0.05, 1e-12);
}

TEST(ExpectedRate, IsWiderThanTheModelAlone) {
  const ExpectedRate expected = *expected_rate(6e-3, 0.05, *scene_error(table_tray_scene(), knowledge()));
  EXPECT_GT(expected.range.high, expected_range({.model = knowledge().model}).high);
  EXPECT_LT(expected.range.low, expected_range({.model = knowledge().model}).low);
}

TEST(ExpectedRate, IsNoneWithoutARateOrChance) {
  const SceneError error = *scene_error(table_tray_scene(), knowledge());
  EXPECT_FALSE(expected_rate(0, 0.05, error));
  EXPECT_FALSE(expected_rate(std::nan(""), 0.05, error));
  EXPECT_FALSE(expected_rate(6e-3, std::nullopt, error));
}

class ExpectedOfAStudy : public testing::Test {
 protected:
  StudyResult result(const std::string& space, const std::string& more = "", int replicates = 3) const {
    const Study study = read_study(files_.study(
        "replicates = " + std::to_string(replicates) + "\n[set]\nspace = \"" + space +
        "\"\ncontact.shell_compression = 1e-4\n"
        "contact.friction_model = \"spring\"\ncontact.rolling = \"spring\"\ncontact.rolling_friction = "
        "0.02\n[set.tray.holes]\nshape = \"round\"\n[set.tray.motion]\nkind = "
        "\"harmonic\"\namplitude = \"8 mm\"\nfrequency = \"5 Hz\"\n[vary]\ntray.holes.width = [\"14 mm\", \"16 "
        "mm\"]\n" +
        more));
    StudyResult found = sweep(study, quick_run, {});
    if (knowledge_for(found.study)) expect_rates(found, knowledge());
    return found;
  }
  StudyFiles files_;
};

TEST_F(ExpectedOfAStudy, EachLayoutHasItsOwn) {
  const StudyResult found = result("3d");
  for (const LayoutResult& layout : found.layouts) {
    ASSERT_TRUE(layout.expected);
    const MeanWithInterval& rate = *layout.metrics["rate_g_per_s"];
    EXPECT_EQ(layout.expected->mass_rate, rate.mean);
    EXPECT_NEAR(half_width_of_normal(layout.expected->error.chance), *rate.half_width_95 / rate.mean, 1e-12);
    EXPECT_EQ(layout.status, LayoutStanding::ok);
    EXPECT_THAT(layout.doubts, IsEmpty());
  }
  EXPECT_GT(found.layouts[0].expected->error.tolerance, found.layouts[1].expected->error.tolerance) << "narrower";
}

TEST_F(ExpectedOfAStudy, OfASingleRunChanceIsThatOfItsBlocks) {
  const LayoutResult layout = result("3d", "", 1).layouts[0];
  EXPECT_FALSE(layout.metrics["rate_g_per_s"]->half_width_95);
  ASSERT_TRUE(layout.expected);
  EXPECT_GT(layout.expected->error.chance, 0);
}

TEST_F(ExpectedOfAStudy, NoneInThePlaneNorBesideMeasuredOutflow) {
  for (const LayoutResult& layout : result("2d").layouts) EXPECT_FALSE(layout.expected);
  files_.write("measured.csv", "tray.holes.width_mm,hole,seeds_per_s\n14,all,20\n16,all,30\n");
  const StudyResult beside = result("3d", "[measured]\nfile = \"measured.csv\"\nscale = \"none\"\n");
  ASSERT_TRUE(beside.study.measured);
  for (const LayoutResult& layout : beside.layouts) EXPECT_FALSE(layout.expected);
}

TEST_F(ExpectedOfAStudy, ADoubtAboutAPartIsMild) {
  const Study study = read_study(files_.study(
      "replicates = 3\n[set]\nspace = \"3d\"\n[set.tray.holes]\nshape = \"round\"\n[vary]\ntray.holes.width = "
      "[\"14 mm\", \"16 mm\"]\n"));
  StudyResult found = sweep(study, quick_run, {});
  expect_rates(found, knowledge());
  for (const LayoutResult& layout : found.layouts) {
    EXPECT_EQ(layout.status, LayoutStanding::ok);
    EXPECT_THAT(layout.doubts, ElementsAre(Field(&CountedDoubt::kind, DoubtKind::beyond_the_levels),
                                           Field(&CountedDoubt::kind, DoubtKind::outside_the_table)));
    EXPECT_FALSE(layout.expected->knows_tolerance);
  }
  const std::string csv = sweep_csv(found);
  EXPECT_THAT(csv, HasSubstr("tray.motion: the tray is not shaken to and fro"));
}

TEST(RateKnowledge, IsShipped) {
  const RateKnowledge shipped = shipped_rate_knowledge();
  EXPECT_EQ(shipped.model.materials, shipped_model_error().materials);
  EXPECT_FALSE(shipped.table.records().empty());
}

}  // namespace
}  // namespace vibrosow
