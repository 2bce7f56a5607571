#pragma once

// What libraries of GIS do for all formats. gis/ has it from GDAL and GEOS; without_gis.cpp stands
// in where the library is built without them.

#include <string>

#include "io/degrees.h"
#include "io/output_crs.h"
#include "medial/io/read.h"

namespace medial::io {

/// A document's reference system may be named "EPSG:n" or WKT: makes it WKT, and sets the unit and
/// whether it is geographic. One that is not understood becomes a note.
void describe_crs(DocumentInfo& document);
/// Gives the document the named system instead. Errors: invalid_option (it names none).
Status describe_crs(const std::string& name, DocumentInfo& document);
/// How many degrees the unit of longitudes and latitudes is, such as 0.9 for grads; by default 1.
double degrees_of_unit(const std::string& crs_wkt);

/// See ReadOptions::project. Errors: invalid_option (no degrees), unsupported (points that cannot
/// be projected).
Status project_to_local(Document<Feature>& document);

/// Adds a note if lengths in the projected reference system are off by more than one percent at one
/// of these points, so that project_to_local() would help.
void note_stretch(DocumentInfo& document, const Extremes& extremes);

/// The reference system of an output: that of the document, or what its coordinates were before
/// where that is a local projection of project_to_local(). Errors: malformed (not understood),
/// unsupported (a local projection that cannot be undone).
Result<OutputCrs> output_crs_of(const std::string& crs_wkt, Unit unit);

/// The name of a reference system as a uniform resource name of the OGC; empty where it has no
/// code.
std::string urn_of_crs(const std::string& crs_wkt);

}  // namespace medial::io
