#include <pthread.h>

#include <atomic>
#include <climits>
#include <condition_variable>
#include <exception>
#include <thread>
#include <utility>

#include "base/pipeline.h"
#include "base/threads.h"

// A thread pool of the standard library, for platforms without oneTBB, such as browsers. A waiting
// thread runs tasks, so the work ends even if the other threads start late or not at all.

namespace medial {
namespace {

/// Tasks with a common waiter.
struct Batch {
  std::size_t open = 0;      ///< those that have not ended
  std::exception_ptr error;  ///< the first one; tasks that have not begun are then skipped
};

struct Task {
  std::function<void()> work;
  Batch* batch;
};

/// Work for a limited number of threads at a time.
struct Arena {
  explicit Arena(int threads) : most(threads) {}
  const int most;
  int working = 1;  ///< with the thread whose work it is
  std::deque<Task> tasks{};
};

/// Set in a process forked from a process with threads, because fork() copies only one thread.
std::atomic<bool> forked{false};

/// The arena whose tasks this thread runs.
thread_local Arena* current = nullptr;

class Threads {
 public:
  Threads() {
    pthread_atfork(nullptr, nullptr, [] { forked = true; });
    add_up_to(static_cast<int>(std::thread::hardware_concurrency()));
  }

  /// Starts threads until there are `count`, including the caller, or the system refuses one. After
  /// a refusal, does not ask for more unless `again`.
  void add_up_to(int count, bool again = false) {
    const std::scoped_lock lock(mutex_);
    if (again) is_refused_ = false;
    try {
      for (; !is_refused_ && count_ < count; ++count_) threads_.emplace_back([this] { serve(); });
    } catch (const std::exception&) {  // no thread, or no memory for one
      is_refused_ = true;
    }
  }
  int count() const { return count_; }

  /// The arena for work without an explicit number of threads.
  Arena& common() { return common_; }
  void open(Arena& arena) {
    const std::scoped_lock lock(mutex_);
    arenas_.push_back(&arena);
  }
  /// Waits until no other thread refers to the arena.
  void close(Arena& arena) {
    std::unique_lock lock(mutex_);
    arenas_.erase(std::find(arenas_.begin(), arenas_.end(), &arena));
    changed_.wait(lock, [&] { return arena.working == 1; });
  }

  void put(Arena& arena, Batch& batch, std::function<void()> work) {
    {
      const std::scoped_lock lock(mutex_);
      arena.tasks.push_back({std::move(work), &batch});  // throws if memory runs out
      ++batch.open;
    }
    more_.notify_one();
    changed_.notify_all();
  }

  /// Runs own(), which may put tasks, and the batch's tasks.
  void finish(Arena& arena, Batch& batch, threads::FunctionRef<> own) {
    std::exception_ptr error;
    try {
      own();
    } catch (...) {
      error = std::current_exception();
    }
    end(arena, batch, error);
    if (batch.error) std::rethrow_exception(batch.error);
  }
  /// Waits until all tasks of the batch have ended. After an error, tasks that have not begun are
  /// dropped.
  void end(Arena& arena, Batch& batch, const std::exception_ptr& error) {
    std::unique_lock lock(mutex_);
    if (error && !batch.error) batch.error = error;
    while (batch.open > 0)
      if (arena.tasks.empty()) {
        changed_.wait(lock);
      } else {
        Task newest = std::move(arena.tasks.back());
        arena.tasks.pop_back();
        run(lock, std::move(newest));
      }
  }

 private:
  /// The loop of every pool thread.
  [[noreturn]] void serve() {
    std::unique_lock lock(mutex_);
    while (true) {
      const auto found = std::find_if(arenas_.begin(), arenas_.end(), [](const Arena* arena) {
        return !arena->tasks.empty() && arena->working < arena->most;
      });
      if (found == arenas_.end()) {
        more_.wait(lock);
        continue;
      }
      Arena& arena = **found;
      current = &arena;
      ++arena.working;
      while (!arena.tasks.empty()) {
        Task oldest = std::move(arena.tasks.front());  // the largest, as work is halved repeatedly
        arena.tasks.pop_front();
        run(lock, std::move(oldest));
      }
      if (--arena.working == 1) changed_.notify_all();
    }
  }

  /// Runs the task with the lock released.
  void run(std::unique_lock<std::mutex>& lock, Task task) {
    std::exception_ptr error = task.batch->error;
    if (!error) {
      lock.unlock();
      try {
        task.work();
      } catch (...) {
        error = std::current_exception();
      }
      task.work = nullptr;  // destroy captured objects before the batch ends
      lock.lock();
    }
    if (error && !task.batch->error) task.batch->error = error;
    if (--task.batch->open == 0) changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable more_;     ///< wakes idle threads: there is work
  std::condition_variable changed_;  ///< wakes waiters: there is work, or their batch has ended
  std::atomic<int> count_{1};
  bool is_refused_ = false;
  Arena common_{INT_MAX};
  std::vector<Arena*> arenas_{&common_};
  std::vector<std::thread> threads_;
};

Threads& pool() {
  static Threads* const threads = new Threads;  // never deleted: its threads sleep until exit
  return *threads;
}
Arena& arena_here() { return current != nullptr ? *current : pool().common(); }
/// The number of threads available to this thread's work.
int threads_here() {
  if (forked || arena_here().most == 1) return 1;
  return std::min(arena_here().most, pool().count());
}

/// Provides the arena of the caller's work during its lifetime.
class Scope {
 public:
  explicit Scope(int threads) : arena_(threads) {
    if (threads > 1) pool().open(arena_);
    before_ = std::exchange(current, &arena_);
  }
  ~Scope() {
    if (arena_.most > 1) pool().close(arena_);
    current = before_;
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  Arena arena_;
  Arena* before_ = nullptr;
};

}  // namespace

int effective_threads(int requested) {
  if (forked) return 1;
  return requested > 0 ? std::min(requested, most_threads) : threads_here();
}

void allow_startable_threads(int requested) {
  const int threads = effective_threads(requested);
  if (threads > 1) pool().add_up_to(threads, true);
}

namespace threads {

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> work) {
  if (count == 0) return;
  constexpr std::size_t pieces_each = 8;  // several pieces per thread balance the load
  const auto threads = static_cast<std::size_t>(threads_here());
  const std::size_t pieces = threads == 1 ? 1 : std::min(count / grain, threads * pieces_each);
  if (pieces <= 1) return work(0, count);
  const auto begin_of = [&](std::size_t i) {
    return i * (count / pieces) + std::min(i, count % pieces);
  };
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i = next++; i < pieces; i = next++) {
      try {
        work(begin_of(i), begin_of(i + 1));
      } catch (...) {
        next = pieces;
        throw;
      }
    }
  };
  Batch batch;
  pool().finish(arena_here(), batch, [&] {
    for (std::size_t i = 1; i < std::min(threads, pieces); ++i)
      pool().put(arena_here(), batch, [&take] { take(); });
    take();
  });
}

void run_both(FunctionRef<> first, FunctionRef<> second) {
  if (threads_here() == 1) {
    first();
    return second();
  }
  Batch batch;
  pool().finish(arena_here(), batch, [&] {
    pool().put(arena_here(), batch, [&second] { second(); });
    first();
  });
}

void run_on(int requested, FunctionRef<> work) {
  const int threads = effective_threads(requested);
  if (threads > 1) pool().add_up_to(threads);
  const Scope scope(threads);
  work();
}

}  // namespace threads

struct TaskGroup::Tasks {
  Arena& arena = arena_here();
  bool is_shared = threads_here() > 1;
  Batch batch{};
  std::vector<std::function<void()>> waiting{};  ///< used if work is not shared
};

TaskGroup::TaskGroup() = default;
TaskGroup::~TaskGroup() {  // after an exception there may be tasks
  if (tasks_ && tasks_->is_shared)
    pool().end(tasks_->arena, tasks_->batch, std::make_exception_ptr(std::exception()));
}

void TaskGroup::run(std::function<void()> task) {
  if (!tasks_) tasks_ = std::make_unique<Tasks>();
  if (tasks_->is_shared) return pool().put(tasks_->arena, tasks_->batch, std::move(task));
  tasks_->waiting.push_back(std::move(task));
}

void TaskGroup::wait() {
  if (!tasks_) return;
  if (tasks_->is_shared) return pool().finish(tasks_->arena, tasks_->batch, [] {});
  while (!tasks_->waiting.empty()) {
    const std::function<void()> next = std::move(tasks_->waiting.back());
    tasks_->waiting.pop_back();
    next();
  }
}

void run_pipeline(int requested, std::size_t /*window*/,
                  const std::function<std::shared_ptr<void>()>& next,
                  std::span<const PipelineStage> stages) {
  // The stages of a task may use several threads.
  on_threads(requested, [&] { run_in_turn(next, stages); });
}

}  // namespace medial
