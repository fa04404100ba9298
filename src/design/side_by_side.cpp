#include "design/side_by_side.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace vibrosow {

void side_by_side(int threads, const std::function<void()>& work) {
  const int wide = threads > 0 ? threads : tbb::info::default_concurrency();
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(wide));
  tbb::task_arena(wide).execute([&] {
    tbb::parallel_for(
        0, wide, [&](int) { work(); }, tbb::simple_partitioner());
  });
}

}  // namespace vibrosow
