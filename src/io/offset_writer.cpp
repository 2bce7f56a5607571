#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "io/canvas.h"
#include "io/gdal_target.h"
#include "io/geojson.h"
#include "io/output.h"
#include "io/ring_text.h"
#include "medial/io/offsets.h"
#ifdef MEDIAL_DXF
#include "io/dxf_drawing.h"
#endif

namespace medial::io {

namespace {

constexpr char offset_formats[] = ".json .geojson .wkt .dxf .svg .pdf .png .ps";

Box box_of(const OffsetItem& item) {
  if (!item.shape.points.empty() || item.planar_graph.points.empty())
    return bounding_box(item.shape);
  return bounding_box(item.planar_graph);
}

double chord_of(const OffsetItem& item, const WriteOptions& options) {
  double reach = diagonal(box_of(item));
  for (const OffsetRegion& region : item.offsets.regions)
    reach = std::max(reach, diagonal(box_of(item)) - 2 * region.clearance);
  return options.chord * reach;
}

void put_attributes(OutputStream& out, const Attributes& attributes) {
  for (std::size_t k = 0; k < attributes.size(); ++k)
    out.put(fmt::format("{}[{},{}]", k == 0 ? "" : ",", quoted(attributes[k].first),
                        quoted(attributes[k].second)));
}

void write_json(OutputStream& out, const Document<OffsetItem>& file) {
  out.put("{\"medial_offsets\":1,\n\"items\":[");
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const OffsetItem& item = file.items[i];
    out.put(i == 0 ? "\n{\"tolerance\":" : ",\n{\"tolerance\":");
    out.put(item.offsets.tolerance);
    out.put(",\"attributes\":[");
    put_attributes(out, item.attributes);
    out.put("],\"regions\":[");
    for (std::size_t k = 0; k < item.offsets.regions.size(); ++k) {
      const OffsetRegion& region = item.offsets.regions[k];
      out.put(k == 0 ? "\n{\"clearance\":" : ",\n{\"clearance\":");
      out.put(region.clearance);
      out.put(",\"parent\":");
      if (region.parent == no_region) {
        out.put("null");
      } else {
        out.put(region.parent);
      }
      if (!item.sources.empty()) {
        const BufferSource& source = item.sources[k];
        out.put(",\"features\":[");
        out.put(fmt::format("{}", fmt::join(source.features, ",")));
        out.put("],\"attributes\":[");
        put_attributes(out, source.attributes);
        out.put(']');
      }
      out.put(",\"rings\":[");
      for (std::size_t r = 0; r < region.rings.size(); ++r) {
        const Ring& ring = region.rings[r];
        out.put(r == 0 ? "[" : ",[");
        for (std::size_t p = 0; p < ring.points.size(); ++p) {
          out.put(p == 0 ? "[" : ",[");
          put_point(out, ring.points[p], ',');
          if (bulge_after(ring, p) != 0) {
            out.put(',');
            out.put(ring.bulges[p]);
          }
          out.put(']');
        }
        out.put(']');
      }
      out.put("]}");
    }
    out.put("]}");
  }
  out.put("\n]}\n");
}

/// Calls each(begin, end) for the regions of each clearance.
template <class Each>
void for_levels(const std::vector<OffsetRegion>& regions, const Each& each) {
  for (std::size_t begin = 0, end = 0; begin < regions.size(); begin = end) {
    while (end < regions.size() && regions[end].clearance == regions[begin].clearance) ++end;
    each(begin, end);
  }
}

/// Circular strings do not survive a projection: of longitudes and latitudes there are chords.
Status write_wkt(OutputStream& out, const Document<OffsetItem>& file, const WriteOptions& options,
                 bool chords) {
  const Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return crs.error();
  chords = chords || crs->changes_points();
  Status status = success();
  for (const OffsetItem& item : file.items) {
    const auto& regions = item.offsets.regions;
    const double chord = chord_of(item, options);
    for_levels(regions, [&](std::size_t begin, std::size_t end) {
      out.put(chords ? "MULTIPOLYGON (" : "MULTISURFACE (");
      for (std::size_t k = begin; k < end; ++k) {
        out.put(k > begin ? ", " : "");
        out.put(chords ? "(" : "CURVEPOLYGON (");
        for (std::size_t r = 0; r < regions[k].rings.size(); ++r) {
          if (r > 0) out.put(", ");
          if (!chords) {
            put_wkt_curve(out, regions[k].rings[r]);
            continue;
          }
          std::vector<Vec2> points = chords_of(regions[k].rings[r], chord);
          if (Status placed = crs->transform(points); !placed) status = std::move(placed);
          put_wkt_points(out, points);
        }
        out.put(')');
      }
      out.put(")\n");
    });
  }
  return status;
}

Status write_geojson(OutputStream& out, const Document<OffsetItem>& file,
                     const WriteOptions& options) {
  const Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return crs.error();
  GeojsonCollection collection(out, {}, crs->reference());
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const OffsetItem& item = file.items[i];
    const double chord = chord_of(item, options);
    for (std::size_t k = 0; k < item.offsets.regions.size(); ++k) {
      const OffsetRegion& region = item.offsets.regions[k];
      collection.start();
      const auto member = [&](std::string_view key, auto value) {
        collection.member(key);
        out.put(value);
      };
      member("\"feature\"", i);
      member("\"region\"", k);
      member("\"clearance\"", region.clearance);
      if (region.parent == no_region) {
        member("\"parent\"", std::string_view("null"));
      } else {
        member("\"parent\"", region.parent);
      }
      member("\"area\"", area(region));
      member("\"length\"", length(region));
      if (!item.sources.empty()) {
        collection.member("\"features\"");
        out.put(fmt::format("[{}]", fmt::join(item.sources[k].features, ",")));
      }
      for (const auto& [name, value] :
           item.sources.empty() ? item.attributes : item.sources[k].attributes) {
        collection.member(quoted(name));
        put_quoted(out, value);
      }
      collection.geometry("Polygon");
      for (std::size_t r = 0; r < region.rings.size(); ++r) {
        std::vector<Vec2> points = chords_of(region.rings[r], chord);
        if (Status placed = crs->transform(points); !placed) return placed;
        out.put(r == 0 ? '[' : ',');
        put_geojson_points(out, points);
      }
      out.put(']');
      collection.end();
    }
  }
  collection.finish();
  return success();
}

#ifdef MEDIAL_DXF
std::string layer_of(double clearance) { return fmt::format("OFFSET {}", clearance); }

Status write_dxf(OutputStream& out, const Document<OffsetItem>& file) {
  std::set<double> clearances;
  for (const OffsetItem& item : file.items)
    for (const OffsetRegion& region : item.offsets.regions) clearances.insert(region.clearance);
  std::vector<std::string> layers;
  for (const double clearance : clearances) layers.push_back(layer_of(clearance));
  DxfDrawing drawing(out, layers);
  for (const OffsetItem& item : file.items)
    for (const OffsetRegion& region : item.offsets.regions)
      for (const Ring& ring : region.rings)
        drawing.polyline(layer_of(region.clearance), ring.points, ring.bulges, true);
  return drawing.finish();
}
#endif

Status write_picture(OutputStream& out, const std::string& format, const Document<OffsetItem>& file,
                     const WriteOptions& options) {
  Extent extent;
  double deepest = 0;
  for (const OffsetItem& item : file.items) {
    Box own = box_of(item);
    double reach = 0;
    for (const OffsetRegion& region : item.offsets.regions) {
      reach = std::max(reach, -region.clearance);
      deepest = std::max(deepest, std::abs(region.clearance));
    }
    own = {own.low - Vec2{reach, reach}, own.high + Vec2{reach, reach}};
    extent.add(own);
  }
  const Box box = extent.box();
  return write_canvas(out, format, box, options.width, file.y_down, [&](Canvas& canvas) {
    constexpr Color inside{0.93, 0.93, 0.95}, outline{0.25, 0.25, 0.3};
    for (const OffsetItem& item : file.items) {
      if (!options.shape) continue;
      canvas.color(inside);
      canvas.trace(item.shape);
      canvas.fill_even_odd();
      canvas.color(outline);
      canvas.line_width(1.2);
      canvas.trace(item.shape);
      for (const PlanarGraphEdge& edge : item.planar_graph.edges)
        canvas.trace(Ring{{item.planar_graph.points[edge.from], item.planar_graph.points[edge.to]},
                          RingRole::any,
                          {edge.bulge, 0}},
                     false);
      canvas.stroke();
      const double dot = 2e-3 * diagonal(box);
      for (const LonePoint& lone : item.planar_graph.lone_points) {
        canvas.circle(item.planar_graph.points[lone.point], dot);
        canvas.fill();
      }
    }
    canvas.line_width(1);
    for (const OffsetItem& item : file.items) {
      for (const OffsetRegion& region : item.offsets.regions) {
        canvas.color(shade(static_cast<int>(
            std::lround(std::abs(region.clearance) / deepest * (shade_count - 1)))));
        for (const Ring& ring : region.rings) {
          canvas.trace(ring);
          canvas.stroke();
        }
      }
    }
  });
}

}  // namespace

std::string known_offset_formats() { return offset_formats; }

Status write_offsets(const std::string& path, const std::string& format,
                     const Document<OffsetItem>& file, const WriteOptions& options, bool chords) {
  const Result<std::string> known = output_format(path, format, "json", offset_formats);
  if (!known) return known.error();
  if (!(options.chord > 0) || !std::isfinite(options.chord))
    return Error{ErrorCode::invalid_option, "chord is not a positive number", {}};
  return write_whole(path, [&](OutputStream& out) -> Status {
    if (*known == "geojson") return write_geojson(out, file, options);
    if (*known == "dxf") {
#ifdef MEDIAL_DXF
      return write_dxf(out, file);
#else
      return Error{ErrorCode::unsupported, "this program was built without DXF", {}};
#endif
    }
    if (*known == "json") {
      write_json(out, file);
    } else if (*known == "wkt") {
      return write_wkt(out, file, options, chords);
    } else {
      return write_picture(out, *known, file, options);
    }
    return success();
  });
}

}  // namespace medial::io
