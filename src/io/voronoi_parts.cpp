#include "io/voronoi_parts.h"

#include <algorithm>

#include "medial/query.h"

namespace medial::io {

const char* name_of(SiteKind kind) {
  return kind == SiteKind::vertex ? "vertex" : kind == SiteKind::arc ? "arc" : "segment";
}

const char* name_of(const VoronoiEdge& edge) {
  return edge.on_enclosure ? "frame" : edge.spoke ? "spoke" : "edge";
}

std::int64_t number_of(std::uint32_t site) {
  return site == no_site ? -1 : static_cast<std::int64_t>(site);
}

double chord_of(const VoronoiItem& item, const WriteOptions& options) {
  const Box box = item.diagram.enclosure ? *item.diagram.enclosure : bounding_box(item.shape);
  return options.chord * diagonal(box);
}

std::vector<Vec2> ring_of_face(const VoronoiDiagram& diagram, std::uint32_t k, double chord) {
  std::vector<Vec2> ring;
  if (diagram.enclosure) {
    ring = face_outline(diagram, k, chord);
    if (!ring.empty()) ring.push_back(ring.front());
    return ring;
  }
  const Site& site = diagram.sites[k];
  ring.push_back(site.start);
  for (const std::uint32_t e : diagram.face(k)) {
    const VoronoiEdge& edge = diagram.edges[e];
    std::vector<Disk> line = sample_by_chord(diagram, edge, chord);
    if (edge.site[1] != k) std::ranges::reverse(line);
    for (std::size_t p = 1; p < line.size(); ++p) ring.push_back(line[p].center);
  }
  if (site.kind() == SiteKind::segment) ring.push_back(site.start);
  return ring;
}

}  // namespace medial::io
