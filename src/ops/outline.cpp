#include <cmath>
#include <optional>

#include "base/arc.h"
#include "medial/compute.h"
#include "medial/sides.h"
#include "ops/half_edges.h"

namespace medial {
namespace {

using ops::HalfEdge;

/// A piece of the outline: along a site, along an arc of a disk, or straight between samples.
struct Piece {
  Vec2 begin, end;
  std::uint32_t site = no_site;  ///< or no_site
  double angle = 0;              ///< of an arc of a disk
  Disk disk;
};

/// The walk around the axis, with the boundary on its right.
class Outliner {
 public:
  explicit Outliner(const MedialAxis& axis) : axis_(axis), halves_(axis) {}

  std::vector<Contour> run() {
    std::vector<Contour> contours;
    std::vector<bool> done(halves_.count(), false);
    std::vector<bool> has_edge(axis_.nodes.size(), false);
    for (HalfEdge start = 0; start < halves_.count(); ++start) {
      has_edge[halves_.from(start)] = true;
      if (done[start]) continue;
      pieces_.clear();
      HalfEdge half = start;
      do {
        done[half] = true;
        add_side(half);
        add_gap(half);
        half = halves_.next(half);
      } while (half != start);
      if (joint_) pieces_.front().begin = *joint_;
      joint_.reset();
      join_ends();
      Contour contour = contour_of_pieces();
      if (!contour.pieces.empty()) contours.push_back(std::move(contour));
    }
    for (std::uint32_t node = 0; node < axis_.nodes.size(); ++node)
      if (!has_edge[node]) contours.push_back(circle(axis_.nodes[node].disk));
    return contours;
  }

 private:
  /// One piece for all edges that run along the same site.
  void add_side(HalfEdge half) {
    Piece piece{halves_.touch(half, false), halves_.touch(half, true), no_site, 0, {}};
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
    if (angle == 0) return;
    // Where the disk touches the joint of the two sites as well, the boundary is known better; and
    // where the joint counts as smooth, so that it has no branch although it lies beyond the disk.
    const bool smooth = angle <= Options{}.corner_angle;
    const HalfEdge next = halves_.next(half);
    if (halves_.exact(half) && halves_.exact(next)) {
      const Vec2 joint = axis_.sites[halves_.right_site(half)].end;
      const Disk& disk = halves_.disk(half, true);
      if (joint == axis_.sites[halves_.right_site(next)].start &&
          (smooth || std::abs(distance(joint, disk.center) - disk.radius) <= 4 * axis_.tolerance)) {
        pieces_.back().end = joint;
        joint_ = joint;
        return;
      }
    }
    pieces_.push_back({halves_.touch(half, true), halves_.touch(halves_.next(half), false), no_site,
                       angle, halves_.disk(half, true)});
  }

  /// The walk may have begun in the middle of a site.
  void join_ends() {
    if (pieces_.size() < 2 || pieces_.front().site == no_site) return;
    if (pieces_.front().site != pieces_.back().site) return;
    pieces_.front().begin = pieces_.back().begin;
    pieces_.pop_back();
  }

  /// What is an end of a site to rounding is that end.
  Vec2 snapped(Vec2 p, const Piece& piece) const {
    if (piece.site == no_site) return p;
    const double slack = 64 * axis_.tolerance;
    for (const Vec2 end : {axis_.sites[piece.site].start, axis_.sites[piece.site].end})
      if (distance(p, end) <= slack) return end;
    return p;
  }

  Contour contour_of_pieces() {
    // Along a site the boundary goes forward; a step backwards is rounding.
    for (Piece& piece : pieces_) {
      if (piece.site == no_site) continue;
      const Site& site = axis_.sites[piece.site];
      if (dot(piece.end - piece.begin, site.end - site.start) < 0) piece.end = piece.begin;
    }
    // Neighbours share a point: the end of a site where there is one. Between two sides of an exact
    // axis without an arc of a disk in between, they are apart by rounding.
    const double slack = 64 * axis_.tolerance;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      Piece &piece = pieces_[i], &next = pieces_[i + 1 < pieces_.size() ? i + 1 : 0];
      const bool sides = piece.site != no_site && next.site != no_site;
      const Vec2 end = snapped(piece.end, piece), begin = snapped(next.begin, next);
      if (!sides && distance(end, begin) > slack) continue;
      const bool by_next = end == piece.end && !(begin == next.begin);
      piece.end = next.begin = by_next || piece.site == no_site ? begin : end;
    }
    Contour contour;
    for (const Piece& piece : pieces_) {
      if (contour.points.empty()) contour.start_at(piece.begin);
      if (!(contour.points.back() == piece.begin)) contour.line_to(piece.begin);
      constexpr double half_turn = 3;  // about: no such arc ends where it begins, but a circle
      if (piece.begin == piece.end && piece.angle < half_turn) continue;
      if (piece.angle > 0) {
        ops::add_arc(piece.disk, piece.begin, piece.end, piece.angle, contour);
      } else if (piece.site != no_site && axis_.sites[piece.site].kind == SiteKind::arc) {
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
  std::vector<Piece> pieces_;  ///< of the contour under way
  std::optional<Vec2> joint_;  ///< where its next piece begins
};

}  // namespace

std::vector<Contour> boundary_of(const MedialAxis& axis) { return Outliner(axis).run(); }

}  // namespace medial
