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

/// How often closed rings wind around points. Takes O(n / points_per_block + crossed blocks) for
/// each point.
class Winding {
 public:
  explicit Winding(const std::vector<std::vector<Vec2>>& rings) {
    for (const std::vector<Vec2>& ring : rings) {
      for (std::size_t begin = 0; begin + 1 < ring.size(); begin += points_per_block) {
        Block block{
            std::span(ring).subspan(begin, std::min(points_per_block + 1, ring.size() - begin)), 0,
            0, 0};
        const auto [low, high] =
            std::ranges::minmax_element(block.points, {}, [](Vec2 p) { return p.y; });
        block.low = low->y;
        block.high = high->y;
        block.right = std::ranges::max_element(block.points, {}, [](Vec2 p) { return p.x; })->x;
        blocks_.push_back(block);
      }
    }
  }

  /// The winding number, and how many edges a ray to the right crosses (odd or even).
  struct Number {
    long winding = 0;
    long crossings = 0;
  };
  Number around(Vec2 p) const {
    Number number;
    for (const Block& block : blocks_) {
      if (block.high < p.y || block.low > p.y || block.right < p.x) continue;
      for (std::size_t i = 0; i + 1 < block.points.size(); ++i) {
        const Vec2 a = block.points[i];
        const Vec2 b = block.points[i + 1];
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        const bool upwards = a.y <= p.y;
        if ((cross(b - a, p - a) > 0) != upwards) continue;
        number.winding += upwards ? 1 : -1;
        ++number.crossings;
      }
    }
    return number;
  }

 private:
  static constexpr std::size_t points_per_block = 64;
  struct Block {
    std::span<const Vec2> points;
    double low, high, right;
  };
  std::vector<Block> blocks_;
};

class Repairer {
 public:
  Repairer(const std::vector<Ring>& rings, RepairRule rule) : rule_(rule) {
    for (const Ring& ring : rings) {
      closed_.push_back(closed_ring(ring));
      roles_.push_back(ring.role);
    }
    const bool loose = std::ranges::find(roles_, RingRole::any) != roles_.end();
    if (rule_ == RepairRule::make_valid && loose) rule_ = RepairRule::even_odd;
  }

  RepairRule rule() const { return rule_; }

  /// Whether the rings are the valid boundary of what the rule asks for.
  bool valid() {
    if (std::ranges::any_of(closed_, [](const auto& ring) { return ring.empty(); })) return false;
    const bool loose = std::ranges::find(roles_, RingRole::any) != roles_.end();
    if (loose && roles_.size() > 1) return false;  // how loose rings nest depends on the rule
    if (rule_ == RepairRule::non_zero) {
      // Outer rings must run one way and holes the other: then the winding number is 0 or not as
      // the roles say.
      const bool positive = signed_area(closed_.front()) > 0;
      for (std::size_t i = 0; i < closed_.size(); ++i) {
        const bool left = (signed_area(closed_[i]) > 0) == positive;
        if (left == (roles_[i] == RingRole::hole)) return false;
      }
    }
    const Geometry whole = polygons();
    return whole && GEOSisValid_r(geos_.handle(), whole.get()) == 1;
  }

  Result<std::vector<Ring>> repaired() {
    Geometry result = rule_ == RepairRule::make_valid ? made_valid(polygons()) : by_faces();
    if (result && GEOSisValid_r(geos_.handle(), result.get()) != 1) {
      result = made_valid(result);
    }
    if (!result) {
      return Error{
          ErrorCode::internal, fmt::format("GEOS cannot repair this: {}", geos_.message()), {}};
    }
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

  Geometry collection(int type, std::vector<Geometry> parts) const {
    std::vector<GEOSGeometry*> raw = released(parts);
    return own(GEOSGeom_createCollection_r(geos_.handle(), type, raw.data(),
                                           static_cast<unsigned>(raw.size())));
  }

  Geometry line(std::span<const Vec2> points, bool ring) const {
    static_assert(sizeof(Vec2) == 2 * sizeof(double));
    GEOSCoordSequence* sequence = GEOSCoordSeq_copyFromBuffer_r(
        geos_.handle(), &points.front().x, static_cast<unsigned>(points.size()), 0, 0);
    if (sequence == nullptr) return own(nullptr);
    return own(ring ? GEOSGeom_createLinearRing_r(geos_.handle(), sequence)
                    : GEOSGeom_createLineString_r(geos_.handle(), sequence));
  }

  /// All rings as one multipolygon by their roles; null if GEOS does not take them.
  Geometry polygons() const {
    std::vector<Geometry> parts;
    for (std::size_t i = 0; i < closed_.size();) {
      const std::size_t outer = i++;
      std::vector<Geometry> holes;
      for (; i < closed_.size() && roles_[i] == RingRole::hole; ++i) {
        if (closed_[i].empty()) continue;
        holes.push_back(line(closed_[i], true));
        if (!holes.back()) return own(nullptr);
      }
      if (closed_[outer].empty()) continue;
      Geometry shell = line(closed_[outer], true);
      if (!shell) return own(nullptr);
      std::vector<GEOSGeometry*> raw = released(holes);
      parts.push_back(own(GEOSGeom_createPolygon_r(geos_.handle(), shell.release(), raw.data(),
                                                   static_cast<unsigned>(raw.size()))));
      if (!parts.back()) return own(nullptr);
    }
    return collection(GEOS_MULTIPOLYGON, std::move(parts));
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

  /// Cuts the plane along all rings and keeps the faces that are inside by the rule.
  Geometry by_faces() const {
    std::vector<Geometry> lines;
    for (const std::vector<Vec2>& ring : closed_) {
      if (!ring.empty()) lines.push_back(line(ring, false));
    }
    const Geometry all = collection(GEOS_MULTILINESTRING, std::move(lines));
    if (!all) return own(nullptr);
    const Geometry noded = own(GEOSUnaryUnion_r(geos_.handle(), all.get()));
    if (!noded) return own(nullptr);
    const GEOSGeometry* input = noded.get();
    const Geometry faces = own(GEOSPolygonize_r(geos_.handle(), &input, 1));
    if (!faces) return own(nullptr);

    const Winding winding(closed_);
    std::vector<Geometry> kept;
    const int count = GEOSGetNumGeometries_r(geos_.handle(), faces.get());
    for (int i = 0; i < count; ++i) {
      const GEOSGeometry* face = GEOSGetGeometryN_r(geos_.handle(), faces.get(), i);
      const Geometry inside = own(GEOSPointOnSurface_r(geos_.handle(), face));
      Vec2 p;
      if (!inside || GEOSGeomGetX_r(geos_.handle(), inside.get(), &p.x) != 1 ||
          GEOSGeomGetY_r(geos_.handle(), inside.get(), &p.y) != 1) {
        return own(nullptr);
      }
      const Winding::Number number = winding.around(p);
      const bool keep =
          rule_ == RepairRule::non_zero ? number.winding != 0 : number.crossings % 2 != 0;
      if (keep) kept.push_back(own(GEOSGeom_clone_r(geos_.handle(), face)));
    }
    // Faces side by side are no valid multipolygon until they are united.
    const Geometry mosaic = collection(GEOS_GEOMETRYCOLLECTION, std::move(kept));
    return mosaic ? own(GEOSUnaryUnion_r(geos_.handle(), mosaic.get())) : own(nullptr);
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
  RepairRule rule_;
  std::vector<std::vector<Vec2>> closed_;
  std::vector<RingRole> roles_;
};

const char* rule_text(RepairRule rule) {
  switch (rule) {
    case RepairRule::even_odd:
      return "by the even-odd rule";
    case RepairRule::non_zero:
      return "by the non-zero rule";
    default:
      return "by MakeValid";
  }
}

}  // namespace

Status repair(Feature& feature, std::size_t index, RepairRule rule,
              std::vector<std::string>& notes) {
  const Place place = in_feature(index);
  for (const Ring& ring : feature.rings) {
    for (const Vec2 point : ring.points) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
        return Error{ErrorCode::not_finite, "a coordinate is not a finite number", place};
      }
    }
  }
  if (rule == RepairRule::none || feature.rings.empty()) return success();
  Repairer repairer(feature.rings, rule);
  if (repairer.valid()) return success();
  const Result<std::vector<Ring>> rings = repairer.repaired();
  if (!rings) {
    notes.push_back(fmt::format("feature {}: {}; its edges are split where they cross", index,
                                rings.error().text));
    return success();
  }
  if (rings->empty()) {
    return Error{ErrorCode::no_area, "nothing is left after the repair: no area is enclosed",
                 place};
  }
  const Counts before = counts_of(feature.rings);
  const Counts after = counts_of(*rings);
  notes.push_back(fmt::format("feature {} was repaired {}: {} before; {} after", index,
                              rule_text(repairer.rule()), described(before), described(after)));
  feature.rings = std::move(*rings);
  return success();
}

}  // namespace medial::io
