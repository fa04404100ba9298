#include <gtest/gtest.h>

#include "picture/escaped_text.hpp"

namespace vibrosow {
namespace {

TEST(EscapedText, IsNoMarkup) {
  EXPECT_EQ(escaped_text("<img alt=\"a & b\">"), "&lt;img alt=&quot;a &amp; b&quot;&gt;");
  EXPECT_EQ(escaped_text("Körner, 4.5 g"), "Körner, 4.5 g");
}

TEST(EscapedText, HasASignForCharactersThatADocumentMustNotHold) {
  EXPECT_EQ(escaped_text("a\x01"
                         "b\x7f"),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
}

}  // namespace
}  // namespace vibrosow
