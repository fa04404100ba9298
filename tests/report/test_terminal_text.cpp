#include "report/terminal_text.hpp"

#include <gtest/gtest.h>

namespace vibrosow {
namespace {

TEST(TerminalText, LinesAreCutAtSpacesBeforeColumn81) {
  const std::string word(39, 'a');
  EXPECT_EQ(wrapped(word + " " + word + "b"), word + " " + word + "b\n");  // 80 columns
  EXPECT_EQ(wrapped(word + " " + word + "bc"), word + "\n" + word + "bc\n");
  EXPECT_EQ(wrapped(word + " " + word + "b", 1), " " + word + "\n " + word + "b\n");
  EXPECT_EQ(wrapped(std::string(100, 'a') + " b"), std::string(100, 'a') + "\nb\n");  // a path stays whole
  EXPECT_EQ(wrapped(""), "\n");
}

TEST(TerminalText, TextStandsBesideItsLabel) {
  const std::string word(39, 'a');
  EXPECT_EQ(wrapped_beside("  yes ", "it rolls"), "  yes it rolls\n");
  EXPECT_EQ(wrapped_beside("  yes ", word + " " + word), "  yes " + word + "\n      " + word + "\n");
}

TEST(TerminalText, MetricsHaveNoExponentUpToAMillion) {
  EXPECT_EQ(to_digits(11106, 4), "11110");
  EXPECT_EQ(to_digits(123, 2), "120");
  EXPECT_EQ(to_digits(-123, 2), "-120");
  EXPECT_EQ(to_digits(12.384, 4), "12.38");
  EXPECT_EQ(to_digits(0.0123456, 2), "0.012");
  EXPECT_EQ(to_digits(0, 4), "0");
  EXPECT_EQ(to_digits(2.5e7, 4), "2.5e+07");
}

}  // namespace
}  // namespace vibrosow
