#include <algorithm>

#include "base/runs.h"
#include "medial/image.h"

namespace medial {
namespace {

struct Run {
  std::int64_t begin;
  std::int64_t end;
};

/// Sets of runs that touch each other.
class Sets {
 public:
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  /// Whether the two were different sets until now.
  bool unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Topology topology(const Image& image) {
  // Runs, and places where runs of neighbouring rows touch, are a graph: its parts are the
  // components. A bounded face of it is a hole; where two runs touch there is just one place.
  Topology result;
  Sets sets;
  std::uint64_t touching = 0, runs = 0;
  std::vector<Run> above, here;
  std::uint32_t above_first = 0, here_first = 0;
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    std::swap(above, here);
    above_first = here_first;
    here.clear();
    here_first = static_cast<std::uint32_t>(runs);
    std::size_t k = 0;
    for_each_run(image.row(y), image.width(), [&](std::int64_t begin, std::int64_t end) {
      const std::uint32_t self = sets.add();
      ++runs;
      ++result.components;
      here.push_back({begin, end});
      while (k < above.size() && above[k].end < begin) ++k;
      for (std::size_t i = k; i < above.size() && above[i].begin <= end; ++i) {
        ++touching;
        if (sets.unite(above_first + static_cast<std::uint32_t>(i), self)) --result.components;
      }
    });
  }
  result.holes = result.components + touching - runs;
  return result;
}

}  // namespace medial
