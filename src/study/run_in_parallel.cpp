#include "study/run_in_parallel.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>

namespace vibrosow {
namespace {

/// Hands over what was written before to who passes later, in a way that the thread sanitiser sees; it cannot see into
/// TBB. Outside of any object, for to read the address of one would itself look like a race.
std::atomic<int> handing_over;
void hand_over() {
  handing_over.fetch_add(1, std::memory_order_acq_rel);
}

}  // namespace

void run_in_parallel(int threads, const std::function<void()>& work) {
  const int wide = threads > 0 ? threads : tbb::info::default_concurrency();
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(wide));
  hand_over();
  tbb::task_arena(wide).execute([&] {
    const auto work_handed_over = [&work](int) {
      hand_over();
      work();
      hand_over();
    };
    tbb::parallel_for(0, wide, work_handed_over, tbb::simple_partitioner());
  });
  hand_over();
}

void run_in_parallel(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  run_in_parallel(threads, [&] {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) work(i);
  });
}

}  // namespace vibrosow
