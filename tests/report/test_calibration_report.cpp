#include "report/calibration_report.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/calibration_page.hpp"
#include "scene/scene_json.hpp"
#include "support/made_up_calibration.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;

class CalibrationReport : public MadeUpCalibration {
 protected:
  std::string file(const std::string& name) const {
    for (const OutputFile& one : calibration_files(answer(), Contact{}))
      if (one.name == name) return one.content;
    return "no such file";
  }
};

TEST_F(CalibrationReport, NamesWhatCannotBeToldApart) {
  calibration_.correlations[1].correlation = -0.93;
  EXPECT_THAT(file("calibration.csv"), HasSubstr("\ncontact.friction,,0.1,0.8,0.4,0.3,0.5,60,depth_factor,,yes\n"));
  EXPECT_THAT(file("contact.toml"), HasSubstr("uncertainty reduced by 60 %; not told apart from depth_factor"));
}

TEST_F(CalibrationReport, WithoutAContactSaysSo) {
  EXPECT_THAT(calibration_table(answer()), testing::Not(HasSubstr("No contact.toml is written")));
  calibration_.values[0] = {.mean = 0.76, .low = 0.7, .high = 0.787, .contraction = 0.6};  // at the edge
  EXPECT_EQ(file("contact.toml"), "no such file");
  EXPECT_THAT(calibration_table(answer()),
              testing::AllOf(testing::StartsWith("Doubtful: contact.friction lies at the upper edge"),
                             HasSubstr("No contact.toml is written")));
}

TEST_F(CalibrationReport, NothingFittedIsSaidBesideTheValues) {
  calibration_.misfit_over_noise = 30;
  EXPECT_THAT(file("calibration.csv"), HasSubstr(",fitted\ncontact.friction,,0.1,0.8,0.4,0.3,0.5,60,,,no\n"));
  const auto data = nlohmann::json::parse(calibration_page_data(answer(), Scene{}));
  EXPECT_EQ(data["headline"], "Nothing was fitted: no values within the ranges meet table.csv.");
}

/// Nowhere else are they all.
TEST_F(CalibrationReport, ThePageHasEveryDoubt) {
  runs_.resize(12);
  for (std::size_t k = 0; k < runs_.size(); ++k) runs_[k] = {"", {}, {{static_cast<DoubtKind>(k), "so"}}};
  ASSERT_GT(answer().doubts.size(), 10U);
  EXPECT_EQ(nlohmann::json::parse(calibration_page_data(answer(), Scene{}))["remarks"].size(), answer().doubts.size());
}

TEST_F(CalibrationReport, SaysWhatWasLearnedInEightyColumns) {
  const std::string table = calibration_table(answer());
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
  nlohmann::json data() const { return nlohmann::json::parse(calibration_page_data(answer(), Scene{})); }
};

TEST_F(CalibrationPage, SaysTheValuesAndHowWellTheHeldOutOnesArePredicted) {
  EXPECT_EQ(
      data()["headline"],
      "Fitted to table.csv: contact.friction 0.4 (0.3 to 0.5), contact.restitution 0.5 (0.3 to 0.8), depth_factor "
      "20 (18 to 22). What was held out is predicted to 2 % (RMS).");
  EXPECT_TRUE(data()["remarks"].empty());
  EXPECT_EQ(data()["scene"], nlohmann::json::parse(scene_to_json(Scene{})));
  EXPECT_EQ(data()["vessels"].size(), 1U);
  calibration_.misfit_probability = 0.001;
  EXPECT_THAT(data()["remarks"][0]["text"].get<std::string>(), testing::StartsWith("the model nowhere meets"));
  EXPECT_EQ(data()["remarks"][0]["serious"], true);
  calibration_.held_out_rms = std::nullopt;
  EXPECT_THAT(data()["headline"].get<std::string>(), testing::EndsWith("(18 to 22)."));
}

TEST_F(CalibrationPage, ParametersHaveTheirRangeAndTheFactorHasNone) {
  const auto parameters = data()["parameters"];
  ASSERT_EQ(parameters.size(), 3U);
  EXPECT_EQ(parameters[0]["prior_high"], 0.8);
  EXPECT_EQ(parameters[0]["contraction_percent"], 60.0);
  EXPECT_TRUE(parameters[2]["prior_low"].is_null());
  EXPECT_EQ(parameters[0]["edge"], "");
  calibration_.values[0] = {.mean = 0.76, .low = 0.7, .high = 0.787, .contraction = 0.6};
  EXPECT_EQ(data()["parameters"][0]["edge"], "upper");
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
