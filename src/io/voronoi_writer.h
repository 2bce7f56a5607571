#pragma once

#include "io/output.h"
#include "medial/io/write.h"

namespace medial::io {

/// Voronoi diagrams as medial's own JSON (docs/format.md), without loss; and as GeoJSON.
void write_voronoi_json(OutputStream& out, const VoronoiFile& file);
void write_voronoi_geojson(OutputStream& out, const VoronoiFile& file, const WriteOptions& options);

}  // namespace medial::io
