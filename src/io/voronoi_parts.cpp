#include "io/voronoi_parts.h"

#include <algorithm>

#include "medial/query.h"

namespace medial::io {

const char* name_of(const VoronoiItem& item, const Site& site) {
  if (site.kind() == SiteKind::vertex) return item.diagram.enclosure ? "point" : "vertex";
  return site.kind() == SiteKind::arc ? "arc" : "segment";
}

const char* name_of(const VoronoiEdge& edge) {
  return edge.on_enclosure ? "enclosure" : edge.spoke ? "spoke" : "edge";
}

std::int64_t number_of(std::uint32_t site) {
  return site == no_site ? -1 : static_cast<std::int64_t>(site);
}

Owner owner_of(const Document<VoronoiItem>& file, std::size_t i, const Site& site) {
  const LoosePieces& pieces = file.items[i].pieces;
  if (pieces.feature.empty()) return {file.index_of(i), &file.items[i].attributes};
  const std::uint32_t feature = pieces.feature[site.ring];
  return {pieces.features.index_of(feature), &pieces.features.items[feature]};
}

std::optional<Owner> owner_of(const Document<VoronoiItem>& file, std::size_t i,
                              const VoronoiEdge& edge) {
  const std::vector<Site>& sites = file.items[i].diagram.sites;
  const auto [left, right] = edge.site;
  const Owner owner = owner_of(file, i, sites[left != no_site ? left : right]);
  const bool alone = left == no_site || right == no_site;
  if (!alone && owner_of(file, i, sites[right]).feature != owner.feature) return std::nullopt;
  return owner;
}

std::uint64_t ring_in_feature(const VoronoiItem& item, const Site& site) {
  const std::vector<std::uint32_t>& features = item.pieces.feature;
  if (features.empty()) return site.ring;
  const auto first = std::ranges::lower_bound(features, features[site.ring]);
  return site.ring - static_cast<std::uint64_t>(first - features.begin());
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
