#pragma once

#include <algorithm>
#include <cmath>

#include "site/bisector.h"
#include "site/site.h"

namespace medial::site {

/// The disks that touch a point and a site, parametrised by the direction of the centre from the
/// point: counter-clockwise, from the direction in which the disk lies between the two. Inside an
/// arc's circle, the centres form an ellipse, whose parameter F is an angle, too: tan(F / 2) =
/// flatness * tan(direction / 2). If the ellipse is flat, directions are equal up to rounding on
/// its far half, and parameters at its near end. On other curves, parameter and direction are
/// equal.
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
  /// The angle by which the foot on the arc has turned about the arc's centre at a parameter.
  double foot_at(double parameter) const { return parameter_at(parameter); }
  /// The parameter of a centre. On the far half, it follows from the coordinate along the long
  /// axis; the coordinate across it, in which a node may be off by the tolerance, decides only the
  /// sign.
  double parameter(Vec2 center) const {
    if (!is_far(center)) return parameter_at(direction(center));
    const double along = dot(near, center - place), across = cross(near, center - place);
    const double below = own.curvature * (0.5 * gap - along);  // relative to the long axis
    const double half = std::atan2(std::sqrt(below), std::sqrt(std::max(1 - below, 0.0)));
    return std::copysign(2 * half, across);
  }
  /// The distance of a centre on the far half from the ellipse, across its long axis; otherwise 0.
  double misfit(Vec2 center) const {
    if (!is_far(center)) return 0;
    const double half_width = 0.5 * flatness * (1 + focus) / own.curvature;
    return std::abs(std::abs(cross(near, center - place)) -
                    half_width * std::abs(std::sin(parameter(center))));
  }
  /// The error of the parameter if the centre is off by `off`.
  double rounding(Vec2 center, double off) const {
    const double half = 0.5 * direction_at(parameter(center));
    const double s = flatness * std::sin(half), c = std::cos(half);
    return flatness * off / ((s * s + c * c) * distance(center, place));
  }
  /// The disk in a direction; its radius is infinite if there is none.
  Disk disk_at(double direction) const {
    const double c = std::cos(direction), s = std::sin(direction);
    const Vec2 to = c * near + s * left_of(near);
    const double radius = tangent_radius(place, to, own);
    return {place + radius * to, radius};
  }
  /// The control point of an edge between two parameters, at most half of the ellipse. More
  /// accurate than the pole of its chord on the far half, where centre and radius change at the
  /// same rate.
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
  /// Of an ellipse: the distance from the point to the arc; the distance between its foci, relative
  /// to the arc's radius.
  double gap = 0, focus = 0;
};

}  // namespace medial::site
