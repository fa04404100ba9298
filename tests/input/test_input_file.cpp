#include "input/input_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input/read_scene.hpp"
#include "scene/input_error.hpp"
#include "temporary_file.hpp"

namespace vibrosow {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(InputFile, ShippedNamesStandForTheirFiles) {
  EXPECT_EQ(input_file("wheat-tray", FileKind::seeder), data_directory() / "seeders" / "wheat-tray.toml");
  EXPECT_EQ(kind_of(input_file("wheat-demo", FileKind::study)), FileKind::study);
  EXPECT_EQ(kind_of(input_file("wheat-demo")), FileKind::study);
}

TEST(InputFile, OfASeederAndAStudyOfOneNameTheWantedOneIsTaken) {
  EXPECT_EQ(kind_of(input_file("paper-a-fig3", FileKind::seeder)), FileKind::seeder);
  EXPECT_EQ(kind_of(input_file("paper-a-fig3", FileKind::study)), FileKind::study);
  EXPECT_EQ(kind_of(input_file("paper-a-fig3")), FileKind::seeder);
}

TEST(InputFile, UnknownNameNamesTheNearest) {
  EXPECT_THAT(
      [] { input_file("wheat-trey"); },
      ThrowsMessage<InputError>(HasSubstr("wheat-trey: there is no such file, and no seeder or study of that name "
                                          "is shipped; did you mean \"wheat-tray\"?")));
  EXPECT_THAT([] { input_file("wheat-trey.toml", FileKind::seeder); },
              ThrowsMessage<InputError>("wheat-trey.toml: there is no such file"));
  EXPECT_THROW(input_file("", FileKind::seeder), InputError);
}

TEST(InputFile, TheOtherKindIsToldItsCommand) {
  const TemporaryFolder folder;
  const auto study = folder.write("study.toml", "base = \"a.toml\"\n"),
             seeder = folder.write("a.toml", "title = \"a\"\n");
  EXPECT_EQ(input_file(study.string(), FileKind::study), study);
  EXPECT_THAT([&] { input_file(study.string(), FileKind::seeder); },
              ThrowsMessage<InputError>(HasSubstr("study.toml: this is a study: use vibrosow sweep")));
  EXPECT_THAT([&] { input_file(seeder.string(), FileKind::study); },
              ThrowsMessage<InputError>(HasSubstr("a.toml: this is a seeder, not a study: use vibrosow run")));
}

}  // namespace
}  // namespace vibrosow
