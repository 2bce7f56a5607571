#pragma once

// What the writers of Voronoi diagrams share.

#include <optional>
#include <vector>

#include "medial/io/write.h"

namespace medial::io {

/// Without an enclosure, vertices are reflex ones; else points of the input.
const char* name_of(const VoronoiItem& item, const Site& site);
const char* name_of(const VoronoiEdge& edge);

/// A site's number, -1 for none.
std::int64_t number_of(std::uint32_t site);

/// A feature of the input.
struct Owner {
  std::uint64_t feature = 0;  ///< its number
  const Attributes* attributes = nullptr;
};

/// Whose a site of the i-th diagram is.
Owner owner_of(const Document<VoronoiItem>& file, std::size_t i, const Site& site);
/// Whose an edge is; nobody's between two features.
std::optional<Owner> owner_of(const Document<VoronoiItem>& file, std::size_t i,
                              const VoronoiEdge& edge);
/// The ring of a site, counted in its feature.
std::uint64_t ring_in_feature(const VoronoiItem& item, const Site& site);

/// The allowed deviation of chords, in units of the input.
double chord_of(const VoronoiItem& item, const WriteOptions& options);

/// A face as a closed ring of points; empty where the face is.
std::vector<Vec2> ring_of_face(const VoronoiDiagram& diagram, std::uint32_t k, double chord);

}  // namespace medial::io
