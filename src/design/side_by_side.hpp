#pragma once

#include <functional>

namespace vibrosow {

/// Calls `work` in `threads` threads at a time, 0: one per core, and returns when all have returned.
void side_by_side(int threads, const std::function<void()>& work);

}  // namespace vibrosow
