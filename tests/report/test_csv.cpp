#include "report/csv.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace vibrosow {
namespace {

TEST(CsvNumber, HasSixDigitsAndIsEmptyWhereUndefined) {
  EXPECT_EQ(csv_number(1.0 / 3).text, "0.333333");
  EXPECT_EQ(csv_number(16.000000000000004).text, "16");
  EXPECT_EQ(csv_number(1234567.0).text, "1.23457e+06");
  EXPECT_EQ(csv_number(-0.0).text, "0");
  EXPECT_EQ(csv_number(std::int64_t{1234567}).text, "1234567");
  EXPECT_EQ(csv_number(std::optional<double>{}).text, "");
  EXPECT_EQ(csv_number(std::optional<double>{2.5}).text, "2.5");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()).text, "");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()).text, "");
}

TEST(CsvTable, QuotesOnlyWhatNeedsIt) {
  CsvTable table({"hole", "note"});
  table.add_row({"1", ""});
  table.add_row({"2", "dry, then \"stuck\""});
  table.add_row({"3", "two\nlines"});
  table.add_row({"#4", "plain; text"});
  EXPECT_EQ(table.text(), "hole,note\n1,\n2,\"dry, then \"\"stuck\"\"\"\n3,\"two\nlines\"\n\"#4\",plain; text\n");
}

TEST(CsvTable, RefusesARowOfAnotherLength) {
  CsvTable table({"hole", "note"});
  EXPECT_THROW(table.add_row({"1"}), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
