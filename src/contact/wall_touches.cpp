#include "contact/wall_touches.hpp"

#include <algorithm>
#include <cstring>

namespace vibrosow {

void WallTouches::begin(std::size_t first, std::size_t count) {
  first_ = first;
  touches_.assign(count, 0);
  twins_.clear();
}

/// What lay on the wall that pushed lies on the other now, as does that wall.
void WallTouches::replace(std::size_t pushing, const Touch& by, std::size_t first_twin) {
  const Touch before = pushing_[pushing];
  pushing_.erase(pushing_.begin() + static_cast<std::ptrdiff_t>(pushing));
  for (std::size_t k = first_twin; k < twins_.size(); ++k)
    if (twins_[k].pusher == before.candidate) twins_[k].pusher = by.candidate;
  if (before.inside) twins_.push_back({before.candidate, by.candidate});
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
