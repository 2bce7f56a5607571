#pragma once

#include <algorithm>
#include <cstdint>

#include "medial/volume.h"

namespace medial::volume {

/// What ends a computation early; thrown inside the layer only.
struct Interrupted {
  Error error;
};

/// The caller's wishes, asked now and then by the one thread that leads the computation.
class Control {
 public:
  explicit Control(const VoxelOptions& options) : options_(options) {}

  bool stopped() const { return options_.cancel != nullptr && options_.cancel->load(); }

  /// Throws if the caller asked to stop or if more is held than was allowed.
  void check(std::uint64_t held_bytes) const {
    if (stopped()) throw Interrupted{{ErrorCode::cancelled, "cancelled", {}}};
    if (held_bytes > options_.memory)
      throw Interrupted{{ErrorCode::too_large,
                         "the grid needs more memory than was allowed: take fewer voxels or allow "
                         "more",
                         {}}};
  }
  /// Reports the share of the work that is done; never less than before.
  void report(double share) {
    done_ = std::max(done_, std::min(share, 1.0));
    if (options_.progress) options_.progress(done_);
  }

 private:
  const VoxelOptions& options_;
  double done_ = 0;
};

}  // namespace medial::volume
