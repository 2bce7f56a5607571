#include "io/voronoi_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "io/format_name.h"
#include "io/guarded.h"
#include "io/picture.h"
#include "io/place.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr std::array<std::string_view, 6> formats{"json", "geojson", "svg", "pdf", "png", "ps"};

std::string quoted(const std::string& text) {
  using Json = nlohmann::json;
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

const char* name_of(SiteKind kind) { return kind == SiteKind::vertex ? "vertex" : "segment"; }

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
  MedialAxis one;  // what samples an edge asks for
  one.nodes = {diagram.nodes[edge.node[0]], diagram.nodes[edge.node[1]]};
  one.sites = {diagram.sites[edge.site[0]], diagram.sites[edge.site[1]]};
  Edge own = edge;
  own.node = {0, 1};
  own.site = {0, 1};
  std::vector<Disk> line = sample_by_chord(one, own, chord);
  if (!forward) std::ranges::reverse(line);
  return line;
}

/// Features of a GeoJSON collection, one by one.
class Features {
 public:
  explicit Features(OutputStream& out) : out_(out) {
    out_.put("{\"type\":\"FeatureCollection\",\"features\":[");
  }
  void start(const char* geometry) {
    out_.put(first_ ? "\n" : ",\n");
    first_ = false;
    out_.put(fmt::format("{{\"type\":\"Feature\",\"geometry\":{{\"type\":\"{}\",\"coordinates\":",
                         geometry));
  }
  void properties(const std::string& text) {
    out_.put(fmt::format("}},\"properties\":{{{}}}}}", text));
  }
  void finish() { out_.put("\n]}\n"); }

 private:
  OutputStream& out_;
  bool first_ = true;
};

Status write_stream(OutputStream& out, const std::string& format, const VoronoiFile& file,
                    const WriteOptions& options) {
  if (format == "json") {
    write_voronoi_json(out, file);
  } else if (format == "geojson") {
    write_voronoi_geojson(out, file, options);
  } else {
    Status drawn = write_voronoi_picture(out, format, file, options);
    if (!drawn) return drawn;
  }
  return out.finish();
}

Status write_any(const std::string& path, const std::string& option, const VoronoiFile& file,
                 const WriteOptions& options) {
  const std::string format = path == "-" && option.empty() ? "json" : format_name(path, option);
  if (std::ranges::find(formats, format) == formats.end())
    return Error{ErrorCode::unsupported,
                 fmt::format("'{}' is no format for Voronoi diagrams; known are {}", format,
                             known_voronoi_formats()),
                 in_file(path)};
  if (is_stream(path)) {
    Result<OutputStream> out = OutputStream::open(path);
    if (!out) return out.error();
    return write_stream(*out, format, file, options);
  }
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return pending.error();
  Result<OutputStream> out = OutputStream::open(pending->path());
  if (!out) return out.error();
  Status written = write_stream(*out, format, file, options);
  if (!written) return written;
  return pending->commit();
}

}  // namespace

void write_voronoi_json(OutputStream& out, const VoronoiFile& file) {
  out.put("{\"medial_voronoi\":1,\n\"items\":[");
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const auto& [shape, diagram, attributes] = file.items[i];
    out.put(i == 0 ? "\n" : ",\n");
    out.put("{\"method\":");
    out.put(quoted(diagram.method));
    out.put(",\"tolerance\":");
    out.put(diagram.tolerance);
    table(out, "attributes", attributes.size(), [&](std::size_t k) {
      out.put(fmt::format("[{},{}]", quoted(attributes[k].first), quoted(attributes[k].second)));
    });
    table(out, "sites", diagram.sites.size(), [&](std::size_t k) {
      const Site& site = diagram.sites[k];
      row(out, site.kind, site.start.x, site.start.y, site.end.x, site.end.y, site.ring,
          site.vertex);
    });
    table(out, "nodes", diagram.nodes.size(), [&](std::size_t k) {
      const Node& node = diagram.nodes[k];
      row(out, node.disk.center.x, node.disk.center.y, node.disk.radius, node.component, node.kind);
    });
    table(out, "edges", diagram.edges.size(), [&](std::size_t k) {
      const VoronoiEdge& edge = diagram.edges[k];
      row(out, edge.node[0], edge.node[1], edge.site[0], edge.site[1], edge.spoke ? 1 : 0,
          edge.control.center.x, edge.control.center.y, edge.control.radius, edge.weight);
    });
    table(out, "faces", diagram.sites.size(), [&](std::size_t k) {
      char separator = '[';
      for (const std::uint32_t edge : diagram.face(k)) {
        out.put(separator);
        out.put(edge);
        separator = ',';
      }
      out.put(']');
    });
    out.put('}');
  }
  out.put("\n]}\n");
}

void write_voronoi_geojson(OutputStream& out, const VoronoiFile& file,
                           const WriteOptions& options) {
  Features features(out);
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const VoronoiDiagram& diagram = file.items[i].diagram;
    const double chord = options.chord * diagonal(bounding_box(file.items[i].shape));
    for (std::uint32_t k = 0; k < diagram.sites.size(); ++k) {
      const Site& site = diagram.sites[k];
      features.start("Polygon");
      out.put("[[");
      row(out, site.start.x, site.start.y);
      for (const std::uint32_t e : diagram.face(k)) {
        const VoronoiEdge& edge = diagram.edges[e];
        const auto line = line_of(diagram, edge, chord, edge.site[1] == k);
        for (std::size_t p = 1; p < line.size(); ++p) {
          out.put(',');
          row(out, line[p].center.x, line[p].center.y);
        }
      }
      if (site.kind == SiteKind::segment) {
        out.put(',');
        row(out, site.start.x, site.start.y);
      }
      out.put("]]");
      features.properties(
          fmt::format("\"feature\":{},\"part\":\"face\",\"site\":{},\"kind\":\"{}\",\"ring\":{},"
                      "\"vertex\":{}",
                      i, k, name_of(site.kind), site.ring, site.vertex));
    }
    for (const VoronoiEdge& edge : diagram.edges) {
      features.start("LineString");
      char separator = '[';
      for (const Disk& disk : line_of(diagram, edge, chord, true)) {
        out.put(separator);
        row(out, disk.center.x, disk.center.y);
        separator = ',';
      }
      out.put(']');
      features.properties(fmt::format(
          "\"feature\":{},\"part\":\"{}\",\"left\":{},\"right\":{},\"radius_from\":{},"
          "\"radius_to\":{}",
          i, edge.spoke ? "spoke" : "edge", edge.site[0], edge.site[1],
          diagram.nodes[edge.node[0]].disk.radius, diagram.nodes[edge.node[1]].disk.radius));
    }
  }
  features.finish();
}

std::string known_voronoi_formats() { return fmt::format(".{}", fmt::join(formats, " .")); }

Status write_voronoi(const std::string& path, const std::string& format, const VoronoiFile& file,
                     const WriteOptions& options) {
  return guarded(path, [&] { return write_any(path, format, file, options); });
}

}  // namespace medial::io
