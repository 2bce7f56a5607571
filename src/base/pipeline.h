#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace medial {

/// A stage that all tasks pass through, either in order, one at a time, or several at once.
struct PipelineStage {
  bool in_order;
  std::function<void(void* task)> run;
};

/// Passes tasks through stages on effective_threads(requested) threads. `next` makes one task after
/// another until it returns null. At most `window` tasks exist at a time: tasks behind a slow one
/// continue until the window is full.
void run_pipeline(int requested, std::size_t window,
                  const std::function<std::shared_ptr<void>()>& next,
                  std::span<const PipelineStage> stages);

/// The same, one task at a time, on the caller's thread.
inline void run_in_turn(const std::function<std::shared_ptr<void>()>& next,
                        std::span<const PipelineStage> stages) {
  while (const std::shared_ptr<void> task = next())
    for (const PipelineStage& stage : stages) stage.run(task.get());
}

}  // namespace medial
