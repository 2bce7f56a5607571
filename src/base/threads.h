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

/// All that the project knows of threads. threads_tbb.cpp implements it with oneTBB;
/// threads_pool.cpp with the standard library's threads, where the library is built with
/// MEDIAL_TBB=OFF; threads_serial.cpp without threads, with MEDIAL_THREADS=OFF. No
/// result depends on which, nor on the number of threads. An exception ends the work and reaches
/// the caller.
namespace medial {

namespace threads {

/// A function that outlives the call that it is passed to; std::function would allocate.
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

/// Calls work(begin, end) for ranges that together are [0, count), each at least about half of
/// `grain` long where there are several.
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

/// Calls work(i, findings) for each i below `count` and returns the findings of each block of
/// `block` numbers, in order: what is made of them does not depend on the number of threads.
template <class Findings, class Work>
std::vector<Findings> in_blocks(std::size_t count, std::size_t block, const Work& work) {
  std::vector<Findings> findings((count + block - 1) / block);
  parallel_for(findings.size(), [&](std::size_t b) {
    const std::size_t end = std::min(count, (b + 1) * block);
    for (std::size_t i = b * block; i < end; ++i) work(i, findings[b]);
  });
  return findings;
}

/// Calls both.
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

/// Tasks that may add others to their group. Without threads they wait in a list, so that many
/// tasks within tasks do not use up the stack.
class TaskGroup {
 public:
  TaskGroup();
  ~TaskGroup();
  TaskGroup(const TaskGroup&) = delete;
  TaskGroup& operator=(const TaskGroup&) = delete;

  void run(std::function<void()> task);
  /// Returns when all tasks have ended. Must be called before the group ends.
  void wait();

 private:
  struct Tasks;
  std::unique_ptr<Tasks> tasks_;
};

/// Objects for tasks to work with: one for each task that runs at the same time.
template <class T>
class Pool {
 public:
  /// Calls work(object) with an object that nobody else uses meanwhile.
  template <class Work>
  void with_one(const Work& work) {
    T& object = take();
    work(object);
    const std::scoped_lock lock(mutex_);
    unused_.push_back(&object);
  }
  /// All objects; no task may run.
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
