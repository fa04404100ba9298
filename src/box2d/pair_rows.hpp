#pragma once

#include <cstddef>
#include <vector>

#include "contact/contact_list.hpp"

namespace vibrosow {

/// What a search finds, grain by grain: for each grain j the grains near it, found by one of several ranges at once.
class PairRows {
 public:
  void begin(std::size_t grains, int ranges);

  /// Begins the range's work.
  void begin_range(int range) { used_[static_cast<std::size_t>(range)] = 0; }
  /// Room for `most` numbers; `found` then says of which grain the first `count` of them are near. One after the other.
  int* room(int range, std::size_t most);
  void found(int range, int grain, int count);

  /// All pairs (i, j) of a grain j and one i near it, sorted: grains j taken in order, the finders of each i come in
  /// order, without a sort.
  void transpose(PairList& pairs);

 private:
  /// Where the grains near one grain stand: `count` places of a range's `near_`.
  struct Row {
    std::size_t begin;
    int range, count;
  };
  template <class Use>
  void for_each_near(const Row& row, Use use) const;

  std::vector<std::vector<int>> near_;  // by range, longer than what is used of it
  std::vector<std::size_t> used_;       // by range, of its `near_`
  std::vector<Row> rows_;               // by grain
  std::vector<int> row_end_;            // by grain
};

}  // namespace vibrosow
