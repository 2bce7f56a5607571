#include "methods/potential/force_lines.h"

#include <algorithm>
#include <cmath>

namespace medial::potential {
namespace {

/// The step of Newton's method to a point without force, in units of the distance to the boundary.
Vec2 newton(const Force& force) {
  const Vec2 f = force.force;
  return (-1 / force.determinant()) *
         Vec2{force.yy * f.x - force.xy * f.y, force.xx * f.y - force.xy * f.x};
}

/// The same, but downhill where the potential is concave: straight to the floor of a valley, and
/// along it. In at least one of two directions, the force falls as fast.
Vec2 downhill(const Force& force) {
  const double angle = 0.5 * std::atan2(2 * force.xy, force.xx - force.yy);
  const Vec2 along{std::cos(angle), std::sin(angle)}, across = left_of(along);
  const auto step = [&](Vec2 way) {
    const double slope = std::abs(dot(way, force.derivative(way)));
    return slope > 0 ? (dot(force.force, way) / slope) * way : Vec2{};
  };
  return step(along) + step(across);
}

Vec2 blend(Vec2 direction, Vec2 force) {
  const Vec2 sum = direction + unit(force);
  return norm(sum) > 0.2 ? unit(sum) : unit(force);
}

}  // namespace

Vec2 valley_direction(const Force& force, double order) {
  // The Hessian of V^(-1/n), which is nearly a distance, is that of the potential plus this.
  const double growth = (order + 1) / force.potential(order);
  const Vec2 f = force.force;
  const double half = 0.5 * (force.xx - force.yy + growth * (f.x * f.x - f.y * f.y));
  const double angle = 0.5 * std::atan2(force.xy + growth * f.x * f.y, half);
  return {std::cos(angle), std::sin(angle)};
}

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
    if (!(size > 0)) return true;
    const double g = cross(moved, force.force);
    if (std::abs(g) <= sine_enough * size) return true;
    const double slope = cross(aside, force.force) + cross(moved, force.derivative(aside)) / radius;
    if (!(slope < 0)) {
      // Lines diverge here, so an explicit step is stable.
      const Vec2 halfway = p + 0.5 * step * direction;
      const Vec2 way = unit(force_at(halfway, radius).force);
      if (!(radius > 0) || dot(way, direction) < 0.5) return false;
      q = p + step * way;
      force = force_at(q, radius);
      return radius > 0;
    }
    const double change = -g / slope;
    t += change;
    if (!(std::abs(t) <= 0.6 * step)) return false;
    // The force nearby follows from its derivatives if the remainder of Taylor's series is less
    // than half of the relevant sine. The force r^-(n + 1) of a charge has second derivatives of up
    // to (n + 1) (n + 2) r^-(n + 3), in units of the distance; together they are at most the
    // potential times these, up to a quarter for r that falls by less than 0.2 / (n + 3).
    const double near = std::abs(change) / radius, n = options_.order;
    const double rest = 0.5 * 1.25 * (n + 1) * (n + 2) * near * near * force.potential(n);
    const Vec2 there = force.force + force.derivative((change / radius) * aside);
    if (near <= 0.2 / (n + 3) && rest <= 0.5 * sine_enough * norm(there)) {
      q = q + change * aside;
      const double before = radius;
      radius = distance_at(q);
      force = force.moved((change / before) * aside, radius / before, n);
      return radius > 0;
    }
  }
  return false;
}

std::optional<ValleyPoint> ForceLines::critical_point(Vec2 p, bool minimum, double furthest) {
  const Vec2 start = p;
  for (int i = 0; i < 60; ++i) {
    double radius = 0;
    const Force force = force_at(p, radius);
    if (!(radius > 0)) return std::nullopt;
    const double determinant = force.determinant();
    if (!minimum && !(determinant < 0)) return std::nullopt;
    const Vec2 move = minimum ? radius * downhill(force) : radius * newton(force);
    const double size = norm(move);
    const double longest = 0.4 * reach(radius);
    // Oscillates: the floor of the valley is too flat for the arithmetic.
    const double share = (i > 30 ? 0.5 : 1) * std::min(1.0, longest / size);
    if (size <= 1e-8 * radius || (i == 59 && size <= 0.01 * radius)) {
      if (minimum ? determinant > 0 : determinant < 0)
        return ValleyPoint{p, radius, valley_direction(force, options_.order),
                           minimum ? ValleyPoint::Kind::minimum : ValleyPoint::Kind::saddle};
      return std::nullopt;
    }
    p = p + share * move;
    if (!minimum && i > 40) return std::nullopt;
    // On the level floor of a valley, there may be no minimum for a long way.
    if (distance(p, start) > furthest) return std::nullopt;
  }
  return std::nullopt;
}

/// The state of a line while it is followed.
class ForceLines::Walk {
 public:
  Walk(ForceLines& lines, Vec2 p, Vec2 direction, double share, Start start)
      : lines_(lines), share_(share), direction_(direction), climbing_(start == Start::either) {
    here_.p = p;
    here_.force = lines_.force_at(p, here_.radius);
  }

  Trail run() {
    Next next = Next::on;
    for (int count = 0; count < most_steps && !lines_.exhausted() && next != Next::stuck; ++count) {
      begins_ = count == 0;
      if (settles()) continue;
      next = propose();
      if (next == Next::on) next = judge();
      if (next == Next::on) next = go();
      if (next == Next::ended) return std::move(trail_);
    }
    if (!lines_.exhausted()) trail_.end = minimum_here();
    return std::move(trail_);
  }

 private:
  enum class Next : std::uint8_t {
    on,     ///< accept the step
    again,  ///< try another step
    ended,  ///< the trail is complete
    stuck,  ///< no step continues the line
  };
  struct Spot {
    Vec2 p;
    double radius = 0;
    Force force;
  };
  static constexpr int most_steps = 10000;
  static constexpr double longest = 0.8, least = longest / 64;

  double step() const { return scale_ * lines_.reach(here_.radius); }
  std::uint32_t minimum_here() {
    return lines_.graph_.minimum_at(
        {here_.p, here_.radius, direction_, ValleyPoint::Kind::minimum});
  }
  void record(ValleyPoint::Kind kind) {
    trail_.points.push_back({here_.p, here_.radius, direction_, kind});
  }

  /// Moves to the floor if steps would be so short that they zigzag across the valley.
  bool settles() {
    const Vec2 before = direction_;
    if (!(scale_ < 0.15 && !settled_ &&
          lines_.settle(here_.p, here_.radius, here_.force, direction_)))
      return false;
    settled_ = true;
    before_ = {};
    if (climbing_ && dot(direction_, before) < 0) direction_ = -direction_;
    record(ValleyPoint::Kind::valley);
    scale_ = 0.4;
    return true;
  }

  /// Proposes a step along the force, or a shorter one; finally an explicit one.
  Next propose() {
    const auto [from, direction, length] = ahead();
    const bool good =
        lines_.advance(from, direction, length, there_.p, there_.force, there_.radius);
    if (!good && scale_ > least) {
      scale_ = std::max(scale_ / 2, least);
      if (!climbing_ && (!begins_ || norm(here_.force.force) > 1e-9))
        direction_ = blend(direction_, here_.force.force);
      return Next::again;
    }
    if (!good && (climbing_ || !step_explicitly())) return Next::ended;
    moved_ = unit(there_.p - here_.p);
    turn_ = dot(moved_, direction_);
    if (turn_ < 0.8 && scale_ > 0.1) {
      scale_ /= 2;
      return Next::again;
    }
    return Next::on;
  }

  /// The start of an implicit step, its direction and its length.
  struct Ahead {
    Vec2 from, direction;
    double length;
  };
  /// Extrapolates from the last two places if the force turns little between them: BDF2, the
  /// formula of second order that also stays in narrow valleys. If the force keeps turning at the
  /// same rate, the first place that is tried is the step's end.
  Ahead ahead() const {
    constexpr double straight = 0.98;    // the cosine of the sharpest turn
    constexpr double largest_ratio = 2;  // of steps: stable below 1 + sqrt(2)
    const Vec2 now = heading(here_), before = heading(before_), last = here_.p - before_.p;
    const bool is_even = step() <= largest_ratio * norm(last);
    if (!is_even || dot(now, direction_) < straight || dot(now, before) < straight)
      return {here_.p, direction_, step()};
    const double ratio = step() / norm(last), share = 1 / (1 + 2 * ratio);
    const Vec2 next = unit(now + ratio * cross(before, now) * left_of(now));
    return {here_.p + ratio * ratio * share * last, next, (1 + ratio) * share * step()};
  }
  /// The direction of the force, or its opposite while the line climbs.
  Vec2 heading(const Spot& spot) const { return (climbing_ ? -1 : 1) * unit(spot.force.force); }

  /// Returns false at the boundary.
  bool step_explicitly() {
    there_.p = here_.p + step() * unit(here_.force.force);
    there_.force = lines_.force_at(there_.p, there_.radius);
    return there_.radius > 0;
  }

  /// Evaluates the force at the end of the step: a saddle that was climbed to, a minimum, or an
  /// end.
  Next judge() {
    if (climbing_ && dot(there_.force.force, moved_) > 0) {
      climbing_ = false;
      if (!trail_.points.empty()) trail_.points.back().kind = ValleyPoint::Kind::saddle;
    }
    const bool turned = dot(there_.force.force, moved_) < 0;
    // Reached the boundary: there is no saddle ahead. Wider necks are passed.
    constexpr double narrowest = 1e-4;
    if (climbing_ && here_.radius < narrowest * lines_.options_.step) return Next::ended;
    return turned && !climbing_ ? meet_turned_force() : Next::on;
  }

  /// Handles a force that has turned: a minimum or a saddle is near, or the step was too long.
  Next meet_turned_force() {
    if (there_.force.determinant() > 0 || here_.force.determinant() > 0) {
      const auto minimum = lines_.critical_point(
          there_.force.determinant() > 0 ? there_.p : here_.p, true, furthest());
      if (minimum && is_near(*minimum)) {
        trail_.end = lines_.graph_.minimum_at(*minimum);
        return Next::ended;
      }
    }
    if (scale_ > 0.2) {
      scale_ /= 2;
      return Next::again;
    }
    constexpr int most_stalls = 40;
    const auto saddle = lines_.critical_point(here_.p, false, furthest());
    if (saddle && is_near(*saddle) && stalls_ < most_stalls) {
      ++stalls_;
      pass(*saddle);
      return Next::again;
    }
    if (scale_ > least) {
      scale_ /= 2;
      return Next::again;
    }
    if (++stalls_ > most_stalls) return Next::stuck;
    return step_explicitly() ? Next::on : Next::ended;
  }

  bool is_near(const ValleyPoint& point) const {
    return distance(point.place, here_.p) <= 2 * lines_.reach(here_.radius);
  }
  /// The search radius around either end of a step.
  double furthest() const { return 3 * lines_.reach(here_.radius); }

  /// Continues a line that almost meets a saddle, to the side on which the line is.
  void pass(const ValleyPoint& saddle) {
    direction_ = dot(here_.force.force, saddle.tangent) < 0 ? -saddle.tangent : saddle.tangent;
    trail_.points.push_back({saddle.place, saddle.radius, direction_, ValleyPoint::Kind::valley});
    here_.p = saddle.place + 0.25 * lines_.reach(saddle.radius) * direction_;
    here_.force = lines_.force_at(here_.p, here_.radius);
    before_ = {};
    record(ValleyPoint::Kind::valley);
  }

  /// Takes the step, and ends the line if it meets a known valley.
  Next go() {
    if (scale_ >= 0.15) settled_ = false;
    const Vec2 way = there_.p - here_.p;
    before_ = here_;
    here_ = there_;
    direction_ = unit(way);
    record(ValleyPoint::Kind::valley);
    if (share_ > 0 && joins(way)) return Next::ended;
    if (turn_ > 0.98) scale_ = std::min(longest, scale_ * 1.6);
    return Next::on;
  }

  bool joins(Vec2 way) {
    const ValleyGraph& graph = lines_.graph_;
    trail_.end = graph.joined(here_.p, here_.radius, direction_, share_, climbing_);
    if (trail_.end == no_point && climbing_)
      trail_.end = graph.crossed(here_.p - way, here_.p, here_.radius);
    return trail_.end != no_point;
  }

  ForceLines& lines_;
  const double share_;
  Trail trail_;
  Spot before_;  ///< the start of the last step, if the line continues from it
  Spot here_;
  Spot there_;  ///< the end of the step
  Vec2 direction_;
  Vec2 moved_;              ///< the direction of the step
  double turn_ = 1;         ///< the cosine between it and the last direction
  double scale_ = longest;  ///< of the step, in units of the longest here
  bool begins_ = true;
  bool climbing_;
  bool settled_ = false;  ///< since the last good step
  int stalls_ = 0;
};

Trail ForceLines::follow(Vec2 p, Vec2 direction, double share, Start start) {
  return Walk(*this, p, direction, share, start).run();
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

void ForceLines::keep(std::uint32_t from, const Trail& trail) {
  std::uint32_t last = from;
  for (const ValleyPoint& point : trail.points) {
    // The last point may have become a minimum.
    if (trail.end != no_point && point.place == graph_.skeleton.points[trail.end].place) break;
    const std::uint32_t index = graph_.add_point(point);
    graph_.add_link(last, index);
    last = index;
  }
  if (trail.end != no_point) graph_.add_link(last, trail.end);
}

}  // namespace medial::potential
