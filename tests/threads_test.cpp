#include "base/threads.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace medial {
namespace {

TEST(Threads, OneWorksAlone) {
  const int all = effective_threads(0);
  on_threads(1, [&] {
    EXPECT_EQ(effective_threads(0), 1);
    const auto here = std::this_thread::get_id();
    std::size_t next = 0;
    parallel_for(10'000, [&](std::size_t i) {
      EXPECT_EQ(i, next++);
      EXPECT_EQ(std::this_thread::get_id(), here);
    });
    EXPECT_EQ(next, 10'000U);
    TaskGroup tasks;
    int done = 0;
    for (int i = 0; i < 3; ++i)
      tasks.run([&] {
        ++done;
        tasks.run([&] { ++done; });
      });
    EXPECT_EQ(done, 0);
    tasks.wait();
    EXPECT_EQ(done, 6);
    in_parallel([&] { ++done; }, [&] { EXPECT_EQ(++done, 8); });
  });
  EXPECT_EQ(effective_threads(0), all);
}

TEST(Threads, MoreWithinOneAndBack) {
  const int two = effective_threads(2);  // 1 in a build without threads
  on_threads(1, [&] {
    on_threads(2, [&] { EXPECT_EQ(effective_threads(0), two); });
    EXPECT_THROW(on_threads(2, [] { throw std::runtime_error("lost"); }), std::runtime_error);
    EXPECT_EQ(effective_threads(0), 1);
  });
  EXPECT_THROW(on_threads(1, [] { throw std::runtime_error("lost"); }), std::runtime_error);
  std::atomic<int> count = 0;
  on_threads(2, [&] {
    EXPECT_EQ(effective_threads(0), two);
    TaskGroup tasks;
    for (int i = 0; i < 100; ++i) tasks.run([&] { on_threads(1, [&] { ++count; }); });
    tasks.wait();
  });
  EXPECT_EQ(count, 100);
}

TEST(Threads, RangesCoverAll) {
  for (const std::size_t count : {0, 1, 7, 8, 9, 1000}) {
    std::atomic<std::size_t> sum = 0;
    parallel_ranges(count, 8, [&](std::size_t begin, std::size_t end) {
      EXPECT_LT(begin, end);
      sum += end - begin;
    });
    EXPECT_EQ(sum, count);
  }
}

TEST(Threads, ErrorsEndTheWorkAndReachTheCaller) {
  for (const int threads : {1, 2, 4})
    on_threads(threads, [&] {
      const auto fail = [](std::size_t i) {
        if (i == 77) throw std::runtime_error("lost");
      };
      for (int time = 0; time < 50; ++time) {
        EXPECT_THROW(parallel_for(1000, fail), std::runtime_error);
        EXPECT_THROW(in_parallel([&] { fail(77); }, [] {}), std::runtime_error);
        EXPECT_THROW(in_parallel([] {}, [&] { parallel_for(100, fail); }), std::runtime_error);
        TaskGroup tasks;
        for (std::size_t i = 0; i < 100; ++i) tasks.run([i, fail] { fail(i); });
        EXPECT_THROW(tasks.wait(), std::runtime_error);
      }
    });
}

/// Halves work until it is small.
void add_up(std::size_t begin, std::size_t end, std::atomic<std::size_t>& sum) {
  if (end - begin < 4) {
    while (begin < end) sum += begin++;
    return;
  }
  const std::size_t middle = (begin + end) / 2;
  in_parallel([&] { add_up(begin, middle, sum); }, [&] { add_up(middle, end, sum); });
}

TEST(Threads, WorkWithinWorkEnds) {
  for (const int threads : {2, 4, 0})
    on_threads(threads, [] {
      std::atomic<std::size_t> sum = 0;
      parallel_for(20, [&](std::size_t) {
        add_up(0, 1000, sum);
        TaskGroup tasks;
        for (std::size_t i = 0; i < 10; ++i) tasks.run([&, i] { add_up(0, 10 * i, sum); });
        tasks.wait();
      });
      std::size_t expected = 499'500;
      for (std::size_t i = 0; i < 10; ++i)
        for (std::size_t k = 0; k < 10 * i; ++k) expected += k;
      EXPECT_EQ(sum, 20 * expected);
    });
}

TEST(Threads, CallersAtTheSameTime) {
  std::atomic<std::size_t> sum = 0;
  std::vector<std::thread> callers;
  for (int i = 0; i < 3; ++i)
    callers.emplace_back([&] {
      for (int time = 0; time < 20; ++time) on_threads(3, [&] { add_up(0, 500, sum); });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 60U * 124'750);
}

TEST(Threads, AnExceptionWaitsForTheTasksOfAGroup) {
  for (int time = 0; time < 20; ++time) {
    std::atomic<int> running = 0;
    const auto fail = [&] {
      TaskGroup tasks;
      for (int i = 0; i < 100; ++i)
        tasks.run([&] {
          ++running;
          std::this_thread::sleep_for(std::chrono::microseconds(100));
          --running;
        });
      std::this_thread::sleep_for(std::chrono::microseconds(300));
      throw std::runtime_error("lost");
    };
    on_threads(4, [&] {
      EXPECT_THROW(fail(), std::runtime_error);
      EXPECT_EQ(running, 0);
    });
  }
}

TEST(Threads, AForkedProcessHasOne) {
  std::atomic<std::size_t> sum = 0;
  on_threads(2, [&] { add_up(0, 500, sum); });
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    on_threads(2, [&] { add_up(0, 500, sum); });
    _exit(effective_threads(2) == 1 && sum == 2U * 124'750 ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

/// Bytes of memory in use.
long resident() {
  long pages = 0, of_program = 0;
  std::ifstream("/proc/self/statm") >> of_program >> pages;
  return pages * sysconf(_SC_PAGESIZE);
}

TEST(Threads, ThousandsOfCallsLoseNoMemory) {
  const auto call = [] {
    on_threads(2, [] {
      TaskGroup tasks;
      tasks.run([] {});
      tasks.wait();
    });
  };
  for (int time = 0; time < 100; ++time) call();
  const long before = resident();
  for (int time = 0; time < 4000; ++time) call();
  EXPECT_LT(resident() - before, 8L << 20);  // 29 MB were lost
}

}  // namespace
}  // namespace medial
