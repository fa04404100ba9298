#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace vibrosow {

/// Which histories contacts have.
struct HistoryKinds {
  bool slip = false, roll = false;
  bool is_3d = false;  // a record for each contact instead of a column for each number

  constexpr bool any() const { return slip || roll; }
  /// Numbers a record has: the slip and one that stays 0, the roll and the twist.
  constexpr std::size_t record_length() const { return is_3d ? (slip ? 4u : 0u) + (roll ? 4u : 0u) : 0; }
};

/// Histories of touching contacts, one entry a candidate of a list; all zero where nothing touches: the displacements
/// of the tangential spring (slip, m) and of the rolling one (roll, rad). In 2D a column for each, empty where
/// its effect is absent, with signs that do not depend on which of the two grains comes first; in 3D a record for
/// each candidate that touches, seen from the pair's first grain. Most candidates touch nothing, and a kernel that
/// stores the records of a block of them puts these side by side at the block's first places. No other block's lie
/// there, as blocks are the same until the list is made anew or shortened, which puts each record at its own
/// candidate's place.
struct ContactHistories {
  static constexpr int no_record = -1;

  std::vector<double> slip, roll;
  std::vector<double> records;         // HistoryKinds::record_length() numbers each, with room for one a candidate
  std::vector<int> place;              // of a candidate's record among these, or no_record: then all is zero
  std::vector<unsigned char> touched;  // 1 where there may be a history
  HistoryKinds kinds;                  // which of these are filled; set by `resize`

  bool has_history(std::size_t k) const {
    return (!slip.empty() && slip[k] != 0) || (!roll.empty() && roll[k] != 0) ||
           (!place.empty() && place[k] != no_record);
  }

  /// Those that are new have no history.
  void resize(std::size_t candidates, HistoryKinds of) {
    kinds = of;
    const bool columns = !of.is_3d;
    slip.resize(columns && of.slip ? candidates : 0), roll.resize(columns && of.roll ? candidates : 0);
    records.resize(candidates * of.record_length());
    place.resize(of.is_3d && of.any() ? candidates : 0, no_record);
    touched.resize(of.any() ? candidates : 0);
  }

  /// The record of entry `k`, which has one.
  double* record(std::size_t k) { return records.data() + static_cast<std::size_t>(place[k]) * kinds.record_length(); }
  const double* record(std::size_t k) const {
    return records.data() + static_cast<std::size_t>(place[k]) * kinds.record_length();
  }

  /// Every entry that has been touched has its record at its own place: of histories that were kept so.
  void place_by_entry() {
    place.assign(kinds.is_3d ? touched.size() : 0, no_record);
    for (std::size_t k = 0; k < place.size(); ++k)
      if (touched[k]) place[k] = static_cast<int>(k);
  }

  /// Entry `k` becomes entry `from_entry` of `from`, which has the same kinds, and counts as touched. `from` may be
  /// these histories where each record lies at its own entry's place, as those of walls do; of pairs the record at
  /// place `k` may be another entry's.
  void copy_entry(std::size_t k, const ContactHistories& from, std::size_t from_entry) {
    if (!slip.empty()) slip[k] = from.slip[from_entry];
    if (!roll.empty()) roll[k] = from.roll[from_entry];
    if (!place.empty()) {
      place[k] = from.place[from_entry] == no_record ? no_record : static_cast<int>(k);
      if (place[k] != no_record) std::copy_n(from.record(from_entry), kinds.record_length(), record(k));
    }
    if (!touched.empty()) touched[k] = 1;
  }

  /// Nothing touches at entry `k` any more.
  void forget(std::size_t k) {
    if (!slip.empty()) slip[k] = 0;
    if (!roll.empty()) roll[k] = 0;
    if (!place.empty()) place[k] = no_record;
  }

  /// Keeps these entries alone, ascending; the histories then match a list shortened the same way.
  void keep_entries(const std::vector<std::size_t>& kept) {
    const ContactHistories before = std::move(*this);
    *this = {};
    resize(kept.size(), before.kinds);
    for (std::size_t k = 0; k < kept.size(); ++k) copy_entry(k, before, kept[k]);
  }
};

/// What an evaluation of the forces is within its step. The displacement at which a force is wanted is the stored one
/// plus `trial` seconds of the speed. What is stored for the next step is `commit` seconds of it on; 0: an evaluation
/// that leaves no trace. With `commit` twice `trial` each speed counts for half a step before it and half a step after:
/// second order, where speeds are those of the moment of the force.
///
/// Velocities may be those of `lag` seconds before the places, in the middle of a step of 2 lag (velocity Verlet). Then
/// a dashpot takes them as its own contact's force, gravity and drag make them until the end, and in the step in which
/// a contact begins it counts as long as there is one (docs/explanation/theory.md). 0: velocities and places are of one
/// time.
struct ContactStep {
  double trial = 0, commit = 0;   // s
  double lag = 0;                 // s
  double fall_x = 0, fall_y = 0;  // m/s, that gravity adds in this time
  double brake = 0;               // kg, drag times this time: over its mass, the part of its speed that a grain loses
};

}  // namespace vibrosow
