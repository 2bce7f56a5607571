#pragma once

#include <cpl_error.h>

#include <string>
#include <string_view>
#include <vector>

#include "medial/io/read.h"

class OGRGeometry;
class OGRSpatialReference;

namespace medial::io {

/// Registers GDAL's drivers, once. From then on, in the whole process, files that name a server, as
/// virtual layers or reference systems may, make GDAL open no connection.
void register_gdal();

/// `name`: of a source, from the user. If it names a server, GDAL may open connections from now on.
void allow_network_for(const std::string& name);

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

/// Bytes as a file in memory, as long as both live, whose name ends with the extension.
class MemoryFile {
 public:
  explicit MemoryFile(std::string& bytes, std::string_view extension = {});
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  /// Empty where there is none.
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

/// What a geometry held besides polygons.
struct GeometryCounts {
  std::uint64_t others = 0;  ///< geometries that are no polygons
};

/// Appends the rings of all polygons in a geometry, outer rings before their holes. Circular arcs
/// stay arcs.
void add_rings(const OGRGeometry& geometry, std::vector<Ring>& rings, GeometryCounts& counts);

/// Appends all of it for a planar graph: also lines, open or closed, and points, as chains.
void add_loose(const OGRGeometry& geometry, Feature& feature, GeometryCounts& counts);

/// A reference system by its code, as "EPSG:n", or as text; false if it is not known.
bool find_crs(const std::string& name, OGRSpatialReference& reference);

/// The name of no reference system in a GeoPackage, which otherwise holds longitudes and latitudes.
inline constexpr const char* no_reference = "Undefined Cartesian SRS";

/// Sets crs_wkt, geographic and the unit; a reference system that is not understood becomes a note.
void set_crs(const OGRSpatialReference& reference, DocumentInfo& dataset);

}  // namespace medial::io
