#pragma once

#include <time.h>

namespace vibrosow {

/// CPU time of the calling thread, s: other programs on the machine do not count.
inline double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace vibrosow
