#pragma once

#include <algorithm>
#include <cmath>

#include "site/bisector.h"
#include "site/site.h"

namespace medial::site {

/// The disks that touch a point and a site, by the way around the point from where they pass
/// between the two, counter-clockwise. Inside an arc's circle the centres are an ellipse, whose own
/// parameter F is an angle as well: tan(F / 2) = flatness * tan(direction / 2). On its far half,
/// where the ellipse is flat, directions are the same up to rounding; on its near end parameters
/// are. Elsewhere the two are one.
struct AroundPoint {
  AroundPoint(const Site& site, Vec2 point) : own(site), place(point) {
    if (!site.is_arc()) {
      near = -site.normal();
      return;
    }
    const ArcView view = view_of_arc(site, point);
    near = view.size > 0 ? (-1 / view.size) * view.toward : -site.normal();
    const double share = site.curvature * view.distance;
    if (!(share > 0)) return;
    flatness = std::sqrt(share / (1 + view.size));
    gap = view.distance;
    focus = view.size;
  }

  bool is_ellipse() const { return gap > 0; }
  /// Whether a centre is on the far half of an ellipse.
  bool is_far(Vec2 center) const { return is_ellipse() && !(dot(near, center - place) > 0); }
  double direction(Vec2 center) const {
    return std::atan2(cross(near, center - place), dot(near, center - place));
  }
  double direction_at(double parameter) const {
    const double half = 0.5 * parameter;
    return 2 * std::atan2(std::sin(half), flatness * std::cos(half));
  }
  double parameter_at(double direction) const {
    const double half = 0.5 * direction;
    return 2 * std::atan2(flatness * std::sin(half), std::cos(half));
  }
  /// How far the foot on the arc has turned at a parameter, seen from the arc's centre.
  double foot_at(double parameter) const { return parameter_at(parameter); }
  /// Of a centre. On the far half the way along the ellipse decides, as a node may lie anywhere
  /// across it within the tolerance: that decides the sign only.
  double parameter(Vec2 center) const {
    if (!is_far(center)) return parameter_at(direction(center));
    const double along = dot(near, center - place), across = cross(near, center - place);
    const double below = own.curvature * (0.5 * gap - along);  // against the whole axis
    const double half = std::atan2(std::sqrt(below), std::sqrt(std::max(1 - below, 0.0)));
    return std::copysign(2 * half, across);
  }
  /// How far a centre on the far half lies beside the ellipse; 0 elsewhere.
  double misfit(Vec2 center) const {
    if (!is_far(center)) return 0;
    const double half_width = 0.5 * flatness * (1 + focus) / own.curvature;
    return std::abs(std::abs(cross(near, center - place)) -
                    half_width * std::abs(std::sin(parameter(center))));
  }
  /// By how much the parameter is off of a centre that is off by so much.
  double rounding(Vec2 center, double off) const {
    const double half = 0.5 * direction_at(parameter(center));
    const double s = flatness * std::sin(half), c = std::cos(half);
    return flatness * off / ((s * s + c * c) * distance(center, place));
  }
  /// Of infinite radius where there is none.
  Disk disk_at(double direction) const {
    const double c = std::cos(direction), s = std::sin(direction);
    const Vec2 to = c * near + s * left_of(near);
    const double radius = tangent_radius(place, to, own);
    return {place + radius * to, radius};
  }
  /// The control point of an edge of the ellipse, at most half of it, between two parameters. It
  /// keeps the digits that the pole of its chord loses on the far half, where centre and radius
  /// change alike.
  Control control(double from, double to) const {
    const double cosine = std::cos(0.5 * (to - from));
    const double whole_axis = 1 / (own.curvature * cosine);
    const double drop = whole_axis * std::sin(0.5 * from) * std::sin(0.5 * to);
    const double across = 0.5 * whole_axis * flatness * (1 + focus) * std::sin(0.5 * (from + to));
    return {{place + (0.5 * gap - drop) * near + across * left_of(near), 0.5 * gap + focus * drop},
            std::abs(cosine)};
  }

  const Site& own;
  Vec2 place, near;
  double flatness = 1;
  double gap = 0, focus = 0;  ///< of an ellipse: between point and arc; against the arc's radius
};

}  // namespace medial::site
