#include <atomic>
#include <climits>
#include <condition_variable>
#include <exception>
#include <thread>
#include <utility>

#include "base/pipeline.h"
#include "base/threads.h"

// Threads of the standard library, for where there is no oneTBB: in browsers. Who waits for tasks
// runs some meanwhile: all work ends however late the other threads start, and if none does.

namespace medial {
namespace {

/// Tasks that somebody waits for.
struct Batch {
  std::size_t open = 0;      ///< those that have not ended
  std::exception_ptr error;  ///< the first; tasks that have not begun are left out then
};

struct Task {
  std::function<void()> work;
  Batch* batch;
};

/// Work for at most so many threads at the same time.
struct Arena {
  explicit Arena(int threads) : most(threads) {}
  const int most;
  int working = 1;  ///< with the thread whose work it is
  std::deque<Task> tasks{};
};

/// Whose tasks this thread runs.
thread_local Arena* current = nullptr;

class Threads {
 public:
  Threads() { add_up_to(static_cast<int>(std::thread::hardware_concurrency())); }
  ~Threads() {
    {
      const std::scoped_lock lock(mutex_);
      is_over_ = true;
    }
    more_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  /// Starts threads until, with the caller, there are `count`, or the system refuses one.
  void add_up_to(int count) {
    const std::scoped_lock lock(mutex_);
    try {
      for (; count_ < count; ++count_) threads_.emplace_back([this] { serve(); });
    } catch (const std::exception&) {  // no thread, or no memory for one
    }
  }
  int count() const { return count_; }

  /// Of work that names no number of threads.
  Arena& common() { return common_; }
  void open(Arena& arena) {
    const std::scoped_lock lock(mutex_);
    arenas_.push_back(&arena);
  }
  /// Returns when no other thread knows the arena.
  void close(Arena& arena) {
    std::unique_lock lock(mutex_);
    arenas_.erase(std::find(arenas_.begin(), arenas_.end(), &arena));
    changed_.wait(lock, [&] { return arena.working == 1; });
  }

  void put(Arena& arena, Batch& batch, std::function<void()> work) {
    {
      const std::scoped_lock lock(mutex_);
      ++batch.open;
      arena.tasks.push_back({std::move(work), &batch});
    }
    more_.notify_one();
    changed_.notify_all();
  }

  /// Runs own() and the batch's tasks.
  void finish(Arena& arena, Batch& batch, threads::FunctionRef<> own) {
    std::exception_ptr error;
    try {
      own();
    } catch (...) {
      error = std::current_exception();
    }
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
    if (batch.error) std::rethrow_exception(batch.error);
  }

 private:
  /// What every thread but the callers' does.
  void serve() {
    std::unique_lock lock(mutex_);
    while (!is_over_) {
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
        Task oldest = std::move(arena.tasks.front());  // in halves of halves, the largest
        arena.tasks.pop_front();
        run(lock, std::move(oldest));
      }
      if (--arena.working == 1) changed_.notify_all();
    }
  }

  /// Runs the task without the lock.
  void run(std::unique_lock<std::mutex>& lock, Task task) {
    std::exception_ptr error = task.batch->error;
    if (!error) {
      lock.unlock();
      try {
        task.work();
      } catch (...) {
        error = std::current_exception();
      }
      task.work = nullptr;  // what it holds ends before the batch
      lock.lock();
    }
    if (error && !task.batch->error) task.batch->error = error;
    if (--task.batch->open == 0) changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable more_;     ///< for threads without work: there is some
  std::condition_variable changed_;  ///< for those who wait: there is some, or theirs has ended
  std::atomic<int> count_{1};
  bool is_over_ = false;
  Arena common_{INT_MAX};
  std::vector<Arena*> arenas_{&common_};
  std::vector<std::thread> threads_;
};

Threads& pool() {
  static Threads threads;
  return threads;
}
Arena& arena_here() { return current != nullptr ? *current : pool().common(); }
/// How many threads there are for the work of this one.
int threads_here() { return std::min(arena_here().most, pool().count()); }

/// The arena of the caller's work, as long as it lives.
class Scope {
 public:
  explicit Scope(int threads) : arena_(threads), before_(std::exchange(current, &arena_)) {
    if (threads > 1) pool().open(arena_);
  }
  ~Scope() {
    if (arena_.most > 1) pool().close(arena_);
    current = before_;
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  Arena arena_;
  Arena* before_;
};

}  // namespace

int effective_threads(int requested) {
  return requested > 0 ? std::min(requested, most_threads) : threads_here();
}

void allow_startable_threads(int requested) { pool().add_up_to(effective_threads(requested)); }

namespace threads {

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> work) {
  if (count == 0) return;
  constexpr std::size_t pieces_each = 8;  // threads that have less to do take more of them
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
  for (std::size_t i = 1; i < std::min(threads, pieces); ++i)
    pool().put(arena_here(), batch, [&take] { take(); });
  pool().finish(arena_here(), batch, take);
}

void run_both(FunctionRef<> first, FunctionRef<> second) {
  if (threads_here() == 1) {
    first();
    return second();
  }
  Batch batch;
  pool().put(arena_here(), batch, [&second] { second(); });
  pool().finish(arena_here(), batch, first);
}

void run_on(int requested, FunctionRef<> work) {
  const int threads = effective_threads(requested);
  pool().add_up_to(threads);
  const Scope scope(threads);
  work();
}

}  // namespace threads

struct TaskGroup::Tasks {
  Arena& arena = arena_here();
  bool is_shared = threads_here() > 1;
  Batch batch{};
  std::vector<std::function<void()>> waiting{};  ///< where it is not shared
};

TaskGroup::TaskGroup() : tasks_(std::make_unique<Tasks>()) {}
TaskGroup::~TaskGroup() = default;

void TaskGroup::run(std::function<void()> task) {
  if (tasks_->is_shared) return pool().put(tasks_->arena, tasks_->batch, std::move(task));
  tasks_->waiting.push_back(std::move(task));
}

void TaskGroup::wait() {
  pool().finish(tasks_->arena, tasks_->batch, [&] {
    while (!tasks_->waiting.empty()) {
      const std::function<void()> next = std::move(tasks_->waiting.back());
      tasks_->waiting.pop_back();
      next();
    }
  });
}

void run_pipeline(int requested, std::size_t /*window*/,
                  const std::function<std::shared_ptr<void>()>& next,
                  std::span<const PipelineStage> stages) {
  on_threads(requested, [&] {  // one task at a time, whose stages may use several
    while (const std::shared_ptr<void> task = next())
      for (const PipelineStage& stage : stages) stage.run(task.get());
  });
}

}  // namespace medial
