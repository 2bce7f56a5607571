#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "methods/exact/numbers.h"
#include "methods/lee/elements.h"
#include "site/apollonius.h"
#include "site/bisector.h"
#include "site/tangent_disk.h"

// The numbers in which diagrams are merged: double, and where its rounding breaks a diagram, 256
// bits. Of each: its disks and sites, and the same questions about them.
namespace medial::lee {

struct InDouble {
  using Real = double;
  using Disk = medial::Disk;
  using Site = site::Site;
  /// In radii, how far Voronoi points of three elements that hardly determine one may be off: a
  /// rounding divided by the square of the angle between their feet, for up to 1e6 of them around a
  /// disk.
  static constexpr double vagueness = 1e-5;
};

/// How far the foot on a site moves forward from one disk to another: seen from the centres, along
/// the site's normals, and of an arc from the centre nearer to its own, in which there is no foot.
inline double advance(const site::Site& site, Vec2 from, Vec2 to) {
  if (!site.is_arc()) return dot(site.direction, to - from);
  const Vec2 d = from - site.point, e = to - site.point, normal = site.normal();
  const double way = dot(site.direction, e - d) + site.curvature * cross(d, e);
  const double larger = std::max(squared_norm(normal - site.curvature * d),
                                 squared_norm(normal - site.curvature * e));
  const double most = distance(from, to);
  return larger > 0 ? std::clamp(way / std::sqrt(larger), -most, most) : 0;
}

struct PreciseSite {
  using Vector = site::apollonius::Vector<exact::Precise>;
  Vector point, direction;
  exact::Precise length{0};
  bool vertex = false;

  bool is_vertex() const { return vertex; }
  Vector normal() const { return {-direction.y, direction.x}; }
  Vector end() const { return point + length * direction; }
};

struct InPrecise {
  using Real = exact::Precise;
  using Disk = site::apollonius::Solution<Real>;
  using Site = PreciseSite;
  static constexpr double tolerance = 0x1p-120, vagueness = 0x1p-100;
};

/// The elements as the shape has them, from the ends of its edges on.
struct PreciseSites {
  std::vector<PreciseSite> elements;
  std::vector<InPrecise::Disk> passages;
};
PreciseSites precise_sites(const Problem& problem, const Elements& elements);

using PreciseDisks = site::apollonius::Solutions<exact::Precise>;

PreciseSite::Vector direction_along(const PreciseSite& right, const PreciseSite& left);
exact::Precise squared_distance(const PreciseSite& site, const PreciseSite::Vector& c);
exact::Precise carrier_distance(const PreciseSite& site, const PreciseSite::Vector& c);
/// Larger than any double where there is none.
exact::Precise tangent_radius(const PreciseSite::Vector& foot, const PreciseSite::Vector& normal,
                              const PreciseSite& site);
PreciseDisks tangent_disks(const PreciseSite& a, const PreciseSite& b, const PreciseSite& c);
inline exact::Precise distance(const PreciseSite::Vector& a, const PreciseSite::Vector& b) {
  return sqrt(dot(a - b, a - b));
}
inline void polish(InPrecise::Disk&, const PreciseSite&, const PreciseSite&, const PreciseSite&,
                   double, double, std::uint64_t&) {}

inline Disk rounded(const InPrecise::Disk& disk) {
  return {{static_cast<double>(disk.center.x), static_cast<double>(disk.center.y)},
          static_cast<double>(disk.radius)};
}

}  // namespace medial::lee
