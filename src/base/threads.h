#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>
#include <vector>

#include "medial/threads.h"

/// The threads of the whole project. threads_tbb.cpp implements them with oneTBB, threads_pool.cpp
/// with std::thread (MEDIAL_TBB=OFF), threads_serial.cpp without threads (MEDIAL_THREADS=OFF).
/// Results depend neither on the implementation nor on the number of threads. An exception ends the
/// work and reaches the caller.
namespace medial {

namespace threads {

/// A reference to a function that outlives the call it is passed to. Unlike std::function, it does
/// not allocate.
template <class... Arguments>
class FunctionRef {
 public:
  template <class Function>
  FunctionRef(const Function& function)  // NOLINT: implicit, as for std::function
      : object_(&function), call_([](const void* object, Arguments... arguments) {
          (*static_cast<const Function*>(object))(arguments...);
        }) {}
  void operator()(Arguments... arguments) const { call_(object_, arguments...); }

 private:
  const void* object_;
  void (*call_)(const void*, Arguments...);
};

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> work);
void run_both(FunctionRef<> first, FunctionRef<> second);
void run_on(int requested, FunctionRef<> work);

}  // namespace threads

/// Calls work(begin, end) for ranges that partition [0, count). If there are several, each has at
/// least about `grain` / 2 elements.
template <class Work>
void parallel_ranges(std::size_t count, std::size_t grain, const Work& work) {
  threads::run_ranges(count, grain, work);
}

/// Calls work(i) for each i below `count`.
template <class Work>
void parallel_for(std::size_t count, const Work& work) {
  threads::run_ranges(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i);
  });
}

/// Calls work(i, findings) for each i below `count`, with one `findings` per block of `block`
/// numbers. Returns the findings of all blocks in order, so the result does not depend on the
/// number of threads.
template <class Findings, class Work>
std::vector<Findings> in_blocks(std::size_t count, std::size_t block, const Work& work) {
  std::vector<Findings> findings((count + block - 1) / block);
  parallel_for(findings.size(), [&](std::size_t b) {
    const std::size_t end = std::min(count, (b + 1) * block);
    for (std::size_t i = b * block; i < end; ++i) work(i, findings[b]);
  });
  return findings;
}

/// Calls both functions, possibly at the same time.
template <class First, class Second>
void in_parallel(const First& first, const Second& second) {
  threads::run_both(first, second);
}

/// Runs work() on effective_threads(requested) threads and returns its result.
template <class Work>
auto on_threads(int requested, Work&& work) {
  if constexpr (std::is_void_v<decltype(work())>) {
    threads::run_on(requested, [&] { work(); });
  } else {
    std::optional<decltype(work())> result;
    threads::run_on(requested, [&] { result.emplace(work()); });
    return *std::move(result);
  }
}

/// Tasks that may add further tasks to their group. Without threads, tasks wait in a list, so that
/// deeply nested tasks do not use up the stack.
class TaskGroup {
 public:
  TaskGroup();
  ~TaskGroup();
  TaskGroup(const TaskGroup&) = delete;
  TaskGroup& operator=(const TaskGroup&) = delete;

  void run(std::function<void()> task);
  /// Waits for all tasks. Must be called before the group is destroyed.
  void wait();

 private:
  struct Tasks;
  std::unique_ptr<Tasks> tasks_;
};

/// A pool of work objects: one for each task that runs at the same time.
template <class T>
class Pool {
 public:
  /// Calls work(object) with an object that no other task is using.
  template <class Work>
  void with_one(const Work& work) {
    T& object = take();
    work(object);
    const std::scoped_lock lock(mutex_);
    unused_.push_back(&object);
  }
  /// All objects. No task may be running.
  const std::deque<T>& all() const { return all_; }

 private:
  T& take() {
    const std::scoped_lock lock(mutex_);
    if (unused_.empty()) return all_.emplace_back();
    T* const object = unused_.back();
    unused_.pop_back();
    return *object;
  }

  std::mutex mutex_;
  std::deque<T> all_;
  std::vector<T*> unused_;
};

}  // namespace medial
