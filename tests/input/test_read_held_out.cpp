#include "input/read_held_out.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "agronomy/prediction_error.hpp"
#include "input/presets.hpp"
#include "input/read_scene.hpp"
#include "input/source_files.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

ModelError error_of(const std::string& text) {
  return read_model_error(parse_csv_lines(text, "rates.csv"));
}

TEST(ReadModelError, AMaterialCountsOnce) {
  const ModelError model = error_of("material,measured,predicted,report\nwood,12,10,a\npea,9,10,b\npea,16,20,b\n");
  EXPECT_EQ(model.materials, 2);
  const double wood = std::log(1.2), pea = 0.5 * (std::log(0.9) + std::log(0.8));
  EXPECT_NEAR(model.scale, std::sqrt((wood * wood + pea * pea) / 2), 1e-12);
  EXPECT_NEAR(model.mean_factor, std::exp(0.5 * (wood + pea)), 1e-12);
}

TEST(ReadModelError, NamesWhatIsWrong) {
  EXPECT_THAT([] { error_of("material,measured\nwood,12\n"); },
              ThrowsMessage<InputError>(HasSubstr("rates.csv:1: predicted: is missing")));
  EXPECT_THAT(
      [] { error_of("material,measured,predicted\nwood,12,0\n"); },
      ThrowsMessage<InputError>(HasSubstr("rates.csv:2: predicted: \"0\" is not a number from 1e-09 to 1e+09")));
  EXPECT_THAT([] { error_of("material,measured,predicted\nwood,1e308,1e-300\n"); },
              ThrowsMessage<InputError>(HasSubstr("rates.csv:2: measured: \"1e308\" is not a number from")));
}

TEST(ReadModelError, TheShippedOneIsOfSeveralMaterials) {
  const ModelError model = shipped_model_error();
  EXPECT_GE(model.materials, 2);
  EXPECT_GT(model.scale, 0.02);
  EXPECT_LT(model.scale, 1);
}

/// What is said of the error holds for materials that are not in it: the report that leaves each out of its own error
/// is of the shipped rates, and of the error as the program has it.
TEST(ReadModelError, EachMaterialIsLeftOutOfItsOwnInTheReport) {
  SourceFiles files;
  const CsvLines shipped = files.csv(data_directory() / "models" / "held-out.csv");
  const CsvLines report = files.csv(data_directory() / "reports" / "held-out" / "left-out.csv");
  ASSERT_EQ(report.header.fields,
            (std::vector<std::string>{"material", "others", "measured_over_predicted", "low", "high", "held"}));
  ASSERT_EQ(report.rows.size(), static_cast<std::size_t>(read_model_error(shipped).materials) + 1);
  int held = 0;
  for (const CsvLines::Row& row : report.rows) {
    if (row.fields[0] == "all") continue;
    const auto number = [&](std::size_t field) { return csv_number(row.fields[field], false).value(); };
    CsvLines others = shipped, own = shipped;
    std::erase_if(others.rows, [&](const CsvLines::Row& one) { return one.fields[0] == row.fields[0]; });
    std::erase_if(own.rows, [&](const CsvLines::Row& one) { return one.fields[0] != row.fields[0]; });
    const ModelError model = read_model_error(others);
    EXPECT_EQ(model.materials, number(1));
    const FactorRange range = expected_range({.model = model});
    EXPECT_NEAR(number(3) / range.low, 1, 0.02) << row.fields[0];
    EXPECT_NEAR(number(4) / range.high, 1, 0.02) << row.fields[0];
    const double factor = read_model_error(own).mean_factor;
    EXPECT_NEAR(number(2) / factor, 1, 1e-3) << row.fields[0];
    const bool is_held = range.low <= factor && factor <= range.high;
    EXPECT_EQ(row.fields[5], is_held ? "yes" : "no") << row.fields[0];
    held += is_held ? 1 : 0;
  }
  EXPECT_EQ(report.rows.back().fields[5], std::to_string(held) + " of " + std::to_string(report.rows.size() - 1));
}

}  // namespace
}  // namespace vibrosow
