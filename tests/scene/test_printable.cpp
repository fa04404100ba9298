#include "scene/printable.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include "scene/input_error.hpp"
#include "scene/trimmed.hpp"

namespace vibrosow {
namespace {

TEST(Printable, KeepsTextAndShowsTheRestAsBytes) {
  EXPECT_EQ(printable("Weizen, 4 \u00b5m, \u4e2d, \U0001F33E"), "Weizen, 4 \u00b5m, \u4e2d, \U0001F33E");
  EXPECT_EQ(printable("\x1b[31mred\n\t\x7f"), "\\x1b[31mred\\x0a\\x09\\x7f");
  EXPECT_EQ(printable("caf\xe9.toml"), "caf\\xe9.toml");
  EXPECT_EQ(printable("\u009b"), "\\xc2\\x9b");
  EXPECT_EQ(printable("\xc0\xaf\xed\xa0\x80\xf8\x90\x90\x90\x90"),
            "\\xc0\\xaf\\xed\\xa0\\x80\\xf8\\x90\\x90\\x90\\x90");
  EXPECT_EQ(printable("\xe4\xb8"), "\\xe4\\xb8");
}

TEST(ShellQuoted, IsOneWordOfAShell) {
  EXPECT_EQ(shell_quoted("tray.holes.width=3 mm"), "'tray.holes.width=3 mm'");
  EXPECT_EQ(shell_quoted("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(shell_quoted(""), "''");
}

TEST(Trimmed, LosesWhatIsBlankOnEitherSideAlone) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \n\t "), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Printable, IsAlwaysJsonAndChangesNothingTwice) {
  EXPECT_TRUE(rc::check("any bytes", [](const std::string& bytes) {
    const std::string text = printable(bytes);
    RC_ASSERT(nlohmann::json::parse(nlohmann::json(text).dump()) == text);
    RC_ASSERT(printable(text) == text);
  }));
}

TEST(Printable, InputErrorsAre) {
  EXPECT_STREQ(InputError("a\x1b[2J.toml: b").what(), "a\\x1b[2J.toml: b");
}

}  // namespace
}  // namespace vibrosow
