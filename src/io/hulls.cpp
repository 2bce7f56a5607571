#include "io/hulls.h"

#include <fmt/format.h>
#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

namespace medial::io {

namespace {

using std::numbers::pi;

/// What GEOS works in: errors are kept, nothing is printed.
struct Context {
  std::string message;
  GEOSContextHandle_t handle = GEOS_init_r();

  Context() {
    GEOSContext_setErrorMessageHandler_r(
        handle, [](const char* text, void* kept) { *static_cast<std::string*>(kept) = text; },
        &message);
  }
  ~Context() { GEOS_finish_r(handle); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

struct Release {
  GEOSContextHandle_t handle;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Release>;

/// Points of a circle from one angle to another, counter-clockwise: both ends, and between them the
/// multiples of one step, so that hulls that share a disk share them.
void add_arc(const Disk& disk, double from, double to, double chord, std::vector<Vec2>& out) {
  const auto at = [&disk](double angle) {
    return disk.center + disk.radius * Vec2{std::cos(angle), std::sin(angle)};
  };
  out.push_back(at(from));
  if (disk.radius > chord) {
    constexpr double fewest = 8, most = 4096;  // steps of a whole circle
    const double half = std::acos(1 - chord / disk.radius);
    const double step = 2 * pi / std::clamp(std::ceil(pi / half), fewest, most);
    for (double k = std::floor(from / step) + 1; k * step < to; ++k) out.push_back(at(k * step));
  }
  out.push_back(at(to));
}

/// The hull of two disks; a circle where one holds the other. Empty without area.
std::vector<Vec2> hull_of(const Disk& a, const Disk& b, double chord) {
  std::vector<Vec2> points;
  const Vec2 d = b.center - a.center;
  const double length = norm(d);
  if (length <= std::abs(a.radius - b.radius)) {
    const Disk& larger = a.radius >= b.radius ? a : b;
    if (!(larger.radius > 0)) return {};
    add_arc(larger, 0, 2 * pi, chord, points);
  } else {
    const double along = std::atan2(d.y, d.x);
    const double open = std::acos(std::clamp((a.radius - b.radius) / length, -1.0, 1.0));
    add_arc(b, along - open, along + open, chord, points);
    add_arc(a, along + open, along - open + 2 * pi, chord, points);
  }
  points.erase(std::unique(points.begin(), points.end()), points.end());
  while (points.size() > 1 && points.back() == points.front()) points.pop_back();
  if (points.size() < 3) return {};
  points.push_back(points.front());
  return points;
}

class HullUnion {
 public:
  explicit HullUnion(double chord) : chord_(chord) {}
  ~HullUnion() {
    for (GEOSGeometry* part : parts_) GEOSGeom_destroy_r(context_.handle, part);
  }
  HullUnion(const HullUnion&) = delete;
  HullUnion& operator=(const HullUnion&) = delete;

  Status add(const Disk& a, const Disk& b) {
    const std::vector<Vec2> points = hull_of(a, b, chord_);
    if (points.empty()) return success();
    GEOSCoordSequence* sequence = GEOSCoordSeq_copyFromBuffer_r(
        context_.handle, &points.front().x, static_cast<unsigned>(points.size()), 0, 0);
    GEOSGeometry* ring =
        sequence == nullptr ? nullptr : GEOSGeom_createLinearRing_r(context_.handle, sequence);
    GEOSGeometry* polygon =
        ring == nullptr ? nullptr : GEOSGeom_createPolygon_r(context_.handle, ring, nullptr, 0);
    if (polygon == nullptr) return failed();
    parts_.push_back(polygon);
    return success();
  }

  Result<std::vector<Ring>> rings() {
    if (parts_.empty()) return Error{ErrorCode::no_area, "the disks are points", {}};
    const auto count = static_cast<unsigned>(parts_.size());
    const Geometry all =
        own(GEOSGeom_createCollection_r(context_.handle, GEOS_MULTIPOLYGON, parts_.data(), count));
    if (!all) return failed();
    parts_.clear();  // the collection has them
    // On a grid far finer than the chords: crossings of doubles leave notches of one rounding.
    const double grid = std::exp2(std::floor(std::log2(chord_ / 64)));
    const Geometry whole = own(GEOSUnaryUnionPrec_r(context_.handle, all.get(), grid));
    if (!whole) return failed();
    std::vector<Ring> rings;
    const int polygons = GEOSGetNumGeometries_r(context_.handle, whole.get());
    for (int i = 0; i < polygons; ++i) {
      const GEOSGeometry* polygon = GEOSGetGeometryN_r(context_.handle, whole.get(), i);
      if (GEOSGeomTypeId_r(context_.handle, polygon) != GEOS_POLYGON) continue;
      add_ring(GEOSGetExteriorRing_r(context_.handle, polygon), RingRole::outer, rings);
      const int holes = GEOSGetNumInteriorRings_r(context_.handle, polygon);
      for (int k = 0; k < holes; ++k)
        add_ring(GEOSGetInteriorRingN_r(context_.handle, polygon, k), RingRole::hole, rings);
    }
    return rings;
  }

 private:
  Geometry own(GEOSGeometry* geometry) const {
    return Geometry(geometry, Release{context_.handle});
  }
  Error failed() const { return {ErrorCode::internal, "GEOS: " + context_.message, {}}; }

  void add_ring(const GEOSGeometry* source, RingRole role, std::vector<Ring>& rings) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_.handle, source);
    unsigned size = 0;
    if (sequence == nullptr || GEOSCoordSeq_getSize_r(context_.handle, sequence, &size) == 0)
      return;
    Ring ring;
    ring.role = role;
    ring.points.resize(size);
    if (size == 0 ||
        GEOSCoordSeq_copyToBuffer_r(context_.handle, sequence, &ring.points.front().x, 0, 0) == 0)
      return;
    rings.push_back(std::move(ring));
  }

  double chord_;
  Context context_;
  std::vector<GEOSGeometry*> parts_;
};

}  // namespace

Result<std::vector<Ring>> union_of_hulls(const MedialAxis& axis, double chord) {
  HullUnion all(chord);
  std::vector<bool> reached(axis.nodes.size(), false);
  for (const Edge& edge : axis.edges) {
    for (const std::uint32_t node : edge.node) reached[node] = true;
    const Disk &a = axis.nodes[edge.node[0]].disk, &b = axis.nodes[edge.node[1]].disk;
    if (Status status = all.add(a, b); !status) return status.error();
  }
  for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
    if (reached[i]) continue;
    const Disk& disk = axis.nodes[i].disk;
    if (Status status = all.add(disk, disk); !status) return status.error();
  }
  return all.rings();
}

}  // namespace medial::io
