#include "io/json_rows.h"
#include "io/native.h"
#include "medial/io/read.h"

namespace medial::io {
namespace {

constexpr int newest_version = 1;

Site read_site(Row row) {
  Site site;
  site.kind = site_kind(row.index<std::uint32_t>());
  site.start = row.point();
  site.end = row.point();
  site.ring = row.index<std::uint32_t>();
  site.vertex = row.index<std::uint32_t>();
  if (site.kind == SiteKind::arc) site.bulge = row.real();
  row.end();
  return site;
}

Node read_node(Row row) {
  Node node;
  node.disk.center = row.point();
  node.disk.radius = row.real();
  node.component = row.index<std::uint32_t>();
  node.kind = node_kind(row.index<std::uint32_t>());
  row.end();
  return node;
}

VoronoiEdge read_edge(Row row) {
  VoronoiEdge edge;
  edge.node[0] = row.index<std::uint32_t>();
  edge.node[1] = row.index<std::uint32_t>();
  edge.site[0] = row.index_or_none();
  edge.site[1] = row.index_or_none();
  const auto part = row.index<std::uint32_t>();
  demand(part <= 2, "an unknown part of a Voronoi diagram");
  edge.spoke = part == 1;
  edge.frame = part == 2;
  edge.control.center = row.point();
  edge.control.radius = row.real();
  edge.weight = row.real();
  row.end();
  return edge;
}

/// That every index is in its range, and that no radius or weight is impossible.
void check(const VoronoiDiagram& diagram) {
  const auto sites = diagram.sites.size(), nodes = diagram.nodes.size();
  for (const Node& node : diagram.nodes)
    demand(node.disk.radius >= 0, "the radius of a node is negative");
  for (const VoronoiEdge& edge : diagram.edges) {
    for (const std::uint32_t node : edge.node) demand(node < nodes, "there is no such node");
    demand(edge.site[0] < sites, "there is no such site");
    demand(edge.frame ? edge.site[1] == no_site : edge.site[1] < sites, "there is no such site");
    demand(edge.weight > 0, "a weight is not positive");
  }
  for (const std::uint32_t edge : diagram.face_edges)
    demand(edge < diagram.edges.size(), "there is no such edge");
  demand(diagram.face_begin.size() == sites + 1, "there is not one face for each site");
}

VoronoiItem read_item(json::value value) {
  VoronoiItem item;
  VoronoiDiagram& diagram = item.diagram;
  for (json::field field : value.get_object()) {
    const std::string_view key = field.unescaped_key();
    json::value content = field.value();
    if (key == "method") {
      diagram.method = text_of(content);
    } else if (key == "tolerance") {
      diagram.tolerance = number(content);
      demand(diagram.tolerance >= 0, "the tolerance is negative");
    } else if (key == "frame") {
      Row row(content);
      const Vec2 low = row.point();
      diagram.frame = Box{low, row.point()};
      row.end();
    } else if (key == "attributes") {
      read_attributes(content, "an attribute is a name and a value", item.attributes);
    } else if (key == "sites") {
      for_each(content, [&](json::value one) { diagram.sites.push_back(read_site(Row(one))); });
    } else if (key == "nodes") {
      for_each(content, [&](json::value one) { diagram.nodes.push_back(read_node(Row(one))); });
    } else if (key == "edges") {
      for_each(content, [&](json::value one) { diagram.edges.push_back(read_edge(Row(one))); });
    } else if (key == "faces") {
      diagram.face_begin.push_back(0);
      for_each(content, [&](json::value face) {
        for_each(face, [&](json::value edge) {
          diagram.face_edges.push_back(integer<std::uint32_t>(edge));
        });
        diagram.face_begin.push_back(static_cast<std::uint32_t>(diagram.face_edges.size()));
      });
    }
  }
  check(diagram);
  return item;
}

Document<VoronoiItem> read_file(json::document& document) {
  Document<VoronoiItem> file;
  bool versioned = false;
  for (json::field field : document.get_object()) {
    const std::string_view key = field.unescaped_key();
    json::value content = field.value();
    if (key == "medial_voronoi") {
      const auto version = integer<std::uint64_t>(content);
      if (version > newest_version) throw TooNew{version};
      versioned = true;
    } else if (key == "items") {
      for_each(content, [&](json::value item) { file.items.push_back(read_item(item)); });
    }
  }
  demand(document.current_location().error() != simdjson::SUCCESS,
         "something follows the last bracket");
  demand(versioned, "the version is missing");
  return file;
}

}  // namespace

Result<Document<VoronoiItem>> read_voronoi(TextSource& source) {
  return read_document(source, newest_version, read_file);
}

}  // namespace medial::io
