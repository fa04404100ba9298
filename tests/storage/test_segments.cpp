#include "storage/segments.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <fstream>
#include <iterator>

#include "support/temporary_folder.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;

class SegmentFolder : public testing::Test {
 protected:
  static bool any(const std::string&) { return true; }
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
  for (const auto& [name, bytes] : cases_) EXPECT_EQ(segments.find(name, any), bytes);
  EXPECT_TRUE(segments.find(name(4), any).empty());
  EXPECT_TRUE(segments.find("no name", any).empty());
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
    EXPECT_TRUE(cut.find(name(3), any).empty()) << size;
  }
}

/// A segment whose table has these numbers, behind a right hash, and so many bytes in all.
void write_table(const fs::path& file, const std::vector<std::uint64_t>& numbers, std::uint64_t size) {
  std::string table;
  for (const std::uint64_t number : numbers)
    for (int k = 0; k < 8; ++k) table += static_cast<char>(number >> (8 * k) & 0xff);
  std::ofstream(file, std::ios::binary) << fmt::format("vibrosow segment 1 {:016x}\n",
                                                       XXH3_64bits(table.data(), table.size()))
                                        << table;
  fs::resize_file(file, size);
}

TEST_F(SegmentFolder, OfManyCopiesOneIsReadAtATimeAndNotAll) {
  constexpr std::uint64_t copies = 1000, key = 0x1111111111111111;
  std::vector<std::uint64_t> numbers = {copies};
  for (std::uint64_t k = 0; k < copies; ++k) numbers.insert(numbers.end(), {key, key, k, 64});
  write_table(folder_.path() / "a.segment", numbers, 1 << 16);
  const Segments segments = fresh();
  EXPECT_EQ(segments.names(), std::vector<std::string>{std::string(32, '1')});
  int looked_at = 0;
  EXPECT_EQ(segments.find(std::string(32, '1'), [&](const std::string&) { return ++looked_at < 0; }), "");
  EXPECT_EQ(looked_at, Segments::most_copies);
}

TEST_F(SegmentFolder, AHugeSparseFileTakesNoMemory) {
  constexpr std::uint64_t key = 0x1111111111111111, huge = std::uint64_t{1} << 40;
  write_table(folder_.path() / "a.segment", {1, key, key, 100, huge - 100}, huge);
  const Segments one = fresh();
  EXPECT_EQ(one.names().size(), 1u);
  EXPECT_EQ(one.find(std::string(32, '1'), any), "");
  EXPECT_TRUE(one.unreadable().empty());
  write_table(folder_.path() / "a.segment", {huge / 64}, huge);
  EXPECT_EQ(fresh().unreadable(), std::vector<std::string>{"a.segment"});
}

}  // namespace
}  // namespace vibrosow
