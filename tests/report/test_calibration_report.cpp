#include "report/calibration_report.hpp"

#include <gmock/gmock.h>

namespace vibrosow {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two keys and a factor, fitted to something.
class CalibrationReport : public testing::Test {
 protected:
  CalibrationReport() {
    task_.seeder = "tray.toml";
    task_.measured.file = "table.csv";
    task_.keys = {{.key = "contact.friction", .low = 0.1, .high = 0.8},
                  {.key = "contact.restitution", .low = 0.2, .high = 0.9}};
    calibration_.values = {{.mean = 0.4, .low = 0.3, .high = 0.5, .contraction = 0.6},
                           {.mean = 0.5, .low = 0.3, .high = 0.8, .contraction = 0.3}};
    calibration_.depth_factor = FittedValue{.mean = 20, .low = 18, .high = 22, .contraction = 1};
    calibration_.posterior.points = Eigen::MatrixXd::Constant(1, 2, 0.5);
    calibration_.posterior.weights = calibration_.posterior.shifts = Eigen::VectorXd::Ones(1);
    calibration_.posterior.effective_points = 1000;
    calibration_.correlations = {{0, 1, 0.2}, {0, 2, 0.7}, {1, 2, -0.1}};
    calibration_.held_out_rms = 0.02;
  }
  CalibrationSource source() const { return {task_, design_, runs_, calibration_}; }
  std::vector<std::string> doubts() const { return calibration_doubts(source()); }
  std::string file(const std::string& name) const {
    for (const OutputFile& one : calibration_files(source(), Contact{}))
      if (one.name == name) return one.content;
    return "no such file";
  }

  CalibrationTask task_;
  CalibrationDesign design_;
  std::vector<ReducedRun> runs_;
  Calibration calibration_;
};

TEST_F(CalibrationReport, HasNoDoubtWhereAllIsWell) {
  EXPECT_THAT(doubts(), IsEmpty());
}

TEST_F(CalibrationReport, NamesWhatCannotBeToldApart) {
  calibration_.correlations[1].correlation = -0.93;
  EXPECT_THAT(doubts(), ElementsAre("contact.friction and depth_factor cannot be told apart by this table (correlation "
                                    "-0.93)"));
  EXPECT_THAT(file("calibration.csv"), HasSubstr("\ncontact.friction,,0.1,0.8,0.4,0.3,0.5,60,depth_factor\n"));
  EXPECT_THAT(file("contact.toml"), HasSubstr("contraction 60 %; not told apart from depth_factor"));
}

TEST_F(CalibrationReport, NamesWhatIsDoubtful) {
  calibration_.values[1].contraction = 0.05;
  calibration_.misfit_probability = 1e-4;
  calibration_.posterior.effective_points = 50;
  calibration_.held_out_rms.reset();
  runs_ = {{"clogged", {}}, {"", {}}};
  EXPECT_THAT(doubts(), ElementsAre("the table says little of contact.restitution",
                                    HasSubstr("nowhere meets the table"), HasSubstr("50 effective points"),
                                    HasSubstr("1 of 2 runs were left out"), HasSubstr("nothing was held out")));
}

TEST_F(CalibrationReport, SaysWhatWasLearnedInEightyColumns) {
  const std::string table = calibration_table(source());
  EXPECT_THAT(table, HasSubstr("depth_factor"));
  EXPECT_THAT(table, HasSubstr("predicted to 2 % (RMS)"));
  for (std::size_t at = 0; at < table.size(); at = table.find('\n', at) + 1) EXPECT_LE(table.find('\n', at) - at, 80U);
}

}  // namespace
}  // namespace vibrosow
