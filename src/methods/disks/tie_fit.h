#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "medial/axis.h"
#include "site/site.h"

namespace medial::disks {

/// A contact's equation at a disk: moving the centre by d and the radius by e changes
/// distance - radius from `residual` to residual + outward.d - e, exactly for a segment.
struct ContactEquation {
  Vec2 outward;
  double residual = 0;
};
inline ContactEquation contact_of(const site::Site& site, const Disk& disk) {
  if (site.is_vertex()) {
    const Vec2 to = disk.center - site.point;
    const double distance = norm(to);
    return {(1 / distance) * to, distance - disk.radius};
  }
  return {site::outward(site, disk.center),
          site::carrier_distance(site, disk.center) - disk.radius};
}

/// What a disk has to touch: a site, or one of three points of an arc that it touches all along.
/// There the foot on the arc could be anywhere, and the arc's circle says too little about it.
struct Touch {
  enum class Part : std::uint8_t { site, start, middle, end };
  std::uint32_t site = ~std::uint32_t{0};
  Part part = Part::site;
  auto operator<=>(const Touch&) const = default;  // NOLINT(modernize-use-nullptr)

  /// What is touched: a point where an arc's foot is one of its ends.
  site::Site seen_from(std::span<const site::Site> sites, Vec2 center) const {
    const site::Site& whole = sites[site];
    if (!whole.is_arc()) return whole;
    double s = part == Part::middle ? 0.5 * whole.length : part == Part::end ? whole.length : 0;
    if (part == Part::site) {
      s = site::foot_parameter(whole, center);
      if (s > 0 && s < whole.length) return whole;
    }
    return site::make_vertex(whole.at(s));
  }
};

/// The one linear dependency of four contacts: the factors add up to 0, and so do they times the
/// outward normals. No disk has four residuals all below `level` in size, and one has exactly that,
/// with the signs of the factors (de la Vallee-Poussin's theorem).
struct Dependency {
  std::array<double, 4> factor{};
  double level = 0;

  explicit Dependency(const std::array<ContactEquation, 4>& contact) {
    std::array<Vec2, 4> to;
    for (std::size_t i = 0; i < 4; ++i) to[i] = contact[i].outward - contact[0].outward;
    factor[1] = cross(to[2], to[3]);
    factor[2] = cross(to[3], to[1]);
    factor[3] = cross(to[1], to[2]);
    factor[0] = -(factor[1] + factor[2] + factor[3]);
    double size = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      size += std::abs(factor[i]);
      level += factor[i] * contact[i].residual;
    }
    if (size > 0) level /= size;
  }
};

/// The disk whose largest residual at given contacts is smallest, or good enough: Stiefel's
/// exchange method for the linear problem, with new equations at every disk.
class Fit {
 public:
  Fit(std::span<const site::Site> sites, double bound) : sites_(sites), bound_(bound) {}

  Disk disk;
  double worst = 0;  ///< the largest residual at the last contacts asked for

  /// Begins with three of the contacts, as far apart as they can be found at once.
  void begin(std::span<const Touch> contacts);
  bool has_begun() const { return count_ > 0; }

  /// Whether the disk touches all the contacts, within the bound: their closed sites.
  bool touches(std::initializer_list<std::span<const Touch>> lists);

  /// After touches() was false: takes the contact with the largest residual into account. False
  /// where no disk touches all of those seen so far.
  bool improve();

 private:
  double distance_to(const Touch& i) const;
  Vec2 normal(const Touch& i) const {
    return site::outward(i.seen_from(sites_, disk.center), disk.center);
  }
  ContactEquation contact(const Touch& i) const {
    return contact_of(i.seen_from(sites_, disk.center), disk);
  }
  std::array<ContactEquation, 4> contacts(const std::array<Touch, 4>& reference) const;

  /// The best disk for five contacts is the one for those four of them that ask for the largest
  /// residual.
  void exchange();

  /// Moves to where three residuals have the given values.
  bool move(const std::array<ContactEquation, 3>& contact, const std::array<double, 3>& goal);

  std::span<const site::Site> sites_;
  double bound_;
  std::array<Touch, 4> reference_{};
  std::size_t count_ = 0;  ///< of the reference
  Touch furthest_;
};

}  // namespace medial::disks
