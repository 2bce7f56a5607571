// Stands in for gis/ in a library without GDAL and GEOS: reference systems stay the names that
// files give them.

#include "io/reference_system.h"
#include "io/repair.h"

namespace medial::io {

namespace {

Error missing(const char* libraries, const char* work) {
  return {ErrorCode::unsupported,
          std::string("this build has no ") + libraries + ", and cannot " + work,
          {}};
}

}  // namespace

void describe_crs(DocumentInfo&) {}

Status describe_crs(const std::string& name, DocumentInfo& document) {
  document.crs_wkt = name;
  return success();
}

double degrees_of_unit(const std::string&) { return 1; }

Result<OutputCrs> output_crs_of(const std::string& crs_wkt, Unit unit) {
  return OutputCrs{crs_wkt, unit, nullptr};
}

std::string urn_of_crs(const std::string&) { return {}; }

Status project_to_local(Document<Feature>&) { return missing("GDAL", "project"); }

void note_stretch(DocumentInfo&, const Extremes&) {}

/// load_shapes() mends these by noding.
Status make_valid(Feature&, std::size_t, std::vector<std::string>&) { return success(); }

#ifndef MEDIAL_FONTS
Result<Document<Feature>> read_text(const std::string&, const std::string&, double) {
  return missing("FreeType", "draw a text");
}
#endif

}  // namespace medial::io
