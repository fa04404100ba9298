#include "storage/segments.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>

#include "support/temporary_folder.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

class SegmentFolder : public testing::Test {
 protected:
  static std::string name(int k) { return std::string(31, 'a') + static_cast<char>('0' + k); }
  fs::path only_file() const { return fs::directory_iterator(folder_.path())->path(); }
  std::string bytes_of_file() const {
    std::ifstream file(only_file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  Segments fresh() const {
    Segments segments(folder_.path());
    segments.refresh();
    return segments;
  }

  TemporaryFolder folder_;
  const std::map<std::string, std::string> cases_ = {
      {name(1), "first"}, {name(2), ""}, {name(3), std::string("a\0b", 3)}};
};

TEST_F(SegmentFolder, GivesBackWhatWasWritten) {
  Segments(folder_.path()).write(cases_);
  const Segments segments = fresh();
  EXPECT_EQ(segments.names().size(), 3u);
  for (const auto& [name, bytes] : cases_) EXPECT_EQ(segments.bytes_of(name), std::vector<std::string>{bytes});
  EXPECT_TRUE(segments.bytes_of(name(4)).empty());
  EXPECT_TRUE(segments.bytes_of("no name").empty());
}

TEST_F(SegmentFolder, APipeIsNotWaitedFor) {
  ASSERT_EQ(mkfifo((folder_.path() / "a.segment").c_str(), 0600), 0);
  EXPECT_TRUE(fresh().names().empty());
}

TEST_F(SegmentFolder, SeesSegmentsThatCameSince) {
  Segments segments = fresh();
  Segments(folder_.path()).write(cases_);
  EXPECT_TRUE(segments.names().empty());
  segments.refresh();
  segments.refresh();
  EXPECT_EQ(segments.names().size(), 3u);
}

TEST_F(SegmentFolder, ADamagedTableGivesNothingAndNeverFails) {
  Segments(folder_.path()).write(cases_);
  const std::string bytes = bytes_of_file();
  const std::size_t table_end = bytes.size() - 8;  // what follows are the cases themselves, with hashes of their own
  for (std::size_t at = 0; at < table_end; ++at) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << at % 8));
    std::ofstream(only_file(), std::ios::binary) << flipped;
    EXPECT_TRUE(fresh().names().empty()) << at;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    std::ofstream(only_file(), std::ios::binary) << bytes.substr(0, size);
    const Segments cut = fresh();
    EXPECT_EQ(cut.names().empty(), size < table_end) << size;
    EXPECT_TRUE(cut.bytes_of(name(3)).empty()) << size;
  }
}

}  // namespace
}  // namespace vibrosow
