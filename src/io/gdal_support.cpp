#include "io/gdal_support.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <memory>
#include <mutex>

namespace medial::io {

namespace {

void add_polygon(const OGRPolygon& polygon, std::vector<Ring>& rings) {
  RingRole role = RingRole::outer;
  for (const OGRLinearRing* source : polygon) {
    Ring& ring = rings.emplace_back();
    ring.role = role;
    role = RingRole::hole;
    const int count = source->getNumPoints();
    ring.points.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      ring.points[static_cast<std::size_t>(i)] = {source->getX(i), source->getY(i)};
    }
  }
}

}  // namespace

void register_gdal() {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
}

GdalMessages::GdalMessages() { CPLPushErrorHandlerEx(&GdalMessages::collect, this); }

GdalMessages::~GdalMessages() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

void CPL_STDCALL GdalMessages::collect(CPLErr level, CPLErrorNum, const char* text) {
  auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
  if (level == CE_Debug || level == CE_None) return;
  std::string line = text;
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' '; }, ' ');
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  constexpr std::size_t kEnough = 20;  // a broken file can warn at each of its features
  if (level == CE_Warning) {
    if (self->warnings_.size() < kEnough &&
        std::ranges::find(self->warnings_, line) == self->warnings_.end()) {
      self->warnings_.push_back(std::move(line));
    }
  } else if (self->failure_.empty()) {
    self->failure_ = std::move(line);
  }
}

void add_rings(const OGRGeometry& geometry, std::vector<Ring>& rings, GeometryCounts& counts) {
  std::unique_ptr<OGRGeometry> straight;
  const OGRGeometry* whole = &geometry;
  if (geometry.hasCurveGeometry(TRUE)) {
    straight.reset(geometry.getLinearGeometry());
    if (!straight) {
      ++counts.others;
      return;
    }
    ++counts.curves;
    whole = straight.get();
  }
  std::vector<const OGRGeometry*> waiting{whole};
  while (!waiting.empty()) {
    const OGRGeometry* part = waiting.back();
    waiting.pop_back();
    switch (wkbFlatten(part->getGeometryType())) {
      case wkbPolygon:
      case wkbTriangle:
        add_polygon(*part->toPolygon(), rings);
        break;
      case wkbMultiPolygon:
      case wkbGeometryCollection: {
        const OGRGeometryCollection* collection = part->toGeometryCollection();
        for (int i = collection->getNumGeometries(); i > 0; --i) {
          waiting.push_back(collection->getGeometryRef(i - 1));
        }
        break;
      }
      default:
        ++counts.others;
    }
  }
}

Status add_rings_of_wkt(const std::string& text, std::vector<Ring>& rings) {
  constexpr std::ptrdiff_t kDeepest = 8;  // GDAL reads nested brackets by recursion
  std::ptrdiff_t depth = 0;
  for (const char c : text) {
    if (c == '(' && ++depth > kDeepest) {
      return Error{ErrorCode::unsupported, "brackets nested too deeply", {}};
    }
    if (c == ')') --depth;
  }
  const GdalMessages messages;
  OGRGeometry* read = nullptr;
  const OGRErr code = OGRGeometryFactory::createFromWkt(text.c_str(), nullptr, &read);
  const std::unique_ptr<OGRGeometry> geometry(read);
  if (code != OGRERR_NONE || !geometry) {
    return Error{ErrorCode::malformed,
                 messages.failure().empty() ? "this is no well-known text" : messages.failure(),
                 {}};
  }
  GeometryCounts counts;
  add_rings(*geometry, rings, counts);
  return success();
}

void set_crs(const OGRSpatialReference& reference, Dataset& dataset) {
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  if (reference.exportToWkt(&text, options) == OGRERR_NONE && text != nullptr) {
    dataset.crs_wkt = text;
    dataset.geographic = reference.IsGeographic() != 0;
  }
  CPLFree(text);
}

void read_crs_of_epsg(int code, Dataset& dataset) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  if (reference.importFromEPSG(code) == OGRERR_NONE) {
    set_crs(reference, dataset);
  } else {
    dataset.notes.push_back(fmt::format("the reference system EPSG:{} is not known", code));
  }
}

void read_crs_of_wkt(const std::string& wkt, Dataset& dataset) {
  if (wkt.empty()) return;
  const GdalMessages messages;
  dataset.crs_wkt = wkt;
  OGRSpatialReference reference;
  if (reference.importFromWkt(wkt.c_str()) == OGRERR_NONE) {
    dataset.geographic = reference.IsGeographic() != 0;
  } else {
    dataset.notes.push_back("the reference system is not understood");
  }
}

}  // namespace medial::io
