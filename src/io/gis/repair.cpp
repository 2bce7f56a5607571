#include "io/repair.h"

#include <fmt/format.h>
#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "base/counted.h"
#include "io/place.h"

namespace medial::io {

namespace {

/// A context of GEOS: errors are kept, nothing is printed.
class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {
    GEOSContext_setErrorMessageHandler_r(handle_, &Geos::keep, &message_);
  }
  ~Geos() { GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  GEOSContextHandle_t handle() const { return handle_; }
  const std::string& message() const { return message_; }

 private:
  static void keep(const char* text, void* message) { *static_cast<std::string*>(message) = text; }
  std::string message_;
  GEOSContextHandle_t handle_;
};

struct Destroy {
  GEOSContextHandle_t handle;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

/// A ring that is closed and has no equal neighbours; empty if it has fewer than three points.
std::vector<Vec2> closed_ring(const Ring& ring) {
  std::vector<Vec2> points = ring.points;
  points.erase(std::unique(points.begin(), points.end()), points.end());
  while (points.size() > 1 && points.back() == points.front()) points.pop_back();
  if (points.size() < 3) return {};
  points.push_back(points.front());
  return points;
}

double signed_area(std::span<const Vec2> ring) {
  if (ring.size() < 3) return 0;
  double twice = 0;  // around the first vertex, so that a distant origin costs no digits
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    twice += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  }
  return 0.5 * twice;
}

struct Counts {
  std::size_t rings = 0;
  std::size_t vertices = 0;
  double area = 0;
};

Counts counts_of(const std::vector<Ring>& rings) {
  Counts counts;
  for (const Ring& ring : rings) {
    const std::vector<Vec2> points = closed_ring(ring);
    ++counts.rings;
    counts.vertices += points.empty() ? 0 : points.size() - 1;
    const double area = std::fabs(signed_area(points));
    counts.area += ring.role == RingRole::hole ? -area : area;
  }
  return counts;
}

std::string described(const Counts& counts) {
  return fmt::format("{}, {} vertices, area {:.10g}", counted(counts.rings, "ring"),
                     counts.vertices, counts.area);
}

class Repairer {
 public:
  explicit Repairer(const std::vector<Ring>& rings) {
    for (const Ring& ring : rings) {
      closed_.push_back(closed_ring(ring));
      roles_.push_back(ring.role);
    }
  }

  bool valid() const {
    if (std::ranges::any_of(closed_, [](const auto& ring) { return ring.empty(); })) return false;
    const Geometry whole = polygons();
    return whole && GEOSisValid_r(geos_.handle(), whole.get()) == 1;
  }

  Result<std::vector<Ring>> repaired() const {
    Geometry result = made_valid(polygons());
    if (result && GEOSisValid_r(geos_.handle(), result.get()) != 1) result = made_valid(result);
    if (!result)
      return Error{
          ErrorCode::internal, fmt::format("GEOS cannot repair this: {}", geos_.message()), {}};
    std::vector<Ring> rings;
    collect(result.get(), rings);
    return rings;
  }

 private:
  Geometry own(GEOSGeometry* geometry) const { return Geometry(geometry, Destroy{geos_.handle()}); }

  /// Gives up the ownership of all, for GEOS's functions that take it.
  static std::vector<GEOSGeometry*> released(std::vector<Geometry>& parts) {
    std::vector<GEOSGeometry*> raw;
    raw.reserve(parts.size());
    for (Geometry& part : parts) raw.push_back(part.release());
    return raw;
  }

  Geometry ring_of(std::span<const Vec2> points) const {
    static_assert(sizeof(Vec2) == 2 * sizeof(double));
    GEOSCoordSequence* sequence = GEOSCoordSeq_copyFromBuffer_r(
        geos_.handle(), &points.front().x, static_cast<unsigned>(points.size()), 0, 0);
    return own(sequence == nullptr ? nullptr
                                   : GEOSGeom_createLinearRing_r(geos_.handle(), sequence));
  }

  /// All rings as one multipolygon by their roles; null if GEOS does not take them.
  Geometry polygons() const {
    std::vector<Geometry> parts;
    for (std::size_t i = 0; i < closed_.size();) {
      const std::size_t outer = i++;
      std::vector<Geometry> holes;
      for (; i < closed_.size() && roles_[i] == RingRole::hole; ++i) {
        if (closed_[i].empty()) continue;
        holes.push_back(ring_of(closed_[i]));
        if (!holes.back()) return own(nullptr);
      }
      if (closed_[outer].empty()) continue;
      Geometry shell = ring_of(closed_[outer]);
      if (!shell) return own(nullptr);
      std::vector<GEOSGeometry*> raw = released(holes);
      parts.push_back(own(GEOSGeom_createPolygon_r(geos_.handle(), shell.release(), raw.data(),
                                                   static_cast<unsigned>(raw.size()))));
      if (!parts.back()) return own(nullptr);
    }
    std::vector<GEOSGeometry*> raw = released(parts);
    return own(GEOSGeom_createCollection_r(geos_.handle(), GEOS_MULTIPOLYGON, raw.data(),
                                           static_cast<unsigned>(raw.size())));
  }

  Geometry made_valid(const Geometry& geometry) const {
    if (!geometry) return own(nullptr);
    GEOSMakeValidParams* parameters = GEOSMakeValidParams_create_r(geos_.handle());
    GEOSMakeValidParams_setMethod_r(geos_.handle(), parameters, GEOS_MAKE_VALID_STRUCTURE);
    GEOSMakeValidParams_setKeepCollapsed_r(geos_.handle(), parameters, 0);
    Geometry result = own(GEOSMakeValidWithParams_r(geos_.handle(), geometry.get(), parameters));
    GEOSMakeValidParams_destroy_r(geos_.handle(), parameters);
    return result;
  }

  void collect(const GEOSGeometry* geometry, std::vector<Ring>& rings) const {
    const int type = GEOSGeomTypeId_r(geos_.handle(), geometry);
    if (type == GEOS_POLYGON) {
      if (GEOSisEmpty_r(geos_.handle(), geometry) == 1) return;
      add_ring(GEOSGetExteriorRing_r(geos_.handle(), geometry), RingRole::outer, rings);
      const int holes = GEOSGetNumInteriorRings_r(geos_.handle(), geometry);
      for (int i = 0; i < holes; ++i) {
        add_ring(GEOSGetInteriorRingN_r(geos_.handle(), geometry, i), RingRole::hole, rings);
      }
    } else if (type == GEOS_MULTIPOLYGON || type == GEOS_GEOMETRYCOLLECTION) {
      const int parts = GEOSGetNumGeometries_r(geos_.handle(), geometry);
      for (int i = 0; i < parts; ++i) {
        collect(GEOSGetGeometryN_r(geos_.handle(), geometry, i), rings);
      }
    }
  }

  void add_ring(const GEOSGeometry* source, RingRole role, std::vector<Ring>& rings) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(geos_.handle(), source);
    unsigned count = 0;
    if (sequence == nullptr || GEOSCoordSeq_getSize_r(geos_.handle(), sequence, &count) != 1)
      return;
    Ring& ring = rings.emplace_back();
    ring.role = role;
    ring.points.resize(count);
    if (count > 0) {
      GEOSCoordSeq_copyToBuffer_r(geos_.handle(), sequence, &ring.points.front().x, 0, 0);
    }
  }

  Geos geos_;
  std::vector<std::vector<Vec2>> closed_;
  std::vector<RingRole> roles_;
};

}  // namespace

Status make_valid(Feature& feature, std::size_t index, std::vector<std::string>& notes) {
  const bool of_polygons = std::ranges::all_of(feature.rings, [](const Ring& ring) {
    return ring.role == RingRole::outer || ring.role == RingRole::hole;
  });
  if (!of_polygons || feature.rings.empty()) return success();
  const Repairer repairer(feature.rings);
  if (repairer.valid()) return success();
  Result<std::vector<Ring>> rings = repairer.repaired();
  if (!rings) {
    notes.push_back(fmt::format("feature {}: {}; its edges are split where they cross", index,
                                rings.error().text));
    return success();
  }
  if (rings->empty()) {
    return Error{ErrorCode::no_area, "nothing is left after the repair: no area is enclosed",
                 in_feature(index)};
  }
  const Counts before = counts_of(feature.rings);
  const Counts after = counts_of(*rings);
  notes.push_back(fmt::format("feature {} was repaired by MakeValid: {} before; {} after", index,
                              described(before), described(after)));
  feature.rings = std::move(*rings);
  return success();
}

}  // namespace medial::io
