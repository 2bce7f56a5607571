#include "io/formats/dxf_drawing.h"

#include <fmt/format.h>

#include <string_view>

#include "io/drawing.h"

namespace medial::io {

namespace {

template <class Put>
void group(OutputStream& out, int code, Put put) {
  out.put(code);
  out.put('\n');
  put();
  out.put('\n');
}

void write_tables(DL_Dxf& drawing, DxfGroups& groups, const std::vector<std::string>& layers) {
  const DL_Attributes plain("", 7, -1, "Continuous", 1.0);
  groups.sectionTables();
  drawing.writeVPort(groups);
  groups.tableLinetypes(3);
  for (const char* name : {"BYBLOCK", "BYLAYER", "CONTINUOUS"}) {
    drawing.writeLinetype(groups, DL_LinetypeData(name, "", 0, 0, 0.0));
  }
  groups.tableEnd();
  groups.tableLayers(static_cast<int>(layers.size()) + 1);
  drawing.writeLayer(groups, DL_LayerData("0", 0), plain);
  for (const std::string& layer : layers) drawing.writeLayer(groups, DL_LayerData(layer, 0), plain);
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

void write_blocks(DL_Dxf& drawing, DxfGroups& groups) {
  groups.sectionBlocks();
  for (const char* name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
    drawing.writeBlock(groups, DL_BlockData(name, 0, 0.0, 0.0, 0.0));
    drawing.writeEndBlock(groups, name);
  }
  groups.sectionEnd();
}

}  // namespace

void DxfGroups::dxfReal(int code, double value) const {
  group(out_, code, [&] { out_.put(value); });
}
void DxfGroups::dxfInt(int code, int value) const {
  group(out_, code, [&] { out_.put(value); });
}
void DxfGroups::dxfHex(int code, int value) const {
  group(out_, code, [&] { out_.put(std::string_view(fmt::format("{:X}", value))); });
}
void DxfGroups::dxfString(int code, const char* value) const {
  group(out_, code, [&] { out_.put(std::string_view(value)); });
}
void DxfGroups::dxfString(int code, const std::string& value) const {
  group(out_, code, [&] { out_.put(std::string_view(value)); });
}

DxfDrawing::DxfDrawing(OutputStream& out, const std::vector<std::string>& layers, Unit unit)
    : groups_(out) {
  drawing_.writeHeader(groups_);
  if (const int units = dxf_units(unit); units != 0) {
    groups_.dxfString(9, "$INSUNITS");
    groups_.dxfInt(70, units);
  }
  groups_.sectionEnd();
  write_tables(drawing_, groups_, layers);
  write_blocks(drawing_, groups_);
  groups_.sectionEntities();
}

void DxfDrawing::begin_entity(const std::string& layer, const char* name, const char* subclass) {
  groups_.entity(name);
  groups_.dxfString(100, "AcDbEntity");
  groups_.dxfString(8, layer);
  groups_.dxfString(100, subclass);
}

void DxfDrawing::polyline(const std::string& layer, const std::vector<Vec2>& points,
                          const std::vector<double>& bulges, bool closed, double elevation) {
  begin_entity(layer, "LWPOLYLINE", "AcDbPolyline");
  groups_.dxfInt(90, static_cast<int>(points.size()));
  groups_.dxfInt(70, closed ? 1 : 0);
  if (elevation != 0) groups_.dxfReal(38, elevation);
  for (std::size_t i = 0; i < points.size(); ++i) {
    groups_.dxfReal(10, points[i].x);
    groups_.dxfReal(20, points[i].y);
    if (!bulges.empty() && bulges[i] != 0) groups_.dxfReal(42, bulges[i]);
  }
}

Status DxfDrawing::finish() {
  groups_.sectionEnd();
  drawing_.writeObjects(groups_);
  drawing_.writeObjectsEnd(groups_);
  groups_.dxfEOF();
  return success();
}

}  // namespace medial::io
