#pragma once

#include <numeric>
#include <span>

namespace medial {

/// Of the threads that options ask for those that work on items of so many points each: one alone
/// where the others would still be starting when all is done.
template <class Asked>
int threads_of(std::span<const double> points, const Asked& options) {
  constexpr double few = 256;
  return std::accumulate(points.begin(), points.end(), 0.0) < few ? 1 : options.threads;
}

}  // namespace medial
