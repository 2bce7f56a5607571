#pragma once

#include <cpl_error.h>

#include <functional>
#include <string>
#include <vector>

#include "medial/io/read.h"

class OGRGeometry;
class OGRSpatialReference;

namespace medial::io {

class OutputStream;

/// Registers GDAL's drivers, once.
void register_gdal();

/// Collects what GDAL reports on this thread while the object lives; nothing is printed.
class GdalMessages {
 public:
  GdalMessages();
  ~GdalMessages();
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  /// The first failure, in GDAL's words on one line; empty if there was none.
  const std::string& failure() const { return failure_; }
  /// Different warnings, in order.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  static void CPL_STDCALL collect(CPLErr level, CPLErrorNum number, const char* text);
  std::string failure_;
  std::vector<std::string> warnings_;
};

/// Lets `write` make a file of one format through GDAL in memory, and its bytes go on to the
/// stream: because a stream cannot seek, or because some drivers of GDAL (GeoJSON) do not notice a
/// full disk. The file is called `name`, which may stand in the bytes. Errors: unsupported (a
/// shapefile is several files), and those of `write`.
Status put_gdal_file(OutputStream& out, const std::string& name, const std::string& format,
                     const std::function<Status(const std::string& path)>& write);

/// What a geometry held besides polygons.
struct GeometryCounts {
  std::uint64_t others = 0;  ///< geometries that are no polygons
};

/// Appends the rings of all polygons in a geometry, outer rings before their holes. Circular arcs
/// stay arcs.
void add_rings(const OGRGeometry& geometry, std::vector<Ring>& rings, GeometryCounts& counts);

/// The same for a planar graph: also its lines, open or closed, and points, as chains.
void add_loose(const OGRGeometry& geometry, std::vector<Ring>& rings, std::vector<Chain>& chains,
               GeometryCounts& counts);

/// The same for a geometry as well-known text. Errors: malformed, unsupported (nested too deeply).
Status add_rings_of_wkt(const std::string& text, std::vector<Ring>& rings);
Status add_chains_of_wkt(const std::string& text, std::vector<Chain>& chains);

/// Sets crs_wkt and geographic; a reference system that cannot be told becomes a note.
void set_crs(const OGRSpatialReference& reference, Document<Feature>& dataset);
void read_crs_of_epsg(int code, Document<Feature>& dataset);
void read_crs_of_wkt(const std::string& wkt, Document<Feature>& dataset);

}  // namespace medial::io
