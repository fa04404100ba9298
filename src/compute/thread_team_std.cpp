// For the thread sanitiser alone, which does not see how TBB, built without it, orders its threads.
#include <thread>
#include <vector>

#include "compute/thread_team.hpp"

namespace vibrosow {

struct ThreadTeam::Pool {};

ThreadTeam::ThreadTeam(int threads) : size_(threads) {}
ThreadTeam::~ThreadTeam() = default;
ThreadTeam::ThreadTeam(ThreadTeam&&) noexcept = default;
ThreadTeam& ThreadTeam::operator=(ThreadTeam&&) noexcept = default;

void ThreadTeam::share(const std::function<void(int)>& work) {
  std::vector<std::jthread> others;
  for (int k = 1; k < size_; ++k) others.emplace_back([&work, k] { work(k); });
  work(0);
}

}  // namespace vibrosow
