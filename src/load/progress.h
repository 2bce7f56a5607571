#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <utility>

namespace medial {

/// The progress of several parts of some work as one share.
class SharedProgress {
 public:
  /// `total` is the sum of the weights of all parts. Without `tell` nothing is counted.
  SharedProgress(std::function<void(double)> tell, double total)
      : tell_(std::move(tell)), total_(total) {}

  /// What a part is to call with its own share in [0, 1]. Must not outlive this.
  std::function<void(double)> part(double weight) {
    if (!tell_ || !(total_ > 0)) return {};
    auto last = std::make_shared<std::atomic<double>>(0.0);
    return [this, weight, last](double share) {
      share = std::clamp(share, 0.0, 1.0);
      const double more = weight * (share - last->exchange(share));
      // Rounding must not report an unfinished job as complete, nor more than that.
      tell_(std::clamp(done_after(more) / total_, 0.0, 1.0));
    };
  }

 private:
  /// Adds to `done_`; a loop, as fetch_add() of doubles is not in every library of C++20.
  double done_after(double more) {
    double before = done_.load();
    while (!done_.compare_exchange_weak(before, before + more)) {
    }
    return before + more;
  }

  std::function<void(double)> tell_;
  double total_;
  std::atomic<double> done_ = 0;
};

}  // namespace medial
