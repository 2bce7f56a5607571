#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "medial/axis.h"
#include "methods/disks/exact_sites.h"
#include "site/site.h"

namespace medial::disks {

/// A contact's equation at a disk: moving the centre by d and the radius by e changes
/// distance - radius from `residual` to residual + outward.d - e, exactly for a segment.
template <class Real>
struct ContactOf {
  exact::Vector<Real> toward;  ///< the outward unit normal: from the foot to the centre
  Real residual;
};
/// The contact of a disk with a site's carrier.
ContactOf<double> contact_of(const site::Site& site, const Disk& disk);

template <class Real>
struct DiskOf {
  exact::Vector<Real> center;
  Real radius;
};

/// What a disk has to touch: a site, or one of three points of an arc that it touches all along.
/// There the foot on the arc could be anywhere, and the arc's circle says too little about it.
struct Touch {
  enum class Part : std::uint8_t { site, start, middle, end };
  std::uint32_t site = ~std::uint32_t{0};
  Part part = Part::site;
  auto operator<=>(const Touch&) const = default;  // NOLINT(modernize-use-nullptr)

  /// What is touched: a point where an arc's foot is one of its ends.
  site::Site seen_from(std::span<const site::Site> sites, Vec2 center) const;
};

/// The sites of a boundary, in double and, where the shape is decided with certainty, as they are.
struct TieSites {
  std::span<const site::Site> sites;
  const ExactSites* exact = nullptr;
};

/// The one linear dependency of four contacts: the factors add up to 0, and so do they times the
/// outward normals. No disk has four residuals all below `level` in size, and one has exactly that,
/// with the signs of the factors (de la Vallee-Poussin's theorem).
template <class Real>
struct Dependency {
  std::array<Real, 4> factor{};
  Real level{0};

  explicit Dependency(const std::array<ContactOf<Real>, 4>& contact) {
    const auto way = [&](std::size_t i) { return contact[i].toward - contact[0].toward; };
    factor[1] = cross(way(2), way(3));
    factor[2] = cross(way(3), way(1));
    factor[3] = cross(way(1), way(2));
    factor[0] = -(factor[1] + factor[2] + factor[3]);
    Real size{0};
    for (std::size_t i = 0; i < 4; ++i) {
      size += factor[i] < 0 ? Real(-factor[i]) : factor[i];
      level += factor[i] * contact[i].residual;
    }
    if (size > 0) level /= size;
  }
};

/// Whether one disk touches given contacts within a bound, and which: Stiefel's exchange method
/// for the linear problem, with new equations at every disk. What double leaves open is decided in
/// 256 bits.
class TieFit {
 public:
  TieFit(const TieSites& sites, const Disk& start) : disk(start), sites_(&sites) {}

  Disk disk;
  double worst = 0;  ///< its largest residual

  /// Whether a disk near the one to begin with touches all contacts within `bound`: that one, if it
  /// does.
  bool fits(std::span<const Touch> contacts, double bound);
  /// Moves on to the disk whose largest residual is the least, which does not depend on the order
  /// of the contacts; none of them is an arc.
  void settle(std::span<const Touch> contacts);

 private:
  const TieSites* sites_;
};

}  // namespace medial::disks
