#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <pthread.h>

#include <atomic>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "base/pipeline.h"
#include "base/threads.h"

namespace medial {
namespace {

using Allowed = tbb::global_control;

/// Whether this thread works for run_on(1). Then oneTBB is not used, because its arenas and tasks
/// take longer than the axis of a rectangle.
thread_local bool alone = false;

/// Set in a process forked from a process that used oneTBB: oneTBB would wait forever for threads
/// that the new process does not have.
std::atomic<bool> forked{false};

/// Whether to share work with other threads.
bool shared() {
  if (alone || forked) return false;
  [[maybe_unused]] static const int registered =
      pthread_atfork(nullptr, nullptr, [] { forked = true; });
  return true;
}

/// Sets `alone` during its lifetime.
class Alone {
 public:
  explicit Alone(bool now) : before_(std::exchange(alone, now)) {}
  ~Alone() { alone = before_; }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  bool before_;
};

/// An arena for a number of threads, used by one call at a time. Arenas are reused, because oneTBB
/// 2021 leaks 7 KB for each arena that ran tasks; there are as many as simultaneous calls. They are
/// never deleted, because other threads may outlive main().
class Arena {
 public:
  explicit Arena(int threads) {
    const std::scoped_lock lock(mutex());
    first_ = &unused()[threads];
    kept_ = *first_ != nullptr ? *first_ : new Kept{tbb::task_arena(threads)};
    *first_ = kept_->next;
  }
  ~Arena() {
    const std::scoped_lock lock(mutex());
    kept_->next = std::exchange(*first_, kept_);
  }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  tbb::task_arena* operator->() const { return &kept_->arena; }

 private:
  struct Kept {
    tbb::task_arena arena;
    Kept* next = nullptr;
  };
  static std::mutex& mutex() {
    static auto* const one = new std::mutex;
    return *one;
  }
  /// By number of threads: the head of a list.
  static std::map<int, Kept*>& unused() {
    static auto* const all = new std::map<int, Kept*>;
    return *all;
  }

  Kept** first_;
  Kept* kept_;
};

/// The number of threads, at most `wanted`, that the system can run at the same time.
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
  if (forked) return 1;
  if (requested > 0) return std::min(requested, most_threads);
  return alone ? 1 : tbb::this_task_arena::max_concurrency();
}

void allow_startable_threads(int requested) {
  const auto wanted = static_cast<std::size_t>(effective_threads(requested)) - 1;
  const std::size_t started = startable_threads(wanted);
  // Never deleted: the limit holds until the program ends. The C library keeps some stacks of the
  // tried threads for later threads.
  if (started == wanted) return;
  static const Allowed* const fewer = new Allowed(Allowed::max_allowed_parallelism, started + 1);
  static_cast<void>(fewer);
}

namespace threads {

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> work) {
  if (count <= grain || !shared()) {
    if (count > 0) work(0, count);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const auto& range) { work(range.begin(), range.end()); });
}

void run_both(FunctionRef<> first, FunctionRef<> second) {
  if (shared()) return tbb::parallel_invoke(first, second);
  first();
  second();
}

void run_on(int requested, FunctionRef<> work) {
  const int threads = effective_threads(requested);
  const Alone scope(threads == 1);
  if (!shared()) return work();
  // Without this, oneTBB gives no more threads than the machine has, and prints a warning.
  std::optional<Allowed> leave;
  if (threads > tbb::this_task_arena::max_concurrency())
    leave.emplace(Allowed::max_allowed_parallelism, static_cast<std::size_t>(threads));
  Arena(threads)->execute(work);
}

}  // namespace threads

struct TaskGroup::Tasks {
  std::optional<tbb::task_group> group;
  std::vector<std::function<void()>> waiting;  ///< without a group
};

TaskGroup::TaskGroup() = default;
TaskGroup::~TaskGroup() = default;

void TaskGroup::run(std::function<void()> task) {
  if (!tasks_) {
    tasks_ = std::make_unique<Tasks>();
    if (shared()) tasks_->group.emplace();
  }
  if (tasks_->group) return tasks_->group->run(std::move(task));
  tasks_->waiting.push_back(std::move(task));
}

void TaskGroup::wait() {
  if (!tasks_) return;
  if (tasks_->group) tasks_->group->wait();
  while (!tasks_->waiting.empty()) {
    const std::function<void()> next = std::move(tasks_->waiting.back());
    tasks_->waiting.pop_back();
    next();
  }
}

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
  on_threads(requested, [&] {
    if (shared()) return tbb::parallel_pipeline(window, chain & end);
    run_in_turn(next, stages);
  });
}

}  // namespace medial
