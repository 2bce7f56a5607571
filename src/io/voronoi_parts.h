#pragma once

// What the writers of Voronoi diagrams share.

#include <vector>

#include "medial/io/write.h"

namespace medial::io {

const char* name_of(SiteKind kind);
const char* name_of(const VoronoiEdge& edge);

/// A site's number, -1 for none.
std::int64_t number_of(std::uint32_t site);

/// The allowed deviation of chords, in units of the input.
double chord_of(const VoronoiItem& item, const WriteOptions& options);

/// A face as a closed ring of points; empty where the face is.
std::vector<Vec2> ring_of_face(const VoronoiDiagram& diagram, std::uint32_t k, double chord);

}  // namespace medial::io
