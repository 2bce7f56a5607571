#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <vector>

#include "io/formats/dxf.h"
#include "io/formats/dxf_drawing.h"
#include "io/formats/dxf_text.h"
#include "io/tool_paths.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr char layer_name[] = "AXIS";

void write_spline(DxfDrawing& drawing, const MedialAxis& axis, const Edge& edge, bool forward,
                  bool radius_as_z) {
  const std::array<Disk, 3> control{axis.nodes[edge.node[forward ? 0 : 1]].disk, edge.control,
                                    axis.nodes[edge.node[forward ? 1 : 0]].disk};
  constexpr int planar = 8;
  constexpr int rational = 4;
  drawing.begin_entity(layer_name, "SPLINE", "AcDbSpline");
  DxfGroups& groups = drawing.groups();
  groups.dxfInt(70, (radius_as_z ? 0 : planar) | (edge.weight == 1 ? 0 : rational));
  groups.dxfInt(71, 2);
  groups.dxfInt(72, 6);
  groups.dxfInt(73, 3);
  groups.dxfInt(74, 0);
  for (const double knot : {0.0, 0.0, 0.0, 1.0, 1.0, 1.0}) groups.dxfReal(40, knot);
  if (edge.weight != 1) {
    for (const double weight : {1.0, edge.weight, 1.0}) groups.dxfReal(41, weight);
  }
  for (const Disk& disk : control) {
    groups.coord(10, disk.center.x, disk.center.y, radius_as_z ? disk.radius : 0);
  }
}

/// Whether an edge is straight in the plane, whatever its radius does.
bool is_straight(const MedialAxis& axis, const Edge& edge) {
  if (axis.resolution > 0) return true;
  const SiteKind kind = axis.sites[edge.site[0]].kind();
  return kind == axis.sites[edge.site[1]].kind() && kind != SiteKind::arc;
}

void write_branch(DxfDrawing& drawing, const MedialAxis& axis, const Branch& branch,
                  bool radius_as_z) {
  std::vector<Vec2> points;
  const auto finish = [&] {
    if (points.size() > 1) drawing.polyline(layer_name, points, {}, false);
    points.clear();
  };
  for (const Step& step : branch.steps) {
    const Edge& edge = axis.edges[step.edge];
    if (radius_as_z || !is_straight(axis, edge)) {
      finish();
      write_spline(drawing, axis, edge, step.forward, radius_as_z);
      continue;
    }
    const auto node = [&](bool first) {
      return axis.nodes[edge.node[first == step.forward ? 0 : 1]].disk.center;
    };
    if (points.empty()) points.push_back(node(true));
    points.push_back(node(false));
  }
  finish();
}

/// Axes on the layer AXIS: of each branch, runs of straight edges as polylines and every other edge
/// as the rational spline of degree 2 that it is, without loss. With options.radius_as_z every edge
/// is a spline whose z is the radius.
Status write_dxf(Target& target, const AxesOutput& output) {
  DxfDrawing drawing(*target.out, {layer_name}, output.document.unit);
  for (const AxisItem& item : output.document.items)
    for (const Branch& branch : branches(item.axis))
      write_branch(drawing, item.axis, branch, output.options.radius_as_z);
  return drawing.finish();
}

/// Every loop as a closed polyline with bulges: nothing is lost.
Status write_dxf(Target& target, const ShapesOutput& output) {
  const std::string layer = "SHAPE";
  DxfDrawing drawing(*target.out, {layer}, output.document.unit);
  for (const ShapeItem& item : output.document.items) {
    for (std::size_t i = 0; i < item.shape.loop_count(); ++i) {
      const Ring ring = ring_of(item.shape, i);
      drawing.polyline(layer, ring.points, ring.bulges, true);
    }
  }
  return drawing.finish();
}

std::string layer_of(double clearance) { return fmt::format("OFFSET {}", clearance); }

Status write_dxf(Target& target, const OffsetsOutput& output) {
  const auto& items = output.document.items;
  std::set<double> clearances;
  for (const OffsetItem& item : items)
    for (const OffsetRegion& region : item.offsets.regions) clearances.insert(region.clearance);
  std::vector<std::string> layers;
  for (const double clearance : clearances) layers.push_back(layer_of(clearance));
  DxfDrawing drawing(*target.out, layers, output.document.unit);
  for (const OffsetItem& item : items)
    for (const OffsetRegion& region : item.offsets.regions)
      for (const Ring& ring : region.rings)
        drawing.polyline(layer_of(region.clearance), ring.points, ring.bulges, true);
  return drawing.finish();
}

/// A path through space.
void write_space_polyline(DxfDrawing& drawing, const std::string& layer,
                          const std::vector<ToolPoint>& points) {
  drawing.begin_entity(layer, "POLYLINE", "AcDb3dPolyline");
  DxfGroups& groups = drawing.groups();
  groups.dxfInt(66, 1);
  groups.coord(10, 0, 0, 0);
  groups.dxfInt(70, 8);
  for (const ToolPoint& point : points) {
    drawing.begin_entity(layer, "VERTEX", "AcDbVertex");
    groups.dxfString(100, "AcDb3dPolylineVertex");
    groups.coord(10, point.point.x, point.point.y, point.z);
    groups.dxfInt(70, 32);
  }
  groups.entity("SEQEND");
  groups.dxfString(100, "AcDbEntity");
  groups.dxfString(8, layer);
}

/// A path as it is, or where arcs and changes of height come together, its flat and its other
/// parts in turn.
std::vector<std::vector<ToolPoint>> parts_by_height(const std::vector<ToolPoint>& path) {
  if (std::ranges::none_of(path, [](const ToolPoint& p) { return p.bulge != 0; })) return {path};
  std::vector<std::vector<ToolPoint>> parts;
  bool flat = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const bool level = path[i].z == path[i + 1].z;
    if (parts.empty() || level != flat) parts.push_back({path[i]});
    parts.back().back().bulge = path[i].bulge;
    parts.back().push_back({path[i + 1].point, path[i + 1].z, 0});
    flat = level;
  }
  return parts;
}

Status write_dxf(Target& target, const CarvingOutput& output) {
  std::vector<std::string> layers{"CLEARING", "WALL", "GROOVE", "RAMP", "PLUNGE"};
  const auto& items = output.document.items;
  if (std::ranges::any_of(items, [](const auto& item) { return !item.clearing.paths.empty(); }))
    layers.emplace_back("MILL");
  DxfDrawing drawing(*target.out, layers, output.document.unit);
  for (const CarveItem& item : items) {
    for_each_path(item, [&](const Carving&, const ToolPath& path, std::string layer) {
      std::ranges::transform(layer, layer.begin(), [](unsigned char c) { return std::toupper(c); });
      for (const auto& part : parts_by_height(path.points)) {
        const double z = part.front().z;
        if (!std::ranges::all_of(part, [z](const ToolPoint& p) { return p.z == z; })) {
          write_space_polyline(drawing, layer, part);
          continue;
        }
        const Ring line = line_of(part);
        drawing.polyline(layer, line.points, line.bulges, false, z);
      }
    });
  }
  return drawing.finish();
}

}  // namespace

Format dxf_format() {
  Format format{".dxf"};
  format.read = read_dxf;
  format.sniff = begins_like_dxf;
  format.has_layers = format.has_loose_curves = true;
  return format.writes<AxesOutput, ShapesOutput, OffsetsOutput, CarvingOutput>(
      write_dxf, write_dxf, write_dxf, write_dxf);
}

}  // namespace medial::io
