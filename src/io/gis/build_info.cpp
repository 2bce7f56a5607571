
#include <fmt/format.h>
#include <gdal.h>
#include <geos_c.h>
#include <ogr_srs_api.h>
#include <simdjson.h>
#include <zlib.h>
#include <zstd.h>
#ifdef MEDIAL_DXF
#include <dxflib/dl_dxf.h>
#endif

#include "io/format.h"
#include "io/gis/gdal_support.h"
#include "io/modules.h"

namespace medial::io {
namespace {

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
      {"simdjson", SIMDJSON_STRINGIFY(SIMDJSON_VERSION)},
      {"zlib", zlibVersion()},
      {"zstd", ZSTD_versionString()},
#ifdef MEDIAL_DXF
      {"dxflib", DL_VERSION},
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
  for (const Attributes& part : {svg_libraries(), drawing_libraries()})
    info.libraries.insert(info.libraries.end(), part.begin(), part.end());
  for (const Format& format : formats_at_hand())
    for (const std::string_view each : {format.extensions, format.also_read})
      if ((format.read != nullptr || format.is_known_to_hold(DocumentKind::mesh)) && !each.empty())
        (info.extensions += info.extensions.empty() ? "" : " ") += each;
  return info;
}

}  // namespace medial::io
