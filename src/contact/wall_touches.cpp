#include "contact/wall_touches.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace vibrosow {

void WallTouches::begin(std::size_t first, std::size_t count) {
  first_ = first;
  touches_.assign(count, 0);
  twins_.clear();
}

void WallTouches::sort_by_distance(double radius) {
  constexpr double as_near = 1e-9;  // of the radius
  sorted_.resize(touched_.size());
  std::iota(sorted_.begin(), sorted_.end(), std::size_t{0});
  for (auto from = sorted_.begin(); from != sorted_.end(); ++from) {
    const auto distance = [&](std::size_t k) { return touched_[k].distance; };
    const double least = distance(*std::ranges::min_element(from, sorted_.end(), {}, distance));
    const auto is_next = [&](std::size_t k, bool inside) {
      return touched_[k].distance <= least + as_near * radius && touched_[k].inside == inside;
    };
    auto next = std::find_if(from, sorted_.end(), [&](std::size_t k) { return is_next(k, true); });
    if (next == sorted_.end())
      next = std::find_if(from, sorted_.end(), [&](std::size_t k) { return is_next(k, false); });
    std::rotate(from, next, next + 1);  // the others stay in their order
  }
}

void WallTouches::take_chosen() {
  pushing_.clear();
  for (const bool inside : {true, false})
    for (std::size_t k = 0; k < touched_.size(); ++k) {
      if (touched_[k].inside != inside) continue;
      const std::size_t candidate = touched_[k].candidate;
      if (pusher_of_[k] == k)
        pushing_.push_back(touched_[k]), add(candidate);
      else if (inside)
        twins_.push_back({candidate, touched_[pusher_of_[k]].candidate}), add(candidate);
    }
}

void WallTouches::renew(ContactHistories& histories) const {
  if (histories.touched.empty()) return;
  for (const auto& [twin, pusher] : twins_)
    if (histories.touched[first_ + twin] && !histories.touched[first_ + pusher])
      histories.copy_entry(first_ + pusher, histories, first_ + twin);
  // Few change: the rest is passed over in long words.
  constexpr std::size_t word = 32;
  for (std::size_t from = 0; from < touches_.size(); from += word) {
    const std::size_t to = std::min(from + word, touches_.size());
    if (std::memcmp(&histories.touched[first_ + from], &touches_[from], to - from) == 0) continue;
    for (std::size_t c = from; c < to; ++c) {
      if (histories.touched[first_ + c] && !touches_[c]) histories.forget(first_ + c);
      histories.touched[first_ + c] = touches_[c];
    }
  }
}

void WallTouches::share(ContactHistories& histories) const {
  if (histories.touched.empty()) return;
  for (const auto& [twin, pusher] : twins_) histories.copy_entry(first_ + twin, histories, first_ + pusher);
}

}  // namespace vibrosow
