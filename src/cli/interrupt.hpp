#pragma once

#include <atomic>

namespace vibrosow {

/// From now on the first Ctrl-C (SIGINT), SIGTERM or SIGHUP sets the flag; a second of its kind ends the program at
/// once. What the caller ignores stays ignored.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace vibrosow
