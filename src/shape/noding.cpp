#include "shape/noding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/arc.h"
#include "base/compat.h"
#include "base/predicates.h"
#include "base/tolerance.h"
#include "shape/errors.h"

namespace medial {
namespace {

/// The smallest size of an outline with arcs, in tolerances. The position of a tangency is known up
/// to the square root of the tolerance times the size, which must be much smaller than the size.
constexpr double least_size = 1 << 10;

/// An arbitrary angle. After a rotation by it, edges and tangents of drawings are hardly ever
/// vertical.
constexpr double turn = 0.5931;

Box box_of(const CleanRings& cleaned) {
  Box box{cleaned.points[0], cleaned.points[0]};
  for (std::uint32_t v = 0; v < cleaned.points.size(); ++v) {
    box.add(cleaned.points[v]);
    if (cleaned.next(v) == no_index) continue;
    const BulgeArc arc{cleaned.points[v], cleaned.points[cleaned.next(v)], cleaned.bulges[v]};
    if (arc.bulge != 0) box.add(apex(arc));  // at most a quarter circle from what is outermost
  }
  return box;
}

/// The arc or its reverse, in a canonical direction, so that results do not depend on the
/// direction.
BulgeArc in_order(const BulgeArc& arc) {
  return lexicographic_less(arc.end, arc.start) ? arc.reversed() : arc;
}

/// The bulge of a part of an arc, measured from the end that the two share, if they share one.
double bulge_of_part(const BulgeArc& arc, Vec2 from, Vec2 to) {
  const bool forward = from == arc.start || (to != arc.end && lexicographic_less(from, to));
  return forward ? partial_bulge(arc, from, to) : 0 - partial_bulge(arc.reversed(), to, from);
}

std::vector<BulgeArc> edges_of(const CleanRings& cleaned) {
  std::vector<BulgeArc> edges;
  edges.reserve(cleaned.points.size());
  for (std::uint32_t v = 0; v < cleaned.points.size(); ++v) {
    const std::uint32_t next = cleaned.next(v);
    const Vec2 end = cleaned.points[next == no_index ? v : next];
    edges.push_back({cleaned.points[v], end, cleaned.bulges[v]});
  }
  return edges;
}

}  // namespace

Noding::Noding(const CleanRings& cleaned, double reach)
    : begin_(cleaned.begin), open_(cleaned.open) {
  const Box box = box_of(cleaned);
  frame_ = frame_of(box);
  map_ = best_map(edges_of(cleaned));
  size_ = frame_.scale * diagonal(box);
  tolerance_ = frame_.scale * std::max(tolerance_for(box, 0), reach);
  rings_.resize(begin_.size() - 1);
  std::iota(rings_.begin(), rings_.end(), 0U);
  nodes_.resize(cleaned.points.size());
  for (std::size_t v = 0; v < nodes_.size(); ++v) {
    const Vec2 point = cleaned.points[v];
    nodes_[v] = {point,
                 to_local(point),
                 cleaned.bulges[v],
                 cleaned.sources[v],
                 cleaned.sources[v],
                 cleaned.weights.empty() ? EdgeWeight{} : cleaned.weights[v]};
  }
}

std::optional<Error> Noding::too_small() const {
  if (nodes_.empty() || size_ >= least_size * tolerance_) return std::nullopt;
  return error_at(
      ErrorCode::unsupported,
      "the edges are too small for their coordinates to differ by more than rounding: move "
      "them nearer to the origin",
      nodes_[0].source, nodes_[0].original);
}

Vec2 Noding::to_local(Vec2 input) const {
  static const double cosine = std::cos(turn);
  static const double sine = std::sin(turn);
  const Vec2 local = turned(map_.to_image(frame_.to_local(input)), cosine, sine);
  return {local.x + 0.0, (map_.mirrors() ? -local.y : local.y) + 0.0};  // makes -0 to 0
}

Vec2 Noding::to_input(Vec2 local) const {
  const Vec2 upright{local.x, map_.mirrors() ? -local.y : local.y};
  const Vec2 image = turned(upright, std::cos(turn), -std::sin(turn));
  const Vec2 point = frame_.to_input(map_.to_input(image));
  return {point.x + 0.0, point.y + 0.0};
}

NodedRings Noding::monotone() const {
  NodedRings result;
  CleanRings& cleaned = result.cleaned;
  cleaned.open = open_;
  result.rings = rings_;
  const std::size_t expected = nodes_.size() + nodes_.size() / 4;
  for (auto* list : {&cleaned.points, &result.originals}) list->reserve(expected);
  for (auto* list : {&cleaned.sources, &result.sources}) list->reserve(expected);
  for (auto* list : {&cleaned.bulges, &result.edge_bulges}) list->reserve(expected);
  result.weights.reserve(expected);
  result.edges.reserve(expected);
  result.passing.reserve(expected);

  const auto append = [&](const Node& node, std::uint32_t edge, double bulge, std::uint32_t ring) {
    cleaned.points.push_back(node.local);
    cleaned.sources.push_back({ring, node.source.vertex});
    cleaned.bulges.push_back(bulge);
    result.sources.push_back(node.source);
    result.originals.push_back(node.original);
    result.edge_bulges.push_back(nodes_[edge].bulge);
    result.weights.push_back(nodes_[edge].weight);
    result.edges.push_back(edge);
  };
  for (std::uint32_t ring = 0; ring + 1 < begin_.size(); ++ring) {
    cleaned.begin.push_back(static_cast<std::uint32_t>(cleaned.points.size()));
    for (std::uint32_t v = begin_[ring]; v < begin_[ring + 1]; ++v) {
      const Node& node = nodes_[v];
      if (ends_chain(ring, v)) {
        result.passing.push_back(false);
        append(node, v, 0, ring);
        continue;
      }
      const BulgeArc arc{node.local, nodes_[next(ring, v)].local, node.bulge};
      auto upright = parallel_point(in_order(arc), {0, 1});
      // An arc that overhangs by less than the tolerance is not cut.
      if (upright && std::min(std::abs(upright->x - arc.start.x),
                              std::abs(upright->x - arc.end.x)) <= 2 * tolerance_) {
        upright.reset();
      }
      result.passing.push_back(false);
      if (!upright) {
        append(node, v, node.bulge, ring);
        continue;
      }
      append(node, v, partial_bulge(arc, arc.start, *upright), ring);
      Node passing = node;
      passing.local = {upright->x + 0.0, upright->y + 0.0};
      passing.original = to_input(*upright);
      // The highest vertex number, so that a loop never begins here.
      passing.source.vertex = std::numeric_limits<std::uint32_t>::max();
      result.passing.push_back(true);
      append(passing, v, 0 - partial_bulge(arc.reversed(), arc.end, *upright), ring);
    }
  }
  cleaned.begin.push_back(static_cast<std::uint32_t>(cleaned.points.size()));
  return result;
}

Noding::Moves::Moves(const NodedRings& noded, std::span<const Merge> merges, const QuarterMap& map)
    : less_{map}, moved_(less_) {
  for (const Merge& merge : merges) {
    const Vec2 from = target(noded.originals[merge.from]);
    const Vec2 to = target(noded.originals[merge.to]);
    if (from != to) moved_.emplace(std::max(from, to, less_), std::min(from, to, less_));
  }
}

Vec2 Noding::Moves::target(Vec2 point) const {
  for (auto it = moved_.find(point); it != moved_.end(); it = moved_.find(point))
    point = it->second;
  return point;
}

void Noding::move(Node& node, Vec2 original) const {
  node.original = original;
  node.local = to_local(original);
}

std::vector<Noding::SplitPoint> Noding::split_points_of(const NodedRings& noded,
                                                        std::span<const TouchedPoint> contacts,
                                                        const Moves& moves) const {
  std::vector<SplitPoint> cuts;
  cuts.reserve(contacts.size());
  for (const TouchedPoint& contact : contacts) {
    const Node& node = nodes_[contact.edge];
    const auto after = std::upper_bound(begin_.begin(), begin_.end(), contact.edge);
    const auto ring = static_cast<std::uint32_t>(after - begin_.begin()) - 1;
    const Vec2 end = nodes_[next(ring, contact.edge)].local;
    Node cut = node;
    if (contact.vertex == no_index) {
      move(cut, to_input(contact.point));
    } else {
      move(cut, moves.target(noded.originals[contact.vertex]));
      if (!noded.passing[contact.vertex]) cut.source = noded.sources[contact.vertex];
    }
    cuts.push_back({contact.edge, dot(end - node.local, cut.local - node.local), cut});
  }
  std::sort(cuts.begin(), cuts.end(), [](const SplitPoint& a, const SplitPoint& b) {
    return std::pair(a.edge, a.along) < std::pair(b.edge, b.along);
  });
  return cuts;
}

void Noding::append_parts(std::uint32_t v, std::uint32_t end, std::span<const SplitPoint> cuts,
                          const Moves& moves, std::vector<Node>& result) {
  const BulgeArc arc{nodes_[v].local, nodes_[end].local, nodes_[v].bulge};
  const Vec2 last = moves.target(nodes_[end].original);
  Node node = nodes_[v];
  move(node, moves.target(node.original));
  Vec2 from = arc.start;
  bool whole = true;
  for (const SplitPoint& cut : cuts) {
    if (cut.node.original == node.original || cut.node.original == last) continue;
    node.bulge = bulge_of_part(arc, from, cut.node.local);
    result.push_back(node);
    node = cut.node;
    from = node.local;
    whole = false;
    ++split_edges_;
  }
  if (node.original == last) return;
  if (!whole) node.bulge = bulge_of_part(arc, from, arc.end);
  result.push_back(node);
}

std::optional<Error> Noding::apply(const NodedRings& noded, std::span<const TouchedPoint> contacts,
                                   std::span<const Merge> merges) {
  const Moves moves(noded, merges, map_);
  const std::vector<SplitPoint> cuts = split_points_of(noded, contacts, moves);
  std::vector<Node> result;
  std::vector<std::uint32_t> begin;
  result.reserve(nodes_.size() + cuts.size());
  auto cut = cuts.begin();
  for (std::uint32_t ring = 0; ring + 1 < begin_.size(); ++ring) {
    const auto first = static_cast<std::uint32_t>(result.size());
    begin.push_back(first);
    for (std::uint32_t v = begin_[ring]; v < begin_[ring + 1]; ++v) {
      if (ends_chain(ring, v)) {
        result.push_back(nodes_[v]);
        move(result.back(), moves.target(nodes_[v].original));
        continue;
      }
      const auto next_cut =
          std::find_if(cut, cuts.end(), [v](const SplitPoint& c) { return c.edge != v; });
      append_parts(v, next(ring, v), span_between(cut, next_cut), moves, result);
      cut = next_cut;
    }
    const std::size_t size = result.size() - first;
    if (open_) continue;
    if (size < 2 || (size == 2 && result[first].bulge == -result[first + 1].bulge)) {
      return error_at(ErrorCode::no_area, "the ring encloses no area",
                      nodes_[begin_[ring]].edge_source, nodes_[begin_[ring]].original);
    }
  }
  begin.push_back(static_cast<std::uint32_t>(result.size()));
  nodes_ = std::move(result);
  begin_ = std::move(begin);
  return std::nullopt;
}

std::uint64_t Noding::drop_repeated() {
  struct Edge {
    Vec2 low, high;
    double bulge;  ///< from low to high
    std::uint32_t node;
    auto key() const { return std::tuple(low.x, low.y, high.x, high.y, bulge, node); }
  };
  std::vector<Edge> edges;
  for (std::uint32_t ring = 0; ring < rings_.size(); ++ring) {
    for (std::uint32_t v = begin_[ring]; !ends_chain(ring, v); ++v) {
      const Vec2 p = nodes_[v].original, q = nodes_[v + 1].original;
      const double bulge = nodes_[v].bulge;
      edges.push_back(lexicographic_less(p, q) ? Edge{p, q, bulge, v} : Edge{q, p, 0 - bulge, v});
    }
  }
  ranges::sort(edges, {}, &Edge::key);
  std::vector<bool> drop(nodes_.size(), false);
  std::uint64_t dropped = 0;
  std::uint32_t kept = 0;  // of those equal to the edge before
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const Edge &a = edges[i - 1], &b = edges[i];
    if (!drop[a.node]) kept = a.node;
    if (a.low != b.low || a.high != b.high) continue;
    const double apart = (b.bulge - a.bulge) / 2 * frame_.scale * distance(a.low, a.high);
    if (apart > 2 * tolerance_) continue;
    drop[b.node] = true;
    const bool same = nodes_[kept].original == nodes_[b.node].original;
    const EdgeWeight extra = nodes_[b.node].weight;
    nodes_[kept].weight.winding += same ? extra.winding : -extra.winding;
    nodes_[kept].weight.odd = nodes_[kept].weight.odd != extra.odd;
    ++dropped;
  }
  if (dropped == 0) return 0;
  std::vector<Node> nodes;
  std::vector<std::uint32_t> begin, rings;
  for (std::uint32_t ring = 0; ring < rings_.size(); ++ring) {
    const std::uint32_t first = begin_[ring], last = begin_[ring + 1] - 1;
    for (std::uint32_t v = first; v <= last; ++v) {
      const bool starts = v < last ? !drop[v] : first == last;
      const bool ends = v > first && !drop[v - 1];
      if (!starts && !ends) continue;
      if (!ends) {
        begin.push_back(static_cast<std::uint32_t>(nodes.size()));
        rings.push_back(rings_[ring]);
      }
      nodes.push_back(nodes_[v]);
    }
  }
  begin.push_back(static_cast<std::uint32_t>(nodes.size()));
  nodes_ = std::move(nodes);
  begin_ = std::move(begin);
  rings_ = std::move(rings);
  return dropped;
}

}  // namespace medial
