#include "io/dxf_writer.h"

#include <array>
#include <vector>

#include "io/dxf_drawing.h"
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
  const SiteKind kind = axis.sites[edge.site[0]].kind;
  return kind == axis.sites[edge.site[1]].kind && kind != SiteKind::arc;
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

}  // namespace

Status write_dxf(OutputStream& out, const Document<AxisItem>& file, const WriteOptions& options) {
  DxfDrawing drawing(out, {layer_name});
  for (const AxisItem& item : file.items) {
    for (const Branch& branch : branches(item.axis)) {
      write_branch(drawing, item.axis, branch, options.radius_as_z);
    }
  }
  return drawing.finish();
}

}  // namespace medial::io
