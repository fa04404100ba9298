#include "input/read_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "scene/motion.hpp"
#include "scene/si_units.hpp"
#include "temporary_file.hpp"

namespace vibrosow::read_motion_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Scene read(const TemporaryFolder& folder, const std::string& motion) {
  return read_scene(folder.write("seeder.toml", R"(
[seeds.pea]
diameter = "8 mm"
mass = "0.3 g"
[contact]
shell_compression = 1e-4
[tray]
length = "50 cm"
height = "12 cm"
fill = { count = 10 }
[run]
duration = "1 s"
[tray.motion]
)" + motion));
}

TEST(ReadMotion, HarmonicWithPhaseAndStop) {
  const TemporaryFolder folder;
  const Scene scene = read(folder, R"(kind = "harmonic"
amplitude = "5 mm"
frequency = "10 Hz"
phase = "90 degree"
stop = "4 s"
)");
  const auto& m = std::get<HarmonicMotion>(*scene.tray.motion);
  EXPECT_NEAR(m.phase, 90 * degree, 1e-15);
  EXPECT_EQ(m.stop, 4);
  EXPECT_EQ(m.stop_ramp, 0.1) << "one period";
}

TEST(ReadMotion, SumSharesRampAndStop) {
  const TemporaryFolder folder;
  const Scene scene = read(folder, R"(kind = "sum"
components = [ { amplitude = "5 mm", frequency = "10 Hz" },
               { amplitude = "1 mm", frequency = "20 Hz", direction = "90 degree", phase = "45 degree" } ]
ramp = "0.2 s"
stop = "3 s"
stop_ramp = "0.5 s"
)");
  const auto& sum = std::get<SumMotion>(*scene.tray.motion);
  ASSERT_EQ(sum.components.size(), 2u);
  EXPECT_EQ(sum.components[1].amplitude, 1e-3);
  EXPECT_NEAR(sum.components[1].phase, 45 * degree, 1e-15);
  for (const HarmonicMotion& m : sum.components) {
    EXPECT_EQ(m.ramp, 0.2);
    EXPECT_EQ(m.stop, 3);
    EXPECT_EQ(m.stop_ramp, 0.5);
  }
  EXPECT_EQ(motion_text(*scene.tray.motion), "5 mm at 10 Hz + 1 mm at 20 Hz");
}

TEST(ReadMotion, Rocking) {
  const TemporaryFolder folder;
  const Scene scene = read(folder, R"(kind = "rocking"
pivot = ["25 cm", "-1 cm"]
angle = "2 degree"
frequency = "3 Hz"
)");
  const auto& m = std::get<RockingMotion>(*scene.tray.motion);
  EXPECT_EQ(m.pivot, Eigen::Vector2d(0.25, -0.01));
  EXPECT_NEAR(m.angle, 2 * degree, 1e-15);
  EXPECT_EQ(m.frequency, 3);
  EXPECT_EQ(m.stop, never);
  EXPECT_TRUE(turns(*scene.tray.motion));
}

TEST(ReadMotion, Turning) {
  const TemporaryFolder folder;
  const Scene scene = read(folder, R"(kind = "turning"
speed = "-6 rpm"
pivot = ["25 cm", "3 cm"]
ramp = "1 s"
stop = "5 s"
)");
  const auto& m = std::get<TurningMotion>(*scene.tray.motion);
  EXPECT_EQ(m.pivot, Eigen::Vector2d(0.25, 0.03));
  EXPECT_NEAR(m.angular_velocity, -0.2 * std::numbers::pi, 1e-15);
  EXPECT_EQ(m.axis, TurningAxis::across);
  EXPECT_EQ(m.ramp, 1);
  EXPECT_EQ(m.stop, 5);
  EXPECT_NEAR(m.stop_ramp, 10, 1e-14) << "one turn";
  EXPECT_TRUE(turns(*scene.tray.motion));
  EXPECT_TRUE(turns_steadily(scene.tray));
  EXPECT_EQ(motion_text(*scene.tray.motion), "-6 rpm about the axis across at (250, 30) mm");
}

TEST(ReadMotion, TableBesideTheFileThatNamesIt) {
  const TemporaryFolder folder;
  folder.write("shake.csv", "# measured\ntime_s;y_mm;angle_degree\n0;0;0\n0,1;1,5;1\n0,2;0;0\n0,3;-1;-2\n");
  const Scene scene = read(folder, "kind = \"table\"\nfile = \"shake.csv\"\n");
  const auto& m = std::get<TableMotion>(*scene.tray.motion);
  EXPECT_EQ(m.times, (std::vector<double>{0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(m.x, (std::vector<double>{0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(m.y[1], 1.5e-3);
  EXPECT_DOUBLE_EQ(m.angle[3], -2 * degree);
  EXPECT_TRUE(moves(*scene.tray.motion));
}

TEST(ReadMotion, WrongTablesAreRefusedWithLineAndColumn) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& message) {
    const auto file = folder.write("shake.csv", text);
    EXPECT_THAT([&] { read_motion_table(SourceFiles().csv(file)); },
                ThrowsMessage<InputError>(HasSubstr(file.string() + message)));
  };
  refused("time_s,x_mm\n0,0\n1,1\n2,0\n", ":4: time_s: expected at least 4 rows");
  refused("time_s,x_mm\n0,0\n1e-4,1e5\n2,0\n3,0\n",
          ":3: x_mm: \"1e5\" is too far from the row before: faster than 1000 m/s");
  refused("time_s,x_mm\n0,1e300\n1,1e300\n2,1e300\n3,1e300\n",
          ":2: x_mm: \"1e300\" is out of range, which is from -1e+06 to 1e+06");
  refused("time_s,angle_degree\n0,0\n1,1\n2,0\n3,-1e9\n", ":5: angle_degree: \"-1e9\" is out of range");
  refused("time_s,y_mm\n0,0\n1e-9,1\n2,0\n3,0\n", ":3: y_mm: \"1\" is too far from the row before");
  refused("time_s,angle_degree\n0,0\n1,1e6\n2,0\n3,0\n",
          ":3: angle_degree: \"1e6\" is too far from the row before: faster than 1000 turns");
  refused("time_s,x_mm\n0,0\n1,1\n2,0\n1e300,0\n",
          ":5: time_s: \"1e300\" is out of range, which is from -1e+06 to 1e+06");
  refused("time_s,x_mm\n0,0\n1,1\n1,0\n2,0\n", ":4: time_s: 1 is not later than the row before");
  refused("time_s,x_mm\n0,0\n1,a\n2,0\n3,0\n", ":3: x_mm: \"a\" is not a number");
  refused("time_s,x_m\n0,0\n1,1\n2,0\n3,0\n",
          ":1: x_m: unknown column; known are time_s, x_mm, y_mm, z_mm, angle_degree");
  refused("x_mm,y_mm\n0,0\n1,1\n2,0\n3,0\n", ":1: time_s: is missing");
  refused("time_s\n0\n1\n2\n3\n", ":1: time_s: stands alone");
  refused("time_s,x_mm,x_mm\n0,0,0\n1,1,1\n2,0,0\n3,0,0\n", ":1: x_mm: stands twice");
}

}  // namespace
}  // namespace vibrosow::read_motion_test
