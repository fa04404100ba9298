#include "storage/study_plan.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <fstream>

#include "support/temporary_folder.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string a_run(32, 'a');

StudyPlan small_plan() {
  return {"study.toml", {"run.duration=1 s"}, 7, {{"study.toml", "base = 1"}}, {{a_run, 1, 7, 1e6}}};
}

/// A plan as somebody else might write it, by its right name.
std::string message_of_reading(const fs::path& folder, const std::string& text) {
  const std::string name = fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
  std::ofstream(plan_file(folder, name + ".json").path()) << text;
  try {
    read_plan(folder, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string plan_with(const std::string& run) {
  return R"({"study":"s","set":[],"random_seed":1,"files":{},"runs":[{)" + run + "}]}";
}

TEST(StudyPlanFile, IsReadAsItWasFrozen) {
  const TemporaryFolder folder;
  const std::string name = freeze_plan(folder.path(), small_plan());
  EXPECT_EQ(current_plan(folder.path()), name);
  const StudyPlan plan = read_plan(folder.path());
  EXPECT_EQ(plan.files, small_plan().files);
  ASSERT_EQ(plan.runs.size(), 1u);
  EXPECT_EQ(plan.runs[0].name, a_run);
}

TEST(StudyPlanFile, KeepsWhatIsAsked) {
  const TemporaryFolder folder;
  StudyPlan asking = small_plan();
  asking.question = DecideQuestion{"rate", std::nullopt, 0.05, 0.02, 0.95, SelectionRule::guaranteed, 400, false};
  const std::string name = freeze_plan(folder.path(), asking);
  EXPECT_EQ(read_plan(folder.path()).question, asking.question);
  std::get<DecideQuestion>(asking.question).margin = 0.03;
  EXPECT_NE(freeze_plan(folder.path(), asking), name) << "another question is another plan";
  freeze_plan(folder.path(), small_plan());
  EXPECT_EQ(read_plan(folder.path()).question, AskedQuestion());
}

TEST(StudyPlanFile, OneThatAsksInWordsIsOfAnotherVersion) {
  const TemporaryFolder folder;
  freeze_plan(folder.path(), small_plan());
  EXPECT_THAT(message_of_reading(folder.path(), R"({"study":"s","set":[],"random_seed":1,"files":{},"runs":[],)"
                                                R"("asked":["decide","--goal=rate"]})"),
              HasSubstr("its plan was made by another version of the program"));
  EXPECT_THAT(message_of_reading(folder.path(), R"({"study":"s","set":[],"random_seed":1,"files":{},"runs":[],)"
                                                R"("question":{"command":"decide","goal":"rate"}})"),
              HasSubstr("is damaged"));
}

TEST(StudyPlanFile, ATruncatedOneIsMadeAgain) {
  const TemporaryFolder folder;
  const std::string name = freeze_plan(folder.path(), small_plan());
  const fs::path file = plan_file(folder.path(), name + ".json").path();
  fs::resize_file(file, 10);
  EXPECT_THROW(read_plan(folder.path()), InputError);
  freeze_plan(folder.path(), small_plan());
  EXPECT_EQ(read_plan(folder.path()).study, "study.toml");
}

TEST(StudyPlanFile, BehindARightHashNothingIsBelieved) {
  const TemporaryFolder folder;
  freeze_plan(folder.path(), small_plan());
  const auto run = [](const std::string& layout, const std::string& seed, const std::string& cost,
                      const std::string& name) {
    return plan_with(
        fmt::format(R"("layout":{},"random_seed":{},"grain_steps":{},"cases":"{}")", layout, seed, cost, name));
  };
  EXPECT_EQ(message_of_reading(folder.path(), run("1", "1", "1e6", a_run)), "no error");
  for (const std::string& bad : {run("1", "1", "-1e308", a_run), run("1", "1", "1e308", a_run),
                                 run("-1", "1", "1", a_run), run("1e99", "1", "1", a_run), run("1", "-1", "1", a_run),
                                 run("1", "1", "1", "../../victim"), run("1", "1", "1", std::string(31, 'a')),
                                 std::string(100'000, '['), std::string(R"({"study":)"), std::string(R"({"study":3})")})
    EXPECT_THAT(message_of_reading(folder.path(), bad), HasSubstr("is damaged")) << bad.substr(0, 200);
}

TEST(StudyPlanFile, ItsNameLeadsNowhere) {
  const TemporaryFolder folder;
  freeze_plan(folder.path(), small_plan());
  EXPECT_THROW(read_plan(folder.path(), "../../../victim"), InputError);
  for (const char* pointer : {"../../victim\n", "0123456789abcdef\nexec evil\n", "0123456789ABCDEF\n"}) {
    std::ofstream(folder.path() / "cases" / "plan") << pointer;
    EXPECT_THROW(current_plan(folder.path()), InputError) << pointer;
  }
}

}  // namespace
}  // namespace vibrosow
