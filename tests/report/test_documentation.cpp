#include "report/documentation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace vibrosow {
namespace {

TEST(Documentation, TheCommittedPageIsWhatTheProgramPrints) {
  std::ifstream page(VIBROSOW_SOURCE_DIR "/docs/reference/output.md", std::ios::binary);
  const std::string committed{std::istreambuf_iterator<char>(page), {}};
  EXPECT_EQ(committed, output_documentation()) << "vibrosow help columns > docs/reference/output.md";
}

TEST(Documentation, HasEveryFileAndEveryMetric) {
  const std::string text = output_documentation();
  for (const char* part :
       {"`outflow.csv`", "`summary.csv`", "`run.json`", "`grains_NNN.csv`", "`sweep.csv`", "`sweep_runs.csv`",
        "`comparison.csv`", "`accuracy.csv`", "| `balance.lost` |", "| `longest_pause_s` | s |"})
    EXPECT_THAT(text, testing::HasSubstr(part));
}

}  // namespace
}  // namespace vibrosow
