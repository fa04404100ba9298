#include "input/measured.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "input/source_files.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

class Measured : public testing::Test {
 protected:
  Measured() : file_(std::filesystem::path(testing::TempDir()) / ("bench-" + std::to_string(getpid()) + ".csv")) {}
  ~Measured() override { std::filesystem::remove(file_); }

  MeasuredTable read(const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    return read_measured(SourceFiles().csv(file_));
  }
  /// The message without the file's name: ":LINE: COLUMN: ...".
  std::string error(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(file_.string())) << message;
      return message.substr(file_.string().size());
    }
    return "no error";
  }
  std::filesystem::path file_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Measured, EmptyColumnsThatASpreadsheetAppendsAreLeftOut) {
  const MeasuredTable table = read("hole;seeds_per_s;;\n1;3,5;;\n2;4,5;;;;\n3;1\n");
  ASSERT_EQ(table.series.size(), 3U);
  EXPECT_EQ(table.series[1].values[0].mean, 4.5);
  EXPECT_TRUE(contains(error("hole;seeds_per_s;;\n1;3;;x\n"), ":2: 4 fields where the header has 2"));
  EXPECT_TRUE(contains(error("hole;;seeds_per_s\n1;;3\n"), ":1: : unknown column"));
}

TEST_F(Measured, TabsOrASaidSeparatorStandBetweenFieldsAndNumbersHaveEitherMark) {
  EXPECT_DOUBLE_EQ(read("time_s\tmass_g\n0\t0,00\n1\t18,42\n").series[0].values[1].mean, 0.01842);
  EXPECT_DOUBLE_EQ(read("sep=;\ntime_s;mass_g\n0,0;0,00\n1,0;18,42\n").series[0].values[1].mean, 0.01842);
  EXPECT_DOUBLE_EQ(read("sep=|\ntime_s|mass_g\n0.0|0\n1.0|18.42\n").series[0].values[1].mean, 0.01842);
  EXPECT_DOUBLE_EQ(read("time_s;mass_g\n0.0;0\n1.0;18.42\n").series[0].values[1].mean, 0.01842);
  EXPECT_TRUE(
      contains(error("time_s;mass_g\n0;0\n1,0;18.42\n"), ":3: mass_g: \"18.42\" is not a number with a decimal comma"));
}

TEST_F(Measured, Utf16WithItsMarkIsRead) {
  std::string wide = "\xFF\xFE";
  for (const char letter : std::string("time_s;mass_g\n0;0\n1,0;18,42\n")) wide += {letter, '\0'};
  EXPECT_DOUBLE_EQ(read(wide).series[0].values[1].mean, 0.01842);
  EXPECT_TRUE(contains(error(std::string("\xFF\xFE\x00\xD8", 4) + "ab"), ": begins as UTF-16 does, and is none"));
}

TEST_F(Measured, ABalanceUnderTheVesselOrOneThatWasNotTaredIsAskedForByName) {
  EXPECT_TRUE(
      contains(error("time_s;mass_g\n0;500\n1;482,1\n2;463\n"),
               ":3: mass_g: falls from 500 to 482.1; the curve is of all that has left so far. A balance under the "
               "vessel has the column remaining_g"));
  EXPECT_TRUE(contains(error("time_s;mass_g\n0;125\n1;143,1\n2;161\n"),
                       ":2: mass_g: begins with 125 at 0 s; a curve is of what has left since its time zero. A balance "
                       "under what catches that was not tared has the column gross_g"));
  const auto values = [&](const std::string& text) {
    std::vector<double> grams;
    const MeasuredTable table = read(text);
    for (const MeanWithInterval& value : table.series[0].values) grams.push_back(std::round(1e6 * value.mean) / 1e3);
    return grams;
  };
  EXPECT_EQ(values("time_s,remaining_g\n0,500\n1,480\n2,462\n"), (std::vector<double>{0, 20, 38}));
  EXPECT_TRUE(contains(error("time_s,gross_g\n0,500\n1,482\n"),
                       ":2: gross_g: falls; a balance under the vessel has the column remaining_g"));
  EXPECT_EQ(values("time_s,gross_g\n0,125\n1,145\n2,163\n"), (std::vector<double>{0, 20, 38}));
  EXPECT_TRUE(contains(error("time_s,remaining_g\n0,480\n1,490\n2,400\n"), ":3: remaining_g: rises by 10 from"));
}

/// Each repeat is of its own fill, and need not be as long as the others.
TEST_F(Measured, RepeatsOfABalanceAreEachOfTheirOwnFill) {
  const MeasuredTable table = read("time_s,remaining_g,repeat\n0,500,1\n0.1,480,1\n0,300,2\n0.1,278,2\n0.2,260,2\n");
  ASSERT_EQ(table.series.size(), 1U);
  const std::vector<MeanWithInterval>& values = table.series[0].values;
  EXPECT_DOUBLE_EQ(values[0].mean, 0);
  EXPECT_DOUBLE_EQ(values[1].mean, 0.021);
  EXPECT_DOUBLE_EQ(values[2].mean, 0.04);
  EXPECT_NEAR(*values[1].half_width_95, 12.706 * 0.001, 1e-6) << "of 20 and 22 g, not of 480 and 278";
  EXPECT_TRUE(contains(error("time_s,remaining_g\n0,500\n0,300\n0.1,480\n0.1,278\n"),
                       ":2: remaining_g: 2 readings at 0 s differ; give a column repeat"));
  EXPECT_TRUE(contains(error("time_s,gross_g,repeat\n0,100,1\n0.1,120,1\n0.05,300,2\n0.1,311,2\n"),
                       ":4: repeat: repeat 2 has no reading at 0 s, where the others begin"));
  EXPECT_TRUE(contains(error("tray.holes.count,repeat,rate_g_per_s\n3,1,4\n3,2,4.1\n5,1,6\n3,1,4\n"),
                       ":5: repeat: repeat 1 stands twice"));
  EXPECT_EQ(read("time_s,gross_g\n0,100\n0,100.5\n0.1,120\n").series.size(), 1U);
}

/// A balance trembles by a hundredth; a curve that is read from later on may begin with what three times its mean rate
/// has brought by then, and a twentieth more.
TEST_F(Measured, ACurveMayTrembleAndBeginLater) {
  EXPECT_EQ(read("time_s,mass_g\n0,0\n1,50\n2,49.1\n3,100\n").series.size(), 1U);
  EXPECT_TRUE(contains(error("time_s,mass_g\n0,0\n1,50\n2,48.9\n3,100\n"), ":4: mass_g: falls from 50 to 48.9"));
  EXPECT_EQ(read("time_s,mass_g\n0,4.9\n3,100\n").series.size(), 1U);
  EXPECT_TRUE(contains(error("time_s,mass_g\n0,5.1\n3,100\n"), "begins with 5.1"));
  EXPECT_EQ(read("time_s,mass_g\n1,34\n11,134\n").series.size(), 1U);  // 3 * 10 + 0.05 * 134
  EXPECT_TRUE(contains(error("time_s,mass_g\n1,38\n11,138\n"), "begins with 38"));
}

TEST_F(Measured, RatesWithRepeatsAreAveraged) {
  const MeasuredTable table = read(
      "# bench, 3 May\n"
      "tray.motion.frequency_Hz,tray.holes.count,hole,repeat,rate_g_per_s,note\n"
      "9,5,1,1,2,\n"
      "9,5,1,2,4,\"lid open, then shut\"\n"
      "9,5,all,1,15,\n"
      "# a break\n"
      "\n"
      "11.50,5,1,1,3,\n");
  EXPECT_EQ(table.quantity, MeasuredQuantity::mass_rate);
  EXPECT_EQ(table.condition_keys, (std::vector<std::string>{"tray.motion.frequency", "tray.holes.count"}));
  ASSERT_EQ(table.series.size(), 3U);
  const MeasuredSeries& first = table.series[0];
  EXPECT_EQ(first.conditions,
            (std::vector<Condition>{{"tray.motion.frequency", "9", 9.0}, {"tray.holes.count", "5", 5.0}}));
  EXPECT_EQ(first.hole, "1");
  EXPECT_EQ(first.lot, "all");
  EXPECT_TRUE(first.times.empty());
  ASSERT_EQ(first.values.size(), 1U);
  EXPECT_DOUBLE_EQ(first.values[0].mean, 3e-3);                   // SI
  EXPECT_NEAR(*first.values[0].half_width_95, 12.7062e-3, 1e-7);  // t(0.975, 1) * 1 g/s
  EXPECT_EQ(first.where, file_.string() + ":3");
  EXPECT_EQ(table.series[1].hole, "all");
  EXPECT_FALSE(table.series[1].values[0].half_width_95);
  EXPECT_EQ(table.series[2].conditions[0].text, "11.5");
  EXPECT_EQ(table.series[2].where, file_.string() + ":8");
}

TEST_F(Measured, SemicolonsAndDecimalCommasGiveTheSame) {
  const MeasuredTable point = read("tray.motion.amplitude_mm,lot,caught_seeds,duration_s\n9.5,wheat,42,10.5\n");
  const MeasuredTable comma =
      read("\xEF\xBB\xBFtray.motion.amplitude_mm;lot;caught_seeds;duration_s\r\n9,5;wheat;42;10,5\r\n;;;\r\n");
  for (const MeasuredTable& table : {point, comma}) {
    EXPECT_EQ(table.quantity, MeasuredQuantity::seed_rate);
    ASSERT_EQ(table.series.size(), 1U);
    EXPECT_EQ(table.series[0].conditions, (std::vector<Condition>{{"tray.motion.amplitude", "9.5", 9.5}}));
    EXPECT_EQ(table.series[0].lot, "wheat");
    EXPECT_DOUBLE_EQ(table.series[0].values[0].mean, 4);
  }
}

TEST_F(Measured, CurvesAreSortedByTimeAndKeptPerCondition) {
  const MeasuredTable table = read(
      "tray.holes.width_mm,repeat,time_s,discharged_percent\n"
      "40,1,0,0\n40,1,2,30\n40,1,1,10\n40,2,1,20\n60,1,1,40\n");
  EXPECT_EQ(table.quantity, MeasuredQuantity::fraction_curve);
  ASSERT_EQ(table.series.size(), 2U);
  EXPECT_EQ(table.series[0].times, (std::vector<double>{0, 1, 2}));
  EXPECT_DOUBLE_EQ(table.series[0].values[1].mean, 0.15);
  EXPECT_TRUE(table.series[0].values[1].half_width_95);
  EXPECT_FALSE(table.series[0].values[2].half_width_95);
  EXPECT_DOUBLE_EQ(table.series[1].values[0].mean, 0.4);
}

TEST_F(Measured, EveryQuantityIsRead) {
  EXPECT_DOUBLE_EQ(read("caught_g,duration_s\n30,10\n").series[0].values[0].mean, 3e-3);
  EXPECT_DOUBLE_EQ(read("seeds_per_s\n30\n").series[0].values[0].mean, 30);
  EXPECT_DOUBLE_EQ(read("time_s,mass_g\n1,30\n").series[0].values[0].mean, 0.03);
  EXPECT_DOUBLE_EQ(read("time_s,seeds\n1,30\n").series[0].values[0].mean, 30);
}

TEST_F(Measured, ResultsAreStatedInTheColumnsOwnUnit) {
  EXPECT_EQ(column_of(MeasuredQuantity::fraction_curve), "discharged_percent");
  EXPECT_DOUBLE_EQ(to_column_unit(MeasuredQuantity::fraction_curve, 0.15), 15);
  EXPECT_DOUBLE_EQ(to_column_unit(MeasuredQuantity::mass_rate, 3e-3), 3);
  EXPECT_DOUBLE_EQ(to_column_unit(MeasuredQuantity::seed_curve, 7), 7);
}

TEST_F(Measured, ConditionsBecomeOverrides) {
  const MeasuredTable table =
      read("tray.motion.frequency_Hz,tray.holes.count,numerics.integrator,seeds_per_s\n9,5,rk2-midpoint,3\n");
  const auto& conditions = table.series[0].conditions;
  const Override frequency = override_of(conditions[0], table.series[0].where);
  EXPECT_EQ(frequency.key, "tray.motion.frequency");
  EXPECT_EQ(toml_text(*frequency.value), "\"9 Hz\"");
  EXPECT_EQ(frequency.where, file_.string() + ":2");
  EXPECT_EQ(toml_text(*override_of(conditions[1], "").value), "5");
  EXPECT_EQ(toml_text(*override_of(conditions[2], "").value), "\"rk2-midpoint\"");
}

TEST_F(Measured, UnknownColumnsAreErrorsWithTheNearest) {
  EXPECT_TRUE(contains(error("tray.motion.frequncy_Hz,seeds_per_s\n9,3\n"),
                       ":1: tray.motion.frequncy_Hz: unknown column; nearest: tray.motion.frequency_Hz"));
  EXPECT_TRUE(contains(error("holes,seeds_per_s\n1,3\n"), "nearest: hole"));
  EXPECT_TRUE(contains(error("# x\nweather_in_the_barn,seeds_per_s\n1,3\n"),
                       ":2: weather_in_the_barn: unknown column; known are"));
  EXPECT_TRUE(
      contains(error("tray.motion.frequency,seeds_per_s\n9,3\n"), "carries its unit: tray.motion.frequency_Hz"));
  EXPECT_TRUE(contains(error("tray.motion.frequency_rpm,seeds_per_s\n540,3\n"), "unknown column"));
  EXPECT_TRUE(contains(error("hole,hole,seeds_per_s\n1,1,3\n"), ":1: hole: stands twice"));
}

TEST_F(Measured, ExactlyOneQuantityIsNeeded) {
  EXPECT_TRUE(contains(error("hole\n1\n"), "exactly one quantity is needed"));
  EXPECT_TRUE(contains(error("seeds_per_s,rate_g_per_s\n1,3\n"), "exactly one quantity is needed"));
  EXPECT_TRUE(contains(error("caught_g\n1\n"), "caught_g: needs a column duration_s"));
  EXPECT_TRUE(contains(error("seeds\n1\n"), "seeds: needs a column time_s"));
  EXPECT_TRUE(contains(error("seeds_per_s,duration_s\n1,3\n"), "duration_s: does not belong to seeds_per_s"));
  EXPECT_TRUE(contains(error("caught_g,duration_s,time_s\n1,3,3\n"), "time_s: does not belong to caught_g"));
}

TEST_F(Measured, BadValuesAreNamedByLineAndColumn) {
  EXPECT_TRUE(contains(error("hole,seeds_per_s\n1,3\n2,three\n"),
                       ":3: seeds_per_s: \"three\" is not a number with a decimal point"));
  EXPECT_TRUE(contains(error("seeds_per_s;hole\n3,5;1\n3.5;2\n"),
                       ":3: seeds_per_s: \"3.5\" is not a number with a decimal comma"));
  EXPECT_TRUE(contains(error("seeds_per_s\n-3\n"), "-3 is negative"));
  EXPECT_TRUE(contains(error("seeds_per_s\nnan\n"), "is not a number"));
  EXPECT_TRUE(contains(error("seeds_per_s\ninf\n"), "is not a number"));
  EXPECT_TRUE(contains(error("seeds_per_s\n1e999\n"), "is not a number"));
  EXPECT_TRUE(contains(error("seeds_per_s,hole\n,1\n"), "is not a number"));
  EXPECT_TRUE(contains(error("seeds_per_s\n0\n"), "rate of zero"));
  EXPECT_TRUE(contains(error("time_s,seeds\n1,0\n2,0\n"), "never leaves zero"));
  EXPECT_TRUE(contains(error("caught_g,duration_s\n3,0\n"), "duration_s: must be greater than zero"));
  EXPECT_TRUE(contains(error("time_s,discharged_percent\n1,120\n"), "more than 100 %"));
  EXPECT_TRUE(contains(error("hole,seeds_per_s\nleft,3\n"), ":2: hole: \"left\" is neither"));
  EXPECT_TRUE(contains(error("hole,seeds_per_s\n0,3\n"), "is neither"));
  EXPECT_TRUE(contains(error("lot,seeds_per_s\n,3\n"), "lot: is empty"));
  EXPECT_TRUE(contains(error("tray.motion.frequency_Hz,seeds_per_s\n,3\n"), "is empty; a column left out means"));
  EXPECT_TRUE(contains(error("tray.motion.frequency_Hz,seeds_per_s\nfast,3\n"), "\"fast\" is not a number"));
}

TEST_F(Measured, NumbersBeyondAnySeederAreNamedByLineAndColumn) {
  EXPECT_TRUE(contains(error("rate_g_per_s\n3\n1e308\n"),
                       ":3: rate_g_per_s: 1e+308 is out of range; expected zero, or from 1e-06 to 1e+09"));
  EXPECT_TRUE(contains(error("seeds_per_s\n1e-300\n"), ":2: seeds_per_s: 1e-300 is out of range"));
  EXPECT_TRUE(contains(error("caught_g,duration_s\n3,1\n3,1e-300\n"), ":3: duration_s: 1e-300 is out of range"));
  EXPECT_TRUE(contains(error("caught_g,duration_s\n1e9,1e-3\n"), ":2: rate_g_per_s: 1e+12 is out of range"));
  EXPECT_TRUE(contains(error("time_s,mass_g\n0,0\n1e-300,1\n"), ":3: time_s: 1e-300 is out of range"));
  EXPECT_TRUE(contains(error("time_s,seeds\n0,0\n1,1e300\n"), ":3: seeds: 1e+300 is out of range"));
}

TEST_F(Measured, ManyRepeatsAreReadInNoTime) {
  std::string text = "repeat,rate_g_per_s\n";
  for (int repeat = 0; repeat < 100000; ++repeat) text += std::to_string(repeat) + ",3\n";
  const MeasuredTable table = read(text);
  ASSERT_EQ(table.series.size(), 1U);
  EXPECT_EQ(table.series[0].repeats[0], 100000);
  EXPECT_TRUE(contains(error(text + "7,3\n"), ":100002: repeat: repeat 7 stands twice"));
}

TEST_F(Measured, BrokenFilesAreErrors) {
  EXPECT_TRUE(contains(error("hole,seeds_per_s\n1,3,4\n"), ":2: 3 fields where the header has 2"));
  EXPECT_TRUE(contains(error("seeds_per_s,note\n3,\"never closed\n4,x\n"), ":2: a quote"));
  EXPECT_TRUE(contains(error("# only a comment\n"), ": is empty"));
  EXPECT_TRUE(contains(error("seeds_per_s\n"), ":1: only a header"));
  EXPECT_THROW(SourceFiles().csv("no/such/file.csv"), InputError);
  EXPECT_THROW(SourceFiles().csv(std::filesystem::path(testing::TempDir())), InputError);
}

}  // namespace
}  // namespace vibrosow
