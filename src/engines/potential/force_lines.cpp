#include "engines/potential/force_lines.h"

#include <algorithm>
#include <cmath>

namespace medial::potential {
namespace {

/// The unit direction of the valley at a place near its floor: the eigenvector of the derivatives'
/// larger eigenvalue, after what is but growth along the force. The other one, across the valley,
/// is negative.
Vec2 valley_direction(const Force& force, double order) {
  // The Hessian of V^(-1/n), nearly a distance, is that of the potential and this.
  const double growth = (order + 1) / force.potential(order);
  const Vec2 f = force.force;
  const double half = 0.5 * (force.xx - force.yy + growth * (f.x * f.x - f.y * f.y));
  const double angle = 0.5 * std::atan2(force.xy + growth * f.x * f.y, half);
  return {std::cos(angle), std::sin(angle)};
}

Vec2 blend(Vec2 direction, Vec2 force) {
  const Vec2 sum = direction + unit(force);
  return norm(sum) > 0.2 ? unit(sum) : unit(force);
}

}  // namespace

bool contains(const Box& box, Vec2 p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
}

Vec2 unit(Vec2 v) {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : Vec2{};
}

bool ForceLines::advance(Vec2 p, Vec2 direction, double step, Vec2& q, Force& force,
                         double& radius) {
  constexpr double sine_enough = 0.01;
  const Vec2 aside = left_of(direction);
  double t = 0;
  for (int i = 0; i < 7; ++i) {
    q = p + step * direction + t * aside;
    force = force_at(q, radius);
    if (!(radius > 0)) return false;
    const Vec2 moved = q - p;
    const double size = norm(force.force) * norm(moved);
    if (!(size > 0) || (options_.through_flats && lost(force))) return true;
    const double g = cross(moved, force.force);
    if (std::abs(g) <= sine_enough * size) return true;
    const double slope = cross(aside, force.force) + cross(moved, force.derivative(aside)) / radius;
    if (!(slope < 0)) {
      // Lines part here, so an explicit step is a stable one.
      const Vec2 halfway = p + 0.5 * step * direction;
      const Vec2 way = unit(force_at(halfway, radius).force);
      if (!(radius > 0) || dot(way, direction) < 0.5) return false;
      q = p + step * way;
      force = force_at(q, radius);
      return radius > 0;
    }
    t -= g / slope;
    if (!(std::abs(t) <= 0.6 * step)) return false;
  }
  return false;
}

std::optional<ValleyPoint> ForceLines::critical_point(Vec2 p, bool minimum) {
  for (int i = 0; i < 60; ++i) {
    double radius = 0;
    const Force force = force_at(p, radius);
    if (!(radius > 0)) return std::nullopt;
    const double determinant = force.determinant();
    Vec2 move;
    if (minimum ? determinant > 0 : determinant < 0) {
      move = {-radius * (force.yy * force.force.x - force.xy * force.force.y) / determinant,
              -radius * (force.xx * force.force.y - force.xy * force.force.x) / determinant};
    } else if (minimum) {
      move = 0.3 * radius * unit(force.force);
    } else {
      return std::nullopt;
    }
    const double size = norm(move);
    const double longest = 0.4 * reach(radius);
    if (size > longest) move = (longest / size) * move;
    // Back and forth: a valley floor too flat for the arithmetic.
    if (i > 30) move = 0.5 * move;
    if (size <= 1e-8 * radius || (i == 59 && size <= 0.01 * radius)) {
      if (minimum ? determinant > 0 : determinant < 0)
        return ValleyPoint{p, radius, valley_direction(force, options_.order),
                           minimum ? ValleyPoint::Kind::minimum : ValleyPoint::Kind::saddle};
      return std::nullopt;
    }
    p = p + move;
    if (!minimum && i > 40) return std::nullopt;
  }
  return std::nullopt;
}

Trail ForceLines::follow(Vec2 p, Vec2 direction, double share, Start start) {
  Trail trail;
  double radius = 0;
  Force force = force_at(p, radius);
  double scale = 0.8;
  constexpr double least_scale = 0.8 / 64;
  constexpr int most_steps = 10000;
  const int most_stalls = options_.through_flats ? 3 : 40;
  int stalls = 0;
  bool settled = false;  // since the last good step
  std::uint32_t flat_since = no_point;
  bool climbing = start == Start::either;
  for (int count = 0; count < most_steps && !exhausted(); ++count) {
    if (options_.within && !contains(*options_.within, p) && count > 0) return trail;
    const Vec2 before = direction;
    if (scale < 0.15 && !settled && settle(p, radius, force, direction)) {
      // Steps of this size would zigzag across the valley.
      settled = true;
      if ((climbing || (options_.through_flats && lost(force))) && dot(direction, before) < 0)
        direction = -direction;
      trail.points.push_back({p, radius, direction, ValleyPoint::Kind::valley});
      scale = 0.4;
      continue;
    }
    const double step = scale * reach(radius);
    Vec2 q;
    Force next;
    double next_radius = 0;
    bool good = advance(p, direction, step, q, next, next_radius);
    if (!good && scale > least_scale) {
      scale = std::max(scale / 2, least_scale);
      if (!climbing && !(options_.through_flats && lost(force)) &&
          (count > 0 || norm(force.force) > 1e-9))
        direction = blend(direction, force.force);
      continue;
    }
    if (!good && climbing) return trail;
    if (!good) {
      q = p + step * unit(force.force);
      next = force_at(q, next_radius);
      if (!(next_radius > 0)) return trail;
    }
    const Vec2 moved = unit(q - p);
    const double turn = dot(moved, direction);
    if (turn < 0.8 && scale > 0.1) {
      scale /= 2;
      continue;
    }
    // Where the force along a valley is lost, the line goes on as it went.
    const bool flat = options_.through_flats && lost(next);
    if (climbing && !flat && dot(next.force, moved) > 0) {
      climbing = false;
      if (!trail.points.empty()) trail.points.back().kind = ValleyPoint::Kind::saddle;
    }
    // A floor without slope between rising ones stands for a minimum.
    if (flat_since != no_point && !flat && dot(next.force, moved) < 0 && share > 0) {
      trail.end = graph_.minimum_at({p, radius, direction, ValleyPoint::Kind::minimum});
      return trail;
    }
    // Up to the border: no saddle is ahead. Necks wider than this are passed.
    constexpr double narrowest = 1e-4;
    if (climbing && radius < narrowest * options_.step) return trail;
    if (dot(next.force, moved) < 0 && !flat && !climbing) {
      // The force has turned: a minimum or a saddle lies near, or the step was too long.
      if (next.determinant() > 0 || force.determinant() > 0) {
        const auto minimum = critical_point(next.determinant() > 0 ? q : p, true);
        if (minimum && distance(minimum->place, p) <= 2 * reach(radius)) {
          trail.end = graph_.minimum_at(*minimum);
          return trail;
        }
      }
      if (scale > 0.2) {
        scale /= 2;
        continue;
      }
      const auto saddle = critical_point(p, false);
      if (saddle && distance(saddle->place, p) <= 2 * reach(radius) && stalls < most_stalls) {
        // The line all but meets it: on, to the side that the line is on.
        ++stalls;
        trail.weakest = 0;
        trail.place = saddle->place;
        direction = dot(force.force, saddle->tangent) < 0 ? -saddle->tangent : saddle->tangent;
        trail.points.push_back(
            {saddle->place, saddle->radius, direction, ValleyPoint::Kind::valley});
        p = saddle->place + 0.25 * reach(saddle->radius) * direction;
        force = force_at(p, radius);
        trail.points.push_back({p, radius, direction, ValleyPoint::Kind::valley});
        continue;
      }
      if (scale > least_scale) {
        scale /= 2;
        continue;
      }
      if (++stalls > most_stalls) break;
      q = p + step * unit(force.force);
      next = force_at(q, next_radius);
      if (!(next_radius > 0)) return trail;
    }
    if (scale >= 0.15) settled = false;
    const Vec2 p_moved = q - p;
    p = q;
    radius = next_radius;
    force = next;
    direction = unit(p_moved);
    // Other valleys may begin where a floor without slope does: a corridor's end.
    const bool level = flat != (flat_since != no_point);
    if (level && !trail.points.empty() && trail.points.back().kind == ValleyPoint::Kind::valley)
      trail.points.back().kind = ValleyPoint::Kind::level;
    trail.points.push_back(
        {p, radius, direction, level ? ValleyPoint::Kind::level : ValleyPoint::Kind::valley});
    if (force.determinant() < 0 && norm(force.force) < trail.weakest) {
      trail.weakest = norm(force.force);
      trail.place = p;
    }
    if (share > 0) {
      trail.end = graph_.joined(p, radius, direction, share, flat || climbing);
      if (trail.end == no_point && (flat || climbing))
        trail.end = graph_.crossed(p - p_moved, p, radius);
      if (trail.end != no_point) return trail;
    }
    if (!flat) {
      flat_since = no_point;
    } else if (flat_since == no_point) {
      flat_since = static_cast<std::uint32_t>(trail.points.size() - 1);
    } else if (trail.points.size() > flat_since + 8 &&
               distance(trail.points[flat_since].place, p) < 0.8 * reach(radius)) {
      trail.closes = flat_since;
      return trail;
    }
    if (turn > 0.98) scale = std::min(0.8, scale * 1.6);
  }
  if (!exhausted())
    trail.end = graph_.minimum_at({p, radius, direction, ValleyPoint::Kind::minimum});
  return trail;
}

bool ForceLines::settle(Vec2& p, double& radius, Force& force, Vec2& direction) {
  for (int i = 0; i < 8; ++i) {
    const Vec2 along = valley_direction(force, options_.order), across = left_of(along);
    const double gentle = dot(along, force.derivative(along));
    const double steep = dot(across, force.derivative(across));
    if (!(steep < 0 && std::abs(gentle) < 0.4 * -steep)) return false;
    const double move = radius * dot(force.force, across) / -steep;
    if (!(std::abs(move) <= 0.5 * radius)) return false;
    p = p + move * across;
    force = force_at(p, radius);
    if (std::abs(move) > 0.01 * reach(radius)) continue;
    const Vec2 floor = valley_direction(force, options_.order);
    direction = dot(floor, force.force) < 0 ? -floor : floor;
    return true;
  }
  return false;
}

Label ForceLines::label_of(const Trail& trail) const {
  if (trail.end == no_point) return {};
  if (graph_.labels[trail.end].minimum != trail.end) return graph_.labels[trail.end];
  const Vec2 valley = graph_.skeleton.points[trail.end].tangent;
  const Vec2 last = trail.points.empty() ? Vec2{} : trail.points.back().tangent;
  return {trail.end, dot(valley, last) > 0};
}

Label ForceLines::keep(std::uint32_t from, const Trail& trail) {
  const Label label = label_of(trail);
  const auto first = static_cast<std::uint32_t>(graph_.skeleton.points.size());
  std::uint32_t last = from;
  for (const ValleyPoint& point : trail.points) {
    // A minimum may be made of the last point.
    if (trail.end != no_point && point.place == graph_.skeleton.points[trail.end].place) break;
    const std::uint32_t index = graph_.add_point(point, label);
    graph_.add_link(last, index);
    last = index;
  }
  if (trail.end != no_point) graph_.add_link(last, trail.end);
  if (trail.closes != no_point) graph_.add_link(last, first + trail.closes);
  return label;
}

}  // namespace medial::potential
