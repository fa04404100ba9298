#include "cli/threads.hpp"

#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/console.hpp"

namespace vibrosow {

int threads_to_be_had(int wanted) {
  std::atomic<bool> counted{false};
  std::vector<std::jthread> others;
  try {
    while (static_cast<int>(others.size()) + 1 < wanted) others.emplace_back([&] { counted.wait(false); });
  } catch (const std::system_error&) {
  }
  counted = true;
  counted.notify_all();
  const int had = static_cast<int>(others.size()) + 1;
  if (had < wanted)
    complain(
        fmt::format("warning: the system gives {} thread{} of the {} asked for", had, had == 1 ? "" : "s", wanted));
  return had;
}

}  // namespace vibrosow
