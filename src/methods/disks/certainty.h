#pragma once

#include <array>
#include <cmath>

#include "methods/disks/events.h"

namespace medial::disks {

inline double taxicab_norm(Vec2 v) { return std::abs(v.x) + std::abs(v.y); }

/// Whether an event that was found in double is certain (docs/exact.md, How disks decides).
class Certainty {
 public:
  Certainty(const Boundary& boundary, double tolerance, const Span& span, const Disk& from,
            const Event& event);

  /// How far the exact disk of the event may be: infinite where it may not exist.
  double error() const { return error_; }
  bool is_certain() const { return certain_; }
  /// Whether it is so only if what touches one disk within the tolerance is one.
  bool is_tie() const { return tie_; }

  /// Whether the walk certainly ends at the disk of the span's node, with nothing in between.
  static bool ends(const Boundary& boundary, double tolerance, const Span& span, const Disk& disk);
  /// How far the exact disk may be that touches `third` and the joint of two sites, one after the
  /// other: infinite where it may not exist.
  static double error_at_joint(const Boundary& boundary, std::uint32_t before, std::uint32_t after,
                               std::uint32_t third, const Disk& disk);

  /// How far the exact disk that touches three sites, in this order around it, may be: infinite
  /// where it may not exist.
  static double error_of_three(const Boundary& boundary, const std::array<std::uint32_t, 3>& sites,
                               const Disk& disk);

  /// What rounding a centre of the local frame moves it by, at most.
  static constexpr double rounding = 0x1p-51;

 private:
  Certainty(const Boundary& boundary, const Span& span, const Disk& from, const Event& event);

  /// A contact of the event's disk: the unit vector from the foot, and what is left to touch.
  struct Contact {
    Vec2 toward;
    double residual;
    double unsure;  ///< by how much the residual may be off
    double bend;    ///< on an arc, how fast `toward` turns; by 1 / radius round a vertex
    double askew;   ///< by how much `toward` may be off on an arc
  };

  const site::Site& site(std::uint32_t i) const { return boundary_.sites[i]; }
  static Contact contact_of(const site::Site& s, const Disk& disk) {
    if (s.is_arc()) return contact_of_arc(s, disk);
    const Vec2 d = disk.center - s.point;
    const double unsure = rounding * taxicab_norm(d);
    if (!s.is_vertex()) return {s.normal(), cross(s.direction, d) - disk.radius, unsure, 0, 0};
    const double away = norm(d);
    return {(1 / away) * d, away - disk.radius, unsure, 0, 0};
  }
  static Contact contact_of_arc(const site::Site& arc, const Disk& disk);
  Contact contact(std::uint32_t i) const { return contact_of(site(i), to_); }
  /// The line on which the centres lie of all disks that touch the boundary where two sites meet:
  /// the normal of a joint, the bisector of a corner.
  struct Line {
    Vec2 direction;   ///< a unit vector
    double growth;    ///< of the radius along it
    Vec2 to_center;   ///< from where the sites meet
    double residual;  ///< of the disk there
    double unsure;    ///< by how much that may be off, and the place beside the line
  };
  static double error_on(const Line& line, const Contact& third, double radius);
  bool is_near(std::uint32_t i, double slack) const;
  /// Whether the event's disk touches the lines and circles of three sites, and the sites
  /// themselves up to where these end.
  bool touches(std::uint32_t third, double slack) const;
  double error_of_three(std::uint32_t third) const {
    return error_of_three(boundary_, {span_.right, third, span_.left}, to_);
  }
  /// The same where two of the three are edges that meet in a corner, however flat it is.
  double error_at_corner(double tolerance) const;
  /// Whether three contacts leave only rounding open of where their disk is: not where two feet lie
  /// in one place. In an arc's own circle they may be anywhere on it.
  bool has_place(std::uint32_t third) const;
  /// Whether the event's disk, if it is nearly the circle of the arc that it touches, touches all
  /// of that: else it may touch one end of the arc long before the rest.
  bool touches_own_arc(double slack) const;
  /// Whether the disk is no larger than an arc's own circle, but for the tolerance.
  bool fits(std::uint32_t i, double tolerance) const;
  /// Whether the feet move forward, further than the disks may be off.
  bool moves_forward() const;
  /// Whether the node's disk, which touches `third` of the span, is before that of the event,
  /// which touches `fourth`: seen by the four contacts of one disk.
  bool comes_before(std::uint32_t fourth) const;

  const Boundary& boundary_;
  const Span& span_;
  const Disk& from_;
  const Disk& to_;
  const std::uint32_t fourth_;  ///< what the event's disk touches beside the span's two sites
  double error_ = 0;
  bool certain_ = false, tie_ = false;
};

}  // namespace medial::disks
