#include "medial/voronoi.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "io/pictures/pictures.h"

namespace medial::io {

namespace {

constexpr double hue_step = 0.618033988749895;  // the golden section: neighbours differ

/// A light colour of this hue in [0, 1).
Color pastel(double hue) {
  constexpr double darkest = 0.72;
  const auto part = [&](double shift) {
    const double wave = 0.5 + 0.5 * std::cos(2 * std::numbers::pi * (hue - shift));
    return darkest + (1 - darkest) * wave;
  };
  return {part(0), part(1.0 / 3), part(2.0 / 3)};
}

bool runs_straight(const VoronoiDiagram& diagram, const VoronoiEdge& edge) {
  if (edge.spoke || edge.on_enclosure) return true;
  const SiteKind kind = diagram.sites[edge.site[0]].kind();
  return kind == diagram.sites[edge.site[1]].kind() && kind != SiteKind::arc;
}

/// Goes along an edge of a diagram, from its node[0] or from its node[1].
void trace_edge(Canvas& canvas, const VoronoiDiagram& diagram, const VoronoiEdge& edge,
                bool forward) {
  const auto place = [&](std::uint32_t node) {
    return canvas.viewport()(diagram.nodes[node].disk.center);
  };
  Piece piece{place(edge.node[0]), canvas.viewport()(edge.control.center), place(edge.node[1]),
              edge.weight, runs_straight(diagram, edge)};
  if (!forward) std::swap(piece.from, piece.to);
  canvas.piece_to(piece);
}

}  // namespace

void draw_faces(Canvas& canvas, const Document<VoronoiItem>& file) {
  const Viewport& viewport = canvas.viewport();
  for (const VoronoiItem& item : file.items) {
    const VoronoiDiagram& diagram = item.diagram;
    for (std::uint32_t site = 0; site < diagram.sites.size(); ++site) {
      const bool vertex = diagram.sites[site].kind() == SiteKind::vertex;
      constexpr Color grey{0.82, 0.82, 0.84};
      canvas.color(vertex ? grey : pastel(std::fmod(hue_step * site, 1.0)));
      if (diagram.face(site).empty()) continue;
      const VoronoiEdge& first = diagram.edges[diagram.face(site).front()];
      canvas.move_to(viewport(
          diagram.enclosure ? diagram.nodes[first.node[first.site[1] == site ? 0 : 1]].disk.center
                            : diagram.sites[site].start));
      for (const std::uint32_t e : diagram.face(site))
        trace_edge(canvas, diagram, diagram.edges[e], diagram.edges[e].site[1] == site);
      canvas.close();
      canvas.fill_even_odd();
    }
  }
  canvas.color(outline_color, 0.5);
  canvas.line_width(0.5);
  for (const VoronoiItem& item : file.items) {
    for (const VoronoiEdge& edge : item.diagram.edges) {
      if (!edge.spoke) continue;
      canvas.move_to(viewport(item.diagram.nodes[edge.node[0]].disk.center));
      canvas.line_to(viewport(item.diagram.nodes[edge.node[1]].disk.center));
      canvas.count_piece(false);
    }
  }
  canvas.stroke();
}

void draw_sites(Canvas& canvas, const Document<VoronoiItem>& file) {
  const Viewport& viewport = canvas.viewport();
  canvas.color(outline_color);
  canvas.line_width(1.6);
  for (const bool points : {false, true}) {
    for (const VoronoiItem& item : file.items) {
      if (!item.diagram.enclosure) continue;
      for (const Site& site : item.diagram.sites) {
        if ((site.kind() == SiteKind::vertex) != points) continue;
        if (points) {
          canvas.dot(viewport(site.start), canvas.thickness(2));
        } else {
          canvas.move_to(viewport(site.start));
          if (site.bulge == 0)
            canvas.line_to(viewport(site.end));
          else
            canvas.arc_to({viewport(site.start), viewport(site.end), viewport.bulge(site.bulge)});
        }
        canvas.count_piece(points);
      }
    }
    points ? canvas.fill() : canvas.stroke();
  }
}

}  // namespace medial::io
