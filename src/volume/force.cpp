#include "volume/force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "base/threads.h"
#include "base/vec3.h"

namespace medial::volume {
namespace {

Vec3 unit(Vec3 a) {
  const double length = norm(a);
  return length > 0 ? 1 / length * a : Vec3{};
}

/// The integral of (p - x) / |p - x|^(order + 2) over a triangle, times scale^(order + 2).
Vec3 force_of(Vec3 p, const Triangle& triangle, int order, double scale, int depth = 0) {
  const auto& [a, b, c] = triangle.corner;
  const Vec3 middle = 1.0 / 3 * (a + b + c);
  const double side = std::max(
      {medial::squared_norm(b - a), medial::squared_norm(c - b), medial::squared_norm(a - c)});
  constexpr int deepest = 16;
  constexpr double small = 0.25;  // the square of a side that is small, by the distance's
  if (side > small * medial::squared_norm(middle - p) && depth < deepest) {
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    Vec3 sum;
    for (const Triangle& part : {Triangle{{a, ab, ca}}, Triangle{{ab, b, bc}},
                                 Triangle{{ca, bc, c}}, Triangle{{ab, bc, ca}}})
      sum = sum + force_of(p, part, order, scale, depth + 1);
    return sum;
  }
  // Seven points, exact for polynomials up to degree 5 (Dunavant 1985).
  const auto at = [&](Vec3 x, double weight) {
    const double distance = norm(p - x);
    return weight / distance * std::pow(scale / distance, order + 1) * (p - x);
  };
  Vec3 sum = at(middle, 0.225);
  constexpr std::array<std::array<double, 2>, 2> points = {
      {{0.470142064105115, 0.132394152788506}, {0.101286507323456, 0.125939180544827}}};
  for (const auto& [share, weight] : points)
    for (const Vec3 corner : {a, b, c})
      sum = sum + at((1 - 3 * share) * corner + 3 * share * middle, weight);
  return 0.5 * norm(cross(b - a, c - a)) * sum;
}

// ---- Where lines start.

struct ConvexEdge {
  std::array<std::uint32_t, 2> ends;
  std::array<Vec3, 2> normals;  ///< of its faces
};

/// The edges at which the surface turns outwards by the angle or more.
std::vector<ConvexEdge> convex_edges(const Grid& grid, double angle) {
  const double cosine = std::cos(angle * std::numbers::pi / 180);
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> first;  // of the two faces
  std::vector<ConvexEdge> edges;
  for (std::uint32_t f = 0; f < grid.faces.size(); ++f) {
    const Face& face = grid.faces[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<std::uint32_t, 2> ends = {std::min(face[i], face[(i + 1) % 3]),
                                                 std::max(face[i], face[(i + 1) % 3])};
      const auto [at, is_new] = first.try_emplace(ends, f);
      if (is_new) continue;
      const Triangle other = grid.triangle(at->second), here = grid.triangle(f);
      const auto normal = [](const Triangle& t) {
        return unit(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
      };
      const ConvexEdge edge{ends, {normal(other), normal(here)}};
      const Vec3 beyond = grid.vertices[face[(i + 2) % 3]] - grid.vertices[ends[0]];
      if (dot(edge.normals[0], edge.normals[1]) <= cosine && dot(edge.normals[0], beyond) < 0)
        edges.push_back(edge);
    }
  }
  return edges;
}

/// Edges end to end between vertices at which not just two convex edges meet.
using EdgeChain = std::vector<std::uint32_t>;

std::vector<EdgeChain> chains_of(const std::vector<ConvexEdge>& edges,
                                 const std::map<std::uint32_t, std::vector<std::uint32_t>>& at) {
  std::vector<bool> used(edges.size());
  std::vector<EdgeChain> chains;
  const auto add = [&](std::uint32_t edge, std::uint32_t from) {
    EdgeChain chain;
    while (!used[edge]) {
      used[edge] = true;
      chain.push_back(edge);
      const auto& [a, b] = edges[edge].ends;
      from = from == a ? b : a;
      const std::vector<std::uint32_t>& next = at.at(from);
      if (next.size() != 2) break;
      edge = next[0] == edge ? next[1] : next[0];
    }
    if (!chain.empty()) chains.push_back(std::move(chain));
  };
  for (const auto& [vertex, around] : at)
    if (around.size() != 2)
      for (const std::uint32_t edge : around) add(edge, vertex);
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) add(edge, edges[edge].ends[0]);
  return chains;
}

/// From a point of the surface inwards, to where the faces around are `depth` away.
Vec3 inwards(Vec3 p, const std::vector<Vec3>& normals) {
  constexpr double depth = 2, farthest = 12;
  Vec3 sum;
  for (const Vec3 normal : normals) sum = sum + normal;
  const Vec3 up = -unit(sum);
  double least = 1;
  for (const Vec3 normal : normals) least = std::min(least, -dot(up, normal));
  return p + std::min(farthest, depth / std::max(least, depth / farthest)) * up;
}

/// Starts of a sheet, in order along a chain of edges, about a voxel apart.
std::vector<Vec3> starts_along(const EdgeChain& chain, const std::vector<ConvexEdge>& edges,
                               const Grid& grid) {
  std::vector<Vec3> starts;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const ConvexEdge& edge = edges[chain[i]];
    auto [from, to] = edge.ends;
    // The end that the next edge, or not the one before, has.
    const auto has = [&](std::size_t k, std::uint32_t vertex) {
      const auto& ends = edges[chain[k]].ends;
      return ends[0] == vertex || ends[1] == vertex;
    };
    if (i + 1 < chain.size() ? has(i + 1, from) && !has(i + 1, to) : i > 0 && has(i - 1, to))
      std::swap(from, to);
    const Vec3 a = grid.vertices[from], b = grid.vertices[to];
    const auto count = static_cast<int>(std::max(1.0, std::round(norm(b - a))));
    for (int k = 0; k < count; ++k)
      starts.push_back(
          inwards(a + (k + 0.5) / count * (b - a), {edge.normals[0], edge.normals[1]}));
  }
  return starts;
}

// ---- Lines.

constexpr std::uint32_t not_added = Voxel::no_face;

struct ForceLine {
  std::vector<Vec3> points;
  std::vector<double> radii;
  std::vector<std::uint32_t> vertices;  ///< of the surface, or not_added
};

class Follower {
 public:
  Follower(const ForceField& field, const FeetFinder& finder, FeetFinder::Scratch& scratch)
      : field_(field), finder_(finder), scratch_(scratch) {}

  /// The force line from p to a minimum of the potential. Where a step leads across a valley, it
  /// goes on from its floor, which lies between the last two points; where the force along the
  /// floor turns back, there is the minimum.
  ForceLine from(Vec3 p) {
    constexpr std::size_t longest = 20'000;
    constexpr double step = 0.5, nearest = 1;
    ForceLine line;
    Vec3 along, valley;
    while (line.points.size() < longest) {
      Vec3 force = force_at(p);
      if (radius_ < nearest) break;
      if (!line.points.empty() && dot(force, along) < 0) {
        p = floor_between(line.points.back(), p, along);
        force = force_at(p);
        if (dot(force, valley) < 0 || force == Vec3{}) {
          add(line, p);
          break;
        }
        valley = force;
      }
      add(line, p);
      along = force;
      p = p + step * along;
    }
    return line;
  }

 private:
  Vec3 force_at(Vec3 p) {
    const FeetFinder::Ray ray = finder_.ray(p, hint_, scratch_);
    hint_ = ray.face;
    radius_ = ray.length;
    return radius_ > 0 ? field_.direction(p, radius_) : Vec3{};
  }
  void add(ForceLine& line, Vec3 p) {
    line.points.push_back(p);
    line.radii.push_back(radius_);
    line.vertices.push_back(not_added);
  }
  /// Where the force has no part along the way from a to b.
  Vec3 floor_between(Vec3 a, Vec3 b, Vec3 along) {
    constexpr int halvings = 12;
    for (int i = 0; i < halvings; ++i) {
      const Vec3 middle = 0.5 * (a + b);
      (dot(force_at(middle), along) > 0 ? a : b) = middle;
    }
    return 0.5 * (a + b);
  }

  const ForceField& field_;
  const FeetFinder& finder_;
  FeetFinder::Scratch& scratch_;
  std::uint32_t hint_ = 0;
  double radius_ = 0;
};

std::vector<ForceLine> follow_all(const std::vector<Vec3>& starts, const ForceField& field,
                                  const FeetFinder& finder) {
  std::vector<ForceLine> lines(starts.size());
  Pool<FeetFinder::Scratch> pool;
  parallel_ranges(starts.size(), 4, [&](std::size_t begin, std::size_t end) {
    pool.with_one([&](FeetFinder::Scratch& scratch) {
      for (std::size_t i = begin; i < end; ++i)
        lines[i] = Follower(field, finder, scratch).from(starts[i]);
    });
  });
  return lines;
}

// ---- Sheets and curves.

/// Puts lines together: sheets between neighbours, curves where they meet.
class Weaver {
 public:
  explicit Weaver(AxisSurface& surface) : surface_(surface) {}

  /// A line that is a curve from its point `begin` on, up to where another curve was.
  void add_curve(ForceLine& line, std::size_t begin) {
    const std::set<Key> before = curves_;
    std::uint32_t last = 0;
    bool joined = false;
    for (std::size_t i = begin; i < line.points.size() && !joined; ++i) {
      const Key key = key_of(line.points[i]);
      joined = i > begin && before.contains(key);
      curves_.insert(key);
      const std::uint32_t here = add(line, i);
      if (i > begin) surface_.lines.push_back({last, here});
      last = here;
    }
  }

  /// The sheet between two neighbouring lines of a chain, up to where they meet, or come to where
  /// the sheet of another chain was.
  void add_strip(ForceLine& a, ForceLine& b, std::size_t chain) {
    std::size_t i = 0, j = 0;
    std::uint32_t at_a = not_added, at_b = not_added;
    while (i + 1 < a.points.size() || j + 1 < b.points.size()) {
      const bool on_a = j + 1 >= b.points.size() ||
                        (i + 1 < a.points.size() && distance(a.points[i + 1], b.points[j]) <=
                                                        distance(a.points[i], b.points[j + 1]));
      const double gap = distance(a.points[i], b.points[j]);
      if (gap < merged && i + j > 0) return add_curve(a, i);
      if (gap > parted || !owns(a.points[i], chain) || !owns(b.points[j], chain)) return;
      if (at_a == not_added) at_a = add(a, i);
      if (at_b == not_added) at_b = add(b, j);
      const std::uint32_t next = on_a ? add(a, ++i) : add(b, ++j);
      surface_.triangles.push_back({at_a, at_b, next});
      (on_a ? at_a : at_b) = next;
    }
  }

 private:
  using Key = std::array<std::int32_t, 3>;
  static constexpr double merged = 0.05, parted = 6;  ///< of voxels, between neighbours

  static Key key_of(Vec3 p) {
    return {static_cast<std::int32_t>(std::floor(p.x)), static_cast<std::int32_t>(std::floor(p.y)),
            static_cast<std::int32_t>(std::floor(p.z))};
  }
  /// Whether the voxel of p was of no sheet yet, or of this one.
  bool owns(Vec3 p, std::size_t chain) {
    return owners_.try_emplace(key_of(p), chain).first->second == chain;
  }
  std::uint32_t add(ForceLine& line, std::size_t i) {
    if (line.vertices[i] != not_added) return line.vertices[i];
    line.vertices[i] = static_cast<std::uint32_t>(surface_.vertices.size());
    surface_.vertices.push_back(line.points[i]);
    surface_.radii.push_back(line.radii[i]);
    return line.vertices[i];
  }

  AxisSurface& surface_;
  std::set<Key> curves_;
  std::map<Key, std::size_t> owners_;
};

}  // namespace

ForceField::ForceField(const Grid& grid, const FaceTree& tree, int order)
    : grid_(grid), tree_(tree), order_(order), reach_(std::pow(1000, 1.0 / (order - 1))) {}

Vec3 ForceField::direction(Vec3 p, double radius) const {
  const double reach = reach_ * radius;
  Vec3 sum;
  tree_.visit([&](const Box3& box) { return squared_distance(p, box) <= reach * reach; },
              [&](std::uint32_t k) {
                const Triangle triangle = grid_.triangle(tree_.order()[k]);
                sum = sum + force_of(p, triangle, order_, radius);
                return true;
              });
  return unit(sum);
}

AxisSurface force_surface(const ForceField& field, const Grid& grid, const FeetFinder& finder,
                          double angle, Control& control) {
  const std::vector<ConvexEdge> edges = convex_edges(grid, angle);
  std::map<std::uint32_t, std::vector<std::uint32_t>> at;  // the convex edges of each vertex
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    for (const std::uint32_t vertex : edges[i].ends) at[vertex].push_back(i);
  std::vector<Vec3> corners;
  for (const auto& [vertex, around] : at) {
    std::vector<Vec3> normals;
    for (const std::uint32_t edge : around)
      normals.insert(normals.end(), edges[edge].normals.begin(), edges[edge].normals.end());
    if (around.size() > 2) corners.push_back(inwards(grid.vertices[vertex], normals));
  }
  AxisSurface surface;
  Weaver weaver(surface);
  for (ForceLine& line : follow_all(corners, field, finder))
    if (!line.points.empty()) weaver.add_curve(line, 0);
  const std::vector<EdgeChain> chains = chains_of(edges, at);
  for (std::size_t chain = 0; chain < chains.size(); ++chain) {
    control.check(surface.vertices.size() * sizeof(Vec3) * 3);
    control.report(static_cast<double>(chain) / static_cast<double>(chains.size()));
    std::vector<ForceLine> lines =
        follow_all(starts_along(chains[chain], edges, grid), field, finder);
    const bool closed = at.at(edges[chains[chain][0]].ends[0]).size() == 2 &&
                        at.at(edges[chains[chain].back()].ends[0]).size() == 2 && lines.size() > 2;
    for (std::size_t i = 0; i + 1 < lines.size() + (closed ? 1 : 0); ++i) {
      ForceLine &a = lines[i], &b = lines[(i + 1) % lines.size()];
      if (!a.points.empty() && !b.points.empty()) weaver.add_strip(a, b, chain);
    }
  }
  return surface;
}

}  // namespace medial::volume
