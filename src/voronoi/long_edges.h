#pragma once

#include <vector>

#include "medial/axis.h"
#include "medial/error.h"
#include "voronoi/clip.h"

namespace medial::voronoi {

/// Divides edges between a point and an arc of an axis around a planar graph: edges (Edge or
/// VoronoiEdge) that stand apart from it. Around a point next to an arc an ellipse can be more than
/// half of one, which no rational quadratic with a positive weight is: pieces that turn by no more
/// than a quarter around the point are. A parabola can turn by almost all around its focus, too; it
/// is divided where `parabolas` asks for that. O(edges). Error: internal, where rounding leaves
/// no disk in between.
template <class E>
Status split_long_edges(MedialAxis& axis, std::vector<E>& edges, bool parabolas);

/// Sets the control point of an edge between the sites on its left and right, or of a part of one,
/// from its ends. (A part of a long curve would have that one's rounding.)
void take_control(const Site& left, const Site& right, ConicEdge& part);

}  // namespace medial::voronoi
