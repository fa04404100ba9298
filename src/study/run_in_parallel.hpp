#pragma once

#include <cstddef>
#include <functional>

namespace vibrosow {

/// Calls `work` in `threads` threads at a time, 0: one per core, and returns when all have returned.
void run_in_parallel(int threads, const std::function<void()>& work);

/// Calls `work` with 0, 1 .. count - 1 in `threads` threads: each takes the next in order, so what is ended early has
/// done the first ones.
void run_in_parallel(int threads, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace vibrosow
