#include "engines/potential/skeleton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace medial::potential {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

bool contains(const Box& box, Vec2 p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
}

double segment_distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = squared_norm(along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return distance(p, a + t * along);
}

Vec2 unit(Vec2 v) {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : Vec2{};
}

/// The unit direction of the valley at a minimum or a saddle: the eigenvector of the derivatives'
/// larger eigenvalue. The other one, across the valley, is negative.
Vec2 valley_direction(const Force& force) {
  const double half = 0.5 * (force.xx - force.yy);
  const double angle = 0.5 * std::atan2(force.xy, half);
  return {std::cos(angle), std::sin(angle)};
}

/// Links of the skeleton near a place: a hash of cells whose size follows the distance to the
/// border, because steps do.
class LinkIndex {
 public:
  void add(std::uint32_t link, Vec2 a, Vec2 b, double scale) {
    const int level = std::ilogb(scale);
    visit(level, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)},
          [&](std::uint64_t key) { cells_[key].push_back(link); });
  }
  template <class Take>
  void near(Vec2 p, double reach, double scale, const Take& take) const {
    const int level = std::ilogb(scale);
    for (int l = level - 2; l <= level + 2; ++l) {
      visit(l, {p.x - reach, p.y - reach}, {p.x + reach, p.y + reach}, [&](std::uint64_t key) {
        const auto cell = cells_.find(key);
        if (cell == cells_.end()) return;
        for (const std::uint32_t link : cell->second) take(link);
      });
    }
  }

 private:
  template <class Visit>
  static void visit(int level, Vec2 low, Vec2 high, const Visit& act) {
    const double cell = std::ldexp(1.0, level);
    const auto at = [cell](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
    const std::int64_t right = std::min(at(high.x), at(low.x) + 8);
    const std::int64_t top = std::min(at(high.y), at(low.y) + 8);
    for (std::int64_t i = at(low.x); i <= right; ++i)
      for (std::int64_t k = at(low.y); k <= top; ++k) {
        const auto hash = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U ^
                          static_cast<std::uint64_t>(k) * 0xC2B2AE3D27D4EB4FU ^
                          static_cast<std::uint64_t>(level) * 0x165667B19E3779F9U;
        act(hash);
      }
  }
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// A force line, from its start to where it ends: at a minimum, or in a valley that is known.
struct Trail {
  std::vector<ValleyPoint> points;
  std::uint32_t end = none;  ///< a point of the skeleton; none: it left the box
  Vec2 place;                ///< of a possible saddle: where the force was weakest on a ridge
  double weakest = std::numeric_limits<double>::infinity();
};

/// To what a place of the border belongs: a minimum, and the side on which its line arrives.
struct Label {
  std::uint32_t minimum = none;
  bool side = false;
  friend bool operator==(const Label&, const Label&) = default;
};

/// A saddle, and to what its two lines lead.
struct Pass {
  Vec2 place;
  Label one, two;
};

/// A place on a loop: piece + share of its length.
struct Sample {
  double place = 0;
  Label label;
};

class Tracer {
 public:
  Tracer(const Region& region, const Charges& charges, const SkeletonOptions& options)
      : region_(region),
        options_(options),
        evaluator_(charges),
        limit_(options.step),
        budget_(20000 + 200 * region.pieces.size() + 5000 * region.holes()) {}

  Skeleton run() {
    if (options_.from) {
      trace_branch(*options_.from);
    } else {
      trace_corners();
      trace_bends();
      if (options_.within) {
        trace_box(*options_.within);
      } else {
        if (skeleton_.points.empty()) probe_any();
        connect();
      }
    }
    return std::move(skeleton_);
  }

 private:
  // ---- The field.

  Force force_at(Vec2 p, double& radius) {
    ++skeleton_.forces;
    radius = evaluator_.place(p).distance;
    return evaluator_.force(options_.order);
  }

  double reach(double radius) const { return std::min(limit_, radius); }

  /// One step along the force line, from p to a point q at the distance `step` about: the force at
  /// q points along q - p, or against it past a minimum. That is an implicit step, so it stays in
  /// narrow valleys. False where no such point is found.
  bool advance(Vec2 p, Vec2 direction, double step, Vec2& q, Force& force, double& radius) {
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
      const double slope =
          cross(aside, force.force) + cross(moved, force.derivative(aside)) / radius;
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

  /// The minimum (or the saddle) that Newton's method finds from p.
  std::optional<ValleyPoint> critical_point(Vec2 p, bool minimum) {
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
          return ValleyPoint{p, radius, valley_direction(force),
                             minimum ? ValleyPoint::Kind::minimum : ValleyPoint::Kind::saddle};
        return std::nullopt;
      }
      p = p + move;
      if (!minimum && i > 40) return std::nullopt;
    }
    return std::nullopt;
  }

  // ---- The skeleton so far.

  std::uint32_t add_point(const ValleyPoint& point, std::uint32_t minimum, bool side) {
    skeleton_.points.push_back(point);
    label_.push_back({minimum, side});
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    ++parts_;
    return static_cast<std::uint32_t>(skeleton_.points.size() - 1);
  }

  void add_link(std::uint32_t from, std::uint32_t to) {
    if (from == to) return;
    const ValleyPoint &a = skeleton_.points[from], &b = skeleton_.points[to];
    links_.add(static_cast<std::uint32_t>(skeleton_.links.size()), a.place, b.place,
               reach(std::max(a.radius, b.radius)));
    skeleton_.links.push_back({from, to});
    const std::uint32_t a_part = find(from), b_part = find(to);
    if (a_part == b_part) return;
    parent_[a_part] = b_part;
    --parts_;
  }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// The minimum at this place, known or new.
  std::uint32_t minimum_at(const ValleyPoint& point) {
    for (const std::uint32_t known : minima_) {
      const ValleyPoint& other = skeleton_.points[known];
      if (distance(other.place, point.place) <= 0.1 * reach(std::min(point.radius, other.radius)))
        return known;
    }
    const std::uint32_t index = add_point(point, none, false);
    label_[index].minimum = index;
    minima_.push_back(index);
    ++skeleton_.minima;
    return index;
  }

  /// The valley that a line at q joins, if it comes near enough to one: its next point downward.
  std::uint32_t joined(Vec2 q, double radius, Vec2 direction, double share) const {
    const double scale = reach(radius);
    double best = share * scale;
    std::uint32_t next = none;
    links_.near(q, best, scale, [&](std::uint32_t index) {
      const auto& link = skeleton_.links[index];
      const Vec2 a = skeleton_.points[link[0]].place, b = skeleton_.points[link[1]].place;
      const double away = segment_distance(q, a, b);
      if (away >= best || dot(unit(b - a), direction) < 0.3) return;
      best = away;
      next = link[1];
    });
    return next;
  }

  // ---- Force lines.

  /// Follows the force from p, at first in `direction`. With a `share` above 0 the line ends where
  /// it comes as near to a known valley, in units of a step.
  Trail follow(Vec2 p, Vec2 direction, double share) {
    Trail trail;
    double radius = 0;
    Force force = force_at(p, radius);
    double scale = 0.8;
    constexpr double least_scale = 0.8 / 64;
    constexpr int most_steps = 10000;
    constexpr int most_stalls = 40;
    int stalls = 0;
    bool settled = false;  // since the last good step
    for (int count = 0; count < most_steps && skeleton_.forces <= budget_; ++count) {
      if (options_.within && !contains(*options_.within, p) && count > 0) return trail;
      if (scale < 0.15 && !settled && settle(p, radius, force, direction)) {
        // Steps of this size would zigzag across the valley.
        settled = true;
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
        if (count > 0 || norm(force.force) > 1e-9) direction = blend(direction, force.force);
        continue;
      }
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
      if (dot(next.force, moved) < 0) {
        // The force has turned: a minimum or a saddle lies near, or the step was too long.
        if (next.determinant() > 0 || force.determinant() > 0) {
          const auto minimum = critical_point(next.determinant() > 0 ? q : p, true);
          if (minimum && distance(minimum->place, p) <= 2 * reach(radius)) {
            trail.end = minimum_at(*minimum);
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
      trail.points.push_back({p, radius, direction, ValleyPoint::Kind::valley});
      if (force.determinant() < 0 && norm(force.force) < trail.weakest) {
        trail.weakest = norm(force.force);
        trail.place = p;
      }
      if (share > 0) {
        trail.end = joined(p, radius, direction, share);
        if (trail.end != none) return trail;
      }
      if (turn > 0.98) scale = std::min(0.8, scale * 1.6);
    }
    trail.end = minimum_at({p, radius, direction, ValleyPoint::Kind::minimum});
    return trail;
  }

  /// Moves p straight to the floor of a narrow valley, and turns the direction along it. False
  /// where the valley is not narrow.
  bool settle(Vec2& p, double& radius, Force& force, Vec2& direction) {
    for (int i = 0; i < 8; ++i) {
      const Vec2 along = valley_direction(force), across = left_of(along);
      const double gentle = dot(along, force.derivative(along));
      const double steep = dot(across, force.derivative(across));
      if (!(steep < 0 && std::abs(gentle) < 0.4 * -steep)) return false;
      const double move = radius * dot(force.force, across) / -steep;
      if (!(std::abs(move) <= 0.5 * radius)) return false;
      p = p + move * across;
      force = force_at(p, radius);
      if (std::abs(move) > 0.01 * reach(radius)) continue;
      const Vec2 floor = valley_direction(force);
      direction = dot(floor, force.force) < 0 ? -floor : floor;
      return true;
    }
    return false;
  }

  static Vec2 blend(Vec2 direction, Vec2 force) {
    const Vec2 sum = direction + unit(force);
    return norm(sum) > 0.2 ? unit(sum) : unit(force);
  }

  Label label_of(const Trail& trail) const {
    if (trail.end == none) return {};
    if (label_[trail.end].minimum != trail.end) return label_[trail.end];
    const Vec2 valley = skeleton_.points[trail.end].tangent;
    const Vec2 last = trail.points.empty() ? Vec2{} : trail.points.back().tangent;
    return {trail.end, dot(valley, last) > 0};
  }

  /// Makes a line part of the skeleton; `from` is the point that it leaves.
  Label keep(std::uint32_t from, const Trail& trail) {
    const Label label = label_of(trail);
    std::uint32_t last = from;
    for (const ValleyPoint& point : trail.points) {
      const std::uint32_t index = add_point(point, label.minimum, label.side);
      add_link(last, index);
      last = index;
    }
    if (trail.end != none) add_link(last, trail.end);
    return label;
  }

  static constexpr double merge_share = 0.25;

  // ---- Where lines begin.

  bool wanted(Vec2 p) const { return !options_.within || contains(*options_.within, p); }

  /// The first point inside of a convex corner: on its bisector, as far as both its edges are
  /// nearest.
  bool corner_start(std::uint32_t piece, Vec2& p, Vec2& direction) {
    const Charge& after = region_.pieces[piece];
    const Charge& before = region_.pieces[region_.before(piece)];
    const Vec2 out = unit(after.end - after.start), in = unit(before.start - before.end);
    direction = unit(out + in);
    if (norm(out + in) < 1e-6) direction = left_of(out);
    const double half_sine = std::abs(cross(direction, out));
    double s = std::min(
        {0.5 * distance(after.start, after.end), 0.5 * distance(before.start, before.end), limit_});
    for (int i = 0; i < 60; ++i, s /= 2) {
      p = after.start + s * direction;
      const double radius = evaluator_.place(p).distance;
      if (radius >= 0.99 * s * half_sine && radius > 0) return true;
    }
    return false;
  }

  void trace_corners() {
    corner_labels_.resize(region_.corners.size());
    for (std::size_t i = 0; i < region_.corners.size(); ++i) {
      const std::uint32_t piece = region_.corners[i];
      const Vec2 corner = region_.pieces[piece].start;
      if (!wanted(corner)) continue;
      Vec2 p, direction;
      const bool found = corner_start(piece, p, direction);
      if (!found) continue;
      Trail trail = follow(p, direction, merge_share);
      double radius = evaluator_.place(p).distance;
      trail.points.insert(trail.points.begin(), {p, radius, direction, ValleyPoint::Kind::valley});
      const std::uint32_t leaf = add_point({corner, 0, {}, ValleyPoint::Kind::corner}, none, false);
      corner_labels_[i] = keep(leaf, trail);
      label_[leaf] = corner_labels_[i];
    }
  }

  void trace_bends() {
    for (const auto& [center, bend] : region_.bends) {
      if (!wanted(center)) continue;
      double radius = 0;
      const Force force = force_at(center, radius);
      // Only the centre of a maximal disk is a leaf; chords are a little nearer than their arc.
      if (!(radius > 0.99 * bend)) continue;
      const Trail trail = follow(center, unit(force.force), merge_share);
      const std::uint32_t leaf =
          add_point({center, radius, unit(force.force), ValleyPoint::Kind::valley}, none, false);
      label_[leaf] = keep(leaf, trail);
    }
  }

  /// A line from the border: what it belongs to. Where it may have passed a saddle is in `trail`.
  Label probe(std::uint32_t piece, double share, Trail& trail) {
    const Charge& charge = region_.pieces[piece];
    const Vec2 along = charge.end - charge.start;
    const Vec2 foot = charge.start + share * along;
    const Vec2 inward = unit(left_of(along));
    double height = std::min(0.1 * limit_, 0.2 * std::min(share, 1 - share) * norm(along));
    for (int i = 0; i < 40; ++i, height /= 2) {
      const double radius = evaluator_.place(foot + height * inward).distance;
      if (radius >= 0.999 * height) break;
    }
    trail = follow(foot + height * inward, inward, 0.1);
    return label_of(trail);
  }

  void probe_any() {
    Trail trail;
    probe(0, 0.5, trail);
  }

  // ---- Saddles.

  std::size_t cycles() const { return skeleton_.links.size() + parts_ - skeleton_.points.size(); }
  bool complete() const { return parts_ <= 1 && cycles() >= region_.holes(); }

  /// The saddle at this place, known or new. A new one becomes part of the skeleton if its lines
  /// connect what was not, or close a cycle that a hole asks for.
  const Pass& pass_at(const ValleyPoint& saddle) {
    for (const Pass& known : saddles_) {
      if (distance(known.place, saddle.place) <= 0.2 * reach(saddle.radius)) return known;
    }
    const Trail one = follow(saddle.place, saddle.tangent, merge_share);
    const Trail two = follow(saddle.place, -saddle.tangent, merge_share);
    saddles_.push_back({saddle.place, label_of(one), label_of(two)});
    if (one.end == none || two.end == none) return saddles_.back();
    const bool connects = find(one.end) != find(two.end);
    if (connects || (cycles() < region_.holes() && one.end != two.end)) {
      const std::uint32_t index = add_point(saddle, none, false);
      ++skeleton_.saddles;
      label_[index] = keep(index, one);
      keep(index, two);
    }
    return saddles_.back();
  }

  /// Looks for saddles between two places of a loop, the second one further on.
  void part_lines(const Sample& first, const Sample& second, bool sides, int depth) {
    const bool same_minimum = first.label.minimum == second.label.minimum;
    if (first.label.minimum == none || second.label.minimum == none || complete()) return;
    if (skeleton_.forces > budget_) return;
    if (sides ? first.label == second.label
              : same_minimum || find(first.label.minimum) == find(second.label.minimum))
      return;
    // Two lines that arrive from both sides may have nothing but their minimum in between.
    if (depth > (same_minimum ? 14 : 44)) return;
    Trail trail;
    Sample middle{0.5 * (first.place + second.place), {}};
    middle.label = probe_at(middle.place, trail);
    if (std::isfinite(trail.weakest)) {
      const auto saddle = critical_point(trail.place, false);
      if (saddle && distance(saddle->place, trail.place) <= 4 * reach(saddle->radius)) {
        const Pass& pass = pass_at(*saddle);
        if ((pass.one == first.label && pass.two == second.label) ||
            (pass.two == first.label && pass.one == second.label))
          return;
      }
    }
    part_lines(first, middle, sides, depth + 1);
    part_lines(middle, second, sides, depth + 1);
  }

  Label probe_at(double place, Trail& trail) {
    const Region::Loop& loop = *loop_;
    const double count = loop.end - loop.begin;
    double local = place - loop.begin;
    if (local >= count) local -= count;
    const double whole = std::min(std::floor(local), count - 1);
    const double share = std::clamp(local - whole, 1e-9, 1 - 1e-9);
    return probe(loop.begin + static_cast<std::uint32_t>(whole), share, trail);
  }

  void connect() {
    if (skeleton_.points.empty()) return;
    // Ever more places of the border, until all is connected.
    for (const int round : {0, 1, 2}) {
      if (complete()) return;
      for (std::size_t l = 0; l < region_.loops.size() && !complete(); ++l) {
        loop_ = &region_.loops[l];
        std::vector<Sample> samples = samples_of(l, round);
        if (samples.empty()) continue;
        samples.push_back(samples.front());
        samples.back().place += loop_->end - loop_->begin;
        for (std::size_t i = 0; i + 1 < samples.size(); ++i)
          part_lines(samples[i], samples[i + 1], round > 0, 0);
      }
    }
    skeleton_.whole = complete();
  }

  /// The convex corners of a loop, and so many places between them as the round asks for.
  std::vector<Sample> samples_of(std::size_t l, int round) {
    const Region::Loop& loop = region_.loops[l];
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < region_.corners.size(); ++i) {
      const std::uint32_t piece = region_.corners[i];
      if (piece >= loop.begin && piece < loop.end && corner_labels_[i].minimum != none)
        samples.push_back({static_cast<double>(piece), corner_labels_[i]});
    }
    const std::uint32_t count = loop.end - loop.begin;
    const std::uint32_t wanted_probes = round == 2 ? count : round == 1 ? 16 : l == 0 ? 0 : 4;
    if (samples.size() < wanted_probes || round == 2) {
      const std::uint32_t stride = std::max(1U, count / std::max(1U, wanted_probes));
      for (std::uint32_t i = 0; i < count; i += stride) {
        Trail trail;
        const double place = loop.begin + i + 0.5;
        samples.push_back({place, probe_at(place, trail)});
      }
    }
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.place < b.place; });
    return samples;
  }

  // ---- A part only.

  /// Step 1 of the algorithm: from a seed to the floor of a valley, as the force leads. False where
  /// it leads to a minimum without one.
  bool reach_valley(Vec2 p, ValleyPoint& contact) {
    double radius = 0;
    Force force = force_at(p, radius);
    constexpr int most_steps = 1000;
    for (int i = 0; i < most_steps && radius > 0; ++i) {
      Vec2 direction = unit(force.force);
      if (settle(p, radius, force, direction)) {
        contact = {p, radius, direction, ValleyPoint::Kind::valley};
        return true;
      }
      p = p + 0.4 * reach(radius) * unit(force.force);
      force = force_at(p, radius);
    }
    return false;
  }

  /// Follows a valley upward, to a corner, to a saddle, out of the box, or to where it ends.
  std::uint32_t climb(std::uint32_t from, Vec2 direction) {
    Vec2 p = skeleton_.points[from].place;
    double radius = skeleton_.points[from].radius, scale = 0.5;
    std::uint32_t last = from;
    constexpr int most_steps = 10000;
    for (int i = 0; i < most_steps && scale > 0.05; ++i) {
      if (options_.within && !contains(*options_.within, p)) break;
      if (radius < 0.02 * limit_) return link_to_corner(last);
      Vec2 q;
      Force force;
      double next_radius = 0;
      if (!advance(p, direction, scale * reach(radius), q, force, next_radius) ||
          dot(unit(q - p), direction) < 0.8) {
        scale /= 2;
        continue;
      }
      direction = unit(q - p);
      if (dot(force.force, direction) > 0) break;
      p = q;
      radius = next_radius;
      scale = std::min(0.5, 1.5 * scale);
      const std::uint32_t known = joined(p, radius, -direction, merge_share);
      const std::uint32_t index =
          known != none
              ? known
              : add_point({p, radius, -direction, ValleyPoint::Kind::valley}, none, false);
      add_link(index, last);
      if (known != none) return known;
      last = index;
    }
    return last;
  }

  std::uint32_t link_to_corner(std::uint32_t last) {
    const ValleyPoint& point = skeleton_.points[last];
    for (const std::uint32_t piece : region_.corners) {
      const Vec2 corner = region_.pieces[piece].start;
      if (distance(corner, point.place) > 0.1 * limit_) continue;
      const std::uint32_t leaf = add_point({corner, 0, {}, ValleyPoint::Kind::corner}, none, false);
      add_link(leaf, last);
      return leaf;
    }
    return last;
  }

  /// Steps 2 and 3: the branch of the skeleton that the force leads to from a seed, both ways.
  void trace_branch(Vec2 seed) {
    ValleyPoint contact;
    if (!reach_valley(seed, contact)) return;
    if (!wanted(contact.place)) return;
    if (joined(contact.place, contact.radius, contact.tangent, merge_share) != none) return;
    const std::uint32_t first = add_point(contact, none, false);
    climb(first, -contact.tangent);
    keep(first, follow(contact.place, contact.tangent, merge_share));
  }

  /// Branches that cross the box without a corner in it, from seeds all over it.
  void trace_box(const Box& box) {
    constexpr int seeds = 8;  // a side
    for (int i = 0; i < seeds; ++i)
      for (int k = 0; k < seeds; ++k) {
        const Vec2 seed{box.low.x + (i + 0.5) / seeds * (box.high.x - box.low.x),
                        box.low.y + (k + 0.5) / seeds * (box.high.y - box.low.y)};
        if (encloses(region_, seed)) trace_branch(seed);
      }
  }

  const Region& region_;
  const SkeletonOptions& options_;
  Evaluator evaluator_;
  double limit_;          ///< the longest step
  std::uint64_t budget_;  ///< forces that may be computed: more than any sound border asks for
  Skeleton skeleton_;
  LinkIndex links_;
  std::vector<Label> label_;           ///< of each point
  std::vector<std::uint32_t> parent_;  ///< of each point, in the forest of connected parts
  std::size_t parts_ = 0;              ///< connected ones
  std::vector<std::uint32_t> minima_;
  std::vector<Pass> saddles_;
  std::vector<Label> corner_labels_;
  const Region::Loop* loop_ = nullptr;
};

}  // namespace

Skeleton trace_valleys(const Region& region, const Charges& charges,
                       const SkeletonOptions& options) {
  return Tracer(region, charges, options).run();
}

}  // namespace medial::potential
