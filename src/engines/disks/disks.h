#pragma once

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/shape.h"

namespace medial::disks {

/// The engine `disks` (docs/disks.md): sites, holes connected, tree, walk, graph. Requires what
/// compute() has checked. Cut short, with any content, where the caller cancels.
MedialAxis run(const Shape& shape, const Options& options);

}  // namespace medial::disks
