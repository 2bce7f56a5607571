#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "axis/node_kinds.h"
#include "base/arc.h"
#include "base/compat.h"
#include "medial/sides.h"
#include "ops/half_edges.h"
#include "site/joint.h"

namespace medial {
namespace {

using ops::HalfEdge;

/// A piece of the outline: along a site, along an arc of a disk, or straight between samples.
struct OutlinePiece {
  Vec2 begin, end;
  std::uint32_t site = no_site;  ///< or no_site
  double angle = 0;              ///< of an arc of a disk
  Disk disk;
};

/// The walk around the axis, with the boundary on its right.
class BoundaryWalk {
 public:
  BoundaryWalk(const MedialAxis& axis, double corner_angle)
      : axis_(axis), halves_(axis), corner_angle_(corner_angle * std::numbers::pi / 180) {}

  std::vector<Contour> run() {
    std::vector<Contour> contours;
    halves_.each_walk([&](std::span<const HalfEdge> walk) {
      pieces_.clear();
      for (const HalfEdge half : walk) {
        add_side(half);
        add_gap(half);
      }
      if (joint_) pieces_.front().begin = *joint_;
      joint_.reset();
      join_ends();
      Contour contour = contour_of_pieces();
      if (!contour.pieces.empty()) contours.push_back(std::move(contour));
    });
    const std::vector<std::uint32_t> degree = degrees_of(axis_);
    for (std::uint32_t node = 0; node < axis_.nodes.size(); ++node)
      if (degree[node] == 0) contours.push_back(circle(axis_.nodes[node].disk));
    return contours;
  }

 private:
  /// One piece for all edges that run along the same site.
  void add_side(HalfEdge half) {
    OutlinePiece piece{halves_.touch(half, false), halves_.touch(half, true), no_site, 0, {}};
    if (halves_.exact(half)) piece.site = halves_.right_site(half);
    if (joint_) piece.begin = *joint_;
    joint_.reset();
    if (!pieces_.empty() && piece.site != no_site && pieces_.back().site == piece.site) {
      pieces_.back().end = piece.end;
    } else {
      pieces_.push_back(piece);
    }
  }

  /// The arc of the disk between a half edge and the next, counter-clockwise: the gap in (3).
  void add_gap(HalfEdge half) {
    const double angle = halves_.gap(half);
    // Where the disk touches the joint of the two sites as well, the boundary is known better; and
    // where the joint counts as smooth, so that it has no branch although it lies beyond the disk.
    const HalfEdge next = halves_.next(half);
    if (halves_.exact(half) && halves_.exact(next)) {
      const std::uint32_t before = halves_.right_site(half), after = halves_.right_site(next);
      const Vec2 joint = axis_.sites[before].end;
      const Disk& disk = halves_.disk(half, true);
      if (joint == axis_.sites[after].start &&
          (goes_on(before, after) || (angle > 0 && std::abs(distance(joint, disk.center) -
                                                            disk.radius) <= 4 * axis_.tolerance))) {
        pieces_.back().end = joint;
        joint_ = joint;
        return;
      }
      const auto arcs =
          angle > 0 ? arcs_between(disk, before, after) : std::vector<std::uint32_t>{};
      for (const std::uint32_t i : arcs) {
        const Site& site = axis_.sites[i];
        pieces_.back().end = site.start;
        pieces_.push_back({site.start, site.end, i, 0, {}});
        joint_ = site.end;
      }
      if (!arcs.empty()) return;
    }
    if (angle == 0) return;
    pieces_.push_back({halves_.touch(half, true), halves_.touch(next, false), no_site, angle,
                       halves_.disk(half, true)});
  }

  /// Whether the boundary goes from one site on to the other without a convex corner, so that no
  /// branch of the axis leads there.
  bool goes_on(std::uint32_t before, std::uint32_t after) const {
    const Site &a = axis_.sites[before], &b = axis_.sites[after];
    if (!(a.end == b.start)) return false;
    if (a.kind() == SiteKind::vertex || b.kind() == SiteKind::vertex) return true;
    if (a.kind() != SiteKind::arc && b.kind() != SiteKind::arc) return false;
    const site::Joint joint = site::joint_of({a.start, a.end, a.bulge}, {b.start, b.end, b.bulge},
                                             axis_.tolerance, corner_angle_);
    return joint == site::Joint::smooth || joint == site::Joint::blunt;
  }

  /// Where the disk is that of a leaf at arcs between two sites, which it touches all along but for
  /// the angles at their joints: those arcs, with reflex vertices that may lie between.
  std::vector<std::uint32_t> arcs_between(const Disk& disk, std::uint32_t before,
                                          std::uint32_t after) const {
    const auto& sites = axis_.sites;
    std::vector<std::uint32_t> chain = ops::sites_between(
        axis_, before, after, [&](std::uint32_t a, std::uint32_t b) { return goes_on(a, b); },
        [&](const Site& site) { return site.kind() == SiteKind::vertex || site.bulge > 0; });
    if (chain.size() < 3) return {};
    double turns = 0;
    std::optional<Vec2> arriving;
    for (const std::uint32_t i : chain) {
      if (sites[i].kind() == SiteKind::vertex) continue;
      const BulgeArc edge{sites[i].start, sites[i].end, sites[i].bulge};
      if (arriving) turns += std::abs(signed_angle(*arriving, start_tangent(edge)));
      arriving = end_tangent(edge);
    }
    chain.pop_back();
    chain.erase(chain.begin());
    const double slack = ops::slack_of(axis_, disk) + turns * disk.radius;
    const auto touches = [&](Vec2 p) {
      return std::abs(distance(p, disk.center) - disk.radius) <= slack;
    };
    const bool all = ranges::all_of(
        chain, [&](std::uint32_t i) { return touches(sites[i].start) && touches(sites[i].end); });
    return all ? chain : std::vector<std::uint32_t>{};
  }

  /// The walk may have started in the middle of a site.
  void join_ends() {
    if (pieces_.size() < 2 || pieces_.front().site == no_site) return;
    if (pieces_.front().site != pieces_.back().site) return;
    pieces_.front().begin = pieces_.back().begin;
    pieces_.pop_back();
  }

  /// What is an end of a site to rounding is that end; of a site as short as rounding, the one that
  /// it would be.
  Vec2 snapped(Vec2 p, const OutlinePiece& piece, bool at_end) const {
    if (piece.site == no_site) return p;
    const double slack = 64 * axis_.tolerance;
    const Site& site = axis_.sites[piece.site];
    const Vec2 likely = at_end ? site.end : site.start, other = at_end ? site.start : site.end;
    if (distance(p, likely) <= slack) return likely;
    return distance(p, other) <= slack ? other : p;
  }

  Contour contour_of_pieces() {
    // Along a site the boundary goes forward; a step backwards is rounding.
    for (OutlinePiece& piece : pieces_) {
      if (piece.site == no_site) continue;
      const Site& site = axis_.sites[piece.site];
      if (dot(piece.end - piece.begin, site.end - site.start) < 0) piece.end = piece.begin;
    }
    // Neighbours share a point: the end of a site where there is one. Between two sides of an exact
    // axis without an arc of a disk in between, they are apart by rounding.
    const double slack = 64 * axis_.tolerance;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      OutlinePiece &piece = pieces_[i], &next = pieces_[i + 1 < pieces_.size() ? i + 1 : 0];
      const bool sides = piece.site != no_site && next.site != no_site;
      const Vec2 end = snapped(piece.end, piece, true), begin = snapped(next.begin, next, false);
      if (!sides && distance(end, begin) > slack) continue;
      const bool by_next = end == piece.end && !(begin == next.begin);
      piece.end = next.begin = by_next || piece.site == no_site ? begin : end;
    }
    Contour contour;
    for (const OutlinePiece& piece : pieces_) {
      if (contour.points.empty()) contour.start_at(piece.begin);
      if (!(contour.points.back() == piece.begin)) contour.line_to(piece.begin);
      constexpr double half_turn = 3;  // about: of these, only a circle ends where it begins
      if (piece.begin == piece.end && piece.angle < half_turn) continue;
      if (piece.angle > 0) {
        ops::add_arc(piece.disk, piece.begin, piece.end, piece.angle, contour);
      } else if (piece.site != no_site && axis_.sites[piece.site].kind() == SiteKind::arc) {
        const Site& site = axis_.sites[piece.site];
        const bool whole = piece.begin == site.start && piece.end == site.end;
        contour.arc_to(piece.end, whole ? site.bulge
                                        : partial_bulge({site.start, site.end, site.bulge},
                                                        piece.begin, piece.end));
      } else {
        contour.line_to(piece.end);
      }
    }
    return contour;
  }

  static Contour circle(const Disk& disk) {
    Contour contour;
    const Vec2 east{disk.radius, 0};
    contour.start_at(disk.center + east);
    contour.arc_to(disk.center - east, 1);
    contour.arc_to(disk.center + east, 1);
    return contour;
  }

  const MedialAxis& axis_;
  const ops::HalfEdges halves_;
  const double corner_angle_;
  std::vector<OutlinePiece> pieces_;  ///< of the contour under way
  std::optional<Vec2> joint_;         ///< where its next piece begins
};

}  // namespace

std::vector<Contour> ops::boundary_of(const MedialAxis& axis, double corner_angle) {
  return BoundaryWalk(axis, corner_angle).run();
}

}  // namespace medial
