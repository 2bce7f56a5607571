#include "methods/biarc_dc/conquer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <optional>
#include <span>
#include <vector>

#include "axis/node_kinds.h"
#include "axis/statistics.h"
#include "base/threads.h"
#include "site/bisector.h"
#include "site/tangent_disk.h"

namespace medial::biarc_dc {
namespace {

using Bone = Skeleton::Bone;
using site::Site;

/// Evaluates base cases one by one. The first nodes are the dividing disks; the new nodes follow.
class Evaluator {
 public:
  Evaluator(const Context& shared, const Division& division)
      : context_(shared), nodes_{division.disks, {}} {
    context_.statistics = {};
  }

  void evaluate(const BaseShape& base) {
    const auto& [first, second, third] = base.element;
    const std::uint32_t x = first.site, y = second.site, z = third.site;
    const std::uint32_t after_x = first.disk_after, after_y = second.disk_after,
                        after_z = third.disk_after;
    switch (base.base_case) {
      case BaseCase::cap:
        break;
      case BaseCase::b:
      case BaseCase::h:
      case BaseCase::i:
        add_edge(after_y, after_x, x, y);
        break;
      case BaseCase::m:
        add_edge(after_y, add_node({site(y).point, 0}, base), x, y);
        break;
      case BaseCase::d: {
        const double radius = 1 / site(y).curvature;
        const Disk apex{site(y).point + radius * site(y).normal(), radius};
        add_edge(after_z, add_node(apex, base), x, z);
        break;
      }
      case BaseCase::a:
      case BaseCase::g: {
        const std::uint32_t passage = add_meeting_node(base);
        add_edge(after_z, passage, x, z);
        add_edge(after_y, passage, z, y);
        break;
      }
      case BaseCase::e:
      case BaseCase::f: {
        const std::uint32_t branching = add_meeting_node(base);
        add_edge(after_z, branching, x, z);
        add_edge(after_y, branching, z, y);
        if (context_.outline.joints[x] == Joint::corner)
          add_edge(branching, add_node({site(y).point, 0}, base), x, y);
        break;
      }
      case BaseCase::c:
      case BaseCase::j:
      case BaseCase::k:
      case BaseCase::l: {
        const std::uint32_t branching = add_meeting_node(base);
        add_edge(after_z, branching, x, z);
        add_edge(after_x, branching, y, x);
        add_edge(after_y, branching, z, y);
        break;
      }
    }
  }

  /// Appends the results.
  void append_to(Skeleton& skeleton, Statistics& statistics) {
    const std::size_t known = nodes_.earlier.size();
    const auto shift = static_cast<std::uint32_t>(skeleton.nodes.size() - known);
    for (Bone& edge : edges_)
      for (std::uint32_t* const node : {&edge.from, &edge.to})
        if (*node >= known) *node += shift;
    skeleton.nodes.insert(skeleton.nodes.end(), nodes_.own.begin(), nodes_.own.end());
    skeleton.component.insert(skeleton.component.end(), component_.begin(), component_.end());
    skeleton.edges.insert(skeleton.edges.end(), edges_.begin(), edges_.end());
    statistics += context_.statistics;
  }

 private:
  const Site& site(std::uint32_t i) const { return context_.outline.sites[i]; }

  std::uint32_t add_node(const Disk& disk, const BaseShape& base) {
    component_.push_back(base.component);
    return nodes_.add(disk);
  }
  void add_edge(std::uint32_t from, std::uint32_t to, std::uint32_t right, std::uint32_t left) {
    edges_.push_back({from, to, right, left});
  }

  /// Adds the branching of a base case, or the node at which the third site replaces one of the
  /// two: the first of these on the way from the dividing disk after the third site.
  std::uint32_t add_meeting_node(const BaseShape& base) {
    const Subshape subshape{base.element, base.component};
    const std::uint32_t last = base.element[2].disk_after;
    const auto meeting = branching_disk(context_, subshape, {0, 2, nodes_[last]}, nodes_);
    return meeting ? add_node(meeting->disk, base) : last;
  }

  Context context_;
  DiskList nodes_;
  std::vector<std::uint32_t> component_;  ///< of its own nodes
  std::vector<Bone> edges_;
};

/// Groups of nodes that turned out to be one.
class Nodes {
 public:
  explicit Nodes(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Replaces node `i` by node `j`.
  void join(std::uint32_t i, std::uint32_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Whether two edges are between the same sites. Both parts of a site that a cutting disk divides
/// count as one.
bool between_same_sites(const SiteOutline& outline, const Bone& a, const Bone& b) {
  const auto same = [&](std::uint32_t x, std::uint32_t y) {
    return x == y ||
           (outline.originals[x] == outline.originals[y] && outline.is_cut(x) && outline.is_cut(y));
  };
  return (same(a.right, b.right) && same(a.left, b.left)) ||
         (same(a.right, b.left) && same(a.left, b.right));
}

/// Removes the edges without length, and merges their ends.
void contract(const Context& context, const Division& division, Skeleton& skeleton) {
  Nodes nodes(skeleton.nodes.size());
  for (const auto& [old, disk] : division.equal) nodes.join(old, disk);
  std::erase_if(skeleton.edges, [&](Bone& edge) {
    const std::uint32_t from = nodes.find(edge.from), to = nodes.find(edge.to);
    if (from == to) return true;
    const Disk &a = skeleton.nodes[from], &b = skeleton.nodes[to];
    // A corner stays a leaf, however thin the shape is there.
    if (!(a.radius > 0 && b.radius > 0 && context.coincide(a, b))) return false;
    nodes.join(from, to);
    return true;
  });
  for (Bone& edge : skeleton.edges) {
    edge.from = nodes.find(edge.from);
    edge.to = nodes.find(edge.to);
  }
  // Drop the nodes that were merged into others.
  for (std::uint32_t i = 0; i < skeleton.nodes.size(); ++i)
    if (nodes.find(i) != i) skeleton.component[i] = none;
}

/// In tolerances. Nodes that are closer may be one node that many sites touch.
constexpr double tie_reach = 64;
/// If a disk's radius equals an arc's within this share, its foot may be anywhere on the arc.
constexpr double same_circle = 1e-7;

/// A site that a node's disk touches, or should touch.
struct TieContact {
  std::uint32_t node, site;
  friend auto operator<=>(const TieContact&, const TieContact&) = default;
};

/// The disk that best touches all given sites. Returns `near` if it misses none by more than
/// `tolerance`: contacts on both sides of a channel do not determine the position along it.
/// Otherwise solves by least squares: moving the centre by (x, y) and the radius by z increases the
/// gap to a site by outward.x x + outward.y y - z. None if the result misses a site.
std::optional<Disk> disk_touching(const Context& context, std::span<const TieContact> touches,
                                  const Disk& near, double tolerance) {
  const auto touches_all = [&](const Disk& disk) {
    return std::all_of(touches.begin(), touches.end(), [&](const TieContact& touch) {
      return std::abs(site::gap(context.outline.sites[touch.site], disk)) <= tolerance;
    });
  };
  if (touches_all(near)) return near;
  std::array<std::array<double, 4>, 3> sum{};
  for (const TieContact& touch : touches) {
    const Site& site = context.outline.sites[touch.site];
    if (std::abs(site.curvature * near.radius - 1) <= same_circle) return std::nullopt;
    const Vec2 outward = site::outward(site, near.center);
    const std::array<double, 4> term{outward.x, outward.y, -1, -site::gap(site, near)};
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        sum[row][column] += term[row] * term[column];
  }
  const auto determinant = [&](std::size_t a, std::size_t b, std::size_t c) {
    return sum[0][a] * (sum[1][b] * sum[2][c] - sum[1][c] * sum[2][b]) -
           sum[0][b] * (sum[1][a] * sum[2][c] - sum[1][c] * sum[2][a]) +
           sum[0][c] * (sum[1][a] * sum[2][b] - sum[1][b] * sum[2][a]);
  };
  const double all = determinant(0, 1, 2);
  if (!(all > 0)) return std::nullopt;
  const Disk disk{near.center + (1 / all) * Vec2{determinant(3, 1, 2), determinant(0, 3, 2)},
                  near.radius + determinant(0, 1, 3) / all};
  return touches_all(disk) ? std::optional(disk) : std::nullopt;
}

/// Moves the node of each tie to the disk that touches all its sites, and marks whether there is
/// one. `touches` must be sorted.
void fit_ties(const Context& context, const std::vector<TieContact>& touches, Skeleton& skeleton,
              std::vector<std::uint8_t>& is_tie) {
  std::vector<std::size_t> begins;  // of the ties in `touches`
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (i == 0 || touches[i].node != touches[i - 1].node) begins.push_back(i);
  begins.push_back(touches.size());
  constexpr std::size_t few = 64;
  parallel_ranges(begins.size() - 1, few, [&](std::size_t i, std::size_t end) {
    for (; i < end; ++i) {
      const auto own = std::span(touches).subspan(begins[i], begins[i + 1] - begins[i]);
      const std::uint32_t node = own.front().node;
      const auto disk = disk_touching(context, own, skeleton.nodes[node], context.tolerance);
      if (disk) skeleton.nodes[node] = *disk;
      is_tie[node] = disk ? 1 : 0;
    }
  });
}

/// Merges nodes that are some tolerances apart if one disk touches all their sites (as in regular
/// polygons): each of them saw only the sites of its sub-shape. Also moves a single node whose
/// dividing disk misses a site of another sub-shape by some tolerances, so that it touches all its
/// sites.
void join_ties(const Context& context, Skeleton& skeleton) {
  const auto is_short = [&](const Bone& edge) {
    const Disk &a = skeleton.nodes[edge.from], &b = skeleton.nodes[edge.to];
    // If two disks at distance d touch a vertex, the disks between them reach over it by d^2 / (8
    // radius), here at most an eighth of the tolerance. In a row of short edges the errors add up,
    // so such nodes are only candidates: one disk must touch all their sites.
    const double reach = std::min(tie_reach * context.tolerance,
                                  std::sqrt(context.tolerance * std::min(a.radius, b.radius)));
    return a.radius > 0 && b.radius > 0 && distance(a.center, b.center) <= reach &&
           std::abs(a.radius - b.radius) <= reach;
  };
  const auto misses_site = [&](const Bone& edge, const Disk& disk) {
    const auto gap = [&](std::uint32_t site) {
      return std::abs(site::carrier_distance(context.outline.sites[site], disk.center) -
                      disk.radius);
    };
    return std::max(gap(edge.right), gap(edge.left)) > context.tolerance;
  };
  // Most edges are long and miss nothing, so few remain.
  constexpr std::size_t grain = 4096;
  std::vector<std::uint8_t> is_suspect(skeleton.edges.size());
  parallel_ranges(skeleton.edges.size(), grain, [&](std::size_t i, std::size_t end) {
    for (; i < end; ++i) {
      const Bone& edge = skeleton.edges[i];
      is_suspect[i] = is_short(edge) || misses_site(edge, skeleton.nodes[edge.from]) ||
                      misses_site(edge, skeleton.nodes[edge.to]);
    }
  });
  std::vector<Bone> suspects;
  for (std::size_t i = 0; i < skeleton.edges.size(); ++i)
    if (is_suspect[i] != 0) suspects.push_back(skeleton.edges[i]);
  if (suspects.empty()) return;
  Nodes nodes(skeleton.nodes.size());
  for (const Bone& edge : suspects)
    if (is_short(edge)) nodes.join(edge.from, edge.to);
  std::vector<std::uint8_t> is_tie(skeleton.nodes.size());
  for (const Bone& edge : suspects)
    for (const std::uint32_t node : {edge.from, edge.to})
      if (is_short(edge) || misses_site(edge, skeleton.nodes[node])) is_tie[nodes.find(node)] = 1;
  std::vector<TieContact> touches;
  for (const Bone& edge : skeleton.edges)
    for (const std::uint32_t end : {edge.from, edge.to})
      if (const std::uint32_t node = nodes.find(end); is_tie[node] != 0)
        touches.insert(touches.end(), {{node, edge.right}, {node, edge.left}});
  std::sort(touches.begin(), touches.end());
  touches.erase(std::unique(touches.begin(), touches.end()), touches.end());
  fit_ties(context, touches, skeleton, is_tie);
  std::erase_if(skeleton.edges, [&](Bone& edge) {
    const std::uint32_t one = nodes.find(edge.from);
    return one == nodes.find(edge.to) && is_tie[one] != 0;
  });
  for (std::uint32_t i = 0; i < skeleton.nodes.size(); ++i)
    if (nodes.find(i) != i && is_tie[nodes.find(i)] != 0) skeleton.component[i] = none;
  for (Bone& edge : skeleton.edges)
    for (std::uint32_t* const node : {&edge.from, &edge.to})
      if (skeleton.component[*node] == none) *node = nodes.find(*node);
}

/// Removes the nodes that only divide an edge, and joins both edges.
void dissolve(const SiteOutline& outline, Skeleton& skeleton) {
  struct Ends {
    std::array<std::uint32_t, 2> edge{none, none};
    std::uint32_t count = 0;
  };
  std::vector<Ends> ends(skeleton.nodes.size());
  for (std::uint32_t e = 0; e < skeleton.edges.size(); ++e) {
    for (const std::uint32_t node : {skeleton.edges[e].from, skeleton.edges[e].to}) {
      Ends& at = ends[node];
      if (at.count < 2) at.edge[at.count] = e;
      ++at.count;
    }
  }
  for (std::uint32_t n = 0; n < skeleton.nodes.size(); ++n) {
    if (ends[n].count != 2) continue;
    const auto [kept, gone] = ends[n].edge;
    Bone &first = skeleton.edges[kept], &second = skeleton.edges[gone];
    if (kept == gone || !between_same_sites(outline, first, second)) continue;
    const std::uint32_t far = second.from == n ? second.to : second.from;
    (first.from == n ? first.from : first.to) = far;
    for (std::uint32_t& edge : ends[far].edge)
      if (edge == gone) edge = kept;
    second.from = second.to = none;
    skeleton.component[n] = none;
  }
  std::erase_if(skeleton.edges, [](const Bone& edge) { return edge.from == none; });
}

/// Renumbers the remaining nodes.
void compact(Skeleton& skeleton) {
  std::vector<std::uint32_t> number(skeleton.nodes.size());
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    if (skeleton.component[i] == none) continue;
    number[i] = kept;
    skeleton.nodes[kept] = skeleton.nodes[i];
    skeleton.component[kept++] = skeleton.component[i];
  }
  skeleton.nodes.resize(kept);
  skeleton.component.resize(kept);
  for (Bone& edge : skeleton.edges) {
    edge.from = number[edge.from];
    edge.to = number[edge.to];
  }
}

}  // namespace

Skeleton conquer(Context& context, const Division& division) {
  constexpr std::size_t block = 4096;
  const std::size_t count = division.base_shapes.size();
  std::vector<std::optional<Evaluator>> blocks((count + block - 1) / block);
  parallel_for(blocks.size(), [&](std::size_t b) {
    Evaluator& evaluator = blocks[b].emplace(context, division);
    for (std::size_t i = b * block; i < std::min(count, (b + 1) * block); ++i)
      evaluator.evaluate(division.base_shapes[i]);
  });
  Skeleton skeleton{division.disks, division.component, {}};
  for (auto& evaluator : blocks) evaluator->append_to(skeleton, context.statistics);
  contract(context, division, skeleton);
  join_ties(context, skeleton);
  dissolve(context.outline, skeleton);
  compact(skeleton);
  return skeleton;
}

void add_edges(const Skeleton& skeleton, const Context& context, const LocalFrame& frame,
               bool curves, MedialAxis& axis) {
  const SiteOutline& outline = context.outline;
  axis.edges.resize(skeleton.edges.size());
  constexpr std::size_t block = 4096;
  const auto residuals = in_blocks<double>(axis.edges.size(), block, [&](std::size_t i, double& r) {
    const Bone& edge = skeleton.edges[i];
    const Disk &from = skeleton.nodes[edge.from], &to = skeleton.nodes[edge.to];
    for (const std::uint32_t site : {edge.left, edge.right})
      for (const Disk* disk : {&from, &to})
        r = std::max(
            r, std::abs(site::carrier_distance(outline.sites[site], disk->center) - disk->radius));
    const site::Control control =
        curves ? site::control_of(outline.sites[edge.left], outline.sites[edge.right], from, to)
               : site::Control{};
    axis.edges[i] = {{edge.from, edge.to},
                     {outline.originals[edge.left], outline.originals[edge.right]},
                     {frame.to_input(control.point.center), frame.inverse * control.point.radius},
                     control.weight};
  });
  double largest_residual = 0;
  for (const double residual : residuals) largest_residual = std::max(largest_residual, residual);
  axis.statistics.largest_residual = frame.inverse * largest_residual;
  std::vector<std::uint8_t> degree(skeleton.nodes.size());
  for (const Bone& edge : skeleton.edges)
    for (const std::uint32_t node : {edge.from, edge.to})
      if (degree[node] < 3) ++degree[node];
  axis.nodes.reserve(skeleton.nodes.size());
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    const Disk& disk = skeleton.nodes[i];
    const NodeKind kind = kind_of_degree(degree[i]);
    axis.nodes.push_back(
        {{frame.to_input(disk.center), frame.inverse * disk.radius}, skeleton.component[i], kind});
  }
}

}  // namespace medial::biarc_dc
