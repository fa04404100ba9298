#include "report/number_text.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace vibrosow {
namespace {

/// What tests/web tries on the pages' functions too.
nlohmann::json cases() {
  return nlohmann::json::parse(std::ifstream(VIBROSOW_SOURCE_DIR "/tests/report/numbers.json"));
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

TEST(NumberText, ChoosesTheUnitOfATime) {
  for (const auto& one : cases()["times"]) EXPECT_EQ(time_text(one["seconds"]), one["text"].get<std::string>());
}

}  // namespace
}  // namespace vibrosow
