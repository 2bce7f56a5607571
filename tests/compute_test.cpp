// What compute() promises about its options.

#include "medial/compute.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <vector>

#include "support/generate.h"

namespace medial::test {
namespace {

TEST(Compute, IsCancelledBeforeItBegins) {
  const Shape shape = *build_shape(hole_grid(10));
  const std::atomic<bool> cancel = true;
  const auto axis = compute(shape, {.cancel = &cancel});
  ASSERT_FALSE(axis.ok());
  EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
}

TEST(Compute, IsCancelledOnTheWay) {
  const Shape shape = *build_shape(maze(100000));
  for (const int threads : {1, 4}) {
    std::atomic<bool> cancel = false;
    std::atomic<int> calls = 0;
    const auto axis = compute(shape, {.threads = threads,
                                      .progress =
                                          [&](double) {
                                            ++calls;
                                            cancel = true;
                                          },
                                      .cancel = &cancel});
    ASSERT_FALSE(axis.ok());
    EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
    EXPECT_GT(calls, 0);
  }
}

TEST(Compute, TellsItsProgress) {
  const Shape shape = *build_shape(maze(100000));
  std::mutex mutex;
  std::vector<double> shares;
  const auto axis = compute(shape, {.progress = [&](double share) {
                              const std::lock_guard lock(mutex);
                              shares.push_back(share);
                            }});
  ASSERT_TRUE(axis.ok());
  ASSERT_GT(shares.size(), 2U);
  EXPECT_EQ(shares.back(), 1);
  for (const double share : shares) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
  }
}

TEST(Compute, RefusesOptionsOutOfRange) {
  const Shape shape = *build_shape(rectangle(2, 1));
  for (const Options& options : std::vector<Options>{{.tolerance = -1},
                                                     {.tolerance = 0.1},
                                                     {.tolerance = std::nan("")},
                                                     {.threads = -1},
                                                     {.threads = 1025}}) {
    const auto axis = compute(shape, options);
    ASSERT_FALSE(axis.ok());
    EXPECT_EQ(axis.error().code, ErrorCode::invalid_option);
  }
}

}  // namespace
}  // namespace medial::test
