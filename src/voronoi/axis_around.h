#pragma once

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// The axis of the region around a planar graph in an enclosure. `surroundings` is around(planar
/// graph, enclosure). Uses the engine `disks`, whatever the options' method. The ring of a site
/// that is a point of the planar graph is the point; the vertex of a site that is an edge is the
/// half-edge; the ring of the enclosure's sites is no_index. `divided`: divides edges so that they
/// turn by at most a quarter around a point.
/// Errors: invalid_option, empty, too_large, unsupported (coordinates), cancelled, internal.
Result<MedialAxis> axis_around(const PlanarGraph& planar_graph, const Shape& surroundings,
                               const Options& options, bool divided = true);

}  // namespace medial
