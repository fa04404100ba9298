#include "report/page.hpp"

#include <gmock/gmock.h>

#include <numeric>
#include <stdexcept>

namespace vibrosow {
namespace {

const std::string page_template =
    "<script id=\"report-data\" type=\"application/json\">@REPORT_DATA@</script>"
    "<script id=\"recording\" type=\"text/plain\">@RECORDING@</script>";

TEST(Page, GivesBackTheRecordingThatItWasFilledWith) {
  for (const std::size_t length : {0U, 1U, 2U, 3U, 256U}) {
    std::string bytes(length, '\0');
    std::iota(bytes.begin(), bytes.end(), char(0));
    EXPECT_EQ(recording_in(filled_page(page_template, "{}", bytes)), bytes) << length << " bytes";
  }
}

TEST(Page, HasNoRecordingWhereNoneIsReadable) {
  EXPECT_EQ(recording_in(""), "");
  EXPECT_EQ(recording_in("<script id=\"recording\" type=\"text/plain\">not base64</script>"), "");
  EXPECT_EQ(recording_in("<script id=\"recording\" type=\"text/plain\">AAA</script>"), "");
}

TEST(Page, ATextEndsNoScript) {
  const std::string text = page_text({{"title", "</script><img onerror=x>"}});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text)["title"], "</script><img onerror=x>");
}

TEST(Page, ItsDataAreKeptWithAndWithoutIt) {
  const std::vector<OutputFile> both = page_files(page_template, "{}"), data = page_files("", "{}");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].name, "report.json");
  EXPECT_EQ(both[0].content, "{}\n");
  EXPECT_EQ(both[1].name, "report.html");
  EXPECT_EQ(both[1].content, filled_page(page_template, "{}"));
  ASSERT_EQ(data.size(), 1U);
  EXPECT_EQ(data[0].content, both[0].content);
}

TEST(Page, ATemplateWithoutPlacesIsRefused) {
  EXPECT_THROW(filled_page("<html>", "{}"), std::invalid_argument);
}

}  // namespace
}  // namespace vibrosow
