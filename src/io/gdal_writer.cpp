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
#include "io/gdal_target.h"
#include "io/gpkg_index.h"
#include "io/table_writer.h"
#include "medial/centreline.h"
#include "medial/query.h"

namespace medial::io {

namespace {

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
  GdalWriter(const NativeFile& file, const WriteOptions& options, const OutputCrs& crs)
      : file_(file), options_(options), crs_(crs), columns_(columns_of(file)) {}

  Status write_layers(GDALDataset& target, const std::string& format,
                      const GdalMessages& messages) {
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
    if (lines == nullptr) return cannot_write(messages);
    for (std::size_t i = 0; i < file_.items.size(); ++i) {
      if (Status status = write_branches(*lines, i, messages); !status) return status;
    }
    if (Status status = write_index(messages); !status) return status;
    if (format == "gpkg") {
      OGRLayer* nodes = create_layer(
          target, "nodes", wkbPoint,
          {{"feature", OFTInteger64}, {"node", OFTInteger64}, {"r", OFTReal}, {"kind", OFTString}});
      if (nodes == nullptr) return cannot_write(messages);
      for (std::size_t i = 0; i < file_.items.size(); ++i) {
        if (Status status = write_nodes(*nodes, i, messages); !status) return status;
      }
      if (Status status = write_index(messages); !status) return status;
    }
    return success();
  }

 private:
  Status write_index(const GdalMessages& messages) {
    return index_ ? index_->write(messages) : success();
  }

  OGRLayer* create_layer(GDALDataset& target, const char* name, OGRwkbGeometryType type,
                         std::initializer_list<std::pair<const char*, OGRFieldType>> fields) {
    OGRLayer* layer = target.CreateLayer(name, crs_.reference(), type,
                                         has_gpkg_index(target) ? without_index() : nullptr);
    if (layer == nullptr) return nullptr;
    for (const auto& [field, field_type] : fields) {
      OGRFieldDefn definition(field, field_type);
      if (layer->CreateField(&definition) != OGRERR_NONE) return nullptr;
    }
    if (!columns_.create_in(*layer)) return nullptr;
    index_.reset();
    if (has_gpkg_index(target)) index_.emplace(target, *layer);
    return layer;
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
      if (Status status = crs_.transform(points); !status) return status;
      auto line = std::make_unique<OGRLineString>();
      set_points(*line, points);

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
      if (layer.CreateFeature(&feature) != OGRERR_NONE) return cannot_write(messages);
      if (index_) index_->add(feature.GetFID(), points);
    }
    return success();
  }

  Status write_nodes(OGRLayer& layer, std::size_t index, const GdalMessages& messages) {
    const NativeItem& item = file_.items[index];
    std::vector<Vec2> points;
    for (const Node& node : item.axis.nodes) points.push_back(node.disk.center);
    if (Status status = crs_.transform(points); !status) return status;
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
      if (layer.CreateFeature(&feature) != OGRERR_NONE) return cannot_write(messages);
      if (index_) index_->add(feature.GetFID(), {points[i]});
    }
    return success();
  }

  const NativeFile& file_;
  const WriteOptions& options_;
  const OutputCrs& crs_;
  AttributeColumns columns_;
  std::optional<GpkgIndex> index_;  ///< of the layer being written
};

}  // namespace

Status write_gdal(const std::string& path, const std::string& format, const NativeFile& file,
                  const WriteOptions& options) {
  const Result<OutputCrs> crs = OutputCrs::make(file.crs_wkt);
  if (!crs) return crs.error();
  GdalWriter writer(file, options, *crs);
  return write_dataset(path, format, [&](GDALDataset& target, const GdalMessages& messages) {
    return writer.write_layers(target, format, messages);
  });
}

}  // namespace medial::io
