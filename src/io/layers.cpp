#include "medial/io/layers.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "io/gdal_columns.h"
#include "io/gdal_support.h"
#include "io/gdal_target.h"
#include "io/output.h"
#include "io/picture.h"
#include "io/place.h"

namespace medial::io {
namespace {

constexpr char layer_formats[] = ".geojson .gpkg .shp .fgb .wkt .svg .pdf .png .ps";

OGRwkbGeometryType type_of(LayerKind kind) {
  if (kind == LayerKind::disks) return wkbPoint;
  return kind == LayerKind::lines ? wkbLineString : wkbPolygon;
}

std::unique_ptr<OGRGeometry> geometry_of(LayerKind kind,
                                         const std::vector<std::vector<Vec2>>& parts) {
  if (kind == LayerKind::disks) return std::make_unique<OGRPoint>(parts[0][0].x, parts[0][0].y);
  if (kind == LayerKind::lines) {
    auto line = std::make_unique<OGRLineString>();
    set_points(*line, parts[0]);
    return line;
  }
  auto polygon = std::make_unique<OGRPolygon>();
  for (const auto& part : parts) {
    auto ring = std::make_unique<OGRLinearRing>();
    set_points(*ring, part);
    ring->closeRings();
    polygon->addRingDirectly(ring.release());
  }
  return polygon;
}

class LayerWriter {
 public:
  LayerWriter(const LayerFile& file, const OutputCrs& crs) : file_(file), crs_(crs) {}

  Status write(const std::string& path, const std::string& format) const {
    return write_dataset(
        path, format, [&](GDALDataset& target, const GdalMessages& messages) -> Status {
          const std::string base = CPLGetBasename(path.c_str());
          OGRLayer* all = nullptr;
          for (const Layer& layer : file_.layers) {
            OGRLayer* own = nullptr;
            // Of GeoJSON there is one collection of all geometries.
            const bool added = format == "geojson"
                                   ? add(target, all, layer, base, wkbUnknown)
                                   : add(target, own, layer, format == "gpkg" ? layer.name : base,
                                         type_of(layer.kind));
            if (!added) return cannot_write(messages);
          }
          return success();
        });
  }

  /// Well-known text, a geometry a line.
  Status write_wkt(OutputStream& out) const {
    for (const Layer& layer : file_.layers) {
      for (const LayerFeature& feature : layer.features) {
        auto parts = feature.parts;
        if (Status done = back(parts); !done) return done;
        char* text = nullptr;
        geometry_of(layer.kind, parts)->exportToWkt(&text);
        if (text != nullptr) out.put(std::string_view(text));
        CPLFree(text);
        out.put('\n');
      }
    }
    return success();
  }

 private:
  Status back(std::vector<std::vector<Vec2>>& parts) const {
    for (auto& part : parts)
      if (Status done = crs_.transform(part); !done) return done;
    return success();
  }

  /// Appends the features of a layer; creates the layer of the file where there is none yet.
  bool add(GDALDataset& target, OGRLayer*& to, const Layer& layer, const std::string& name,
           OGRwkbGeometryType type) const {
    const bool shared = type == wkbUnknown;
    std::vector<std::string> own{"feature", "layer"};
    for (const Layer& one : file_.layers)
      for (const std::string& field : one.fields)
        if (std::ranges::find(own, field) == own.end()) own.push_back(field);
    std::vector<const Attributes*> items;
    for (const Attributes& item : file_.attributes) items.push_back(&item);
    const AttributeColumns columns(items, own);
    const std::vector<std::string>& fields = layer.fields;
    if (to == nullptr) {
      to = target.CreateLayer(name.c_str(), crs_.reference(), type, nullptr);
      if (to == nullptr) return false;
      OGRFieldDefn number("feature", OFTInteger64);
      if (to->CreateField(&number) != OGRERR_NONE) return false;
      if (shared) {
        OGRFieldDefn kind("layer", OFTString);
        if (to->CreateField(&kind) != OGRERR_NONE) return false;
      }
      const auto create = [&](const std::string& field) {
        OGRFieldDefn value(field.c_str(), OFTReal);
        return to->CreateField(&value) == OGRERR_NONE;
      };
      if (!shared && !std::ranges::all_of(fields, create)) return false;
      if (shared && !std::all_of(own.begin() + 2, own.end(), create)) return false;
      if (!columns.create_in(*to)) return false;
    }
    const int first_attribute = 1 + static_cast<int>(shared ? own.size() - 1 : fields.size());
    for (const LayerFeature& source : layer.features) {
      OGRFeature feature(to->GetLayerDefn());
      feature.SetField(0, static_cast<GIntBig>(source.feature));
      if (shared) feature.SetField(1, layer.name.c_str());
      for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto at = std::ranges::find(own, fields[i]) - own.begin();
        feature.SetField(shared ? static_cast<int>(at) : 1 + static_cast<int>(i), source.values[i]);
      }
      if (source.feature < file_.attributes.size())
        columns.set(feature, first_attribute, file_.attributes[source.feature]);
      auto parts = source.parts;
      if (Status done = back(parts); !done) return false;
      feature.SetGeometryDirectly(geometry_of(layer.kind, parts).release());
      if (to->CreateFeature(&feature) != OGRERR_NONE) return false;
    }
    return true;
  }

  const LayerFile& file_;
  const OutputCrs& crs_;
};

}  // namespace

std::string known_layer_formats() { return layer_formats; }

Status write_layers(const std::string& path, const std::string& format, const LayerFile& file,
                    const NativeFile& background, const WriteOptions& options) {
  const Result<std::string> known = output_format(path, format, "geojson", known_layer_formats());
  if (!known) return known.error();
  const auto refused = [&path](ErrorCode code, std::string text) {
    return Error{code, std::move(text), in_file(path)};
  };
  if ((*known == "shp" || *known == "fgb") && file.layers.size() != 1)
    return refused(ErrorCode::unsupported,
                   fmt::format(".{} holds one layer only, and there are {}; .gpkg and .geojson "
                               "hold several",
                               *known, file.layers.size()));
  Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return refused(crs.error().code, crs.error().text);
  const LayerWriter writer(file, *crs);
  return write_file(
      path, *known, "medial", [&](const std::string& name) { return writer.write(name, *known); },
      [&](OutputStream& out) {
        return *known == "wkt" ? writer.write_wkt(out)
                               : write_layers_picture(out, *known, file, background, options);
      });
}

}  // namespace medial::io
