#pragma once

#include <vector>

#include "medial/axis.h"
#include "medial/error.h"
#include "voronoi/clip.h"

namespace medial::voronoi {

/// Divides edges between a point and an arc in the axis around a planar graph. The edges (Edge or
/// VoronoiEdge) are stored separately from the axis. Around a point next to an arc, an edge can be
/// more than half of an ellipse, which no rational quadratic with a positive weight can represent.
/// Pieces that turn by at most a quarter around the point are representable. A parabola can turn by
/// almost a full turn around its focus, too, and is divided if `parabolas` is set. O(edges). Error:
/// internal (rounding leaves no disk in between).
template <class E>
Status split_long_edges(MedialAxis& axis, std::vector<E>& edges, bool parabolas);

/// Computes the control point of an edge, or of a part of one, from its ends and the sites on its
/// left and right. (Subdividing a long curve would inherit its rounding errors.)
void take_control(const Site& left, const Site& right, ConicEdge& part);

}  // namespace medial::voronoi
