#include "support/true_graph.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"

namespace medial::test {
namespace {

namespace mp = boost::multiprecision;

template <unsigned bits>
using Float = mp::number<mp::cpp_bin_float<bits, mp::digit_base_2>, mp::et_off>;

template <class Real>
struct Vector {
  Real x, y;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector operator*(const Real& s, const Vector& a) { return {s * a.x, s * a.y}; }
};
template <class Real>
Real dot(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class Real>
Real cross(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.y - a.y * b.x;
}

/// What is zero. Numbers are of the size of the shape, which is 1.
template <class Real>
class Signs {
 public:
  explicit Signs(int zero_exponent) : zero_(mp::ldexp(Real(1), zero_exponent)) {}

  int operator()(const Real& x) {
    if (x > zero_) return 1;
    if (x < -zero_) return -1;
    ++zeros;
    return 0;
  }
  std::uint64_t zeros = 0;  ///< how many were

 private:
  Real zero_;
};

/// A site: a segment, or a reflex vertex.
template <class Real>
struct Place {
  bool vertex = false;
  Vector<Real> start, end;
  Vector<Real> along;          ///< the unit vector of a segment
  Vector<Real> before, after;  ///< of a vertex: those of the segments that meet there
  Real length{0};

  Vector<Real> normal() const { return {-along.y, along.x}; }
};

template <class Real>
struct TrueDisk {
  Vector<Real> center;
  Real radius{0};
  std::vector<std::uint32_t> contacts;
};

/// a.x x + a.y y + radius r + power (x x + y y - r r) = right.
template <class Real>
struct Row {
  std::array<Real, 4> factor;
  Real right;
};

template <class Real>
class BruteForce {
 public:
  BruteForce(std::span<const Site> sites, std::vector<std::uint32_t> next, const Box& box,
             int zero_exponent)
      : sign_(zero_exponent), next_(std::move(next)) {
    int exponent = 0;
    std::frexp(std::max(box.high.x - box.low.x, box.high.y - box.low.y), &exponent);
    scale_ = mp::ldexp(Real(1), -exponent);
    origin_ = {Real(box.low.x), Real(box.low.y)};
    for (const Site& site : sites) {
      Place<Real> place{
          site.kind() == SiteKind::vertex, local(site.start), local(site.end), {}, {}, {}};
      const Vector<Real> chord = place.end - place.start;
      place.length = sqrt(dot(chord, chord));
      if (!place.vertex) place.along = Real(1 / place.length) * chord;
      places_.push_back(std::move(place));
    }
    const auto count = static_cast<std::uint32_t>(places_.size());
    before_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (places_[next_[i]].vertex) places_[next_[i]].before = places_[i].along;
      if (places_[i].vertex) places_[i].after = places_[next_[i]].along;
      before_[next_[i]] = i;
    }
  }

  /// Whether the reflex vertices are those that the edges say.
  bool has_right_sites() {
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      const Place<Real>&place = places_[i], &after = places_[next_[i]];
      if (place.vertex && sign_(cross(place.before, place.after)) >= 0) return false;
      if (!place.vertex && !after.vertex && sign_(cross(place.along, after.along)) < 0)
        return false;
    }
    return true;
  }

  std::uint64_t zeros() const { return sign_.zeros; }

  SiteGraph graph() {
    SiteGraph graph;
    find_disks();
    for (TrueDisk<Real>& disk : disks_) sort_around(disk);
    link(graph);
    for (const TrueDisk<Real>& disk : disks_) {
      const Vector<Real> center = Real(1 / scale_) * disk.center + origin_;
      graph.disks.push_back({{double(center.x), double(center.y)}, double(disk.radius / scale_)});
      graph.contacts.push_back(disk.contacts);
    }
    if (lost_ && graph.failure.empty()) graph.failure = "brute force: disks out of order";
    return graph;
  }

 private:
  using Three = std::array<std::uint32_t, 3>;

  Vector<Real> local(Vec2 p) const {
    return scale_ * (Vector<Real>{Real(p.x), Real(p.y)} - origin_);
  }
  /// Whether a foot passes from one site to the next.
  bool joined(std::uint32_t i, std::uint32_t j) {
    if (next_[i] != j) return false;
    return places_[i].vertex || places_[j].vertex ||
           sign_(cross(places_[i].along, places_[j].along)) == 0;
  }

  Row<Real> row_of(std::uint32_t i) const {
    const Place<Real>& place = places_[i];
    const Vector<Real>& p = place.start;
    if (place.vertex) return {{Real(-2 * p.x), Real(-2 * p.y), Real(0), Real(1)}, Real(-dot(p, p))};
    const Vector<Real> n = place.normal();
    return {{n.x, n.y, Real(-1), Real(0)}, dot(n, p)};
  }
  /// The normal of a segment at one of its ends.
  Row<Real> normal_row(std::uint32_t segment, const Vector<Real>& end) const {
    const Vector<Real>& t = places_[segment].along;
    return {{t.x, t.y, Real(0), Real(0)}, dot(t, end)};
  }

  void find_disks() {
    const auto count = static_cast<std::uint32_t>(places_.size());
    for (std::uint32_t i = 0; i < count; ++i)
      if (!places_[i].vertex && !places_[next_[i]].vertex && !joined(i, next_[i]))
        disks_.push_back({places_[i].end, Real(0), {i, next_[i]}});
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < count; ++j)
        for (std::uint32_t k = j + 1; k < count; ++k) try_disks({i, j, k});
  }

  /// Replaces the equation of a site that is joined to another one of three.
  void replace_joined(const Three& sites, std::array<Row<Real>, 3>& rows) {
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        if (a == b || !joined(sites[a], sites[b])) continue;
        const bool segment_first = !places_[sites[a]].vertex;
        if (segment_first) {
          rows[b] = normal_row(sites[a], places_[sites[a]].end);
        } else {
          rows[a] = normal_row(sites[b], places_[sites[b]].start);
        }
      }
    }
  }

  /// Gauss: which unknown is free, and the others as a + b free. None where rows depend.
  struct Line {
    std::array<Real, 4> at, slope;
  };
  std::optional<Line> solve(std::array<Row<Real>, 3> rows) {
    std::array<std::size_t, 3> pivot{};
    std::array<bool, 4> used{};
    for (std::size_t r = 0; r < 3; ++r) {
      std::size_t row = r, column = 4;
      Real most(0);
      for (std::size_t i = r; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          if (!used[j] && abs(rows[i].factor[j]) > most) {
            most = abs(rows[i].factor[j]);
            row = i;
            column = j;
          }
      if (column == 4 || sign_(most) == 0) return std::nullopt;
      std::swap(rows[r], rows[row]);
      used[column] = true;
      pivot[r] = column;
      for (std::size_t i = 0; i < 3; ++i) {
        if (i == r) continue;
        const Real factor = rows[i].factor[column] / rows[r].factor[column];
        for (std::size_t j = 0; j < 4; ++j) rows[i].factor[j] -= factor * rows[r].factor[j];
        rows[i].factor[column] = 0;
        rows[i].right -= factor * rows[r].right;
      }
    }
    const auto free =
        static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
    Line line;
    line.at[free] = 0;
    line.slope[free] = 1;
    for (std::size_t r = 0; r < 3; ++r) {
      line.at[pivot[r]] = rows[r].right / rows[r].factor[pivot[r]];
      line.slope[pivot[r]] = -rows[r].factor[free] / rows[r].factor[pivot[r]];
    }
    return line;
  }

  void try_disks(const Three& sites) {
    std::array<Row<Real>, 3> rows{row_of(sites[0]), row_of(sites[1]), row_of(sites[2])};
    replace_joined(sites, rows);
    const auto line = solve(rows);
    if (!line) return;
    const auto& [x, y, r, q] = line->at;
    const auto& [u, v, s, p] = line->slope;
    // x x + y y - r r = q along the line.
    const Real a = u * u + v * v - s * s;
    const Real half_b = x * u + y * v - r * s - p / 2;
    const Real c = x * x + y * y - r * r - q;
    const auto at = [&](const Real& t) { try_disk({x + t * u, y + t * v}, r + t * s, sites); };
    if (a == 0 || sign_(a) == 0) {
      if (sign_(half_b) != 0) at(-c / (2 * half_b));
      return;
    }
    const Real square = half_b * half_b - a * c;
    const int several = sign_(square);
    if (several < 0) return;
    const Real root = several == 0 ? Real(0) : Real(sqrt(square));
    at((-half_b + root) / a);
    if (several > 0) at((-half_b - root) / a);
  }

  /// Adds a disk that touches three sites if it is one of the axis.
  void try_disk(const Vector<Real>& center, const Real& radius, const Three& sites) {
    if (sign_(radius) <= 0 || radius > 2) return;
    TrueDisk<Real> disk{center, radius, {}};
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      const int side = side_of(i, disk, sites);
      if (side < 0) return;
      if (side == 0) disk.contacts.push_back(i);
    }
    if (disk.contacts.size() < 3) return;
    for (const TrueDisk<Real>& other : disks_)
      if (sign_(other.center.x - center.x) == 0 && sign_(other.center.y - center.y) == 0) return;
    disks_.push_back(std::move(disk));
  }

  /// -1 where a site reaches into a disk, 0 where it touches, 1 outside; so of its ends. That a
  /// disk touches the three sites that it was made of need not be asked.
  int side_of(std::uint32_t i, const TrueDisk<Real>& disk, const Three& sites) {
    const auto made_of = [&](std::uint32_t site) {
      return sites[0] == site || sites[1] == site || sites[2] == site;
    };
    const Place<Real>& place = places_[i];
    const Vector<Real> from_start = disk.center - place.start;
    const bool given = made_of(i),
               from_before = given && made_of(before_[i]) && joined(before_[i], i);
    const bool to_next = given && made_of(next_[i]) && joined(i, next_[i]);
    if (place.vertex) {
      const int side = given ? 0 : sign_(dot(from_start, from_start) - disk.radius * disk.radius);
      if (side != 0) return side;
      const bool behind = from_before || sign_(dot(place.before, from_start)) >= 0;
      return behind && (to_next || sign_(dot(place.after, from_start)) <= 0) ? 0 : 1;
    }
    if (!places_[before_[i]].vertex && reaches_over(place.start, disk)) return -1;
    const Real foot = dot(place.along, from_start);
    if (!from_before && sign_(foot) < 0) return 1;
    if (!to_next && sign_(foot - place.length) > 0) return 1;
    if (given) return 0;
    const Real height = dot(place.normal(), from_start);
    const int side = sign_(abs(height) - disk.radius);
    return side == 0 && height < 0 ? 1 : side;
  }
  bool reaches_over(const Vector<Real>& p, const TrueDisk<Real>& disk) {
    const Vector<Real> way = disk.center - p;
    return sign_(dot(way, way) - disk.radius * disk.radius) < 0;
  }

  // ---- Edges.

  /// From a disk's centre to its foot on a site.
  Vector<Real> spoke(const TrueDisk<Real>& disk, std::uint32_t site) const {
    const Place<Real>& place = places_[site];
    if (place.vertex) return place.start - disk.center;
    return Real(-disk.radius) * place.normal();
  }
  /// Counter-clockwise from some direction on; joined sites, whose feet are one, along the
  /// boundary.
  bool is_before(const TrueDisk<Real>& disk, std::uint32_t i, std::uint32_t j) {
    if (joined(i, j)) return true;
    if (joined(j, i)) return false;
    const Vector<Real> a = spoke(disk, i), b = spoke(disk, j), first{Real(0.7071), Real(0.5403)};
    const bool upper = sign_(cross(first, a)) > 0;
    if (upper != (sign_(cross(first, b)) > 0)) return upper;
    const int turn = sign_(cross(a, b));
    if (turn == 0) lost_ = true;
    return turn > 0;
  }
  void sort_around(TrueDisk<Real>& disk) {
    if (disk.radius == 0) return;
    std::vector<std::uint32_t>& contacts = disk.contacts;
    for (std::size_t i = 1; i < contacts.size(); ++i)  // by insertion: always ends
      for (std::size_t j = i; j > 0 && is_before(disk, contacts[j], contacts[j - 1]); --j)
        std::swap(contacts[j], contacts[j - 1]);
  }

  /// Increases along the bisector of two sites with `right` on the right.
  Real place_along(const TrueDisk<Real>& disk, std::uint32_t right, std::uint32_t left) const {
    const Place<Real>&a = places_[right], &b = places_[left];
    if (!a.vertex) return dot(a.along, disk.center - a.start);
    if (!b.vertex) return -dot(b.along, disk.center - b.start);
    const Vector<Real> across = a.start - b.start;
    return cross(across, disk.center);
  }

  struct Leaving {
    Real place;
    bool forward = false;
    std::uint32_t disk = 0;
  };
  using Bisectors = std::map<std::array<std::uint32_t, 2>, std::vector<Leaving>>;

  Bisectors leaving() {
    Bisectors result;
    for (std::uint32_t i = 0; i < disks_.size(); ++i) {
      const TrueDisk<Real>& disk = disks_[i];
      for (std::size_t k = 0; k < disk.contacts.size(); ++k) {
        const std::uint32_t right = disk.contacts[k];
        const std::uint32_t left = disk.contacts[(k + 1) % disk.contacts.size()];
        const bool is_corner = disk.radius == 0 && next_[right] == left;
        if (joined(right, left) || (is_corner && k == 0)) continue;
        const std::array<std::uint32_t, 2> pair{std::min(right, left), std::max(right, left)};
        result[pair].push_back({place_along(disk, pair[0], pair[1]), right == pair[0], i});
      }
    }
    return result;
  }

  void link(SiteGraph& graph) {
    DisjointSets parts(disks_.size());
    for (auto& [pair, ends] : leaving()) {
      std::sort(ends.begin(), ends.end(), [&](const Leaving& a, const Leaving& b) {
        const int order = sign_(a.place - b.place);
        return order != 0 ? order < 0 : !a.forward && b.forward;
      });
      if (ends.size() % 2 != 0) lost_ = true;
      for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        if (!ends[i].forward || ends[i + 1].forward) lost_ = true;
        graph.links.push_back({{ends[i].disk, ends[i + 1].disk}, {pair[1], pair[0]}});
        parts.join(ends[i].disk, ends[i + 1].disk);
      }
    }
    parts_ = parts.count();
  }

 public:
  std::size_t parts() const { return parts_; }

 private:
  Signs<Real> sign_;
  std::vector<std::uint32_t> next_, before_;
  Real scale_{1};
  Vector<Real> origin_;
  std::vector<Place<Real>> places_;
  std::vector<TrueDisk<Real>> disks_;
  std::size_t parts_ = 0;
  bool lost_ = false;
};

template <unsigned bits>
SiteGraph computed_with(const Shape& shape, std::span<const Site> sites, int zero_exponent,
                        std::uint64_t& zeros) {
  BruteForce<Float<bits>> brute_force(sites, next_sites(shape, sites), bounding_box(shape),
                                      zero_exponent);
  if (!brute_force.has_right_sites()) return {.failure = "the sites are not the shape's"};
  SiteGraph graph = brute_force.graph();
  zeros = brute_force.zeros();
  const std::size_t cycles = graph.links.size() + brute_force.parts() - graph.disks.size();
  if (graph.failure.empty() &&
      (brute_force.parts() != shape.component_count() || cycles != shape.hole_count()))
    graph.failure = "brute force: " + std::to_string(brute_force.parts()) + " parts, " +
                    std::to_string(cycles) + " cycles";
  return graph;
}

}  // namespace

SiteGraph true_graph(const Shape& shape, std::span<const Site> sites) {
  std::size_t edges = 0;
  for (const Site& site : sites) {
    if (site.kind() == SiteKind::arc) return {.failure = "brute force: no arcs"};
    edges += site.kind() == SiteKind::segment ? 1 : 0;
  }
  if (edges != shape.points.size()) return {.failure = "the sites are not the shape's"};
  std::uint64_t zeros = 0;
  SiteGraph graph = computed_with<500>(shape, sites, -200, zeros);
  return zeros == 0 ? graph : computed_with<1200>(shape, sites, -500, zeros);
}

}  // namespace medial::test
