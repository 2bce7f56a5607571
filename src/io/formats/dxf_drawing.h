#pragma once

#include <dl_dxf.h>
#include <dl_writer_ascii.h>

#include <string>
#include <vector>

#include "io/output.h"
#include "medial/document.h"

namespace medial::io {

/// dxflib's writer, with its groups going to a stream that notices a full disk, and its numbers
/// written without loss.
class DxfGroups : public DL_WriterA {
 public:
  explicit DxfGroups(OutputStream& out) : DL_WriterA("", DL_Codes::AC1015), out_(out) {}

  void dxfReal(int code, double value) const override;
  void dxfInt(int code, int value) const override;
  void dxfHex(int code, int value) const override;
  void dxfString(int code, const char* value) const override;
  void dxfString(int code, const std::string& value) const override;

 private:
  OutputStream& out_;
};

/// A drawing in DXF (AutoCAD 2000): everything up to the entities, the entities, and the rest.
class DxfDrawing {
 public:
  DxfDrawing(OutputStream& out, const std::vector<std::string>& layers, Unit unit);

  /// Groups of an entity that follows begin_entity().
  DxfGroups& groups() { return groups_; }
  void begin_entity(const std::string& layer, const char* name, const char* subclass);
  /// An LWPOLYLINE; `bulges` of the edges after each point, empty: all straight.
  void polyline(const std::string& layer, const std::vector<Vec2>& points,
                const std::vector<double>& bulges, bool closed, double elevation = 0);
  /// Always a success, for the sake of writers.
  Status finish();

 private:
  DxfGroups groups_;
  DL_Dxf drawing_;
};

}  // namespace medial::io
