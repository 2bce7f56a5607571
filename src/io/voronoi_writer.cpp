#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/gdal_target.h"
#include "io/geojson.h"
#include "io/picture.h"
#include "io/ring_text.h"
#include "medial/io/write.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr char diagram_formats[] = ".json .geojson .csv .wkt .svg .pdf .png .ps";

const char* name_of(SiteKind kind) {
  return kind == SiteKind::vertex ? "vertex" : kind == SiteKind::arc ? "arc" : "segment";
}

const char* name_of(const VoronoiEdge& edge) {
  return edge.frame ? "frame" : edge.spoke ? "spoke" : "edge";
}

/// A site's number, -1 for none.
std::int64_t number_of(std::uint32_t site) {
  return site == no_site ? -1 : static_cast<std::int64_t>(site);
}

/// The allowed deviation of chords, in units of the input.
double chord_of(const VoronoiItem& item, const WriteOptions& options) {
  const Box box = item.diagram.frame ? *item.diagram.frame : bounding_box(item.shape);
  return options.chord * diagonal(box);
}

/// Numbers in brackets: a row of a table.
template <class... Values>
void row(OutputStream& out, Values... values) {
  char separator = '[';
  const auto one = [&](auto value) {
    out.put(separator);
    separator = ',';
    if constexpr (std::is_enum_v<decltype(value)>) {
      out.put(static_cast<std::uint32_t>(value));
    } else {
      out.put(value);
    }
  };
  (one(values), ...);
  out.put(']');
}

/// "name":[ and what put(i) writes for each of `count`, a line each.
template <class Put>
void table(OutputStream& out, std::string_view name, std::size_t count, const Put& put) {
  out.put(",\n\"");
  out.put(name);
  out.put("\":[");
  for (std::size_t i = 0; i < count; ++i) {
    out.put(i == 0 ? "\n" : ",\n");
    put(i);
  }
  out.put(']');
}

/// An edge as a line, from node[0] or from node[1].
std::vector<Disk> line_of(const VoronoiDiagram& diagram, const VoronoiEdge& edge, double chord,
                          bool forward) {
  std::vector<Disk> line = sample_by_chord(diagram, edge, chord);
  if (!forward) std::ranges::reverse(line);
  return line;
}

/// A face as a closed ring of points; empty where the face is.
std::vector<Vec2> ring_of_face(const VoronoiDiagram& diagram, std::uint32_t k, double chord) {
  std::vector<Vec2> ring;
  const Site& site = diagram.sites[k];
  if (diagram.frame) {
    ring = face_outline(diagram, k, chord);
  } else {
    ring.push_back(site.start);
    for (const std::uint32_t e : diagram.face(k)) {
      const VoronoiEdge& edge = diagram.edges[e];
      const auto line = line_of(diagram, edge, chord, edge.site[1] == k);
      for (std::size_t p = 1; p < line.size(); ++p) ring.push_back(line[p].center);
    }
    if (site.kind == SiteKind::segment) ring.push_back(site.start);
    return ring;
  }
  if (!ring.empty()) ring.push_back(ring.front());
  return ring;
}

/// A row for each sample of an edge.
Status write_voronoi_csv(OutputStream& out, const Document<VoronoiItem>& file,
                         const WriteOptions& options, const OutputCrs& crs) {
  out.put("edge,part,left,right,x,y,r\n");
  std::uint64_t number = 0;
  for (const VoronoiItem& item : file.items) {
    const double chord = chord_of(item, options);
    for (const VoronoiEdge& edge : item.diagram.edges) {
      std::vector<Disk> line = line_of(item.diagram, edge, chord, true);
      if (Status placed = crs.transform(line); !placed) return placed;
      for (const Disk& disk : line) {
        out.put(fmt::format("{},{},{},{},", number, name_of(edge), number_of(edge.site[0]),
                            number_of(edge.site[1])));
        out.put(disk.center.x);
        out.put(',');
        out.put(disk.center.y);
        out.put(',');
        out.put(disk.radius);
        out.put('\n');
      }
      ++number;
    }
  }
  return success();
}

/// A polygon for each face, a line of text each, in the order of the sites.
Status write_voronoi_wkt(OutputStream& out, const Document<VoronoiItem>& file,
                         const WriteOptions& options, const OutputCrs& crs) {
  for (const VoronoiItem& item : file.items) {
    const double chord = chord_of(item, options);
    for (std::uint32_t k = 0; k < item.diagram.sites.size(); ++k) {
      std::vector<Vec2> ring = ring_of_face(item.diagram, k, chord);
      out.put(ring.empty() ? "POLYGON EMPTY\n" : "POLYGON (");
      if (ring.empty()) continue;
      if (Status placed = crs.transform(ring); !placed) return placed;
      put_wkt_points(out, ring);
      out.put(")\n");
    }
  }
  return success();
}

void write_voronoi_json(OutputStream& out, const Document<VoronoiItem>& file) {
  out.put("{\"medial_voronoi\":1,\n\"items\":[");
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const auto& diagram = file.items[i].diagram;
    const auto& attributes = file.items[i].attributes;
    out.put(i == 0 ? "\n" : ",\n");
    out.put("{\"method\":");
    out.put(quoted(diagram.method));
    out.put(",\"tolerance\":");
    out.put(diagram.tolerance);
    if (diagram.frame) {
      out.put(",\"frame\":");
      row(out, diagram.frame->low.x, diagram.frame->low.y, diagram.frame->high.x,
          diagram.frame->high.y);
    }
    table(out, "attributes", attributes.size(), [&](std::size_t k) {
      out.put(fmt::format("[{},{}]", quoted(attributes[k].first), quoted(attributes[k].second)));
    });
    table(out, "sites", diagram.sites.size(), [&](std::size_t k) {
      const Site& site = diagram.sites[k];
      if (site.kind == SiteKind::arc)
        row(out, site.kind, site.start.x, site.start.y, site.end.x, site.end.y, site.ring,
            site.vertex, site.bulge);
      else
        row(out, site.kind, site.start.x, site.start.y, site.end.x, site.end.y, site.ring,
            site.vertex);
    });
    table(out, "nodes", diagram.nodes.size(), [&](std::size_t k) {
      const Node& node = diagram.nodes[k];
      row(out, node.disk.center.x, node.disk.center.y, node.disk.radius, node.component, node.kind);
    });
    table(out, "edges", diagram.edges.size(), [&](std::size_t k) {
      const VoronoiEdge& edge = diagram.edges[k];
      row(out, edge.node[0], edge.node[1], number_of(edge.site[0]), number_of(edge.site[1]),
          edge.frame   ? 2
          : edge.spoke ? 1
                       : 0,
          edge.control.center.x, edge.control.center.y, edge.control.radius, edge.weight);
    });
    table(out, "faces", diagram.sites.size(), [&](std::size_t k) {
      out.put('[');
      const auto face = diagram.face(k);
      for (std::size_t j = 0; j < face.size(); ++j) {
        if (j > 0) out.put(',');
        out.put(face[j]);
      }
      out.put(']');
    });
    out.put('}');
  }
  out.put("\n]}\n");
}

Status write_voronoi_geojson(OutputStream& out, const Document<VoronoiItem>& file,
                             const WriteOptions& options, const OutputCrs& crs) {
  GeojsonCollection collection(out, {}, crs.reference());
  const auto number = [&](std::string_view key, auto value) {
    collection.member(key);
    out.put(value);
  };
  const auto text = [&](std::string_view key, const char* value) {
    collection.member(key);
    put_quoted(out, value);
  };
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const VoronoiDiagram& diagram = file.items[i].diagram;
    const double chord = chord_of(file.items[i], options);
    for (std::uint32_t k = 0; k < diagram.sites.size(); ++k) {
      const Site& site = diagram.sites[k];
      std::vector<Vec2> ring = ring_of_face(diagram, k, chord);
      if (ring.empty()) continue;
      if (Status placed = crs.transform(ring); !placed) return placed;
      collection.start();
      number("\"feature\"", i);
      text("\"part\"", "face");
      number("\"site\"", k);
      text("\"kind\"", name_of(site.kind));
      number("\"ring\"", site.ring);
      number("\"vertex\"", site.vertex);
      collection.geometry("Polygon");
      out.put('[');
      put_geojson_points(out, ring);
      out.put(']');
      collection.end();
    }
    for (const VoronoiEdge& edge : diagram.edges) {
      std::vector<Vec2> line;
      for (const Disk& disk : line_of(diagram, edge, chord, true)) line.push_back(disk.center);
      if (Status placed = crs.transform(line); !placed) return placed;
      collection.start();
      number("\"feature\"", i);
      text("\"part\"", name_of(edge));
      number("\"left\"", number_of(edge.site[0]));
      number("\"right\"", number_of(edge.site[1]));
      number("\"radius_from\"", diagram.nodes[edge.node[0]].disk.radius);
      number("\"radius_to\"", diagram.nodes[edge.node[1]].disk.radius);
      collection.geometry("LineString");
      put_geojson_points(out, line);
      collection.end();
    }
  }
  collection.finish();
  return success();
}

Status put_voronoi(OutputStream& out, const std::string& format, const Document<VoronoiItem>& file,
                   const WriteOptions& options) {
  if (format == "json") {
    write_voronoi_json(out, file);
    return success();
  }
  const Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return crs.error();
  if (format == "geojson") return write_voronoi_geojson(out, file, options, *crs);
  if (format == "csv") return write_voronoi_csv(out, file, options, *crs);
  if (format == "wkt") return write_voronoi_wkt(out, file, options, *crs);
  return write_voronoi_picture(out, format, file, options);
}

}  // namespace

std::string known_voronoi_formats() { return diagram_formats; }

Status write_voronoi(const std::string& path, const std::string& format,
                     const Document<VoronoiItem>& file, const WriteOptions& options) {
  const Result<std::string> known = output_format(path, format, "json", diagram_formats);
  if (!known) return known.error();
  return write_whole(
      path, [&](OutputStream& out) -> Status { return put_voronoi(out, *known, file, options); });
}

}  // namespace medial::io
