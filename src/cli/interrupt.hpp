#pragma once

#include <atomic>

namespace vibrosow {

/// From now on the first Ctrl-C sets the flag; a second ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace vibrosow
