#include "io/dxf_writer.h"

#include <dl_dxf.h>
#include <dl_writer_ascii.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "medial/query.h"

namespace medial::io {

namespace {

constexpr char layer[] = "AXIS";

/// dxflib's writer, with its groups going to a stream that notices a full disk, and its numbers
/// written without loss.
class Groups : public DL_WriterA {
 public:
  explicit Groups(OutputStream& out) : DL_WriterA("", DL_Codes::AC1015), out_(out) {}

  void dxfReal(int code, double value) const override {
    if (!std::isfinite(value)) {
      finite_ = false;
      value = 0;
    }
    group(code, [&] { out_.put(value); });
  }
  void dxfInt(int code, int value) const override {
    group(code, [&] { out_.put(value); });
  }
  void dxfHex(int code, int value) const override {
    group(code, [&] { out_.put(std::string_view(fmt::format("{:X}", value))); });
  }
  void dxfString(int code, const char* value) const override {
    group(code, [&] { out_.put(std::string_view(value)); });
  }
  void dxfString(int code, const std::string& value) const override {
    group(code, [&] { out_.put(std::string_view(value)); });
  }
  bool finite() const { return finite_; }

 private:
  template <class Put>
  void group(int code, Put put) const {
    out_.put(code);
    out_.put('\n');
    put();
    out_.put('\n');
  }
  OutputStream& out_;
  mutable bool finite_ = true;
};

void write_tables(DL_Dxf& drawing, Groups& groups) {
  const DL_Attributes plain("", 7, -1, "Continuous", 1.0);
  groups.sectionTables();
  drawing.writeVPort(groups);
  groups.tableLinetypes(3);
  for (const char* name : {"BYBLOCK", "BYLAYER", "CONTINUOUS"}) {
    drawing.writeLinetype(groups, DL_LinetypeData(name, "", 0, 0, 0.0));
  }
  groups.tableEnd();
  groups.tableLayers(2);
  drawing.writeLayer(groups, DL_LayerData("0", 0), plain);
  drawing.writeLayer(groups, DL_LayerData(layer, 0), plain);
  groups.tableEnd();
  groups.tableStyle(1);
  drawing.writeStyle(groups, DL_StyleData("Standard", 0, 0.0, 1.0, 0.0, 0, 2.5, "txt", ""));
  groups.tableEnd();
  drawing.writeView(groups);
  drawing.writeUcs(groups);
  groups.tableAppid(1);
  drawing.writeAppid(groups, "ACAD");
  groups.tableEnd();
  drawing.writeDimStyle(groups, 1, 1, 1, 1, 1);
  drawing.writeBlockRecord(groups);
  groups.tableEnd();
  groups.sectionEnd();
}

void write_blocks(DL_Dxf& drawing, Groups& groups) {
  groups.sectionBlocks();
  for (const char* name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
    drawing.writeBlock(groups, DL_BlockData(name, 0, 0.0, 0.0, 0.0));
    drawing.writeEndBlock(groups, name);
  }
  groups.sectionEnd();
}

void begin_entity(Groups& groups, const char* name, const char* subclass) {
  groups.entity(name);
  groups.dxfString(100, "AcDbEntity");
  groups.dxfString(8, layer);
  groups.dxfString(100, subclass);
}

void write_polyline(Groups& groups, const std::vector<Vec2>& points) {
  begin_entity(groups, "LWPOLYLINE", "AcDbPolyline");
  groups.dxfInt(90, static_cast<int>(points.size()));
  groups.dxfInt(70, 0);
  for (const Vec2 p : points) {
    groups.dxfReal(10, p.x);
    groups.dxfReal(20, p.y);
  }
}

void write_spline(Groups& groups, const MedialAxis& axis, const Edge& edge, bool forward,
                  bool radius_as_z) {
  const std::array<Disk, 3> control{axis.nodes[edge.node[forward ? 0 : 1]].disk, edge.control,
                                    axis.nodes[edge.node[forward ? 1 : 0]].disk};
  constexpr int planar = 8;
  constexpr int rational = 4;
  begin_entity(groups, "SPLINE", "AcDbSpline");
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

void write_branch(Groups& groups, const MedialAxis& axis, const Branch& branch, bool radius_as_z) {
  std::vector<Vec2> points;
  const auto finish = [&] {
    if (points.size() > 1) write_polyline(groups, points);
    points.clear();
  };
  for (const Step& step : branch.steps) {
    const Edge& edge = axis.edges[step.edge];
    if (radius_as_z || !is_straight(axis, edge)) {
      finish();
      write_spline(groups, axis, edge, step.forward, radius_as_z);
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

Status write_dxf(OutputStream& out, const NativeFile& file, const WriteOptions& options) {
  Groups groups(out);
  DL_Dxf drawing;
  drawing.writeHeader(groups);
  groups.sectionEnd();
  write_tables(drawing, groups);
  write_blocks(drawing, groups);
  groups.sectionEntities();
  for (const NativeItem& item : file.items) {
    for (const Branch& branch : branches(item.axis)) {
      write_branch(groups, item.axis, branch, options.radius_as_z);
    }
  }
  groups.sectionEnd();
  drawing.writeObjects(groups);
  drawing.writeObjectsEnd(groups);
  groups.dxfEOF();
  if (groups.finite()) return success();
  return Error{ErrorCode::internal, "a number of the result is not finite", {}};
}

}  // namespace medial::io
