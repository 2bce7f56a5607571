#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/arc.h"
#include "io/gdal_target.h"
#include "io/geojson.h"
#include "io/native.h"
#include "io/output.h"
#include "io/picture.h"
#include "io/ring_text.h"
#include "medial/io/read.h"
#include "medial/io/shapes.h"
#include "medial/io/write.h"
#ifdef MEDIAL_DXF
#include "io/dxf_drawing.h"
#endif

namespace medial::io {

namespace {

constexpr char shape_formats[] = ".json .svg .wkt .geojson .dxf .pdf .png .ps";

/// The loops of a shape, part by part: the outer loop first, then its holes.
std::vector<std::vector<std::size_t>> parts_of(const Shape& shape) {
  std::vector<std::vector<std::size_t>> parts(shape.component_count());
  for (const bool holes : {false, true})
    for (std::size_t i = 0; i < shape.loop_count(); ++i)
      if (shape.hole[i] == holes) parts[shape.component[i]].push_back(i);
  return parts;
}

/// Calls edge(BulgeArc) for the edges of a loop in their order.
template <class Visit>
void for_each_edge(const Shape& shape, std::size_t loop, const Visit& visit) {
  const auto points = shape.loop(loop);
  for (std::size_t k = 0; k < points.size(); ++k)
    visit(BulgeArc{points[k], points[k + 1 < points.size() ? k + 1 : 0],
                   shape.bulge(shape.loop_begin[loop] + k)});
}

bool has_arcs(const Shape& shape) {
  return std::ranges::any_of(shape.bulges, [](double bulge) { return bulge != 0; });
}

void write_svg(OutputStream& out, const ShapesFile& file) {
  Box box = Box::nothing();
  for (const ShapeItem& item : file.items)
    if (!item.shape.points.empty()) box.add(bounding_box(item.shape));
  if (box.is_nothing()) box = {};
  const double margin = 0.02 * diagonal(box);
  const Vec2 size = box.high - box.low + 2 * margin * Vec2{1, 1};
  const double top = file.y_down ? box.low.y - margin : -box.high.y - margin;
  // Without a width of the picture a unit stays a unit for who reads it again.
  out.put(fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.9g} {:.9g} {:.9g} {:.9g}\">\n",
      box.low.x - margin, top, size.x, size.y));
  out.put(fmt::format(
      "<g{} fill=\"#f1f1ec\" fill-rule=\"evenodd\" stroke=\"#404045\" stroke-width=\"{:.3g}\" "
      "stroke-linejoin=\"round\">\n",
      file.y_down ? "" : " transform=\"scale(1 -1)\"", 1.5e-3 * std::max(size.x, size.y)));
  for (const ShapeItem& item : file.items) {
    out.put("<path d=\"");
    for (std::size_t i = 0; i < item.shape.loop_count(); ++i) {
      bool begun = false;
      for_each_edge(item.shape, i, [&](const BulgeArc& arc) {
        if (!begun) {
          out.put('M');
          put_point(out, arc.start, ' ');
          begun = true;
        }
        if (arc.bulge == 0) {
          out.put('L');
        } else {
          const double radius = 1 / std::abs(curvature(arc));
          out.put('A');
          out.put(radius);
          out.put(' ');
          out.put(radius);
          out.put(arc.bulge > 0 ? " 0 0 1 " : " 0 0 0 ");
        }
        put_point(out, arc.end, ' ');
      });
      out.put("Z\n");
    }
    out.put("\"/>\n");
  }
  out.put("</g>\n</svg>\n");
}

double chord_of(const ShapesFile& file, const Shape& shape) {
  return shape.points.empty() ? 1 : file.chord * diagonal(bounding_box(shape));
}

/// Circular strings do not survive a projection: of longitudes and latitudes there are chords.
Status write_wkt(OutputStream& out, const ShapesFile& file) {
  const Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return crs.error();
  for (const ShapeItem& item : file.items) {
    const Shape& shape = item.shape;
    const bool curved = has_arcs(shape) && !crs->changes_points();
    const auto parts = parts_of(shape);
    const bool one = parts.size() == 1;
    if (parts.empty()) {
      out.put("POLYGON EMPTY\n");
      continue;
    }
    if (!one) out.put(curved ? "MULTISURFACE (" : "MULTIPOLYGON (");
    if (one && !curved) out.put("POLYGON ");
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (k > 0) out.put(", ");
      out.put(curved ? "CURVEPOLYGON (" : "(");
      for (std::size_t i = 0; i < parts[k].size(); ++i) {
        if (i > 0) out.put(", ");
        const Ring ring = ring_of(shape, parts[k][i]);
        if (curved) {
          put_wkt_curve(out, ring);
          continue;
        }
        std::vector<Vec2> points = chords_of(ring, chord_of(file, shape));
        if (Status placed = crs->transform(points); !placed) return placed;
        put_wkt_points(out, points);
      }
      out.put(')');
    }
    out.put(one ? "\n" : ")\n");
  }
  return success();
}

Status write_geojson(OutputStream& out, const ShapesFile& file) {
  const Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return crs.error();
  GeojsonCollection collection(out, {}, crs->reference());
  for (const ShapeItem& item : file.items) {
    const Shape& shape = item.shape;
    collection.start();
    for (const auto& [name, value] : item.attributes) {
      collection.member(quoted(name));
      put_quoted(out, value);
    }
    collection.geometry("MultiPolygon");
    out.put('[');
    const auto parts = parts_of(shape);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      out.put(k > 0 ? ",[" : "[");
      for (std::size_t i = 0; i < parts[k].size(); ++i) {
        std::vector<Vec2> points = chords_of(ring_of(shape, parts[k][i]), chord_of(file, shape));
        if (Status placed = crs->transform(points); !placed) return placed;
        if (i > 0) out.put(',');
        put_geojson_points(out, points);
      }
      out.put(']');
    }
    out.put(']');
    collection.end();
  }
  collection.finish();
  return success();
}

/// Every loop as a closed polyline with bulges: nothing is lost.
Status write_dxf([[maybe_unused]] OutputStream& out, [[maybe_unused]] const ShapesFile& file) {
#ifdef MEDIAL_DXF
  const std::string layer = "SHAPE";
  DxfDrawing drawing(out, {layer});
  for (const ShapeItem& item : file.items) {
    const Shape& shape = item.shape;
    for (std::size_t i = 0; i < shape.loop_count(); ++i) {
      const auto points = shape.loop(i);
      std::vector<double> bulges;
      if (has_arcs(shape))
        for (std::size_t k = 0; k < points.size(); ++k)
          bulges.push_back(shape.bulge(shape.loop_begin[i] + k));
      drawing.polyline(layer, {points.begin(), points.end()}, bulges, true);
    }
  }
  return drawing.finish();
#else
  return Error{ErrorCode::unsupported, "this program was built without DXF", {}};
#endif
}

Status write_stream(OutputStream& out, const std::string& format, const ShapesFile& file) {
  Status status = success();
  if (format == "svg") {
    write_svg(out, file);
  } else if (format == "wkt") {
    status = write_wkt(out, file);
  } else if (format == "geojson") {
    status = write_geojson(out, file);
  } else if (format == "dxf") {
    status = write_dxf(out, file);
  } else {
    Document<AxisItem> native;
    native.crs_wkt = file.crs_wkt;
    native.y_down = file.y_down;
    for (const ShapeItem& item : file.items) {
      native.items.emplace_back();
      native.items.back().shape = item.shape;
      native.items.back().attributes = item.attributes;
    }
    WriteOptions pictures;
    pictures.width = file.width;
    status =
        format == "json" ? write_native(out, native) : write_picture(out, format, native, pictures);
  }
  return status;
}

}  // namespace

std::string known_shape_formats() { return shape_formats; }

Status write_shapes(const std::string& path, const std::string& format, const ShapesFile& file) {
  Result<std::string> own = output_format(path, format, "json", shape_formats);
  if (!own) return std::move(own).error();
  return write_whole(path,
                     [&](OutputStream& out) -> Status { return write_stream(out, *own, file); });
}

}  // namespace medial::io
