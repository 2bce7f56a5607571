#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <thread>
#include <utility>

#include "base/pipeline.h"
#include "base/threads.h"

namespace medial {
namespace {

using Allowed = tbb::global_control;

/// How many threads, at most `wanted`, the system starts at the same time.
std::size_t startable_threads(std::size_t wanted) {
  std::vector<std::thread> threads;
  std::mutex all_started;
  {
    const std::scoped_lock hold(all_started);
    try {
      threads.reserve(wanted);
      while (threads.size() < wanted)
        threads.emplace_back([&] { const std::scoped_lock wait(all_started); });
    } catch (const std::exception&) {  // no thread, or no memory for one
    }
  }
  for (std::thread& thread : threads) thread.join();
  return threads.size();
}

}  // namespace

int effective_threads(int requested) {
  return requested > 0 ? std::min(requested, most_threads)
                       : tbb::this_task_arena::max_concurrency();
}

void allow_startable_threads(int requested) {
  const auto wanted = static_cast<std::size_t>(effective_threads(requested)) - 1;
  const std::size_t started = startable_threads(wanted);
  // Never deleted: it holds until the program ends. The C library keeps some of the tried threads'
  // stacks for those to come.
  if (started == wanted) return;
  static const Allowed* const fewer = new Allowed(Allowed::max_allowed_parallelism, started + 1);
  static_cast<void>(fewer);
}

namespace threads {

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const auto& range) { work(range.begin(), range.end()); });
}

void run_both(FunctionRef<> first, FunctionRef<> second) { tbb::parallel_invoke(first, second); }

void run_on(int requested, FunctionRef<> work) {
  const int threads = effective_threads(requested);
  // Without leave oneTBB gives no more threads than the machine has, and prints a warning.
  std::optional<Allowed> leave;
  if (threads > tbb::this_task_arena::max_concurrency())
    leave.emplace(Allowed::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute(work);
}

}  // namespace threads

struct TaskGroup::Tasks {
  tbb::task_group group;
};

TaskGroup::TaskGroup() : tasks_(std::make_unique<Tasks>()) {}
TaskGroup::~TaskGroup() = default;

void TaskGroup::run(std::function<void()> task) { tasks_->group.run(std::move(task)); }

void TaskGroup::wait() { tasks_->group.wait(); }

void run_pipeline(int requested, std::size_t window,
                  const std::function<std::shared_ptr<void>()>& next,
                  std::span<const PipelineStage> stages) {
  using Task = std::shared_ptr<void>;
  constexpr auto in_order = tbb::filter_mode::serial_in_order;
  tbb::filter<void, Task> chain(in_order, [&next](tbb::flow_control& control) {
    Task task = next();
    if (task == nullptr) control.stop();
    return task;
  });
  for (const PipelineStage& stage : stages)
    chain = chain & tbb::filter<Task, Task>(stage.in_order ? in_order : tbb::filter_mode::parallel,
                                            [&stage](Task task) {
                                              stage.run(task.get());
                                              return task;
                                            });
  const tbb::filter<Task, void> end(tbb::filter_mode::parallel, [](const Task&) {});
  on_threads(requested, [&] { tbb::parallel_pipeline(window, chain & end); });
}

}  // namespace medial
