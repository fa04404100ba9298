#include "report/number_text.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace vibrosow {
namespace {

/// What tests/web tries on the pages' functions too.
const nlohmann::json& cases() {
  static const nlohmann::json read =
      nlohmann::json::parse(std::ifstream(VIBROSOW_SOURCE_DIR "/tests/report/numbers.json"));
  return read;
}

TEST(NumberText, HasAsManyDigitsAsAreRead) {
  for (const auto& one : cases()["numbers"]) EXPECT_EQ(number_text(one["value"]), one["text"].get<std::string>());
  EXPECT_EQ(number_text(1.23456, 5), "1.2346");
  EXPECT_EQ(number_text(NAN), "-");
}

TEST(NumberText, ShowsAMeanToThePlaceOfItsInterval) {
  for (const auto& one : cases()["intervals"]) {
    const auto half_width = one["half_width"].is_null() ? std::nullopt : std::optional<double>(one["half_width"]);
    EXPECT_EQ(interval_text(one["mean"], half_width, "±"), one["text"].get<std::string>());
  }
}

TEST(NumberText, SaysLargeCountsInWords) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999'400), "999\u202f000");
  EXPECT_EQ(count_text(999'600), "1 million");
  EXPECT_EQ(count_text(18.63e6), "18.6 million");
  EXPECT_EQ(count_text(999.6e6), "1 billion");
  EXPECT_EQ(count_text(53.2e9), "53.2 billion");
}

TEST(NumberText, ChoosesTheUnitOfATime) {
  for (const auto& one : cases()["times"]) EXPECT_EQ(time_text(one["seconds"]), one["text"].get<std::string>());
}

}  // namespace
}  // namespace vibrosow
