#pragma once

#include <cstddef>
#include <vector>

namespace vibrosow {

/// History of one contact; signs do not depend on which of the two grains comes first.
struct ContactHistory {
  double slip = 0, slip_speed = 0;  // m, m/s: displacement of the tangential spring, last sliding speed
  double roll = 0, roll_speed = 0;  // rad, rad/s: the same of the rolling spring
};

/// Which histories contacts have.
struct HistoryKinds {
  bool slip = false, roll = false;

  bool any() const { return slip || roll; }
};

/// Histories of touching contacts, one entry a candidate of a list; all zero where nothing touches. Arrays of an
/// absent effect are empty.
struct ContactHistories {
  std::vector<double> slip, slip_speed, roll, roll_speed;
  std::vector<unsigned char> touched;  // 1 where there may be a history

  bool has_history(std::size_t k) const {
    return (!slip.empty() && (slip[k] != 0 || slip_speed[k] != 0)) ||
           (!roll.empty() && (roll[k] != 0 || roll_speed[k] != 0));
  }

  void clear() { slip.clear(), slip_speed.clear(), roll.clear(), roll_speed.clear(), touched.clear(); }

  void resize(std::size_t candidates, HistoryKinds kinds) {
    slip.resize(kinds.slip ? candidates : 0), slip_speed.resize(slip.size());
    roll.resize(kinds.roll ? candidates : 0), roll_speed.resize(roll.size());
    touched.resize(kinds.any() ? candidates : 0);
  }
  HistoryKinds kinds() const { return {!slip.empty(), !roll.empty()}; }

  /// Entry `k` becomes entry `from_entry` of `from`, which has the same kinds, and counts as touched.
  void copy_entry(std::size_t k, const ContactHistories& from, std::size_t from_entry) {
    if (!slip.empty()) slip[k] = from.slip[from_entry], slip_speed[k] = from.slip_speed[from_entry];
    if (!roll.empty()) roll[k] = from.roll[from_entry], roll_speed[k] = from.roll_speed[from_entry];
    if (!touched.empty()) touched[k] = 1;
  }

  /// Keeps these entries alone, ascending; the histories then match a list shortened the same way.
  void keep_entries(const std::vector<std::size_t>& kept) {
    const HistoryKinds before = kinds();
    for (std::size_t k = 0; k < kept.size(); ++k) copy_entry(k, *this, kept[k]);
    resize(kept.size(), before);
  }
};

/// How a history moves on in one evaluation of the forces. The displacement at which a force is wanted is the stored
/// one plus `trial` seconds of the speed, which is taken between the stored (0) and the present one (1) at `present`.
/// What is stored for the next step is `commit` seconds on; 0: an evaluation that leaves no trace.
struct HistoryAdvance {
  double trial = 0, commit = 0;  // s
  double present = 1;
};

}  // namespace vibrosow
