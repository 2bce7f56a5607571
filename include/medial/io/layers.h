#pragma once

// Loose geometries with values, in layers: what measuring a shape gives besides axes.

#include <cstdint>
#include <string>
#include <vector>

#include "medial/document.h"
#include "medial/error.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/vec2.h"

namespace medial::io {

enum class LayerKind : std::uint8_t {
  disks,     ///< points; the first value is the radius
  lines,     ///< one part: the points of the line
  polygons,  ///< the parts are rings, the outer one first
};

struct LayerFeature {
  std::uint32_t feature = 0;             ///< of the input, whose attributes it gets
  std::vector<std::vector<Vec2>> parts;  ///< of the kind that the layer tells
  std::vector<double> values;            ///< one for each field of the layer
};

struct Layer {
  std::string name;
  LayerKind kind = LayerKind::lines;
  std::vector<std::string> fields;
  std::vector<LayerFeature> features;
};

struct LayerFile {
  std::vector<Layer> layers;
  /// Of the features of the input: name and value, as they were read.
  std::vector<Attributes> attributes;
  std::string crs_wkt;
};

/// Writes layers by the extension of `path`, as write_axes() does: .geojson and .wkt (all layers
/// one after another, .geojson with a member "layer"), .gpkg (a layer each), .shp and .fgb (one
/// layer only), .svg .pdf .png .ps (drawn over `background`: its shapes and axes). Points of a
/// local projection go back to longitude and latitude, values stay as they are. Errors:
/// unsupported, unwritable.
Status write_layers(const std::string& path, const std::string& format, const LayerFile& file,
                    const Document<AxisItem>& background, const WriteOptions& options = {});

/// The extensions write_layers() takes, for help texts.
std::string known_layer_formats();

}  // namespace medial::io
