#include <dl_creationadapter.h>
#include <dl_dxf.h>

#include <sstream>

#include "io/drawing.h"
#include "io/formats/dxf.h"
#include "io/formats/dxf_text.h"

namespace medial::io {

namespace {

/// Thrown inside this file only, and caught in read_dxf().
struct Refused {
  Error error;
};

/// Receives what dxflib finds, and gathers what it finds in several parts.
class Collector : public DL_CreationAdapter {
 public:
  Drawing drawing;

  void addLayer(const DL_LayerData& data) override {
    drawing.layers.insert(data.name);
    const bool frozen = (data.flags & 1) != 0;
    if (frozen || data.off || getAttributes().getColor() < 0) drawing.hidden.insert(data.name);
  }
  void addBlock(const DL_BlockData& data) override {
    finish();
    drawing.begin_block(data.name, {data.bpx, data.bpy});
  }
  void endBlock() override {
    finish();
    drawing.end_block();
  }

  void addPoint(const DL_PointData& data) override {
    if (begin("POINT")) drawing.add_point({data.x, data.y});
  }
  void addLine(const DL_LineData& data) override {
    if (begin("LINE")) drawing.add_line({data.x1, data.y1}, {data.x2, data.y2});
  }
  void addCircle(const DL_CircleData& data) override {
    if (begin("CIRCLE")) drawing.add_circle({data.cx, data.cy}, data.radius);
  }
  void addArc(const DL_ArcData& data) override {
    if (begin("ARC")) drawing.add_arc({data.cx, data.cy}, data.radius, data.angle1, data.angle2);
  }
  void addEllipse(const DL_EllipseData& data) override {
    if (begin("ELLIPSE"))
      drawing.add_ellipse({data.cx, data.cy}, {data.mx, data.my}, data.ratio, data.angle1,
                          data.angle2);
  }

  void addPolyline(const DL_PolylineData& data) override {
    if (!begin("POLYLINE")) return;
    constexpr int mesh_flags = 16 | 64;
    if ((data.flags & mesh_flags) != 0) {
      ++drawing.left_out["polygon mesh"];
      return;
    }
    kind_ = Kind::polyline;
    closed_ = (data.flags & 1) != 0;
  }
  void addVertex(const DL_VertexData& data) override {
    if (kind_ != Kind::polyline) return;
    points_.push_back({data.x, data.y});
    numbers_.push_back(data.bulge);
  }
  void addSpline(const DL_SplineData& data) override {
    if (!begin("SPLINE")) return;
    kind_ = Kind::spline;
    degree_ = data.degree;
    closed_ = (data.flags & 1) != 0;
  }
  void addControlPoint(const DL_ControlPointData& data) override {
    if (kind_ != Kind::spline) return;
    points_.push_back({data.x, data.y});
    numbers_.push_back(data.w);
  }
  void addKnot(const DL_KnotData& data) override { knots_.push_back(data.k); }

  void addInsert(const DL_InsertData& data) override {
    if (!begin("INSERT")) return;
    drawing.add_copies({data.name,
                        {data.ipx, data.ipy},
                        data.sx,
                        data.sy,
                        data.angle,
                        data.cols,
                        data.rows,
                        data.colSp,
                        data.rowSp});
  }

  void endEntity() override { finish(); }
  void endSequence() override { finish(); }

  /// Ends the polyline or spline under way.
  void finish() {
    const Kind kind = kind_;
    kind_ = Kind::none;
    Status status = success();
    if (kind == Kind::polyline) drawing.add_polyline(points_, numbers_, closed_);
    if (kind == Kind::spline)
      status = drawing.add_spline(degree_, knots_, points_, numbers_, closed_);
    if (!status) throw Refused{std::move(status).error()};
    points_.clear();
    numbers_.clear();
    knots_.clear();
  }

 private:
  enum class Kind : std::uint8_t { none, polyline, spline };

  /// Whether an entity is one of the drawing, in a plane that is read.
  bool begin(const char* name) {
    finish();
    const double* normal = getExtrusion()->getDirection();
    return drawing.begin_entity(name, getAttributes().getLayer(),
                                {normal[0], normal[1], normal[2]}) &&
           !getAttributes().isInPaperSpace();
  }

  Kind kind_ = Kind::none;
  bool closed_ = false;
  std::uint32_t degree_ = 0;
  std::vector<Vec2> points_;
  std::vector<double> numbers_;  ///< bulges or weights
  std::vector<double> knots_;
};

}  // namespace

Result<Document<Feature>> read_dxf(const Input& input, const ReadOptions& options) {
  Result<DxfText> text = read_dxf_text(*input.source);
  if (!text) return text.error();
  try {
    Collector found;
    std::istringstream stream(std::move(text->text));
    DL_Dxf().in(stream, &found);
    found.finish();
    text->others.merge(found.drawing.left_out);
    found.drawing.left_out = std::move(text->others);
    found.drawing.units = text->units;
    return features_of(found.drawing, options);
  } catch (const Refused& refused) {
    return refused.error;
  }
}

}  // namespace medial::io
