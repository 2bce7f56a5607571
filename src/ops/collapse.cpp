// Partial collapse: wide parts stay polygons, narrow parts become lines.

#include <algorithm>
#include <cmath>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "medial/centreline.h"
#include "medial/query.h"
#include "medial/sides.h"
#include "ops/half_edges.h"
#include "ops/routes.h"
#include "ops/trees.h"

namespace medial {
namespace {

/// The axis divided where its radius is half of the width, with the wide edges marked.
struct DividedAxis {
  MedialAxis axis;
  std::vector<bool> wide;
};

DividedAxis divided_at(const MedialAxis& axis, double radius) {
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
  DividedAxis divided{part_of(axis, pieces), std::move(wide)};
  // A node without edges stays.
  const std::vector<std::uint32_t> degree = degrees_of(axis);
  for (std::size_t i = 0; i < axis.nodes.size(); ++i)
    if (degree[i] == 0 && axis.nodes[i].disk.radius >= radius)
      divided.axis.nodes.push_back(axis.nodes[i]);
  return divided;
}

/// Sorts the narrow edges into those that stay with the polygons, those that become lines, and
/// those that are dropped: corners of narrow parts.
class Collapse {
 public:
  Collapse(const DividedAxis& divided, double radius, double trim)
      : axis_(divided.axis),
        wide_(divided.wide),
        radius_(radius),
        trim_(trim),
        incidence_(divided.axis),
        parts_(divided.axis) {}

  void run() {
    const std::size_t count = axis_.edges.size();
    stays_ = wide_;
    at_cut_.assign(axis_.nodes.size(), false);
    for (std::size_t i = 0; i < count; ++i)
      if (wide_[i])
        for (const std::uint32_t node : axis_.edges[i].node) at_cut_[node] = true;
    for (const Part& part : narrow_parts()) {
      // A narrow part without lines does not count as a part.
      const std::size_t lines_before = lines_.size();
      if (!belongs_to_polygon(part)) add_lines(part);
      if (lines_.size() > lines_before) continue;
      for (const std::uint32_t edge : part.edges) stays_[edge] = true;
    }
  }

  /// The axis of the polygons.
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
  /// Narrow edges that are connected without passing a wide place.
  struct Part {
    std::vector<std::uint32_t> edges, nodes;  ///< increasing
    MedialAxis graph;                         ///< of them alone, numbered in order
    std::vector<bool> at_cut;                 ///< of the graph's nodes: whether a wide part begins

    Vec2 center(std::uint32_t node) const { return graph.nodes[node].disk.center; }
    double radius(std::uint32_t node) const { return graph.nodes[node].disk.radius; }
  };

  std::vector<Part> narrow_parts() const {
    DisjointSets sets(axis_.edges.size());
    for (std::uint32_t node = 0; node < axis_.nodes.size(); ++node) {
      if (at_cut_[node]) continue;
      const auto edges = incidence_.edges(node);
      for (const std::uint32_t edge : edges) sets.join(edges[0], edge);
    }
    std::vector<Part> parts;
    std::vector<std::uint32_t> part_of_set(axis_.edges.size(), none);
    for (std::uint32_t i = 0; i < axis_.edges.size(); ++i) {
      if (wide_[i]) continue;
      std::uint32_t& part = part_of_set[sets.find(i)];
      if (part == none) {
        part = static_cast<std::uint32_t>(parts.size());
        parts.emplace_back();
      }
      parts[part].edges.push_back(i);
    }
    for (Part& part : parts) fill(part);
    return parts;
  }

  void fill(Part& part) const {
    for (const std::uint32_t edge : part.edges)
      for (const std::uint32_t node : axis_.edges[edge].node) part.nodes.push_back(node);
    ranges::sort(part.nodes);
    part.nodes.erase(std::unique(part.nodes.begin(), part.nodes.end()), part.nodes.end());
    for (const std::uint32_t node : part.nodes) {
      part.graph.nodes.push_back(axis_.nodes[node]);
      part.at_cut.push_back(at_cut_[node]);
    }
    for (const std::uint32_t edge : part.edges) {
      Edge& own = part.graph.edges.emplace_back(axis_.edges[edge]);
      for (std::uint32_t& node : own.node)
        node =
            static_cast<std::uint32_t>(ranges::lower_bound(part.nodes, node) - part.nodes.begin());
    }
  }

  /// Whether the part is a corner, or a neck that is shorter than wide.
  bool belongs_to_polygon(const Part& part) const {
    const auto count = static_cast<std::uint32_t>(part.nodes.size());
    std::vector<std::uint32_t> cuts;
    for (std::uint32_t node = 0; node < count; ++node)
      if (part.at_cut[node]) cuts.push_back(node);
    if (cuts.empty()) return false;
    const Vec2 first = part.center(cuts.front());
    for (const std::uint32_t cut : cuts)
      if (cut != cuts.front() && !(distance(part.center(cut), first) < 2 * radius_)) return false;
    const auto is_near = [&](std::uint32_t node) {
      return ranges::any_of(cuts, [&](std::uint32_t cut) {
        const double reach = distance(part.center(node), part.center(cut)) + part.radius(node);
        return reach <= (1 + trim_) * radius_ * (1 + 1e-9);
      });
    };
    for (std::uint32_t node = 0; node < count; ++node)
      if (!is_near(node)) return false;
    return true;
  }

  /// Adds the lines of one narrow part, without dead ends that protrude little from their bases.
  void add_lines(const Part& part) {
    const MedialAxis& graph = part.graph;
    // If nothing is wide, the widest node is the root.
    std::vector<bool> is_root = part.at_cut;
    if (std::find(is_root.begin(), is_root.end(), true) == is_root.end())
      is_root[deepest_node(graph)] = true;
    // First edges of arms that do not protrude.
    std::vector<bool> dropped(graph.edges.size(), false);
    std::vector<double> reach;
    for (const Node& node : graph.nodes) reach.push_back(node.disk.radius);
    const std::vector<std::uint32_t> degree = ops::take_off_leaves(
        graph, [&](std::uint32_t node) { return is_root[node]; },
        [&](std::uint32_t edge, std::uint32_t leaf, std::uint32_t inner) {
          const double arm = reach[leaf] + length(graph, graph.edges[edge]);
          const bool decides = is_root[inner] || incidence_.degree(part.nodes[inner]) > 2;
          dropped[edge] = decides && !(arm > (1 + trim_) * part.radius(inner));
          reach[inner] = std::max(reach[inner], arm);
        });
    // The remaining edges, from the roots and cycles outwards.
    const Incidence incidence(graph);
    std::vector<std::uint32_t> queue;
    std::vector<bool> seen(graph.nodes.size(), false), kept(graph.edges.size(), false);
    const auto visit = [&](std::uint32_t node) {
      if (!seen[node]) queue.push_back(node);
      seen[node] = true;
    };
    for (std::uint32_t node = 0; node < degree.size(); ++node)
      if (is_root[node] || degree[node] > 1) visit(node);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const std::uint32_t edge : incidence.edges(queue[i])) {
        if (dropped[edge]) continue;
        kept[edge] = true;
        visit(other_end(graph.edges[edge], queue[i]));
      }
    }
    if (std::find(kept.begin(), kept.end(), true) == kept.end()) return add_main_path(part);
    clip(part, incidence, kept);
  }

  /// Adds the main path of a small part without arms.
  void add_main_path(const Part& part) {
    std::vector<PathPiece> pieces;
    for (const std::uint32_t edge : part.edges) pieces.push_back({edge, 0, 1});
    for (const AxisPath& path : main_paths(parts_.part(pieces), {.trim = trim_}))
      for (const PathPiece& piece : path.pieces)
        lines_.push_back({part.edges[piece.edge], piece.from, piece.to});
  }

  /// Clips lines at the arc that ends the polygon, one radius from the cut.
  void clip(const Part& part, const Incidence& incidence, const std::vector<bool>& kept) {
    std::vector<PathPiece> pieces;
    for (const std::uint32_t edge : part.edges) pieces.push_back({edge, 0, 1});
    std::vector<bool> covered(part.edges.size(), false);
    for (std::uint32_t cut = 0; cut < part.nodes.size(); ++cut) {
      if (!part.at_cut[cut]) continue;
      const auto is_inside = [&](Vec2 p) { return distance(p, part.center(cut)) <= radius_; };
      std::vector<std::uint32_t> inside{cut};
      for (std::size_t i = 0; i < inside.size(); ++i) {
        for (const std::uint32_t k : incidence.edges(inside[i])) {
          if (!kept[k] || covered[k]) continue;
          const Edge& edge = part.graph.edges[k];
          const bool forward = edge.node[0] == inside[i];
          const std::uint32_t far = other_end(edge, inside[i]);
          if (is_inside(part.center(far))) {
            covered[k] = true;
            if (!part.at_cut[far]) inside.push_back(far);
            continue;
          }
          const Curve curve = curve_of(part.graph, edge);
          double low = 0, high = 1;
          for (double middle = 0.5; low < middle && middle < high; middle = 0.5 * (low + high))
            (is_inside(curve.at(forward ? middle : 1 - middle).center) ? low : high) = middle;
          (forward ? pieces[k].from : pieces[k].to) = forward ? high : 1 - high;
        }
      }
    }
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (kept[k] && !covered[k] && pieces[k].from < pieces[k].to) lines_.push_back(pieces[k]);
  }

  const MedialAxis& axis_;
  const std::vector<bool>& wide_;
  double radius_, trim_;
  const Incidence incidence_;
  ops::PartMaker parts_;
  std::vector<bool> stays_, at_cut_;
  std::vector<PathPiece> lines_;
};

}  // namespace

Result<CollapsedShape> collapse_narrow(const MedialAxis& axis, double width, double trim,
                                       double corner_angle) {
  if (!(width > 0) || !std::isfinite(width) || !(trim >= 0))
    return Error{ErrorCode::invalid_option, "the width to collapse must be positive", {}};
  const DividedAxis divided = divided_at(axis, 0.5 * width);
  Collapse collapse(divided, 0.5 * width, trim);
  collapse.run();
  CollapsedShape result;
  result.lines = collapse.lines();
  const MedialAxis kept = collapse.polygons();
  if (kept.nodes.empty()) return result;
  // If arcs meet in a cusp that is narrower than rounding, their ends may overlap. Then all tips
  // are rounded by a disk that is small relative to the width.
  const auto outline = [&](const MedialAxis& part) {
    // Between sites that join smoothly, an outline may have steps of a few roundings in any
    // direction, which would overlap their neighbours.
    std::vector<Ring> rings;
    for (const Contour& contour : ops::boundary_of(part, corner_angle)) {
      rings.push_back(ops::ring_of(contour, 0x1p12 * axis.tolerance));
      rings.back().role = RingRole::winding;
    }
    return build_shape(rings, {.node_crossings = true});
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
