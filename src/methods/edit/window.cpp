#include "methods/edit/window.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "site/tangent_disk.h"

namespace medial::edit {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// A part of a site, or the disk of a bridge.
struct Piece {
  std::uint32_t site = none;  ///< none: a bridge
  double from = -endless, to = endless;
  std::uint32_t bridge = none;
};
using Cycle = std::vector<Piece>;

/// Assembles the pieces of the boundary between the borders, and connects separate cycles.
class Assembly {
 public:
  Assembly(const Rings& rings, const AxisGraph& graph, const Affected& affected,
           double radius_limit)
      : rings_(rings), graph_(graph), affected_(affected), radius_limit_(radius_limit) {}

  std::optional<std::vector<Window>> windows(const std::vector<std::uint32_t>& loops, int parts) {
    if ((affected_.nodes.empty() && parts <= 0) || !find_cycles()) return std::nullopt;
    add_whole_loops(loops);
    // The first cycle of a window goes around it, all others around holes in it. In the new part of
    // each window, nodes + borders - edges = 1 - holes.
    const auto signed_size = [](const auto& list) {
      return static_cast<std::ptrdiff_t>(list.size());
    };
    const std::ptrdiff_t twice = signed_size(cycles_) + parts + signed_size(affected_.nodes) +
                                 signed_size(affected_.borders) - signed_size(affected_.edges);
    if (twice % 2 != 0 || twice < 0) return std::nullopt;
    while (2 * signed_size(cycles_) > twice)
      if (!connect_any() || takes_long()) return std::nullopt;
    std::vector<Window> windows;
    for (Cycle& cycle : cycles_) windows.push_back(window(cycle));
    return windows;
  }

 private:
  /// The end of a piece, where a border's disk touches it.
  struct End {
    std::uint32_t site;
    double place;
    std::uint32_t border;
    bool operator<(const End& other) const {
      return site != other.site ? site < other.site : place < other.place;
    }
  };

  /// The position along a site at which a disk touches it: the parameter on an edge, counted across
  /// its pieces; on a vertex, the angle by which the normal has turned to the right since the edge
  /// before.
  double place_on(std::uint32_t number, Vec2 center) const {
    const site::Pieces pieces = rings_.pieces(number);
    if (Rings::is_edge(number)) {
      const bool is_last = pieces.count > 1 && site::squared_distance(pieces.last(), center) <
                                                   site::squared_distance(pieces.first(), center);
      return is_last ? pieces.first().length + site::foot_parameter(pieces.last(), center)
                     : site::foot_parameter(pieces.first(), center);
    }
    const std::uint32_t before = 2 * rings_.corner_before(number / 2) + 1;
    const Vec2 from = rings_.pieces(before).last().end_normal();
    const Vec2 to = center - pieces.first().point;
    const double angle = std::atan2(-cross(from, to), dot(from, to));
    return angle < -0.5 * std::numbers::pi ? angle + 2 * std::numbers::pi : angle;
  }

  const Disk& disk_of(std::uint32_t border) const {
    return graph_.disk(affected_.borders[border].node);
  }

  /// Finds the closed sequences of pieces and borders. Returns false if one does not close.
  bool find_cycles() {
    const auto& borders = affected_.borders;
    for (std::uint32_t i = 0; i < borders.size(); ++i)
      ends_.push_back({borders[i].right, place_on(borders[i].right, disk_of(i).center), i});
    std::sort(ends_.begin(), ends_.end());
    most_pieces_ = 8 * (affected_.edges.size() + borders.size()) + 64;
    std::vector<bool> used(borders.size(), false);
    for (std::uint32_t first = 0; first < borders.size(); ++first) {
      if (used[first]) continue;
      Cycle& cycle = cycles_.emplace_back();
      std::uint32_t border = first;
      do {
        border = add_between(border, cycle);
        if (border == none || used[border]) return false;
        used[border] = true;
        cycle.push_back({none, -endless, endless, border});
      } while (border != first);
    }
    return true;
  }

  /// Adds the pieces from a border to the next one, and returns that border.
  std::uint32_t add_between(std::uint32_t border, Cycle& cycle) {
    std::uint32_t site = affected_.borders[border].left;
    double from = place_on(site, disk_of(border).center);
    while (pieces_++ < most_pieces_) {
      add_loop(rings_[site / 2].loop);
      const auto end = std::upper_bound(ends_.begin(), ends_.end(), End{site, from, 0});
      if (end != ends_.end() && end->site == site) {
        cycle.push_back({site, from, end->place});
        return end->border;
      }
      cycle.push_back({site, from});
      site = rings_.next_site(site);
      from = -endless;
    }
    return none;
  }

  bool add_loop(std::uint32_t loop) { return loops_.insert(loop).second; }

  /// Adds the loops that no border touches.
  void add_whole_loops(const std::vector<std::uint32_t>& loops) {
    std::vector<std::uint32_t> found = loops;
    for (const std::uint32_t edge : affected_.edges)
      for (const std::uint32_t site : graph_.edge(edge).site)
        if (rings_.is_site(site)) found.push_back(rings_[site / 2].loop);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const std::uint32_t one : found) {
      if (!add_loop(one)) continue;
      Cycle& cycle = cycles_.emplace_back();
      const std::uint32_t first = 2 * rings_.first_of(one) + 1;
      std::uint32_t site = first;
      do {
        cycle.push_back({site});
        site = rings_.next_site(site);
      } while (site != first);
    }
  }

  /// A disk that touches an edge of one cycle and a site of another.
  struct Connection {
    std::size_t piece, cycle, other_piece;
    double place, other_place;
    Disk disk;
  };

  bool takes_long() const {
    constexpr std::size_t most_looks = 256;  // per piece
    return looks_ > most_looks * most_pieces_;
  }

  /// Connects two cycles. Returns false if no disk connects any.
  bool connect_any() {
    for (std::size_t i = cycles_.size(); i-- > 0;) {
      std::swap(cycles_[i], cycles_.back());
      if (connect_last()) return true;
    }
    return false;
  }

  /// Connects the last cycle with another one. Returns false if no disk does, or if the search
  /// takes too long.
  bool connect_last() {
    const Cycle& last = cycles_.back();
    std::size_t pieces = 0;
    for (const Cycle& cycle : cycles_) pieces += cycle.size();
    for (std::size_t i = 0; i < last.size(); ++i) {
      if (last[i].site == none || !Rings::is_edge(last[i].site)) continue;
      looks_ += pieces;
      if (takes_long()) return false;
      if (const auto found = connection(i)) {
        splice(*found);
        return true;
      }
    }
    return false;
  }

  /// The disk that touches a piece of the last cycle at a chosen point, if it touches another
  /// cycle.
  std::optional<Connection> connection(std::size_t piece) const {
    constexpr double share = 0.3819660112501051;  // golden section, hardly a special point
    const Piece& own = cycles_.back()[piece];
    const site::Pieces edge = rings_.pieces(own.site);
    const double from = std::max(own.from, 0.0), to = std::min(own.to, length_of(edge));
    if (!(from < to)) return std::nullopt;
    const double place = from + share * (to - from);
    const bool on_last = edge.count > 1 && place > edge.first().length;
    const site::Site& own_piece = on_last ? edge.last() : edge.first();
    const double s = on_last ? place - edge.first().length : place;
    const Vec2 foot = own_piece.at(s), normal = own_piece.normal_at(s);
    std::uint32_t touched = none;
    double radius = radius_limit_;
    if (own_piece.curvature > 0) radius = std::min(radius, 1 / own_piece.curvature);
    for (const Cycle& cycle : cycles_)
      for (const Piece& other : cycle) {
        if (other.site == none || other.site == own.site) continue;
        const site::Pieces pieces = rings_.pieces(other.site);
        for (std::size_t k = 0; k < pieces.count; ++k) {
          const double r = site::touching_radius(foot, normal, pieces.site[k]);
          if (r < radius || (r == radius && !Rings::is_edge(other.site))) {
            radius = r;
            touched = other.site;
          }
        }
      }
    if (touched == none || !(radius > 0)) return std::nullopt;
    const Disk disk{foot + radius * normal, radius};
    touched = owner(touched, disk.center);
    const double other_place = place_on(touched, disk.center);
    for (std::size_t c = 0; c + 1 < cycles_.size(); ++c)
      for (std::size_t i = 0; i < cycles_[c].size(); ++i) {
        const Piece& other = cycles_[c][i];
        if (other.site == touched && other.from < other_place && other_place < other.to)
          return Connection{piece, c, i, place, other_place, disk};
      }
    return std::nullopt;
  }

  static double length_of(const site::Pieces& edge) {
    return edge.first().length + (edge.count > 1 ? edge.last().length : 0);
  }

  /// The vertex, if an edge is touched at an end that is a site of its own; else the edge.
  std::uint32_t owner(std::uint32_t number, Vec2 center) const {
    if (!Rings::is_edge(number)) return number;
    const double s = place_on(number, center);
    const std::uint32_t after = rings_.corner_after(number / 2);
    if (s <= 0 && rings_.is_reflex(number / 2)) return number - 1;
    if (s >= length_of(rings_.pieces(number)) && rings_.is_reflex(after)) return 2 * after;
    return number;
  }

  void splice(const Connection& found) {
    const Cycle inner = std::move(cycles_.back());
    cycles_.pop_back();
    const auto bridge = static_cast<std::uint32_t>(affected_.borders.size() + connections_.size());
    connections_.push_back(found.disk);
    Cycle& outer = cycles_[found.cycle];
    const Piece divided = outer[found.other_piece], begun = inner[found.piece];
    const Piece marker{none, -endless, endless, bridge};
    Cycle added{{divided.site, divided.from, found.other_place}, marker};
    added.push_back({begun.site, found.place, begun.to});
    for (std::size_t i = 1; i < inner.size(); ++i)
      added.push_back(inner[(found.piece + i) % inner.size()]);
    added.push_back({begun.site, begun.from, found.place});
    added.push_back(marker);
    outer[found.other_piece] = {divided.site, found.other_place, divided.to};
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(found.other_piece), added.begin(),
                 added.end());
  }

  /// Makes a boundary of a remaining cycle, starting at its first border.
  Window window(Cycle& cycle) const {
    Window window;
    const std::size_t borders = affected_.borders.size();
    std::vector<std::uint32_t> bridges;
    for (const Piece& piece : cycle) {
      if (piece.site == none)
        bridges.push_back(piece.bridge);
      else
        window.loops.push_back(rings_[piece.site / 2].loop);
    }
    std::sort(bridges.begin(), bridges.end());
    bridges.erase(std::unique(bridges.begin(), bridges.end()), bridges.end());
    for (const std::uint32_t bridge : bridges) {
      if (bridge < borders) window.borders.push_back(affected_.borders[bridge]);
      window.boundary.bridges.push_back(
          {bridge < borders ? disk_of(bridge) : connections_[bridge - borders]});
    }
    std::sort(window.loops.begin(), window.loops.end());
    window.loops.erase(std::unique(window.loops.begin(), window.loops.end()), window.loops.end());
    if (window.borders.empty()) return window;
    for (Piece& piece : cycle)
      if (piece.site == none)
        piece.bridge = static_cast<std::uint32_t>(
            std::lower_bound(bridges.begin(), bridges.end(), piece.bridge) - bridges.begin());
    const auto start = std::find_if(cycle.begin(), cycle.end(),
                                    [](const Piece& piece) { return piece.bridge == 0; });
    std::rotate(cycle.begin(), start + 1, cycle.end());
    cycle.pop_back();
    for (const Piece& piece : cycle)
      if (piece.site != none) window.names.push_back(piece.site);
    std::vector<std::uint32_t>& names = window.names;
    std::sort(names.begin(), names.end());
    std::vector<bool> several(names.size(), false);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (kept > 0 && names[kept - 1] == names[i])
        several[kept - 1] = true;
      else
        names[kept++] = names[i];
    }
    names.resize(kept);
    disks::Boundary& boundary = window.boundary;
    boundary.has_arcs = rings_.has_arcs();
    boundary.reserve(cycle.size());
    for (const Piece& piece : cycle) add(piece, names, several, boundary);
    boundary.runs.push_back({0, static_cast<std::uint32_t>(boundary.sites.size() - 1), false});
    return window;
  }

  void add(const Piece& piece, const std::vector<std::uint32_t>& names,
           const std::vector<bool>& several, disks::Boundary& boundary) const {
    using disks::Element;
    const auto here = static_cast<std::uint32_t>(boundary.sites.size());
    if (piece.site == none) {
      auto& places = boundary.bridges[piece.bridge].places;
      if (places[0] == none) places[0] = here;
      places[1] = here;
      boundary.add(site::make_vertex({1e30, 1e30}), Element::bridge, piece.bridge);
      return;
    }
    const auto name = static_cast<std::uint32_t>(
        std::lower_bound(names.begin(), names.end(), piece.site) - names.begin());
    const site::Pieces pieces = rings_.pieces(piece.site);
    if (!Rings::is_edge(piece.site)) return boundary.add(pieces.first(), Element::vertex, name);
    double begin = 0;
    for (std::size_t k = 0; k < pieces.count; ++k) {
      const site::Site& whole = pieces.site[k];
      const double from = std::max(piece.from - begin, 0.0),
                   to = std::min(piece.to - begin, whole.length);
      begin += whole.length;
      if (pieces.count > 1 && !(from < to)) continue;
      const bool is_last = k + 1 == pieces.count;
      boundary.add(
          several[name] ? site::part_of(whole, from, to) : whole, Element::edge, name,
          is_last ? rings_[rings_.corner_after(piece.site / 2)].joint : site::Joint::smooth);
    }
  }

  const Rings& rings_;
  const AxisGraph& graph_;
  const Affected& affected_;
  const double radius_limit_;
  std::vector<End> ends_;
  std::vector<Cycle> cycles_;
  std::set<std::uint32_t> loops_;
  std::vector<Disk> connections_;
  std::size_t pieces_ = 0, most_pieces_ = 0;
  std::size_t looks_ = 0;  ///< pieces visited in order to connect cycles
};

}  // namespace

void Spread::add_node(std::uint32_t node) {
  if (node >= marks_.size()) marks_.resize(graph_.node_slots(), 0);
  if (marks_[node] == mark_) return;
  marks_[node] = mark_;
  nodes_.push_back(node);
}

void Spread::add_around(std::uint32_t node, std::size_t count) {
  std::size_t next = nodes_.size();
  for (add_node(node); next < nodes_.size() && count > 0; ++next, --count)
    graph_.for_edges_at(nodes_[next], [&](std::uint32_t edge, std::size_t k) {
      add_node(graph_.edge(edge).node[1 - k]);
    });
}

void Spread::add_site(std::uint32_t site) {
  graph_.for_edges_of_site(site, [&](std::uint32_t edge, std::size_t) {
    for (const std::uint32_t node : graph_.edge(edge).node) add_node(node);
  });
}

void Spread::spread(const std::vector<site::Site>& fresh, double margin) {
  const auto is_near = [&](const Disk& disk) {
    const double reach = disk.radius + margin;
    return std::any_of(fresh.begin(), fresh.end(), [&](const site::Site& site) {
      return site::squared_distance(site, disk.center) < reach * reach;
    });
  };
  if (marks_.size() < graph_.node_slots()) marks_.resize(graph_.node_slots(), 0);
  for (; spread_ < nodes_.size(); ++spread_)
    graph_.for_edges_at(nodes_[spread_], [&](std::uint32_t edge, std::size_t k) {
      const std::uint32_t other = graph_.edge(edge).node[1 - k];
      if (marks_[other] == mark_) return;
      const Disk& disk = graph_.disk(other);
      if (disk.radius == 0 || graph_.degree(other) == 1 || is_near(disk)) add_node(other);
    });
}

Affected Spread::result() const {
  Affected affected;
  affected.nodes = nodes_;
  for (const std::uint32_t node : nodes_)
    graph_.for_edges_at(node, [&](std::uint32_t number, std::size_t k) {
      const AxisGraph::Edge& edge = graph_.edge(number);
      const std::uint32_t other = edge.node[1 - k];
      const bool is_border = marks_[other] != mark_;
      if (!is_border && k == 1) return;  // added from its other end
      affected.edges.push_back(number);
      if (!is_border) return;
      const bool goes_there = k == 0;
      affected.borders.push_back(
          {other, edge.site[goes_there ? 1 : 0], edge.site[goes_there ? 0 : 1]});
    });
  return affected;
}

std::optional<std::vector<Window>> windows_of(const Rings& rings, const AxisGraph& graph,
                                              const Affected& affected,
                                              const std::vector<std::uint32_t>& loops, int parts,
                                              double radius_limit) {
  return Assembly(rings, graph, affected, radius_limit).windows(loops, parts);
}

}  // namespace medial::edit
