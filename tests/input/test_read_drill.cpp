#include <gtest/gtest.h>

#include <string>

#include "input/read_scene.hpp"
#include "temporary_file.hpp"

namespace vibrosow::read_drill_test {
namespace {

const std::string tray = R"([seeds.wheat]
diameter = "4 mm"
mass = "40 mg"
[contact]
shell_compression = 1e-3
[tray]
length = "50 cm"
height = "12 cm"
fill = { count = 40 }
[tray.holes]
count = 3
width = "16 mm"
[run]
duration = "4 s"
)";

Seeder read(const std::string& drill, const std::vector<Override>& overrides = {}) {
  const TemporaryFolder folder;
  return read_seeder(folder.write("seeder.toml", tray + drill), overrides);
}

TEST(ReadDrill, AHoleFeedsARowUnlessItIsSaid) {
  EXPECT_FALSE(read("").drill);
  const Drill drill = *read("[drill]\nrow_spacing = \"25 cm\"\nspeed = \"9 km/h\"\n").drill;
  EXPECT_DOUBLE_EQ(drill.pace.row_spacing, 0.25);
  EXPECT_DOUBLE_EQ(drill.pace.speed, 2.5);
  EXPECT_EQ(drill.hole_to_row, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(drill.rows(), 3);
  EXPECT_FALSE(drill.reference_spacing);
  EXPECT_EQ(drill.limits, (SpacingLimits{.multiples_below = 0.5, .skips_above = 1.5}));
  EXPECT_DOUBLE_EQ(drill.cv_limit, 0.05);
}

TEST(ReadDrill, RowsMayShareAHoleAndHolesARow) {
  const std::string pace = "[drill]\nrow_spacing = \"15 cm\"\nspeed = \"2 m/s\"\n";
  const Drill shared = *read(pace + "rows_per_hole = 4").drill;
  EXPECT_EQ(shared.hole_to_row, (std::vector<int>{1, 5, 9}));
  EXPECT_EQ(shared.rows(), 12);
  EXPECT_EQ(shared.streams(), 3);
  EXPECT_EQ(shared.stream_of(1), 1u);
  const Drill joined = *read(pace + "hole_to_row = [2, 1, 2]").drill;
  EXPECT_EQ(joined.rows(), 2);
  EXPECT_EQ(joined.stream_of(0), 1u);
  EXPECT_EQ(joined.stream_of(1), 0u);
}

TEST(ReadDrill, LimitsAreSettings) {
  const Drill drill = *read(R"([drill]
row_spacing = "15 cm"
speed = "2 m/s"
reference_spacing = "5 cm"
multiples_below = 0.4
skips_above = 1.6
cv_limit = "10 %"
)")
                           .drill;
  EXPECT_DOUBLE_EQ(*drill.reference_spacing, 0.05);
  EXPECT_EQ(drill.limits, (SpacingLimits{.multiples_below = 0.4, .skips_above = 1.6}));
  EXPECT_DOUBLE_EQ(drill.cv_limit, 0.1);
}

TEST(ReadDrill, ChangesNoScene) {
  const std::string drill = "[drill]\nrow_spacing = \"15 cm\"\nspeed = \"2 m/s\"\n";
  const Seeder slow = read(drill), fast = read(drill, {parse_override("drill.speed=14.4 km/h")});
  EXPECT_EQ(slow.scene, fast.scene);
  EXPECT_EQ(slow.scene, read("").scene);
  EXPECT_DOUBLE_EQ(fast.drill->pace.speed, 4);
}

}  // namespace
}  // namespace vibrosow::read_drill_test
