#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "methods/disks/tie_fit.h"

namespace medial::disks {

/// A node of the axis, with what it touches.
struct TouchingNode {
  const Disk& disk;
  std::span<const Touch> contacts;
};

/// How far two nodes are from each other as their sites have it: in double, or where that leaves it
/// open, in more digits, of nodes that touch three sites.
class NodeDistance {
 public:
  NodeDistance(const ExactSites& exact, const TouchingNode& a, const TouchingNode& b)
      : exact_(exact), a_(a), b_(b) {}

  /// Only edges shorter than this, against the radius, are looked at, and no disk moves further: a
  /// tie's nodes are off by rounding over an angle, and distances are nearly linear so far.
  static constexpr double short_edge = 0x1p-7;
  /// By how much the centres of two nodes may be nearer or further apart than double has them.
  static constexpr double rounding = 0x1p-50;
  /// Whether two nodes are near to each other against both of their disks, give or take `slack`: no
  /// leaf is.
  static bool is_short(const Disk& a, const Disk& b, double slack) {
    const double furthest = short_edge * std::min(a.radius, b.radius) + slack;
    return furthest > 0 && squared_norm(b.center - a.center) < furthest * furthest;
  }

  /// is_short(), exactly.
  bool is_short() const;
  /// Whether the centres are no further apart than `length`, if double is certain.
  std::optional<bool> is_within_in_double(double length, double tolerance) const;
  /// The same as the sites have them.
  bool is_within(double length) const;

 private:
  using ThreeSites = std::optional<std::array<std::uint32_t, 3>>;

  ThreeSites three_of(const TouchingNode& node) const;
  double error_of(const TouchingNode& node) const;
  template <class Real>
  std::optional<exact::DiskBounds<Real>> disk_in(const TouchingNode& node) const;
  template <class Most>
  std::optional<bool> is_within(const Most& most) const;
  template <class Real, class Most>
  std::optional<bool> is_within_in(const Most& most) const;

  const ExactSites& exact_;
  const TouchingNode a_, b_;
};

}  // namespace medial::disks
