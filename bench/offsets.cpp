// medial_bench_offsets: ten offset curves of one polygon, compared with GEOS's buffers; one thread,
// best of several rounds, processor time. Prints Markdown.
//
//   medial_bench_offsets [FILE]     (default: the coastline of New Guinea)

#include <geos_c.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "clock.h"
#include "medial/io/read.h"
#include "medial/offset.h"
#include "support/environment.h"

namespace {

using namespace medial;

constexpr int rounds = 3;
constexpr int quadrant_segments = 8;  // GEOS's default: chords within 0.5 % of the distance

GEOSGeometry* polygon_of(GEOSContextHandle_t geos, const Shape& shape) {
  std::vector<GEOSGeometry*> holes;
  GEOSGeometry* outer = nullptr;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    const auto count = static_cast<unsigned>(loop.size());
    GEOSCoordSequence* points = GEOSCoordSeq_create_r(geos, count + 1, 2);
    for (unsigned k = 0; k <= count; ++k)
      GEOSCoordSeq_setXY_r(geos, points, k, loop[k % count].x, loop[k % count].y);
    GEOSGeometry* ring = GEOSGeom_createLinearRing_r(geos, points);
    if (shape.hole[i]) {
      holes.push_back(ring);
    } else {
      outer = ring;
    }
  }
  return GEOSGeom_createPolygon_r(geos, outer, holes.data(), static_cast<unsigned>(holes.size()));
}

void measure(const char* name, const Shape& shape, const std::vector<double>& clearances) {
  double own = std::numeric_limits<double>::infinity(), axis = 0, peer = own;
  std::size_t regions = 0;
  Options options;
  options.threads = 1;
  for (int round = 0; round < rounds; ++round) {
    const double begin = bench::processor_seconds();
    const auto offsets = offset_curves(shape, clearances, options);
    const double seconds = bench::processor_seconds() - begin;
    if (!offsets) {
      std::printf("%s\n", to_string(offsets.error()).c_str());
      std::exit(1);
    }
    regions = offsets->regions.size();
    if (seconds < own) own = seconds, axis = offsets->seconds_axis;
  }
  GEOSContextHandle_t geos = GEOS_init_r();
  GEOSGeometry* polygon = polygon_of(geos, shape);
  int parts = 0;
  for (int round = 0; round < 1; ++round) {
    parts = 0;
    const double begin = bench::processor_seconds();
    for (const double c : clearances) {
      GEOSGeometry* buffer = GEOSBuffer_r(geos, polygon, -c, quadrant_segments);
      parts += GEOSGetNumGeometries_r(geos, buffer);
      GEOSGeom_destroy_r(geos, buffer);
    }
    peer = std::min(peer, bench::processor_seconds() - begin);
  }
  GEOSGeom_destroy_r(geos, polygon);
  GEOS_finish_r(geos);
  std::printf("| %s | %zu | %.3f | %zu | %.3f | %d | %.1f |\n", name, shape.points.size(), own,
              regions, peer, parts, peer / own);
  (void)axis;
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string path =
      argc > 1 ? argv[1]
               : (test::data_folder() / "packaged/A_gis/gshhg/new_guinea.wkt.gz").string();
  const auto dataset = io::read_document(path);
  if (!dataset) {
    std::printf("%s\n", to_string(dataset.error()).c_str());
    return 1;
  }
  const auto shape = build_shape(dataset->items.at(0).rings);
  if (!shape) return 1;
  // From a few hundred metres to half of the largest inscribed circle, of a coastline in degrees.
  const double size = diagonal(bounding_box(*shape));
  std::vector<double> inside, outside;
  for (int i = 1; i <= 10; ++i) {
    const double d = size * 2e-3 * i;
    inside.push_back(d);
    outside.push_back(-d);
  }
  std::vector<double> fine;
  for (const double d : inside) fine.push_back(d / 20);
  std::puts("| offsets | vertices | medial s | regions | GEOS s | parts | times |");
  std::puts("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
  measure("10 inwards", *shape, inside);
  measure("10 inwards, fine", *shape, fine);
  measure("10 outwards", *shape, outside);
  return 0;
}
