// Partial collapse: what is wide stays a polygon, what is narrow becomes a line.

#include <algorithm>
#include <cmath>

#include "axis/curve.h"
#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "medial/centreline.h"
#include "medial/query.h"
#include "medial/sides.h"
#include "ops/part.h"
#include "ops/routes.h"

namespace medial {
namespace {

/// The axis cut where its radius is half of the width, and which of the edges are wide.
struct Cut {
  MedialAxis axis;
  std::vector<bool> wide;
};

Cut cut_at(const MedialAxis& axis, double radius) {
  std::vector<PathPiece> pieces;
  std::vector<bool> wide;
  const auto add = [&](std::uint32_t edge, double from, double to, bool is_wide) {
    if (!(from < to)) return;
    pieces.push_back({edge, from, to});
    wide.push_back(is_wide);
  };
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    double done = 0;
    for (const PathPiece& piece : ops::wide_pieces(axis, i, radius)) {
      add(i, done, piece.from, false);
      add(i, piece.from, piece.to, true);
      done = piece.to;
    }
    add(i, done, 1, false);
  }
  Cut cut{part_of(axis, pieces), std::move(wide)};
  // A disk without edges stays one.
  std::vector<bool> has_edge(axis.nodes.size(), false);
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t node : edge.node) has_edge[node] = true;
  for (std::size_t i = 0; i < axis.nodes.size(); ++i)
    if (!has_edge[i] && axis.nodes[i].disk.radius >= radius)
      cut.axis.nodes.push_back(axis.nodes[i]);
  return cut;
}

/// Sorts the narrow edges into those that stay with the polygons, those that become lines, and
/// those that are dropped: corners of narrow parts.
class Collapse {
 public:
  Collapse(const Cut& cut, double radius, double trim)
      : axis_(cut.axis), wide_(cut.wide), radius_(radius), trim_(trim), incidence_(cut.axis) {}

  void run() {
    const std::size_t count = axis_.edges.size();
    stays_ = wide_;
    at_cut_.assign(axis_.nodes.size(), false);
    for (std::size_t i = 0; i < count; ++i)
      if (wide_[i])
        for (const std::uint32_t node : axis_.edges[i].node) at_cut_[node] = true;
    for (const auto& edges : narrow_parts()) {
      // What would leave no line is no part of its own.
      const std::size_t lines_before = lines_.size();
      if (!belongs_to_polygon(edges)) add_lines(edges);
      if (lines_.size() > lines_before) continue;
      for (const std::uint32_t edge : edges) stays_[edge] = true;
    }
  }

  /// The axis of what stays.
  MedialAxis polygons() const {
    std::vector<PathPiece> pieces;
    for (std::uint32_t i = 0; i < axis_.edges.size(); ++i)
      if (stays_[i]) pieces.push_back({i, 0, 1});
    MedialAxis part = part_of(axis_, pieces);
    for (std::uint32_t i = 0; i < axis_.nodes.size(); ++i)
      if (incidence_.degree(i) == 0) part.nodes.push_back(axis_.nodes[i]);
    return part;
  }
  MedialAxis lines() const { return part_of(axis_, lines_); }

 private:
  double radius_at(std::uint32_t node) const { return axis_.nodes[node].disk.radius; }
  Vec2 center_of(std::uint32_t node) const { return axis_.nodes[node].disk.center; }
  bool is_narrow(std::uint32_t edge) const { return !wide_[edge]; }

  /// Narrow edges, connected otherwise than through a wide place.
  std::vector<std::vector<std::uint32_t>> narrow_parts() const {
    DisjointSets sets(axis_.edges.size());
    for (std::uint32_t node = 0; node < axis_.nodes.size(); ++node) {
      if (at_cut_[node]) continue;
      const auto edges = incidence_.edges(node);
      for (const std::uint32_t edge : edges) sets.join(edges[0], edge);
    }
    std::vector<std::vector<std::uint32_t>> parts;
    std::vector<std::uint32_t> part_of_set(axis_.edges.size(), none);
    for (std::uint32_t i = 0; i < axis_.edges.size(); ++i) {
      if (!is_narrow(i)) continue;
      std::uint32_t& part = part_of_set[sets.find(i)];
      if (part == none) {
        part = static_cast<std::uint32_t>(parts.size());
        parts.emplace_back();
      }
      parts[part].push_back(i);
    }
    return parts;
  }

  std::vector<std::uint32_t> nodes_of(const std::vector<std::uint32_t>& edges) const {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t edge : edges)
      for (const std::uint32_t node : axis_.edges[edge].node) nodes.push_back(node);
    ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  /// A corner, or a neck shorter than wide.
  bool belongs_to_polygon(const std::vector<std::uint32_t>& edges) const {
    const std::vector<std::uint32_t> nodes = nodes_of(edges);
    std::vector<std::uint32_t> cuts;
    for (const std::uint32_t node : nodes)
      if (at_cut_[node]) cuts.push_back(node);
    if (cuts.empty()) return false;
    const Vec2 first = center_of(cuts.front());
    for (const std::uint32_t cut : cuts)
      if (cut != cuts.front() && !(distance(center_of(cut), first) < 2 * radius_)) return false;
    return ranges::all_of(nodes, [&](std::uint32_t node) {
      return ranges::any_of(cuts, [&](std::uint32_t cut) {
        const double reach = distance(center_of(node), center_of(cut)) + radius_at(node);
        return reach <= (1 + trim_) * radius_ * (1 + 1e-9);
      });
    });
  }

  /// Lines of one narrow part: all but the dead ends that protrude little from where they begin.
  void add_lines(const std::vector<std::uint32_t>& edges) {
    const std::vector<std::uint32_t> nodes = nodes_of(edges);
    // Where nothing is wide, the search ends in the widest node.
    std::uint32_t root = none;
    if (ranges::none_of(nodes, [this](std::uint32_t node) { return at_cut_[node]; })) {
      root =
          *ranges::max_element(nodes, {}, [this](std::uint32_t node) { return radius_at(node); });
    }
    const auto is_root = [&](std::uint32_t node) { return at_cut_[node] || node == root; };
    const auto local = [&nodes](std::uint32_t node) {
      return static_cast<std::size_t>(ranges::lower_bound(nodes, node) - nodes.begin());
    };
    std::vector<std::uint32_t> degree(nodes.size(), 0);
    std::vector<double> reach(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) reach[i] = radius_at(nodes[i]);
    for (const std::uint32_t edge : edges)
      for (const std::uint32_t node : axis_.edges[edge].node) ++degree[local(node)];
    std::vector<std::uint32_t> leaves;
    for (const std::uint32_t node : nodes)
      if (degree[local(node)] == 1 && !is_root(node)) leaves.push_back(node);
    // From the dead ends inwards: `gone` are edges taken off, `dropped` those of them that begin
    // an arm which does not protrude.
    std::vector<bool> gone(edges.size(), false), dropped(edges.size(), false);
    const auto rank = [&edges](std::uint32_t edge) {
      return static_cast<std::size_t>(ranges::lower_bound(edges, edge) - edges.begin());
    };
    while (!leaves.empty()) {
      const std::uint32_t leaf = leaves.back();
      leaves.pop_back();
      if (degree[local(leaf)] != 1) continue;
      for (const std::uint32_t edge : incidence_.edges(leaf)) {
        if (!is_narrow(edge) || gone[rank(edge)]) continue;
        gone[rank(edge)] = true;
        degree[local(leaf)] = 0;
        const std::uint32_t next = other_end(axis_.edges[edge], leaf);
        const double arm = reach[local(leaf)] + length(axis_, axis_.edges[edge]);
        const bool decides = is_root(next) || incidence_.degree(next) > 2;
        dropped[rank(edge)] = decides && !(arm > (1 + trim_) * radius_at(next));
        reach[local(next)] = std::max(reach[local(next)], arm);
        if (--degree[local(next)] == 1 && !is_root(next)) leaves.push_back(next);
      }
    }
    // What is left, seen from the cuts and cycles.
    std::vector<std::uint32_t> queue;
    std::vector<bool> seen(nodes.size(), false), kept(edges.size(), false);
    const auto visit = [&](std::uint32_t node) {
      if (seen[local(node)]) return;
      seen[local(node)] = true;
      queue.push_back(node);
    };
    for (const std::uint32_t node : nodes)
      if (is_root(node) || degree[local(node)] > 1) visit(node);
    bool any = false;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const std::uint32_t edge : incidence_.edges(queue[i])) {
        if (!is_narrow(edge) || !ranges::binary_search(edges, edge)) continue;
        if (dropped[rank(edge)] || kept[rank(edge)]) continue;
        kept[rank(edge)] = any = true;
        visit(other_end(axis_.edges[edge], queue[i]));
      }
    }
    if (!any) return add_main_path(edges);
    clip(kept, edges);
  }

  /// A small part without any arm: its main path.
  void add_main_path(const std::vector<std::uint32_t>& edges) {
    std::vector<PathPiece> pieces;
    for (const std::uint32_t edge : edges) pieces.push_back({edge, 0, 1});
    for (const AxisPath& path : main_paths(part_of(axis_, pieces), {.trim = trim_}))
      for (const PathPiece& piece : path.pieces)
        lines_.push_back({edges[piece.edge], piece.from, piece.to});
  }

  /// Lines end on the arc of the polygon's end, one radius from the cut.
  void clip(const std::vector<bool>& kept, const std::vector<std::uint32_t>& edges) {
    const auto rank = [&edges](std::uint32_t edge) {
      return static_cast<std::size_t>(ranges::lower_bound(edges, edge) - edges.begin());
    };
    std::vector<PathPiece> pieces;
    for (const std::uint32_t edge : edges) pieces.push_back({edge, 0, 1});
    std::vector<bool> covered(edges.size(), false);
    for (const std::uint32_t cut : nodes_of(edges)) {
      if (!at_cut_[cut]) continue;
      std::vector<std::uint32_t> inside{cut};
      for (std::size_t i = 0; i < inside.size(); ++i) {
        for (const std::uint32_t edge : incidence_.edges(inside[i])) {
          if (!ranges::binary_search(edges, edge)) continue;
          const std::size_t k = rank(edge);
          if (!kept[k] || covered[k]) continue;
          const Edge& e = axis_.edges[edge];
          const bool forward = e.node[0] == inside[i];
          const std::uint32_t far = other_end(e, inside[i]);
          if (distance(center_of(far), center_of(cut)) <= radius_) {
            covered[k] = true;
            if (!at_cut_[far]) inside.push_back(far);
            continue;
          }
          const Curve curve = curve_of(axis_, e);
          double low = 0, high = 1;
          for (double middle = 0.5; low < middle && middle < high; middle = 0.5 * (low + high)) {
            const Vec2 p = curve.at(forward ? middle : 1 - middle).center;
            (distance(p, center_of(cut)) <= radius_ ? low : high) = middle;
          }
          (forward ? pieces[k].from : pieces[k].to) = forward ? high : 1 - high;
        }
      }
    }
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (kept[k] && !covered[k] && pieces[k].from < pieces[k].to) lines_.push_back(pieces[k]);
  }

  const MedialAxis& axis_;
  const std::vector<bool>& wide_;
  double radius_, trim_;
  const Incidence incidence_;
  std::vector<bool> stays_, at_cut_;
  std::vector<PathPiece> lines_;
};

/// The contours as rings. Between sites that join smoothly an outline may have steps of some
/// roundings, in any direction, that would overlap their neighbours: they are left out.
std::vector<Ring> rings_of(const std::vector<Contour>& contours, double tolerance) {
  const double step = 0x1p12 * tolerance;
  std::vector<Ring> rings;
  for (const Contour& contour : contours) {
    Ring& ring = rings.emplace_back();
    ring.role = RingRole::winding;
    for (const CurvePiece& piece : contour.pieces) {
      const Vec2 start = contour.points[piece.first];
      if (distance(start, contour.points[piece.first + 1]) <= step) continue;
      ring.points.push_back(start);
      ring.bulges.push_back(piece.bulge);
    }
    if (distance(contour.points.back(), contour.points.front()) > step) {
      ring.points.push_back(contour.points.back());
      ring.bulges.push_back(0);
    }
  }
  return rings;
}

}  // namespace

Result<CollapsedShape> collapse_narrow(const MedialAxis& axis, double width, double trim) {
  if (!(width > 0) || !std::isfinite(width) || !(trim >= 0))
    return Error{ErrorCode::invalid_option, "a width to collapse is a positive number", {}};
  const Cut cut = cut_at(axis, 0.5 * width);
  Collapse collapse(cut, 0.5 * width, trim);
  collapse.run();
  CollapsedShape result;
  result.lines = collapse.lines();
  const MedialAxis kept = collapse.polygons();
  if (kept.nodes.empty()) return result;
  // Where arcs meet in a cusp, no wider than rounding, their ends may overlap: then all tips are
  // rounded by a disk that is small against the width.
  const auto outline = [&](const MedialAxis& part) {
    return build_shape(rings_of(boundary_of(part), axis.tolerance), {.node_crossings = true});
  };
  auto shape = outline(kept);
  for (const double share : {0x1p-20, 0x1p-10})
    if (!shape && shape.error().code == ErrorCode::overlap)
      shape = outline(clearance_part(kept, 0.5 * share * width));
  if (!shape) return std::move(shape).error();
  result.polygons = std::move(shape).value();
  return result;
}

}  // namespace medial
