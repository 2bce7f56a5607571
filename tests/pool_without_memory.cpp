// The pool when memory runs out: a part of pool_tests alone, since it replaces `new`.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>

#include "base/threads.h"

namespace {

/// Whether this thread gets no memory.
thread_local bool runs_out = false;

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  void* const memory = runs_out ? nullptr : std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace medial {
namespace {

/// How often of 100 times `work` ends for want of memory.
template <class Work>
int failures(const Work& work) {
  int count = 0;
  for (int time = 0; time < 100; ++time) {
    try {
      runs_out = true;
      work();
    } catch (const std::bad_alloc&) {
      ++count;
    }
    runs_out = false;
  }
  return count;
}

/// Adds this many tasks at the same time.
void nest(int depth, const std::function<void()>& task) {
  if (depth > 0) in_parallel([&] { nest(depth - 1, task); }, task);
}

TEST(PoolWithoutMemory, WorkEndsBeforeItsError) {
  on_threads(32, [] {
    using std::chrono::microseconds;
    std::atomic<int> begun{0};
    const std::function<void()> task = [&begun] {
      ++begun;
      std::this_thread::sleep_for(microseconds(50));
    };
    const auto ended = [&begun](const auto& work) {
      try {
        work();
      } catch (const std::bad_alloc&) {
        const int before = begun;
        std::this_thread::sleep_for(microseconds(300));
        EXPECT_EQ(begun, before);
        throw;
      }
    };
    EXPECT_GT(failures([&] { ended([&] { parallel_for(100, [&](std::size_t) { task(); }); }); }),
              0);
    EXPECT_GT(failures([&] { ended([&] { nest(32, task); }); }), 0);
  });
}

TEST(PoolWithoutMemory, AGroupEndsWithoutTheTaskThatHasNoRoom) {
  on_threads(4, [] {
    TaskGroup tasks;
    std::atomic<int> done{0};
    int put = 0;
    const int failed = failures([&] {
      tasks.run([&done] { ++done; });
      ++put;
    });
    tasks.wait();
    EXPECT_GT(failed, 0);
    EXPECT_EQ(failed + put, 100);
    EXPECT_EQ(done, put);
  });
}

}  // namespace
}  // namespace medial
