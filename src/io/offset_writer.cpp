#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "base/arc.h"
#include "io/canvas.h"
#include "io/output.h"
#include "medial/io/offsets.h"
#include "medial/io/projection.h"
#ifdef MEDIAL_DXF
#include "io/dxf_drawing.h"
#endif

namespace medial::io {

namespace {

constexpr char formats[] = ".json .geojson .wkt .dxf .svg .pdf .png .ps";

std::string quoted(const std::string& text) {
  using Json = nlohmann::json;
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

double bulge_after(const Ring& ring, std::size_t i) {
  return ring.bulges.empty() ? 0 : ring.bulges[i];
}
Vec2 next_point(const Ring& ring, std::size_t i) {
  return ring.points[i + 1 == ring.points.size() ? 0 : i + 1];
}

/// The ring's points, and points on its arcs, so that chords stay within `chord`; closed.
std::vector<Vec2> chords_of(const Ring& ring, double chord) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const Vec2 from = ring.points[i], to = next_point(ring, i);
    out.push_back(from);
    const double bulge = bulge_after(ring, i);
    if (bulge == 0) continue;
    // A piece of the angle a has the sagitta r (1 - cos(a / 2)).
    constexpr double most = 100000;
    const double angle = 4 * std::atan(bulge);
    const double radius = distance(from, to) / (2 * std::sin(std::abs(angle) / 2));
    const double widest = 2 * std::acos(std::max(1 - chord / radius, 0.0));
    const int pieces = static_cast<int>(std::clamp(std::ceil(std::abs(angle) / widest), 1.0, most));
    const Vec2 tangent = start_tangent({from, to, bulge});
    for (int k = 1; k < pieces; ++k) {
      const double half = angle * k / (2 * pieces);
      out.push_back(from + (2 * radius * std::sin(std::abs(half))) *
                               turned(tangent, std::cos(half), std::sin(half)));
    }
  }
  out.push_back(ring.points[0]);
  return out;
}

Box box_of(const OffsetItem& item) {
  if (!item.shape.points.empty() || item.soup.points.empty()) return bounding_box(item.shape);
  return bounding_box(item.soup);
}

double chord_of(const OffsetItem& item, const WriteOptions& options) {
  double reach = diagonal(box_of(item));
  for (const OffsetRegion& region : item.offsets.regions)
    reach = std::max(reach, diagonal(box_of(item)) - 2 * region.clearance);
  return options.chord * reach;
}

void put_point(OutputStream& out, Vec2 p, char separator) {
  out.put(p.x);
  out.put(separator);
  out.put(p.y);
}

void write_json(OutputStream& out, const OffsetFile& file) {
  out.put("{\"medial_offsets\":1,\n\"items\":[");
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const OffsetItem& item = file.items[i];
    out.put(i == 0 ? "\n{\"tolerance\":" : ",\n{\"tolerance\":");
    out.put(item.offsets.tolerance);
    out.put(",\"attributes\":[");
    for (std::size_t k = 0; k < item.attributes.size(); ++k)
      out.put(fmt::format("{}[{},{}]", k == 0 ? "" : ",", quoted(item.attributes[k].first),
                          quoted(item.attributes[k].second)));
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

/// A ring as a compound curve: runs of straight edges, and runs of arcs with a point in the middle
/// of each.
void put_curve(OutputStream& out, const Ring& ring) {
  const std::size_t count = ring.points.size();
  const bool straight =
      std::all_of(ring.bulges.begin(), ring.bulges.end(), [](double bulge) { return bulge == 0; });
  if (!straight) out.put("COMPOUNDCURVE (");
  for (std::size_t i = 0; i < count;) {
    const bool arcs = bulge_after(ring, i) != 0;
    if (i > 0) out.put(", ");
    out.put(arcs ? "CIRCULARSTRING (" : "(");
    put_point(out, ring.points[i], ' ');
    for (; i < count && (bulge_after(ring, i) != 0) == arcs; ++i) {
      if (arcs) {
        out.put(", ");
        put_point(out, apex({ring.points[i], next_point(ring, i), ring.bulges[i]}), ' ');
      }
      out.put(", ");
      put_point(out, next_point(ring, i), ' ');
    }
    out.put(')');
  }
  if (!straight) out.put(')');
}

/// Calls each(begin, end) for the regions of each clearance.
template <class Each>
void for_levels(const std::vector<OffsetRegion>& regions, const Each& each) {
  for (std::size_t begin = 0, end = 0; begin < regions.size(); begin = end) {
    while (end < regions.size() && regions[end].clearance == regions[begin].clearance) ++end;
    each(begin, end);
  }
}

void write_wkt(OutputStream& out, const OffsetFile& file, const WriteOptions& options,
               bool chords) {
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
            put_curve(out, regions[k].rings[r]);
            continue;
          }
          const std::vector<Vec2> points = chords_of(regions[k].rings[r], chord);
          for (std::size_t p = 0; p < points.size(); ++p) {
            out.put(p == 0 ? "(" : ", ");
            put_point(out, points[p], ' ');
          }
          out.put(')');
        }
        out.put(')');
      }
      out.put(")\n");
    });
  }
}

Status write_geojson(OutputStream& out, const OffsetFile& file, const WriteOptions& options) {
  std::optional<BackToGeographic> back;
  if (is_local_projection(file.crs_wkt)) {
    Result<BackToGeographic> made = BackToGeographic::make(file.crs_wkt);
    if (!made) return std::move(made).error();
    back = std::move(*made);
  }
  out.put("{\"type\":\"FeatureCollection\",\"features\":[");
  bool first = true;
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const OffsetItem& item = file.items[i];
    const double chord = chord_of(item, options);
    for (std::size_t k = 0; k < item.offsets.regions.size(); ++k) {
      const OffsetRegion& region = item.offsets.regions[k];
      out.put(first ? "\n" : ",\n");
      first = false;
      out.put("{\"type\":\"Feature\",\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[");
      for (std::size_t r = 0; r < region.rings.size(); ++r) {
        std::vector<Vec2> points = chords_of(region.rings[r], chord);
        if (back) {
          if (Status status = back->transform(points); !status) return status;
        }
        out.put(r == 0 ? "[" : ",[");
        for (std::size_t p = 0; p < points.size(); ++p) {
          out.put(p == 0 ? "[" : ",[");
          put_point(out, points[p], ',');
          out.put(']');
        }
        out.put(']');
      }
      out.put(
          fmt::format("]}},\"properties\":{{\"feature\":{},\"region\":{},\"clearance\":{},"
                      "\"parent\":{},\"area\":{},\"length\":{}",
                      i, k, region.clearance,
                      region.parent == no_region ? "null" : std::to_string(region.parent),
                      area(region), length(region)));
      for (const auto& [name, value] : item.attributes)
        out.put(fmt::format(",{}:{}", quoted(name), quoted(value)));
      out.put("}}");
    }
  }
  out.put("\n]}\n");
  return success();
}

#ifdef MEDIAL_DXF
std::string layer_of(double clearance) { return fmt::format("OFFSET {}", clearance); }

Status write_dxf(OutputStream& out, const OffsetFile& file) {
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

Status write_picture(OutputStream& out, const std::string& format, const OffsetFile& file,
                     const WriteOptions& options) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  double deepest = 0;
  for (const OffsetItem& item : file.items) {
    Box own = box_of(item);
    double reach = 0;
    for (const OffsetRegion& region : item.offsets.regions) {
      reach = std::max(reach, -region.clearance);
      deepest = std::max(deepest, std::abs(region.clearance));
    }
    own = {own.low - Vec2{reach, reach}, own.high + Vec2{reach, reach}};
    box.low = {std::min(box.low.x, own.low.x), std::min(box.low.y, own.low.y)};
    box.high = {std::max(box.high.x, own.high.x), std::max(box.high.y, own.high.y)};
  }
  if (!(box.low.x <= box.high.x)) box = {{0, 0}, {1, 1}};
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
      for (const SoupEdge& edge : item.soup.edges)
        canvas.trace(Ring{{item.soup.points[edge.from], item.soup.points[edge.to]},
                          RingRole::any,
                          {edge.bulge, 0}},
                     false);
      canvas.stroke();
      const double dot = 2e-3 * diagonal(box);
      for (const LonePoint& lone : item.soup.lone_points) {
        canvas.circle(item.soup.points[lone.point], dot);
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

std::string known_offset_formats() { return formats; }

Status write_offsets(const std::string& path, const std::string& format, const OffsetFile& file,
                     const WriteOptions& options, bool chords) {
  const Result<std::string> known = output_format(path, format, "json", formats);
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
      write_wkt(out, file, options, chords);
    } else {
      return write_picture(out, *known, file, options);
    }
    return success();
  });
}

}  // namespace medial::io
