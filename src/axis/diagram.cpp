#include <algorithm>

#include "base/compat.h"
#include "medial/axis.h"
#include "medial/query.h"

namespace medial {

std::vector<Disk> sample_by_chord(const VoronoiDiagram& diagram, const VoronoiEdge& edge,
                                  double chord) {
  MedialAxis one;  // for sample_by_chord()
  one.nodes = {diagram.nodes[edge.node[0]], diagram.nodes[edge.node[1]]};
  Edge own = edge;
  own.node = {0, 1};
  return sample_by_chord(one, own, chord);
}

std::vector<Vec2> face_outline(const VoronoiDiagram& diagram, std::size_t site, double chord) {
  std::vector<Vec2> outline;
  for (const std::uint32_t e : diagram.face(site)) {
    const VoronoiEdge& edge = diagram.edges[e];
    std::vector<Disk> line = sample_by_chord(diagram, edge, chord);
    if (edge.site[1] != site) ranges::reverse(line);
    // Each edge ends where the next one begins.
    for (std::size_t i = 0; i + 1 < line.size(); ++i) outline.push_back(line[i].center);
  }
  ranges::reverse(outline);
  return outline;
}

}  // namespace medial
