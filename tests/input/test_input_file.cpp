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
  EXPECT_EQ(input_file("wheat-tray", FileKind::seeder).path, data_directory() / "seeders" / "wheat-tray.toml");
  EXPECT_EQ(input_file("wheat-demo", FileKind::study).kind, FileKind::study);
  EXPECT_EQ(input_file("wheat-demo").kind, FileKind::study);
}

TEST(InputFile, OfASeederAndAStudyOfOneNameTheWantedOneIsTaken) {
  EXPECT_EQ(input_file("paper-a-fig3", FileKind::seeder).kind, FileKind::seeder);
  EXPECT_EQ(input_file("paper-a-fig3", FileKind::study).kind, FileKind::study);
  EXPECT_EQ(input_file("paper-a-fig3").kind, FileKind::seeder);
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
  EXPECT_EQ(input_file(study.string(), FileKind::study).path, study);
  EXPECT_THAT([&] { input_file(study.string(), FileKind::seeder); },
              ThrowsMessage<InputError>(HasSubstr("study.toml: this is a study: use vibrosow sweep")));
  EXPECT_THAT([&] { input_file(seeder.string(), FileKind::study); },
              ThrowsMessage<InputError>(HasSubstr("a.toml: this is a seeder, not a study: use vibrosow run")));
}

TEST(InputFile, LookingIntoAFileIsItsOnlyReading) {
  const TemporaryFolder folder;
  const auto study = folder.write("study.toml", "base = \"a.toml\"\n");
  const InputFile file = input_file(study.string());
  EXPECT_EQ(kind_of(file.path, file.files), FileKind::study);
  EXPECT_EQ(file.files->reads(), 1);
}

}  // namespace
}  // namespace vibrosow
