#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "compute/thread_team.hpp"

namespace vibrosow {

struct ThreadTeam::Pool {
  explicit Pool(int threads)
      : limit(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads) {}

  oneapi::tbb::global_control limit;  // more threads than cores are the user's to ask for
  oneapi::tbb::task_arena arena;
};

ThreadTeam::ThreadTeam(int threads) : size_(threads), pool_(threads > 1 ? std::make_unique<Pool>(threads) : nullptr) {}
ThreadTeam::~ThreadTeam() = default;
ThreadTeam::ThreadTeam(ThreadTeam&&) noexcept = default;
ThreadTeam& ThreadTeam::operator=(ThreadTeam&&) noexcept = default;

void ThreadTeam::share(const std::function<void(int)>& work) {
  if (!pool_) return work(0);
  pool_->arena.execute([&] { oneapi::tbb::parallel_for(0, size_, work, oneapi::tbb::static_partitioner{}); });
}

}  // namespace vibrosow
