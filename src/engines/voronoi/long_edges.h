#pragma once

#include <array>
#include <cstdint>

#include "engines/voronoi/clip.h"
#include "medial/axis.h"

namespace medial::voronoi {

/// Divides edges between a point and an arc of an axis around a soup. Around a point next to an arc
/// an ellipse can be more than half of one, which no rational quadratic with a positive weight is:
/// pieces that turn by no more than a quarter around the point are. A parabola can turn by almost
/// all around its focus, too; it is divided where `parabolas` asks for that. O(edges). Throws
/// std::runtime_error where rounding leaves no disk in between.
void split_long_edges(MedialAxis& axis, bool parabolas);

/// Sets the control point of an edge between two sites of an axis, or of a part of one, from its
/// ends. (A part of a long curve would have that one's rounding.)
void take_control(const MedialAxis& axis, std::array<std::uint32_t, 2> own, ConicEdge& part);

}  // namespace medial::voronoi
