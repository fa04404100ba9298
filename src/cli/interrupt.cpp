#include "cli/interrupt.hpp"

#include <csignal>

namespace vibrosow {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // what a signal handler may touch

extern "C" void note_interrupt(int) {
  interrupted = true;
}

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  struct sigaction action = {};
  action.sa_handler = note_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // the second of a kind finds the default: death
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction former = {};
    sigaction(signal, nullptr, &former);
    if (former.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup and job control keep theirs
  }
  return interrupted;
}

}  // namespace vibrosow
