// Shapes of arcs as drawings, drives and offsets have them, spoilt by so little that rounding
// decides: the kinds with which attacks on the decisions next to arcs found faults.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "medial/compute.h"
#include "medial/offset.h"
#include "support/generate_arcs.h"
#include "support/generate_parts.h"
#include "support/nasty.h"

namespace medial::test {
namespace {

constexpr double pi = std::numbers::pi;

std::size_t up_to(Random& random, std::int64_t most) {
  return static_cast<std::size_t>(random.integer(1, most));
}

double sign(Random& random) { return random.chance(0.5) ? 1 : -1; }

double bulge_of(double angle) { return std::tan(angle / 4); }

/// How wide a neck is, or by which angle a joint turns, and the like.
double small_share(Random& random) {
  return random.power_of_ten(-14, random.chance(0.5) ? -6 : -1);
}

void add(Ring& ring, Vec2 p, double bulge = 0) {
  ring.points.push_back(p);
  ring.bulges.push_back(bulge);
}

/// An arc around `center` from one angle by `sweep`, in pieces; its end is for the next edge.
void add_arc(Ring& ring, Vec2 center, double radius, double from, double sweep,
             std::size_t pieces) {
  const double part = sweep / static_cast<double>(pieces);
  for (std::size_t i = 0; i < pieces; ++i)
    add(ring, center + polar(radius, from + part * static_cast<double>(i)), bulge_of(part));
}

Vec2 direction(Random& random) { return polar(1, random.between(0, two_pi)); }

/// Cuts a vertex in two, a tiny edge apart, which is straight or an arc.
void add_tiny_edges(Random& random, Ring& ring) {
  const double size = random.power_of_ten(-16, -3);
  for (std::size_t count = up_to(random, 2); count > 0; --count) {
    const auto last = static_cast<std::int64_t>(ring.points.size()) - 1;
    const auto at = random.integer(0, last);
    const Vec2 p = ring.points[static_cast<std::size_t>(at)];
    const double bulge = random.chance(0.5) ? 0 : random.between(-1, 1);
    ring.points.insert(ring.points.begin() + at, p + size * direction(random));
    ring.bulges.insert(ring.bulges.begin() + at, bulge);
  }
}

/// Points, bulges or both are off by one share of the size, at most `most`; tiny edges; turned,
/// scaled, far away.
Rings spoilt(Random& random, Ring ring, double most = 1e-3) {
  const double size = random.chance(0.2) ? 0 : random.power_of_ten(-16, std::log10(most));
  const std::int64_t kind = random.integer(0, 2);
  if (kind != 1)
    for (Vec2& p : ring.points) p = p + size * random.unit() * direction(random);
  if (kind != 0)
    for (double& bulge : ring.bulges) bulge *= 1 + size * random.between(-1, 1);
  if (random.chance(0.25)) add_tiny_edges(random, ring);
  const double turn = random.chance(0.3) ? 0 : random.between(0, two_pi);
  const double scale = random.chance(0.5) ? 1 : random.power_of_ten(-6, 6);
  const Vec2 away =
      random.chance(0.3) ? scale * random.power_of_ten(0, 9) * direction(random) : Vec2{};
  for (Vec2& p : ring.points) p = scale * turned(p, turn) + away;
  return {std::move(ring)};
}

// ---- Rows of circles, joined by necks.

/// On the circle of one radius around (x, 0), from a to b.
void add_arc_between(Random& random, Ring& ring, double x, Vec2 a, Vec2 b) {
  const Vec2 center{x, 0};
  const double from = std::atan2(a.y, a.x - x);
  double sweep = std::atan2(b.y, b.x - x) - from;
  if (sweep <= 0) sweep += two_pi;
  const std::size_t first = ring.points.size();
  add_arc(ring, center, distance(a, center), from, sweep, up_to(random, 2));
  ring.points[first] = a;
}

struct Neck {
  Vec2 left, right;  ///< its upper ends
};

Rings row_shape(Random& random, bool small) {
  const std::size_t n = 1 + up_to(random, small ? 1 : 4);
  std::vector<double> radii(n), centers(n);
  for (double& radius : radii) radius = random.chance(0.4) ? 1 : random.power_of_ten(-2, 0);
  std::vector<Neck> necks;
  double narrowest = 1;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double half = std::min(radii[i], radii[i + 1]) * small_share(random);
    narrowest = std::min(narrowest, half);
    const double reach = std::sqrt((radii[i] - half) * (radii[i] + half));
    const double length = random.chance(0.5) ? 0 : small_share(random);
    const Vec2 left{centers[i] + reach, half};
    necks.push_back({left, left + Vec2{length, 0}});
    centers[i + 1] =
        necks.back().right.x + std::sqrt((radii[i + 1] - half) * (radii[i + 1] + half));
  }
  Ring ring;
  const auto below = [](Vec2 p) { return Vec2{p.x, -p.y}; };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (necks[i].left != necks[i].right) add(ring, below(necks[i].left));
    const Vec2 end = i + 2 < n ? below(necks[i + 1].left) : necks[i].right;
    add_arc_between(random, ring, centers[i + 1], below(necks[i].right), end);
  }
  for (std::size_t i = n - 1; i > 0; --i) {
    const Neck& neck = necks[i - 1];
    if (neck.left != neck.right) add(ring, neck.right);
    const Vec2 end = i > 1 ? necks[i - 2].right : below(necks[0].left);
    add_arc_between(random, ring, centers[i - 1], neck.left, end);
  }
  if (random.chance(0.5)) {  // a joint in the middle of an arc: blunt, or reflex
    const auto last = static_cast<std::int64_t>(ring.points.size()) - 1;
    Vec2& p = ring.points[static_cast<std::size_t>(random.integer(0, last))];
    p = p + std::min(small_share(random), 0.5 * narrowest) * direction(random);
  }
  return spoilt(random, std::move(ring), 0.1 * narrowest);
}

// ---- Belts around pulleys, and slots along arcs.

/// Around pulleys at the corners of a polygon, on its outside; negative radii are bends inwards.
Rings belt_shape(Random& random, bool small) {
  const std::size_t n = 1 + up_to(random, small ? 2 : 6);
  const Ring corners =
      n == 2 ? Ring{{{-1, 0}, {1, 0}}, {}, {}} : star(random, std::max<std::size_t>(n, 4));
  const std::vector<Vec2>& centers = corners.points;
  const std::size_t count = centers.size();
  std::vector<double> radii(count);
  const bool alike = random.chance(0.4);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 in = centers[i] - centers[(i + count - 1) % count],
               out = centers[(i + 1) % count] - centers[i];
    const double size = alike ? 0.1 : random.power_of_ten(-3, -0.8);
    radii[i] = cross(in, out) < 0 ? -size : size;
  }
  Ring ring;
  /// Of the straight part from pulley i on: the angle of its outer normal.
  const auto normal_after = [&](std::size_t i) {
    const std::size_t next = (i + 1) % count;
    const Vec2 along = centers[next] - centers[i];
    return std::atan2(along.y, along.x) - std::acos((radii[i] - radii[next]) / norm(along));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double from = normal_after((i + count - 1) % count), to = normal_after(i);
    const double sweep = std::remainder(to - from, two_pi);
    const Vec2 end = centers[i] + polar(radii[i], to);
    add_arc(ring, centers[i], radii[i], from, radii[i] > 0 && sweep < -1 ? sweep + two_pi : sweep,
            up_to(random, 2));
    add(ring, end);
  }
  return spoilt(random, std::move(ring));
}

/// Between two arcs of one centre, with round ends.
Rings slot_shape(Random& random, bool small) {
  const double half = random.power_of_ten(-3, -0.5), sweep = random.between(0.1, 5);
  const auto pieces = [&] { return up_to(random, small ? 1 : 3); };
  Ring ring;
  add_arc(ring, {}, 1 + half, 0, sweep, pieces());
  add_arc(ring, polar(1, sweep), half, sweep, pi, pieces());
  add_arc(ring, {}, 1 - half, sweep, -sweep, pieces());
  add_arc(ring, {1, 0}, half, pi, pi, pieces());
  return spoilt(random, std::move(ring));
}

// ---- Few arcs.

/// Two arcs over and under a chord, often of nearly one circle, whose ends may be short sides.
Rings lens_shape(Random& random, bool) {
  const double over = random.chance(0.5) ? random.power_of_ten(-2, 2) : 1;
  const double under = random.chance(0.7) ? (1 + sign(random) * small_share(random)) / over
                                          : random.power_of_ten(-2, 0) / over;
  Ring ring;
  const auto add_end = [&](double x) {
    const double side = random.chance(0.5) ? 0 : small_share(random);
    if (side > 0) add(ring, {x, x * side}, random.chance(0.6) ? 0 : random.between(-0.5, 1));
    return side;
  };
  const double left = add_end(-1);
  add(ring, {-1, -left}, under);
  const double right = add_end(1);
  if (right > 0) ring.points.back() = {1, -right};
  add(ring, {1, right}, over);
  std::rotate(ring.points.begin(), ring.points.begin() + (left > 0 ? 1 : 0), ring.points.end());
  std::rotate(ring.bulges.begin(), ring.bulges.begin() + (left > 0 ? 1 : 0), ring.bulges.end());
  if (left > 0) ring.points.back() = {-1, left};
  return spoilt(random, std::move(ring));
}

/// Lobes: arcs over the sides of a regular polygon, near its circle or not, some of them inwards.
Rings rosette_shape(Random& random, bool small) {
  const std::size_t n = 1 + up_to(random, small ? 5 : 16);
  const double round = bulge_of(two_pi / static_cast<double>(n));
  const double lobe = random.chance(0.5) ? round : random.between(-0.5, 1) * round;
  const double off = small_share(random);
  Ring ring = bulged_polygon(n, lobe);
  for (double& bulge : ring.bulges) {
    if (random.chance(0.5)) bulge += round * off * random.between(-1, 1);
    if (random.chance(0.1)) bulge = 0;
  }
  return spoilt(random, std::move(ring));
}

/// Sectors of rings around one centre: stairs of arcs and of sides that point to it.
Rings sector_shape(Random& random, bool small) {
  const std::size_t n = 1 + up_to(random, small ? 1 : 6);
  const double inner = random.chance(0.3) ? 0 : random.between(0.05, 0.5);
  const double whole = random.chance(0.3) ? 1.5 * pi : random.between(0.3, 6);
  const double part = whole / static_cast<double>(n);
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double from = part * static_cast<double>(i);
    const double radius = random.chance(0.3) ? 1 : random.between(0.6, 1.5);
    add_arc(ring, {}, radius, from, part, 1);
    add(ring, polar(radius, from + part));
  }
  if (inner > 0) add_arc(ring, {}, inner, whole, -whole, 1);
  add(ring, polar(inner, 0));
  return spoilt(random, std::move(ring));
}

// ---- Outlines with something small on them.

/// A circle, bar or polygon with a dent, bump or slit on an edge.
Rings dimple_shape(Random& random, bool small) {
  Ring ring = random.chance(0.4)   ? arcs_of_circle(2 + static_cast<int>(up_to(random, 4)))
              : random.chance(0.5) ? stadium({-1, 0}, {1, 0}, random.power_of_ten(-1, 0))
                                   : rounded(star(random, small ? 4 : 3 + up_to(random, 8)),
                                             random.between(0.01, 0.2));
  const auto at = static_cast<std::size_t>(
      random.integer(0, static_cast<std::int64_t>(ring.points.size()) - 1));
  const Vec2 a = ring.points[at], b = ring.points[(at + 1) % ring.points.size()];
  const double bulge = ring.bulges[at], angle = 4 * std::atan(bulge);
  const double share = random.between(0.1, 0.8), size = small_share(random);
  const auto on_edge = [&](double t) {
    if (bulge == 0) return a + t * (b - a);
    const double half = angle / 2;
    return a + std::sin(t * half) / std::sin(half) * turned(b - a, (t - 1) * half);
  };
  const auto part_of = [&](double part) { return bulge_of(part * angle); };
  const Vec2 from = on_edge(share), to = on_edge(share + size);
  std::vector<Vec2> points{from};
  std::vector<double> bulges{0};
  if (random.chance(0.5)) {
    bulges = {random.between(-1.5, 1)};
  } else {
    points.push_back(midpoint(from, to) + random.between(-2, 2) * left_of(to - from));
    bulges.push_back(0);
  }
  points.push_back(to);
  bulges.push_back(part_of(1 - share - size));
  ring.bulges[at] = part_of(share);
  const auto place = static_cast<std::ptrdiff_t>(at) + 1;
  ring.points.insert(ring.points.begin() + place, points.begin(), points.end());
  ring.bulges.insert(ring.bulges.begin() + place, bulges.begin(), bulges.end());
  return spoilt(random, std::move(ring));
}

/// Polygons with corners rounded so that arcs all but meet, or by less than rounding.
Rings fillet_shape(Random& random, bool small) {
  const Ring corners = random.chance(0.5) ? star(random, 3 + up_to(random, small ? 2 : 9))
                                          : rectangle(random.between(1, 4), 1)[0];
  const double radius = random.chance(0.3) ? 10 : small_share(random);
  return spoilt(random, rounded(corners, radius));
}

/// Edges that are hardly bent, and smooth waves.
Rings bow_shape(Random& random, bool small) {
  if (random.chance(0.3)) return spoilt(random, smooth_biarcs(random, 16 * up_to(random, 2), 1));
  Ring ring = star(random, 3 + up_to(random, small ? 3 : 12));
  ring.bulges.assign(ring.points.size(), 0);
  for (double& bulge : ring.bulges)
    bulge = random.chance(0.2) ? 0 : sign(random) * random.power_of_ten(-16, -2);
  return spoilt(random, std::move(ring));
}

constexpr std::array<NastyClass, 9> families{{{"rows", row_shape, true},
                                              {"belts", belt_shape, true},
                                              {"slots", slot_shape, true},
                                              {"lenses", lens_shape, true},
                                              {"rosettes", rosette_shape, true},
                                              {"sectors", sector_shape, true},
                                              {"dimples", dimple_shape, true},
                                              {"fillets", fillet_shape, true},
                                              {"bows", bow_shape, true}}};

/// An offset of one of these, or an offset of that.
Rings offset_shape(Random& random, bool small) {
  const auto family = static_cast<std::size_t>(random.integer(0, families.size() - 1));
  Rings rings = families[family].generate(random, small);
  for (std::size_t times = up_to(random, 2); times > 0; --times) {
    const auto shape = build_shape(rings);
    const auto axis = shape ? compute(*shape, {.threads = 1}) : Result<MedialAxis>(Error{});
    if (!axis || axis->nodes.empty()) return rings;
    double largest = 0;
    for (const Node& node : axis->nodes) largest = std::max(largest, node.disk.radius);
    const double clearance = random.between(0.02, 0.95) * largest * sign(random);
    const auto offsets = offset_curves(*shape, std::array{clearance}, {.threads = 1});
    if (!offsets || offsets->regions.empty()) return rings;
    rings = offsets->regions.front().rings;
  }
  return rings;
}

}  // namespace

std::span<const NastyClass> nasty_arc_classes() {
  static const std::vector<NastyClass> all = [] {
    std::vector<NastyClass> classes(families.begin(), families.end());
    classes.push_back({"offsets", offset_shape, true});
    return classes;
  }();
  return all;
}

}  // namespace medial::test
