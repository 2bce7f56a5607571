#pragma once

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// The axis of what lies around a planar graph in an enclosure: `surroundings` is around(planar
/// graph, enclosure). By the engine `disks`, whatever the options' method. A site that is a point
/// of the planar graph has it as its ring; one that is an edge has the half-edge as its vertex; of
/// the enclosure's, the ring is no_index. `divided`: edges turn by no more than a quarter around a
/// point, with nodes in between.
/// Errors: invalid_option, empty, too_large, unsupported (coordinates), cancelled, internal.
Result<MedialAxis> axis_around(const PlanarGraph& planar_graph, const Shape& surroundings,
                               const Options& options, bool divided = true);

}  // namespace medial
