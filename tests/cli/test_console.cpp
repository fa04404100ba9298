#include "cli/console.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>

#include "cli/commands.hpp"
#include "scene/input_error.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;

struct Ended {
  int code;
  std::string said;  // on standard error
};

template <class Thrown>
Ended ended_by(const Thrown& thrown) {
  testing::internal::CaptureStderr();
  const int code = exit_code_of([&]() -> int { throw thrown; });
  return {code, testing::internal::GetCapturedStderr()};
}

TEST(ExitCode, IsWhatTheProgramReturns) {
  EXPECT_EQ(exit_code_of([] { return static_cast<int>(exit_stopped_by_guard); }), exit_stopped_by_guard);
}

TEST(ExitCode, OfWrongInputAndOfWhatTheSystemRefusesIsTwo) {
  const Ended input = ended_by(InputError("a.toml:3: tray.length: 0 m"));
  EXPECT_EQ(input.code, exit_wrong_input);
  EXPECT_EQ(input.said, "vibrosow: a.toml:3: tray.length: 0 m\n");
  const Ended system = ended_by(std::system_error(std::make_error_code(std::errc::permission_denied), "out"));
  EXPECT_EQ(system.code, exit_wrong_input);
  EXPECT_EQ(system.said, "vibrosow: out: Permission denied\n");
}

TEST(ExitCode, OfAnythingElseThatIsThrownIsADefectsOwn) {
  const Ended known = ended_by(std::logic_error("no such contact"));
  EXPECT_EQ(known.code, exit_defect);
  EXPECT_EQ(known.said, "vibrosow: a defect of the program, please report it with your file: no such contact\n");
  const Ended unknown = ended_by(7);
  EXPECT_EQ(unknown.code, exit_defect);
  EXPECT_EQ(unknown.said, "vibrosow: a defect of the program, please report it with your file\n");
}

TEST(ExitCode, OfADefectThatSaysMuchIsOneLineAllTheSame) {
  const Ended ended = ended_by(std::logic_error("one\ntwo\x1b[2J"));
  EXPECT_EQ(ended.code, exit_defect);
  EXPECT_EQ(std::count(ended.said.begin(), ended.said.end(), '\n'), 1) << ended.said;
  EXPECT_THAT(ended.said, testing::Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace vibrosow
