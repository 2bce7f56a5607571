#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace medial {

/// More threads than this nobody gets.
constexpr int most_threads = 1024;

/// How many threads a request means: 0 asks for all of the machine.
inline int effective_threads(int requested) {
  return requested > 0 ? std::min(requested, most_threads)
                       : tbb::this_task_arena::max_concurrency();
}

/// Runs work() in an arena of effective_threads(requested) and returns its result. oneTBB gives no
/// more threads than the machine has, and prints a warning, unless it has leave to; so it gets it.
template <class Work>
auto on_threads(int requested, Work&& work) {
  const int threads = effective_threads(requested);
  std::optional<tbb::global_control> leave;
  if (threads > tbb::this_task_arena::max_concurrency())
    leave.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

}  // namespace medial
