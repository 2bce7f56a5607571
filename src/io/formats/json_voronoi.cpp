#include "io/formats/json.h"
#include "io/formats/json_rows.h"
#include "io/formats/json_text.h"
#include "io/voronoi_parts.h"

namespace medial::io {
namespace {

constexpr int newest_version = 1;

Site read_voronoi_site(json::value value) {
  Row row(value);
  const SiteKind kind = site_kind(row.index<std::uint32_t>());
  const double first = row.real();
  return read_site(row, kind, first);
}

VoronoiEdge read_voronoi_edge(json::value value) {
  Row row(value);
  VoronoiEdge edge;
  edge.node[0] = row.index<std::uint32_t>();
  edge.node[1] = row.index<std::uint32_t>();
  edge.site[0] = row.index_or_none();
  edge.site[1] = row.index_or_none();
  const auto part = row.index<std::uint32_t>();
  demand(part <= 2, "an unknown part of a Voronoi diagram");
  edge.spoke = part == 1;
  edge.on_enclosure = part == 2;
  edge.control.center = row.point();
  edge.control.radius = row.real();
  edge.weight = row.real();
  row.end();
  return edge;
}

/// That every index is in its range, and that no weight is impossible.
void check(const VoronoiDiagram& diagram) {
  const auto sites = diagram.sites.size(), nodes = diagram.nodes.size();
  for (const VoronoiEdge& edge : diagram.edges) {
    for (const std::uint32_t node : edge.node) demand(node < nodes, "there is no such node");
    demand(edge.site[0] < sites, "there is no such site");
    demand(edge.on_enclosure ? edge.site[1] == no_site : edge.site[1] < sites,
           "there is no such site");
    demand(edge.weight > 0, "a weight is not positive");
  }
  for (const std::uint32_t edge : diagram.face_edges)
    demand(edge < diagram.edges.size(), "there is no such edge");
  demand(diagram.face_begin.size() == sites + 1, "there is not one face for each site");
}

void read_faces(json::value value, VoronoiDiagram& diagram) {
  diagram.face_begin.push_back(0);
  for_each(value, [&](json::value face) {
    append_all(face, diagram.face_edges, integer<std::uint32_t>);
    diagram.face_begin.push_back(static_cast<std::uint32_t>(diagram.face_edges.size()));
  });
}

VoronoiItem read_voronoi_item(json::value value) {
  VoronoiItem item;
  VoronoiDiagram& diagram = item.diagram;
  read_members(
      value.get_object(), Member{"method", [&](json::value v) { diagram.method = text_of(v); }},
      Member{"tolerance",
             [&](json::value v) {
               diagram.tolerance = number(v);
               demand(diagram.tolerance >= 0, "the tolerance is negative");
             }},
      Member{"frame",
             [&](json::value v) {
               Row row(v);
               const Vec2 low = row.point();
               diagram.enclosure = Box{low, row.point()};
               row.end();
             }},
      Member{"attributes",
             [&](json::value v) {
               read_attributes(v, "an attribute is a name and a value", item.attributes);
             }},
      Member{"sites", [&](json::value v) { append_all(v, diagram.sites, read_voronoi_site); }},
      Member{"nodes", [&](json::value v) { append_all(v, diagram.nodes, read_node); }},
      Member{"edges", [&](json::value v) { append_all(v, diagram.edges, read_voronoi_edge); }},
      Member{"faces", [&](json::value v) { read_faces(v, diagram); }});
  check(diagram);
  return item;
}

Document<VoronoiItem> read_voronoi_file(json::document& document) {
  Document<VoronoiItem> file;
  file.items =
      read_items<VoronoiItem>(document, "medial_voronoi", newest_version, read_voronoi_item);
  return file;
}

void put_diagram(OutputStream& out, const VoronoiItem& item) {
  const VoronoiDiagram& diagram = item.diagram;
  put_member(out, "{\"method\":", diagram.method);
  put_member(out, ",\"tolerance\":", diagram.tolerance);
  if (const auto& box = diagram.enclosure) {
    out.put(",\"frame\":");
    put_row(out, box->low.x, box->low.y, box->high.x, box->high.y);
  }
  out.put(",\n\"attributes\":");
  put_lines(out, item.attributes, [&](const auto& attribute) {
    put_list(out, std::array{attribute.first, attribute.second},
             [&](const std::string& text) { put_quoted(out, text); });
  });
  out.put(",\n\"sites\":");
  put_lines(out, diagram.sites, [&](const Site& site) { put_site(out, site); });
  out.put(",\n\"nodes\":");
  put_lines(out, diagram.nodes, [&](const Node& node) { put_node(out, node); });
  out.put(",\n\"edges\":");
  put_lines(out, diagram.edges, [&](const VoronoiEdge& edge) {
    const int part = edge.on_enclosure ? 2 : edge.spoke ? 1 : 0;
    put_row(out, edge.node[0], edge.node[1], number_of(edge.site[0]), number_of(edge.site[1]), part,
            edge.control.center.x, edge.control.center.y, edge.control.radius, edge.weight);
  });
  out.put(",\n\"faces\":");
  put_lines(out, numbers_below(diagram.sites.size()), [&](std::size_t site) {
    put_list(out, diagram.face(site), [&](std::uint32_t edge) { out.put(edge); });
  });
  out.put('}');
}

}  // namespace

bool begins_like_voronoi(std::string_view text) {
  return begins_with_member(text, "\"medial_voronoi\"");
}

const char* text_without_shape(std::string_view text) {
  if (begins_like_voronoi(text))
    return "this is a Voronoi diagram, which `medial verify` reads: medial verify INPUT FILE";
  if (begins_with_member(text, "\"medial_offsets\""))
    return "this is the .json of `medial offset`, which no command reads; .geojson can be read "
           "again";
  if (begins_with_member(text, "\"medial_features\""))
    return "this is the .json of `medial features`, which no command reads";
  return nullptr;
}

Result<Document<VoronoiItem>> read_voronoi(TextSource& source) {
  return read_document(source, newest_version, read_voronoi_file);
}

Status write_json(Target& target, const VoronoiOutput& output) {
  target.out->put("{\"medial_voronoi\":1");
  put_unit(target);
  target.out->put(",\n\"items\":");
  put_items(*target.out, output.document.items,
            [&](const VoronoiItem& item) { put_diagram(*target.out, item); });
  return success();
}

}  // namespace medial::io
