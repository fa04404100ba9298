#include "report/record_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace vibrosow {
namespace {

class RecordReport : public testing::Test {
 protected:
  void SetUp() override {
    scene.lots = {{.name = "wheat", .diameter = 4e-3, .mass = 40e-6, .number_fraction = 0.5},
                  {.name = "weed", .diameter = 4e-3, .mass = 10e-6, .number_fraction = 0.5}};
    scene.tray.name = "tray";
    scene.tray.length = 0.04;
    scene.tray.height = 0.1;
    scene.tray.holes = {{0.01, 0.016}};
    scene.record = Record{{0, 1}, 5e-3};
    run.end_time = 10;
    // Three grains at the corners of a triangle, moved with the tray and sheared by 0.5: x += y / 2.
    Snapshot s{.time = 0,
               .x = {7.5e-3, 12.5e-3, 7.5e-3},
               .y = {2.5e-3, 2.5e-3, 7.5e-3},
               .vx = {0, 0, 0.01},
               .vy = {0, 0, 0},
               .omega = {0, 0, 1},
               .lot = {0, 0, 1},
               .id = {4, 5, 6},
               .radius = {2e-3, 2e-3, 2e-3},
               .mass = {40e-6, 40e-6, 10e-6},
               .area = {4e-6 * std::numbers::pi, 4e-6 * std::numbers::pi, 4e-6 * std::numbers::pi},
               .start_x = {0, 0, 0.03},
               .start_y = {0, 0, 0.02}};
    run.snapshots = {s, s};
    Snapshot& later = run.snapshots[1];
    later.time = 1;
    later.tray_x = 1e-3;
    for (std::size_t i = 0; i < 3; ++i) later.x[i] += 1e-3 + 0.5 * (later.y[i] - 2.5e-3);
    run.events = {{1, 1, 0, 0, 40e-6, 0.005, 0.5}};
  }
  Scene scene;
  vibrosow::Run run;
};

TEST_F(RecordReport, NothingWithoutARecord) {
  scene.record.reset();
  EXPECT_TRUE(record_files(scene, run).empty());
}

TEST_F(RecordReport, HasTwoFilesASnapshotAndThreeOfTheRun) {
  std::vector<std::string> names;
  for (const OutputFile& file : record_files(scene, run)) names.push_back(file.name);
  EXPECT_EQ(names, (std::vector<std::string>{"grains_001.csv", "fields_001.csv", "grains_002.csv", "fields_002.csv",
                                             "records.csv", "profile.csv", "flow.csv"}));
}

TEST_F(RecordReport, GrainsAreInTheTraysFrameWithTheirShearSinceTheLastRecord) {
  const std::string header =
      "id,lot,x_mm,y_mm,vx_m_per_s,vy_m_per_s,omega_rad_per_s,angle_rad,radius_mm,start_x_mm,start_y_mm,shear\n";
  EXPECT_EQ(grains_csv(scene, run.snapshots[0], nullptr), header +
                                                              "4,wheat,7.5,2.5,0,0,0,,2,0,0,\n"
                                                              "5,wheat,12.5,2.5,0,0,0,,2,0,0,\n"
                                                              "6,weed,7.5,7.5,0.01,0,1,,2,30,20,\n");
  EXPECT_EQ(grains_csv(scene, run.snapshots[1], &run.snapshots[0]), header +
                                                                        "4,wheat,7.5,2.5,0,0,0,,2,0,0,0.5\n"
                                                                        "5,wheat,12.5,2.5,0,0,0,,2,0,0,0.5\n"
                                                                        "6,weed,10,7.5,0.01,0,1,,2,30,20,0.5\n");
}

TEST_F(RecordReport, FieldsHaveTheCellsThatHoldGrains) {
  // pi 4 / 25 of a cell is covered. All three grains are in reach (12 mm): v_x = 0.01 m/s over 5 mm is 2 per s.
  const std::string text = fields_csv(scene, run.snapshots[0], nullptr);
  EXPECT_TRUE(text.starts_with(
      "x_mm,y_mm,packing_fraction,packing_change,vx_m_per_s,vy_m_per_s,shear_rate_per_s,dilation_rate_per_s\n"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 4);
  EXPECT_NE(text.find("\n12.5,2.5,0.502655,,"), std::string::npos) << text;
  EXPECT_NE(text.find(",0,2,"), std::string::npos) << text;
  // The third grain has moved by half a cell.
  const std::string later = fields_csv(scene, run.snapshots[1], &run.snapshots[0]);
  EXPECT_NE(later.find("\n7.5,7.5,0.251327,-0.251327,"), std::string::npos) << later;
  EXPECT_NE(later.find("\n12.5,7.5,0.251327,0.251327,"), std::string::npos) << later;
  EXPECT_NE(later.find("\n7.5,2.5,0.502655,0,"), std::string::npos) << later;
}

TEST_F(RecordReport, APeriodicTrayLosesNoneAtItsSeam) {
  scene.tray.sides = Sides::periodic;
  for (double& x : run.snapshots[0].x) x += 32.5e-3;  // to 40, 45 and 40 mm: the seam is at 40 mm
  EXPECT_NE(records_csv(scene, run.snapshots).find("1,0,all,3,0.09,"), std::string::npos)
      << records_csv(scene, run.snapshots);
  // Cells of 5 mm: half of each grain on the seam is in the first column and half in the last, the other is in the
  // first two.
  const std::string text = fields_csv(scene, run.snapshots[0], nullptr);
  EXPECT_NE(text.find("\n2.5,2.5,0.502655,"), std::string::npos) << text;
  EXPECT_NE(text.find("\n7.5,2.5,0.251327,"), std::string::npos) << text;
  EXPECT_NE(text.find("\n37.5,2.5,0.251327,"), std::string::npos) << text;
  EXPECT_NE(text.find("\n37.5,7.5,0.251327,"), std::string::npos) << text;
  EXPECT_EQ(std::ranges::count(text, '\n'), 6) << text;
}

/// The same three grains as balls, 6, 10 and 6 mm from the front of a tray that has moved by 1 mm across, and a fourth
/// behind the first, since it takes four to tell a strain in 3D.
class RecordReport3d : public RecordReport {
 protected:
  void SetUp() override {
    RecordReport::SetUp();
    scene.space = Space::three_dimensional;
    scene.tray.depth = 0.02;
    for (Snapshot& s : run.snapshots) {
      s.z = {6e-3, 10e-3, 6e-3};
      s.x.push_back(7.5e-3), s.y.push_back(2.5e-3), s.z.push_back(14e-3);
      s.vx.push_back(0), s.vy.push_back(0), s.vz = {0, 0.25, 0, 0};
      s.omega.push_back(0), s.omega_x = {0, 0, 2, 0}, s.omega_y = {0, 0, 3, 0};
      s.lot.push_back(0), s.id.push_back(7), s.radius.push_back(2e-3), s.mass.push_back(40e-6);
      s.area.clear(), s.volume.assign(4, 32e-9 / 3 * std::numbers::pi);
      s.start_x.push_back(0), s.start_y.push_back(0), s.start_z = {0, 0, 0.01, 0};
      s.tray_z = 1e-3;
      for (double& z : s.z) z += 1e-3;
    }
    run.snapshots[1].x[3] = 8.5e-3;  // with the tray
  }
};

TEST_F(RecordReport3d, GrainsHaveColumnsMoreAndFieldsTheirMeanOverTheDepth) {
  EXPECT_EQ(grains_csv(scene, run.snapshots[1], &run.snapshots[0]),
            "id,lot,x_mm,y_mm,vx_m_per_s,vy_m_per_s,omega_rad_per_s,angle_rad,radius_mm,start_x_mm,start_y_mm,shear,"
            "z_mm,vz_m_per_s,omega_x_rad_per_s,omega_y_rad_per_s,start_z_mm,q_w,q_x,q_y,q_z\n"
            "4,wheat,7.5,2.5,0,0,0,,2,0,0,0.5,6,0,0,0,0,,,,\n"
            "5,wheat,12.5,2.5,0,0,0,,2,0,0,0.5,10,0.25,0,0,0,,,,\n"
            "6,weed,10,7.5,0.01,0,1,,2,30,20,0.5,6,0,2,3,10,,,,\n"
            "7,wheat,7.5,2.5,0,0,0,,2,0,0,0.5,14,0,0,0,0,,,,\n");
  for (Snapshot& s : run.snapshots) s.q_w.assign(4, 0.5), s.q_x = s.q_y = s.q_z = s.q_w;
  EXPECT_NE(grains_csv(scene, run.snapshots[1], nullptr).find("14,0,0,0,0,0.5,0.5,0.5,0.5\n"), std::string::npos);
  // 4 / 3 pi 8 of a cell of 25 mm2 through 20 mm; two balls in the first cell.
  const std::string text = fields_csv(scene, run.snapshots[0], nullptr);
  EXPECT_NE(text.find(",dilation_rate_per_s,vz_m_per_s\n7.5,2.5,0.134041,,"), std::string::npos) << text;
  EXPECT_NE(text.find("\n12.5,2.5,0.0670206,,"), std::string::npos) << text;
}

TEST_F(RecordReport3d, ASliceHasWhatLiesInTheMiddle) {
  scene.record->view = MapView::slice;
  // From 7.5 to 12.5 mm: a whole ball, and two caps 0.5 mm high.
  const std::string text = fields_csv(scene, run.snapshots[0], nullptr);
  EXPECT_EQ(std::ranges::count(text, '\n'), 4) << text;
  EXPECT_NE(text.find("\n12.5,2.5,0.268083,,0,0,,,0.25\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n7.5,7.5,0.0115192,,"), std::string::npos) << text;
}

TEST_F(RecordReport, ProfileAndRecordsTellWhereTheLotsLie) {
  run.snapshots.pop_back();
  EXPECT_EQ(profile_csv(scene, run.snapshots),
            "time_s,height_mm,lot,grains,mass_g,mass_fraction\n"
            "0,2.5,wheat,2,0.08,1\n"
            "0,2.5,weed,0,0,0\n"
            "0,7.5,wheat,0,0,0\n"
            "0,7.5,weed,1,0.01,1\n");
  // No grain reaches into the bed's inside, 10 to 30 by 5 to 7.5 mm.
  // Mean heights 2.5, 7.5 and, of all, 12.5 / 3 mm. Tops of 5 mm columns: 0, 9.5, 4.5 and 0 mm left, none right.
  EXPECT_EQ(records_csv(scene, run.snapshots),
            "record,time_s,lot,grains,mass_g,segregation,flux_asymmetry,surface_asymmetry,packing_fraction\n"
            "1,0,wheat,2,0.08,-1.2,,,\n"
            "1,0,weed,1,0.01,1.2,,,\n"
            "1,0,all,3,0.09,,,1,0\n");
}

TEST_F(RecordReport, FlowHasItsWindowsAndTheWhole) {
  const std::string text = flow_csv(scene, run);
  EXPECT_TRUE(text.starts_with(
      "from_s,to_s,hole,grains,mass_g,asymmetry,pauses,longest_pause_s,paused_s,paused_fraction\n0,1,1,0,0,,1,1,1,1\n"))
      << text;
  EXPECT_TRUE(text.ends_with("\n0,10,1,1,0.04,1,2,9,10,1\n")) << text;
}

}  // namespace
}  // namespace vibrosow
