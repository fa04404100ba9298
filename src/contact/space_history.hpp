#pragma once

#include "contact/pair_block.hpp"
#include "contact/space_force.hpp"

namespace vibrosow::inline VIBROSOW_ISA {

/// Where the parts of a record of ContactHistories lie: the normal, then the slip and its speed, then roll, twist and
/// theirs.
template <class Effects>
struct RecordOf {
  static constexpr bool slips = Effects::spring, rolls = Effects::rolling == Rolling::spring;
  static constexpr HistoryKinds kinds{slips, rolls, true};
  static constexpr std::size_t slip = 3, slip_speed = 6;
  static constexpr std::size_t roll = slips ? 9 : 3, roll_speed = roll + 3, twist = roll + 6, twist_speed = roll + 7;
  static constexpr std::size_t length = kinds.record_length();
};

/// A record's numbers, each at `at(n)`.
template <class Effects, class At>
inline SpaceHistory history_from(At at) {
  using Record = RecordOf<Effects>;
  SpaceHistory history;
  if constexpr (keeps_history<Effects>) {
    const auto vector = [&at](std::size_t n) { return Vector3{at(n), at(n + 1), at(n + 2)}; };
    history.normal = vector(0);
    if constexpr (Record::slips) history.slip = vector(Record::slip), history.slip_speed = vector(Record::slip_speed);
    if constexpr (Record::rolls) {
      history.roll = vector(Record::roll), history.roll_speed = vector(Record::roll_speed);
      history.twist = at(Record::twist), history.twist_speed = at(Record::twist_speed);
    }
  }
  return history;
}

template <class Effects>
inline SpaceHistory load_history(const double* records, std::size_t entry) {
  const double* record = records + entry * RecordOf<Effects>::length;
  return history_from<Effects>([record](std::size_t n) { return record[n]; });
}

template <class Effects>
inline void clear_record(ContactHistories& histories, std::size_t entry) {
  double* record = histories.records.data() + entry * RecordOf<Effects>::length;
  for (std::size_t n = 0; n < RecordOf<Effects>::length; ++n) record[n] = 0;
}

/// Records of the contacts of a block, number by number.
struct SpaceBlockHistories {
  static constexpr std::size_t longest = HistoryKinds{true, true, true}.record_length();
  double numbers[longest][pair_block_size];

  template <class Effects>
  SpaceHistory get(std::size_t k) const {
    return history_from<Effects>([this, k](std::size_t n) { return numbers[n][k]; });
  }
  template <class Effects>
  void set(std::size_t k, const SpaceHistory& history) {
    using Record = RecordOf<Effects>;
    if constexpr (!keeps_history<Effects>) return;
    const auto put = [this, k](std::size_t at, const Vector3& a) {
      numbers[at][k] = a.x, numbers[at + 1][k] = a.y, numbers[at + 2][k] = a.z;
    };
    put(0, history.normal);
    if constexpr (Record::slips) put(Record::slip, history.slip), put(Record::slip_speed, history.slip_speed);
    if constexpr (Record::rolls) {
      put(Record::roll, history.roll), put(Record::roll_speed, history.roll_speed);
      numbers[Record::twist][k] = history.twist, numbers[Record::twist_speed][k] = history.twist_speed;
    }
  }
};

/// Fetches the records of the first `count` contacts of a block, from their entries of the list after `first`: side by
/// side, where vector instructions find them.
template <class Effects>
void load_block(const ContactHistories& histories, const int* entry, int first, int count,
                SpaceBlockHistories& of_block) {
  if constexpr (!keeps_history<Effects>) return;
  constexpr std::size_t length = RecordOf<Effects>::length;
  const double* records = histories.records.data();
  for (int k = 0; k < count; ++k) {
    const double* record = records + static_cast<std::size_t>(first + entry[k]) * length;
    for (std::size_t n = 0; n < length; ++n) of_block.numbers[n][k] = record[n];
  }
}

/// Stores the records of the first `count` contacts of a block, at their entries of the list after `first`.
template <class Effects>
void store_block(const SpaceBlockHistories& of_block, const int* entry, int first, int count,
                 ContactHistories& histories) {
  constexpr std::size_t length = RecordOf<Effects>::length;
  double* records = histories.records.data();
  for (int k = 0; k < count; ++k) {
    double* record = records + static_cast<std::size_t>(first + entry[k]) * length;
    for (std::size_t n = 0; n < length; ++n) record[n] = of_block.numbers[n][k];
  }
}

}  // namespace vibrosow::inline VIBROSOW_ISA
