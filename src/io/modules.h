#pragma once

// What gis/ and pictures/ do, as one table each. GDAL, and Cairo and Assimp, with the libraries
// that they need take longer to load than most axes to compute, and more memory: the command line
// has them in shared modules, which late_modules.cpp loads when something first asks for them, if
// their MEDIAL_STAMP is the program's (cmake/stamp.cmake).

#include "io/format.h"
#include "io/reference_system.h"
#include "io/repair.h"

namespace medial::io {

/// Names and versions of the libraries that pictures/ loads, or why it cannot be loaded.
Attributes drawing_libraries();

/// The functions of the same names, and the table of formats with pictures and meshes.
struct DrawModule {
  const char* stamp;
  decltype(&io::formats_at_hand) formats;
  decltype(&io::drawing_libraries) drawing_libraries;
  decltype(&io::read_text) read_text;
};

/// The same, and the table of formats with those of GIS.
struct GisModule {
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

/// The symbols that the modules are asked for, of these types.
constexpr const char* draw_module_name = "medial_draw_table";
constexpr const char* gis_module_name = "medial_gis_table";

}  // namespace medial::io
