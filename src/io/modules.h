#pragma once

// What gis/, pictures/ and the reader of SVG do, as one table each. GDAL, Cairo with Assimp, and
// libxml2, with the libraries that they need take longer to load than most axes to compute, and
// more memory: the command line has them in shared modules, which late_modules.cpp loads when
// something first asks for them, if their MEDIAL_STAMP is the program's (cmake/stamp.cmake).

#include "io/format.h"
#include "io/formats/svg.h"
#include "io/reference_system.h"
#include "io/repair.h"

namespace medial::io {

/// Names and versions of the libraries that a module loads, or why it cannot be loaded.
Attributes svg_libraries();
Attributes drawing_libraries();

/// The functions of the same names. Each table says what its module is for, its file, and the
/// symbol that the module has for the table.
struct SvgModule {
  static constexpr const char* part = "reading SVG";
  static constexpr const char* file = "medial_svg.so";
  static constexpr const char* symbol = "medial_svg_table";
  const char* stamp;
  decltype(&io::svg_libraries) libraries;
  decltype(&io::read_svg) read_svg;
};

/// The same, and the table of formats with pictures and meshes.
struct DrawModule {
  static constexpr const char* part = "pictures, meshes and fonts";
  static constexpr const char* file = "medial_draw.so";
  static constexpr const char* symbol = "medial_draw_table";
  const char* stamp;
  decltype(&io::drawing_libraries) libraries;
  decltype(&io::formats_at_hand) formats;
  decltype(&io::read_text) read_text;
};

/// The same, and the table of formats with those of GIS.
struct GisModule {
  static constexpr const char* part = "GIS formats and images";
  static constexpr const char* file = "medial_gis.so";
  static constexpr const char* symbol = "medial_gis_table";
  const char* stamp;
  decltype(&io::formats_at_hand) formats;
  void (*describe)(DocumentInfo&);
  Status (*describe_by_name)(const std::string&, DocumentInfo&);
  decltype(&io::degrees_of_unit) degrees_of_unit;
  decltype(&io::output_crs_of) output_crs_of;
  decltype(&io::urn_of_crs) urn_of_crs;
  decltype(&io::project_to_local) project_to_local;
  decltype(&io::note_stretch) note_stretch;
  decltype(&io::make_valid) make_valid;
  decltype(&io::read_image) read_image;
  decltype(&io::build_info) build_info;
};

}  // namespace medial::io
