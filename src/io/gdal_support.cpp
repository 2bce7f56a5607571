#include "io/gdal_support.h"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <string_view>

namespace medial::io {

namespace {

/// The bulge of the arc from a through m to b: tangent of half the angle by which its chords turn
/// at m, which is half of the arc's angle. Not a number where a coordinate is none, or overflows.
double bulge_of(Vec2 a, Vec2 m, Vec2 b) {
  const Vec2 u = m - a;
  const Vec2 v = b - m;
  const double scale = norm(u) * norm(v) + dot(u, v);
  if (!std::isfinite(scale)) return std::numeric_limits<double>::quiet_NaN();
  return scale > 0 ? cross(u, v) / scale : 0;
}

/// Appends the points of a piece of a ring; its first one is the last of the piece before.
void add_curve(const OGRSimpleCurve& curve, Ring& ring) {
  const int count = curve.getNumPoints();
  const auto point = [&curve](int i) { return Vec2{curve.getX(i), curve.getY(i)}; };
  const bool circular = wkbFlatten(curve.getGeometryType()) == wkbCircularString;
  if (ring.points.empty() && count > 0) ring.points.push_back(point(0));
  if (circular || !ring.bulges.empty()) ring.bulges.resize(ring.points.size(), 0);
  ring.points.reserve(ring.points.size() + static_cast<std::size_t>(count));
  if (!circular) {
    for (int i = 1; i < count; ++i) ring.points.push_back(point(i));
    if (!ring.bulges.empty()) ring.bulges.resize(ring.points.size(), 0);
    return;
  }
  for (int i = 2; i < count; i += 2) {
    const Vec2 a = ring.points.back();
    const Vec2 m = point(i - 1);
    const Vec2 b = point(i);
    if (a == b) {  // a whole circle, by its diameter
      ring.bulges.back() = 1;
      ring.points.push_back(m);
      ring.bulges.push_back(1);
    } else {
      ring.bulges.back() = bulge_of(a, m, b);
    }
    ring.points.push_back(b);
    ring.bulges.push_back(0);
  }
}

void add_ring(const OGRCurve& source, Ring& ring) {
  if (wkbFlatten(source.getGeometryType()) == wkbCompoundCurve) {
    for (const OGRCurve* part : *source.toCompoundCurve()) add_curve(*part->toSimpleCurve(), ring);
  } else {
    add_curve(*source.toSimpleCurve(), ring);
  }
}

void add_polygon(const OGRCurvePolygon& polygon, std::vector<Ring>& rings) {
  RingRole role = RingRole::outer;
  for (const OGRCurve* source : polygon) {
    Ring& ring = rings.emplace_back();
    ring.role = role;
    role = RingRole::hole;
    add_ring(*source, ring);
  }
}

}  // namespace

void register_gdal() {
  static std::once_flag once;
  std::call_once(once, [] {
    // Nothing is written beside what is read.
    CPLSetConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
    GDALAllRegister();
  });
}

MemoryFile::MemoryFile(std::string& bytes)
    : name_(fmt::format("/vsimem/medial_{}", static_cast<const void*>(&bytes))) {
  VSILFILE* file = VSIFileFromMemBuffer(name_.c_str(), reinterpret_cast<GByte*>(bytes.data()),
                                        bytes.size(), FALSE);
  if (file == nullptr)
    name_.clear();
  else
    VSIFCloseL(file);
}

MemoryFile::~MemoryFile() {
  if (!name_.empty()) VSIUnlink(name_.c_str());
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
  constexpr std::size_t enough = 20;  // a broken file can warn at each of its features
  if (level == CE_Warning) {
    if (self->warnings_.size() < enough &&
        std::ranges::find(self->warnings_, line) == self->warnings_.end()) {
      self->warnings_.push_back(std::move(line));
    }
  } else if (self->failure_.empty()) {
    self->failure_ = std::move(line);
  }
}

namespace {

/// Appends a point or a line; false where the geometry is neither.
bool add_chain(const OGRGeometry& part, std::vector<Chain>& chains) {
  switch (wkbFlatten(part.getGeometryType())) {
    case wkbPoint: {
      const OGRPoint* point = part.toPoint();
      if (!point->IsEmpty()) chains.push_back({{{point->getX(), point->getY()}}});
      return true;
    }
    case wkbLineString:
    case wkbCircularString:
    case wkbCompoundCurve: {
      Ring line;
      add_ring(*part.toCurve(), line);
      if (!line.points.empty())
        chains.push_back({std::move(line.points), std::move(line.bulges), false});
      return true;
    }
    default:
      return false;
  }
}

}  // namespace

void add_loose(const OGRGeometry& geometry, Feature& feature, GeometryCounts& counts) {
  std::vector<const OGRGeometry*> waiting{&geometry};
  while (!waiting.empty()) {
    const OGRGeometry* part = waiting.back();
    waiting.pop_back();
    if (add_chain(*part, feature.chains)) continue;
    const OGRwkbGeometryType type = wkbFlatten(part->getGeometryType());
    if (type == wkbMultiPoint || type == wkbMultiLineString || type == wkbMultiCurve ||
        type == wkbGeometryCollection) {
      const OGRGeometryCollection* collection = part->toGeometryCollection();
      for (int i = collection->getNumGeometries(); i > 0; --i)
        waiting.push_back(collection->getGeometryRef(i - 1));
      continue;
    }
    add_rings(*part, feature.rings, counts);
  }
}

void add_rings(const OGRGeometry& geometry, std::vector<Ring>& rings, GeometryCounts& counts) {
  std::vector<const OGRGeometry*> waiting{&geometry};
  while (!waiting.empty()) {
    const OGRGeometry* part = waiting.back();
    waiting.pop_back();
    switch (wkbFlatten(part->getGeometryType())) {
      case wkbPolygon:
      case wkbTriangle:
      case wkbCurvePolygon:
        add_polygon(*part->toCurvePolygon(), rings);
        break;
      case wkbMultiPolygon:
      case wkbMultiSurface:
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

Status add_wkt(const std::string& text, bool loose, Feature& feature) {
  constexpr std::ptrdiff_t deepest_bracket = 8;  // GDAL reads nested brackets by recursion
  std::ptrdiff_t depth = 0;
  for (const char c : text) {
    if (c == '(' && ++depth > deepest_bracket) {
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
                 messages.failure().empty() ? "this is not well-known text" : messages.failure(),
                 {}};
  }
  GeometryCounts counts;
  if (loose)
    add_loose(*geometry, feature, counts);
  else
    add_rings(*geometry, feature.rings, counts);
  return success();
}

namespace {

void describe_units(const OGRSpatialReference& reference, Document<Feature>& dataset) {
  dataset.geographic = reference.IsGeographic() != 0;
  if (dataset.geographic)
    dataset.unit = Unit::degree;
  else
    dataset.unit = unit_of_length(1e3 * reference.GetLinearUnits());
}

}  // namespace

void set_crs(const OGRSpatialReference& reference, Document<Feature>& dataset) {
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  if (reference.exportToWkt(&text, options) == OGRERR_NONE && text != nullptr) {
    dataset.crs_wkt = text;
    describe_units(reference, dataset);
  }
  CPLFree(text);
}

Status read_crs_by_name(const std::string& name, Document<Feature>& dataset) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  if (reference.SetFromUserInput(
          name.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) != OGRERR_NONE)
    return Error{ErrorCode::invalid_option,
                 fmt::format("'{}' does not name a reference system; use EPSG:n or WKT", name),
                 {}};
  set_crs(reference, dataset);
  return success();
}

void read_crs_of_epsg(int code, Document<Feature>& dataset) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  if (reference.importFromEPSG(code) == OGRERR_NONE) {
    set_crs(reference, dataset);
  } else {
    dataset.notes.push_back(fmt::format("the reference system EPSG:{} is not known", code));
  }
}

void read_crs_of_wkt(const std::string& wkt, Document<Feature>& dataset) {
  if (wkt.empty()) return;
  const GdalMessages messages;
  dataset.crs_wkt = wkt;
  OGRSpatialReference reference;
  if (reference.importFromWkt(wkt.c_str()) == OGRERR_NONE) {
    describe_units(reference, dataset);
  } else {
    dataset.notes.push_back("the reference system is not understood");
  }
}

}  // namespace medial::io
