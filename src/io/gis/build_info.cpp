
#include <cairo.h>
#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include <gdal.h>
#include <geos_c.h>
#include <libxml/xmlversion.h>
#include <ogr_srs_api.h>
#include <simdjson.h>
#include <zlib.h>
#include <zstd.h>
#ifdef MEDIAL_DXF
#include <dxflib/dl_dxf.h>
#endif
#ifdef MEDIAL_MESH
#include <assimp/version.h>
#endif

#include "io/format.h"
#include "io/gis/gdal_support.h"

namespace medial::io {
namespace {

std::string freetype_version() {
  FT_Library library = nullptr;
  if (FT_Init_FreeType(&library) != 0) return "does not start";
  int major = 0, minor = 0, patch = 0;
  FT_Library_Version(library, &major, &minor, &patch);
  FT_Done_FreeType(library);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

std::string proj_version() {
  int major = 0, minor = 0, patch = 0;
  OSRGetPROJVersion(&major, &minor, &patch);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

Attributes loaded_libraries() {
  return {
      {"GDAL", GDALVersionInfo("RELEASE_NAME")},
      {"PROJ", proj_version()},
      {"GEOS", GEOSversion()},
      {"Cairo", cairo_version_string()},
      {"FreeType", freetype_version()},
      {"libxml2", LIBXML_DOTTED_VERSION},
      {"simdjson", SIMDJSON_STRINGIFY(SIMDJSON_VERSION)},
      {"zlib", zlibVersion()},
      {"zstd", ZSTD_versionString()},
#ifdef MEDIAL_DXF
      {"dxflib", DL_VERSION},
#endif
#ifdef MEDIAL_MESH
      {"Assimp",
       fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch())},
#endif
  };
}

std::vector<std::string> drivers_with(const char* capability) {
  std::vector<std::string> names;
  for (int i = 0; i < GDALGetDriverCount(); ++i) {
    GDALDriverH driver = GDALGetDriver(i);
    const auto has = [driver](const char* name) {
      return GDALGetMetadataItem(driver, name, nullptr) != nullptr;
    };
    if (has(capability) && has(GDAL_DCAP_OPEN)) names.emplace_back(GDALGetDriverShortName(driver));
  }
  return names;
}

bool finds_projections() {
  const GdalMessages unheard;
  OGRSpatialReferenceH reference = OSRNewSpatialReference(nullptr);
  const bool found = OSRImportFromEPSG(reference, 3857) == OGRERR_NONE;
  OSRDestroySpatialReference(reference);
  return found;
}

}  // namespace

BuildInfo build_info() {
  register_gdal();
  BuildInfo info{loaded_libraries(), "", drivers_with(GDAL_DCAP_VECTOR),
                 drivers_with(GDAL_DCAP_RASTER), finds_projections()};
  for (const Format& format : formats())
    for (const std::string_view each : {format.extensions, format.also_read})
      if ((format.read != nullptr || format.is_known_to_hold(DocumentKind::mesh)) && !each.empty())
        (info.extensions += info.extensions.empty() ? "" : " ") += each;
  return info;
}

}  // namespace medial::io
