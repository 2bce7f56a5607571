#include <algorithm>

#include "io/format.h"
#include "io/format_name.h"

namespace medial::io {

// Without a library its part of a row is missing.
#ifndef MEDIAL_PICTURES
Format with_pictures(Format format) { return format; }
#endif
#ifndef MEDIAL_GIS
Format with_rasters(Format format) { return format; }
#endif
#ifndef MEDIAL_MESH
Format with_meshes(Format format) { return format; }
#endif

/// In the order in which texts are recognised, and lists of formats printed.
const std::vector<Format>& formats_at_hand() {
  static const std::vector<Format> rows{
      json_format(),
      safetensors_format(),
      geojson_format(),
#ifdef MEDIAL_GIS
      gpkg_format(),
      shp_format(),
      fgb_format(),
#endif
      wkt_format(),
      csv_format(),
      graphml_format(),
      nodelink_format(),
      edgelist_format(),
      gcode_format(),
#ifdef MEDIAL_DXF
      dxf_format(),
#endif
      with_pictures(svg_format()),
      xy_format(),  // any text that begins with a number, as drawings do
#ifdef MEDIAL_PICTURES
      with_pictures(Format{".pdf"}),
      with_rasters(png_format()),
      with_pictures(Format{".ps"}),
#endif
      ply_format(),
      vtk_format(),
      with_meshes(obj_format()),
      glb_format(),
#ifdef MEDIAL_MESH
      with_meshes(Format{".stl"}),
#endif
      off_format(),
#ifdef MEDIAL_GIS
      ros_map_format(),
      tif_format(),
      pgm_format(),
      pbm_format(),
      image_format(),
      gdal_format(),
#endif
  };
  return rows;
}

#ifndef MEDIAL_LATE
Result<const std::vector<Format>*> formats_in(Module) { return &formats_at_hand(); }
#endif

bool lists_extension(std::string_view extensions, std::string_view extension) {
  while (!extensions.empty()) {
    const std::size_t end = std::min(extensions.find(' '), extensions.size());
    if (extensions.substr(1, end - 1) == extension) return true;
    extensions.remove_prefix(std::min(end + 1, extensions.size()));
  }
  return false;
}

Result<const Format*> find_format(std::string_view extension, DocumentKind kind) {
  const auto first = [&](const std::vector<Format>& rows, const auto& does) -> const Format* {
    const auto found = std::ranges::find_if(rows, [&](const Format& row) {
      return does(row) && lists_extension(row.extensions, extension);
    });
    return found != rows.end() ? &*found : nullptr;
  };
  const auto holds = [kind](const Format& row) { return row.holds(kind); };
  if (const Format* row = first(formats_at_hand(), holds)) return row;
  for (const Module module : {Module::drawing, Module::gis}) {
    const auto announces = [&](const Format& row) { return row.is_announced(module, kind); };
    if (first(formats_at_hand(), announces) == nullptr) continue;
    const Result<const std::vector<Format>*> rows = formats_in(module);
    if (!rows) return rows.error();
    return first(**rows, holds);
  }
  return nullptr;
}

std::string formats_of(DocumentKind kind, bool growing) {
  std::string list;
  for (const Format& format : formats_at_hand())
    if (format.is_known_to_hold(kind) && (!growing || format.growing != Growing::none))
      (list += list.empty() ? "" : " ") += format.extensions;
  return list;
}

}  // namespace medial::io
