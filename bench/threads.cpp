// The speed of an axis on any number of cores, relative to one, by a model.
//
//     medial_bench_threads [--quick]
//
// This program has an implementation of base/threads.h of its own. It runs everything one after the
// other, and measures two things: the work, which is the processor time of all of it, and the span,
// which is that of the longest chain of parts that have to wait for each other. A scheduler that
// leaves no thread idle while there is something to do needs at most span + (work - span) / p on p
// cores (Brent 1974). What cores share, caches and memory, is not in the model. Prints a table in
// Markdown: the least of several rounds.

#include "base/threads.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

#include "axes/inputs.h"
#include "base/pipeline.h"
#include "medial/compute.h"

namespace {

constexpr int most_cores = 64;
constexpr int rounds = 5;
/// Ranges are divided no further, as a scheduler would leave them too.
constexpr std::size_t most_ranges = 8 * most_cores;

double processor_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The longest chain of work up to the place where the program is.
class Span {
 public:
  double seconds() {
    const double now = processor_seconds();
    seconds_ += now - std::exchange(last_, now);
    return seconds_;
  }
  /// The following work must wait only for the first `seconds`.
  void go_to(double seconds) {
    last_ = processor_seconds();
    seconds_ = seconds;
  }

 private:
  double seconds_ = 0;
  double last_ = processor_seconds();
};

Span span;

/// Parts that all begin at the creation of this object, and do not wait for each other.
class Fork {
 public:
  template <class Part>
  void run(const Part& part) {
    span.go_to(begin_);
    part();
    end_ = std::max(end_, span.seconds());
  }
  ~Fork() { span.go_to(end_); }

 private:
  double begin_ = span.seconds();
  double end_ = begin_;
};

}  // namespace

namespace medial {

int effective_threads(int /*requested*/) { return most_cores; }

void allow_startable_threads(int /*requested*/) {}

namespace threads {

void run_ranges(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> work) {
  if (count <= grain) return count > 0 ? work(0, count) : void();
  const std::size_t length = std::max(grain, count / most_ranges + 1);
  Fork fork;
  for (std::size_t begin = 0; begin < count; begin += length)
    fork.run([&] { work(begin, std::min(count, begin + length)); });
}

void run_both(FunctionRef<> first, FunctionRef<> second) {
  Fork fork;
  fork.run([&] { first(); });
  fork.run([&] { second(); });
}

void run_on(int /*requested*/, FunctionRef<> work) { work(); }

}  // namespace threads

struct TaskGroup::Tasks {
  std::vector<std::pair<double, std::function<void()>>> waiting;  ///< each with where it begins
};

TaskGroup::TaskGroup() : tasks_(std::make_unique<Tasks>()) {}
TaskGroup::~TaskGroup() = default;

void TaskGroup::run(std::function<void()> task) {
  tasks_->waiting.emplace_back(span.seconds(), std::move(task));
}

void TaskGroup::wait() {
  double end = span.seconds();
  while (!tasks_->waiting.empty()) {
    const auto [begin, task] = std::move(tasks_->waiting.back());
    tasks_->waiting.pop_back();
    span.go_to(begin);
    task();
    end = std::max(end, span.seconds());
  }
  span.go_to(end);
}

/// No axis asks for it.
void run_pipeline(int /*requested*/, std::size_t /*window*/,
                  const std::function<std::shared_ptr<void>()>& next,
                  std::span<const PipelineStage> stages) {
  run_in_turn(next, stages);
}

}  // namespace medial

int main(int count, char** words) {
  const bool quick = count > 1 && std::strcmp(words[1], "--quick") == 0;
  std::puts(
      "| input | vertices | work, ms | span, ms | times as fast on 2 | on 4 | on 8 | on 16 |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|--:|");
  for (const auto& input : medial::bench::inputs(quick)) {
    const auto rings = input.rings();
    if (!rings) return std::puts(medial::to_string(rings.error()).c_str()), 1;
    const auto shape = medial::build_shape(*rings);
    if (!shape) return std::puts(medial::to_string(shape.error()).c_str()), 1;
    double work = 1e9, longest = 1e9;
    for (int i = 0; i < rounds; ++i) {
      span.go_to(0);
      const double begin = processor_seconds();
      static_cast<void>(medial::compute(*shape));
      longest = std::min(longest, span.seconds());
      work = std::min(work, processor_seconds() - begin);
    }
    std::printf("| %s | %zu | %.2f | %.3f |", input.name.c_str(), shape->points.size(), 1e3 * work,
                1e3 * longest);
    for (const int cores : {2, 4, 8, 16})
      std::printf(" %.2f |", work / (longest + (work - longest) / cores));
    std::puts("");
    std::fflush(stdout);
  }
  return 0;
}
