#include <stdexcept>
#include <string>

#include "compute/thread_team.hpp"

namespace vibrosow {

struct ThreadTeam::Pool {};

ThreadTeam::ThreadTeam(int threads) : size_(threads) {
  if (threads > 1)
    throw std::invalid_argument(std::to_string(threads) +
                                " threads asked for, but this build has none (VIBROSOW_THREADS=OFF); ask for 1");
}
ThreadTeam::~ThreadTeam() = default;
ThreadTeam::ThreadTeam(ThreadTeam&&) noexcept = default;
ThreadTeam& ThreadTeam::operator=(ThreadTeam&&) noexcept = default;

void ThreadTeam::share(const std::function<void(int)>& work) {
  work(0);
}

}  // namespace vibrosow
