#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/runs.h"
#include "medial/raster.h"

namespace medial {
namespace {

/// The columns [begin, end).
struct Span {
  std::int64_t begin;
  std::int64_t end;
};

}  // namespace

Topology topology(const Image& image) {
  // Runs, and places where runs of neighbouring rows touch, are a graph: its parts are the
  // components. A bounded face of it is a hole; where two runs touch there is just one place.
  Topology result;
  DisjointSets sets;
  std::uint64_t touching = 0, runs = 0;
  std::vector<Span> above, here;
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
        if (sets.join(above_first + static_cast<std::uint32_t>(i), self)) --result.components;
      }
    });
  }
  result.holes = result.components + touching - runs;
  return result;
}

}  // namespace medial
