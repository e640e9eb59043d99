#include "apps/machine/thread_limit.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "apps/machine/usable_cores.h"

namespace kaustik::app {

void with_thread_limit(int threads, const std::function<void()>& work) {
  const int limit = threads > 0 ? threads : core_limits().usable();
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(limit));
  tbb::task_arena arena(limit);
  arena.execute(work);
}

}  // namespace kaustik::app
