#include "io/gdal_writer.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/gdal_columns.h"
#include "io/gdal_support.h"
#include "io/place.h"
#include "io/table_writer.h"
#include "medial/centreline.h"
#include "medial/io/projection.h"
#include "medial/query.h"

namespace medial::io {

namespace {

const char* driver_of(const std::string& format) {
  if (format == "geojson") return "GeoJSON";
  if (format == "gpkg") return "GPKG";
  if (format == "shp") return "ESRI Shapefile";
  return "FlatGeobuf";
}

AttributeColumns columns_of(const NativeFile& file) {
  std::vector<const Attributes*> items;
  for (const NativeItem& item : file.items) items.push_back(&item.attributes);
  static const std::array<std::string, 10> own{"feature",    "branch", "r_from", "r_to",
                                               "length",     "r_min",  "r_max",  "site_left",
                                               "site_right", "node"};
  return {items, own};
}

/// "ring/vertex" (a colon would make readers take it for a time of day); empty for no site.
std::string site_text(const MedialAxis& axis, std::uint32_t site) {
  if (site == no_site) return {};
  return fmt::format("{}/{}", axis.sites[site].ring, axis.sites[site].vertex);
}

class GdalWriter {
 public:
  GdalWriter(const NativeFile& file, const WriteOptions& options, std::string shown)
      : file_(file), options_(options), shown_(std::move(shown)), columns_(columns_of(file)) {}

  Status write(const std::string& path, const std::string& format) {
    register_gdal();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_of(format));
    if (driver == nullptr) {
      return Error{ErrorCode::unsupported, fmt::format("this GDAL cannot write {}", format), {}};
    }
    if (Status status = prepare_crs(); !status) return status;
    const GdalMessages messages;
    GDALDatasetUniquePtr target(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!target) return failed(messages);
    Status status = write_layers(*target, format, messages);
    if (!status) return status;
    target.reset();  // closing writes, too
    return messages.failure().empty() ? success() : failed(messages);
  }

 private:
  Status failed(const GdalMessages& messages) const {
    return Error{ErrorCode::unwritable, "cannot write: " + messages.failure(), in_file(shown_)};
  }

  Status prepare_crs() {
    std::string wkt = file_.crs_wkt;
    if (is_local_projection(wkt)) {
      Result<BackToGeographic> back = BackToGeographic::make(wkt);
      if (!back) return back.error();
      back_ = std::move(*back);
      wkt = back_->crs_wkt();
    }
    const GdalMessages messages;
    if (!wkt.empty() && crs_.importFromWkt(wkt.c_str()) == OGRERR_NONE) {
      crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      has_crs_ = true;
    }
    return success();
  }

  OGRLayer* create_layer(GDALDataset& target, const char* name, OGRwkbGeometryType type,
                         std::initializer_list<std::pair<const char*, OGRFieldType>> fields) {
    OGRLayer* layer = target.CreateLayer(name, has_crs_ ? &crs_ : nullptr, type, nullptr);
    if (layer == nullptr) return nullptr;
    for (const auto& [field, field_type] : fields) {
      OGRFieldDefn definition(field, field_type);
      if (layer->CreateField(&definition) != OGRERR_NONE) return nullptr;
    }
    return columns_.create_in(*layer) ? layer : nullptr;
  }

  Status write_layers(GDALDataset& target, const std::string& format,
                      const GdalMessages& messages) {
    const bool transactions = target.TestCapability(ODsCTransactions) != 0;
    if (transactions) target.StartTransaction();
    // The only layer of a file that holds one is named after the file.
    const std::string name = format == "gpkg" ? "axis" : CPLGetBasename(target.GetDescription());
    OGRLayer* lines = create_layer(target, name.c_str(), wkbLineString,
                                   {{"feature", OFTInteger64},
                                    {"branch", OFTInteger64},
                                    {"r_from", OFTReal},
                                    {"r_to", OFTReal},
                                    {"length", OFTReal},
                                    {"r_min", OFTReal},
                                    {"r_max", OFTReal},
                                    {"site_left", OFTString},
                                    {"site_right", OFTString}});
    if (lines == nullptr) return failed(messages);
    for (std::size_t i = 0; i < file_.items.size(); ++i) {
      if (Status status = write_branches(*lines, i, messages); !status) return status;
    }
    if (format == "gpkg") {
      OGRLayer* nodes = create_layer(
          target, "nodes", wkbPoint,
          {{"feature", OFTInteger64}, {"node", OFTInteger64}, {"r", OFTReal}, {"kind", OFTString}});
      if (nodes == nullptr) return failed(messages);
      for (std::size_t i = 0; i < file_.items.size(); ++i) {
        if (Status status = write_nodes(*nodes, i, messages); !status) return status;
      }
    }
    if (transactions && target.CommitTransaction() != OGRERR_NONE) return failed(messages);
    return success();
  }

  Status write_branches(OGRLayer& layer, std::size_t index, const GdalMessages& messages) {
    const NativeItem& item = file_.items[index];
    const MedialAxis& axis = item.axis;
    const double chord = chord_of(item, options_);
    const std::vector<Branch> all = branches(axis);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Branch& branch = all[i];
      std::vector<Vec2> points;
      for (const Disk& disk : sample(axis, branch, chord)) points.push_back(disk.center);
      if (back_) {
        if (Status status = back_->transform(points); !status) return status;
      }
      auto line = std::make_unique<OGRLineString>();
      line->setNumPoints(static_cast<int>(points.size()), FALSE);
      for (std::size_t k = 0; k < points.size(); ++k) {
        line->setPoint(static_cast<int>(k), points[k].x, points[k].y);
      }

      double total = 0;
      double smallest = std::numeric_limits<double>::infinity();
      double largest = 0;
      for (const Step& step : branch.steps) {
        const Edge& edge = axis.edges[step.edge];
        total += length(axis, edge);
        const double low = narrowest_place(axis, step.edge).t;
        const double high = widest_place(axis, step.edge).t;
        smallest = std::min(smallest, disk_at(axis, edge, low).radius);
        largest = std::max(largest, disk_at(axis, edge, high).radius);
      }
      const Step& first = branch.steps.front();
      const auto& site = axis.edges[first.edge].site;
      OGRFeature feature(layer.GetLayerDefn());
      feature.SetField(0, static_cast<GIntBig>(index));
      feature.SetField(1, static_cast<GIntBig>(i));
      feature.SetField(2, axis.nodes[branch.from].disk.radius);
      feature.SetField(3, axis.nodes[branch.to].disk.radius);
      feature.SetField(4, total);
      feature.SetField(5, smallest);
      feature.SetField(6, largest);
      feature.SetField(7, site_text(axis, site[first.forward ? 0 : 1]).c_str());
      feature.SetField(8, site_text(axis, site[first.forward ? 1 : 0]).c_str());
      columns_.set(feature, 9, item.attributes);
      feature.SetGeometryDirectly(line.release());
      if (layer.CreateFeature(&feature) != OGRERR_NONE) return failed(messages);
    }
    return success();
  }

  Status write_nodes(OGRLayer& layer, std::size_t index, const GdalMessages& messages) {
    const NativeItem& item = file_.items[index];
    std::vector<Vec2> points;
    for (const Node& node : item.axis.nodes) points.push_back(node.disk.center);
    if (back_) {
      if (Status status = back_->transform(points); !status) return status;
    }
    constexpr std::array<const char*, 3> kinds{"leaf", "site_change", "branching"};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Node& node = item.axis.nodes[i];
      OGRFeature feature(layer.GetLayerDefn());
      feature.SetField(0, static_cast<GIntBig>(index));
      feature.SetField(1, static_cast<GIntBig>(i));
      feature.SetField(2, node.disk.radius);
      feature.SetField(3, kinds[static_cast<std::size_t>(node.kind)]);
      columns_.set(feature, 4, item.attributes);
      feature.SetGeometryDirectly(new OGRPoint(points[i].x, points[i].y));
      if (layer.CreateFeature(&feature) != OGRERR_NONE) return failed(messages);
    }
    return success();
  }

  const NativeFile& file_;
  const WriteOptions& options_;
  std::string shown_;
  AttributeColumns columns_;
  OGRSpatialReference crs_;
  bool has_crs_ = false;
  std::optional<BackToGeographic> back_;
};

}  // namespace

Status write_gdal(const std::string& path, const std::string& format, const NativeFile& file,
                  const WriteOptions& options) {
  return GdalWriter(file, options, path).write(path, format);
}

}  // namespace medial::io
