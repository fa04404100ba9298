#include "report/page.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "vessel/vessel_motion.hpp"

namespace vibrosow {
namespace {

const std::string page_template =
    "<script id=\"report-data\" type=\"application/json\">@REPORT_DATA@</script>"
    "<script id=\"recording\" type=\"text/plain\">@RECORDING@</script>";

TEST(Page, GivesBackTheRecordingThatItWasFilledWith) {
  for (const std::size_t length : {0U, 1U, 2U, 3U, 256U}) {
    std::string bytes(length, '\0');
    std::iota(bytes.begin(), bytes.end(), char(0));
    EXPECT_EQ(recording_in(filled_page(page_template, "{}", bytes)), bytes) << length << " bytes";
  }
}

TEST(Page, HasNoRecordingWhereNoneIsReadable) {
  EXPECT_EQ(recording_in(""), "");
  EXPECT_EQ(recording_in("<script id=\"recording\" type=\"text/plain\">not base64</script>"), "");
  EXPECT_EQ(recording_in("<script id=\"recording\" type=\"text/plain\">AAA</script>"), "");
}

Scene with_round_hole() {
  Scene scene;
  scene.space = Space::three_dimensional;
  scene.tray.name = "tray";
  scene.tray.length = 0.1, scene.tray.height = 0.05, scene.tray.depth = 0.04;
  Hole hole;
  hole.shape = HoleShape::round;
  hole.centre = 0.03, hole.across = 0.02, hole.width = 0.008;
  scene.tray.holes = {hole};
  return scene;
}

TEST(Page, AFloorHasItsRoundHolesAsRoundHoles) {
  const nlohmann::json faces = page_faces(with_round_hole())["tray"];
  const auto floor = std::ranges::find_if(faces, [](const nlohmann::json& face) { return face.contains("holes_mm"); });
  ASSERT_NE(floor, faces.end());
  const nlohmann::json& hole = (*floor)["holes_mm"][0];
  const auto at = [&](std::size_t axis) {
    return (*floor)["at_mm"][axis].get<double>() + hole[0].get<double>() * (*floor)["e1"][axis].get<double>() +
           hole[1].get<double>() * (*floor)["e2"][axis].get<double>();
  };
  EXPECT_DOUBLE_EQ(at(0), 30);
  EXPECT_DOUBLE_EQ(at(1), 0);
  EXPECT_DOUBLE_EQ(at(2), 20);
  EXPECT_DOUBLE_EQ(hole[2].get<double>(), 4);
  EXPECT_EQ(faces.size(), 5U);  // floor, two ends, front and back
}

TEST(Page, AGateSaysWhenItOpensAndWhatIsTurnedHasItsRims) {
  Scene scene = with_round_hole();
  scene.tray.holes[0].open_at = 0.5;
  const nlohmann::json gate = page_faces(scene)["tray"].back();
  EXPECT_EQ(gate["opens_at_s"], 0.5);
  EXPECT_EQ(gate["rims_mm"], nlohmann::json({{0.0, 0.0}, {4.0, 0.0}}));
}

TEST(Page, APeriodicTrayIsDrawnOnceAndAPlaneHasNoFaces) {
  Scene scene = with_round_hole();
  scene.tray.sides = scene.tray.front_and_back = Sides::periodic;
  const nlohmann::json faces = page_faces(scene)["tray"];
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_EQ(faces[0]["size_mm"], nlohmann::json({40.0, 100.0}));
  EXPECT_EQ(faces[0]["holes_mm"].size(), 1U);
  scene.space = Space::two_dimensional;
  EXPECT_TRUE(page_faces(scene).empty());
}

TEST(Page, APathFollowsTheShakeBetweenItsPlaces) {
  Scene scene = with_round_hole();
  scene.tray.front = 0.01, scene.tray.origin = {0.02, 0.03};
  HarmonicMotion motion;
  motion.amplitude = 0.004, motion.frequency = 9;
  scene.tray.motion = motion;
  const nlohmann::json path = page_paths(scene, 1)["tray"];
  const double step = path["step_s"];
  ASSERT_GT(static_cast<double>(path["at"].size() - 1) * step, 1.0);
  for (double time = 0; time < 1; time += 0.0037) {
    const auto k = static_cast<std::size_t>(time / step);
    const double part = time / step - static_cast<double>(k);
    const auto between = [&](std::size_t axis) {
      return (1 - part) * path["at"][k][axis].get<double>() + part * path["at"][k + 1][axis].get<double>();
    };
    EXPECT_NEAR(between(0), 20 + 1e3 * vessel_pose(scene.tray, time).displacement.x(), 0.01 * 4) << time;
    EXPECT_NEAR(between(1), 30, 1e-9);
    EXPECT_NEAR(between(2), 10, 1e-9);
  }
  EXPECT_LE(page_paths(scene, 1e4)["tray"]["at"].size(), 20002U);
  scene.tray.motion.reset();
  EXPECT_TRUE(page_paths(scene, 1).empty());
}

TEST(Page, ATextEndsNoScript) {
  const std::string text = page_text({{"title", "</script><img onerror=x>"}});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text)["title"], "</script><img onerror=x>");
}

TEST(Page, ItsDataAreKeptWithAndWithoutIt) {
  const std::vector<OutputFile> both = page_files(page_template, "{}"), data = page_files("", "{}");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].name, "report.json");
  EXPECT_EQ(both[0].content, "{}\n");
  EXPECT_EQ(both[1].name, "report.html");
  EXPECT_EQ(both[1].content, filled_page(page_template, "{}"));
  ASSERT_EQ(data.size(), 1U);
  EXPECT_EQ(data[0].content, both[0].content);
}

TEST(Page, ATemplateWithoutPlacesIsRefused) {
  EXPECT_THROW(filled_page("<html>", "{}"), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
