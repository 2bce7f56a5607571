#pragma once

#include "axis/sites.h"
#include "medial/compute.h"
#include "medial/shape.h"
#include "medial/diagram.h"

namespace medial::disks {

/// The engine `disks` (docs/disks.md): sites, holes connected, tree, walk, graph. Requires what
/// compute() has checked. Cut short, with any content, where the caller cancels. An error
/// (error_of_wrong_axis) where a disk misses one of its sites by far more than rounding explains:
/// no such axis is given out. Nor is one, of disks that are the own circles of several arcs but for
/// rounding, that verify() refuses (`in_centers` tells of such disks): then it is unsupported, with
/// the place.
Result<MedialAxis> run(const Shape& shape, const Options& options, bool* in_centers = nullptr);

/// run() for what lies around a planar graph (shape/around.h): a shape whose edges may stand there
/// twice, once for each side, and with loops of one point. The axis' edges, Edge or VoronoiEdge,
/// stand in `edges`; they and the nodes leave room for a diagram's spokes and the planar graph's
/// points. It has no sites yet: `numbers` tells what they are.
template <class E>
MedialAxis run_two_sided(const Shape& shape, const Options& options, std::vector<E>& edges,
                         sites::SiteNumbers& numbers);

}  // namespace medial::disks
