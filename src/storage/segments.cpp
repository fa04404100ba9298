#include "storage/segments.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>

#include "files/atomic_file.hpp"

namespace vibrosow {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view segment_signature = "vibrosow segment 1 ";
constexpr std::size_t segment_hash_digits = 16, segment_head_size = segment_signature.size() + segment_hash_digits + 1,
                      bytes_of_place = 32;
constexpr std::uint64_t most_cases = std::uint64_t{1} << 20;  // of a segment, which has some thousand

std::uint64_t number_of(std::string_view digits) {
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return number;
}

void add_number(std::string& bytes, std::uint64_t number) {
  for (int k = 0; k < 8; ++k) bytes += static_cast<char>(number >> (8 * k) & 0xff);  // the same on every machine
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t k = 8; k-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + k]);
  return number;
}

std::string head_of(const std::string& numbers) {
  return fmt::format("{}{:0{}x}\n", segment_signature, XXH3_64bits(numbers.data(), numbers.size()),
                     segment_hash_digits);
}

/// The numbers of a segment, the count of its cases before; none where it is damaged.
std::optional<std::string> numbers_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;  // to open a pipe is to wait for who writes it
  const std::uint64_t size = fs::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  std::string head(segment_head_size, '\0'), numbers(8, '\0');
  if (error || !in.read(head.data(), segment_head_size) || !in.read(numbers.data(), 8)) return std::nullopt;
  const std::uint64_t count = number_at(numbers, 0);
  if (count > std::min(size / bytes_of_place, most_cases)) return std::nullopt;
  numbers.resize(8 + count * bytes_of_place);
  if (!in.read(numbers.data() + 8, static_cast<std::streamsize>(numbers.size() - 8))) return std::nullopt;
  if (head != head_of(numbers)) return std::nullopt;
  return numbers;
}

}  // namespace

void Segments::read(const fs::path& file) {
  const auto segment = static_cast<std::uint32_t>(files_.size());
  files_.push_back(file);
  const std::optional<std::string> numbers = numbers_of(file);
  if (!numbers) return unreadable_.push_back(file.filename().string());
  for (std::size_t at = 8; at < numbers->size(); at += bytes_of_place)
    entries_.push_back({{number_at(*numbers, at), number_at(*numbers, at + 8)},
                        number_at(*numbers, at + 16),
                        number_at(*numbers, at + 24),
                        segment});
}

void Segments::refresh() {
  std::vector<fs::path> fresh;
  for (const fs::path& file : entries_of(folder_.path()))
    if (file.extension() == ".segment" && known_.insert(file.filename().string()).second) fresh.push_back(file);
  if (fresh.empty()) return;
  std::ranges::sort(fresh);
  for (const fs::path& file : fresh) read(file);
  std::ranges::sort(entries_);
  entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
}

std::string Segments::find(const std::string& name, const std::function<bool(const std::string&)>& is_wanted) const {
  if (name.size() != 32) return "";
  const Key key = {number_of(name.substr(0, 16)), number_of(name.substr(16))};
  auto it = std::ranges::lower_bound(entries_, key, {}, &IndexEntry::key);
  for (int copy = 0; copy < most_copies && it != entries_.end() && it->key == key; ++copy, ++it) {
    const IndexEntry& entry = *it;
    if (std::error_code none; !fs::is_regular_file(files_[entry.segment], none)) continue;
    std::ifstream in(files_[entry.segment], std::ios::binary);
    std::error_code error;
    const std::uint64_t file_size = fs::file_size(files_[entry.segment], error);
    if (error || entry.size > std::min(file_size, most_bytes_of_a_case) || entry.at > file_size - entry.size) continue;
    std::string bytes(entry.size, '\0');
    in.seekg(static_cast<std::streamoff>(entry.at));
    if (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) && is_wanted(bytes)) return bytes;
  }
  return "";
}

std::vector<std::string> Segments::names() const {
  std::vector<std::string> names;
  const Key* last = nullptr;
  for (const IndexEntry& entry : entries_) {
    if (!last || *last != entry.key) names.push_back(fmt::format("{:016x}{:016x}", entry.key[0], entry.key[1]));
    last = &entry.key;
  }
  return names;
}

void Segments::write(const std::map<std::string, std::string>& cases) const {
  std::string numbers, content, all_names;
  add_number(numbers, cases.size());
  std::uint64_t at = segment_head_size + 8 + cases.size() * bytes_of_place;
  for (const auto& [name, bytes] : cases) {
    for (const std::uint64_t number :
         {number_of(name.substr(0, 16)), number_of(name.substr(16)), at, std::uint64_t{bytes.size()}})
      add_number(numbers, number);
    at += bytes.size();
    content += bytes;
    all_names += name;
  }
  const XXH128_hash_t hash = XXH3_128bits(all_names.data(), all_names.size());
  const PathInFolder file = folder_ / fmt::format("{:016x}{:016x}.segment", hash.high64, hash.low64);
  make_directories(folder_, file.path());
  write_file_atomically(file, head_of(numbers) + numbers + content);
}

}  // namespace vibrosow
