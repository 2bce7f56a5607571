#include "base/pipeline.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace medial {
namespace {

struct Number {
  int value;
};

TEST(Pipeline, TasksArriveInOrderAndNeverMoreThanTheWindow) {
  constexpr int count = 200;
  constexpr std::size_t window = 5;
  for (const int threads : {1, 2, 4}) {
    int made = 0;
    std::atomic<int> under_way = 0, most = 0;
    std::vector<int> arrived;
    const std::vector<PipelineStage> stages{
        {false,
         [&](void* task) {
           const int now = ++under_way;
           for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
           }
           if (static_cast<Number*>(task)->value == 0)  // a slow one
             std::this_thread::sleep_for(std::chrono::milliseconds(20));
         }},
        {true, [&](void* task) {
           arrived.push_back(static_cast<Number*>(task)->value);
           --under_way;
         }}};
    run_pipeline(
        threads, window,
        [&]() -> std::shared_ptr<void> {
          return made < count ? std::make_shared<Number>(Number{made++}) : nullptr;
        },
        stages);
    ASSERT_EQ(arrived.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) EXPECT_EQ(arrived[static_cast<std::size_t>(i)], i);
    EXPECT_LE(most.load(), static_cast<int>(window));
  }
}

TEST(Pipeline, OneThreadIsTheCaller) {
  std::set<std::thread::id> seen;
  int made = 0;
  const std::vector<PipelineStage> stages{
      {false, [&seen](void*) { seen.insert(std::this_thread::get_id()); }}};
  run_pipeline(
      1, 8,
      [&]() -> std::shared_ptr<void> {
        return made < 200 ? std::make_shared<Number>(Number{made++}) : nullptr;
      },
      stages);
  EXPECT_EQ(made, 200);
  EXPECT_EQ(seen, std::set{std::this_thread::get_id()});
}

TEST(Pipeline, AnExceptionReachesTheCaller) {
  int made = 0;
  const std::vector<PipelineStage> stages{{false, [](void* task) {
                                             if (static_cast<Number*>(task)->value == 3)
                                               throw std::runtime_error("three");
                                           }}};
  EXPECT_THROW(run_pipeline(
                   2, 4,
                   [&]() -> std::shared_ptr<void> {
                     return made < 50 ? std::make_shared<Number>(Number{made++}) : nullptr;
                   },
                   stages),
               std::runtime_error);
}

}  // namespace
}  // namespace medial
