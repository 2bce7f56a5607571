#include "io/gis/gdal_rows.h"

#include <ogrsf_frmts.h>

#include "io/gis/gdal_support.h"

namespace medial::io {

namespace {

void set_points(OGRSimpleCurve& curve, std::span<const Vec2> points) {
  curve.setNumPoints(static_cast<int>(points.size()), FALSE);
  for (int i = 0; const Vec2 p : points) curve.setPoint(i++, p.x, p.y);
}

/// Gives a feature the geometry of a row. Points and lines stay the same objects, row after row.
void set_geometry(OGRFeature& feature, GeometryKind kind, const Rows& rows, std::size_t row) {
  if (kind == GeometryKind::polygon) {
    auto polygon = std::make_unique<OGRPolygon>();
    for (std::size_t i = 0; i < rows.ring_count(row); ++i) {
      auto ring = std::make_unique<OGRLinearRing>();
      set_points(*ring, rows.ring(row, i));
      ring->closeRings();
      polygon->addRingDirectly(ring.release());
    }
    feature.SetGeometryDirectly(polygon.release());
    return;
  }
  if (feature.GetGeometryRef() == nullptr) {
    if (kind == GeometryKind::point) feature.SetGeometryDirectly(new OGRPoint);
    if (kind == GeometryKind::line) feature.SetGeometryDirectly(new OGRLineString);
  }
  const std::span<const Vec2> points = rows.ring(row, 0);
  if (kind == GeometryKind::line)
    return set_points(*feature.GetGeometryRef()->toLineString(), points);
  feature.GetGeometryRef()->toPoint()->setX(points[0].x);
  feature.GetGeometryRef()->toPoint()->setY(points[0].y);
}

void set_field(OGRFeature& feature, int number, const Rows& rows, const Rows::Field& field) {
  switch (field.kind) {
    case Rows::Kind::nothing:
      return feature.SetFieldNull(number);
    case Rows::Kind::whole:
      return feature.SetField(number, static_cast<GIntBig>(field.whole));
    case Rows::Kind::real:
      return feature.SetField(number, field.real);
    case Rows::Kind::text:
      return feature.SetField(number, rows.text(field));
  }
}

class GdalRows final : public RowFile {
 public:
  GdalRows(GDALDatasetUniquePtr dataset, std::span<const EmptyLayer> layers)
      : dataset_(std::move(dataset)) {
    for (const EmptyLayer& of : layers) {
      OGRLayer* layer = dataset_->GetLayerByName(of.name.c_str());
      layers_.push_back(
          {layer, of.kind, OGRFeatureUniquePtr(new OGRFeature(layer->GetLayerDefn()))});
    }
  }
  ~GdalRows() override {
    const GdalMessages unheard;
    end();
  }

  Status add(const Rows& rows) override {
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const Layer& layer = layers_[rows.table(row)];
      OGRFeature& feature = *layer.feature;
      feature.SetFID(OGRNullFID);
      int number = 0;
      for (const Rows::Field& field : rows.fields(row)) set_field(feature, number++, rows, field);
      set_geometry(feature, layer.kind, rows, row);
      if (layer.layer->CreateFeature(&feature) != OGRERR_NONE)
        return Error{ErrorCode::unwritable, "cannot write", {}};
    }
    return success();
  }
  Status close() override {
    end();
    return success();
  }

 private:
  struct Layer {
    OGRLayer* layer;
    GeometryKind kind;
    OGRFeatureUniquePtr feature;  ///< each row in turn
  };

  void end() {
    layers_.clear();
    dataset_.reset();
  }

  GDALDatasetUniquePtr dataset_;
  std::vector<Layer> layers_;
};

}  // namespace

std::unique_ptr<RowFile> rows_of_gdal(GDALDatasetUniquePtr dataset,
                                      std::span<const EmptyLayer> layers) {
  return std::make_unique<GdalRows>(std::move(dataset), layers);
}

}  // namespace medial::io
