#include <algorithm>

#include "io/format.h"
#include "io/format_name.h"

namespace medial::io {

// Without a library its part of a row is missing.
#ifndef MEDIAL_GIS
Format with_pictures(Format format) { return format; }
#endif
#ifndef MEDIAL_MESH
Format with_meshes(Format format) { return format; }
#endif

/// In the order in which texts are recognised, and lists of formats printed.
const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      json_format(),
      geojson_format(),
#ifdef MEDIAL_GIS
      gpkg_format(),
      shp_format(),
      fgb_format(),
#endif
      wkt_format(),
      csv_format(),
      xy_format(),
      graphml_format(),
      nodelink_format(),
      edgelist_format(),
      gcode_format(),
#ifdef MEDIAL_DXF
      dxf_format(),
#endif
      with_pictures(svg_format()),
#ifdef MEDIAL_GIS
      with_pictures(Format{".pdf"}),
      png_format(),
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
  return all;
}

bool lists_extension(std::string_view extensions, std::string_view extension) {
  while (!extensions.empty()) {
    const std::size_t end = std::min(extensions.find(' '), extensions.size());
    if (extensions.substr(1, end - 1) == extension) return true;
    extensions.remove_prefix(std::min(end + 1, extensions.size()));
  }
  return false;
}

const Format* find_format(std::string_view extension, DocumentKind kind) {
  for (const Format& format : formats())
    if (format.holds(kind) && lists_extension(format.extensions, extension)) return &format;
  return nullptr;
}

std::string formats_of(DocumentKind kind) {
  std::string list;
  for (const Format& format : formats())
    if (format.holds(kind)) (list += list.empty() ? "" : " ") += format.extensions;
  return list;
}

}  // namespace medial::io
