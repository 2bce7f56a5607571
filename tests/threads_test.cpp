#include "base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
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

}  // namespace
}  // namespace medial
