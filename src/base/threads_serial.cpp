#include <utility>

#include "base/pipeline.h"
#include "base/threads.h"

namespace medial {

int effective_threads(int /*requested*/) { return 1; }

void allow_startable_threads(int /*requested*/) {}

namespace threads {

void run_ranges(std::size_t count, std::size_t /*grain*/,
                FunctionRef<std::size_t, std::size_t> work) {
  if (count > 0) work(0, count);
}

void run_both(FunctionRef<> first, FunctionRef<> second) {
  first();
  second();
}

void run_on(int /*requested*/, FunctionRef<> work) { work(); }

}  // namespace threads

struct TaskGroup::Tasks {
  std::vector<std::function<void()>> waiting;
};

TaskGroup::TaskGroup() = default;
TaskGroup::~TaskGroup() = default;

void TaskGroup::run(std::function<void()> task) {
  if (!tasks_) tasks_ = std::make_unique<Tasks>();
  tasks_->waiting.push_back(std::move(task));
}

void TaskGroup::wait() {
  while (tasks_ && !tasks_->waiting.empty()) {
    const std::function<void()> next = std::move(tasks_->waiting.back());
    tasks_->waiting.pop_back();
    next();
  }
}

void run_pipeline(int /*requested*/, std::size_t /*window*/,
                  const std::function<std::shared_ptr<void>()>& next,
                  std::span<const PipelineStage> stages) {
  run_in_turn(next, stages);
}

}  // namespace medial
