#pragma once

// What gis/ does, as one table. GDAL with the libraries that it needs takes longer to load than
// most axes to compute: the command line has gis/ in a shared module, which late_gis.cpp loads when
// something first asks for it.

#include "io/format.h"
#include "io/reference_system.h"
#include "io/repair.h"

namespace medial::io {

/// The functions of the same names, and the whole table of formats.
struct GisModule {
  const std::vector<Format>& (*formats)();
  void (*describe)(Document<Feature>&);
  Status (*describe_by_name)(const std::string&, Document<Feature>&);
  decltype(&io::degrees_of_unit) degrees_of_unit;
  decltype(&io::output_crs_of) output_crs_of;
  decltype(&io::urn_of_crs) urn_of_crs;
  decltype(&io::project_to_local) project_to_local;
  decltype(&io::note_stretch) note_stretch;
  decltype(&io::make_valid) make_valid;
  decltype(&io::read_image) read_image;
  decltype(&io::build_info) build_info;
};

/// The one symbol that the module is asked for, of type GisModule.
constexpr const char* gis_module_name = "medial_gis_module";

}  // namespace medial::io
