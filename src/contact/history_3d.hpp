#pragma once

#include "compute/four.hpp"
#include "contact/data_3d.hpp"
#include "contact/force_3d.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Where the parts of a record of ContactHistories lie: rows of four, the slip, then roll and twist.
template <bool has_slip, bool has_roll>
struct ContactRecord {
  static constexpr bool slips = has_slip, rolls = has_roll;
  static constexpr std::size_t slip = 0, roll = slips ? 4 : 0, twist = roll + 3;
  static constexpr std::size_t length = HistoryKinds{slips, rolls, true}.record_length();
};
template <class Effects>
using RecordOf = ContactRecord<Effects::spring, Effects::rolling == Rolling::spring>;

/// A record's numbers, each at `at(n)`.
template <class Record, class At>
inline History3d history_from(At at) {
  History3d history;
  [[maybe_unused]] const auto vector = [&at](std::size_t n) { return Vector3{at(n), at(n + 1), at(n + 2)}; };
  if constexpr (Record::slips) history.slip = vector(Record::slip);
  if constexpr (Record::rolls) history.roll = vector(Record::roll), history.twist = at(Record::twist);
  return history;
}

/// Records by entries of a list, zeros where an entry has none.
template <class Record>
class RecordsRead {
 public:
  explicit RecordsRead(const ContactHistories& histories)
      : records_(histories.records.data()), place_(histories.place.data()) {}
  const double* operator[](int entry) const {
    const int place = place_[entry];
    return place == ContactHistories::no_record ? zeros_ : records_ + static_cast<std::size_t>(place) * Record::length;
  }

 private:
  static constexpr double zeros_[HistoryKinds{true, true, true}.record_length()] = {};
  const double* records_;
  const int* place_;
};

template <class Effects>
inline History3d load_record(const ContactHistories& histories, std::size_t entry) {
  if constexpr (!keeps_history<Effects>) return {};
  const double* record = RecordsRead<RecordOf<Effects>>(histories)[static_cast<int>(entry)];
  return history_from<RecordOf<Effects>>([record](std::size_t n) { return record[n]; });
}

/// Records of the contacts of a block, number by number.
struct BlockHistories3d {
  static constexpr std::size_t longest = HistoryKinds{true, true, true}.record_length();
  alignas(64) double numbers[longest][pair_block_room];

  template <class Effects>
  History3d get(std::size_t k) const {
    return history_from<RecordOf<Effects>>([this, k](std::size_t n) { return numbers[n][k]; });
  }
  template <class Effects>
  void set(std::size_t k, const History3d& history) {
    using Record = RecordOf<Effects>;
    if constexpr (!keeps_history<Effects>) return;
    const auto put = [this, k](std::size_t at, const Vector3& a) {
      numbers[at][k] = a.x, numbers[at + 1][k] = a.y, numbers[at + 2][k] = a.z;
    };
    if constexpr (Record::slips) put(Record::slip, history.slip);
    if constexpr (Record::rolls) put(Record::roll, history.roll), numbers[Record::twist][k] = history.twist;
  }
};

/// Asks for `count` records from the place `first` on ahead of their use, where a block's lie.
template <class Record>
void await_records(const ContactHistories& histories, int first, int count) {
  constexpr std::size_t cache_line = 8;
  const double* records = histories.records.data() + static_cast<std::size_t>(first) * Record::length;
  const std::size_t numbers = static_cast<std::size_t>(count) * Record::length;
  for (std::size_t n = 0; n < numbers; n += cache_line) __builtin_prefetch(records + n);
}

/// Fetches the records of the first `count` contacts of a block, from their entries of the list after `first`: number
/// by number, where vector instructions find them.
template <class Record>
[[gnu::noinline]] void load_block(const ContactHistories& histories, const int* entry, int first, int count,
                                  BlockHistories3d& of_block) {
  const RecordsRead<Record> records(histories);
  const auto record = [=](int k) { return records[first + entry[k]]; };
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    const double* const of[4]{record(k), record(k + 1), record(k + 2), record(k + 3)};
    for (std::size_t n = 0; n < Record::length; n += 4) {
      Four four[4];
      for (int c = 0; c < 4; ++c) load(four[c], of[c] + n);
      transpose(four);
      for (std::size_t m = 0; m < 4; ++m) *reinterpret_cast<Four*>(&of_block.numbers[n + m][k]) = four[m];
    }
  }
  for (; k < count; ++k)
    for (std::size_t n = 0; n < Record::length; ++n) of_block.numbers[n][k] = record(k)[n];
}

/// Places of records, for the contacts of a block: one after another, or each at its own entry.
struct PlacesFrom {
  int first;
  int operator()(int k) const { return first + k; }
};
struct PlacesOfEntries {
  const int* entry;
  int operator()(int k) const { return entry[k]; }
};

/// Stores the records of the first `count` contacts of a block, whose entries of the list are those after `first`.
template <class Record, class Places>
[[gnu::noinline]] void store_block(const BlockHistories3d& of_block, const int* entry, int first, int count,
                                   const Places place, ContactHistories& histories) {
  double* records = histories.records.data();
  const auto record = [=](int k) { return records + static_cast<std::size_t>(place(k)) * Record::length; };
  int* place_of_entry = histories.place.data() + first;
  for (int c = 0; c < count; ++c) place_of_entry[entry[c]] = place(c);
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    double* const of[4]{record(k), record(k + 1), record(k + 2), record(k + 3)};
    for (std::size_t n = 0; n < Record::length; n += 4) {
      Four four[4];
      for (std::size_t m = 0; m < 4; ++m) four[m] = *reinterpret_cast<const Four*>(&of_block.numbers[n + m][k]);
      transpose(four);
      for (int c = 0; c < 4; ++c) store(four[c], of[c] + n);
    }
  }
  for (; k < count; ++k)
    for (std::size_t n = 0; n < Record::length; ++n) record(k)[n] = of_block.numbers[n][k];
}

}  // namespace vibrosow::inline VIBROSOW_ISA
