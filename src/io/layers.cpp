#include "medial/io/layers.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "io/format_name.h"
#include "io/gdal_columns.h"
#include "io/gdal_support.h"
#include "io/guarded.h"
#include "io/output.h"
#include "io/picture.h"
#include "io/place.h"
#include "medial/io/projection.h"

namespace medial::io {
namespace {

constexpr std::array<std::string_view, 9> formats{"geojson", "gpkg", "shp", "fgb", "wkt",
                                                  "svg",     "pdf",  "png", "ps"};

bool holds_one_layer(const std::string& format) { return format == "shp" || format == "fgb"; }

const char* driver_of(const std::string& format) {
  if (format == "geojson") return "GeoJSON";
  if (format == "gpkg") return "GPKG";
  if (format == "shp") return "ESRI Shapefile";
  return "FlatGeobuf";
}

OGRwkbGeometryType type_of(LayerKind kind) {
  if (kind == LayerKind::disks) return wkbPoint;
  return kind == LayerKind::lines ? wkbLineString : wkbPolygon;
}

void fill(OGRSimpleCurve& curve, const std::vector<Vec2>& points) {
  curve.setNumPoints(static_cast<int>(points.size()), FALSE);
  for (std::size_t i = 0; i < points.size(); ++i)
    curve.setPoint(static_cast<int>(i), points[i].x, points[i].y);
}

std::unique_ptr<OGRGeometry> geometry_of(LayerKind kind,
                                         const std::vector<std::vector<Vec2>>& parts) {
  if (kind == LayerKind::disks) return std::make_unique<OGRPoint>(parts[0][0].x, parts[0][0].y);
  if (kind == LayerKind::lines) {
    auto line = std::make_unique<OGRLineString>();
    fill(*line, parts[0]);
    return line;
  }
  auto polygon = std::make_unique<OGRPolygon>();
  for (const auto& part : parts) {
    auto ring = std::make_unique<OGRLinearRing>();
    fill(*ring, part);
    ring->closeRings();
    polygon->addRingDirectly(ring.release());
  }
  return polygon;
}

class LayerWriter {
 public:
  explicit LayerWriter(const LayerFile& file) : file_(file) {
    std::string wkt = file.crs_wkt;
    if (is_local_projection(wkt)) {
      if (auto back = BackToGeographic::make(wkt)) {
        wkt = back->crs_wkt();
        back_ = std::move(*back);
      }
    }
    const GdalMessages messages;
    if (!wkt.empty() && crs_.importFromWkt(wkt.c_str()) == OGRERR_NONE) {
      crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      has_crs_ = true;
    }
  }

  Status write(const std::string& path, const std::string& format) {
    register_gdal();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(format));
    if (driver == nullptr)
      return Error{ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", format), {}};
    const GdalMessages messages;
    const auto failed = [&messages] {
      return Error{ErrorCode::unwritable, "cannot write: " + messages.failure(), {}};
    };
    GDALDatasetUniquePtr target(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!target) return failed();
    const bool transactions = target->TestCapability(ODsCTransactions) != 0;
    if (transactions) target->StartTransaction();
    if (format == "geojson") {  // one collection of all geometries
      OGRLayer* all = nullptr;
      for (const Layer& layer : file_.layers)
        if (!add(*target, all, layer, CPLGetBasename(path.c_str()), wkbUnknown)) return failed();
    } else {
      for (const Layer& layer : file_.layers) {
        OGRLayer* own = nullptr;
        const std::string name = format == "gpkg" ? layer.name : CPLGetBasename(path.c_str());
        if (!add(*target, own, layer, name, type_of(layer.kind))) return failed();
      }
    }
    if (transactions && target->CommitTransaction() != OGRERR_NONE) return failed();
    target.reset();  // closing writes, too
    return messages.failure().empty() ? success() : failed();
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
    if (!back_) return success();
    for (auto& part : parts)
      if (Status done = back_->transform(part); !done) return done;
    return success();
  }

  /// Appends the features of a layer; creates the layer of the file where there is none yet.
  bool add(GDALDataset& target, OGRLayer*& to, const Layer& layer, const std::string& name,
           OGRwkbGeometryType type) {
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
      to = target.CreateLayer(name.c_str(), has_crs_ ? &crs_ : nullptr, type, nullptr);
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
  OGRSpatialReference crs_;
  bool has_crs_ = false;
  std::optional<BackToGeographic> back_;
};

Status write_stream(OutputStream& out, const std::string& format, const LayerFile& file,
                    const NativeFile& background, const WriteOptions& options) {
  Status status = success();
  if (format == "wkt") {
    status = LayerWriter(file).write_wkt(out);
  } else if (format == "geojson" || format == "fgb" || format == "gpkg") {
    status = put_gdal_file(out, "medial", format, [&](const std::string& name) {
      return LayerWriter(file).write(name, format);
    });
  } else {
    status = write_layers_picture(out, format, file, background, options);
  }
  if (!status) return status;
  return out.finish();
}

Status write_any(const std::string& path, const std::string& option, const LayerFile& file,
                 const NativeFile& background, const WriteOptions& options) {
  const std::string format = path == "-" && option.empty() ? "geojson" : format_name(path, option);
  if (std::ranges::find(formats, format) == formats.end()) {
    return Error{
        ErrorCode::unsupported,
        fmt::format("'{}' is no format for layers; known are {}", format, known_layer_formats()),
        {}};
  }
  if (holds_one_layer(format) && file.layers.size() != 1) {
    return Error{ErrorCode::unsupported,
                 fmt::format(".{} holds one layer only, and there are {}; .gpkg and .geojson hold "
                             "several",
                             format, file.layers.size()),
                 {}};
  }
  if (is_stream(path)) {
    if (format == "shp") {
      return Error{
          ErrorCode::unsupported, "a shapefile is several files and cannot go to a stream", {}};
    }
    Result<OutputStream> out = OutputStream::open(path);
    if (!out) return out.error();
    return write_stream(*out, format, file, background, options);
  }
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return pending.error();
  if (format == "gpkg" || format == "shp") {
    if (Status written = LayerWriter(file).write(pending->path(), format); !written) return written;
  } else {
    Result<OutputStream> out = OutputStream::open(pending->path());
    if (!out) return out.error();
    if (Status written = write_stream(*out, format, file, background, options); !written)
      return written;
  }
  return pending->commit();
}

}  // namespace

std::string known_layer_formats() { return fmt::format(".{}", fmt::join(formats, " .")); }

Status write_layers(const std::string& path, const std::string& format, const LayerFile& file,
                    const NativeFile& background, const WriteOptions& options) {
  return guarded(path, [&] { return write_any(path, format, file, background, options); });
}

}  // namespace medial::io
