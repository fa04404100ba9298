#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "files/atomic_file.hpp"

namespace vibrosow {

/// No case that is kept holds more bytes: a damaged or foreign file asks for no more memory.
constexpr std::uint64_t most_bytes_of_a_case = std::uint64_t{1} << 30;

/// Many cases in one file: a line "vibrosow segment 1 HASH", the number of cases, then for each its name, place and
/// size, then their bytes one after the other. The hash is of the numbers; each case has its own. The file's name is
/// the hash of its names. Written whole or not at all, never changed.
class Segments {
 public:
  explicit Segments(PathInFolder folder) : folder_(std::move(folder)) {}

  /// Looks for segments that have come since. Not for several threads at a time.
  void refresh();

  /// Of a case the first copy that is wanted, in the order of the segments' names; empty where there is none. One is
  /// read at a time, and of more than `most_copies`, as nobody writes them, no further ones.
  static constexpr int most_copies = 16;
  std::string find(const std::string& name, const std::function<bool(const std::string&)>& is_wanted) const;

  /// Names of all cases in them, in order.
  std::vector<std::string> names() const;

  /// Names of segments that are damaged: what they held is missing.
  const std::vector<std::string>& unreadable() const { return unreadable_; }

  /// Writes one segment of these cases, by name, down to the disk. Throws InputError where that fails.
  void write(const std::map<std::string, std::string>& cases) const;

 private:
  using Key = std::array<std::uint64_t, 2>;  // the name's 32 digits
  struct IndexEntry {
    Key key;
    std::uint64_t at, size;  // bytes of the segment
    std::uint32_t segment;   // index in files_
    auto operator<=>(const IndexEntry&) const = default;
  };

  void read(const std::filesystem::path& file);

  PathInFolder folder_;
  std::vector<std::filesystem::path> files_;  // sound and others
  std::set<std::string> known_;               // their names: a folder of many segments is looked through for each miss
  std::vector<IndexEntry> entries_;           // in order
  std::vector<std::string> unreadable_;
};

}  // namespace vibrosow
