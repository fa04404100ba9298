#include "report/calibration_report.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/calibration_page.hpp"

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
  runs_ = {{"clogged", {}, {}}, {"", {}, {}}};
  EXPECT_THAT(doubts(), ElementsAre("the table says little of contact.restitution",
                                    HasSubstr("nowhere meets the table"), HasSubstr("50 effective points"),
                                    HasSubstr("1 of 2 runs were left out"), HasSubstr("nothing was held out")));
}

/// 0.1 to 0.8 is a range of 0.7, of which two hundredths are near an edge.
TEST_F(CalibrationReport, AValueAtTheEdgeOfItsRangeIsSaidToBeAndGivesNoContact) {
  EXPECT_TRUE(gives_a_contact(source()));
  calibration_.values[0] = {.mean = 0.76, .low = 0.7, .high = 0.787, .contraction = 0.6};
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("contact.friction lies at the upper edge of its range, 0.1 to 0.8")));
  EXPECT_FALSE(gives_a_contact(source()));
  EXPECT_EQ(file("contact.toml"), "no such file");
  EXPECT_THAT(calibration_table(source()), HasSubstr("No contact.toml is written"));
  calibration_.values[0].high = 0.785;
  EXPECT_THAT(doubts(), IsEmpty());
  calibration_.values[0] = {.mean = 0.13, .low = 0.113, .high = 0.2, .contraction = 0.6};
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("lower edge")));
  calibration_.values[0].contraction = 0.1;  // then it reaches to both: nothing is known of it
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("the table says little of")));
}

TEST_F(CalibrationReport, AMisfitThatDwarfsTheNoiseIsNoFit) {
  calibration_.misfit_probability = 1e-9, calibration_.misfit_over_noise = 2.9;
  EXPECT_FALSE(is_beyond_its_noise(source()));
  EXPECT_FALSE(gives_a_contact(source()));
  calibration_.misfit_over_noise = 3.1;
  EXPECT_TRUE(is_beyond_its_noise(source()));
  EXPECT_THAT(doubts(), ElementsAre(HasSubstr("miss it by 3.1 times its noise. Nothing was fitted")));
}

TEST_F(CalibrationReport, AContractionBelowNothingIsExplained) {
  calibration_.values[1].contraction = -0.2;
  EXPECT_THAT(doubts(), testing::Contains(HasSubstr("contact.restitution scatters more than an even spread")));
}

TEST_F(CalibrationReport, RunsThatLostSeedsGiveNoContact) {
  runs_ = {{"", {}, {{DoubtKind::guard_warned, "deep"}}}};  // which is said
  EXPECT_TRUE(gives_a_contact(source()));
  runs_.push_back({"", {}, {{DoubtKind::seeds_lost, "2 of 9 seeds lost through walls"}}});
  EXPECT_FALSE(gives_a_contact(source()));
  runs_.back().reason = "clogged";  // it does not count
  EXPECT_TRUE(gives_a_contact(source()));
}

TEST_F(CalibrationReport, SaysWhatWasLearnedInEightyColumns) {
  const std::string table = calibration_table(source());
  EXPECT_THAT(table, HasSubstr("depth_factor"));
  EXPECT_THAT(table, HasSubstr("predicted to 2 % (RMS)"));
  for (std::size_t at = 0; at < table.size(); at = table.find('\n', at) + 1) EXPECT_LE(table.find('\n', at) - at, 80U);
}

class CalibrationPage : public CalibrationReport {
 protected:
  CalibrationPage() {
    task_.measured.table.quantity = MeasuredQuantity::mass_rate;
    task_.measured.table.series.resize(2);
    task_.measured.table.series[1].hole = std::string("2");
    calibration_.predictions = {
        {.series = 1, .time = {}, .held_out = true, .measured = 0.012, .predicted = 0.01, .low = 0.009, .high = 0.011}};
    calibration_.posterior.weights = Eigen::VectorXd::Ones(1);
    calibration_.posterior.shifts = Eigen::VectorXd::Constant(1, std::log(20.0));
    calibration_.fitted_rms = 0.01;
  }
  nlohmann::json data() const { return nlohmann::json::parse(calibration_page_data(source(), Scene{})); }
};

TEST_F(CalibrationPage, SaysTheValuesAndHowWellTheHeldOutOnesArePredicted) {
  EXPECT_EQ(
      data()["headline"],
      "Fitted to table.csv: contact.friction 0.4 (0.3 to 0.5), contact.restitution 0.5 (0.3 to 0.8), depth_factor "
      "20 (18 to 22). What was held out is predicted to 2 % (RMS).");
  EXPECT_EQ(data()["doubts"].size(), doubts().size());
  calibration_.held_out_rms = std::nullopt;
  EXPECT_THAT(data()["headline"].get<std::string>(), testing::EndsWith("(18 to 22)."));
}

TEST_F(CalibrationPage, ParametersHaveTheirRangeAndTheFactorHasNone) {
  const auto parameters = data()["parameters"];
  ASSERT_EQ(parameters.size(), 3U);
  EXPECT_EQ(parameters[0]["prior_high"], 0.8);
  EXPECT_EQ(parameters[0]["contraction_percent"], 60.0);
  EXPECT_TRUE(parameters[2]["prior_low"].is_null());
}

TEST_F(CalibrationPage, PairsThatAreNotToldApartBringTheirPoints) {
  EXPECT_TRUE(data()["pairs"][1]["points"].empty());
  calibration_.correlations[1].correlation = -0.9;
  const auto pair = data()["pairs"][1];
  EXPECT_EQ(pair["b"], "depth_factor");
  EXPECT_EQ(pair["told_apart"], false);
  ASSERT_FALSE(pair["points"].empty());
  EXPECT_NEAR(pair["points"][0][0].get<double>(), 0.45, 1e-9);  // the middle of 0.1 to 0.8
  EXPECT_NEAR(pair["points"][0][1].get<double>(), 20, 1e-9);
}

TEST_F(CalibrationPage, MeasuredValuesStandWithTheirSeriesInTheTablesUnit) {
  const auto series = data()["series"];
  ASSERT_EQ(series.size(), 2U);
  EXPECT_TRUE(series[0]["values"].empty());
  const auto value = series[1]["values"][0];
  EXPECT_NEAR(value["measured"].get<double>(), 12, 1e-9);  // g/s
  EXPECT_EQ(value["held_out"], true);
  EXPECT_TRUE(value["time_s"].is_null());
  EXPECT_EQ(data()["quantity"], "rate_g_per_s");
}

}  // namespace
}  // namespace vibrosow
