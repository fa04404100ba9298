#include "box2d/pair_rows.hpp"

#include <algorithm>
#include <numeric>

namespace vibrosow {

void PairRows::begin(std::size_t grains, int ranges) {
  near_.resize(static_cast<std::size_t>(ranges)), used_.resize(near_.size());
  rows_.resize(grains);
}

int* PairRows::room(int range, std::size_t most) {
  std::vector<int>& near = near_[static_cast<std::size_t>(range)];
  const std::size_t used = used_[static_cast<std::size_t>(range)], needed = used + most;
  if (near.size() < needed) near.resize(std::max(needed, 2 * near.size()));  // seldom: it fills what it adds
  return near.data() + used;
}

void PairRows::found(int range, int grain, int count) {
  std::size_t& used = used_[static_cast<std::size_t>(range)];
  rows_[static_cast<std::size_t>(grain)] = {used, range, count};
  used += static_cast<std::size_t>(count);
}

template <class Use>
void PairRows::for_each_near(const Row& row, Use use) const {
  const int* near = near_[static_cast<std::size_t>(row.range)].data() + row.begin;
  for (int k = 0; k < row.count; ++k) use(static_cast<std::size_t>(near[k]));
}

void PairRows::transpose(PairList& pairs) {
  row_end_.assign(rows_.size() + 1, 0);
  for (const Row& row : rows_) for_each_near(row, [this](std::size_t i) { ++row_end_[i + 1]; });
  std::partial_sum(row_end_.begin(), row_end_.end(), row_end_.begin());
  pairs.grain.resize(static_cast<std::size_t>(row_end_.back())), pairs.partner.resize(pairs.grain.size());
  for (std::size_t i = 0; i < rows_.size(); ++i)
    std::fill(pairs.grain.begin() + row_end_[i], pairs.grain.begin() + row_end_[i + 1], static_cast<int>(i));
  for (std::size_t j = 0; j < rows_.size(); ++j)
    for_each_near(rows_[j],
                  [&](std::size_t i) { pairs.partner[static_cast<std::size_t>(row_end_[i]++)] = static_cast<int>(j); });
}

}  // namespace vibrosow
