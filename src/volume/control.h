#pragma once

#include <algorithm>
#include <cstdint>

#include "medial/volume.h"

namespace medial::volume {

/// Ends a computation early. Thrown only inside the layer.
struct Interrupted {
  Error error;
};

/// The caller's cancel flag, memory limit and progress callback. The leading thread polls it.
class Control {
 public:
  explicit Control(const VoxelOptions& options) : options_(options) {}

  bool stopped() const { return options_.cancel != nullptr && options_.cancel->load(); }

  /// Throws if the caller cancelled, or if `held_bytes` exceeds the limit.
  void check(std::uint64_t held_bytes) const {
    if (stopped()) throw Interrupted{{ErrorCode::cancelled, "cancelled", {}}};
    if (held_bytes > options_.memory)
      throw Interrupted{{ErrorCode::too_large,
                         "the grid needs more memory than was allowed: take fewer voxels or allow "
                         "more",
                         {}}};
  }
  /// Reports the share of work done, which never decreases.
  void report(double share) {
    done_ = std::max(done_, std::min(share, 1.0));
    if (options_.progress) options_.progress(done_);
  }

 private:
  const VoxelOptions& options_;
  double done_ = 0;
};

}  // namespace medial::volume
